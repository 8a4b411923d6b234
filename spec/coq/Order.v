(** * Total orders

    What a finite map needs of its keys, and JOIN-2 of records: a comparison that decides equality and is a
    strict total order. Records are ordered field by field, so the orders of pairs, lists and options are
    lexicographic. *)

From Coq Require Export NArith ZArith String List Bool Lia.
From Coq Require Import Ascii.
Export ListNotations.
#[global] Open Scope list_scope.
#[global] Open Scope bool_scope.

Class Ordered (A : Type) := {
  cmp : A -> A -> comparison;
  cmp_eq : forall x y, cmp x y = Eq <-> x = y;
  cmp_sym : forall x y, cmp y x = CompOpp (cmp x y);
  cmp_trans : forall x y z, cmp x y = Lt -> cmp y z = Lt -> cmp x z = Lt
}.

Section Ordered.
  Context {A : Type} `{Ordered A}.

  Lemma cmp_refl x : cmp x x = Eq.
  Proof. now apply cmp_eq. Qed.

  Lemma cmp_irrefl x : cmp x x <> Lt.
  Proof. now rewrite cmp_refl. Qed.

  Definition eqb (x y : A) : bool := match cmp x y with Eq => true | _ => false end.
  Definition ltb (x y : A) : bool := match cmp x y with Lt => true | _ => false end.

  Lemma eqb_eq x y : eqb x y = true <-> x = y.
  Proof. unfold eqb. rewrite <- cmp_eq. destruct (cmp x y); split; congruence. Qed.

  Lemma eqb_refl x : eqb x x = true.
  Proof. now apply eqb_eq. Qed.

  Lemma eqb_neq x y : eqb x y = false <-> x <> y.
  Proof. rewrite <- eqb_eq. now destruct (eqb x y). Qed.

  Lemma ltb_lt x y : ltb x y = true <-> cmp x y = Lt.
  Proof. unfold ltb. destruct (cmp x y); split; congruence. Qed.

  Lemma cmp_gt_lt x y : cmp x y = Gt <-> cmp y x = Lt.
  Proof. rewrite (cmp_sym x y). destruct (cmp x y); simpl; split; congruence. Qed.

  Definition eq_dec (x y : A) : {x = y} + {x <> y}.
  Proof. destruct (eqb x y) eqn:E; [left; now apply eqb_eq | right; now apply eqb_neq]. Defined.

  (** Membership in a list, decided. *)
  Definition member (x : A) (l : list A) : bool := existsb (eqb x) l.

  Lemma member_in x l : member x l = true <-> In x l.
  Proof.
    unfold member. rewrite existsb_exists. split.
    - intros (y & I & E). apply eqb_eq in E. now subst.
    - intros I. exists x. now rewrite eqb_refl.
  Qed.

  (** The greater of two. *)
  Definition greater (x y : A) : A := match cmp x y with Lt => y | _ => x end.

  Lemma greater_idem x : greater x x = x.
  Proof. unfold greater. now rewrite cmp_refl. Qed.

  Lemma greater_comm x y : greater x y = greater y x.
  Proof.
    unfold greater. rewrite (cmp_sym x y). destruct (cmp x y) eqn:E; simpl; auto.
    now apply cmp_eq in E.
  Qed.

  Lemma greater_assoc x y z : greater (greater x y) z = greater x (greater y z).
  Proof.
    unfold greater. destruct (cmp x y) eqn:XY; destruct (cmp y z) eqn:YZ;
      rewrite ?XY, ?YZ; try reflexivity; try (apply cmp_eq in XY; subst; now rewrite YZ);
      try (apply cmp_eq in YZ; subst; now rewrite XY).
    - now rewrite (cmp_trans _ _ _ XY YZ).
    - apply cmp_gt_lt in XY, YZ. pose proof (cmp_trans _ _ _ YZ XY) as T.
      apply cmp_gt_lt in T. now rewrite T.
  Qed.
End Ordered.

(** ** Instances *)

#[export, program] Instance ordered_N : Ordered N := { cmp := N.compare }.
Next Obligation. apply N.compare_eq_iff. Qed.
Next Obligation. apply N.compare_antisym. Qed.
Next Obligation. rewrite N.compare_lt_iff in *. now transitivity y. Qed.

#[export, program] Instance ordered_Z : Ordered Z := { cmp := Z.compare }.
Next Obligation. apply Z.compare_eq_iff. Qed.
Next Obligation. apply Z.compare_antisym. Qed.
Next Obligation. rewrite Z.compare_lt_iff in *. now transitivity y. Qed.

(** The order that an injection into an ordered type induces. *)
#[program] Definition ordered_by {A B} `{Ordered B} (f : A -> B)
    (injective : forall x y, f x = f y -> x = y) : Ordered A :=
  {| cmp x y := cmp (f x) (f y) |}.
Next Obligation. rewrite cmp_eq. split; [auto | now intros ->]. Qed.
Next Obligation. apply cmp_sym. Qed.
Next Obligation. eapply cmp_trans; eauto. Qed.

(** Pairs: first things first. *)
Definition then_cmp (c d : comparison) : comparison := match c with Eq => d | _ => c end.

#[export, program] Instance ordered_pair {A B} `{Ordered A} `{Ordered B} : Ordered (A * B) :=
  { cmp x y := then_cmp (cmp (fst x) (fst y)) (cmp (snd x) (snd y)) }.
Next Obligation.
  simpl. destruct (cmp a0 a) eqn:E; simpl.
  - apply cmp_eq in E. subst. rewrite cmp_eq. split; congruence.
  - split; [easy |]. intros [= -> ->]. now rewrite cmp_refl in E.
  - split; [easy |]. intros [= -> ->]. now rewrite cmp_refl in E.
Qed.
Next Obligation. simpl. rewrite (cmp_sym a0 a), (cmp_sym b0 b). now destruct (cmp a0 a). Qed.
Next Obligation.
  simpl in *. destruct (cmp a1 a0) eqn:E; destruct (cmp a0 a) eqn:F; simpl in *; try easy.
  - apply cmp_eq in E, F. subst. rewrite cmp_refl. simpl. eapply cmp_trans; eauto.
  - apply cmp_eq in E. subst. now rewrite F.
  - apply cmp_eq in F. subst. now rewrite E.
  - now rewrite (cmp_trans _ _ _ E F).
Qed.

(** None before some. *)
Definition cmp_option {A} `{Ordered A} (x y : option A) : comparison :=
  match x, y with
  | None, None => Eq
  | None, Some _ => Lt
  | Some _, None => Gt
  | Some a, Some b => cmp a b
  end.

#[export, program] Instance ordered_option {A} `{Ordered A} : Ordered (option A) := { cmp := cmp_option }.
Next Obligation.
  destruct x, y; simpl; try (split; congruence). rewrite cmp_eq. split; congruence.
Qed.
Next Obligation. destruct x, y; simpl; auto. apply cmp_sym. Qed.
Next Obligation. destruct x, y, z; simpl in *; try easy. eapply cmp_trans; eauto. Qed.

(** Item by item, the shorter first where one begins the other. *)
Fixpoint cmp_list {A} `{Ordered A} (x y : list A) : comparison :=
  match x, y with
  | [], [] => Eq
  | [], _ => Lt
  | _, [] => Gt
  | a :: x, b :: y => then_cmp (cmp a b) (cmp_list x y)
  end.

#[export, program] Instance ordered_list {A} `{Ordered A} : Ordered (list A) := { cmp := cmp_list }.
Next Obligation.
  revert y. induction x as [| a x IH]; intros [| b y]; simpl; try (split; congruence).
  destruct (cmp a b) eqn:E; simpl.
  - apply cmp_eq in E. subst. rewrite IH. split; congruence.
  - split; [easy |]. intros [= -> ->]. now rewrite cmp_refl in E.
  - split; [easy |]. intros [= -> ->]. now rewrite cmp_refl in E.
Qed.
Next Obligation.
  revert y. induction x as [| a x IH]; intros [| b y]; simpl; auto.
  rewrite (cmp_sym a b), IH. now destruct (cmp a b).
Qed.
Next Obligation.
  revert y z H0 H1. induction x as [| a x IH]; intros [| b y] [| c z] XY YZ; simpl in *; try easy.
  destruct (cmp a b) eqn:E; destruct (cmp b c) eqn:F; simpl in *; try easy.
  - apply cmp_eq in E, F. subst. rewrite cmp_refl. simpl. eapply IH; eauto.
  - apply cmp_eq in E. subst. now rewrite F.
  - apply cmp_eq in F. subst. now rewrite E.
  - now rewrite (cmp_trans _ _ _ E F).
Qed.

(** Strings by their bytes. *)
Definition bytes (s : string) : list N := map N_of_ascii (list_ascii_of_string s).

Lemma bytes_injective s t : bytes s = bytes t -> s = t.
Proof.
  unfold bytes. intros E.
  rewrite <- (string_of_list_ascii_of_string s), <- (string_of_list_ascii_of_string t). f_equal.
  apply (f_equal (map ascii_of_N)) in E. rewrite !map_map in E.
  rewrite !(map_ext _ (fun a => a) ascii_N_embedding), !map_id in E. exact E.
Qed.

#[export] Instance ordered_string : Ordered string := ordered_by bytes bytes_injective.
