(** * Finite maps in canonical form

    A finite map is its list of entries, ascending by key. The list's order is part of the type, so two maps
    that answer every look-up alike are *equal* ([fmap_ext]): no axiom of extensionality, and no equivalence
    relation beside equality, is needed anywhere in this development. The maps run: they are what an
    extracted program uses.

    Each operation is a [tabulate]: its keys, and what it has under each. *)

From DSR Require Export Order.
From Coq Require Import Eqdep_dec.

Section Map.
  Context {K : Type} `{Ordered K} {V : Type}.

  Fixpoint ascending (l : list (K * V)) : bool :=
    match l with
    | (k, _) :: ((k', _) :: _) as rest => ltb k k' && ascending rest
    | _ => true
    end.

  Record fmap := FMap { entries : list (K * V); canonical : ascending entries = true }.

  Lemma entries_injective m m' : entries m = entries m' -> m = m'.
  Proof.
    destruct m as [l p], m' as [l' p']; simpl. intros <-. f_equal.
    apply UIP_dec. decide equality.
  Qed.

  (** ** Look-up *)

  Fixpoint lookup (k : K) (l : list (K * V)) : option V :=
    match l with
    | [] => None
    | (k', v) :: rest => if eqb k k' then Some v else lookup k rest
    end.

  Definition find (m : fmap) (k : K) : option V := lookup k (entries m).
  Definition keys (m : fmap) : list K := map fst (entries m).
  Definition size (m : fmap) : nat := length (entries m).

  Lemma ascending_tail e l : ascending (e :: l) = true -> ascending l = true.
  Proof. destruct e, l as [| []]; simpl; auto. now intros ?%andb_prop. Qed.

  Lemma ascending_head k v l : ascending ((k, v) :: l) = true ->
    forall k' v', In (k', v') l -> cmp k k' = Lt.
  Proof.
    revert k v. induction l as [| [a b] l IH]; intros k v A k' v' I; [easy |].
    pose proof (ascending_tail _ _ A) as T. simpl in A. apply andb_prop in A as [L%ltb_lt _].
    destruct I as [[= -> ->] | I]; auto. eapply cmp_trans; eauto.
  Qed.

  Lemma lookup_in l k v : ascending l = true -> lookup k l = Some v <-> In (k, v) l.
  Proof.
    induction l as [| [a b] l IH]; intros A; simpl; [easy |].
    specialize (IH (ascending_tail _ _ A)). pose proof (ascending_head _ _ _ A) as Hd.
    destruct (eqb k a) eqn:E.
    - apply eqb_eq in E. subst. split; [intros [= ->]; auto |].
      intros [[= ->] | I]; auto. apply Hd in I. now apply cmp_irrefl in I.
    - apply eqb_neq in E. rewrite IH. split; [auto |]. intros [[= -> ->] | I]; easy.
  Qed.

  Lemma find_in m k v : find m k = Some v <-> In (k, v) (entries m).
  Proof. apply lookup_in, canonical. Qed.

  Lemma in_keys m k : In k (keys m) <-> find m k <> None.
  Proof.
    unfold keys. rewrite in_map_iff. split.
    - intros ([k' v] & E & I). simpl in E. subst. apply find_in in I. now rewrite I.
    - intros F. destruct (find m k) as [v |] eqn:E; [| easy]. exists (k, v). split; auto.
      now apply find_in.
  Qed.

  Lemma keys_nodup m : NoDup (keys m).
  Proof.
    destruct m as [l A]. unfold keys. simpl. induction l as [| [k v] l IH]; simpl; constructor.
    - rewrite in_map_iff. intros ([k' v'] & E & I). simpl in E. subst.
      apply (ascending_head _ _ _ A) in I. now apply cmp_irrefl in I.
    - eapply IH, ascending_tail, A.
  Qed.

  (** ** Equality is agreement of all look-ups *)

  Theorem fmap_ext m m' : (forall k, find m k = find m' k) -> m = m'.
  Proof.
    intros E. apply entries_injective.
    assert (S : forall k v, In (k, v) (entries m) <-> In (k, v) (entries m')).
    { intros. rewrite <- !find_in. now rewrite E. }
    clear E. destruct m as [l A], m' as [l' A']. simpl in *.
    revert l' A' S. induction l as [| [k v] l IH]; intros [| [k' v'] l'] A' S; auto.
    - exfalso. apply (S k' v'). now left.
    - exfalso. apply (S k v). now left.
    - assert (k = k' /\ v = v') as [<- <-].
      { pose proof (proj1 (S k v) (or_introl eq_refl)) as I.
        pose proof (proj2 (S k' v') (or_introl eq_refl)) as I'.
        destruct I as [[= -> ->] | I]; auto. destruct I' as [[= -> ->] | I']; auto.
        apply (ascending_head _ _ _ A') in I. apply (ascending_head _ _ _ A) in I'.
        pose proof (cmp_trans _ _ _ I I') as C. now apply cmp_irrefl in C. }
      f_equal. apply IH; eauto using ascending_tail.
      intros a b. specialize (S a b). simpl in S.
      split; intros I.
      + destruct (proj1 S (or_intror I)) as [[= -> ->] |]; auto.
        apply (ascending_head _ _ _ A) in I. now apply cmp_irrefl in I.
      + destruct (proj2 S (or_intror I)) as [[= -> ->] |]; auto.
        apply (ascending_head _ _ _ A') in I. now apply cmp_irrefl in I.
  Qed.

  (** ** Construction *)

  Fixpoint insert_entry (k : K) (v : V) (l : list (K * V)) : list (K * V) :=
    match l with
    | [] => [(k, v)]
    | (k', v') :: rest =>
        match cmp k k' with
        | Lt => (k, v) :: l
        | Eq => (k, v) :: rest
        | Gt => (k', v') :: insert_entry k v rest
        end
    end.

  Lemma lookup_insert k v l k' :
    lookup k' (insert_entry k v l) = if eqb k' k then Some v else lookup k' l.
  Proof.
    induction l as [| [a b] l IH]; simpl; auto.
    destruct (cmp k a) eqn:C; simpl; auto.
    - apply cmp_eq in C. subst. now destruct (eqb k' a).
    - rewrite IH. destruct (eqb k' a) eqn:E; auto. apply eqb_eq in E. subst.
      destruct (eqb a k) eqn:F; auto. apply eqb_eq in F. subst. now rewrite cmp_refl in C.
  Qed.

  Lemma ascending_insert k v l : ascending l = true -> ascending (insert_entry k v l) = true.
  Proof.
    induction l as [| [a b] l IH]; intros A; auto. simpl. destruct (cmp k a) eqn:C.
    - apply cmp_eq in C. subst. now destruct l as [| []].
    - change (ltb k a && ascending ((a, b) :: l) = true). rewrite A. now apply ltb_lt in C as ->.
    - specialize (IH (ascending_tail _ _ A)). apply cmp_gt_lt, ltb_lt in C.
      destruct l as [| [c d] l]; simpl in *; [now rewrite C |].
      apply andb_prop in A as [L A]. destruct (cmp k c) eqn:D; simpl in *.
      + apply cmp_eq in D. subst. now rewrite L.
      + rewrite C. now apply ltb_lt in D as ->.
      + now rewrite L.
  Qed.

  Definition empty : fmap := FMap [] eq_refl.
  Definition insert (k : K) (v : V) (m : fmap) : fmap :=
    FMap (insert_entry k v (entries m)) (ascending_insert _ _ _ (canonical m)).

  Lemma find_empty k : find empty k = None.
  Proof. reflexivity. Qed.

  Lemma find_insert k v m k' : find (insert k v m) k' = if eqb k' k then Some v else find m k'.
  Proof. apply lookup_insert. Qed.

  (** The map that has under each of the keys listed what the function says, if anything. *)
  Definition tabulate (f : K -> option V) (ks : list K) : fmap :=
    fold_right (fun k m => match f k with Some v => insert k v m | None => m end) empty ks.

  Theorem find_tabulate f ks k : find (tabulate f ks) k = if member k ks then f k else None.
  Proof.
    induction ks as [| a ks IH]; simpl; auto.
    assert (R : find (tabulate f (a :: ks)) k = if eqb k a then f k else find (tabulate f ks) k).
    { simpl. destruct (f a) as [v |] eqn:F.
      - rewrite find_insert. destruct (eqb k a) eqn:E; auto. apply eqb_eq in E. now subst.
      - destruct (eqb k a) eqn:E; auto. apply eqb_eq in E. subst. rewrite IH, F. now destruct (member a ks). }
    simpl in R. rewrite R, IH. now destruct (eqb k a).
  Qed.
End Map.

Arguments fmap K {_} V.

(** ** Finite sets: maps to nothing in particular *)

Section Set_.
  Context {K : Type} `{Ordered K}.

  Definition fset := fmap K unit.
  Definition mem (s : fset) (k : K) : bool := match find s k with Some _ => true | None => false end.
  Definition elements (s : fset) : list K := keys s.
  (** The listed elements that satisfy [p]. *)
  Definition collect (p : K -> bool) (ks : list K) : fset :=
    tabulate (fun k => if p k then Some tt else None) ks.
  Definition set_of (ks : list K) : fset := collect (fun _ => true) ks.
  Definition union (s t : fset) : fset := set_of (elements s ++ elements t).

  Theorem set_ext s t : (forall k, mem s k = mem t k) -> s = t.
  Proof.
    intros E. apply fmap_ext. intros k. specialize (E k). unfold mem in E.
    destruct (find s k) as [[] |], (find t k) as [[] |]; congruence.
  Qed.

  Lemma mem_elements s k : In k (elements s) <-> mem s k = true.
  Proof. unfold elements, mem. rewrite in_keys. destruct (find s k); split; congruence. Qed.

  Lemma mem_collect p ks k : mem (collect p ks) k = member k ks && p k.
  Proof.
    unfold mem, collect. rewrite find_tabulate. destruct (member k ks); simpl; auto. now destruct (p k).
  Qed.

  Lemma mem_set_of ks k : mem (set_of ks) k = member k ks.
  Proof. unfold set_of. rewrite mem_collect. apply andb_true_r. Qed.

  Lemma member_elements s k : member k (elements s) = mem s k.
  Proof. apply eq_true_iff_eq. rewrite member_in. apply mem_elements. Qed.

  Lemma member_app (k : K) l l' : member k (l ++ l') = member k l || member k l'.
  Proof. unfold member. now rewrite existsb_app. Qed.

  Lemma mem_union s t k : mem (union s t) k = mem s k || mem t k.
  Proof. unfold union. now rewrite mem_set_of, member_app, !member_elements. Qed.

  Lemma mem_empty k : mem empty k = false.
  Proof. reflexivity. Qed.
End Set_.

Arguments fset K {_}.
