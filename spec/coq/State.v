(** * State (state.md)

    A state is a store and a context (STATE-1). The context is a finite set of dots, which is what CTX-1 says
    it means; that the version vector with its cloud behaves as that set is proved in Context.v. *)

From DSR Require Export Identity.

(** ** Records *)

(** A type, a name, a label, or an attribute's name. *)
Definition Name := string.

(** A value: the number of its type, and its items as integers that are ordered as VALUE-3 orders them (the
    bytes of a text, the numbers of a vector, the one number of a scalar; of a float the integer that stands
    for it in IEEE 754's total order). Nothing in the laws looks into a value. *)
Record Value := { value_type : N; items : list Z }.

Inductive record :=
| Vertex (type name : Name) (external_id : option N) (stamp : N)
| Edge (from to : Dot) (label : Name) (stamp : N)
| Write (target : Dot) (name : Name) (value : Value) (time_ns : N) (stamp : N).

Arguments Vertex (type name)%string external_id stamp%N.
Arguments Edge from to label%string stamp%N.
Arguments Write target name%string value (time_ns stamp)%N.

Definition stamp_of (x : record) : N :=
  match x with Vertex _ _ _ s | Edge _ _ _ s | Write _ _ _ _ s => s end.

(** [STATE-2] The dots without which a record cannot be. *)
Definition anchors (x : record) : list Dot :=
  match x with
  | Vertex _ _ _ _ => []
  | Edge from to _ _ => [from; to]
  | Write target _ _ _ _ => [target]
  end.

(** The order of JOIN-2: vertex < edge < write, then field by field. *)
Definition value_fields (v : Value) : N * list Z := (value_type v, items v).
Lemma value_fields_injective v w : value_fields v = value_fields w -> v = w.
Proof. destruct v, w. unfold value_fields. simpl. congruence. Qed.
#[export] Instance ordered_value : Ordered Value := ordered_by value_fields value_fields_injective.

Definition vertex_fields (x : record) : option (Name * (Name * (option N * N))) :=
  match x with Vertex t n e s => Some (t, (n, (e, s))) | _ => None end.
Definition edge_fields (x : record) : option (Dot * (Dot * (Name * N))) :=
  match x with Edge f t l s => Some (f, (t, (l, s))) | _ => None end.
Definition write_fields (x : record) : option (Dot * (Name * (Value * (N * N)))) :=
  match x with Write d n v t s => Some (d, (n, (v, (t, s)))) | _ => None end.
(** No fields come before some, so the kinds are ordered as asked. *)
Definition record_fields (x : record) := (write_fields x, (edge_fields x, vertex_fields x)).
Lemma record_fields_injective x y : record_fields x = record_fields y -> x = y.
Proof. unfold record_fields. destruct x, y; simpl; congruence. Qed.
#[export] Instance ordered_record : Ordered record := ordered_by record_fields record_fields_injective.

(** ** States *)

Record State := { store : fmap Dot record; context : fset Dot }.

Definition get (X : State) (d : Dot) : option record := find (store X) d.
Definition seen (X : State) (d : Dot) : bool := mem (context X) d.
Definition holds (X : State) (d : Dot) : bool := match get X d with Some _ => true | None => false end.
Definition is_dead (X : State) (d : Dot) : bool := negb (holds X d) && seen X d.

(** The records held, with their dots, in the order of dots. *)
Definition records (X : State) : list (Dot * record) := entries (store X).

Lemma records_get X d x : In (d, x) (records X) <-> get X d = Some x.
Proof. symmetry. apply find_in. Qed.

(** The state that has seen nothing. *)
Definition bottom : State := {| store := empty; context := empty |}.

(** [STATE-3] Every dot is in exactly one of three conditions. *)
Inductive condition := Unseen | Held (x : record) | Dead.

Definition cond (X : State) (d : Dot) : condition :=
  match get X d with Some x => Held x | None => if seen X d then Dead else Unseen end.

(** Forwards: unseen < held < dead, and a record does not become another. *)
Inductive before : condition -> condition -> Prop :=
| before_unseen c : before Unseen c
| before_held x : before (Held x) (Held x)
| before_dead c : before c Dead.

(** The order of states: no dot is farther in X than in Y. *)
Definition le (X Y : State) : Prop := forall d, before (cond X d) (cond Y d).
Infix "≤" := le (at level 70).

(** A state from its parts: what the dots listed are, the others unseen. All operations are made so. *)
Definition held_in (c : condition) : option record := match c with Held x => Some x | _ => None end.
Definition seen_in (c : condition) : bool := match c with Unseen => false | _ => true end.
Definition make (f : Dot -> condition) (ds : list Dot) : State :=
  {| store := tabulate (fun d => held_in (f d)) ds; context := collect (fun d => seen_in (f d)) ds |}.

(** Every dot that is not unseen, some perhaps twice. *)
Definition domain (X : State) : list Dot := keys (store X) ++ elements (context X).

(** A dot that two states hold is held with one record by both: what ID-1 grants, if both were made by
    replicas that never used a dot twice. *)
Definition agree (X Y : State) : Prop := forall d x y, get X d = Some x -> get Y d = Some y -> x = y.

(** ** Facts *)

Lemma cond_held X d x : cond X d = Held x <-> get X d = Some x.
Proof. unfold cond. destruct (get X d); [split; congruence |]. destruct (seen X d); split; congruence. Qed.

Lemma cond_dead X d : cond X d = Dead <-> is_dead X d = true.
Proof.
  unfold cond, is_dead, holds. destruct (get X d); simpl; [split; congruence |].
  destruct (seen X d); split; congruence.
Qed.

Lemma domain_spec X d : member d (domain X) = true <-> cond X d <> Unseen.
Proof.
  unfold domain. rewrite member_in, in_app_iff, in_keys, mem_elements. fold (get X d) (seen X d).
  unfold cond. destruct (get X d), (seen X d); split; try easy; intuition congruence.
Qed.

Lemma domain_spec_not X d : member d (domain X) = false <-> cond X d = Unseen.
Proof.
  pose proof (domain_spec X d). destruct (member d (domain X)), (cond X d); intuition congruence.
Qed.

Lemma cond_make f ds d : cond (make f ds) d = if member d ds then f d else Unseen.
Proof.
  unfold cond, get, seen, make. simpl. rewrite find_tabulate, mem_collect.
  destruct (member d ds); simpl; auto. now destruct (f d).
Qed.

Lemma cond_bottom d : cond bottom d = Unseen.
Proof. reflexivity. Qed.

Lemma before_refl c : before c c.
Proof. destruct c; constructor. Qed.

Lemma before_trans a b c : before a b -> before b c -> before a c.
Proof. intros [] S; inversion S; subst; constructor. Qed.

Lemma before_antisym a b : before a b -> before b a -> a = b.
Proof. intros [] S; inversion S; subst; auto. Qed.

Lemma le_refl X : X ≤ X.
Proof. intros d. apply before_refl. Qed.

Lemma le_trans X Y Z : X ≤ Y -> Y ≤ Z -> X ≤ Z.
Proof. intros L M d. eapply before_trans; eauto. Qed.

(** [STATE-3] Dead is for ever: what is dead in X is dead in whatever comes after X. *)
Theorem dead_for_ever X Y d : X ≤ Y -> is_dead X d = true -> is_dead Y d = true.
Proof.
  intros L. rewrite <- !cond_dead. intros D. specialize (L d). rewrite D in L. now inversion L.
Qed.

(** [STATE-3] Exactly one of three, and it depends on store and context as said. *)
Theorem three_conditions X d :
  match cond X d with
  | Unseen => seen X d = false /\ get X d = None
  | Held x => get X d = Some x
  | Dead => seen X d = true /\ get X d = None
  end.
Proof. unfold cond. destruct (get X d); auto. now destruct (seen X d). Qed.

(** ** The order and equality, decided *)

Definition check_before (b c : condition) : bool :=
  match b, c with
  | Unseen, _ | _, Dead => true
  | Held x, Held y => eqb x y
  | _, _ => false
  end.

Definition check_le (X Y : State) : bool := forallb (fun d => check_before (cond X d) (cond Y d)) (domain X).

Theorem check_le_iff X Y : check_le X Y = true <-> X ≤ Y.
Proof.
  assert (B : forall b c, check_before b c = true <-> before b c).
  { intros b c. split.
    - destruct b, c; simpl; try easy; try constructor. intros <-%eqb_eq. constructor.
    - intros [d | x | d]; simpl; [easy | apply eqb_refl | now destruct d]. }
  unfold check_le. rewrite forallb_forall. split.
  - intros F d. destruct (member d (domain X)) eqn:M.
    + apply B, F. now apply member_in.
    + apply domain_spec_not in M. rewrite M. constructor.
  - intros L d _. apply B, L.
Qed.

Definition state_eqb (X Y : State) : bool :=
  eqb (entries (store X)) (entries (store Y)) && eqb (elements (context X)) (elements (context Y)).

Theorem state_eqb_eq X Y : state_eqb X Y = true <-> X = Y.
Proof.
  unfold state_eqb. rewrite andb_true_iff, !eqb_eq. split; [| now intros ->].
  intros [S C]. destruct X as [s c], Y as [t e]. simpl in *. f_equal.
  - now apply entries_injective.
  - apply set_ext. intros d. apply eq_true_iff_eq. now rewrite <- !mem_elements, C.
Qed.
