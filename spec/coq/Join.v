(** * Join (join.md, JOIN-3 to JOIN-5) *)

From DSR Require Export Closure.

Definition join (X Y : State) : State := close (merge X Y).
Infix "⊔" := join (at level 50, left associativity).

(** ** [JOIN-3] Join keeps well-formedness *)

Theorem join_context X Y d : held_seen X -> held_seen Y -> seen (X ⊔ Y) d = seen X d || seen Y d.
Proof. intros. unfold join. rewrite close_context, merge_context; auto using held_seen_merge. Qed.

(** Nothing but what one side holds is held. *)
Theorem join_from X Y d x : get (X ⊔ Y) d = Some x -> get X d = Some x \/ get Y d = Some x.
Proof. intros G. apply merge_from. now apply close_from. Qed.

Theorem wf_join X Y : wf X -> wf Y -> wf (X ⊔ Y).
Proof.
  intros (EX & SX & CX) (EY & SY & CY). split; [| split].
  - intros d. rewrite join_context by auto. intros [S | S]%orb_prop; auto.
  - apply held_seen_close, held_seen_merge.
  - apply close_closed.
Qed.

(** [WF-4] to [WF-6] judge each record by itself, so join keeps them. *)
Theorem each_record_join P X Y : each_record P X -> each_record P Y -> each_record P (X ⊔ Y).
Proof. intros A B d x [G | G]%join_from; eauto. Qed.

(** ** [JOIN-3] Join is associative, commutative and idempotent, with the empty state as neutral element *)

Theorem join_comm X Y : X ⊔ Y = Y ⊔ X.
Proof. unfold join. now rewrite merge_comm. Qed.

Theorem join_idem X : wf X -> X ⊔ X = X.
Proof. intros (_ & S & C). unfold join. rewrite merge_idem by auto. now apply close_fixed. Qed.

Theorem join_bottom X : wf X -> bottom ⊔ X = X.
Proof. intros (_ & S & C). unfold join. rewrite merge_bottom by auto. now apply close_fixed. Qed.

Corollary join_bottom_right X : wf X -> X ⊔ bottom = X.
Proof. intros. rewrite join_comm. now apply join_bottom. Qed.

(** No dot was used twice: hence [agree]. Without it this is false, see [reuse_breaks_join]. *)
Theorem join_assoc X Y Z : agree X Y -> agree Y Z -> agree X Z -> (X ⊔ Y) ⊔ Z = X ⊔ (Y ⊔ Z).
Proof.
  intros XY YZ XZ. unfold join.
  rewrite close_merge by (apply agree_merge; auto).
  rewrite (merge_comm X (close _)), close_merge by (apply agree_merge; auto using agree_sym).
  now rewrite (merge_comm (merge Y Z)), merge_assoc.
Qed.

(** [WF-2] On a state that is not closed it is not idempotent, nor is the empty state neutral. *)
Theorem idempotent_iff_closed X : held_seen X -> (X ⊔ X = X <-> closed X) /\ (bottom ⊔ X = X <-> closed X).
Proof.
  intros S. unfold join. rewrite merge_idem, merge_bottom by auto.
  assert (E : close X = X <-> closed X).
  { split; [intros <-; apply close_closed | apply close_fixed]. }
  now split.
Qed.

(** ** [JOIN-4] The order of the semilattice *)

Definition below (X Y : State) : Prop := X ⊔ Y = Y.
Infix "⊑" := below (at level 70).

Lemma join_upper_left X Y : agree X Y -> X ≤ X ⊔ Y.
Proof. intros. apply (le_trans _ (merge X Y)); [now apply merge_upper_left | apply close_inflationary]. Qed.

Lemma join_upper_right X Y : agree X Y -> Y ≤ X ⊔ Y.
Proof. intros. rewrite join_comm. now apply join_upper_left, agree_sym. Qed.

(** The join is the least closed state above both: [close ∘ merge] is the least upper bound. *)
Theorem join_least X Y Z : closed Z -> X ≤ Z -> Y ≤ Z -> X ⊔ Y ≤ Z.
Proof. intros. apply close_least; auto using merge_least. Qed.

(** JOIN-4's order is the one of STATE-3, dot by dot. *)
Theorem below_iff_le X Y : wf Y -> agree X Y -> X ⊑ Y <-> X ≤ Y.
Proof.
  intros (_ & S & C) A. unfold below. split.
  - intros <-. now apply join_upper_left.
  - intros L. apply le_antisym; auto using join_upper_right.
    + apply held_seen_close, held_seen_merge.
    + apply join_least; auto using le_refl.
Qed.

Theorem bottom_below X : wf X -> bottom ⊑ X.
Proof. apply join_bottom. Qed.

(** [CLAIM-R1] What is dead stays dead through any join; no join makes it held or unseen again. *)
Theorem removal_is_final X Y d : held_seen X -> held_seen Y -> is_dead X d = true -> is_dead (X ⊔ Y) d = true.
Proof.
  intros SX SY D. apply close_drops. left. apply cond_dead. apply cond_dead in D.
  rewrite cond_merge, D. now destruct (cond Y d).
Qed.

(** ** [JOIN-5] A state is a function of the set of deltas joined *)

(** All that was ever filed: [U d x] if some replica filed [x] under [d]. That no dot was used twice means
    that [U] is a function; what replicas make holds only what was filed. *)
Section Filed.
  Context (U : Dot -> record -> Prop).
  Definition once : Prop := forall d x y, U d x -> U d y -> x = y.
  Definition filed (X : State) : Prop := forall d x, get X d = Some x -> U d x.
  (** A state that can occur: well-formed, and of filed records. *)
  Definition proper (X : State) : Prop := wf X /\ filed X.

  Context (unique : once).

  Lemma proper_agree X Y : proper X -> proper Y -> agree X Y.
  Proof. intros [_ A] [_ B] d x y G H. eauto. Qed.

  Lemma proper_bottom : proper bottom.
  Proof. split; [apply wf_bottom | intros d x; easy]. Qed.

  Lemma proper_join X Y : proper X -> proper Y -> proper (X ⊔ Y).
  Proof.
    intros [WX FX] [WY FY]. split; [now apply wf_join |]. intros d x [G | G]%join_from; auto.
  Qed.

  (** All deltas of a list joined, from nothing on. *)
  Definition joins (l : list State) : State := fold_right join bottom l.

  Lemma proper_joins l : Forall proper l -> proper (joins l).
  Proof. induction 1; simpl; auto using proper_bottom, proper_join. Qed.

  Lemma joins_upper l X : Forall proper l -> In X l -> X ≤ joins l.
  Proof.
    induction 1 as [| Y l P F IH]; simpl; [easy |]. pose proof (proper_joins _ F).
    intros [-> | I]; [now apply join_upper_left, proper_agree |].
    apply (le_trans _ (joins l)); auto. now apply join_upper_right, proper_agree.
  Qed.

  Lemma joins_least l Z : closed Z -> (forall X, In X l -> X ≤ Z) -> joins l ≤ Z.
  Proof.
    intros C. induction l as [| Y l IH]; simpl; intros L; [constructor |].
    apply join_least; auto.
  Qed.

  Lemma proper_le_antisym X Y : proper X -> proper Y -> X ≤ Y -> Y ≤ X -> X = Y.
  Proof. intros [(_ & S & _) _] [(_ & T & _) _]. now apply le_antisym. Qed.

  Lemma joins_incl l l' : Forall proper l' -> incl l l' -> joins l ≤ joins l'.
  Proof. intros P I. apply joins_least; [apply (proper_joins _ P) |]. auto using joins_upper. Qed.

  (** Order and repetition do not matter: lists with the same members have the same join. *)
  Theorem joins_set l l' : Forall proper l -> (forall X, In X l <-> In X l') -> joins l = joins l'.
  Proof.
    intros P E. assert (P' : Forall proper l').
    { rewrite Forall_forall in *. intros X I. apply P, E, I. }
    apply proper_le_antisym; auto using proper_joins; apply joins_incl; auto; intros X; apply E.
  Qed.

  (** Nor does grouping: deltas joined first and applied as one (MUT-0.4). *)
  Theorem joins_groups ls : Forall (Forall proper) ls -> joins (map joins ls) = joins (concat ls).
  Proof.
    intros P. assert (PG : Forall proper (map joins ls)).
    { rewrite Forall_map. revert P. apply Forall_impl. exact proper_joins. }
    assert (PC : Forall proper (concat ls)).
    { clear PG. induction P; simpl; auto. now apply Forall_app. }
    apply proper_le_antisym; auto using proper_joins.
    - apply joins_least; [apply (proper_joins _ PC) |].
      intros X (l & <- & I)%in_map_iff. apply joins_incl; auto. intros Y J. apply in_concat. eauto.
    - apply joins_least; [apply (proper_joins _ PG) |].
      intros X (l & I & J)%in_concat. apply (le_trans _ (joins l)).
      + apply joins_upper; auto. rewrite Forall_forall in P. auto.
      + apply joins_upper; auto. now apply in_map.
  Qed.

  (** Joining a delta again changes nothing. *)
  Lemma join_joins l X : Forall proper l -> proper X -> joins l ⊔ X = joins (X :: l).
  Proof. intros. simpl. apply join_comm. Qed.

  Lemma joins_app l l' : Forall proper l -> Forall proper l' -> joins (l ++ l') = joins l ⊔ joins l'.
  Proof.
    intros P P'. induction P as [| X l PX P IH]; simpl.
    - now rewrite join_bottom by apply (proper_joins _ P').
    - rewrite IH, join_assoc; auto using proper_agree, proper_joins.
  Qed.
End Filed.

(** [WF-3] is kept if no author anchored a record wrongly in all that was filed (NET-5). *)
Theorem right_anchors_filed (U : Dot -> record -> Prop) :
  (forall d x a, U d x -> In a (anchors x) ->
    (sequence a = 0%N -> a = ROOT) /\ forall y, U a y -> may_anchor x y = true) ->
  forall X, filed U X -> right_anchors X.
Proof. intros R X F d x a G I. destruct (R _ _ _ (F _ _ G) I). auto. Qed.

(** ** [CRASH-3] If a dot was used twice *)

(** A dot that two states hold with different records can be named. *)
Definition reused_dot (X Y : State) : option Dot :=
  option_map fst (List.find (fun e => match get Y (fst e) with
    | Some y => negb (eqb (snd e) y) | None => false end) (records X)).

Theorem reused_dot_none X Y : reused_dot X Y = None <-> agree X Y.
Proof.
  unfold reused_dot. split.
  - intros N d x y G H. destruct (List.find _ _) eqn:F; [easy |].
    apply records_get in G. apply (find_none _ _ F) in G. simpl in G. rewrite H in G.
    apply negb_false_iff in G. now apply eqb_eq.
  - intros A. destruct (List.find _ _) as [[d x] |] eqn:F; auto. apply find_some in F as [G E].
    apply records_get in G. simpl in E. destruct (get Y d) eqn:H; [| easy].
    rewrite (A _ _ _ G H), eqb_refl in E. discriminate.
Qed.

Theorem reused_dot_some X Y d : reused_dot X Y = Some d ->
  exists x y, get X d = Some x /\ get Y d = Some y /\ x <> y.
Proof.
  unfold reused_dot. destruct (List.find _ _) as [[e x] |] eqn:F; [| easy]. intros [= <-].
  apply find_some in F as [G E]. apply records_get in G. simpl in *.
  destruct (get Y e) as [y |] eqn:H; [| easy]. exists x, y. repeat split; auto.
  intros ->. now rewrite eqb_refl in E.
Qed.

(** r1.3 is used for an edge anchored to r1.1, and for a write on ROOT. X holds the edge, Y has seen r1.1 die,
    Z holds the write. All three are well-formed, and the order of delivery shows. *)
Module Reuse.
  Definition X := make (fun _ => Held (Edge (r 1 1) ROOT "in" 3)) [r 1 3].
  Definition Y := make (fun _ => Dead) [r 1 1].
  Definition Z := make (fun _ => Held (Write ROOT "a" {| value_type := 4; items := [1%Z] |} 0 3)) [r 1 3].
End Reuse.

Theorem reuse_breaks_join : exists X Y Z, wf X /\ wf Y /\ wf Z /\ (X ⊔ Y) ⊔ Z <> X ⊔ (Y ⊔ Z).
Proof.
  exists Reuse.X, Reuse.Y, Reuse.Z. repeat split; try now apply check_wf_iff.
  intros E. apply (f_equal (fun S => is_dead S (r 1 3))) in E. vm_compute in E. discriminate.
Qed.

(** ** [WF-3] Wrong anchors *)

(** Without NET-5 the join of two states can break WF-3, and WF-3 alone: r2.1 was written on r1.1 before its
    author knew that r1.1 is a write. *)
Theorem wrong_anchor_by_join : exists X Y, wf X /\ wf Y /\ agree X Y /\ right_anchors X /\ right_anchors Y /\
  wf (X ⊔ Y) /\ ~ right_anchors (X ⊔ Y).
Proof.
  set (w t := Held (Write t "a" {| value_type := 4; items := [1%Z] |} 0 1)).
  exists (make (fun _ => w (r 1 1)) [r 2 1]), (make (fun _ => w ROOT) [r 1 1]).
  split; [now apply check_wf_iff |]. split; [now apply check_wf_iff |].
  split; [now apply reused_dot_none |]. split; [now apply check_anchors_iff |].
  split; [now apply check_anchors_iff |]. split; [now apply check_wf_iff |].
  rewrite <- check_anchors_iff. vm_compute. discriminate.
Qed.
