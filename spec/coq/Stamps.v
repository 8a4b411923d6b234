(** * Stamps and claims (stamps.md) *)

From DSR Require Export WellFormed.

(** [STAMP-2] The rank of a claim; the greatest of competing claims wins. *)
Definition Rank : Type := N * Dot.
Definition rank_of (d : Dot) (x : record) : Rank := (stamp_of x, d).
Definition rank (X : State) (d : Dot) : option Rank := option_map (rank_of d) (get X d).

(** [STAMP-1] The greatest stamp that a state holds, 0 if it holds none. *)
Definition greatest_stamp (X : State) : N :=
  fold_right (fun e m => N.max (stamp_of (snd e)) m) 0%N (records X).

Theorem greatest_stamp_bounds X d x : get X d = Some x -> (stamp_of x <= greatest_stamp X)%N.
Proof.
  rewrite <- records_get. unfold greatest_stamp. induction (records X) as [| e l IH]; simpl; [easy |].
  intros [-> | I]; [simpl; lia |]. specialize (IH I). lia.
Qed.

Theorem greatest_stamp_least X m : (forall d x, get X d = Some x -> stamp_of x <= m)%N ->
  (greatest_stamp X <= m)%N.
Proof.
  intros B. assert (A : forall d x, In (d, x) (records X) -> (stamp_of x <= m)%N).
  { intros d x I. apply records_get in I. eauto. }
  clear B. unfold greatest_stamp. induction (records X) as [| [d x] l IH]; simpl; [lia |].
  assert (stamp_of x <= m)%N by (apply (A d x); now left).
  enough (fold_right (fun e m => N.max (stamp_of (snd e)) m) 0 l <= m)%N by lia.
  apply IH. intros d' x' I. apply (A d' x'). now right.
Qed.

(** [STAMP-1] So a claim with the next stamp outranks every claim that its author holds. *)
Theorem next_stamp_outranks X d x new y : get X d = Some x ->
  stamp_of y = (1 + greatest_stamp X)%N -> cmp (rank_of d x) (rank_of new y) = Lt.
Proof.
  intros G S. apply greatest_stamp_bounds in G. cbn -[N.compare].
  assert (L : (stamp_of x ?= stamp_of y)%N = Lt) by (apply N.compare_lt_iff; lia). now rewrite L.
Qed.

(** [STAMP-2] Claims under different dots have different ranks, and one of any two is the greater. *)
Theorem ranks_total d x d' y : d <> d' ->
  cmp (rank_of d x) (rank_of d' y) = Lt \/ cmp (rank_of d' y) (rank_of d x) = Lt.
Proof.
  intros D. destruct (cmp (rank_of d x) (rank_of d' y)) eqn:E; auto.
  - apply cmp_eq in E. now injection E.
  - right. now apply cmp_gt_lt.
Qed.

(** [STAMP-4] Which claims compete: a register is the edge claims of one [register] below, or the writes of
    one target and name. A dictionary says which labels are functional (DICT-3). *)
Record Key := { key_from : Dot; key_to : Dot; key_label : Name }.
Record Dictionary := { functional : Name -> bool }.

Definition is_RT (label : Name) : bool := eqb label RT.

(** Whether an edge claim is on the register of a key. *)
Definition competes (D : Dictionary) (k : Key) (x : record) : bool :=
  match x with
  | Edge from to label _ =>
      eqb label (key_label k) &&
      if is_RT label then eqb to (key_to k)
      else eqb from (key_from k) && (eqb to (key_to k) || functional D label)
  | _ => false
  end.

(** Whether a record is a write of one attribute. *)
Definition writes (target : Dot) (name : Name) (x : record) : bool :=
  match x with Write t n _ _ _ => eqb t target && eqb n name | _ => false end.

Definition key_of (x : record) : option Key :=
  match x with
  | Edge from to label _ => Some {| key_from := from; key_to := to; key_label := label |}
  | _ => None
  end.

(** Competing is an equivalence of keys, so registers are disjoint. *)
Theorem competes_own D x k : key_of x = Some k -> competes D k x = true.
Proof.
  destruct x; simpl; try easy. intros [= <-]. simpl. rewrite !eqb_refl. now destruct (is_RT label).
Qed.

Theorem competes_sym D x y k l : key_of x = Some k -> key_of y = Some l ->
  competes D k y = competes D l x.
Proof.
  destruct x, y; simpl; try easy. intros [= <-] [= <-]. simpl. apply eq_true_iff_eq.
  destruct (eqb label0 label) eqn:E.
  - apply eqb_eq in E. subst. rewrite eqb_refl. simpl. destruct (is_RT label).
    + rewrite !eqb_eq. split; congruence.
    + rewrite !andb_true_iff, !orb_true_iff, !eqb_eq. intuition congruence.
  - split; [easy |]. rewrite andb_true_iff, eqb_eq. intros [-> _]. now rewrite eqb_refl in E.
Qed.

Theorem competes_trans D x y k l m : key_of x = Some k -> key_of y = Some l ->
  competes D l x = true -> competes D m y = true -> competes D m x = true.
Proof.
  destruct x, y; simpl; try easy. intros [= <-] [= <-]. simpl.
  rewrite !andb_true_iff, !eqb_eq. intros [-> A] [-> B]. split; auto.
  destruct (is_RT (key_label m)).
  - rewrite !eqb_eq in *. congruence.
  - rewrite !andb_true_iff, !orb_true_iff, !eqb_eq in *. intuition congruence.
Qed.
