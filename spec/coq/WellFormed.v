(** * Well-formed states (wellformed.md) *)

From DSR Require Export State.

(** [CTX-1] ROOT's dot and every dot of sequence 0 are in no context. *)
Definition events (X : State) : Prop := forall d, seen X d = true -> sequence d <> 0%N.
(** [WF-1] Every held dot is in the context. *)
Definition held_seen (X : State) : Prop := forall d, holds X d = true -> seen X d = true.
(** [WF-2] No held record has a dead anchor. *)
Definition closed (X : State) : Prop :=
  forall d x a, get X d = Some x -> In a (anchors x) -> is_dead X a = false.

(** What the laws need. *)
Definition wf (X : State) : Prop := events X /\ held_seen X /\ closed X.

(** [WF-3] An anchor that is held is of the right kind; an anchor of sequence 0 is ROOT. *)
Definition may_anchor (x y : record) : bool :=
  match x, y with
  | Edge _ _ _ _, Vertex _ _ _ _ => true
  | Write _ _ _ _ _, Vertex _ _ _ _ | Write _ _ _ _ _, Edge _ _ _ _ => true
  | _, _ => false
  end.
Definition right_anchors (X : State) : Prop :=
  forall d x a, get X d = Some x -> In a (anchors x) ->
    (sequence a = 0%N -> a = ROOT) /\ forall y, get X a = Some y -> may_anchor x y = true.

(** [WF-4] An edge has two different ends; an RT edge does not enter ROOT. WF-5 and WF-6 bound the sizes of
    names, values and stamps: like WF-4 they judge a record by itself. *)
Definition RT : Name := "RT"%string.
Definition edge_ends (x : record) : Prop :=
  match x with Edge from to label _ => from <> to /\ (label = RT -> to <> ROOT) | _ => True end.
(** All records held satisfy [P]. *)
Definition each_record (P : record -> Prop) (X : State) : Prop := forall d x, get X d = Some x -> P x.

(** A state that satisfies WF-1 is determined by the conditions of its dots. *)
Theorem state_ext X Y : held_seen X -> held_seen Y -> (forall d, cond X d = cond Y d) -> X = Y.
Proof.
  intros HX HY E.
  assert (G : forall d, get X d = get Y d).
  { intros d. specialize (E d). unfold cond in E.
    destruct (get X d), (get Y d); auto; destruct (seen X d), (seen Y d); congruence. }
  assert (S : forall d, seen X d = seen Y d).
  { intros d. specialize (E d). specialize (HX d). specialize (HY d). unfold holds, cond in *.
    rewrite <- (G d) in *. destruct (get X d); [now rewrite HX, HY |].
    destruct (seen X d), (seen Y d); congruence. }
  destruct X, Y. f_equal; [now apply fmap_ext | now apply set_ext].
Qed.

Lemma seen_cond X d : held_seen X -> seen X d = seen_in (cond X d).
Proof.
  intros W. specialize (W d). unfold holds, cond in *. destruct (get X d); simpl; auto.
  now destruct (seen X d).
Qed.

Lemma holds_cond X d : holds X d = match cond X d with Held _ => true | _ => false end.
Proof. unfold holds, cond. destruct (get X d); auto. now destruct (seen X d). Qed.

Lemma held_seen_make f ds : held_seen (make f ds).
Proof.
  intros d. unfold holds, get, seen, make. simpl. rewrite find_tabulate, mem_collect.
  destruct (member d ds); simpl; [now destruct (f d) | easy].
Qed.

(** The order of states is an order. *)
Theorem le_antisym X Y : held_seen X -> held_seen Y -> X ≤ Y -> Y ≤ X -> X = Y.
Proof. intros. apply state_ext; auto. intros d. now apply before_antisym. Qed.

(** [STATE-4] ROOT is unseen wherever CTX-1 and WF-1 hold; so it has no record and is never dead. *)
Theorem root_lives X : events X -> held_seen X -> cond X ROOT = Unseen.
Proof.
  intros E S.
  assert (U : seen X ROOT = false) by (destruct (seen X ROOT) eqn:I; auto; now apply E in I).
  specialize (S ROOT). unfold holds, cond in *. rewrite U in *. destruct (get X ROOT); auto.
  now specialize (S eq_refl).
Qed.

Lemma wf_bottom : wf bottom.
Proof. repeat split; intros d; easy. Qed.

(** [CLOSE-4] In a well-formed state an anchor of a held record lives (is held, or ROOT), or is unseen: then
    the record is pending. There is no third case. *)
Theorem live_or_pending X d x a : wf X -> get X d = Some x -> In a (anchors x) ->
  holds X a = true \/ a = ROOT \/ seen X a = false.
Proof.
  intros (_ & _ & C) G I. specialize (C _ _ _ G I). unfold is_dead in C.
  destruct (holds X a), (seen X a); auto; discriminate.
Qed.

(** ** The same, decided *)

Definition check_wf (X : State) : bool :=
  forallb (fun d => negb (eqb (sequence d) 0%N)) (elements (context X)) &&
  forallb (seen X) (keys (store X)) &&
  forallb (fun e => forallb (fun a => negb (is_dead X a)) (anchors (snd e))) (records X).

Definition check_anchors (X : State) : bool :=
  forallb (fun e => forallb (fun a =>
      implb (eqb (sequence a) 0%N) (eqb a ROOT) &&
      match get X a with Some y => may_anchor (snd e) y | None => true end) (anchors (snd e)))
    (records X).

Theorem check_wf_iff X : check_wf X = true <-> wf X.
Proof.
  unfold check_wf. rewrite !andb_true_iff, !forallb_forall. split.
  - intros ((E & S) & C). split; [| split].
    + intros d I Z. apply mem_elements in I. apply E in I. rewrite Z in I. discriminate.
    + intros d H. apply S, in_keys. unfold holds, get in H. now destruct (find (store X) d).
    + intros d x a G I. apply records_get in G. apply C in G. simpl in G. rewrite forallb_forall in G.
      apply G in I. now destruct (is_dead X a).
  - intros (E & S & C). split; [split |].
    + intros d I. apply mem_elements in I. apply E in I. apply eqb_neq in I. now rewrite I.
    + intros d I. apply in_keys in I. apply S. unfold holds, get. now destruct (find (store X) d).
    + intros [d x] I. apply records_get in I. apply forallb_forall. intros a J. simpl in J.
      now rewrite (C _ _ _ I J).
Qed.

Theorem check_anchors_iff X : check_anchors X = true <-> right_anchors X.
Proof.
  unfold check_anchors. rewrite forallb_forall. split.
  - intros C d x a G I. apply records_get in G. apply C in G. simpl in G. rewrite forallb_forall in G.
    apply G in I. apply andb_prop in I as [Z M]. split.
    + intros E. rewrite E in Z. now apply eqb_eq.
    + intros y H. now rewrite H in M.
  - intros R [d x] G. apply records_get in G. apply forallb_forall. intros a I. simpl in I.
    destruct (R _ _ _ G I) as [Z M]. apply andb_true_intro. split.
    + destruct (eqb (sequence a) 0%N) eqn:E; auto. apply eqb_eq in E. apply eqb_eq. auto.
    + simpl. destruct (get X a); auto.
Qed.
