(** * Merge (join.md, JOIN-1 and JOIN-2)

    Merge is a pointwise maximum, and so a semilattice on all states that satisfy WF-1, even where a dot was
    used twice. What reuse breaks is closure: see CRASH-3 in Join.v. *)

From DSR Require Export WellFormed.

(** [JOIN-1] The maximum in the chain unseen < held < dead. [JOIN-2] Of two records the greater. *)
Definition cmax (b c : condition) : condition :=
  match b, c with
  | Unseen, c | c, Unseen => c
  | Dead, _ | _, Dead => Dead
  | Held x, Held y => Held (greater x y)
  end.

Definition merge (X Y : State) : State :=
  make (fun d => cmax (cond X d) (cond Y d)) (domain X ++ domain Y).

Theorem cond_merge X Y d : cond (merge X Y) d = cmax (cond X d) (cond Y d).
Proof.
  unfold merge. rewrite cond_make, member_app.
  destruct (member d (domain X)) eqn:A; simpl; auto.
  destruct (member d (domain Y)) eqn:B; simpl; auto.
  apply domain_spec_not in A, B. now rewrite A, B.
Qed.

Lemma held_seen_merge X Y : held_seen (merge X Y).
Proof. apply held_seen_make. Qed.

(** [JOIN-1] In other words: a record is kept if both hold it, or if one holds it and the other has not seen
    its dot. *)
Theorem merge_keeps X Y d x : agree X Y ->
  get (merge X Y) d = Some x <->
  get X d = Some x /\ get Y d = Some x \/
  get X d = Some x /\ cond Y d = Unseen \/ cond X d = Unseen /\ get Y d = Some x.
Proof.
  intros A. specialize (A d). rewrite <- !cond_held, cond_merge in *.
  unfold cond in *. destruct (get X d), (get Y d), (seen X d), (seen Y d); simpl;
    try (rewrite (A _ _ eq_refl eq_refl), greater_idem); intuition congruence.
Qed.

(** Contexts unite (CTX-3). *)
Theorem merge_context X Y d : held_seen X -> held_seen Y ->
  seen (merge X Y) d = seen X d || seen Y d.
Proof.
  intros. rewrite !seen_cond, cond_merge; auto using held_seen_merge.
  now destruct (cond X d), (cond Y d).
Qed.

(** A record of the merge is a record of one side, whatever was used twice. *)
Theorem merge_from X Y d x : get (merge X Y) d = Some x -> get X d = Some x \/ get Y d = Some x.
Proof.
  rewrite <- !cond_held, cond_merge. destruct (cond X d), (cond Y d); simpl; auto; try easy.
  unfold greater. destruct (cmp x0 x1); auto.
Qed.

(** [JOIN-1] The same by store and context apart, as an implementation has them: this is [State::merge]. *)
Definition merge_parts (X Y : State) : State :=
  {| store := tabulate (fun d =>
       match get X d, get Y d with
       | Some x, Some y => Some (greater x y)
       | Some x, None => if seen Y d then None else Some x
       | None, Some y => if seen X d then None else Some y
       | None, None => None
       end) (keys (store X) ++ keys (store Y));
     context := union (context X) (context Y) |}.

Lemma get_merge_parts X Y d : get (merge_parts X Y) d =
  match get X d, get Y d with
  | Some x, Some y => Some (greater x y)
  | Some x, None => if seen Y d then None else Some x
  | None, Some y => if seen X d then None else Some y
  | None, None => None
  end.
Proof.
  unfold merge_parts. unfold get at 1. simpl. rewrite find_tabulate, member_app.
  assert (M : forall Z, member d (keys (store Z)) = match get Z d with Some _ => true | None => false end).
  { intros Z. apply eq_true_iff_eq. rewrite member_in, in_keys. unfold get.
    destruct (find (store Z) d); split; congruence. }
  rewrite !M. now destruct (get X d), (get Y d).
Qed.

Lemma seen_merge_parts X Y d : seen (merge_parts X Y) d = seen X d || seen Y d.
Proof. apply mem_union. Qed.

Theorem merge_is_merge_parts X Y : held_seen X -> held_seen Y -> merge_parts X Y = merge X Y.
Proof.
  intros HX HY.
  assert (S : held_seen (merge_parts X Y)).
  { intros d. specialize (HX d). specialize (HY d). unfold holds in *.
    rewrite get_merge_parts, seen_merge_parts.
    destruct (get X d), (get Y d), (seen X d), (seen Y d); simpl; auto. }
  apply state_ext; auto using held_seen_merge. intros d. specialize (HX d). specialize (HY d).
  rewrite cond_merge. unfold cond, holds in *. rewrite get_merge_parts, seen_merge_parts.
  destruct (get X d), (get Y d), (seen X d), (seen Y d); simpl; auto; now (discriminate HX || discriminate HY) || auto.
Qed.

(** [WF-1] It is associative on all states whatever, those that hold what they have not seen included. *)
Theorem merge_parts_assoc X Y Z : merge_parts (merge_parts X Y) Z = merge_parts X (merge_parts Y Z).
Proof.
  assert (S : context (merge_parts (merge_parts X Y) Z) = context (merge_parts X (merge_parts Y Z))).
  { apply set_ext. intros d. simpl. rewrite !mem_union. now rewrite orb_assoc. }
  assert (T : store (merge_parts (merge_parts X Y) Z) = store (merge_parts X (merge_parts Y Z))).
  { apply fmap_ext. intros d. fold (get (merge_parts (merge_parts X Y) Z) d).
    fold (get (merge_parts X (merge_parts Y Z)) d). rewrite !get_merge_parts, !seen_merge_parts.
    destruct (get X d), (get Y d), (get Z d), (seen X d), (seen Y d), (seen Z d); simpl; auto.
    all: now rewrite greater_assoc. }
  destruct (merge_parts (merge_parts X Y) Z), (merge_parts X (merge_parts Y Z)). simpl in *. congruence.
Qed.

(** ** Merge is a semilattice *)

Theorem merge_comm X Y : merge X Y = merge Y X.
Proof.
  apply state_ext; auto using held_seen_merge. intros d. rewrite !cond_merge.
  destruct (cond X d), (cond Y d); simpl; auto. now rewrite greater_comm.
Qed.

Theorem merge_assoc X Y Z : merge (merge X Y) Z = merge X (merge Y Z).
Proof.
  apply state_ext; auto using held_seen_merge. intros d. rewrite !cond_merge.
  destruct (cond X d), (cond Y d), (cond Z d); simpl; auto. now rewrite greater_assoc.
Qed.

Theorem merge_idem X : held_seen X -> merge X X = X.
Proof.
  intros. apply state_ext; auto using held_seen_merge. intros d. rewrite cond_merge.
  destruct (cond X d); simpl; auto. now rewrite greater_idem.
Qed.

Theorem merge_bottom X : held_seen X -> merge bottom X = X.
Proof. intros. apply state_ext; auto using held_seen_merge. intros d. now rewrite cond_merge. Qed.

(** ** Merge and the order of states *)

Lemma le_agree X Y : X ≤ Y -> agree X Y.
Proof.
  intros L d x y. rewrite <- !cond_held. intros A B. specialize (L d). rewrite A, B in L. now inversion L.
Qed.

Lemma agree_sym X Y : agree X Y -> agree Y X.
Proof. intros A d x y GX GY. symmetry. eauto. Qed.

Lemma agree_merge X Y Z : agree X Z -> agree Y Z -> agree (merge X Y) Z.
Proof. intros A B d x z [G | G]%merge_from H; eauto. Qed.

Lemma merge_upper_left X Y : agree X Y -> X ≤ merge X Y.
Proof.
  intros A d. specialize (A d). rewrite cond_merge. unfold cond in *.
  destruct (get X d), (get Y d), (seen X d), (seen Y d); simpl;
    try (rewrite (A _ _ eq_refl eq_refl), greater_idem); constructor.
Qed.

Lemma merge_upper_right X Y : agree X Y -> Y ≤ merge X Y.
Proof. intros. rewrite merge_comm. now apply merge_upper_left, agree_sym. Qed.

(** The merge is the least state above both. *)
Theorem merge_least X Y Z : X ≤ Z -> Y ≤ Z -> merge X Y ≤ Z.
Proof.
  intros A B d. specialize (A d). specialize (B d). rewrite cond_merge.
  destruct (cond X d), (cond Y d); simpl; auto.
  destruct (cond Z d); inversion A; inversion B; subst; try rewrite greater_idem; constructor.
Qed.

Theorem le_merge X Y : held_seen Y -> agree X Y -> X ≤ Y <-> merge X Y = Y.
Proof.
  intros H A. split.
  - intros L. apply le_antisym; auto using held_seen_merge, merge_least, le_refl.
    now apply merge_upper_right.
  - intros <-. now apply merge_upper_left.
Qed.
