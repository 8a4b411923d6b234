(** * The six δ-mutations (mutations.md)

    A mutation is refused or makes a delta. Here are all six deltas, record by record. Of the conditions those
    are here that speak of the state alone ([possible]); those of the view, the dictionary and the limits
    refuse more, and what is refused changes nothing: so what is proved of every possible mutation holds of
    every accepted one. *)

From DSR Require Export Join Stamps.

(** ** Who, when, and under which dots *)

Record Author := { me : Replica; time_ns : N }.

(** [ID-3] The greatest sequence of a replica in a context, whether or not there are gaps below it. *)
Definition greatest (X : State) (p : Replica) : N :=
  fold_right (fun d m => if eqb (replica d) p then N.max (sequence d) m else m) 0%N (elements (context X)).
Definition dot_of (p : Replica) (n : N) : Dot := {| replica := p; sequence := n |}.
Definition next_dot (X : State) (p : Replica) : Dot := dot_of p (1 + greatest X p).

(** [MUT-0.2] The dots of one delta follow each other without gap. *)
Fixpoint numbered (p : Replica) (n : N) (xs : list record) : list (Dot * record) :=
  match xs with
  | [] => []
  | x :: xs => (dot_of p n, x) :: numbered p (n + 1) xs
  end.

(** ** What a mutation does: the records that it makes, and the dots that it kills *)

Record Plan := { made : list (Dot * record); killed : list Dot }.

(** [MUT-0.1] Its delta: the records made; in the context their dots and the dots killed, and no other. *)
Definition delta_of (p : Plan) : State :=
  make (fun d => match lookup d (made p) with Some x => Held x | None => Dead end)
       (map fst (made p) ++ killed p).

(** Its effect on a state, said without join: what it kills is dropped from the store, what it makes is put
    in, and what that leaves without an anchor goes as well. *)
Definition edit (p : Plan) (X : State) : State :=
  close (make (fun d => match lookup d (made p) with
                        | Some x => Held x
                        | None => if member d (killed p) then Dead else cond X d
                        end) (domain X ++ map fst (made p) ++ killed p)).

(** ** The six *)

Definition Attributes := fmap Name Value.
(** A value to set, or none to unset. *)
Definition Updates := fmap Name (option Value).

Inductive Mutation :=
| AddVertex (type name : Name) (external_id : option N) (attributes : Attributes)
            (other : Dot) (label : Name) (outgoing : bool) (link_attributes : Attributes)
| AddEdge (key : Key) (attributes : Attributes)
| UpdateAttributes (target : Dot) (updates : Updates)
| RemoveEdge (key : Key)
| MoveEdge (old new : Key) (attributes : Attributes)
| RemoveVertex (vertex : Dot).

(** [MUT-2.6] Every claim held on the register of a key, shown, hidden or pending. *)
Definition register (D : Dictionary) (X : State) (k : Key) : list Dot :=
  map fst (filter (fun e => competes D k (snd e)) (records X)).
(** [MUT-3.5] Every write held of one attribute. *)
Definition writes_of (X : State) (target : Dot) (name : Name) : list Dot :=
  map fst (filter (fun e => writes target name (snd e)) (records X)).

Section Plans.
  Context (D : Dictionary) (X : State) (a : Author).

  Let stamp := (1 + greatest_stamp X)%N.
  Let first := (1 + greatest X (me a))%N.
  Let dot := dot_of (me a).

  Definition edge_record (k : Key) : record := Edge (key_from k) (key_to k) (key_label k) stamp.
  Definition set (target : Dot) (attributes : Attributes) : list record :=
    map (fun e => Write target (fst e) (snd e) (time_ns a) stamp) (entries attributes).
  Definition updated (target : Dot) (updates : Updates) : list record :=
    flat_map (fun e => match snd e with
      | Some v => [Write target (fst e) v (time_ns a) stamp] | None => [] end) (entries updates).

  Definition make_records (xs : list record) (kill : list Dot) : Plan :=
    {| made := numbered (me a) first xs; killed := kill |}.

  Definition plan (m : Mutation) : Plan :=
    match m with
    | AddVertex type name ext attributes other label outgoing link_attributes =>
        let new := dot first in
        let k := if outgoing then {| key_from := new; key_to := other; key_label := label |}
                 else {| key_from := other; key_to := new; key_label := label |} in
        make_records (Vertex type name ext stamp :: edge_record k ::
                      set (dot (first + 1)) link_attributes ++ set new attributes) (register D X k)
    | AddEdge k attributes => make_records (edge_record k :: set (dot first) attributes) (register D X k)
    | UpdateAttributes target updates =>
        make_records (updated target updates) (flat_map (writes_of X target) (keys updates))
    | RemoveEdge k => make_records [] (register D X k)
    | MoveEdge old new attributes =>
        make_records (edge_record new :: set (dot first) attributes) (register D X old ++ register D X new)
    | RemoveVertex v => make_records [] [v]
    end.

  (** ROOT, or a vertex held. *)
  Definition is_vertex (d : Dot) : bool :=
    is_root d || match get X d with Some (Vertex _ _ _ _) => true | _ => false end.
  (** Or an edge held between such (VIEW-1.1: no other is visible). *)
  Definition is_element (d : Dot) : bool :=
    is_vertex d || match get X d with Some (Edge from to _ _) => is_vertex from && is_vertex to | _ => false end.

  (** [MUT-1.1] [MUT-2.1] [MUT-3.1] [MUT-6.1] [MUT-6.2] What a mutation speaks of is there. *)
  Definition possible (m : Mutation) : bool :=
    match m with
    | AddVertex _ _ _ _ other _ _ _ => is_vertex other
    | AddEdge k _ | MoveEdge _ k _ => is_vertex (key_from k) && is_vertex (key_to k)
    | UpdateAttributes target _ => is_element target
    | RemoveEdge _ => true
    | RemoveVertex v => negb (is_root v) && is_vertex v
    end.
End Plans.

(** [MUT-0] The delta, and the state after: mᵟ and m. *)
Definition delta (D : Dictionary) (a : Author) (m : Mutation) (X : State) : State := delta_of (plan D X a m).
Definition mutate (D : Dictionary) (a : Author) (m : Mutation) (X : State) : State := edit (plan D X a m) X.

(** ** Dots *)

(** Nothing that has been seen of a replica is beyond its greatest sequence. *)
Theorem greatest_bounds X p d : seen X d = true -> replica d = p -> (sequence d <= greatest X p)%N.
Proof.
  unfold seen, greatest. rewrite <- mem_elements. intros I <-.
  induction (elements (context X)) as [| e l IH]; simpl in *; [easy |].
  destruct I as [-> | I]; [rewrite eqb_refl; lia |]. specialize (IH I). destruct eqb; lia.
Qed.

Lemma greatest_seen X p : greatest X p <> 0%N -> seen X (dot_of p (greatest X p)) = true.
Proof.
  unfold seen, greatest. rewrite <- mem_elements.
  induction (elements (context X)) as [| e l IH]; simpl; [easy |].
  destruct (eqb (replica e) p) eqn:E; [| now right; apply IH].
  apply eqb_eq in E. intros N.
  destruct (N.max_spec (sequence e) (fold_right (fun d m =>
    if eqb (replica d) p then N.max (sequence d) m else m) 0%N l)) as [[L ->] | [L ->]].
  - right. apply IH. lia.
  - left. subst. now destruct e.
Qed.

(** [ID-3] So the dots from the next on are new to the author's state. *)
Theorem next_dots_unseen X p n : (greatest X p < n)%N -> seen X (dot_of p n) = false.
Proof.
  intros L. apply not_true_iff_false. intros S. apply (greatest_bounds _ p) in S; auto. simpl in S. lia.
Qed.

Lemma cmp_dots p n n' : cmp (dot_of p n) (dot_of p n') = (n ?= n')%N.
Proof. unfold dot_of. cbn. now rewrite !N.compare_refl. Qed.

Lemma numbered_in p xs : forall n d x, In (d, x) (numbered p n xs) ->
  In x xs /\ replica d = p /\ (n <= sequence d < n + N.of_nat (length xs))%N.
Proof.
  induction xs as [| y xs IH]; intros n d x; simpl; [easy |]. intros [[= <- <-] | I].
  - simpl. repeat split; auto; lia.
  - destruct (IH _ _ _ I) as (J & E & B). repeat split; auto; lia.
Qed.

Lemma numbered_dot p xs : forall n d, In d (map fst (numbered p n xs)) <->
  replica d = p /\ (n <= sequence d < n + N.of_nat (length xs))%N.
Proof.
  induction xs as [| y xs IH]; intros n d; simpl; [split; [easy | lia] |]. rewrite IH. split.
  - intros [<- | (E & B)]; simpl; split; auto; lia.
  - intros (E & B). destruct (N.eq_dec n (sequence d)) as [-> |]; [left; subst; now destruct d | right].
    split; auto; lia.
Qed.

Lemma numbered_length p xs : forall n, length (numbered p n xs) = length xs.
Proof. induction xs; simpl; auto. Qed.

Lemma numbered_has p xs x : forall n, In x xs -> exists d, In (d, x) (numbered p n xs).
Proof.
  induction xs as [| y xs IH]; intros n; simpl; [easy |]. intros [-> | I]; [eauto |].
  destruct (IH (n + 1)%N I). eauto.
Qed.

(** What is told apart by [f] is filed once. *)
Lemma numbered_once {B} (f : record -> B) p xs : forall n, NoDup (map f xs) ->
  forall d x e y, In (d, x) (numbered p n xs) -> In (e, y) (numbered p n xs) -> f x = f y -> d = e.
Proof.
  induction xs as [| z xs IH]; intros n N d x e y; simpl; [easy |].
  inversion N as [| ? ? Z N']; subst. intros [[= <- <-] | I] [[= <- <-] | J] E; eauto; exfalso; apply Z.
  - rewrite E. apply in_map. now apply numbered_in in J.
  - rewrite <- E. apply in_map. now apply numbered_in in I.
Qed.

Lemma numbered_ascending p xs : forall n, ascending (numbered p n xs) = true.
Proof.
  induction xs as [| x [| y xs] IH]; intros n; auto.
  change (ltb (dot_of p n) (dot_of p (n + 1)) && ascending (numbered p (n + 1) (y :: xs)) = true).
  rewrite IH, andb_true_r. apply ltb_lt. rewrite cmp_dots. apply N.compare_lt_iff. lia.
Qed.

Lemma lookup_none {V} d (l : list (Dot * V)) : lookup d l = None <-> ~ In d (map fst l).
Proof.
  induction l as [| [e x] l IH]; simpl; [easy |]. destruct (eqb d e) eqn:E.
  - apply eqb_eq in E. subst. intuition congruence.
  - apply eqb_neq in E. rewrite IH. intuition congruence.
Qed.

(** ** What every plan of a possible mutation satisfies *)

Record sound (X : State) (p : Plan) : Prop := {
  made_ascending : ascending (made p) = true;
  (* ID-3: what is filed is new, *)
  made_new : forall d, In d (map fst (made p)) -> seen X d = false /\ sequence d <> 0%N;
  (* what is killed is there, *)
  killed_held : forall d, In d (killed p) -> holds X d = true;
  (* what is filed is anchored to ROOT, to what is held or to what is filed with it, of the right kind, *)
  made_anchored : forall d x b, In (d, x) (made p) -> In b (anchors x) ->
    b = ROOT \/ exists y, may_anchor x y = true /\ (In (b, y) (made p) \/ get X b = Some y);
  (* and to nothing that is killed. *)
  anchors_kept : forall d x b, In (d, x) (made p) -> In b (anchors x) -> ~ In b (killed p);
  (* and what it is anchored to stands: on ROOT, or on what is anchored to nothing and not killed. *)
  anchors_stand : forall d x b y c, In (d, x) (made p) -> In b (anchors x) ->
    get X b = Some y -> In c (anchors y) ->
    ~ In c (killed p) /\ (c = ROOT \/ exists z, get X c = Some z /\ anchors z = [])
}.

(** ** What follows of every sound plan *)

Section Sound.
  Context (X : State) (p : Plan) (W : wf X) (P : sound X p).

  Lemma cond_made d x : lookup d (made p) = Some x -> cond X d = Unseen.
  Proof.
    intros L. apply lookup_in, (in_map fst) in L; [| apply P]. apply P in L as [S _]. simpl in S.
    pose proof (seen_cond X d (proj1 (proj2 W))) as C. rewrite S in C. now destruct (cond X d).
  Qed.

  Lemma cond_delta_of d : cond (delta_of p) d =
    match lookup d (made p) with Some x => Held x | None => if member d (killed p) then Dead else Unseen end.
  Proof.
    unfold delta_of. rewrite cond_make, member_app.
    destruct (lookup d (made p)) eqn:L.
    - apply lookup_in, (in_map fst) in L; [| apply P]. apply member_in in L. simpl in L. now rewrite L.
    - apply lookup_none in L. rewrite <- member_in, not_true_iff_false in L. now rewrite L.
  Qed.

  Lemma delta_of_held d x : get (delta_of p) d = Some x <-> In (d, x) (made p).
  Proof.
    rewrite <- cond_held, cond_delta_of, <- (lookup_in _ d x (made_ascending _ _ P)).
    destruct (lookup d (made p)); [split; congruence |]. destruct member; split; congruence.
  Qed.

  (** [MUT-0.1] The context of a delta is the dots of its records and the dots killed, and no other. *)
  Theorem delta_of_context d :
    seen (delta_of p) d = true <-> In d (map fst (made p)) \/ In d (killed p).
  Proof.
    unfold seen, delta_of. simpl. rewrite mem_collect, member_app.
    rewrite <- !(member_in d). destruct (lookup d (made p)); simpl;
      rewrite andb_true_r, orb_true_iff; reflexivity.
  Qed.

  Lemma agree_delta_of : agree X (delta_of p).
  Proof.
    intros d x y G H. apply delta_of_held, lookup_in, cond_made in H; [| apply P].
    apply cond_held in G. congruence.
  Qed.

  Lemma killed_not_made d : In d (killed p) -> lookup d (made p) = None.
  Proof.
    intros K. destruct (lookup d (made p)) eqn:L; auto. apply cond_made in L.
    apply P in K. rewrite holds_cond, L in K. discriminate.
  Qed.

  (** [WF-1] [WF-2] A delta is a well-formed state (STATE-5). *)
  Theorem wf_delta_of : wf (delta_of p).
  Proof.
    split; [| split].
    - intros d [I | K]%delta_of_context; [now apply P |]. apply P in K.
      apply W. apply W in K. exact K.
    - apply held_seen_make.
    - intros d x b G I. apply delta_of_held in G. apply not_true_iff_false. rewrite <- cond_dead.
      rewrite cond_delta_of. destruct (lookup b (made p)); [easy |].
      destruct (member b (killed p)) eqn:K; [| easy]. apply member_in in K.
      now apply (anchors_kept _ _ P _ _ _ G I) in K.
  Qed.

  (** [MUT-0] X ⊔ mᵟ(X) = m(X): joining the delta does what the mutation says. *)
  Theorem join_delta_of : X ⊔ delta_of p = edit p X.
  Proof.
    unfold join, edit. f_equal. apply state_ext; auto using held_seen_merge, held_seen_make. intros d.
    rewrite cond_merge, cond_delta_of, cond_make, !member_app.
    destruct (lookup d (made p)) eqn:L.
    - rewrite (cond_made _ _ L). apply lookup_in, (in_map fst) in L; [| apply P].
      apply member_in in L. simpl in L. now rewrite L, orb_true_r.
    - apply lookup_none in L. rewrite <- member_in, not_true_iff_false in L. rewrite L. simpl.
      destruct (member d (killed p)) eqn:K.
      + rewrite orb_true_r. apply member_in, P in K. rewrite holds_cond in K. now destruct (cond X d).
      + rewrite orb_false_r. destruct (member d (domain X)) eqn:M; [now destruct (cond X d) |].
        apply domain_spec_not in M. now rewrite M.
  Qed.

  (** [MUT-0.1] Every mutation is inflationary. *)
  Theorem edit_inflationary : X ⊑ edit p X /\ X ≤ edit p X.
  Proof.
    assert (L : X ≤ edit p X) by (rewrite <- join_delta_of; apply join_upper_left, agree_delta_of).
    split; auto. apply below_iff_le; auto using le_agree.
    rewrite <- join_delta_of. apply wf_join; auto using wf_delta_of.
  Qed.

  Theorem wf_edit : wf (edit p X).
  Proof. rewrite <- join_delta_of. apply wf_join; auto using wf_delta_of. Qed.

  (** What was killed is dead afterwards, and what was made lives. *)
  Theorem killed_dies d : In d (killed p) -> is_dead (edit p X) d = true.
  Proof.
    intros K. unfold edit. apply close_drops. left. apply cond_dead. rewrite cond_make.
    rewrite (killed_not_made _ K). apply member_in in K. rewrite !member_app, K, !orb_true_r. reflexivity.
  Qed.

  Let M := merge X (delta_of p).

  Lemma cond_merge_made d x : In (d, x) (made p) -> cond M d = Held x.
  Proof.
    intros I. unfold M. rewrite cond_merge. pose proof I as J. apply delta_of_held, cond_held in J. rewrite J.
    apply lookup_in, cond_made in I; [| apply P]. now rewrite I.
  Qed.

  Lemma cond_merge_kept d x : get X d = Some x -> ~ In d (killed p) -> cond M d = Held x.
  Proof.
    intros G K. unfold M. rewrite cond_merge, cond_delta_of. destruct (lookup d (made p)) eqn:L.
    - apply cond_made in L. apply cond_held in G. congruence.
    - rewrite <- member_in, not_true_iff_false in K. rewrite K. apply cond_held in G. now rewrite G.
  Qed.

  Lemma root_unseen : cond M ROOT = Unseen.
  Proof.
    unfold M. rewrite cond_merge. destruct W as (E & S & _), wf_delta_of as (E' & S' & _).
    now rewrite !root_lives.
  Qed.

  Lemma made_not_doomed d : doomed M d -> forall x, ~ In (d, x) (made p).
  Proof.
    assert (S : forall d x b, In (d, x) (made p) -> In b (anchors x) -> is_dead M b = false).
    { intros e x b I J. apply not_true_iff_false. rewrite <- cond_dead.
      destruct (made_anchored _ _ P _ _ _ I J) as [-> | (y & _ & [K | K])].
      - now rewrite root_unseen.
      - now rewrite (cond_merge_made _ _ K).
      - rewrite (cond_merge_kept _ _ K); [easy |]. eapply anchors_kept; eauto. }
    induction 1 as [d x' b G J B | d x' b G J B IH]; intros x I;
      apply cond_held in G; rewrite (cond_merge_made _ _ I) in G; injection G as <-.
    - now rewrite (S _ _ _ I J) in B.
    - destruct (made_anchored _ _ P _ _ _ I J) as [-> | (y & _ & [K | K])]; [| now apply IH in K |].
      + inversion B as [? ? ? G | ? ? ? G]; apply cond_held in G; now rewrite root_unseen in G.
      + assert (T : forall c, In c (anchors y) -> is_dead M c = false /\ ~ doomed M c).
        { intros c H. destruct (anchors_stand _ _ P _ _ _ _ _ I J K H) as [N [-> | (z & Gz & Z)]].
          - split; [apply not_true_iff_false; rewrite <- cond_dead; now rewrite root_unseen |].
            inversion 1 as [? ? ? G | ? ? ? G]; apply cond_held in G; now rewrite root_unseen in G.
          - pose proof (cond_merge_kept _ _ Gz N) as C. split.
            + apply not_true_iff_false. rewrite <- cond_dead. congruence.
            + inversion 1 as [? ? ? G | ? ? ? G]; apply cond_held in G; rewrite C in G;
                injection G as <-; now rewrite Z in *. }
        pose proof (cond_merge_kept _ _ K (anchors_kept _ _ P _ _ _ I J)) as C.
        inversion B as [? ? c G H E | ? ? c G H E]; apply cond_held in G; rewrite C in G;
          injection G as <-; apply T in H as [T1 T2]; congruence || auto.
  Qed.

  Theorem made_lives d x : In (d, x) (made p) -> get (edit p X) d = Some x.
  Proof.
    intros I. pose proof (cond_merge_made _ _ I) as C.
    rewrite <- join_delta_of. unfold join. fold M. apply cond_held.
    pose proof (close_inflationary M d) as L. rewrite C in L.
    destruct (cond (close M) d) eqn:H; inversion L; auto.
    apply cond_dead, close_drops in H as [H | H].
    - apply cond_dead in H. congruence.
    - now apply made_not_doomed in I.
  Qed.
End Sound.

(** ** The plans of all six are sound *)

Lemma register_in D X k d : In d (register D X k) <-> exists x, get X d = Some x /\ competes D k x = true.
Proof.
  unfold register. rewrite in_map_iff. split.
  - intros ([e x] & <- & I). apply filter_In in I as [I C]. apply records_get in I. simpl in *. eauto.
  - intros (x & G & C). exists (d, x). split; auto. apply filter_In. split; auto. now apply records_get.
Qed.

Lemma writes_of_in X t n d : In d (writes_of X t n) <-> exists x, get X d = Some x /\ writes t n x = true.
Proof.
  unfold writes_of. rewrite in_map_iff. split.
  - intros ([e x] & <- & I). apply filter_In in I as [I C]. apply records_get in I. simpl in *. eauto.
  - intros (x & G & C). exists (d, x). split; auto. apply filter_In. split; auto. now apply records_get.
Qed.

Lemma writes_in X t (u : Updates) d : In d (flat_map (writes_of X t) (keys u)) -> exists x, get X d = Some x /\
  exists n v c s, x = Write t n v c s.
Proof.
  rewrite in_flat_map. intros (n & _ & I). apply writes_of_in in I as (x & G & E). exists x. split; auto.
  destruct x; simpl in E; try easy. apply andb_prop in E as [<-%eqb_eq _]. eauto.
Qed.

Lemma set_in X a t l x : In x (set X a t l) -> exists n v, x = Write t n v (time_ns a) (1 + greatest_stamp X).
Proof. unfold set. rewrite in_map_iff. intros ([n v] & <- & _). eauto. Qed.

Lemma updated_in X a t u x : In x (updated X a t u) ->
  exists n v, In (n, Some v) (entries u) /\ x = Write t n v (time_ns a) (1 + greatest_stamp X).
Proof.
  unfold updated. rewrite in_flat_map. intros ([n [v |]] & I & J); simpl in J; [| easy].
  destruct J as [<- | []]. eauto.
Qed.

Section Make.
  Context (X : State) (a : Author) (xs : list record) (kill : list Dot) (W : wf X).
  Let p := make_records X a xs kill.

  (** An anchor [b] of a record [x] that is filed. *)
  Definition good (x : record) (b : Dot) : Prop :=
    (b = ROOT \/ exists y, may_anchor x y = true /\ (In (b, y) (made p) \/ get X b = Some y)) /\
    ~ In b kill /\
    forall y c, get X b = Some y -> In c (anchors y) ->
      ~ In c kill /\ (c = ROOT \/ exists z, get X c = Some z /\ anchors z = []).

  Lemma made_dot d : In d (map fst (made p)) -> seen X d = false /\ sequence d <> 0%N.
  Proof.
    unfold p, make_records. cbn [made]. rewrite numbered_dot. intros (E & B). split; [| lia].
    destruct d as [q n]. cbn [replica sequence] in *. subst q. apply (next_dots_unseen X (me a)). lia.
  Qed.

  Lemma make_sound : (forall d, In d kill -> holds X d = true) ->
    (forall x b, In x xs -> In b (anchors x) -> good x b) -> sound X p.
  Proof.
    intros K G.
    assert (I : forall d x, In (d, x) (made p) -> In x xs) by (intros d x I; now apply numbered_in in I).
    constructor; auto using made_dot.
    - apply numbered_ascending.
    - intros d x b J H. now apply (G x b (I _ _ J)).
    - intros d x b J H. now apply (G x b (I _ _ J)).
    - intros d x b y c J H. now apply (G x b (I _ _ J)).
  Qed.

  Context (K : forall d, In d kill -> holds X d = true).

  Lemma not_unseen_killed b : seen X b = false -> ~ In b kill.
  Proof. intros S I. apply K, W in I. congruence. Qed.

  Lemma root_not_killed : ~ In ROOT kill.
  Proof. apply not_unseen_killed. destruct W as (E & S & _). rewrite seen_cond, root_lives; auto. Qed.

  Lemma good_made x y b : In (b, y) (made p) -> may_anchor x y = true -> good x b.
  Proof.
    intros I M. assert (S : seen X b = false) by (apply made_dot, (in_map fst _ _ I)).
    split; [| split].
    - eauto.
    - now apply not_unseen_killed.
    - intros z c G. exfalso. assert (H : holds X b = true) by (unfold holds; now rewrite G).
      apply W in H. congruence.
  Qed.

  Context (V : forall d x, In d kill -> get X d = Some x -> match x with Vertex _ _ _ _ => False | _ => True end).

  Lemma vertex_not_killed b : is_vertex X b = true -> ~ In b kill.
  Proof.
    unfold is_vertex. intros [R | R]%orb_prop.
    - apply eqb_eq in R as ->. apply root_not_killed.
    - intros I. destruct (get X b) as [[] |] eqn:G; try easy. now apply (V _ _ I) in G.
  Qed.

  Lemma good_vertex x b : match x with Vertex _ _ _ _ => False | _ => True end ->
    is_vertex X b = true -> good x b.
  Proof.
    intros N B. split; [| split; [now apply vertex_not_killed |]].
    - apply orb_prop in B as [R | R]; [left; now apply eqb_eq | right].
      destruct (get X b) as [[] |]; try easy. eexists. split; [| eauto]. now destruct x.
    - intros y c G. apply orb_prop in B as [R | R].
      + exfalso. apply eqb_eq in R as ->. destruct W as (E & S & _). pose proof (root_lives X E S) as U.
        apply cond_held in G. congruence.
      + rewrite G in R. now destruct y.
  Qed.
End Make.

Lemma competes_edge D k x : competes D k x = true -> exists f t l s, x = Edge f t l s.
Proof. destruct x; simpl; try easy. eauto. Qed.

Theorem plan_sound D X a m : wf X -> possible X m = true -> sound X (plan D X a m).
Proof.
  intros W Q.
  assert (RK : forall k d, In d (register D X k) -> holds X d = true).
  { intros k d (x & G & _)%register_in. unfold holds. now rewrite G. }
  assert (RV : forall k d x, In d (register D X k) -> get X d = Some x ->
    match x with Vertex _ _ _ _ => False | _ => True end).
  { intros k d x (y & G & (f & t & l & s & ->)%competes_edge)%register_in H. rewrite G in H. now injection H as <-. }
  destruct m; cbn [possible plan] in Q |- *.
  - (* add_vertex *)
    apply make_sound; eauto. intros x b [<- | [<- | [I | I]%in_app_iff]] J.
    + easy.
    + assert (b = other \/ b = dot_of (me a) (1 + greatest X (me a))) as [-> | ->].
      { destruct outgoing; cbn [anchors edge_record key_from key_to In] in J; intuition congruence. }
      * apply (good_vertex X a _ _ W (RK _) (RV _)); [exact Logic.I | auto].
      * eapply good_made; eauto; [now left | reflexivity].
    + apply set_in in I as (n & v & ->). destruct J as [<- | []].
      eapply good_made; eauto; [right; now left | reflexivity].
    + apply set_in in I as (n & v & ->). destruct J as [<- | []].
      eapply good_made; eauto; [now left | reflexivity].
  - (* add_edge *)
    apply andb_prop in Q as [QF QT]. apply make_sound; eauto. intros x b [<- | I] J.
    + apply (good_vertex X a _ _ W (RK _) (RV _)); [exact Logic.I |]. destruct J as [<- | [<- | []]]; auto.
    + apply set_in in I as (n & v & ->). destruct J as [<- | []].
      eapply good_made; eauto; [now left | reflexivity].
  - (* update_attributes *)
    assert (K : forall d, In d (flat_map (writes_of X target) (keys updates)) -> holds X d = true).
    { intros d (x & G & _)%writes_in. unfold holds. now rewrite G. }
    assert (V : forall d x, In d (flat_map (writes_of X target) (keys updates)) -> get X d = Some x ->
      match x with Vertex _ _ _ _ => False | _ => True end).
    { intros d x (y & G & n & v & c & s & ->)%writes_in H. rewrite G in H. now injection H as <-. }
    apply make_sound; eauto. intros x b I J. apply updated_in in I as (n & v & _ & ->).
    destruct J as [<- | []]. unfold is_element in Q. apply orb_prop in Q as [Q | Q].
    + apply (good_vertex X a _ _ W K V); [exact Logic.I | auto].
    + destruct (get X target) as [[| from to label s |] |] eqn:G; try easy. apply andb_prop in Q as [QF QT].
      split; [right; eexists; split; [| eauto]; reflexivity |]. split.
      * intros (y & H & n' & v' & c' & s' & ->)%writes_in. congruence.
      * rewrite G. intros y c [= <-] I.
        assert (Qc : is_vertex X c = true) by (destruct I as [<- | [<- | []]]; auto).
        split; [eapply vertex_not_killed; eauto |].
        apply orb_prop in Qc as [R | R]; [left; now apply eqb_eq | right].
        destruct (get X c) as [[] |]; try easy. eauto.
  - (* remove_edge *)
    apply make_sound; eauto. easy.
  - (* move_edge *)
    apply andb_prop in Q as [QF QT].
    assert (K : forall d, In d (register D X old ++ register D X new) -> holds X d = true).
    { intros d [I | I]%in_app_iff; eauto. }
    assert (V : forall d x, In d (register D X old ++ register D X new) -> get X d = Some x ->
      match x with Vertex _ _ _ _ => False | _ => True end).
    { intros d x [I | I]%in_app_iff G; [exact (RV _ _ _ I G) | exact (RV _ _ _ I G)]. }
    apply make_sound; eauto. intros x b [<- | I] J.
    + apply (good_vertex X a _ _ W K V); [exact Logic.I |]. destruct J as [<- | [<- | []]]; auto.
    + apply set_in in I as (n & v & ->). destruct J as [<- | []].
      eapply good_made; eauto; [now left | reflexivity].
  - (* remove_vertex *)
    apply andb_prop in Q as [R Q]. apply make_sound; eauto; [| easy].
    intros d [<- | []]. unfold is_vertex in Q. apply negb_true_iff in R. rewrite R in Q.
    unfold holds. now destruct (get X vertex).
Qed.

(** ** The clauses *)

Section Clauses.
  Context (D : Dictionary) (a : Author) (m : Mutation) (X : State).
  Context (W : wf X) (Q : possible X m = true).

  (** [MUT-0] [CLAIM-L2] *)
  Theorem mutate_is_join : X ⊔ delta D a m X = mutate D a m X.
  Proof. apply join_delta_of; auto. now apply plan_sound. Qed.

  (** [MUT-0.1] [CLAIM-L2] *)
  Theorem mutate_inflationary : X ⊑ mutate D a m X.
  Proof. apply edit_inflationary; auto. now apply plan_sound. Qed.

  Theorem wf_delta : wf (delta D a m X).
  Proof. apply (wf_delta_of X); auto. now apply plan_sound. Qed.

  Theorem wf_mutate : wf (mutate D a m X).
  Proof. apply wf_edit; auto. now apply plan_sound. Qed.

  (** [ID-3] [MUT-0.2] The dots of what is filed are the author's next ones, without gap. *)
  Theorem delta_dots d : holds (delta D a m X) d = true <->
    replica d = me a /\
    (1 + greatest X (me a) <= sequence d < 1 + greatest X (me a) + N.of_nat (length (made (plan D X a m))))%N.
  Proof.
    pose proof (plan_sound D X a m W Q) as P.
    assert (H : holds (delta D a m X) d = true <-> In d (map fst (made (plan D X a m)))).
    { unfold holds. rewrite in_map_iff. split.
      - destruct (get (delta D a m X) d) as [x |] eqn:G; [| easy]. intros _.
        apply (delta_of_held X) in G; auto. now exists (d, x).
      - intros ([e x] & <- & I). apply (delta_of_held X _ P) in I. simpl. unfold delta. now rewrite I. }
    rewrite H.
    assert (N : exists xs, made (plan D X a m) = numbered (me a) (1 + greatest X (me a)) xs)
      by (destruct m; eexists; reflexivity).
    destruct N as (xs & N). rewrite N, numbered_dot.
    now rewrite numbered_length.
  Qed.

  (** [STAMP-1] Each record filed outranks every record that the author held. *)
  Theorem delta_outranks d x e y : get (delta D a m X) d = Some x -> get X e = Some y ->
    cmp (rank_of e y) (rank_of d x) = Lt.
  Proof.
    intros G H. pose proof (plan_sound D X a m W Q) as P. apply (delta_of_held X _ P) in G.
    apply (next_stamp_outranks X); auto.
    destruct m; apply numbered_in in G as [I _].
    - destruct I as [<- | [<- | [I | I]%in_app_iff]]; auto; apply set_in in I as (? & ? & ->); auto.
    - destruct I as [<- | I]; auto. apply set_in in I as (? & ? & ->); auto.
    - apply updated_in in I as (? & ? & _ & ->); auto.
    - destruct I.
    - destruct I as [<- | I]; auto. apply set_in in I as (? & ? & ->); auto.
    - destruct I.
  Qed.

  Lemma mutate_held d x : get (mutate D a m X) d = Some x ->
    In (d, x) (made (plan D X a m)) \/ get X d = Some x /\ ~ In d (killed (plan D X a m)).
  Proof.
    pose proof (plan_sound D X a m W Q) as P. intros G.
    destruct (member d (killed (plan D X a m))) eqn:K.
    - apply member_in in K. apply (killed_dies X _ W P) in K. apply cond_dead in K.
      apply cond_held in G. unfold mutate in G. congruence.
    - rewrite <- not_true_iff_false, member_in in K. rewrite <- mutate_is_join in G.
      apply join_from in G as [G | G]; auto. left. now apply (delta_of_held X _ P).
  Qed.
End Clauses.

(** [MUT-2.6] [MUT-4] [MUT-5] Afterwards nothing is held on a register but what the mutation claimed. *)
Theorem remove_edge_clears D a X k : wf X ->
  forall d x, get (mutate D a (RemoveEdge k) X) d = Some x -> competes D k x = false.
Proof.
  intros W d x G. apply mutate_held in G as [[] | [G N]]; auto. apply not_true_iff_false. intros C.
  apply N, register_in. eauto.
Qed.

Theorem add_edge_claims D a X k l : wf X -> possible X (AddEdge k l) = true ->
  get (mutate D a (AddEdge k l) X) (next_dot X (me a)) = Some (edge_record X k) /\
  forall d x, get (mutate D a (AddEdge k l) X) d = Some x -> competes D k x = true ->
    d = next_dot X (me a).
Proof.
  intros W Q. split.
  - apply made_lives; auto using plan_sound. now left.
  - intros d x G C. apply mutate_held in G as [I | [G N]]; auto.
    + destruct I as [[= <- _] | I]; auto. apply numbered_in in I as [I _].
      apply set_in in I as (? & ? & ->). discriminate.
    + destruct N. apply register_in. eauto.
Qed.

Theorem move_edge_claims D a X k k' l : wf X -> possible X (MoveEdge k k' l) = true ->
  get (mutate D a (MoveEdge k k' l) X) (next_dot X (me a)) = Some (edge_record X k') /\
  forall d x, get (mutate D a (MoveEdge k k' l) X) d = Some x ->
    competes D k x = true \/ competes D k' x = true -> d = next_dot X (me a).
Proof.
  intros W Q. split.
  - apply made_lives; auto using plan_sound. now left.
  - intros d x G C. apply mutate_held in G as [I | [G N]]; auto.
    + destruct I as [[= <- _] | I]; auto. apply numbered_in in I as [I _].
      apply set_in in I as (? & ? & ->). now destruct C.
    + destruct N. apply in_app_iff. rewrite !register_in. destruct C; eauto.
Qed.

Definition attribute (x : record) : option Name := match x with Write _ n _ _ _ => Some n | _ => None end.

Lemma updated_names X a t (u : Updates) : NoDup (keys u) -> NoDup (map attribute (updated X a t u)).
Proof.
  unfold keys, updated. induction (entries u) as [| [n v] l IH]; simpl; [constructor |].
  intros N. inversion N as [| ? ? F N']; subst. destruct v; simpl; auto. constructor; auto.
  rewrite in_map_iff. intros (x & E & I). apply in_flat_map in I as ([n' [v' |]] & I & J); simpl in J; [| easy].
  destruct J as [<- | []]. injection E as ->. apply F. apply in_map_iff. now exists (n, Some v').
Qed.

(** [MUT-3] [MUT-3.5] Of an attribute that is set exactly one write is held afterwards, the new value; of one
    that is unset none. [MUT-3.6] No edge is touched. *)
Theorem update_sets D a X t u n v : wf X -> possible X (UpdateAttributes t u) = true ->
  In (n, Some v) (entries u) ->
  exists d, get (mutate D a (UpdateAttributes t u) X) d
      = Some (Write t n v (time_ns a) (1 + greatest_stamp X)) /\
    forall e x, get (mutate D a (UpdateAttributes t u) X) e = Some x -> writes t n x = true -> e = d.
Proof.
  intros W Q I.
  assert (J : In (Write t n v (time_ns a) (1 + greatest_stamp X)) (updated X a t u)).
  { apply in_flat_map. exists (n, Some v). split; [auto | now left]. }
  destruct (numbered_has (me a) _ _ (1 + greatest X (me a))%N J) as (d & F).
  exists d. split; [now apply made_lives; auto using plan_sound |].
  intros e x G C. apply mutate_held in G as [H | [G N]]; auto.
  - refine (numbered_once attribute (me a) _ _ _ _ _ _ _ H F _).
    + apply updated_names, keys_nodup.
    + destruct x; try easy. simpl in C. apply andb_prop in C as [_ C%eqb_eq]. simpl. congruence.
  - destruct N. apply in_flat_map. exists n. split.
    + apply in_map_iff. now exists (n, Some v).
    + apply writes_of_in. eauto.
Qed.

Theorem update_unsets D a X t u n : wf X -> possible X (UpdateAttributes t u) = true ->
  In (n, None) (entries u) ->
  forall e x, get (mutate D a (UpdateAttributes t u) X) e = Some x -> writes t n x = false.
Proof.
  intros W Q I e x G. apply mutate_held in G as [J | [G N]]; auto.
  - apply numbered_in in J as [J _]. apply updated_in in J as (n' & v & J & ->). simpl.
    rewrite eqb_refl. apply eqb_neq. intros ->. apply find_in in I, J. congruence.
  - apply not_true_iff_false. intros C. apply N. apply in_flat_map. exists n. split.
    + apply in_map_iff. now exists (n, None).
    + apply writes_of_in. eauto.
Qed.

(** [MUT-6] After a vertex was removed nothing is anchored to it, in whatever state the delta arrives. *)
Theorem remove_vertex_takes D a X Y v : wf X -> possible X (RemoveVertex v) = true -> wf Y ->
  is_dead (Y ⊔ delta D a (RemoveVertex v) X) v = true /\
  forall d x, get (Y ⊔ delta D a (RemoveVertex v) X) d = Some x -> ~ In v (anchors x).
Proof.
  intros W Q WY. assert (K : is_dead (Y ⊔ delta D a (RemoveVertex v) X) v = true).
  { rewrite join_comm. apply removal_is_final; try apply WY; try now apply wf_delta.
    apply cond_dead. unfold delta. rewrite (cond_delta_of X) by now apply plan_sound.
    simpl. now rewrite eqb_refl. }
  split; auto. intros d x G I. pose proof (close_closed _ _ _ _ G I) as C.
  unfold join in K. congruence.
Qed.

(** [MUT-0.4] Deltas compose by join: the join of deltas made one after the other does what both do. *)
Theorem deltas_compose D a m m' X : wf X -> possible X m = true -> possible (mutate D a m X) m' = true ->
  X ⊔ (delta D a m X ⊔ delta D a m' (mutate D a m X)) = mutate D a m' (mutate D a m X).
Proof.
  intros W Q Q'. pose proof (wf_mutate D a m X W Q) as W'.
  pose proof (plan_sound D X a m W Q) as P. pose proof (plan_sound D _ a m' W' Q') as P'.
  rewrite <- (mutate_is_join D a m' _ W' Q').
  rewrite <- (mutate_is_join D a m X W Q) at 2.
  (* What the second files is new to the author's state, which has seen all of X and of the first. *)
  assert (N : forall Y, Y ≤ mutate D a m X -> agree Y (delta D a m' (mutate D a m X))).
  { intros Y L d x y G H. pose proof (L d) as B. apply cond_held in G. rewrite G in B.
    apply (delta_of_held _ _ P') , lookup_in, (cond_made _ _ W' P') in H; [| apply P'].
    rewrite H in B. inversion B. }
  symmetry. apply join_assoc; try apply N.
  - now apply (agree_delta_of _ _ W P).
  - rewrite <- (mutate_is_join D a m X W Q). now apply join_upper_right, (agree_delta_of _ _ W P).
  - now apply edit_inflationary.
Qed.
