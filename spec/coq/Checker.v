(** * The checker's reduction (checker.md: CHECK-3, CHECK-4, CHECK-7)

    Schedules (L2) are runs of deliveries and mutations. Histories (L1) are made of macro-steps: a replica
    receives any set of deltas and mutates. Both have the same pools of broadcast deltas, and every state of a
    schedule is that of a delivered subset of its pool. *)

From DSR Require Export Network.

(** A macro-step. *)
Record Macro := { who : Replica; when : N; receives : list State; what : Mutation }.

(** The deltas broadcast, and each replica's state after its last mutation. *)
Record History := { pool : list State; last : Replica -> State }.

Definition beginning : History := {| pool := []; last := fun _ => bottom |}.

Section Reduction.
  Context (D : Dictionary).

  (** The state in which the mutation of a macro-step is made. *)
  Definition ready (h : History) (s : Macro) : State := last h (who s) ⊔ joins (receives s).

  Definition macro (h : History) (s : Macro) : History :=
    let X := ready h s in
    let M := delta D {| me := who s; time_ns := when s |} (what s) X in
    {| pool := M :: pool h; last := update (last h) (who s) (X ⊔ M) |}.

  (** Received is what was broadcast, and the mutation is possible then. *)
  Definition may (h : History) (s : Macro) : Prop :=
    incl (receives s) (pool h) /\ possible (ready h s) (what s) = true.

  Fixpoint legal (h : History) (l : list Macro) : Prop :=
    match l with [] => True | s :: l => may h s /\ legal (macro h s) l end.
  Definition history (l : list Macro) : History := fold_left macro l beginning.

  (** A schedule of CHECK-7: without restarts, resynchronisation and groups. *)
  Definition plain (e : event) : Prop := match e with Mutate _ _ _ | Deliver _ _ => True | _ => False end.

  (** ** From schedules to histories: deliveries are fused into the mutation that first observes them *)

  Fixpoint project (w : World) (waiting : Replica -> list State) (es : list event) : list Macro :=
    match es with
    | [] => []
    | Mutate p t m :: es =>
        if possible (at_ w p) m
        then {| who := p; when := t; receives := waiting p; what := m |}
             :: project (step D w (Mutate p t m)) (update waiting p []) es
        else project w waiting es
    | Deliver p M :: es =>
        if sent w M then project (step D w (Deliver p M)) (update waiting p (M :: waiting p)) es
        else project w waiting es
    | e :: es => project (step D w e) waiting es
    end.

  Record related (w : World) (h : History) (waiting : Replica -> list State) : Prop := {
    related_sound : sound_world w;
    same_pool : messages w = pool h;
    waiting_sent : forall p, incl (waiting p) (messages w);
    last_proper : forall p, proper (said w) (last h p);
    same_state : forall p, at_ w p = last h p ⊔ joins (waiting p)
  }.

  Lemma projection es : Forall plain es -> forall w h waiting, related w h waiting ->
    legal h (project w waiting es) /\
    exists waiting', related (fold_left (step D) es w) (fold_left macro (project w waiting es) h) waiting'.
  Proof.
    induction 1 as [| e es P F IH]; intros w h waiting R; simpl; [eauto |].
    destruct R as [S EP WS LP ES].
    assert (PW : forall p, Forall (proper (said w)) (waiting p)).
    { intros p. apply Forall_forall. intros M I. apply WS in I. split; [now apply (messages_wf _ S) |].
      intros d x G. now exists M. }
    destruct e as [p t m | p M | | | |]; try easy; simpl.
    - destruct (possible (at_ w p) m) eqn:Q; [| now apply IH]. simpl.
      set (s := {| who := p; when := t; receives := waiting p; what := m |}).
      assert (ER : ready h s = at_ w p) by (unfold ready; simpl; now rewrite ES).
      set (M := delta D {| me := p; time_ns := t |} m (at_ w p)) in *.
      assert (S' : sound_world (receive p M (say M w))) by now apply mutate_sound.
      assert (EM : forall q, last (macro h s) q = update (last h) p (at_ w p ⊔ M) q).
      { intros q. unfold macro. rewrite ER. reflexivity. }
      assert (R : related (receive p M (say M w)) (macro h s) (update waiting p [])).
      { constructor; auto.
        - simpl. rewrite EP, ER. reflexivity.
        - intros q. apply (update_case (fun _ l => incl l (messages (receive p M (say M w))))); [easy |].
          intros r _ N I. right. now apply (WS r).
        - intros q. rewrite EM. unfold update. destruct (eqb q p) eqn:E.
          + apply eqb_eq in E. subst q. pose proof (state_wf _ S' p) as W. pose proof (state_filed _ S' p) as G.
            simpl in W, G. unfold update in W, G. rewrite eqb_refl in W, G. now split.
          + destruct (LP q) as [W G]. split; auto. intros d x H. destruct (G d x H) as (N & I & K).
            exists N. split; auto. now right.
        - intros q. rewrite EM. simpl. unfold update. destruct (eqb q p) eqn:E; auto.
          simpl. rewrite join_bottom_right; auto.
          pose proof (state_wf _ S' p) as W. simpl in W. unfold update in W. now rewrite eqb_refl in W. }
      destruct (IH _ _ _ R) as (L & R'). split; auto. split; auto. split.
      + simpl. rewrite <- EP. auto.
      + now rewrite ER.
    - destruct (sent w M) eqn:E; [| now apply IH]. apply IH.
      assert (I : In M (messages w)) by now apply sent_in.
      assert (PM : proper (said w) M).
      { split; [now apply (messages_wf _ S) |]. intros d x G. now exists M. }
      constructor; auto.
      + now apply receive_sound.
      + intros q. simpl. apply (update_case (fun _ l => incl l (messages w))); auto.
        intros N [<- | J]; auto. now apply (WS p).
      + intros q. simpl. unfold update. destruct (eqb q p) eqn:EQ; auto.
        apply eqb_eq in EQ. subst q. simpl. rewrite ES, (join_comm M).
        pose proof (proper_joins _ _ (PW p)) as PJ.
        apply join_assoc; eapply proper_agree; eauto; apply S.
  Qed.

  Lemma related_start : related start beginning (fun _ => []).
  Proof.
    constructor; simpl; auto using start_sound, proper_bottom; easy.
  Qed.

  (** [CHECK-7] Every schedule projects to a history with the same pool, in which each replica's state is its
      state after its last mutation with a delivered subset of the pool. *)
  Theorem schedule_is_history es : Forall plain es ->
    let l := project start (fun _ => []) es in
    legal beginning l /\ pool (history l) = messages (run D es) /\
    forall p, exists S, incl S (pool (history l)) /\ at_ (run D es) p = last (history l) p ⊔ joins S.
  Proof.
    intros P l. destruct (projection es P _ _ _ related_start) as (L & waiting & R).
    split; [auto | split; [symmetry; apply R |]]. intros p. exists (waiting p). split.
    - fold l in R. unfold history. rewrite <- (same_pool _ _ _ R). apply (waiting_sent _ _ _ R).
    - apply (same_state _ _ _ R).
  Qed.

  (** [CHECK-4] In a run of any kind each state is that of a delivered subset of what was sent. *)
  Theorem state_of_subset es p : exists S, incl S (messages (run D es)) /\ at_ (run D es) p = joins S.
  Proof.
    pose proof (run_sound D es) as S. exists (got (run D es) p). split; [apply S | apply (state_joins _ S)].
  Qed.

  (** ** From histories to schedules *)

  Definition deliveries (p : Replica) (S : list State) : list event := map (Deliver p) S.
  Definition unfuse (l : list Macro) : list event :=
    flat_map (fun s => deliveries (who s) (receives s) ++ [Mutate (who s) (when s) (what s)]) l.

  Lemma plain_deliveries p S : Forall plain (deliveries p S).
  Proof. induction S; simpl; constructor; simpl; auto. Qed.

  Lemma plain_unfuse l : Forall plain (unfuse l).
  Proof.
    induction l as [| s l IH]; simpl; auto. rewrite !Forall_app. repeat split; auto using plain_deliveries.
    repeat constructor.
  Qed.

  Lemma delivered S : forall w p, sound_world w -> incl S (messages w) ->
    let w' := fold_left (step D) (deliveries p S) w in
    sound_world w' /\ messages w' = messages w /\
    (forall q, at_ w' q = if eqb q p then at_ w p ⊔ joins S else at_ w q).
  Proof.
    induction S as [| M S IH]; intros w p SW I; simpl.
    - split; [auto | split; auto]. intros q. destruct (eqb q p) eqn:E; auto. apply eqb_eq in E. subst.
      rewrite join_bottom_right; auto. apply (state_wf _ SW).
    - assert (IM : In M (messages w)) by (apply I; now left).
      assert (SM : sent w M = true).
      { apply existsb_exists. exists M. split; auto. now apply state_eqb_eq. }
      rewrite SM. destruct (IH (receive p M w) p) as (S1 & S2 & S3).
      { now apply receive_sound. }
      { intros N J. apply I. now right. }
      split; [auto | split; auto]. intros q. rewrite S3. simpl. unfold update. rewrite eqb_refl.
      destruct (eqb q p) eqn:E; auto.
      assert (PS : forall N, In N (messages w) -> proper (said w) N).
      { intros N J. split; [now apply (messages_wf _ SW) |]. intros d x G. now exists N. }
      assert (PJ : proper (said w) (joins S)).
      { apply proper_joins. apply Forall_forall. intros N J. apply PS, I. now right. }
      assert (PA : proper (said w) (at_ w p)) by (split; [apply (state_wf _ SW) | apply (state_filed _ SW)]).
      pose proof (proper_agree _ (said_once _ SW)) as A. apply join_assoc; auto.
  Qed.

  Lemma unfused l : forall w h, related w h (fun _ => []) -> legal h l ->
    related (fold_left (step D) (unfuse l) w) (fold_left macro l h) (fun _ => []).
  Proof.
    induction l as [| s l IH]; intros w h R L; simpl; auto. destruct L as [[I Q] L].
    rewrite !fold_left_app. apply IH; auto. simpl. pose proof R as R0. destruct R as [SW EP _ LP ES].
    assert (EL : forall p, at_ w p = last h p).
    { intros p. rewrite ES. simpl. apply join_bottom_right. apply LP. }
    rewrite <- EP in I. destruct (delivered _ w (who s) SW I) as (S1 & S2 & S3).
    set (w' := fold_left (step D) (deliveries (who s) (receives s)) w) in *.
    assert (ER : at_ w' (who s) = ready h s) by (rewrite S3, eqb_refl, EL; reflexivity).
    rewrite ER, Q. rewrite <- ER in Q. pose proof (mutate_sound D _ (when s) _ _ S1 Q) as S4.
    simpl in S4. rewrite ER in S4.
    assert (EW : forall q, last (macro h s) q =
      at_ (receive (who s) (delta D {| me := who s; time_ns := when s |} (what s) (ready h s))
            (say (delta D {| me := who s; time_ns := when s |} (what s) (ready h s)) w')) q).
    { intros q. simpl. unfold update. rewrite ER. destruct (eqb q (who s)) eqn:E; auto. now rewrite S3, E, EL. }
    constructor; auto.
    - simpl. now rewrite S2, EP.
    - intros p N [].
    - intros p. rewrite EW. split; [apply (state_wf _ S4) | apply (state_filed _ S4)].
    - intros p. rewrite EW. simpl. rewrite join_bottom_right; auto. apply (state_wf _ S4).
  Qed.

  (** [CHECK-7] Every history is a schedule with the same pool and the same states. *)
  Theorem history_is_schedule l : legal beginning l ->
    Forall plain (unfuse l) /\ messages (run D (unfuse l)) = pool (history l) /\
    forall p, at_ (run D (unfuse l)) p = last (history l) p.
  Proof.
    intros L. split; [apply plain_unfuse |]. pose proof (unfused l _ _ related_start L) as R.
    split; [apply R |]. intros p. unfold run. rewrite (same_state _ _ _ R). simpl.
    apply join_bottom_right. apply (last_proper _ _ _ R).
  Qed.

  (** [CHECK-7] With one more replica that only receives, its states are those of all delivered subsets. *)
  Theorem observer es o S : at_ (run D es) o = bottom -> incl S (messages (run D es)) ->
    at_ (run D (es ++ deliveries o S)) o = joins S.
  Proof.
    intros B I. unfold run. rewrite fold_left_app.
    destruct (delivered S _ o (run_sound D es) I) as (_ & _ & E). fold (run D es). rewrite E, eqb_refl, B.
    apply join_bottom. apply (proper_joins (said (run D es))). apply Forall_forall. intros M J.
    apply messages_proper. auto.
  Qed.

  (** [CHECK-4] Diamonds: on every reachable state deliveries commute, and a repeated one changes nothing. What
      the checker tries in each state is so in all. *)
  Theorem diamond es p M N : In M (messages (run D es)) -> In N (messages (run D es)) ->
    at_ (run D es) p ⊔ M ⊔ N = at_ (run D es) p ⊔ N ⊔ M /\
    at_ (run D es) p ⊔ M ⊔ M = at_ (run D es) p ⊔ M.
  Proof.
    intros IM IN. apply messages_proper in IM, IN. pose proof (states_proper D es p) as P.
    pose proof (proper_agree _ (dots_unique D es)) as A. split.
    - rewrite !join_assoc by auto. f_equal. apply join_comm.
    - rewrite join_assoc by auto. f_equal. apply join_idem, IM.
  Qed.
End Reduction.
