(** * Network and authors (network.md, identity.md)

    A run is any list of events. Nothing is asked of the network (NET-1 to NET-3): a message may be delivered
    to anybody at any time, in any order, any number of times, or never. Messages are deltas, groups of
    messages (MUT-0.4), whole states (STATE-5), and answers to digests, however late (SYNC-3).

    Every replica id that there may be is there from the start, with the empty state. A restart without its
    state is a new id (CRASH-2) of which nothing has been heard; a restart with its state is a new id that is
    sent the old one's state. What no event does is take state away from a replica that goes on: that is
    CRASH-1. No event lets an author use another's id, or file a record otherwise than by a mutation: NET-5. *)

From DSR Require Export Mutations Sync.

Inductive event :=
| Mutate (p : Replica) (time : N) (m : Mutation)  (* p mutates, and broadcasts the delta *)
| Deliver (p : Replica) (M : State)               (* a copy of a message arrives *)
| Group (M N : State)                             (* two messages are sent on as one *)
| Send (p : Replica)                              (* p sends its state *)
| Ask (p : Replica)                               (* p sends its digest *)
| Answer (q : Replica) (A : State).               (* q answers a digest, that of the state A *)

Record World := {
  messages : list State;           (* all that were ever sent *)
  asked : list State;              (* the states whose digests were *)
  at_ : Replica -> State;          (* each replica's state *)
  got : Replica -> list State      (* which messages each has joined, its own included; for proofs only *)
}.

Definition start : World :=
  {| messages := []; asked := []; at_ := fun _ => bottom; got := fun _ => [] |}.

Definition update {A} (f : Replica -> A) (p : Replica) (x : A) : Replica -> A :=
  fun q => if eqb q p then x else f q.
Definition sent (w : World) (M : State) : bool := existsb (state_eqb M) (messages w).

Section Runs.
  Context (D : Dictionary).

  Definition say (M : State) (w : World) : World :=
    {| messages := M :: messages w; asked := asked w; at_ := at_ w; got := got w |}.
  Definition receive (p : Replica) (M : State) (w : World) : World :=
    {| messages := messages w; asked := asked w;
       at_ := update (at_ w) p (at_ w p ⊔ M); got := update (got w) p (M :: got w p) |}.

  (** What cannot happen changes nothing. *)
  Definition step (w : World) (e : event) : World :=
    match e with
    | Mutate p t m =>
        if possible (at_ w p) m
        then let M := delta D {| me := p; time_ns := t |} m (at_ w p) in receive p M (say M w)
        else w
    | Deliver p M => if sent w M then receive p M w else w
    | Group M N => if sent w M && sent w N then say (M ⊔ N) w else w
    | Send p => say (at_ w p) w
    | Ask p => {| messages := messages w; asked := at_ w p :: asked w; at_ := at_ w; got := got w |}
    | Answer q A => if existsb (state_eqb A) (asked w) then say (delta_for (at_ w q) (digest A)) w else w
    end.
  Definition run (es : list event) : World := fold_left step es start.

  (** All that was ever filed. *)
  Definition said (w : World) (d : Dot) (x : record) : Prop :=
    exists M, In M (messages w) /\ get M d = Some x.

  Record sound_world (w : World) : Prop := {
    messages_wf : forall M, In M (messages w) -> wf M;
    asked_wf : forall A, In A (asked w) -> wf A;
    state_wf : forall p, wf (at_ w p);
    state_filed : forall p, filed (said w) (at_ w p);
    (* ID-1 *)
    said_once : once (said w);
    (* CRASH-1: whatever is known of a replica's events is known to the replica *)
    own_message : forall M d, In M (messages w) -> seen M d = true -> seen (at_ w (replica d)) d = true;
    own_state : forall p d, seen (at_ w p) d = true -> seen (at_ w (replica d)) d = true;
    (* and its own events it knows without gap *)
    own_gapless : forall p n k, seen (at_ w p) (dot_of p n) = true -> (0 < k <= n)%N ->
      seen (at_ w p) (dot_of p k) = true;
    (* NET-5: what is filed is anchored to what is filed, and of the right kind *)
    said_anchored : forall d x b, said w d x -> In b (anchors x) ->
      b = ROOT \/ exists y, said w b y /\ may_anchor x y = true;
    (* a state is the join of what was received *)
    got_sent : forall p, incl (got w p) (messages w);
    state_joins : forall p, at_ w p = joins (got w p)
  }.

  Lemma sent_in w M : sent w M = true -> In M (messages w).
  Proof. unfold sent. rewrite existsb_exists. intros (N & I & E). apply state_eqb_eq in E. now subst. Qed.

  Lemma update_case {A} (P : Replica -> A -> Prop) f p x :
    P p x -> (forall q, q <> p -> P q (f q)) -> forall q, P q (update f p x q).
  Proof.
    intros HP HF q. unfold update. destruct (eqb q p) eqn:E.
    - apply eqb_eq in E. now subst.
    - apply HF. now apply eqb_neq.
  Qed.

  Lemma start_sound : sound_world start.
  Proof.
    constructor; simpl; try easy; try (intros; apply wf_bottom).
    - intros d x y (M & [] & _).
    - intros d x b (M & [] & _).
  Qed.

  (** Sending on what says nothing new keeps all of this. *)
  Lemma say_sound M w : sound_world w -> wf M -> filed (said w) M ->
    (forall d, seen M d = true -> seen (at_ w (replica d)) d = true) -> sound_world (say M w).
  Proof.
    intros S WM FM OM.
    assert (E : forall d x, said (say M w) d x <-> said w d x).
    { intros d x. split; [| intros (N & I & G); exists N; split; [now right | auto]].
      intros (N & [<- | I] & G); [now apply FM | now exists N]. }
    destruct S. constructor; simpl; auto.
    - intros N [<- | I]; auto.
    - intros p d x G. apply E. now apply (state_filed0 p).
    - intros d x y. rewrite !E. apply said_once0.
    - intros N d [<- | I]; eauto.
    - intros d x b H I. apply E in H. destruct (said_anchored0 _ _ _ H I) as [| (y & K & A)]; auto.
      right. exists y. split; auto. now apply E.
    - intros p N I. right. now apply (got_sent0 p).
  Qed.

  Lemma receive_sound p M w : sound_world w -> In M (messages w) -> sound_world (receive p M w).
  Proof.
    intros S I. destruct S.
    assert (J : forall d, seen (at_ w p ⊔ M) d = seen (at_ w p) d || seen M d).
    { intros d. apply join_context; [apply state_wf0 | now apply messages_wf0]. }
    assert (O : forall q d, seen (at_ w q) d = true -> seen (update (at_ w) p (at_ w p ⊔ M) q) d = true).
    { intros q d. apply (update_case (fun q X => seen (at_ w q) d = true -> seen X d = true)); auto.
      intros E. now rewrite J, E. }
    assert (L : forall q d, seen (update (at_ w) p (at_ w p ⊔ M) q) d = true ->
      seen (at_ w q) d = true \/ seen M d = true).
    { intros q d. apply (update_case (fun q X => seen X d = true -> seen (at_ w q) d = true \/ seen M d = true)); auto.
      rewrite J. apply orb_prop. }
    constructor; simpl; auto.
    - intros q. apply (update_case (fun _ X => wf X)); auto using wf_join.
    - intros q. change (filed (said w) (update (at_ w) p (at_ w p ⊔ M) q)).
      apply (update_case (fun _ X => filed (said w) X)); auto.
      intros d x [G | G]%join_from; [now apply (state_filed0 p) | now exists M].
    - intros N d IN SN. apply O. eauto.
    - intros q d SQ. apply O. destruct (L _ _ SQ); eauto.
    - intros q n k SQ B. apply O. apply (own_gapless0 q n); auto.
      destruct (L _ _ SQ) as [| SM]; auto. exact (own_message0 _ _ I SM).
    - intros q. apply (update_case (fun _ l => incl l (messages w))); auto.
      intros N [<- | H]; auto. now apply (got_sent0 p).
    - intros q. unfold update. destruct (eqb q p) eqn:E; auto.
      simpl. rewrite <- state_joins0. apply join_comm.
  Qed.

  Lemma mutate_sound p t m w : sound_world w -> possible (at_ w p) m = true ->
    let M := delta D {| me := p; time_ns := t |} m (at_ w p) in sound_world (receive p M (say M w)).
  Proof.
    intros S Q M. set (a := {| me := p; time_ns := t |}) in M.
    pose proof (state_wf _ S p) as W. pose proof (plan_sound D _ a _ W Q) as P.
    assert (WM : wf M) by now apply wf_delta.
    assert (H : forall d x, get M d = Some x <-> In (d, x) (made (plan D (at_ w p) a m)))
      by (intros; now apply (delta_of_held (at_ w p))).
    assert (N : forall d x, get M d = Some x -> replica d = p /\ seen (at_ w p) d = false).
    { intros d x G. split.
      - assert (HD : holds M d = true) by (unfold holds; now rewrite G).
        now apply delta_dots in HD as [E _].
      - apply H, (in_map fst) in G. now apply P in G. }
    (* Nobody has seen the dots that are filed: their author would have (CRASH-1). *)
    assert (F : forall d x, get M d = Some x -> forall y, ~ said w d y).
    { intros d x G y (K & I & GK). destruct (N _ _ G) as [R U].
      assert (SK : seen K d = true).
      { apply (messages_wf _ S _ I). unfold holds. now rewrite GK. }
      apply (own_message _ S) in SK; auto. subst. congruence. }
    assert (O : forall d, seen M d = true ->
      replica d = p /\ seen M d = true \/ seen (at_ w (replica d)) d = true).
    { intros d SM. destruct (holds M d) eqn:HM.
      - left. split; auto. now apply delta_dots in HM as [E _].
      - right. apply (delta_of_context) in SM as [I | K].
        + exfalso. apply in_map_iff in I as ([e x] & <- & I). apply H in I. unfold holds in HM. simpl in HM.
          now rewrite I in HM.
        + apply P in K. apply W in K. now apply (own_state _ S) in K. }
    assert (J : forall d, seen (at_ w p ⊔ M) d = seen (at_ w p) d || seen M d).
    { intros d. apply join_context; [apply W | apply WM]. }
    assert (U : forall q d, seen (at_ w q) d = true -> seen (update (at_ w) p (at_ w p ⊔ M) q) d = true).
    { intros q d. apply (update_case (fun q X => seen (at_ w q) d = true -> seen X d = true)); auto.
      intros E. now rewrite J, E. }
    assert (OP : forall d, seen M d = true -> seen (update (at_ w) p (at_ w p ⊔ M) (replica d)) d = true).
    { intros d SM. destruct (O _ SM) as [[-> _] | SR]; auto. unfold update. rewrite eqb_refl, J, SM.
      apply orb_true_r. }
    assert (E : forall d x, said (receive p M (say M w)) d x <-> get M d = Some x \/ said w d x).
    { intros d x. split.
      - intros (K & [<- | I] & G); auto. right. now exists K.
      - intros [G | (K & I & G)]; [exists M; split; auto; now left | exists K; split; auto; now right]. }
    destruct S. constructor; simpl; auto.
    - intros K [<- | I]; auto.
    - intros q. apply (update_case (fun _ X => wf X)); auto using wf_join.
    - intros q. apply (update_case (fun _ X => filed (said (receive p M (say M w))) X)).
      + intros d x [G | G]%join_from; apply E; [right; now apply (state_filed0 p) | now left].
      + intros r _ d x G. apply E. right. now apply (state_filed0 r).
    - intros d x y. rewrite !E. intros [G | G] [K | K]; try congruence.
      + now apply (F _ _ G) in K.
      + now apply (F _ _ K) in G.
      + eapply said_once0; eauto.
    - intros K d [<- | I] SK; auto. apply U. eauto.
    - intros q d. apply (update_case (fun q X => seen X d = true ->
        seen (update (at_ w) p (at_ w p ⊔ M) (replica d)) d = true)).
      + rewrite J. intros [SP | SM]%orb_prop; auto. apply U. eauto.
      + intros r _ SR. apply U. eauto.
    - intros q n k. apply (update_case (fun q X => seen X (dot_of q n) = true -> (0 < k <= n)%N ->
        seen X (dot_of q k) = true)); eauto.
      (* The dots filed follow the greatest without gap. *)
      rewrite !J. intros SN B. destruct (seen (at_ w p) (dot_of p k)) eqn:SK; auto. simpl.
      set (g := greatest (at_ w p) p) in *.
      assert (G : (g < k)%N).
      { apply N.nle_gt. intros L. assert (SG : seen (at_ w p) (dot_of p g) = true) by (apply greatest_seen; lia).
        apply (own_gapless0 p g k) in SG; [congruence | lia]. }
      apply orb_prop in SN as [SN | SN].
      { apply (greatest_bounds _ p) in SN; auto. simpl in SN. fold g in SN. lia. }
      assert (HN : holds M (dot_of p n) = true).
      { destruct (holds M (dot_of p n)) eqn:HN; auto. apply delta_of_context in SN as [I | K].
        - apply in_map_iff in I as ([e x] & HE & I). simpl in HE. subst e. apply H in I. unfold holds in HN.
          now rewrite I in HN.
        - apply P in K. apply W in K. apply (greatest_bounds _ p) in K; auto. simpl in K. fold g in K. lia. }
      apply delta_dots in HN as [_ HN]; auto. cbn [sequence dot_of me] in HN. change (greatest (at_ w p) (me a)) with g in HN.
      apply WM. apply delta_dots; auto. split; auto.
      change (sequence (dot_of p k)) with k. change (greatest (at_ w p) (me a)) with g. lia.
    - intros d x b Hx I. apply E in Hx as [G | G].
      + apply H in G. destruct (made_anchored _ _ P _ _ _ G I) as [| (y & A & [K | K])]; auto;
          right; exists y; split; auto; apply E; [left; now apply H | right; now apply (state_filed0 p)].
      + destruct (said_anchored0 _ _ _ G I) as [| (y & K & A)]; auto. right. exists y. split; auto.
        apply E. now right.
    - intros q. apply (update_case (fun _ l => incl l (M :: messages w))).
      + intros K [<- | I]; [now left | right; now apply (got_sent0 p)].
      + intros r _ K I. right. now apply (got_sent0 r).
    - intros q. unfold update. destruct (eqb q p) eqn:EQ; auto. simpl. rewrite <- state_joins0. apply join_comm.
  Qed.

  Lemma step_sound w e : sound_world w -> sound_world (step w e).
  Proof.
    intros S. destruct e; simpl.
    - destruct (possible (at_ w p) m) eqn:Q; auto. now apply mutate_sound.
    - destruct (sent w M) eqn:E; auto. apply receive_sound; auto. now apply sent_in.
    - destruct (sent w M) eqn:E; auto. destruct (sent w N) eqn:F; auto. simpl.
      apply sent_in in E, F. apply say_sound; auto.
      + apply wf_join; now apply (messages_wf _ S).
      + intros d x [G | G]%join_from; eexists; eauto.
      + intros d. rewrite join_context by now apply (messages_wf _ S).
        intros [G | G]%orb_prop; [apply (own_message _ S M) | apply (own_message _ S N)]; auto.
    - apply say_sound; [auto | apply (state_wf _ S) | apply (state_filed _ S) | apply (own_state _ S)].
    - destruct S. constructor; simpl; auto. intros A [<- | I]; auto.
    - destruct (existsb (state_eqb A) (asked w)) eqn:E; auto. apply existsb_exists in E as (B & I & E).
      apply state_eqb_eq in E. subst B. pose proof (asked_wf _ S _ I) as WA.
      pose proof (state_wf _ S q) as WQ. apply say_sound; auto.
      + now apply wf_delta_for.
      + intros d x G. apply delta_for_from in G; [now apply (state_filed _ S) in G | apply WA].
      + intros d. rewrite delta_for_context by (apply WA || apply WQ). intros H. apply (own_state _ S q).
        unfold is_dead in H. destruct (seen (at_ w q) d); auto.
        rewrite !andb_false_r in H. discriminate.
  Qed.

  Lemma steps_sound es : forall w, sound_world w -> sound_world (fold_left step es w).
  Proof. induction es; simpl; auto using step_sound. Qed.

  Theorem run_sound es : sound_world (run es).
  Proof. apply steps_sound, start_sound. Qed.

  (** ** What follows *)

  (** [ID-1] Under the assumptions no dot is ever used twice: whatever is held under a dot, in states and in
      messages, by whomever, is one record. *)
  Theorem dots_unique es : once (said (run es)).
  Proof. apply run_sound. Qed.

  Theorem states_proper es p : proper (said (run es)) (at_ (run es) p).
  Proof. split; apply run_sound. Qed.

  Theorem messages_proper es M : In M (messages (run es)) -> proper (said (run es)) M.
  Proof. split; [now apply (run_sound es) | intros d x G; now exists M]. Qed.

  Corollary states_agree es p q : agree (at_ (run es) p) (at_ (run es) q).
  Proof. eapply proper_agree; eauto using dots_unique, states_proper. Qed.

  (** [WF-3] Honest authors' records are anchored to records of the right kind: in every state, *)
  Lemma filed_right_anchors es X : filed (said (run es)) X -> right_anchors X.
  Proof.
    pose proof (run_sound es) as S. apply right_anchors_filed.
    assert (Z : forall b y, said (run es) b y -> sequence b <> 0%N).
    { intros b y (M & IM & GM). destruct (messages_wf _ S _ IM) as (E & H & _).
      apply E, H. unfold holds. now rewrite GM. }
    intros d x b G I. destruct (said_anchored _ S _ _ _ G I) as [-> | (y & K & A)].
    - split; auto. intros z H. now apply Z in H.
    - split; [intros E; now apply Z in K |]. intros z H. now rewrite (said_once _ S _ _ _ H K).
  Qed.

  Theorem states_right_anchors es p : right_anchors (at_ (run es) p).
  Proof. apply (filed_right_anchors es), (state_filed _ (run_sound es)). Qed.

  (** and in every message: deltas, groups, answers. *)
  Theorem messages_right_anchors es M : In M (messages (run es)) -> right_anchors M.
  Proof. intros I. apply (filed_right_anchors es). now apply messages_proper. Qed.

  (** [CLOSE-3] So two passes close whatever is merged in a run. *)
  Theorem two_passes_in_runs es p M : In M (messages (run es)) ->
    at_ (run es) p ⊔ M = pass (pass (merge (at_ (run es) p) M)).
  Proof.
    intros I. apply two_passes; [apply held_seen_merge |]. apply (filed_right_anchors es).
    intros d x [G | G]%merge_from; [now apply (states_proper es p) | now apply (messages_proper es M)].
  Qed.

  (** [CLAIM-L3] [JOIN-5] Strong eventual consistency: who has received the same messages has the same state,
      whatever the order, repetition and grouping. *)
  Theorem strong_eventual_consistency es p q :
    (forall M, In M (got (run es) p) <-> In M (got (run es) q)) -> at_ (run es) p = at_ (run es) q.
  Proof.
    intros E. pose proof (run_sound es) as S. rewrite !(state_joins _ S).
    apply (joins_set (said (run es)) (dots_unique es)); auto. apply Forall_forall. intros M I.
    apply messages_proper. now apply (got_sent _ S) in I.
  Qed.

  (** [NET-6] [CLAIM-L3] Whatever was lost, and by whatever messages it came at last: who is beyond all that was
      ever sent has the join of it all. So all such replicas are equal. *)
  Theorem all_received es p : (forall M, In M (messages (run es)) -> M ≤ at_ (run es) p) ->
    at_ (run es) p = joins (messages (run es)).
  Proof.
    intros A. pose proof (run_sound es) as S.
    assert (P : Forall (proper (said (run es))) (messages (run es))) by
      (apply Forall_forall; intros M; apply messages_proper).
    pose proof (proper_joins _ _ P) as PJ. apply (proper_le_antisym (said (run es))); auto using states_proper.
    - rewrite (state_joins _ S p). apply (joins_incl _ (dots_unique es)); auto. apply (got_sent _ S).
    - apply joins_least; auto. apply (state_wf _ S).
  Qed.

  (** [SYNC-5] After loss: who joins the other's answer has the join of all that either received. *)
  Theorem resynchronised es p q :
    at_ (run es) p ⊔ delta_for (at_ (run es) q) (digest (at_ (run es) p)) =
    joins (got (run es) p ++ got (run es) q).
  Proof.
    pose proof (run_sound es) as S. rewrite delta_for_join; [| apply (state_wf _ S) | apply states_agree].
    rewrite (joins_app (said (run es)) (dots_unique es)), !(state_joins _ S); auto;
      apply Forall_forall; intros M I; apply messages_proper; now apply (got_sent _ S) in I.
  Qed.

  (** [SYNC-5] The same as events: p sends its digest, q answers, the answer arrives. *)
  Definition pull (w : World) (p q : Replica) : list event :=
    [Ask p; Answer q (at_ w p); Deliver p (delta_for (at_ w q) (digest (at_ w p)))].
  Definition pulled (w : World) (p q : Replica) : World := fold_left step (pull w p q) w.

  Lemma pulled_sound w p q : sound_world w -> sound_world (pulled w p q).
  Proof. intros. now apply steps_sound. Qed.

  Lemma pulled_state w p q : sound_world w -> forall o, at_ (pulled w p q) o =
    if eqb o p then at_ w p ⊔ at_ w q else at_ w o.
  Proof.
    intros S o. assert (R : forall X, state_eqb X X = true) by (intros; now apply state_eqb_eq).
    unfold pulled, pull, fold_left, step, sent. cbn [asked existsb]. rewrite R. cbn [orb].
    unfold say. cbn [messages existsb at_]. rewrite R. cbn [orb receive at_]. unfold update.
    destruct (eqb o p); auto. apply delta_for_join; [apply (state_wf _ S) |].
    apply (proper_agree (said w)); [apply S | |]; split; apply (state_wf _ S) || apply (state_filed _ S).
  Qed.

  (** A hub pulls from each of some replicas, and each of them pulls from it. *)
  Definition gather (h : Replica) (ps : list Replica) (w : World) : World :=
    fold_left (fun w p => pulled w h p) ps w.
  Definition spread (h : Replica) (ps : list Replica) (w : World) : World :=
    fold_left (fun w p => pulled w p h) ps w.

  Lemma pulled_upper w p q : sound_world w ->
    at_ w p ≤ at_ (pulled w p q) p /\ at_ w q ≤ at_ (pulled w p q) p.
  Proof.
    intros S. rewrite pulled_state, eqb_refl by auto.
    assert (A : agree (at_ w p) (at_ w q)) by
      (apply (proper_agree (said w)); [apply S | |]; split; apply (state_wf _ S) || apply (state_filed _ S)).
    auto using join_upper_left, join_upper_right.
  Qed.

  Lemma gathered h ps : forall w, sound_world w -> sound_world (gather h ps w) /\
    at_ w h ≤ at_ (gather h ps w) h /\
    (forall p, p <> h -> at_ (gather h ps w) p = at_ w p) /\
    forall p, In p ps -> at_ w p ≤ at_ (gather h ps w) h.
  Proof.
    induction ps as [| q ps IH]; intros w S; simpl.
    { split; [auto | split; [apply le_refl | split; [auto | intros p []]]]. }
    destruct (IH (pulled w h q) (pulled_sound _ _ _ S)) as (S' & L & O & A).
    destruct (pulled_upper w h q S) as [LH LQ]. split; auto. split; [eapply le_trans; eauto |].
    assert (E : forall p, p <> h -> at_ (pulled w h q) p = at_ w p).
    { intros p N. rewrite pulled_state by auto. apply eqb_neq in N. now rewrite N. }
    split; [intros p N; now rewrite O, E |]. intros p [-> | I]; [eapply le_trans; eauto |].
    destruct (eq_dec p h) as [-> | N]; [eapply le_trans; eauto |]. rewrite <- (E p N). auto.
  Qed.

  Lemma spread_equal h ps X : forall w, sound_world w -> at_ w h = X -> (forall p, In p ps -> at_ w p ≤ X) ->
    at_ (spread h ps w) h = X /\
    forall p, In p ps \/ at_ w p = X -> at_ (spread h ps w) p = X.
  Proof.
    induction ps as [| q ps IH]; intros w S EH L; simpl.
    { split; auto. now intros p [[] |]. }
    assert (EQ : at_ (pulled w q h) q = X).
    { rewrite pulled_state, eqb_refl, EH by auto. apply below_iff_le.
      - rewrite <- EH. apply (state_wf _ S).
      - apply le_agree. apply L. now left.
      - apply L. now left. }
    assert (E : forall p, at_ (pulled w q h) p = X \/ at_ (pulled w q h) p = at_ w p).
    { intros p. destruct (eq_dec p q) as [-> | N]; auto. right. rewrite pulled_state by auto.
      apply eqb_neq in N. now rewrite N. }
    destruct (IH (pulled w q h)) as [H A].
    - now apply pulled_sound.
    - destruct (E h); congruence.
    - intros p I. destruct (E p) as [-> | ->]; [apply le_refl | apply L; now right].
    - split; auto. intros p [[-> | I] | EP]; auto. apply A. right. destruct (E p); congruence.
  Qed.

  (** [SYNC-5] [CHECK-6] So from every moment of a run everybody is made equal by way of one, whatever was lost. *)
  Theorem hub_makes_equal es h ps :
    let w := spread h ps (gather h ps (run es)) in
    (exists es', w = run (es ++ es')) /\ forall p, In p ps -> at_ w p = at_ w h.
  Proof.
    intros w. split.
    - assert (F : forall (f : World -> Replica -> list event) l w0, exists es',
        fold_left (fun w p => fold_left step (f w p) w) l w0 = fold_left step es' w0).
      { intros f l. induction l as [| p l IH]; intros w0; simpl; [now exists [] |].
        destruct (IH (fold_left step (f w0 p) w0)) as (es' & ->). exists (f w0 p ++ es').
        now rewrite fold_left_app. }
      destruct (F (fun w p => pull w h p) ps (run es)) as (e1 & E1).
      destruct (F (fun w p => pull w p h) ps (gather h ps (run es))) as (e2 & E2).
      exists (e1 ++ e2). unfold w, spread, pulled. rewrite E2. unfold gather, pulled. rewrite E1.
      unfold run. now rewrite !fold_left_app.
    - destruct (gathered h ps (run es) (run_sound es)) as (S & L & O & A).
      destruct (spread_equal h ps _ _ S eq_refl) as [H B].
      + intros p I. destruct (eq_dec p h) as [-> | N]; [apply le_refl |]. rewrite (O p N). auto.
      + intros p I. unfold w. rewrite H. auto.
  Qed.

  (** [STATE-3] A state only moves forwards in a run. *)
  Theorem states_grow es es' p : at_ (run es) p ≤ at_ (run (es ++ es')) p.
  Proof.
    assert (G : forall w, sound_world w -> forall e, at_ w p ≤ at_ (step w e) p).
    { intros w S e. assert (L : forall q M, proper (said w) M \/ (exists t m, possible (at_ w q) m = true /\
        M = delta D {| me := q; time_ns := t |} m (at_ w q)) -> at_ w p ≤ update (at_ w) q (at_ w q ⊔ M) p).
      { intros q M H. apply (update_case (fun p X => at_ w p ≤ X)); auto using le_refl.
        apply join_upper_left. pose proof (state_wf _ S q) as W. destruct H as [H | (t & m & Q & ->)].
        - apply (proper_agree (said w)); auto; [apply S |]. split; [auto | apply (state_filed _ S)].
        - apply agree_delta_of; auto. now apply plan_sound. }
      destruct e; simpl; try apply le_refl.
      - destruct (possible (at_ w p0) m) eqn:Q; [| apply le_refl]. apply L. eauto.
      - destruct (sent w M) eqn:E; [| apply le_refl]. apply sent_in in E. apply L. left.
        split; [now apply (messages_wf _ S) |]. intros d x H. now exists M.
      - destruct (sent w M && sent w N); apply le_refl.
      - destruct (existsb (state_eqb A) (asked w)); apply le_refl. }
    unfold run. rewrite fold_left_app. fold (run es). pose proof (run_sound es) as S. revert S.
    generalize (run es). induction es' as [| e es' IH]; intros w S; simpl; [apply le_refl |].
    eapply le_trans; [apply (G w S e) | apply IH]. now apply step_sound.
  Qed.

  (** [CLAIM-R1] So what is removed somewhere stays removed there, *)
  Corollary stays_removed es es' p d :
    is_dead (at_ (run es) p) d = true -> is_dead (at_ (run (es ++ es')) p) d = true.
  Proof. apply dead_for_ever, states_grow. Qed.

  (** and is removed wherever a message that says so arrives. *)
  Corollary removed_by_message es p M d : In M (got (run es) p) -> is_dead M d = true ->
    is_dead (at_ (run es) p) d = true.
  Proof.
    pose proof (run_sound es) as S. intros I. apply dead_for_ever. rewrite (state_joins _ S p).
    apply (joins_upper (said (run es)) (dots_unique es)); auto. apply Forall_forall. intros N J.
    apply messages_proper. now apply (got_sent _ S) in J.
  Qed.

  (** [CLAIM-S1] [CTX-2] Who has received all that was ever sent has no gap in its context. *)
  Theorem no_gaps es p : (forall M, In M (messages (run es)) -> M ≤ at_ (run es) p) ->
    forall d k, seen (at_ (run es) p) d = true -> (0 < k <= sequence d)%N ->
      seen (at_ (run es) p) (dot_of (replica d) k) = true.
  Proof.
    intros A [q n] k SD B. simpl in B |- *. pose proof (run_sound es) as S.
    apply (own_state _ S) in SD. simpl in SD.
    assert (SK : seen (at_ (run es) q) (dot_of q k) = true) by (eapply (own_gapless _ S); eauto).
    (* q has it from a message, and p has all messages. *)
    assert (L : at_ (run es) q ≤ at_ (run es) p).
    { rewrite (state_joins _ S q). apply joins_least; [apply (state_wf _ S) |].
      intros M I. apply A. now apply (got_sent _ S) in I. }
    specialize (L (dot_of q k)).
    rewrite seen_cond in SK by apply (state_wf _ S). rewrite seen_cond by apply (state_wf _ S).
    destruct L; easy.
  Qed.
End Runs.

(** ** [CRASH-1] is needed: a counter that is lost breaks convergence *)

(** r2 adds a vertex; r1 claims an edge from it, under r1.1; r2 removes the vertex. Then r1 restarts *under its
    old id without its state*, and writes an attribute of ROOT, again under r1.1. Each delta is that of a
    possible mutation, and two readers who receive the same four deltas differ for ever. *)
Module Forgot.
  Definition D : Dictionary := {| functional := fun _ => false |}.
  Definition author (n : N) : Author := {| me := replica (r n 0); time_ns := 0 |}.
  Definition add := AddVertex "room"%string "v"%string None empty ROOT "in"%string true empty.
  Definition link := AddEdge {| key_from := r 2 1; key_to := ROOT; key_label := "near"%string |} empty.
  Definition remove := RemoveVertex (r 2 1).
  Definition write := UpdateAttributes ROOT (insert "a"%string (Some {| value_type := 4; items := [1%Z] |}) empty).
  Definition d0 := delta D (author 2) add bottom.
  Definition d1 := delta D (author 1) link d0.
  Definition d2 := delta D (author 2) remove d0.
  (** Made in the empty state. *)
  Definition d3 := delta D (author 1) write bottom.
End Forgot.

Import Forgot.

Theorem reused_dots_diverge :
  possible bottom add = true /\ possible d0 link = true /\ possible d0 remove = true /\
  possible bottom write = true /\
  ((bottom ⊔ d0 ⊔ d1) ⊔ d2) ⊔ d3 <> ((bottom ⊔ d0 ⊔ d1) ⊔ d3) ⊔ d2.
Proof.
  repeat split. intros E. apply (f_equal (fun X => is_dead X (r 1 1))) in E. vm_compute in E. discriminate.
Qed.

(** The dot is used twice, and that can be seen. *)
Theorem reuse_is_seen : reused_dot d1 d3 = Some (r 1 1).
Proof. reflexivity. Qed.

(** A fresh incarnation, which is what ID-3 asks for, uses other dots, and all orders agree. *)
Theorem fresh_incarnation_converges :
  let d3 := delta D {| me := next_incarnation (replica (r 1 0)); time_ns := 0 |} write bottom in
  ((bottom ⊔ d0 ⊔ d1) ⊔ d2) ⊔ d3 = ((bottom ⊔ d0 ⊔ d1) ⊔ d3) ⊔ d2.
Proof. now apply state_eqb_eq. Qed.

(** ** [SYNC-2] A run in which a context is no digest *)

(** r1 adds two vertices and an edge r1.5 between them, and moves it twice: to r1.6, to r1.7. r2 receives all
    deltas but that of the first move. Both have seen r1.1 to r1.7; r1 holds r1.7, r2 holds r1.5 as well. *)
Module Moved.
  Definition p1 : Replica := replica (r 1 0).
  Definition p2 : Replica := replica (r 2 0).
  Definition key (label : Name) : Key := {| key_from := r 1 1; key_to := r 1 3; key_label := label |}.
  Definition authored : list event :=
    [Mutate p1 0 (AddVertex "room"%string "a"%string None empty ROOT "in"%string true empty);
     Mutate p1 0 (AddVertex "room"%string "b"%string None empty ROOT "in"%string true empty);
     Mutate p1 0 (AddEdge (key "near"%string) empty);
     Mutate p1 0 (MoveEdge (key "near"%string) (key "at"%string) empty);
     Mutate p1 0 (MoveEdge (key "at"%string) (key "by"%string) empty)].
  Definition received : list State :=
    match messages (run D authored) with [m5; m4; m3; m2; m1] => [m1; m2; m3; m5] | _ => [] end.
  Definition w : World := run D (authored ++ map (Deliver p2) received).
End Moved.

Theorem equal_contexts_in_a_run :
  context (at_ Moved.w Moved.p1) = context (at_ Moved.w Moved.p2) /\
  holds (at_ Moved.w Moved.p1) (r 1 5) = false /\ holds (at_ Moved.w Moved.p2) (r 1 5) = true /\
  holds (at_ Moved.w Moved.p1) (r 1 7) = true /\ holds (at_ Moved.w Moved.p2) (r 1 7) = true.
Proof. split; [now apply entries_injective; vm_compute | repeat split; now vm_compute]. Qed.
