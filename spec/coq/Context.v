(** * Causal context (context.md)

    State.v takes a context for what it means, a finite set of dots (CTX-1). Here is its form: for each replica
    the maximal runs of its sequences. A run that begins at 1 is the replica's entry in the version vector; the
    others are its cloud. The form behaves as the set and as nothing else, and equal sets have equal forms. *)

From DSR Require Export WellFormed.

(** ** Runs of one replica *)

Definition run_ := (N * N)%type.

Definition within (k : N) (i : run_) : bool := (fst i <=? k)%N && (k <=? snd i)%N.
Definition in_runs (rs : list run_) (k : N) : bool := existsb (within k) rs.

(** Compact: ascending, and each begins at least two above the one before; the first at [b] or above. *)
Fixpoint compact_from (b : N) (rs : list run_) : Prop :=
  match rs with
  | [] => True
  | (f, l) :: rest => (b <= f)%N /\ (f <= l)%N /\ compact_from (l + 2) rest
  end.

(** Adds a run, swallowing those that it overlaps or touches. *)
Fixpoint add_run (f l : N) (rs : list run_) : list run_ :=
  match rs with
  | [] => [(f, l)]
  | (f', l') :: rest =>
      if (l + 1 <? f')%N then (f, l) :: rs
      else if (l' + 1 <? f)%N then (f', l') :: add_run f l rest
      else add_run (N.min f f') (N.max l l') rest
  end.

Lemma within_iff k f l : within k (f, l) = true <-> (f <= k <= l)%N.
Proof. unfold within. simpl. rewrite andb_true_iff, !N.leb_le. reflexivity. Qed.

Lemma in_runs_cons f l rs k : in_runs ((f, l) :: rs) k = true <-> (f <= k <= l)%N \/ in_runs rs k = true.
Proof. unfold in_runs. simpl. rewrite orb_true_iff, within_iff. reflexivity. Qed.

Lemma compact_weaken b c rs : (b <= c)%N -> compact_from c rs -> compact_from b rs.
Proof. destruct rs as [| [f l] rs]; simpl; intuition lia. Qed.

Lemma compact_above b rs k : compact_from b rs -> in_runs rs k = true -> (b <= k)%N.
Proof.
  revert b. induction rs as [| [f l] rs IH]; intros b; [easy |].
  intros (B & L & C) [K | K]%in_runs_cons; [lia |]. apply (IH _ C) in K. lia.
Qed.

Theorem add_run_compact b f l rs : (b <= f <= l)%N -> compact_from b rs -> compact_from b (add_run f l rs).
Proof.
  revert b f l. induction rs as [| [f' l'] rs IH]; intros b f l B C; simpl; [repeat split; auto; lia |].
  destruct C as (B' & L' & C). destruct (N.ltb_spec (l + 1) f'); [simpl; repeat split; auto; lia |].
  destruct (N.ltb_spec (l' + 1) f).
  - simpl. repeat split; auto. apply IH; auto. lia.
  - apply IH; [lia |]. apply (compact_weaken b (l' + 2)); auto. lia.
Qed.

Theorem add_run_meaning b f l rs k : (f <= l)%N -> compact_from b rs ->
  in_runs (add_run f l rs) k = true <-> (f <= k <= l)%N \/ in_runs rs k = true.
Proof.
  revert b f l. induction rs as [| [f' l'] rs IH]; intros b f l L C; [apply in_runs_cons |].
  simpl add_run. destruct C as (B' & L' & C).
  destruct (N.ltb_spec (l + 1) f'); [apply in_runs_cons |].
  destruct (N.ltb_spec (l' + 1) f).
  - rewrite !in_runs_cons, (IH _ _ _ L C). tauto.
  - rewrite (IH (l' + 2)%N (N.min f f') (N.max l l') ltac:(lia) C), in_runs_cons. split; [| intuition lia].
    intros [K |]; [| auto]. destruct (N.le_gt_cases f k), (N.le_gt_cases k l); intuition lia.
Qed.

(** Equal sets have equal forms. *)
Theorem compact_unique rs : forall b rs', compact_from b rs -> compact_from b rs' ->
  (forall k, in_runs rs k = true <-> in_runs rs' k = true) -> rs = rs'.
Proof.
  induction rs as [| [f l] rs IH]; intros b [| [f' l'] rs'] C C' E; auto.
  - exfalso. destruct C' as (B & L & _). specialize (E f'). rewrite in_runs_cons in E.
    discriminate (proj2 E (or_introl (conj (N.le_refl _) L))).
  - exfalso. destruct C as (B & L & _). specialize (E f). rewrite in_runs_cons in E.
    discriminate (proj1 E (or_introl (conj (N.le_refl _) L))).
  - destruct C as (B & L & C), C' as (B' & L' & C').
    assert (A : forall k, in_runs rs k = true -> (l + 2 <= k)%N) by (intros; eapply compact_above; eauto).
    assert (A' : forall k, in_runs rs' k = true -> (l' + 2 <= k)%N) by (intros; eapply compact_above; eauto).
    assert (F : f = f').
    { pose proof (E f) as Ef. pose proof (E f') as Ef'. rewrite !in_runs_cons in Ef, Ef'.
      specialize (A f'). specialize (A' f).
      destruct (proj1 Ef ltac:(left; lia)) as [|]; destruct (proj2 Ef' ltac:(left; lia)) as [|];
        repeat match goal with H : in_runs _ _ = true -> _, I : in_runs _ _ = true |- _ => specialize (H I) end; lia. }
    assert (G : l = l').
    { subst f'. destruct (N.lt_trichotomy l l') as [T | [T | T]]; auto; exfalso.
      - pose proof (E (l + 1)%N) as K. rewrite !in_runs_cons in K.
        destruct (proj2 K ltac:(left; lia)) as [| I]; [lia |]. apply A in I. lia.
      - pose proof (E (l' + 1)%N) as K. rewrite !in_runs_cons in K.
        destruct (proj1 K ltac:(left; lia)) as [| I]; [lia |]. apply A' in I. lia. }
    subst. f_equal. apply (IH (l' + 2)%N); auto. intros k. specialize (E k). rewrite !in_runs_cons in E.
    split; intros I; [pose proof (A _ I) | pose proof (A' _ I)]; intuition lia.
Qed.

(** ** The whole form *)

Definition Form := fmap Replica (list run_).
Definition runs_of (F : Form) (p : Replica) : list run_ := match find F p with Some rs => rs | None => [] end.
Definition covers (F : Form) (d : Dot) : bool := in_runs (runs_of F (replica d)) (sequence d).

(** [CTX-2] A replica's entry in the vector, 0 if it has none, and its cloud. *)
Definition vector (F : Form) (p : Replica) : N :=
  match runs_of F p with (1, n)%N :: _ => n | _ => 0%N end.
Definition cloud (F : Form) (p : Replica) : list run_ :=
  match runs_of F p with (1, _)%N :: rest => rest | rs => rs end.

Definition compact (F : Form) : Prop := forall p rs, find F p = Some rs -> rs <> [] /\ compact_from 1 rs.

Lemma compact_runs F p : compact F -> compact_from 1 (runs_of F p).
Proof. intros C. unfold runs_of. destruct (find F p) eqn:E; [now apply C in E | easy]. Qed.

(** [CTX-2] All of r.1 … r.n are in the set; the cloud holds the others; every run of the cloud begins at least
    two above the entry. *)
Theorem vector_and_cloud F p k : compact F -> (0 < k)%N ->
  covers F (Build_Dot p k) = true <-> (k <= vector F p)%N \/ in_runs (cloud F p) k = true.
Proof.
  intros C K. unfold covers, vector, cloud. simpl. pose proof (compact_runs F p C) as R.
  destruct (runs_of F p) as [| [[| [? | ? |]] l] rs]; try (simpl; intuition lia).
  rewrite in_runs_cons. intuition lia.
Qed.

Theorem cloud_beyond F p : compact F -> compact_from (vector F p + 2) (cloud F p).
Proof.
  intros C. unfold vector, cloud. pose proof (compact_runs F p C) as R.
  destruct (runs_of F p) as [| [[| [q | q |]] l] rs]; simpl in *; intuition lia.
Qed.

(** [CTX-1] No dot of sequence 0 is covered, so ROOT's is not. *)
Theorem covers_events F d : compact F -> covers F d = true -> sequence d <> 0%N.
Proof. intros C H. apply (compact_above 1) in H; [lia | now apply compact_runs]. Qed.

(** [CTX-2] [CTX-4] One form for one set. *)
Theorem one_form F G : compact F -> compact G -> (forall d, covers F d = covers G d) -> F = G.
Proof.
  intros CF CG E. apply fmap_ext. intros p.
  assert (R : runs_of F p = runs_of G p).
  { apply (compact_unique _ 1); try now apply compact_runs. intros k.
    pose proof (E (Build_Dot p k)) as K. unfold covers in K. simpl in K. now rewrite K. }
  unfold runs_of in R. destruct (find F p) eqn:A, (find G p) eqn:B; auto; try congruence.
  - apply CF in A as [A _]. congruence.
  - apply CG in B as [B _]. congruence.
Qed.

(** ** Adding and joining *)

Definition insert_run (p : Replica) (f l : N) (F : Form) : Form := insert p (add_run f l (runs_of F p)) F.

Lemma add_run_nonempty f l rs : add_run f l rs <> [].
Proof.
  revert f l. induction rs as [| [f' l'] rs IH]; intros f l; simpl; [easy |].
  destruct (l + 1 <? f')%N; [easy |]. destruct (l' + 1 <? f)%N; [easy | apply IH].
Qed.

Theorem insert_run_compact p f l F : (1 <= f <= l)%N -> compact F -> compact (insert_run p f l F).
Proof.
  intros B C q rs. unfold insert_run. rewrite find_insert. destruct (eqb q p); [| apply C].
  intros [= <-]. split; [apply add_run_nonempty |]. apply add_run_compact; auto using compact_runs.
Qed.

Theorem insert_run_meaning p f l F d : (f <= l)%N -> compact F ->
  covers (insert_run p f l F) d = true <->
  (replica d = p /\ (f <= sequence d <= l)%N) \/ covers F d = true.
Proof.
  intros L C. unfold covers, insert_run. unfold runs_of at 1. rewrite find_insert.
  destruct (eqb (replica d) p) eqn:E.
  - apply eqb_eq in E. rewrite (add_run_meaning 1) by auto using compact_runs. rewrite E. tauto.
  - apply eqb_neq in E. fold (runs_of F (replica d)). tauto.
Qed.

(** [CTX-3] The join of two contexts: all runs of one added to the other. *)
Definition form_join (F G : Form) : Form :=
  fold_right (fun e H => fold_right (fun i => insert_run (fst e) (fst i) (snd i)) H (snd e)) F (entries G).

Lemma add_runs p rs b F : (1 <= b)%N -> compact_from b rs -> compact F ->
  let H := fold_right (fun i => insert_run p (fst i) (snd i)) F rs in
  compact H /\ forall d, covers H d = true <-> (replica d = p /\ in_runs rs (sequence d) = true) \/ covers F d = true.
Proof.
  revert b. induction rs as [| [f l] rs IH]; intros b B C CF; simpl; [split; auto; intros; intuition easy |].
  destruct C as (BF & L & C). destruct (IH (l + 2)%N) as [CH E]; auto; [lia |]. split.
  - apply insert_run_compact; auto. lia.
  - intros d. rewrite insert_run_meaning, E by auto.
    pose proof (in_runs_cons f l rs (sequence d)) as I. unfold in_runs in I |- *. simpl in I |- *. tauto.
Qed.

Theorem form_join_meaning F G : compact F -> compact G ->
  compact (form_join F G) /\ forall d, covers (form_join F G) d = covers F d || covers G d.
Proof.
  intros CF CG. unfold form_join.
  assert (R : forall l, (forall p rs, In (p, rs) l -> compact_from 1 rs) ->
    let H := fold_right (fun e H => fold_right (fun i => insert_run (fst e) (fst i) (snd i)) H (snd e)) F l in
    compact H /\ forall d, covers H d = true <->
      covers F d = true \/ exists rs, In (replica d, rs) l /\ in_runs rs (sequence d) = true).
  { induction l as [| [p rs] l IH]; intros A; simpl.
    - split; auto. intros d. split; [auto | intros [| (rs & [] & _)]; auto].
    - destruct IH as [CH E]; [intros q s I; apply (A q); now right |].
      destruct (add_runs p rs 1 _ ltac:(lia) (A p rs ltac:(now left)) CH) as [CI EI]. split; auto.
      intros d. rewrite EI, E. split.
      + intros [[<- I] | [I | (s & J & I)]]; eauto 6.
      + intros [I | (s & [[= -> ->] | J] & I)]; eauto 6. }
  destruct (R (entries G)) as [CH E].
  { intros p rs I. apply find_in in I. now apply CG in I. }
  split; auto. intros d. apply eq_true_iff_eq. rewrite E, orb_true_iff. apply or_iff_compat_l.
  unfold covers, runs_of. split.
  - intros (rs & I & J). apply find_in in I. now rewrite I.
  - destruct (find G (replica d)) as [rs |] eqn:I; [| easy]. intros J. exists rs. split; auto. now apply find_in.
Qed.

(** ** Forms and sets *)

(** [CTX-1] The form stands for a set. *)
Definition stands_for (F : Form) (s : fset Dot) : Prop := compact F /\ forall d, covers F d = mem s d.

Definition form_of (s : fset Dot) : Form :=
  fold_right (fun d => insert_run (replica d) (sequence d) (sequence d)) empty (elements s).

(** The form of the dots listed. *)
Lemma form_of_dots l : (forall d, In d l -> sequence d <> 0%N) ->
  let F := fold_right (fun d => insert_run (replica d) (sequence d) (sequence d)) empty l in
  compact F /\ forall d, covers F d = true <-> In d l.
Proof.
  induction l as [| d l IH]; intros A; simpl; [split; [intros p rs; easy | easy] |].
  destruct IH as [C M]; [intros e I; apply A; now right |].
  assert (sequence d <> 0%N) by (apply A; now left). split.
  - apply insert_run_compact; auto. lia.
  - intros e. rewrite insert_run_meaning, M by (auto; lia). split; intros [H1 | H1]; auto.
    + left. destruct d, e; simpl in *. destruct H1 as [-> ?]. f_equal. lia.
    + subst. left. split; auto. lia.
Qed.

(** Every context of a well-formed state has a form, and only one. *)
Theorem form_of_stands s : (forall d, mem s d = true -> sequence d <> 0%N) -> stands_for (form_of s) s.
Proof.
  intros E. destruct (form_of_dots (elements s)) as [C M]; [intros d I; now apply E, mem_elements |].
  split; auto. intros d. apply eq_true_iff_eq. unfold form_of. now rewrite M, mem_elements.
Qed.

Theorem forms_equal F G s : stands_for F s -> stands_for G s -> F = G.
Proof. intros [CF EF] [CG EG]. apply one_form; auto. intros d. now rewrite EF, EG. Qed.

(** [CTX-3] Joins stand for unions. *)
Theorem form_join_stands F G s t : stands_for F s -> stands_for G t -> stands_for (form_join F G) (union s t).
Proof.
  intros [CF EF] [CG EG]. destruct (form_join_meaning F G CF CG) as [C E]. split; auto.
  intros d. now rewrite E, mem_union, EF, EG.
Qed.

(** [CTX-2] [CLAIM-S1] Without gaps the cloud is empty: the form is one number for each replica. *)
Theorem gapless_cloud F s : stands_for F s ->
  (forall d k, mem s d = true -> (0 < k <= sequence d)%N -> mem s (Build_Dot (replica d) k) = true) ->
  forall p, cloud F p = [].
Proof.
  intros [C E] G p. pose proof (cloud_beyond F p C) as B.
  destruct (cloud F p) as [| [f l] rs] eqn:K; auto. exfalso. destruct B as (B & L & R).
  assert (I : covers F (Build_Dot p f) = true).
  { apply vector_and_cloud; auto; [lia |]. right. rewrite K. apply in_runs_cons. left. lia. }
  rewrite E in I. apply (G _ (f - 1)%N) in I; simpl in *; [| lia]. rewrite <- E in I.
  apply vector_and_cloud in I; auto; [| lia]. rewrite K, in_runs_cons in I.
  destruct I as [I | [I | I]]; try lia. apply (compact_above _ _ _ R) in I. lia.
Qed.
