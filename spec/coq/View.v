(** * The view (view.md, invariants.md)

    A function of a state and a dictionary, over lists: it runs. The theorems hold of *any* state that holds
    nothing under ROOT's dot, as every well-formed one (STATE-4): reachable or not, closed or not. *)

From DSR Require Export Stamps Forest.
From Coq Require Import Permutation Relations.

(** ** Choosing by rank *)

Section Best.
  Context {A K : Type} `{Ordered K} (f : A -> K).

  (** Nothing listed is greater, or nothing is less. *)
  Definition is_greatest (l : list A) (a : A) : bool := forallb (fun b => negb (ltb (f a) (f b))) l.
  Definition is_least (l : list A) (a : A) : bool := forallb (fun b => negb (ltb (f b) (f a))) l.

  Lemma not_less_trans x y z : ltb x y = false -> ltb y z = false -> ltb x z = false.
  Proof.
    rewrite <- !not_true_iff_false, !ltb_lt. intros A1 A2 L. destruct (cmp x y) eqn:E; try easy.
    - apply cmp_eq in E. now subst.
    - apply cmp_gt_lt in E. apply A2. eapply cmp_trans; eauto.
  Qed.

  Lemma ltb_irrefl x : ltb x x = false.
  Proof. unfold ltb. now rewrite cmp_refl. Qed.

  Lemma ltb_asym x y : ltb x y = true -> ltb y x = false.
  Proof. unfold ltb. rewrite (cmp_sym x y). now destruct (cmp x y). Qed.

  Lemma ltb_total x y : ltb x y = false -> ltb y x = false -> x = y.
  Proof. unfold ltb. rewrite (cmp_sym x y), <- (cmp_eq x y). now destruct (cmp x y). Qed.

  Lemma is_greatest_spec l a : is_greatest l a = true <-> forall b, In b l -> ltb (f a) (f b) = false.
  Proof. unfold is_greatest. rewrite forallb_forall. now setoid_rewrite negb_true_iff. Qed.

  Lemma is_least_spec l a : is_least l a = true <-> forall b, In b l -> ltb (f b) (f a) = false.
  Proof. unfold is_least. rewrite forallb_forall. now setoid_rewrite negb_true_iff. Qed.

  Lemma greatest_exists l : l <> [] -> exists a, In a l /\ is_greatest l a = true.
  Proof.
    setoid_rewrite is_greatest_spec. induction l as [| b l IH]; [easy |]. intros _. destruct l as [| c l'].
    - exists b. simpl. split; auto. intros ? [<- | []]. apply ltb_irrefl.
    - destruct IH as (a & I & G); [easy |]. destruct (ltb (f a) (f b)) eqn:L.
      + exists b. split; [now left |]. intros d [<- | J]; [apply ltb_irrefl |].
        eapply not_less_trans; [apply ltb_asym, L | auto].
      + exists a. split; [now right |]. intros d [<- | J]; auto.
  Qed.

  Lemma least_exists l : l <> [] -> exists a, In a l /\ is_least l a = true.
  Proof.
    setoid_rewrite is_least_spec. induction l as [| b l IH]; [easy |]. intros _. destruct l as [| c l'].
    - exists b. simpl. split; auto. intros ? [<- | []]. apply ltb_irrefl.
    - destruct IH as (a & I & G); [easy |]. destruct (ltb (f b) (f a)) eqn:L.
      + exists b. split; [now left |]. intros d [<- | J]; [apply ltb_irrefl |].
        eapply not_less_trans; [| apply ltb_asym, L]. auto.
      + exists a. split; [now right |]. intros d [<- | J]; auto.
  Qed.

  (** Sorted descending. *)
  Fixpoint file (a : A) (l : list A) : list A :=
    match l with
    | [] => [a]
    | b :: rest => if ltb (f a) (f b) then b :: file a rest else a :: l
    end.
  Definition descending (l : list A) : list A := fold_right file [] l.

  Lemma file_permutation a l : Permutation (a :: l) (file a l).
  Proof.
    induction l as [| b l IH]; simpl; auto. destruct ltb; auto.
    eapply perm_trans; [apply perm_swap | auto].
  Qed.

  Lemma descending_permutation l : Permutation l (descending l).
  Proof.
    induction l as [| a l IH]; simpl; auto. eapply perm_trans; [| apply file_permutation]. auto.
  Qed.

  Lemma descending_in l a : In a (descending l) <-> In a l.
  Proof. split; apply Permutation_in; [apply Permutation_sym |]; apply descending_permutation. Qed.

  Definition sorted : list A -> Prop := ForallOrdPairs (fun a b => ltb (f a) (f b) = false).

  Lemma file_sorted a l : sorted l -> sorted (file a l).
  Proof.
    induction 1 as [| b l F S IH]; simpl; [repeat constructor |]. destruct (ltb (f a) (f b)) eqn:L.
    - constructor; auto. rewrite Forall_forall in *. intros c I.
      apply (Permutation_in _ (Permutation_sym (file_permutation a l))) in I as [<- | I]; auto.
      now apply ltb_asym.
    - constructor; [| now constructor]. constructor; auto. rewrite Forall_forall in *. intros c I.
      eapply not_less_trans; eauto.
  Qed.

  Lemma descending_sorted l : sorted (descending l).
  Proof. induction l; simpl; [constructor | now apply file_sorted]. Qed.
End Best.

(** ** Claims *)

(** A record with its dot. *)
Definition Claim : Type := Dot * record.
Definition from (c : Claim) : Dot := match snd c with Edge f _ _ _ => f | _ => ROOT end.
Definition to (c : Claim) : Dot := match snd c with Edge _ t _ _ => t | _ => ROOT end.
Definition label (c : Claim) : Name := match snd c with Edge _ _ l _ => l | _ => ""%string end.
Definition key (c : Claim) : Key := {| key_from := from c; key_to := to c; key_label := label c |}.
(** [STAMP-2] *)
Definition claim_rank (c : Claim) : Rank := rank_of (fst c) (snd c).

(** [VIEW-1.1] In the graph are ROOT and every vertex held. *)
Definition in_graph (X : State) (d : Dot) : bool :=
  is_root d || match get X d with Some (Vertex _ _ _ _) => true | _ => false end.
Definition vertices (X : State) : list Dot :=
  ROOT :: map fst (filter (fun c => match snd c with Vertex _ _ _ _ => true | _ => false end) (records X)).

(** [VIEW-1.1] Visible are the edges held whose ends are both in the graph. (WF-4 has the ends differ; the
    view asks again, and so keeps INV-4 of whatever it is given.) *)
Definition is_visible (X : State) (c : Claim) : bool :=
  match snd c with
  | Edge f t _ _ => negb (eqb f t) && in_graph X f && in_graph X t
  | _ => false
  end.
Definition visible (X : State) : list Claim := filter (is_visible X) (records X).

(** ** What the view reports [VIEW-9] *)

Inductive Rule := SameKey | Functional | RtParent.
Inductive Repair :=
| Superseded (hidden shown : Dot) (rule : Rule)
| CycleBroken (hidden : Dot)
| Detached (vertex : Dot)
| Reattached (vertex : Dot)
| NameClash (name : Name) (shown hidden : Dot)
| Undeclared (write : Dot).

(** [VIEW-4] *)
Inductive Placement := Root | Child (parent edge : Dot) | DetachedTop | Outside.

(** ** Components: whom edges join, whatever their direction *)

Definition look (labels : list (Dot * Dot)) (v : Dot) : Dot :=
  match lookup v labels with Some l => l | None => v end.
Definition unite (edge : Dot * Dot) (labels : list (Dot * Dot)) : list (Dot * Dot) :=
  let a := look labels (fst edge) in
  let b := look labels (snd edge) in
  map (fun p => (fst p, if eq_dec (snd p) a then b else snd p)) labels.
(** Each vertex begins alone; an edge gives all of its source's component the label of its target's. *)
Definition components (vs : list Dot) (edges : list (Dot * Dot)) : list (Dot * Dot) :=
  fold_right unite (map (fun v => (v, v)) vs) edges.

Definition joined (edges : list (Dot * Dot)) : Dot -> Dot -> Prop :=
  clos_refl_sym_trans Dot (fun u v => In (u, v) edges).
Definition ends (c : Claim) : Dot * Dot := (from c, to c).

Section View.
  Context (D : Dictionary).
  (** The dictionary's word on an attribute: its name, and the type of the value. *)
  Context (allows : Name -> N -> bool).

  (** [VIEW-2] [VIEW-6] Symbolic claims: of competing ones the greatest is shown. *)
  Definition symbolic (X : State) : list Claim := filter (fun c => negb (is_RT (label c))) (visible X).
  Definition competitors (X : State) (c : Claim) : list Claim :=
    filter (fun c' => competes D (key c) (snd c')) (symbolic X).
  Definition wins (X : State) (c : Claim) : bool := is_greatest claim_rank (competitors X c) c.
  Definition winners (X : State) : list Claim := filter (wins X) (symbolic X).
  Definition rule_of (c : Claim) : Rule := if functional D (label c) then Functional else SameKey.
  Definition superseded (X : State) : list Repair :=
    flat_map (fun h => if wins X h then [] else
      map (fun s => Superseded (fst h) (fst s) (rule_of h)) (filter (wins X) (competitors X h))) (symbolic X).

  (** [VIEW-3] Kinematic claims, in descending rank, accepted greedily. *)
  Definition kinematic (X : State) : list Claim :=
    descending claim_rank (filter (fun c => is_RT (label c) && negb (is_root (to c))) (visible X)).
  Definition accepted (X : State) : list Claim := Forest.shown eq_dec from to (kinematic X).
  Definition refused (X : State) : list (Claim * reason Claim) := Forest.hidden eq_dec from to (kinematic X).
  Definition refusal (h : Claim * reason Claim) : Repair :=
    match snd h with
    | OtherParent s => Superseded (fst (fst h)) (fst s) RtParent
    | ClosesCycle _ => CycleBroken (fst (fst h))
    end.

  Definition shown (X : State) : list Claim := winners X ++ accepted X.

  (** [VIEW-4] *)
  Definition parent_of (X : State) (v : Dot) : option Claim := parent_claim eq_dec to (accepted X) v.
  Definition has_child (X : State) (v : Dot) : bool := existsb (fun c => eqb (from c) v) (accepted X).
  Definition placement (X : State) (v : Dot) : Placement :=
    if is_root v then Root else
    match parent_of X v with
    | Some c => Child (from c) (fst c)
    | None => if has_child X v then DetachedTop else Outside
    end.
  Definition is_detached (X : State) (v : Dot) : bool :=
    match placement X v with DetachedTop => true | _ => false end.
  Definition in_tree (X : State) (v : Dot) : bool :=
    match placement X v with Outside => false | _ => true end.
  Definition detached (X : State) : list Dot := filter (is_detached X) (vertices X).

  (** [VIEW-5] *)
  Definition labels (X : State) : list (Dot * Dot) := components (vertices X) (map ends (shown X)).
  Definition reattached (X : State) : list Dot :=
    let at_ := look (labels X) in
    let lost := filter (is_detached X) (vertices X) in
    filter (fun v =>
      let own := filter (fun u => eqb (at_ u) (at_ v)) (vertices X) in
      negb (eqb (at_ v) (at_ ROOT)) && forallb (fun u => negb (eqb (at_ u) (at_ v))) lost &&
      is_least (rank X) own v) (vertices X).
  Definition is_stranded (X : State) (v : Dot) : bool :=
    is_detached X v || negb (eqb (look (labels X) v) (look (labels X) ROOT)).
  Definition stranded_vertices (X : State) : list Dot := filter (is_stranded X) (vertices X).

  (** [VIEW-7] *)
  Definition name_of (X : State) (v : Dot) : option Name :=
    match get X v with Some (Vertex _ n _ _) => Some n | _ => None end.
  Definition reserved (n : Name) : bool := eqb n "root"%string || eqb n "world"%string.
  Definition namesakes (X : State) (n : Name) : list Dot :=
    filter (fun v => eqb (name_of X v) (Some n)) (vertices X).
  Definition by_name (X : State) (n : Name) : option Dot :=
    if reserved n then Some ROOT
    else List.find (is_least (rank X) (namesakes X n)) (namesakes X n).
  Definition clashes (X : State) : list Repair :=
    flat_map (fun v =>
      match name_of X v with
      | Some n => match by_name X n with
                  | Some w => if eqb w v then [] else [NameClash n w v]
                  | None => []
                  end
      | None => []
      end) (vertices X).

  (** [VIEW-8] Attributes are looked for on vertices in the graph and on visible edge claims (VIEW-1.1). *)
  Definition is_element (X : State) (d : Dot) : bool :=
    in_graph X d || match get X d with Some x => is_visible X (d, x) | None => false end.
  Definition is_live_write (X : State) (c : Claim) : bool :=
    match snd c with Write t _ _ _ _ => is_element X t | _ => false end.
  Definition declared (c : Claim) : bool :=
    match snd c with Write _ n v _ _ => allows n (value_type v) | _ => false end.
  Definition live_writes (X : State) : list Claim := filter (is_live_write X) (records X).
  Definition shown_writes (X : State) : list Claim := filter declared (live_writes X).
  (** All writes of an attribute, the greatest first, and the winner. *)
  Definition attribute_writes (X : State) (target : Dot) (name : Name) : list Claim :=
    descending claim_rank (filter (fun c => writes target name (snd c)) (shown_writes X)).
  Definition attribute (X : State) (target : Dot) (name : Name) : option Claim :=
    hd_error (attribute_writes X target name).
  Definition undeclared (X : State) : list Claim := filter (fun c => negb (declared c)) (live_writes X).

  Definition repairs (X : State) : list Repair :=
    superseded X ++ map refusal (refused X) ++ map Detached (detached X) ++ map Reattached (reattached X)
    ++ clashes X ++ map (fun c => Undeclared (fst c)) (undeclared X).

  (** The view, as one value. *)
  Record View := {
    view_vertices : list Dot; view_edges : list Claim; view_placement : list (Dot * Placement);
    view_stranded : list Dot; view_names : list (Dot * option Dot); view_writes : list Claim;
    view_repairs : list Repair
  }.
  Definition view (X : State) : View := {|
    view_vertices := vertices X;
    view_edges := shown X;
    view_placement := map (fun v => (v, placement X v)) (vertices X);
    view_stranded := stranded_vertices X;
    view_names := map (fun v => (v, match name_of X v with Some n => by_name X n | None => None end)) (vertices X);
    view_writes := shown_writes X;
    view_repairs := repairs X
  |}.

  (** [VIEW-1] The view is total, as every function here; and what it shows depends on the records held and on
      nothing else: not on how the state came about, nor on its context. *)
  Theorem view_deterministic X Y : (forall d, get X d = get Y d) -> view X = view Y.
  Proof.
    intros E. apply fmap_ext in E. destruct X as [s c], Y as [s' c']; simpl in E; subst s'. reflexivity.
  Qed.

  (** ** What is visible *)

  Lemma in_records X (c : Claim) : In c (records X) <-> get X (fst c) = Some (snd c).
  Proof. destruct c. apply records_get. Qed.

  Lemma vertices_in X v : In v (vertices X) <-> in_graph X v = true.
  Proof.
    unfold vertices, in_graph. rewrite orb_true_iff. unfold is_root. rewrite eqb_eq. simpl.
    rewrite in_map_iff. split.
    - intros [<- | (c & <- & I)]; auto. right. apply filter_In in I as [I E].
      apply in_records in I. now rewrite I.
    - intros [-> | E]; auto. right. destruct (get X v) as [x |] eqn:G; [| easy].
      exists (v, x). split; auto. apply filter_In. split; auto. now apply in_records.
  Qed.

  Lemma visible_in X c : In c (visible X) <->
    get X (fst c) = Some (snd c) /\ (exists s, snd c = Edge (from c) (to c) (label c) s) /\
    from c <> to c /\ in_graph X (from c) = true /\ in_graph X (to c) = true.
  Proof.
    unfold visible. rewrite filter_In, in_records. unfold is_visible, from, to, label.
    destruct (snd c) as [| f t l s |] eqn:E.
    - split; [easy |]. now intros (_ & (s & F) & _).
    - rewrite !andb_true_iff, negb_true_iff, eqb_neq. split.
      + intros (G & (N & F) & T). repeat split; auto. now exists s.
      + intros (G & _ & N & F & T). auto.
    - split; [easy |]. now intros (_ & (s & F) & _).
  Qed.

  Lemma same_dot X c c' : In c (records X) -> In c' (records X) -> fst c = fst c' -> c = c'.
  Proof. rewrite !in_records. destruct c, c'; simpl. intros G G' <-. congruence. Qed.

  Lemma same_rank X c c' : In c (records X) -> In c' (records X) ->
    ltb (claim_rank c) (claim_rank c') = false -> ltb (claim_rank c') (claim_rank c) = false -> c = c'.
  Proof.
    intros I I' L L'. apply (same_dot X); auto. pose proof (ltb_total _ _ L L') as E.
    unfold claim_rank, rank_of in E. congruence.
  Qed.

  Lemma visible_records X c : In c (visible X) -> In c (records X).
  Proof. now intros [I _]%filter_In. Qed.

  Lemma symbolic_in X c : In c (symbolic X) <-> In c (visible X) /\ is_RT (label c) = false.
  Proof. unfold symbolic. now rewrite filter_In, negb_true_iff. Qed.

  Lemma kinematic_in X c :
    In c (kinematic X) <-> In c (visible X) /\ is_RT (label c) = true /\ to c <> ROOT.
  Proof.
    unfold kinematic. rewrite descending_in, filter_In, andb_true_iff, negb_true_iff.
    unfold is_root. now rewrite eqb_neq.
  Qed.

  Lemma accepted_kinematic X c : In c (accepted X) -> In c (kinematic X).
  Proof.
    intros I. eapply Permutation_in; [apply Permutation_sym, (shown_or_hidden eq_dec from to) |].
    apply in_app_iff. now left.
  Qed.

  Lemma shown_visible X c : In c (shown X) -> In c (visible X).
  Proof.
    unfold shown. rewrite in_app_iff. intros [I | I].
    - apply filter_In in I as [I _]. now apply symbolic_in in I.
    - now apply accepted_kinematic, kinematic_in in I.
  Qed.

  (** The shown RT edges are the accepted claims. *)
  Lemma shown_RT X c : In c (shown X) /\ is_RT (label c) = true <-> In c (accepted X).
  Proof.
    unfold shown. rewrite in_app_iff. split.
    - intros [[I | I] R]; auto. apply filter_In in I as [I _]. apply symbolic_in in I as [_ N]. congruence.
    - intros I. split; auto. now apply accepted_kinematic, kinematic_in in I.
  Qed.

  (** ** Nothing dangles [INV-2], no self-loops [INV-4], nothing enters ROOT *)

  Theorem no_dangling_edge X c : In c (shown X) ->
    get X (fst c) = Some (snd c) /\ In (from c) (vertices X) /\ In (to c) (vertices X).
  Proof. intros I. apply shown_visible, visible_in in I. rewrite !vertices_in. tauto. Qed.

  Theorem no_dangling_write X c : In c (shown_writes X) ->
    exists target, In target (anchors (snd c)) /\
      (In target (vertices X) \/ exists x, get X target = Some x /\ In (target, x) (visible X)).
  Proof.
    intros [[I L]%filter_In _]%filter_In. unfold is_live_write in L.
    destruct (snd c) as [| | t n v z s]; try easy. exists t. split; [now left |].
    apply orb_prop in L as [G | V]; [left; now apply vertices_in | right].
    destruct (get X t) as [x |] eqn:G; [| easy]. exists x. split; auto.
    apply filter_In. split; auto. now apply in_records.
  Qed.

  Theorem no_self_loop X c : In c (shown X) -> from c <> to c.
  Proof. intros I. apply shown_visible, visible_in in I. tauto. Qed.

  Theorem nothing_enters_root X c : In c (shown X) -> is_RT (label c) = true -> to c <> ROOT.
  Proof.
    intros I R. assert (A : In c (accepted X)) by now apply shown_RT.
    now apply accepted_kinematic, kinematic_in in A.
  Qed.

  (** ** The kinematic tree [INV-3] [VIEW-3] [VIEW-4] *)

  (** Taken in descending rank. *)
  Theorem kinematic_sorted X : sorted claim_rank (kinematic X).
  Proof. apply descending_sorted. Qed.

  Theorem kinematic_forest X : forest eq_dec from to (accepted X).
  Proof. apply shown_forest. Qed.

  (** [INV-3] Unique parents and no cycle, whatever the direction. *)
  Theorem unique_parent X c c' : In c (shown X) -> In c' (shown X) ->
    is_RT (label c) = true -> is_RT (label c') = true -> to c = to c' -> c = c'.
  Proof.
    intros I I' R R' E. assert (A : In c (accepted X)) by now apply shown_RT.
    assert (A' : In c' (accepted X)) by now apply shown_RT.
    destruct (proj1 (forest_iff eq_dec from to _) (kinematic_forest X)) as [U _].
    clear - A A' E U. unfold unique_parents in U. induction (accepted X) as [| a l IH]; [easy |].
    inversion U as [| ? ? N U']; subst. destruct A as [-> | A], A' as [-> | A']; auto.
    - exfalso. apply N. rewrite E. now apply in_map.
    - exfalso. apply N. rewrite <- E. now apply in_map.
  Qed.

  Theorem kinematic_acyclic X : acyclic from to (accepted X) /\ acyclic_undirected from to (accepted X).
  Proof.
    split; [eapply forest_iff | eapply forest_iff_undirected]; apply kinematic_forest.
  Qed.

  Lemma parent_of_child X v c : parent_of X v = Some c -> In c (accepted X) /\ to c = v.
  Proof. intros P. now apply parent_claim_some in P. Qed.

  Lemma parent_of_none X v : parent_of X v = None <-> forall c, In c (accepted X) -> to c <> v.
  Proof. now apply (parent_claim_none eq_dec to). Qed.

  Lemma has_child_iff X v : has_child X v = true <-> exists c, In c (accepted X) /\ from c = v.
  Proof. unfold has_child. rewrite existsb_exists. now setoid_rewrite eqb_eq. Qed.

  (** [VIEW-4] Each vertex is exactly one of four. *)
  Theorem placement_spec X v :
    match placement X v with
    | Root => v = ROOT
    | Child p e => v <> ROOT /\ exists c, In c (accepted X) /\ fst c = e /\ from c = p /\ to c = v
    | DetachedTop => v <> ROOT /\ (forall c, In c (accepted X) -> to c <> v) /\
                     exists c, In c (accepted X) /\ from c = v
    | Outside => v <> ROOT /\ forall c, In c (accepted X) -> to c <> v /\ from c <> v
    end.
  Proof.
    unfold placement. destruct (is_root v) eqn:R; [now apply eqb_eq |]. apply eqb_neq in R.
    destruct (parent_of X v) as [c |] eqn:P.
    - apply parent_of_child in P as [I E]. split; auto. exists c. auto.
    - rewrite parent_of_none in P. destruct (has_child X v) eqn:C.
      + apply has_child_iff in C. auto.
      + split; auto. intros c I. split; auto. intros E.
        rewrite (proj2 (has_child_iff X v)) in C by eauto. discriminate.
  Qed.

  Lemma is_detached_iff X v : is_detached X v = true <->
    v <> ROOT /\ (forall c, In c (accepted X) -> to c <> v) /\ exists c, In c (accepted X) /\ from c = v.
  Proof.
    unfold is_detached. pose proof (placement_spec X v) as P.
    destruct (placement X v); (split; [try easy | intros (N & M & c & I & E)]); auto.
    - destruct P as (_ & c' & I' & _ & _ & E'). now apply M in I'.
    - destruct P as [_ P]. now apply P in I.
  Qed.

  Lemma detached_in X v : In v (detached X) <-> is_detached X v = true.
  Proof.
    unfold detached. rewrite filter_In. split; [tauto |]. intros P. split; auto. apply vertices_in.
    apply is_detached_iff in P as (_ & _ & c & I & <-). apply accepted_kinematic, kinematic_in in I as [I _].
    now apply visible_in in I.
  Qed.

  Lemma reported_detached X v : In (Detached v) (repairs X) <-> is_detached X v = true.
  Proof.
    rewrite <- detached_in. unfold repairs. rewrite !in_app_iff, !in_map_iff. split.
    - intros [I | [I | [I | [I | [I | I]]]]].
      + apply in_flat_map in I as (c & _ & I). destruct wins; [easy |]. now apply in_map_iff in I as (? & ? & _).
      + destruct I as ((c & []) & E & _); easy.
      + now destruct I as (w & [= <-] & I).
      + now destruct I as (w & ? & _).
      + apply in_flat_map in I as (w & _ & I). destruct name_of; [| easy]. destruct by_name; [| easy].
        destruct eqb; [easy |]. destruct I as [| []]; easy.
      + now destruct I as (w & ? & _).
    - intros I. right; right; left. eauto.
  Qed.

  (** [INV-3] Every way up ends at ROOT or at a reported detached vertex, which hangs from ROOT. *)
  Theorem way_up_ends X v : in_tree X v = true ->
    exists t, up from to (accepted X) v t /\ (t = ROOT \/ In (Detached t) (repairs X)).
  Proof.
    intros T. exists (top eq_dec from to (accepted X) v). pose proof (kinematic_forest X) as F.
    split; [now apply up_to_top |]. destruct (eq_dec (top eq_dec from to (accepted X) v) ROOT) as [-> | N]; auto.
    right. apply reported_detached, is_detached_iff. split; [auto | split].
    - intros c I. now apply top_has_no_parent.
    - pose proof (up_to_top v F) as U. apply clos_rt_rtn1 in U.
      inversion U as [E | y z (c & I & _ & E) _]; [| now exists c].
      unfold in_tree in T. pose proof (placement_spec X v) as P. destruct (placement X v).
      + congruence.
      + destruct P as (_ & c & I & _ & _ & E'). exfalso.
        apply (top_has_no_parent v c F I). congruence.
      + destruct P as (_ & _ & c & I & E'). exists c. split; auto. congruence.
      + easy.
  Qed.

  (** [INV-3] The shown RT edges together with the reported detachments are one tree: their relation has
      unique parents and no cycle, its only top is ROOT. *)
  Definition tree_edges (X : State) : list (Dot * Dot) :=
    map (fun v => (ROOT, v)) (nodup eq_dec (detached X)) ++ map ends (accepted X).

  Lemma tree_step X u w : step fst snd (tree_edges X) u w <->
    step from to (accepted X) u w \/ (w = ROOT /\ is_detached X u = true).
  Proof.
    unfold step, tree_edges. setoid_rewrite in_app_iff. split.
    - intros (e & [I | I] & <- & <-); apply in_map_iff in I as (c & <- & I); simpl.
      + right. split; auto. now apply detached_in, (nodup_In eq_dec).
      + left. exists c. auto.
    - intros [(c & I & <- & <-) | [-> I]].
      + exists (ends c). split; auto. right. now apply in_map.
      + exists (ROOT, u). split; auto. left. apply in_map_iff. exists u. split; auto.
        now apply nodup_In, detached_in.
  Qed.

  Lemma root_has_no_parent X w : ~ step fst snd (tree_edges X) ROOT w.
  Proof.
    rewrite tree_step. intros [(c & I & E & _) | [_ I]].
    - apply accepted_kinematic, kinematic_in in I. tauto.
    - apply is_detached_iff in I. tauto.
  Qed.

  Theorem one_tree_rooted_at_root X :
    unique_parents snd (tree_edges X) /\ acyclic fst snd (tree_edges X) /\
    forall v, in_tree X v = true -> up fst snd (tree_edges X) v ROOT.
  Proof.
    destruct (proj1 (forest_iff eq_dec from to _) (kinematic_forest X)) as [U A]. split; [| split].
    - unfold unique_parents, tree_edges. rewrite map_app, !map_map. simpl. rewrite map_id.
      assert (G : forall l l' : list Dot, NoDup l -> NoDup l' -> (forall x, In x l -> ~ In x l') -> NoDup (l ++ l')).
      { intros l l' N N' S. induction N as [| x l Hx N IH]; simpl; auto. constructor.
        - rewrite in_app_iff. intros [I | I]; [auto | apply (S x); simpl; auto].
        - apply IH. intros y I. apply S. now right. }
      apply G; [apply NoDup_nodup | exact U |].
      intros v I J. apply nodup_In, detached_in, is_detached_iff in I as (_ & N & _).
      apply in_map_iff in J as (c & E & J). now apply N in J.
    - assert (R : forall u w, clos_trans Dot (step fst snd (tree_edges X)) u w -> u <> ROOT).
      { intros u w T. apply clos_trans_t1n in T. destruct T as [y S | y z S _]; intros ->;
          now apply root_has_no_parent in S. }
      assert (K : forall u w, clos_trans Dot (step fst snd (tree_edges X)) u w ->
                  clos_trans Dot (step from to (accepted X)) u w \/ w = ROOT).
      { induction 1 as [u w S | u w z T1 I1 T2 I2].
        - apply tree_step in S as [S | [-> _]]; [left; now apply t_step | now right].
        - destruct I1 as [I1 | ->]; [| now apply R in T2]. destruct I2 as [I2 | ->]; auto.
          left. eapply t_trans; eauto. }
      intros v T. pose proof (R _ _ T). apply K in T as [T |]; [| auto]. now apply A in T.
    - intros v T. destruct (way_up_ends X v T) as (t & W & E).
      assert (L : up fst snd (tree_edges X) v t).
      { clear - W. induction W as [u w S | |]; [apply rt_step, tree_step; auto | apply rt_refl |].
        eapply rt_trans; eauto. }
      destruct E as [-> | E]; auto. eapply rt_trans; [exact L |]. apply rt_step, tree_step. right.
      split; auto. now apply reported_detached.
  Qed.

  (** [VIEW-3] No hidden kinematic claim could be added to those accepted. *)
  Theorem maximal X h why : In (h, why) (refused X) -> ~ forest eq_dec from to (h :: accepted X).
  Proof. apply acceptance_maximal. Qed.

  (** [VIEW-3] Every kinematic claim is shown, or hidden for the reason reported. *)
  Theorem kinematic_shown_or_refused X c : In c (kinematic X) ->
    In c (accepted X) \/ exists why, In (c, why) (refused X).
  Proof.
    intros I. apply (Permutation_in _ (shown_or_hidden eq_dec from to (kinematic X))) in I.
    apply in_app_iff in I as [I | I]; [auto | right]. apply in_map_iff in I as ([c' why] & <- & I). eauto.
  Qed.

  (** [VIEW-3] [VIEW-9] Why a kinematic claim is hidden: one shown, of greater rank, is its child's parent; or
      others shown, all of greater rank, join its two ends. *)
  Theorem refused_has_cause X h why : In (h, why) (refused X) ->
    match why with
    | OtherParent s =>
        In s (accepted X) /\ to s = to h /\ ltb (claim_rank s) (claim_rank h) = false
    | ClosesCycle _ => exists greater, incl greater (accepted X) /\
        Forall (fun s => ltb (claim_rank s) (claim_rank h) = false) greater /\
        connected from to greater (from h) (to h)
    end.
  Proof.
    intros I. destruct (hidden_has_cause eq_dec from to _ _ _ I) as (b & a & E & C).
    assert (G : forall s, In s (Forest.shown eq_dec from to b) -> ltb (claim_rank s) (claim_rank h) = false).
    { intros s J. assert (Hb : In s b).
      { eapply Permutation_in; [apply Permutation_sym, (shown_or_hidden eq_dec from to) |].
        apply in_app_iff. now left. }
      pose proof (kinematic_sorted X) as S. unfold sorted in S. rewrite E in S. clear - S Hb.
      induction b as [| x b IH]; [easy |]. simpl in S. inversion S as [| ? ? F S']; subst.
      destruct Hb as [<- | Hb]; [| now apply IH]. rewrite Forall_forall in F. apply F, in_app_iff. simpl. auto. }
    destruct why as [s |].
    - destruct C as (Hb & Hs & T). auto.
    - destruct C as [_ C]. exists (Forest.shown eq_dec from to b). repeat split; auto.
      + intros s J. unfold accepted. rewrite E. unfold Forest.shown. rewrite grow_app. now apply grow_keeps.
      + now apply Forall_forall.
  Qed.

  (** ** Paths to ROOT [INV-1] [VIEW-5] *)

  Lemma lookup_map (g : Dot -> Dot) (l : list (Dot * Dot)) v :
    lookup v (map (fun p => (fst p, g (snd p))) l) = option_map g (lookup v l).
  Proof. induction l as [| [a b] l IH]; simpl; auto. now destruct (eqb v a). Qed.

  Lemma lookup_some {V} v (l : list (Dot * V)) : In v (map fst l) -> exists b, lookup v l = Some b.
  Proof.
    induction l as [| [a b] l IH]; simpl; [easy |]. intros I. destruct (eqb v a) eqn:E; [eauto |].
    apply eqb_neq in E. apply IH. intuition congruence.
  Qed.

  Lemma lookup_listed {V} v b (l : list (Dot * V)) : lookup v l = Some b -> In v (map fst l).
  Proof.
    induction l as [| [a c] l IH]; simpl; [easy |]. destruct (eqb v a) eqn:E; auto.
    apply eqb_eq in E. auto.
  Qed.

  Lemma unite_keys e l : map fst (unite e l) = map fst l.
  Proof. unfold unite. now rewrite map_map. Qed.

  (** Two vertices have one label exactly if edges join them. *)
  Theorem components_spec vs edges :
    (forall e, In e edges -> In (fst e) vs /\ In (snd e) vs) ->
    forall u v, look (components vs edges) u = look (components vs edges) v <-> joined edges u v.
  Proof.
    intros B.
    enough (G : (forall v, In v vs <-> In v (map fst (components vs edges))) /\
                (forall v, In v vs -> In (look (components vs edges) v) vs) /\
                (forall u v, look (components vs edges) u = look (components vs edges) v <-> joined edges u v))
      by tauto.
    induction edges as [| e edges IH].
    - assert (L : forall v, look (components vs []) v = v).
      { intros v. unfold look, components. simpl. destruct (lookup v _) as [b |] eqn:E; auto.
        clear -E. induction vs as [| a l IH]; simpl in E; [easy |].
        destruct (eqb v a) eqn:F; auto. apply eqb_eq in F. congruence. }
      split; [| split].
      + intros v. unfold components. simpl. rewrite map_map. simpl. now rewrite map_id.
      + intros v. now rewrite L.
      + intros u v. rewrite !L. split; [intros <-; apply rst_refl |].
        intros J. induction J; congruence || easy.
    - destruct IH as (K & R & S); [intros e' I; apply B; now right |].
      destruct (B e (or_introl eq_refl)) as [Ba Bb].
      set (f := look (components vs edges)) in *.
      assert (L : forall v, look (components vs (e :: edges)) v =
                  if eq_dec (f v) (f (fst e)) then f (snd e) else f v).
      { intros v. change (components vs (e :: edges)) with (unite e (components vs edges)).
        unfold look at 1, unite. fold f.
        rewrite lookup_map with (g := fun b => if eq_dec b (f (fst e)) then f (snd e) else b).
        destruct (lookup v (components vs edges)) as [b |] eqn:E.
        - simpl. assert (Fv : f v = b) by (unfold f, look; now rewrite E). now rewrite Fv.
        - assert (Fv : f v = v) by (unfold f, look; now rewrite E). simpl. rewrite Fv.
          destruct (eq_dec v (f (fst e))) as [Q |]; auto. exfalso.
          specialize (R _ Ba). rewrite <- Q in R. apply K, lookup_some in R as [b Lb]. congruence. }
      split; [| split].
      + intros v. rewrite K. change (components vs (e :: edges)) with (unite e (components vs edges)).
        now rewrite unite_keys.
      + intros v I. rewrite L. destruct eq_dec; auto.
      + apply (merge_classes eq_dec) with (R := fun u v => In (u, v) edges) (f := f) (a := fst e) (b := snd e); auto.
        intros u v. simpl. rewrite (surjective_pairing e) at 1. intuition congruence.
  Qed.

  (** [at_ X v] is the label of [v]'s component. *)
  Definition at_ (X : State) : Dot -> Dot := look (labels X).

  Lemma same_component X u v : at_ X u = at_ X v <-> joined (map ends (shown X)) u v.
  Proof.
    apply components_spec. intros e I. apply in_map_iff in I as (c & <- & I).
    apply no_dangling_edge in I. simpl. tauto.
  Qed.

  Lemma reattached_in X v : In v (reattached X) <->
    In v (vertices X) /\ at_ X v <> at_ X ROOT /\
    (forall u, is_detached X u = true -> at_ X u <> at_ X v) /\
    (forall u, In u (vertices X) -> at_ X u = at_ X v -> ltb (rank X u) (rank X v) = false).
  Proof.
    unfold reattached. rewrite filter_In, !andb_true_iff, negb_true_iff, eqb_neq, forallb_forall, is_least_spec.
    fold (at_ X). split.
    - intros (I & (N & H) & L). repeat split; auto.
      + intros u P. apply eqb_neq, negb_true_iff, H. now apply detached_in.
      + intros u J E. apply L, filter_In. split; auto. now apply eqb_eq.
    - intros (I & N & H & L). repeat split; auto.
      + intros u P. apply detached_in in P. now apply negb_true_iff, eqb_neq, H.
      + intros u P. apply filter_In in P as [P E]. apply eqb_eq in E. auto.
  Qed.

  Lemma reported_reattached X v : In (Reattached v) (repairs X) <-> In v (reattached X).
  Proof.
    unfold repairs. rewrite !in_app_iff, !in_map_iff. split.
    - intros [I | [I | [I | [I | [I | I]]]]].
      + apply in_flat_map in I as (c & _ & I). destruct wins; [easy |]. now apply in_map_iff in I as (? & ? & _).
      + destruct I as ((c & []) & E & _); easy.
      + now destruct I as (w & ? & _).
      + now destruct I as (w & [= <-] & I).
      + apply in_flat_map in I as (w & _ & I). destruct name_of; [| easy]. destruct by_name; [| easy].
        destruct eqb; [easy |]. destruct I as [| []]; easy.
      + now destruct I as (w & ? & _).
    - intros I. do 3 right. left. eauto.
  Qed.

  (** A step of a path: a shown edge, or the link of a repair that is reported. *)
  Definition held_together (X : State) (u v : Dot) : Prop :=
    In (u, v) (map ends (shown X)) \/
    u = ROOT /\ (In (Detached v) (repairs X) \/ In (Reattached v) (repairs X)).

  Lemma joined_held X u v : joined (map ends (shown X)) u v -> clos_refl_sym_trans Dot (held_together X) u v.
  Proof.
    intros J. induction J; [apply rst_step; now left | apply rst_refl | apply rst_sym; auto | eapply rst_trans; eauto].
  Qed.

  (** [INV-1] Every vertex has a path to ROOT over shown edges and reported links, whatever their direction. *)
  Theorem path_to_root X v : In v (vertices X) -> clos_refl_sym_trans Dot (held_together X) v ROOT.
  Proof.
    intros I. destruct (eq_dec (at_ X v) (at_ X ROOT)) as [E | N]; [now apply joined_held, same_component |].
    assert (V : forall u, at_ X u = at_ X v -> held_together X ROOT u ->
                clos_refl_sym_trans Dot (held_together X) v ROOT).
    { intros u E H. eapply rst_trans; [apply joined_held, same_component; symmetry; exact E |].
      apply rst_sym, rst_step, H. }
    destruct (existsb (fun u => eqb (at_ X u) (at_ X v)) (detached X)) eqn:L.
    - apply existsb_exists in L as (u & J & E). apply eqb_eq in E. apply (V u E). right. split; auto. left.
      now apply reported_detached, detached_in.
    - destruct (least_exists (rank X) (filter (fun u => eqb (at_ X u) (at_ X v)) (vertices X))) as (m & M & Lm).
      { intros Z. assert (In v []); [| easy]. rewrite <- Z. apply filter_In. split; auto. apply eqb_refl. }
      apply filter_In in M as [M E]. apply eqb_eq in E. apply (V m E). right. split; auto. right.
      apply reported_reattached, reattached_in. rewrite E. repeat split; auto.
      + intros u P F. apply not_true_iff_false in L. apply L, existsb_exists. exists u. split.
        * now apply detached_in.
        * now apply eqb_eq.
      + intros u J F. rewrite is_least_spec in Lm. apply Lm, filter_In. split; auto. now apply eqb_eq.
  Qed.

  (** [VIEW-5] One vertex of a component is reported: the oldest. *)
  Theorem reattached_once X u v : In u (reattached X) -> In v (reattached X) -> at_ X u = at_ X v -> u = v.
  Proof.
    rewrite !reattached_in. intros (I & N & _ & L) (J & M & _ & K) E.
    pose proof (ltb_total _ _ (L _ J (eq_sym E)) (K _ I E)) as R. unfold rank in R.
    assert (V : forall w, In w (vertices X) -> at_ X w <> at_ X ROOT -> exists x, get X w = Some x).
    { intros w Iw Nw. apply vertices_in in Iw. unfold in_graph, is_root in Iw. apply orb_prop in Iw as [Z | Z].
      - apply eqb_eq in Z. congruence.
      - destruct (get X w); eauto; easy. }
    destruct (V _ I N) as [x Gx], (V _ J M) as [y Gy]. rewrite Gx, Gy in R. now injection R.
  Qed.

  (** [VIEW-5] Stranded is what is detached, or has no path to ROOT over shown edges alone. *)
  Theorem stranded_iff X v : is_stranded X v = true <->
    is_detached X v = true \/ ~ joined (map ends (shown X)) v ROOT.
  Proof.
    unfold is_stranded. rewrite orb_true_iff, negb_true_iff, eqb_neq. fold (at_ X).
    now rewrite same_component.
  Qed.

  (** ** Registers [VIEW-2] [VIEW-6] [INV-6] *)

  Lemma competitors_in X c c' :
    In c' (competitors X c) <-> In c' (symbolic X) /\ competes D (key c) (snd c') = true.
  Proof. apply filter_In. Qed.

  Lemma symbolic_key X c : In c (symbolic X) -> key_of (snd c) = Some (key c).
  Proof. intros I. apply symbolic_in in I as [I _]. apply visible_in in I as (_ & (s & E) & _). now rewrite E. Qed.

  Lemma competes_refl X c : In c (symbolic X) -> competes D (key c) (snd c) = true.
  Proof. intros I. eapply competes_own, symbolic_key, I. Qed.

  Lemma competitors_same X c c' d : In c (symbolic X) -> In c' (symbolic X) ->
    competes D (key c) (snd c') = true -> In d (competitors X c) <-> In d (competitors X c').
  Proof.
    intros I I' C. rewrite !competitors_in. split; intros [J B]; split; auto.
    - eapply competes_trans; [apply (symbolic_key X d J) | apply (symbolic_key X c I) | exact B |].
      now rewrite (competes_sym D _ _ _ _ (symbolic_key X c' I') (symbolic_key X c I)).
    - eapply competes_trans; [apply (symbolic_key X d J) | apply (symbolic_key X c' I') | exact B | exact C].
  Qed.

  Lemma records_symbolic X c : In c (symbolic X) -> In c (records X).
  Proof. intros I. apply symbolic_in in I as [I _]. now apply visible_records. Qed.

  (** [INV-6] [VIEW-2] [VIEW-6] Of competing claims one is shown, *)
  Theorem one_shown X c c' : In c (winners X) -> In c' (winners X) ->
    competes D (key c) (snd c') = true -> c = c'.
  Proof.
    intros [I W]%filter_In [I' W']%filter_In C. unfold wins in *. rewrite is_greatest_spec in *.
    apply (same_rank X); auto using records_symbolic.
    - apply W, competitors_in. auto.
    - apply W', (competitors_same X c c'); auto. apply competitors_in. split; auto. now apply competes_refl with X.
  Qed.

  (** and it is the greatest. *)
  Theorem winner_is_greatest X c c' : In c (winners X) -> In c' (symbolic X) ->
    competes D (key c) (snd c') = true -> ltb (claim_rank c) (claim_rank c') = false.
  Proof.
    intros [I W]%filter_In I' C. unfold wins in W. rewrite is_greatest_spec in W.
    apply W, competitors_in. auto.
  Qed.

  (** Each symbolic claim has a winner that it competes with. *)
  Lemma winner_exists X c : In c (symbolic X) ->
    exists w, In w (winners X) /\ In w (competitors X c) /\ wins X w = true.
  Proof.
    intros I. destruct (greatest_exists claim_rank (competitors X c)) as (w & J & G).
    { intros Z. assert (In c []); [| easy]. rewrite <- Z. apply competitors_in.
      split; auto. now apply competes_refl with X. }
    assert (W : wins X w = true).
    { unfold wins. rewrite is_greatest_spec in *. intros d Hd. apply G.
      apply competitors_in in J as [J C]. now apply (competitors_same X c w d). }
    exists w. repeat split; auto. apply filter_In. split; auto. now apply competitors_in in J.
  Qed.

  (** [VIEW-9] Each symbolic claim is shown, or reported with the greater one that is shown in its place; the
      rule is the label's. *)
  Theorem shown_or_superseded X h : In h (symbolic X) ->
    In h (winners X) \/
    exists s, In s (winners X) /\ competes D (key h) (snd s) = true /\
      ltb (claim_rank h) (claim_rank s) = true /\ In (Superseded (fst h) (fst s) (rule_of h)) (repairs X).
  Proof.
    intros I. destruct (wins X h) eqn:W; [left; now apply filter_In | right].
    destruct (winner_exists X h I) as (s & S & C & Ws). exists s. split; auto.
    pose proof C as C'. apply competitors_in in C as [J C]. repeat split; auto.
    - apply not_false_iff_true. intros L. apply not_true_iff_false in W. apply W. unfold wins in *.
      rewrite is_greatest_spec in *. intros d Hd. eapply not_less_trans; [| apply Ws].
      + destruct (ltb (claim_rank h) (claim_rank s)) eqn:F; auto.
      + now apply (competitors_same X h s d).
    - unfold repairs. rewrite in_app_iff. left. apply in_flat_map. exists h. split; auto. rewrite W.
      apply in_map_iff. exists s. split; auto. now apply filter_In.
  Qed.

  (** ** Names [VIEW-7] *)

  Lemma namesakes_in X n v : In v (namesakes X n) <-> In v (vertices X) /\ name_of X v = Some n.
  Proof. unfold namesakes. now rewrite filter_In, eqb_eq. Qed.

  (** A name finds the oldest of its vertices; the reserved ones find ROOT. *)
  Theorem name_finds_oldest X n : reserved n = false ->
    match by_name X n with
    | Some w => In w (vertices X) /\ name_of X w = Some n /\
        forall v, In v (vertices X) -> name_of X v = Some n -> ltb (rank X v) (rank X w) = false
    | None => forall v, In v (vertices X) -> name_of X v <> Some n
    end.
  Proof.
    intros R. unfold by_name. rewrite R. destruct (List.find _ _) as [w |] eqn:F.
    - apply find_some in F as [I L]. apply namesakes_in in I as [I E]. repeat split; auto.
      rewrite is_least_spec in L. intros v J Ev. apply L, namesakes_in. auto.
    - intros v I E. destruct (least_exists (rank X) (namesakes X n)) as (m & M & L).
      + intros Z. assert (In v []); [| easy]. rewrite <- Z. now apply namesakes_in.
      + apply (find_none _ _ F) in M. congruence.
  Qed.

  Theorem reserved_finds_root X n : reserved n = true -> by_name X n = Some ROOT.
  Proof. unfold by_name. now intros ->. Qed.

  (** ** Attributes [VIEW-8] [INV-5] *)

  Theorem shown_writes_declared X c : In c (shown_writes X) -> declared c = true.
  Proof. now intros [_ E]%filter_In. Qed.

  Lemma attribute_writes_in X t n c :
    In c (attribute_writes X t n) <-> In c (shown_writes X) /\ writes t n (snd c) = true.
  Proof. unfold attribute_writes. now rewrite descending_in, filter_In. Qed.

  Theorem attribute_writes_sorted X t n : sorted claim_rank (attribute_writes X t n).
  Proof. apply descending_sorted. Qed.

  (** Readers get the greatest write of an attribute, if there is one; it is the only greatest. *)
  Theorem attribute_is_greatest X t n :
    match attribute X t n with
    | Some c => In c (shown_writes X) /\ writes t n (snd c) = true /\
        forall c', In c' (shown_writes X) -> writes t n (snd c') = true -> c' <> c ->
          ltb (claim_rank c') (claim_rank c) = true
    | None => forall c, In c (shown_writes X) -> writes t n (snd c) = false
    end.
  Proof.
    unfold attribute. pose proof (attribute_writes_sorted X t n) as S.
    pose proof (attribute_writes_in X t n) as M. destruct (attribute_writes X t n) as [| c l]; simpl.
    - intros c I. apply not_true_iff_false. intros W. now apply (M c).
    - destruct (proj1 (M c) (or_introl eq_refl)) as [I W]. repeat split; auto. intros c' I' W' N.
      destruct (proj2 (M c') (conj I' W')) as [-> | J]; [easy |].
      inversion S as [| ? ? F _]; subst. rewrite Forall_forall in F. specialize (F _ J).
      apply not_false_iff_true. intros L. apply N. apply (same_rank X); auto;
        eapply proj1, filter_In, proj1, filter_In; eassumption.
  Qed.

  (** ** No needless repair [VIEW-10], and none is silent [VIEW-9] *)

  (** What claims can break, said of the visible claims as they are: VIEW-9 lists the six. *)
  Record unbroken (X : State) : Prop := {
    one_edge_each_register : forall c c', In c (symbolic X) -> In c' (symbolic X) ->
      competes D (key c) (snd c') = true -> c = c';
    one_kinematic_parent : forall c c', In c (kinematic X) -> In c' (kinematic X) -> to c = to c' -> c = c';
    one_kinematic_tree : forall c, In c (kinematic X) -> up from to (kinematic X) (from c) ROOT;
    all_paths : forall v, In v (vertices X) -> joined (map ends (visible X)) v ROOT;
    one_vertex_each_name : forall v w n, In v (vertices X) -> In w (vertices X) ->
      name_of X v = Some n -> name_of X w = Some n -> v = w /\ reserved n = false;
    all_declared : forall c, In c (live_writes X) -> declared c = true
  }.

  (** WF-4, of which INV-4 is a part. *)
  Definition right_ends : State -> Prop := each_record edge_ends.

  Lemma visible_split X c : right_ends X -> In c (visible X) -> In c (symbolic X) \/ In c (kinematic X).
  Proof.
    intros E I. rewrite symbolic_in, kinematic_in. destruct (is_RT (label c)) eqn:R; [right | left]; auto.
    repeat split; auto. apply visible_in in I as (G & (s & F) & _). apply E in G. rewrite F in G.
    apply eqb_eq in R. now apply G.
  Qed.

  Lemma flat_map_nil {A B} (f : A -> list B) l : flat_map f l = [] <-> forall a, In a l -> f a = [].
  Proof.
    induction l as [| a l IH]; simpl; [easy |]. split.
    - intros [E F]%app_eq_nil b [<- | I]; auto. now apply IH.
    - intros E. rewrite (E a) by auto. apply IH. auto.
  Qed.

  Lemma filter_nil {A} (p : A -> bool) l : filter p l = [] <-> forall a, In a l -> p a = false.
  Proof.
    induction l as [| a l IH]; simpl; [easy |]. destruct (p a) eqn:P; split; try easy.
    - intros F. now rewrite (F a) in P by auto.
    - intros E b [<- | I]; auto. now apply IH.
    - intros F. apply IH. auto.
  Qed.

  Lemma map_nil {A B} (f : A -> B) l : map f l = [] <-> l = [].
  Proof. now destruct l. Qed.

  Lemma nodup_map {A B} (f : A -> B) l : NoDup l ->
    (forall a b, In a l -> In b l -> f a = f b -> a = b) -> NoDup (map f l).
  Proof.
    induction 1 as [| a l N U IH]; simpl; intros J; constructor.
    - rewrite in_map_iff. intros (b & E & I). apply N. rewrite <- (J b a); auto.
    - apply IH. intros; apply J; auto.
  Qed.

  Lemma records_nodup X : NoDup (records X).
  Proof. eapply NoDup_map_inv. apply (keys_nodup (store X)). Qed.

  Lemma kinematic_nodup X : NoDup (kinematic X).
  Proof.
    eapply Permutation_NoDup; [apply descending_permutation |]. repeat apply NoDup_filter. apply records_nodup.
  Qed.

  Lemma no_up_from_root X w : ~ step from to (kinematic X) ROOT w.
  Proof. intros (c & I & E & _). apply kinematic_in in I. tauto. Qed.

  (** Ways up that end at ROOT, with one parent each, make no cycle. *)
  Lemma rooted_acyclic X : unbroken X -> acyclic from to (kinematic X).
  Proof.
    intros U v T.
    assert (F : forall u w w', step from to (kinematic X) u w -> step from to (kinematic X) u w' -> w = w').
    { intros u w w' (c & I & E & <-) (c' & I' & E' & <-). now rewrite (one_kinematic_parent X U c c') by congruence. }
    assert (G : forall u, up from to (kinematic X) u ROOT -> ~ clos_trans Dot (step from to (kinematic X)) u u).
    { intros u H. apply clos_rt_rt1n in H. remember ROOT as t eqn:Z. induction H as [u | u w t S H IH].
      - subst. intros C. apply clos_trans_t1n in C. destruct C; eapply no_up_from_root; eauto.
      - intros C. apply (IH Z). apply clos_trans_t1n in C. inversion C as [y S' | y z S' C']; subst.
        + rewrite (F _ _ _ S S') in *. apply t_step. congruence.
        + rewrite (F _ _ _ S S') in *. apply clos_t1n_trans in C'. eapply t_trans; [exact C' |]. now apply t_step. }
    apply (G v); auto. apply clos_trans_t1n in T.
    assert (S : exists w, step from to (kinematic X) v w) by (inversion T; eauto).
    destruct S as (w & c & I & <- & E). eapply rt_trans; [| apply (one_kinematic_tree X U c I)].
    apply rt_step. exists c. auto.
  Qed.

  Lemma kinematic_unique X : unbroken X -> unique_parents to (kinematic X).
  Proof. intros U. apply nodup_map; [apply kinematic_nodup | apply U]. Qed.

  (** All claims are shown as they are. *)
  Lemma all_win X c : unbroken X -> In c (symbolic X) -> In c (winners X).
  Proof.
    intros U I. apply filter_In. split; auto. apply is_greatest_spec. intros d [J C]%competitors_in.
    rewrite <- (one_edge_each_register X U c d) by auto. apply ltb_irrefl.
  Qed.

  Lemma all_accepted X : unbroken X -> accepted X = rev (kinematic X) /\ refused X = [].
  Proof. intros U. apply nothing_hidden; [now apply kinematic_unique | now apply rooted_acyclic]. Qed.

  (** [VIEW-10] If the visible claims break nothing, the view shows them all, *)
  Theorem unbroken_shows_all X c : right_ends X -> unbroken X -> In c (visible X) -> In c (shown X).
  Proof.
    intros E U I. unfold shown. apply in_app_iff. destruct (visible_split X c E I) as [S | K].
    - left. now apply all_win.
    - right. rewrite (proj1 (all_accepted X U)). now apply -> in_rev.
  Qed.

  Theorem unbroken_shows_all_writes X : unbroken X -> shown_writes X = live_writes X.
  Proof.
    intros U. pose proof (all_declared X U) as A. unfold shown_writes.
    induction (live_writes X) as [| c l IH]; simpl; auto. rewrite A by now left.
    f_equal. apply IH. intros; apply A. now right.
  Qed.

  Lemma named_finds X v n : In v (vertices X) -> name_of X v = Some n -> exists w, by_name X n = Some w.
  Proof.
    intros I E. destruct (reserved n) eqn:R; [exists ROOT; now apply reserved_finds_root |].
    pose proof (name_finds_oldest X n R) as F. destruct (by_name X n); eauto. now apply F in E.
  Qed.

  (** and reports nothing. *)
  Theorem unbroken_reports_nothing X : right_ends X -> unbroken X -> repairs X = [].
  Proof.
    intros E U. destruct (all_accepted X U) as [A R]. unfold repairs.
    assert (P : forall v, is_detached X v = false).
    { intros v. apply not_true_iff_false. rewrite is_detached_iff. intros (N & P & c & I & F).
      rewrite A in P, I. apply in_rev in I. pose proof (one_kinematic_tree X U c I) as W. rewrite F in W.
      apply clos_rt_rt1n in W. destruct W as [| w t (d & J & G & _) _]; [easy |]. apply (P d); auto.
      now apply -> in_rev. }
    assert (Z : superseded X = []).
    { apply flat_map_nil. intros h I. apply (all_win X h U), filter_In in I as [_ W]. now rewrite W. }
    rewrite Z, R. simpl. assert (Dt : detached X = []) by (apply filter_nil; auto). rewrite Dt. simpl.
    assert (Rt : reattached X = []).
    { destruct (reattached X) as [| v l] eqn:L; auto.
      assert (I : In v (reattached X)) by (rewrite L; now left). apply reattached_in in I as (I & N & _).
      exfalso. apply N. apply same_component. pose proof (all_paths X U v I) as J.
      clear -E U J. induction J as [u w I | | |];
        [| apply rst_refl | apply rst_sym; auto | eapply rst_trans; eauto].
      apply rst_step. apply in_map_iff in I as (c & <- & I). apply in_map_iff. exists c. split; auto.
      now apply unbroken_shows_all. }
    rewrite Rt. simpl. assert (Cl : clashes X = []).
    { apply flat_map_nil. intros v I. destruct (name_of X v) as [n |] eqn:Ev; auto.
      destruct (one_vertex_each_name X U v v n) as [_ Rn]; auto.
      pose proof (name_finds_oldest X n Rn) as F. destruct (by_name X n) as [w |]; auto.
      destruct F as (J & Ew & _). rewrite (proj1 (one_vertex_each_name X U w v n J I Ew Ev)).
      now rewrite eqb_refl. }
    rewrite Cl. simpl. apply map_nil, filter_nil. intros c I. apply negb_false_iff. now apply U.
  Qed.

  (** [VIEW-9] A repair is never silent: what reports nothing breaks nothing. (ROOT has no record: STATE-4.) *)
  Theorem silent_only_if_unbroken X : get X ROOT = None -> repairs X = [] -> unbroken X.
  Proof.
    intros NR Z. unfold repairs in Z.
    apply app_eq_nil in Z as [Zs Z]. apply app_eq_nil in Z as [Zk Z]. apply app_eq_nil in Z as [Zd Z].
    apply app_eq_nil in Z as [Zr Z]. apply app_eq_nil in Z as [Zc Zu]. apply map_nil in Zk, Zd, Zr, Zu.
    assert (Win : forall c, In c (symbolic X) -> wins X c = true).
    { intros c I. apply not_false_iff_true. intros W. apply flat_map_nil with (a := c) in Zs; auto.
      rewrite W in Zs. apply map_nil in Zs. destruct (winner_exists X c I) as (w & _ & J & Ww).
      pose proof (proj2 (filter_In (wins X) w (competitors X c)) (conj J Ww)) as Q. now rewrite Zs in Q. }
    destruct (nothing_hidden_only_if eq_dec from to _ Zk) as [Up Ac].
    destruct (nothing_hidden eq_dec Up Ac) as [A _]. fold (accepted X) in A.
    assert (ND : forall v, ~ In (Detached v) (repairs X)).
    { intros v I. apply reported_detached, detached_in in I. now rewrite Zd in I. }
    split.
    - intros c c' I I' C. apply one_shown with X; auto; apply filter_In; auto.
    - intros c c' I I' E. rewrite in_rev, <- A, <- shown_RT in I, I'.
      apply unique_parent with X; tauto.
    - intros c I. destruct (way_up_ends X (from c)) as (t & W & [-> | T]); [| | now apply ND in T].
      + unfold in_tree. pose proof (placement_spec X (from c)) as P. destruct (placement X (from c)); auto.
        destruct P as [_ P]. destruct (P c) as [_ N]; [rewrite A, <- in_rev; auto | easy].
      + eapply up_incl; [| exact W]. intros d. rewrite A. apply in_rev.
    - intros v I. apply path_to_root in I. clear - I ND Zr. induction I as [u w [I | [_ [T | T]]] | | |].
      + apply rst_step. apply in_map_iff in I as (c & <- & I). apply in_map, shown_visible, I.
      + now apply ND in T.
      + apply reported_reattached in T. now rewrite Zr in T.
      + apply rst_refl.
      + now apply rst_sym.
      + eapply rst_trans; eauto.
    - assert (F : forall v n, In v (vertices X) -> name_of X v = Some n -> by_name X n = Some v).
      { intros v n I E. destruct (named_finds X v n I E) as (w & B).
        apply flat_map_nil with (a := v) in Zc; auto. rewrite E, B in Zc. destruct (eqb w v) eqn:Q; [| easy].
        apply eqb_eq in Q. congruence. }
      intros v w n I J Ev Ew. split.
      + apply F in Ev; auto. apply F in Ew; auto. congruence.
      + apply not_true_iff_false. intros Rn. apply (reserved_finds_root X) in Rn. rewrite (F v n I Ev) in Rn.
        injection Rn as ->. unfold name_of in Ev. now rewrite NR in Ev.
    - intros c I. apply filter_nil with (a := c) in Zu; auto. now apply negb_false_iff.
  Qed.

  (** [VIEW-9] [VIEW-10] The view reports a repair exactly where the claims break something. *)
  Theorem repairs_iff_broken X : get X ROOT = None -> right_ends X -> repairs X = [] <-> unbroken X.
  Proof.
    split; [now apply silent_only_if_unbroken | now apply unbroken_reports_nothing].
  Qed.

  (** [VIEW-3] What is refused is not shown. *)
  Theorem refused_not_accepted X h why : In (h, why) (refused X) -> ~ In h (accepted X).
  Proof.
    intros R A. pose proof (kinematic_nodup X) as N.
    apply (Permutation_NoDup (shown_or_hidden eq_dec from to (kinematic X))) in N.
    apply (in_map fst) in R. simpl in R. fold (accepted X) in N. fold (refused X) in N.
    induction (accepted X) as [| a l IH]; [easy |]. inversion N as [| ? ? F N']; subst.
    destruct A as [-> | A]; [| now apply IH]. apply F, in_app_iff. now right.
  Qed.

  (** [VIEW-9] [VIEW-10] Each report by itself is caused by a break, and says truly what is shown instead. *)
  Theorem report_has_cause X p : In p (repairs X) ->
    match p with
    | Superseded h s _ => exists lesser greater, fst lesser = h /\ fst greater = s /\
        In lesser (visible X) /\ In greater (shown X) /\
        competes D (key lesser) (snd greater) = true /\ ltb (claim_rank lesser) (claim_rank greater) = true
    | CycleBroken h => exists c greater, fst c = h /\ In c (kinematic X) /\ incl greater (accepted X) /\
        Forall (fun s => ltb (claim_rank s) (claim_rank c) = false) greater /\
        connected from to greater (from c) (to c)
    | Detached v => v <> ROOT /\ (forall c, In c (accepted X) -> to c <> v) /\
        exists c, In c (accepted X) /\ from c = v
    | Reattached v => In v (vertices X) /\ ~ joined (map ends (shown X)) v ROOT
    | NameClash n w v => In v (vertices X) /\ name_of X v = Some n /\ by_name X n = Some w /\ w <> v
    | Undeclared d => exists c, fst c = d /\ In c (live_writes X) /\ declared c = false
    end.
  Proof.
    intros I. pose proof I as I0. unfold repairs in I. rewrite !in_app_iff in I.
    destruct I as [I | [I | [I | [I | [I | I]]]]].
    - apply in_flat_map in I as (h & H & I). destruct (wins X h) eqn:Wh; [easy |].
      apply in_map_iff in I as (s & <- & I). apply filter_In in I as [J Ws].
      pose proof J as G. apply competitors_in in J as [J C]. exists h, s. repeat split; auto.
      + now apply symbolic_in in H.
      + apply in_app_iff. left. now apply filter_In.
      + apply not_false_iff_true. intros L. assert (h = s); [| congruence].
        apply (same_rank X); auto using records_symbolic. unfold wins in Ws. rewrite is_greatest_spec in Ws.
        apply Ws, (competitors_same X h s); auto. apply competitors_in. split; auto.
        now apply competes_refl with X.
    - apply in_map_iff in I as ([h why] & <- & I). pose proof (refused_has_cause X h why I) as C.
      pose proof (refused_not_accepted X h why I) as N.
      assert (K : In h (kinematic X)).
      { eapply Permutation_in; [apply Permutation_sym, (shown_or_hidden eq_dec from to) |].
        apply in_app_iff. right. now apply (in_map fst) in I. }
      unfold refusal. simpl. destruct why as [s |].
      + destruct C as (S & T & L). exists h, s. pose proof S as Ks. apply accepted_kinematic in Ks.
        pose proof K as (V & R & _)%kinematic_in. pose proof Ks as (V' & R' & _)%kinematic_in.
        repeat split; auto.
        * apply in_app_iff. now right.
        * apply visible_in in V' as (_ & (x & E) & _). rewrite E. simpl. rewrite R'.
          apply eqb_eq in R, R'. rewrite R, R', T. now rewrite !eqb_refl.
        * apply not_false_iff_true. intros L'. apply N. replace h with s; auto.
          apply (same_rank X); auto using visible_records.
      + destruct C as (g & G1 & G2 & G3). exists h, g. auto.
    - apply in_map_iff in I as (v & <- & I). now apply is_detached_iff, detached_in.
    - apply in_map_iff in I as (v & <- & I). apply reattached_in in I as (J & N & _). split; auto.
      now rewrite <- same_component.
    - apply in_flat_map in I as (v & J & I). destruct (name_of X v) as [n |] eqn:En; [| easy].
      destruct (by_name X n) as [w |] eqn:B; [| easy]. destruct (eqb w v) eqn:Q; [easy |].
      destruct I as [<- | []]. apply eqb_neq in Q. auto.
    - apply in_map_iff in I as (c & <- & I). apply filter_In in I as [I N]. apply negb_true_iff in N. eauto.
  Qed.
End View.
