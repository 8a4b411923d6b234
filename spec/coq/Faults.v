(** * Faults of states (wellformed.md)

    What [state_fault] of Conditions.v finds: nothing in exactly the states that satisfy WF-1 to WF-6, and else
    a fault that is there. *)

From DSR Require Export Refinement Conditions.

(** ** The conditions of one record by itself *)

Definition names_fit (x : record) : bool :=
  match x with
  | Vertex t n _ _ => name_fits t && name_fits n
  | Edge _ _ l _ => name_fits l
  | Write _ n _ _ _ => name_fits n
  end.
Definition payload_fits (x : record) : bool := match x with Write _ _ v _ _ => value_fits v | _ => true end.
Definition no_other_nan (x : record) : bool := match x with Write _ _ v _ _ => nans_canonical v | _ => true end.
Definition stamp_fits (x : record) : Prop := (1 <= stamp_of x <= stamp_max)%N.

(** [WF-4] [WF-5] [WF-6] *)
Record record_fits (x : record) : Prop := {
  fits_ends : edge_ends x;
  fits_names : names_fit x = true;
  fits_payload : payload_fits x = true;
  fits_stamp : stamp_fits x;
  fits_nans : no_other_nan x = true
}.
(** [WF-5] [LIMIT-6] *)
Definition sequences_fit (X : State) : Prop := forall d, seen X d = true -> (sequence d <= sequence_max)%N.

(** What each fault says is not so. *)
Definition broken (X : State) (f : fault) : Prop :=
  match f with
  | Sequence_ => exists d, seen X d = true /\ (sequence_max < sequence d)%N
  | HeldUnseen => exists d, holds X d = true /\ seen X d = false
  | NotClosed => exists d x b, get X d = Some x /\ In b (anchors x) /\ is_dead X b = true
  | NoSuchAnchor => exists d x b, get X d = Some x /\ In b (anchors x) /\ sequence b = 0%N /\ b <> ROOT
  | WrongAnchor => exists d x b y, get X d = Some x /\ In b (anchors x) /\ get X b = Some y /\ may_anchor x y = false
  | FaultSelfLoop => exists d f l s, get X d = Some (Edge f f l s)
  | FaultIntoRoot => exists d f s, get X d = Some (Edge f ROOT RT s)
  | FaultNameLength => exists d x, get X d = Some x /\ names_fit x = false
  | FaultValueSize => exists d x, get X d = Some x /\ payload_fits x = false
  | Stamp_ => exists d x, get X d = Some x /\ ~ stamp_fits x
  | Nan => exists d x, get X d = Some x /\ no_other_nan x = false
  end.

Lemma first_fault_none {A} (f : A -> option fault) l : first_fault f l = None <-> forall x, In x l -> f x = None.
Proof.
  unfold first_fault. induction l as [| a l IH]; simpl; [easy |]. destruct (f a) eqn:F.
  - split; [easy |]. intros N. rewrite <- F. auto.
  - rewrite IH. split; [intros N x [<- | I]; auto | auto].
Qed.

Lemma first_fault_some {A} (f : A -> option fault) l why : first_fault f l = Some why ->
  exists x, In x l /\ f x = Some why.
Proof.
  unfold first_fault. induction l as [| a l IH]; simpl; [easy |]. destruct (f a) eqn:F.
  - intros [= <-]. exists a. auto.
  - intros N. destruct (IH N) as (x & I & E). exists x. auto.
Qed.

Lemma sound_or_some b why w : sound_or b why = Some w -> b = false /\ w = why.
Proof. destruct b; [easy |]. now intros [= <-]. Qed.

Lemma then_some (a b : option fault) w : (a then_ b) = Some w -> a = Some w \/ a = None /\ b = Some w.
Proof. destruct a; auto. Qed.

Lemma then_none (a b : option fault) : (a then_ b) = None <-> a = None /\ b = None.
Proof. destruct a; split; intuition congruence. Qed.

Lemma sound_or_none b why : sound_or b why = None <-> b = true.
Proof. now destruct b. Qed.

Section Faults.
  Context (S : Exec) (X : State) (R : represents S X).

  Let sequences := forallb (fun e : Replica * list run_ => forallb (fun i => (snd i <=? sequence_max)%N) (snd e)) (entries (form S)).

  Lemma held_is d x : In (d, x) (entries (held S)) <-> get X d = Some x.
  Proof. rewrite (proj1 R). apply records_get. Qed.

  Lemma run_end b rs i : compact_from b rs -> In i rs -> in_runs rs (snd i) = true.
  Proof.
    revert b. induction rs as [| [f l] rs IH]; intros b; [easy |]. intros (_ & L & C) [<- | I]; apply in_runs_cons.
    - left. simpl. lia.
    - right. eauto.
  Qed.

  Lemma sequences_iff : sequences = true <-> sequences_fit X.
  Proof.
    destruct R as [_ [C E]]. unfold sequences. rewrite forallb_forall. split.
    - intros F d I. unfold seen in I. rewrite <- E in I. unfold covers, runs_of in I.
      destruct (find (form S) (replica d)) as [rs |] eqn:G; [| easy]. apply find_in in G. apply F in G. simpl in G.
      rewrite forallb_forall in G. apply existsb_exists in I as ([f l] & J & I). apply within_iff in I.
      apply G in J. apply N.leb_le in J. simpl in J. lia.
    - intros F [p rs] I. apply forallb_forall. intros i J. apply find_in in I. pose proof (C _ _ I) as [_ K].
      apply N.leb_le. simpl in J. apply (F (dot_of p (snd i))). unfold seen. rewrite <- E. unfold covers, runs_of. simpl.
      rewrite I. eapply run_end; eauto.
  Qed.

  Lemma sequences_not : sequences = false -> exists d, seen X d = true /\ (sequence_max < sequence d)%N.
  Proof.
    intros F. destruct (existsb (fun d => (sequence_max <? sequence d)%N) (elements (context X))) eqn:B.
    - apply existsb_exists in B as (d & I & L). exists d. split; [now apply mem_elements | now apply N.ltb_lt].
    - exfalso. rewrite <- not_true_iff_false in F, B. apply F, sequences_iff. intros d I.
      apply N.nlt_ge. intros L. apply B, existsb_exists. exists d. split; [now apply mem_elements | now apply N.ltb_lt].
  Qed.

  (** A fault that is named is there. [WF-1] – [WF-6] *)
  Theorem fault_is_there why : state_fault S = Some why -> broken X why.
  Proof.
    intros [F | [_ F]]%then_some.
    - apply sound_or_some in F as [F ->]. now apply sequences_not.
    - apply first_fault_some in F as ([d x] & I & F). cbn [fst snd] in F. apply held_is in I.
      apply then_some in F as [F | [_ F]].
      { apply sound_or_some in F as [F ->]. rewrite (x_seen_is _ _ d R) in F. exists d. split; auto.
        unfold holds. now rewrite I. }
      apply then_some in F as [F | [_ F]].
      { apply sound_or_some in F as [F ->]. exists d, x. split; auto. intros [A B].
        apply N.leb_le in A, B. now rewrite A, B in F. }
      apply then_some in F as [F | [_ F]].
      { apply first_fault_some in F as (b & J & F). unfold anchor_fault in F.
        destruct (is_root b) eqn:Rt; [easy |]. apply eqb_neq in Rt.
        apply then_some in F as [F | [_ F]].
        { apply sound_or_some in F as [F ->]. apply negb_false_iff, N.eqb_eq in F. exists d, x, b. auto. }
        apply then_some in F as [F | [_ F]]; apply sound_or_some in F as [F ->].
        - apply negb_false_iff in F. rewrite (x_dead_is _ _ b R) in F. exists d, x, b. auto.
        - rewrite (x_get_is _ _ b R) in F. destruct (get X b) as [y |] eqn:G; [| easy]. exists d, x, b, y. auto. }
      destruct x as [t n e s | f t l s | t n v z s].
      + apply sound_or_some in F as [F ->]. exists d. eexists. split; [exact I | exact F].
      + apply then_some in F as [F | [_ F]].
        { apply sound_or_some in F as [F ->]. apply negb_false_iff, eqb_eq in F. subst t. exists d, f, l, s. exact I. }
        apply then_some in F as [F | [_ F]]; apply sound_or_some in F as [F ->].
        * apply negb_false_iff, andb_prop in F as [F G]. apply eqb_eq in F, G. subst. exists d, f, s. exact I.
        * exists d. eexists. split; [exact I | exact F].
      + apply then_some in F as [F | [_ F]].
        { apply sound_or_some in F as [F ->]. exists d. eexists. split; [exact I | exact F]. }
        apply then_some in F as [F | [_ F]]; apply sound_or_some in F as [F ->];
          exists d; eexists; (split; [exact I | exact F]).
  Qed.

  (** No fault is found exactly where WF-1 to WF-6 hold. *)
  Theorem no_fault_iff : state_fault S = None <->
    wf X /\ right_anchors X /\ sequences_fit X /\ each_record record_fits X.
  Proof.
    split.
    - intros F. apply then_none in F as [Q F]. apply sound_or_none, sequences_iff in Q.
      rewrite first_fault_none in F.
      assert (G : forall d x, get X d = Some x -> record_fault S d x = None).
      { intros d x I. apply held_is in I. now apply F in I. }
      clear F. unfold record_fault in G.
      assert (G1 : forall d x, get X d = Some x -> seen X d = true).
      { intros d x I. apply G, then_none in I as [I _]. now rewrite sound_or_none, (x_seen_is _ _ d R) in I. }
      assert (NR : get X ROOT = None).
      { destruct (get X ROOT) as [x |] eqn:I; auto. apply G1 in I. now apply (represents_events _ _ R) in I. }
      assert (A : forall d x b, get X d = Some x -> In b (anchors x) -> b <> ROOT ->
        sequence b <> 0%N /\ is_dead X b = false /\ forall y, get X b = Some y -> may_anchor x y = true).
      { intros d x b I J N. apply G in I. rewrite !then_none in I. destruct I as (_ & _ & I & _).
        rewrite first_fault_none in I. specialize (I _ J). unfold anchor_fault in I.
        apply eqb_neq in N. unfold is_root in I. rewrite N, !then_none, !sound_or_none, !negb_true_iff in I.
        rewrite (x_dead_is _ _ b R), (x_get_is _ _ b R), N.eqb_neq in I. destruct I as (I1 & I2 & I3).
        repeat split; auto. intros y H. now rewrite H in I3. }
      split; [split; [| split] | split; [| split]]; auto.
      + now apply (represents_events S).
      + intros d H. unfold holds in H. destruct (get X d) eqn:I; [eauto | easy].
      + intros d x b I J. destruct (eq_dec b ROOT) as [-> | N]; [| now apply (A d x b)].
        unfold is_dead. apply andb_false_iff. right. apply not_true_iff_false. intros Sn.
        now apply (represents_events _ _ R) in Sn.
      + intros d x b I J. split.
        * intros Z. destruct (eq_dec b ROOT) as [-> | N]; auto. now destruct (A d x b I J N).
        * intros y H. destruct (eq_dec b ROOT) as [-> | N]; [congruence |].
          destruct (A d x b I J N) as (_ & _ & M). auto.
      + intros d x I. apply G in I. rewrite !then_none, !sound_or_none, andb_true_iff, !N.leb_le in I.
        destruct I as (_ & T & _ & I). destruct x as [t n e s | f t l s | t n v z s];
          rewrite ?then_none, ?sound_or_none in I; split; try easy; try apply I; auto.
        simpl. destruct I as (I1 & I2 & I3). apply negb_true_iff, eqb_neq in I1. split; auto.
        intros -> ->. discriminate.
    - intros ((E & Hs & C) & Ra & Q & Rf). apply then_none. split; [now apply sound_or_none, sequences_iff |].
      apply first_fault_none. intros [d x] I. apply held_is in I. cbn [fst snd]. unfold record_fault.
      rewrite !then_none, !sound_or_none, (x_seen_is _ _ d R).
      destruct (Rf _ _ I) as [F1 F2 F3 F4 F5]. repeat split.
      + apply Hs. unfold holds. now rewrite I.
      + apply andb_true_iff. rewrite !N.leb_le. exact F4.
      + apply first_fault_none. intros b J. unfold anchor_fault. destruct (is_root b) eqn:Rt; auto.
        rewrite !then_none, !sound_or_none, !negb_true_iff, (x_dead_is _ _ b R), (x_get_is _ _ b R), N.eqb_neq.
        destruct (Ra _ _ _ I J) as [Z M]. repeat split; [| now apply (C d x) |].
        * intros Z0. apply Z in Z0. apply eqb_neq in Rt. contradiction.
        * destruct (get X b); auto.
      + destruct x as [t n e s | f t l s | t n v z s]; rewrite ?then_none, ?sound_or_none; auto.
        simpl in F1. destruct F1 as [N1 N2]. repeat split; auto.
        * now apply negb_true_iff, eqb_neq.
        * apply negb_true_iff, not_true_iff_false. rewrite andb_true_iff. unfold is_RT, is_root. rewrite !eqb_eq.
          intros [L T]. now apply N2 in L.
  Qed.
End Faults.
