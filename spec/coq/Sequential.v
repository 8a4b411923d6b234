(** * One replica alone never sees a repair (VIEW-12), and the conditions of the six mutations

    The conditions that mutations.md puts on each mutation ([accepts]) are questions to the author's view.
    Here it is proved that they keep a view free of repairs, if it was so before and nothing is pending: hence
    no sequence of accepted mutations, by whatever authors, one after the other, makes a view repair. *)

From DSR Require Import Mutations.
From DSR Require Export View.
From Coq Require Import Permutation Relations.

Section Sequential.
  Context (D : Dictionary) (allows : Name -> N -> bool).

  (** ** The conditions *)

  (** [MUT-3.2] as far as the view can tell: limits (LIMIT-1 to LIMIT-6) only refuse more. *)
  Definition attributes_ok (l : Attributes) : bool :=
    forallb (fun e => allows (fst e) (value_type (snd e))) (entries l).

  Definition has_key (k : Key) (c : Claim) : bool :=
    eqb (from c) (key_from k) && eqb (to c) (key_to k) && eqb (label c) (key_label k).
  Definition is_shown (X : State) (k : Key) : bool := existsb (has_key k) (shown D X).
  (** Whether a source shows an edge of a label. *)
  Definition is_taken (X : State) (source : Dot) (l : Name) : bool :=
    existsb (fun c => eqb (from c) source && eqb (label c) l) (shown D X).

  (** [MUT-2.1] [MUT-2.3] [MUT-2.4] [MUT-2.5] *)
  Definition edge_possible (X : State) (k : Key) : bool :=
    in_graph X (key_from k) && in_graph X (key_to k) && negb (eqb (key_from k) (key_to k)) &&
    negb (is_shown X k) &&
    if is_RT (key_label k) then
      negb (is_root (key_to k)) &&
      match parent_of X (key_to k) with Some _ => false | None => true end &&
      in_tree X (key_from k) &&
      negb (eqb (top eq_dec from to (accepted X) (key_from k)) (key_to k))
    else implb (functional D (key_label k)) (negb (is_taken X (key_from k) (key_label k))).

  (** [MUT-4.2] *)
  Definition strands_nothing (X Y : State) : bool :=
    forallb (fun v => implb (is_stranded D Y v) (is_stranded D X v)) (vertices Y).

  Definition accepts (X : State) (a : Author) (m : Mutation) : bool :=
    match m with
    | AddVertex _ name _ attributes other l outgoing link_attributes =>
        (* MUT-1.2, MUT-1.3, MUT-1.4 *)
        negb (reserved name) && match by_name X name with Some _ => false | None => true end &&
        attributes_ok attributes && attributes_ok link_attributes &&
        (* MUT-1.1 *)
        in_graph X other &&
        if is_RT l then negb outgoing && in_tree X other
        else implb (negb outgoing && functional D l) (negb (is_taken X other l))
    | AddEdge k attributes => edge_possible X k && attributes_ok attributes (* MUT-2.7 *)
    | UpdateAttributes target updates =>
        (* MUT-3.1, MUT-3.2, MUT-3.3, MUT-3.4 *)
        (in_graph X target || existsb (fun c => eqb (fst c) target) (shown D X)) &&
        negb (eqb (keys updates) []) &&
        forallb (fun e => match snd e with
          | Some v => allows (fst e) (value_type v)
          | None => match attribute allows X target (fst e) with Some _ => true | None => false end
          end) (entries updates)
    | RemoveEdge k => is_shown X k && strands_nothing X (mutate D a m X) (* MUT-4.1, MUT-4.2 *)
    | MoveEdge old new attributes =>
        (* MUT-5.1, MUT-5.2, MUT-5.5, MUT-5.3, MUT-5.4 *)
        is_shown X old && negb (has_key old (ROOT, Edge (key_from new) (key_to new) (key_label new) 0)) &&
        attributes_ok attributes &&
        edge_possible (mutate D a (RemoveEdge old) X) new &&
        strands_nothing X (mutate D a m X)
    | RemoveVertex v =>
        (* MUT-6.1, MUT-6.2, MUT-6.3 *)
        in_graph X v && negb (is_root v) && strands_nothing X (mutate D a m X)
    end.

  (** [MUT-2.5] "The child is not among the parent's ancestors": a child without a parent is an ancestor of
      the parent exactly if it is the parent's top. *)
  Theorem cycle_condition X p c : parent_of X c = None ->
    top eq_dec from to (accepted X) p = c <-> up from to (accepted X) p c.
  Proof.
    intros N. rewrite parent_of_none in N. pose proof (kinematic_forest X) as F. split.
    - intros <-. now apply up_to_top.
    - intros U. apply up_connected in U. apply (same_top_iff_connected F) in U. rewrite U.
      now apply top_of_top.
  Qed.

  (** ** What a lone replica keeps *)

  (** Nothing is pending: whatever a record is anchored to is held, or ROOT, and of the right kind. *)
  Definition settled (X : State) : Prop := forall d x b, get X d = Some x -> In b (anchors x) ->
    b = ROOT \/ exists y, get X b = Some y /\ may_anchor x y = true.

  Record clean (X : State) : Prop := {
    clean_wf : wf X;
    clean_settled : settled X;
    clean_ends : right_ends X;
    clean_unbroken : unbroken D allows X
  }.

  Lemma wf_root X : wf X -> get X ROOT = None.
  Proof.
    intros (E & S & _). pose proof (root_lives X E S) as U. unfold cond in U. destruct (get X ROOT); auto. easy.
  Qed.

  Theorem clean_reports_nothing X : clean X -> repairs D allows X = [].
  Proof. intros C. apply unbroken_reports_nothing; apply C. Qed.

  Lemma clean_bottom : clean bottom.
  Proof.
    assert (V : forall v, In v (vertices bottom) -> v = ROOT) by (intros v [<- | []]; auto).
    split; [apply wf_bottom | easy | easy |]. split; try easy.
    intros v I. apply V in I as ->. apply rst_refl.
  Qed.

  Lemma in_graph_possible X d : in_graph X d = Mutations.is_vertex X d.
  Proof. reflexivity. Qed.

  Lemma edge_possible_ends X k : edge_possible X k = true ->
    in_graph X (key_from k) = true /\ in_graph X (key_to k) = true /\ key_from k <> key_to k /\
    (is_RT (key_label k) = true -> key_to k <> ROOT).
  Proof.
    unfold edge_possible. rewrite !andb_true_iff, negb_true_iff, eqb_neq. intros ((((F & T) & N) & _) & R).
    repeat split; auto. intros Rt. rewrite Rt, !andb_true_iff, negb_true_iff in R.
    destruct R as (((R & _) & _) & _). now apply eqb_neq in R.
  Qed.

  (** A mutation has no effect on the kinds of dots that it does not make. *)
  Lemma in_graph_old X a m d : wf X -> possible X m = true -> (forall x, ~ In (d, x) (made (plan D X a m))) ->
    in_graph (mutate D a m X) d = true -> in_graph X d = true.
  Proof.
    intros W Q N. unfold in_graph. destruct (is_root d); auto. simpl.
    destruct (get (mutate D a m X) d) as [x |] eqn:G; [| easy].
    apply mutate_held in G as [I | [G _]]; auto; [now apply N in I | now rewrite G].
  Qed.

  Theorem accepts_possible X a m : wf X -> accepts X a m = true -> possible X m = true.
  Proof.
    intros W. destruct m; cbn [accepts possible]; rewrite ?andb_true_iff.
    - intros ((_ & G) & _). exact G.
    - intros (E & _). apply edge_possible_ends in E as (F & T & _). now split.
    - intros ((T & _) & _). unfold Mutations.is_element. apply orb_true_iff. apply orb_prop in T as [T | T]; auto.
      right. apply existsb_exists in T as (c & I & E). apply eqb_eq in E as <-.
      apply shown_visible, visible_in in I as (G & (s & E) & _ & F & T). rewrite G, E. now apply andb_true_intro.
    - auto.
    - intros ((_ & E) & _). apply edge_possible_ends in E as (F & T & _).
      split; (eapply in_graph_old; [exact W | | | eassumption]; [reflexivity | easy]).
    - intros ((G & N) & _). auto.
  Qed.

  (** ** What is made *)

  Definition new_vertex (X : State) (a : Author) (m : Mutation) : option (Dot * Name) :=
    match m with AddVertex _ name _ _ _ _ _ _ => Some (next_dot X (me a), name) | _ => None end.
  Definition new_key (X : State) (a : Author) (m : Mutation) : option Key :=
    match m with
    | AddVertex _ _ _ _ other l outgoing _ => Some (
        if outgoing then {| key_from := next_dot X (me a); key_to := other; key_label := l |}
        else {| key_from := other; key_to := next_dot X (me a); key_label := l |})
    | AddEdge k _ | MoveEdge _ k _ => Some k
    | _ => None
    end.
  Definition new_edge_dot (X : State) (a : Author) (m : Mutation) : Dot :=
    dot_of (me a) (1 + greatest X (me a) + match m with AddVertex _ _ _ _ _ _ _ _ => 1 | _ => 0 end).

  Lemma set_declared X a t l d x : attributes_ok l = true -> In x (set X a t l) ->
    key_of x = None /\ declared allows (d, x) = true.
  Proof.
    unfold attributes_ok, set. rewrite forallb_forall, in_map_iff. intros A ([n v] & <- & I).
    split; auto. now apply A in I.
  Qed.

  Lemma made_spec X a m d x : accepts X a m = true -> In (d, x) (made (plan D X a m)) ->
    match x with
    | Vertex _ n _ _ => new_vertex X a m = Some (d, n)
    | Edge f t l _ => new_key X a m = Some {| key_from := f; key_to := t; key_label := l |} /\ d = new_edge_dot X a m
    | Write _ _ _ _ _ => declared allows (d, x) = true
    end.
  Proof.
    assert (S : forall t l, attributes_ok l = true -> In x (set X a t l) ->
      match x with Write _ _ _ _ _ => declared allows (d, x) = true | _ => False end).
    { intros t l A I. pose proof I as J. apply set_in in J as (n & v & ->).
      now apply (set_declared X a t l d) in I. }
    intros A I. destruct m; cbn [plan made make_records accepts] in A, I; rewrite ?andb_true_iff in A.
    - destruct A as ((((_ & A1) & A2) & _) & _).
      destruct I as [[= <- <-] | [[= <- <-] | I]].
      + unfold next_dot. simpl. auto.
      + unfold new_edge_dot. simpl. destruct outgoing; split; auto; simpl; rewrite N.add_0_r; reflexivity.
      + apply numbered_in in I as [[I | I]%in_app_iff _]; apply S in I; auto; now destruct x.
    - destruct A as (_ & A). destruct I as [[= <- <-] | I].
      + unfold new_edge_dot. simpl. rewrite N.add_0_r. split; auto. now destruct key.
      + apply numbered_in in I as [I _]. apply S in I; auto. now destruct x.
    - destruct A as (_ & A). apply numbered_in in I as [I _]. apply updated_in in I as (n & v & I & ->).
      rewrite forallb_forall in A. now apply A in I.
    - easy.
    - destruct A as ((((_ & _) & A) & _) & _). destruct I as [[= <- <-] | I].
      + unfold new_edge_dot. simpl. rewrite N.add_0_r. split; auto. now destruct new.
      + apply numbered_in in I as [I _]. apply S in I; auto. now destruct x.
    - easy.
  Qed.

  (** Whatever makes an edge kills all that is held on its register, [MUT-2.6]. *)
  Lemma register_killed X a m k d x : new_key X a m = Some k -> get X d = Some x -> competes D k x = true ->
    In d (killed (plan D X a m)).
  Proof.
    intros K G C. assert (I : In d (register D X k)) by (apply register_in; eauto).
    destruct m; cbn [new_key plan killed make_records] in *; try easy; injection K as <-; auto.
    apply in_app_iff. now right.
  Qed.

  Lemma killed_no_vertex X a m d t n e s : (forall v, m <> RemoveVertex v) ->
    In d (killed (plan D X a m)) -> get X d <> Some (Vertex t n e s).
  Proof.
    assert (R : forall k, In d (register D X k) -> get X d <> Some (Vertex t n e s)).
    { intros k (x & G & C)%register_in. rewrite G. intros [= ->]. discriminate. }
    intros N I. destruct m; cbn [plan killed make_records] in I; eauto.
    - apply writes_in in I as (x & G & n' & v & c & s' & ->). now rewrite G.
    - apply in_app_iff in I as [I | I]; eauto.
    - now destruct (N vertex).
  Qed.

  (** Where nothing is pending every edge held is visible. *)
  Lemma edge_visible X d f t l s : settled X -> right_ends X ->
    get X d = Some (Edge f t l s) -> In (d, Edge f t l s) (visible X).
  Proof.
    intros S E G. assert (V : forall b, In b [f; t] -> in_graph X b = true).
    { intros b I. unfold in_graph. destruct (S _ _ b G I) as [-> | (y & H & M)]; [easy |].
      rewrite H. destruct y; try easy. now rewrite orb_true_r. }
    apply visible_in. unfold from, to, label. simpl. repeat split; eauto; try apply V; simpl; auto.
    now destruct (E _ _ G).
  Qed.

  (** Nothing made is under a dot that is in the graph already. *)
  Lemma next_dot_new X a : wf X -> in_graph X (next_dot X (me a)) = false.
  Proof.
    intros W. unfold in_graph. apply orb_false_intro.
    - apply eqb_neq. intros N. apply (f_equal sequence) in N. unfold next_dot, dot_of, ROOT, r in N.
      cbn [sequence] in N. lia.
    - destruct (get X (next_dot X (me a))) eqn:E; auto. exfalso.
      assert (S : seen X (next_dot X (me a)) = false) by (apply next_dots_unseen; lia).
      assert (B : holds X (next_dot X (me a)) = true) by (unfold holds; now rewrite E).
      apply W in B. congruence.
  Qed.

  (** A vertex or an edge outlives a mutation that kills neither it nor a vertex. *)
  Lemma survives X a m d x : wf X -> possible X m = true -> (forall v, m <> RemoveVertex v) ->
    (forall b, In b (anchors x) -> b = ROOT \/ exists y, get X b = Some y /\ may_anchor x y = true) ->
    get X d = Some x -> match x with Write _ _ _ _ _ => False | _ => True end ->
    ~ In d (killed (plan D X a m)) -> get (mutate D a m X) d = Some x.
  Proof.
    intros W Q N S G K NK. pose proof (plan_sound D X a m W Q) as P.
    set (M := merge X (delta_of (plan D X a m))).
    assert (H : forall b y, get X b = Some y -> ~ In b (killed (plan D X a m)) -> cond M b = Held y)
      by (intros b y; apply cond_merge_kept; auto).
    assert (A : forall b, In b (anchors x) -> is_dead M b = false /\ ~ doomed M b).
    { intros b I. destruct (S _ I) as [-> | (y & E & V)].
      - pose proof (root_unseen X _ W P : cond M ROOT = Unseen) as R. split.
        + apply not_true_iff_false. rewrite <- cond_dead. now rewrite R.
        + inversion 1 as [? ? ? F | ? ? ? F]; apply cond_held in F; now rewrite R in F.
      - destruct x; try easy. destruct y as [t' n' e' s' | |]; try easy.
        assert (R : cond M b = Held (Vertex t' n' e' s')).
        { apply H; auto. intros I'. now apply (killed_no_vertex X a m b t' n' e' s') in I'. }
        split.
        + apply not_true_iff_false. rewrite <- cond_dead. now rewrite R.
        + inversion 1 as [? ? ? F J | ? ? ? F J]; apply cond_held in F; rewrite R in F; injection F as <-; easy. }
    pose proof (H _ _ G NK) as B. unfold mutate. rewrite <- join_delta_of by auto. unfold join. fold M.
    pose proof (close_inflationary M d) as L. rewrite B in L. apply cond_held.
    destruct (cond (close M) d) eqn:F; inversion L; subst; auto.
    apply cond_dead, close_drops in F as [F | F].
    - apply cond_dead in F. congruence.
    - inversion F as [? x' b F' J Dd | ? x' b F' J Dd]; apply cond_held in F'; rewrite B in F';
        injection F' as <-; apply A in J as [J1 J2]; congruence || auto.
  Qed.

  Lemma vertex_stays X a m v : wf X -> possible X m = true -> (forall u, m <> RemoveVertex u) ->
    in_graph X v = true -> in_graph (mutate D a m X) v = true.
  Proof.
    intros W Q N. unfold in_graph. destruct (is_root v); auto. simpl.
    destruct (get X v) as [[t n e s | |] |] eqn:G; try easy. intros _.
    rewrite (survives X a m v (Vertex t n e s)); auto; [easy |].
    intros I. now apply (killed_no_vertex X a m v t n e s) in I.
  Qed.

  (** [WF-4] What a new edge joins. *)
  Lemma new_key_ends X a m k : wf X -> accepts X a m = true -> new_key X a m = Some k ->
    key_from k <> key_to k /\ (key_label k = RT -> key_to k <> ROOT).
  Proof.
    intros W A G. assert (H : forall Z k, edge_possible Z k = true ->
      key_from k <> key_to k /\ (key_label k = RT -> key_to k <> ROOT)).
    { intros Z k' E. apply edge_possible_ends in E as (_ & _ & N & R). split; auto. intros E. apply R.
      now rewrite E. }
    destruct m as [ty nm ext ats other lb outgoing lats | k0 ats | tg up | k0 | old new ats | vx];
      cbn [new_key accepts] in G, A; try discriminate; injection G as <-.
    - rewrite !andb_true_iff in A. destruct A as ((_ & O) & R). pose proof (next_dot_new X a W) as S.
      assert (N : next_dot X (me a) <> ROOT) by (intros N; now rewrite N in S).
      destruct outgoing; cbn [key_from key_to key_label].
      + split; [intros E; congruence |]. intros ->. discriminate.
      + split; [intros E; congruence | auto].
    - apply andb_prop in A as [A _]. eauto.
    - rewrite !andb_true_iff in A. destruct A as ((_ & E) & _). eauto.
  Qed.

  Definition new_edge (X : State) (a : Author) (m : Mutation) (k : Key) : Claim :=
    (new_edge_dot X a m, edge_record X k).

  Lemma new_edge_made X a m k : new_key X a m = Some k -> In (new_edge X a m k) (made (plan D X a m)).
  Proof.
    intros K. unfold new_edge, new_edge_dot.
    destruct m as [ty nm ext ats other lb outgoing lats | k0 ats | tg up | k0 | old new ats | vx];
      cbn [new_key plan made make_records numbered] in *; try discriminate; injection K as <-.
    - right. now left.
    - rewrite N.add_0_r. now left.
    - rewrite N.add_0_r. now left.
  Qed.

  (** *** [INTENT-1] A new edge is shown at once, in whatever state *)

  Lemma new_edge_visible X a m k : wf X -> accepts X a m = true -> new_key X a m = Some k ->
    In (new_edge X a m k) (visible (mutate D a m X)).
  Proof.
    intros W A K. pose proof (accepts_possible X a m W A) as Q. pose proof (plan_sound D X a m W Q) as P.
    assert (N : forall u, m <> RemoveVertex u) by (intros u ->; discriminate).
    assert (V : in_graph (mutate D a m X) (key_from k) = true /\ in_graph (mutate D a m X) (key_to k) = true).
    { pose proof (fun v => vertex_stays X a m v W Q N) as S.
      destruct m as [ty nm ext ats other lb outgoing lats | k0 ats | tg up | k0 | old new ats | vx];
        cbn [new_key accepts] in K, A; try discriminate; injection K as <-.
      - rewrite !andb_true_iff in A. destruct A as ((_ & O) & _). apply S in O.
        assert (L : in_graph (mutate D a (AddVertex ty nm ext ats other lb outgoing lats) X)
          (next_dot X (me a)) = true).
        { unfold in_graph, mutate.
          rewrite (made_lives X _ W P _ (Vertex ty nm ext (1 + greatest_stamp X))) by now left. apply orb_true_r. }
        destruct outgoing; now split.
      - apply andb_prop in A as [A _]. apply edge_possible_ends in A as (F & T & _). split; now apply S.
      - rewrite !andb_true_iff in A. destruct A as ((_ & E) & _). apply edge_possible_ends in E as (F & T & _).
        split; apply S; (eapply in_graph_old; [exact W | | | eassumption]; [reflexivity | easy]). }
    apply visible_in. unfold new_edge, from, to, label, edge_record. simpl. repeat split; eauto; try apply V.
    - apply (made_lives X _ W P), new_edge_made, K.
    - now apply (new_key_ends X a m k) in K.
  Qed.

  (** It outranks every other claim. *)
  Lemma new_edge_greatest X a m k c : wf X -> accepts X a m = true -> new_key X a m = Some k ->
    In c (visible (mutate D a m X)) -> c <> new_edge X a m k ->
    ltb (claim_rank c) (claim_rank (new_edge X a m k)) = true.
  Proof.
    intros W A K I N. pose proof (accepts_possible X a m W A) as Q. pose proof I as V.
    apply visible_in in V as (G & (s & E) & _). rewrite E in G. apply mutate_held in G as [G | [G _]]; auto.
    - exfalso. apply N, (same_dot (mutate D a m X)); [now apply visible_records | |].
      + now apply visible_records, new_edge_visible.
      + now apply made_spec in G as [_ ->].
    - apply ltb_lt. rewrite <- E in G. now apply (next_stamp_outranks X).
  Qed.

  Lemma sorted_head (c : Claim) l : sorted claim_rank l -> In c l ->
    (forall d, In d l -> d <> c -> ltb (claim_rank d) (claim_rank c) = true) -> exists rest, l = c :: rest.
  Proof.
    intros S I B. destruct l as [| x l]; [easy |]. destruct I as [-> | I]; [eauto |].
    inversion S as [| ? ? F _]; subst. rewrite Forall_forall in F.
    assert (R : {x = c} + {x <> c}) by (decide equality; apply eq_dec).
    destruct R as [-> | R]; [eauto |]. specialize (B x (or_introl eq_refl) R).
    rewrite (F c I) in B. discriminate.
  Qed.

  (** [INTENT-1] [MUT-1] [MUT-2] [MUT-5] Afterwards the new edge is shown: of *any* well-formed state, whatever is
      hidden, pending or broken in it. The tree cannot refuse it, since it is taken first. *)
  Theorem new_edge_shown X a m k : wf X -> accepts X a m = true -> new_key X a m = Some k ->
    In (new_edge X a m k) (shown D (mutate D a m X)).
  Proof.
    intros W A K. pose proof (new_edge_visible X a m k W A K) as V. unfold shown. apply in_app_iff.
    destruct (new_key_ends X a m k W A K) as [Ne Nr]. destruct (is_RT (key_label k)) eqn:R; [right | left].
    - assert (I : In (new_edge X a m k) (kinematic (mutate D a m X))).
      { apply kinematic_in. repeat split; auto. now apply Nr, eqb_eq. }
      destruct (sorted_head _ _ (kinematic_sorted _) I) as (rest & E).
      { intros d J N. apply kinematic_in in J as [J _]. now apply new_edge_greatest. }
      unfold accepted. rewrite E. unfold Forest.shown. simpl.
      assert (J : judge eq_dec from to [] (new_edge X a m k) = None) by (apply judge_none; split; easy).
      rewrite J. apply grow_keeps. now left.
    - apply filter_In. split; [now apply symbolic_in |]. apply is_greatest_spec. intros d [I _]%competitors_in.
      assert (Q : {d = new_edge X a m k} + {d <> new_edge X a m k}) by (decide equality; apply eq_dec).
      destruct Q as [-> | Q]; [apply ltb_irrefl |]. apply ltb_asym. apply symbolic_in in I as [I _].
      now apply new_edge_greatest.
  Qed.

  (** [MUT-4] Afterwards no edge of the register is shown. *)
  Theorem removed_edge_hidden X a k c : wf X ->
    In c (shown D (mutate D a (RemoveEdge k) X)) -> competes D k (snd c) = false.
  Proof.
    intros W I. apply no_dangling_edge in I as (G & _). eapply remove_edge_clears; eauto.
  Qed.

  (** [MUT-5] Afterwards nothing is shown on the old register, unless it is the new one. *)
  Theorem moved_edge_hidden X a old new l c : wf X -> accepts X a (MoveEdge old new l) = true ->
    In c (shown D (mutate D a (MoveEdge old new l) X)) -> competes D old (snd c) = true ->
    fst c = new_edge_dot X a (MoveEdge old new l).
  Proof.
    intros W A I C. apply no_dangling_edge in I as (G & _). unfold new_edge_dot. rewrite N.add_0_r.
    apply (move_edge_claims D a X old new l W (accepts_possible X a _ W A)) in G; auto.
  Qed.

  (** [MUT-6] Afterwards the vertex is not in the graph. *)
  Theorem removed_vertex_gone X a v : wf X -> accepts X a (RemoveVertex v) = true ->
    ~ In v (vertices (mutate D a (RemoveVertex v) X)).
  Proof.
    intros W A I. pose proof (accepts_possible X a _ W A) as Q. pose proof (plan_sound D X a _ W Q) as P.
    apply vertices_in in I. unfold in_graph in I. apply orb_prop in I as [I | I].
    - cbn [possible] in Q. apply andb_prop in Q as [Q _]. unfold is_root in *. now rewrite I in Q.
    - destruct (get (mutate D a (RemoveVertex v) X) v) as [x |] eqn:G; [| easy].
      assert (K : In v (killed (plan D X a (RemoveVertex v)))) by now left.
      apply (killed_dies X _ W P), cond_dead in K. apply cond_held in G. unfold mutate in G. congruence.
  Qed.

  (** [MUT-1] Afterwards the name finds the new vertex. *)
  Theorem new_vertex_found X a m v n : wf X -> accepts X a m = true -> new_vertex X a m = Some (v, n) ->
    by_name (mutate D a m X) n = Some v.
  Proof.
    intros W A N. pose proof (accepts_possible X a m W A) as Q. pose proof (plan_sound D X a m W Q) as P.
    destruct m as [ty nm ext ats other lb outgoing lats | | | | |]; try discriminate.
    injection N as <- <-. pose proof A as A'. cbn [accepts] in A'. rewrite !andb_true_iff, negb_true_iff in A'.
    destruct A' as (((((R & B) & _) & _) & _) & _).
    set (m := AddVertex ty nm ext ats other lb outgoing lats) in *.
    assert (G : get (mutate D a m X) (next_dot X (me a)) = Some (Vertex ty nm ext (1 + greatest_stamp X))).
    { apply (made_lives X _ W P). now left. }
    assert (U : forall w, name_of (mutate D a m X) w = Some nm -> w = next_dot X (me a)).
    { intros w E. unfold name_of in E. destruct (get (mutate D a m X) w) as [[t n e s | |] |] eqn:H; try easy.
      injection E as ->. apply mutate_held in H as [H | [H _]]; auto.
      - apply made_spec in H; auto. unfold m in H. cbn [new_vertex] in H. now injection H.
      - exfalso. pose proof (name_finds_oldest X nm R) as F. destruct (by_name X nm); [easy |].
        apply (F w); [apply vertices_in; unfold in_graph | unfold name_of]; rewrite H; auto. apply orb_true_r. }
    pose proof (name_finds_oldest (mutate D a m X) nm R) as F. destruct (by_name (mutate D a m X) nm) as [w |].
    - destruct F as (_ & E & _). now rewrite (U w E).
    - exfalso. apply (F (next_dot X (me a))); [apply vertices_in; unfold in_graph | unfold name_of]; rewrite G; auto.
      apply orb_true_r.
  Qed.

  Lemma element_stays X a t u : wf X -> accepts X a (UpdateAttributes t u) = true ->
    is_element (mutate D a (UpdateAttributes t u) X) t = true.
  Proof.
    intros W A. pose proof (accepts_possible X a _ W A) as Q.
    pose proof (fun v => vertex_stays X a _ v W Q ltac:(easy)) as S.
    cbn [accepts] in A. rewrite !andb_true_iff in A. destruct A as ((T & _) & _). unfold is_element.
    apply orb_prop in T as [T | T]; [now rewrite S |]. apply existsb_exists in T as (c & I & E).
    apply eqb_eq in E as <-. apply shown_visible, visible_in in I as (G & (s & E) & Ne & F & T).
    assert (V : forall b, in_graph X b = true -> b = ROOT \/ exists y, get X b = Some y /\ may_anchor (snd c) y = true).
    { intros b B. unfold in_graph in B. apply orb_prop in B as [B | B]; [left; now apply eqb_eq | right].
      destruct (get X b) as [[] |]; try easy. eexists. split; eauto. now rewrite E. }
    rewrite (survives X a _ (fst c) (snd c) W Q); auto; try easy.
    - unfold is_visible. rewrite E. simpl. apply S in F, T. unfold from, to in *. rewrite E in *. simpl in *.
      rewrite F, T. apply eqb_neq in Ne. rewrite Ne. now rewrite !andb_true_r, orb_true_r.
    - intros b B. apply V. rewrite E in B. now destruct B as [<- | [<- | []]].
    - now rewrite E.
    - intros K. cbn [plan killed make_records] in K. apply writes_in in K as (x & G' & n & v & z & s' & ->). congruence.
  Qed.

  (** [MUT-3] Afterwards the view shows the value that was set, as the only one, *)
  Theorem set_attribute_shown X a t u n v : wf X -> accepts X a (UpdateAttributes t u) = true ->
    In (n, Some v) (entries u) ->
    exists d, attribute_writes allows (mutate D a (UpdateAttributes t u) X) t n
      = [(d, Write t n v (time_ns a) (1 + greatest_stamp X))].
  Proof.
    intros W A I. destruct (update_sets D a X t u n v W (accepts_possible X a _ W A) I) as (d & G & One).
    exists d. set (Y := mutate D a (UpdateAttributes t u) X) in *.
    set (c := (d, Write t n v (time_ns a) (1 + greatest_stamp X)) : Claim).
    assert (Ic : In c (attribute_writes allows Y t n)).
    { apply attribute_writes_in. split; [| simpl; now rewrite !eqb_refl]. apply filter_In. split.
      - apply filter_In. split; [now apply in_records |]. now apply element_stays.
      - cbn [accepts] in A. rewrite !andb_true_iff in A. destruct A as (_ & A). rewrite forallb_forall in A.
        now apply A in I. }
    assert (Only : forall c', In c' (attribute_writes allows Y t n) -> c' = c).
    { intros c' I'. apply attribute_writes_in in I' as [I' Wr]. apply filter_In in I' as [I' _].
      apply filter_In in I' as [I' _]. pose proof I' as G'. apply in_records in G'.
      apply (same_dot Y); auto; [now apply in_records | now apply (One (fst c') (snd c'))]. }
    assert (N : NoDup (attribute_writes allows Y t n)).
    { eapply Permutation_NoDup; [apply descending_permutation |]. repeat apply NoDup_filter. apply records_nodup. }
    destruct (attribute_writes allows Y t n) as [| x [| y l]]; [easy | |].
    - now rewrite (Only x) by now left.
    - exfalso. inversion N as [| ? ? F _]; subst. apply F. left.
      rewrite (Only x), (Only y); simpl; auto.
  Qed.

  (** and nothing for what was unset. *)
  Theorem unset_attribute_gone X a t u n : wf X -> accepts X a (UpdateAttributes t u) = true ->
    In (n, None) (entries u) -> attribute_writes allows (mutate D a (UpdateAttributes t u) X) t n = [].
  Proof.
    intros W A I. set (Y := mutate D a (UpdateAttributes t u) X).
    destruct (attribute_writes allows Y t n) as [| c l] eqn:E; auto. exfalso.
    assert (J : In c (attribute_writes allows Y t n)) by (rewrite E; now left).
    apply attribute_writes_in in J as [J Wr]. apply filter_In in J as [J _]. apply filter_In in J as [J _].
    apply in_records in J. pose proof (update_unsets D a X t u n W (accepts_possible X a _ W A) I _ _ J). congruence.
  Qed.

  (** Mutations 1 to 3. *)
  Definition adds (m : Mutation) : Prop :=
    match m with AddVertex _ _ _ _ _ _ _ _ | AddEdge _ _ | UpdateAttributes _ _ => True | _ => False end.

  Section Step.
    Context (X : State) (a : Author) (m : Mutation).
    Context (C : clean X) (A : accepts X a m = true).
    Let Y := mutate D a m X.
    Let W : wf X := clean_wf X C.
    Let Q : possible X m = true := accepts_possible X a m W A.
    Let U : unbroken D allows X := clean_unbroken X C.
    Let P : sound X (plan D X a m) := plan_sound D X a m W Q.

    Lemma wf_Y : wf Y.
    Proof. now apply wf_mutate. Qed.

    Lemma held_Y d x : get Y d = Some x ->
      In (d, x) (made (plan D X a m)) \/ get X d = Some x /\ ~ In d (killed (plan D X a m)).
    Proof. now apply mutate_held. Qed.

    Lemma stays d x : get X d = Some x -> is_dead Y d = false -> get Y d = Some x.
    Proof.
      intros G N. assert (L : X ≤ Y) by now apply edit_inflationary. specialize (L d).
      apply cond_held in G. rewrite G in L. destruct (cond Y d) eqn:E; inversion L; subst.
      - now apply cond_held.
      - apply cond_dead in E. congruence.
    Qed.

    Lemma settled_Y : settled Y.
    Proof.
      intros d x b G I.
      assert (S : forall y, get X b = Some y -> get Y b = Some y).
      { intros y H. apply stays; auto. now apply (proj2 (proj2 wf_Y) d x). }
      apply held_Y in G as [G | [G _]].
      - destruct (made_anchored _ _ P _ _ _ G I) as [-> | (y & M & [H | H])]; auto; right; exists y; split; auto.
        now apply made_lives.
      - destruct (clean_settled X C _ _ _ G I) as [-> | (y & H & M)]; auto. right. exists y. auto.
    Qed.

    (** A visible edge afterwards is the new one, or was visible before and does not compete with it. *)
    Lemma visible_Y c : In c (visible Y) ->
      fst c = new_edge_dot X a m /\ new_key X a m = Some (key c) \/
      In c (visible X) /\ ~ In (fst c) (killed (plan D X a m)) /\
      forall k, new_key X a m = Some k -> competes D k (snd c) = false.
    Proof.
      intros I. apply visible_in in I as (G & (s & E) & _). rewrite E in G.
      apply held_Y in G as [G | [G K]].
      - left. now apply made_spec in G as [G ->].
      - right. repeat split; auto.
        + destruct c as [d x]. simpl in *. rewrite E. apply edge_visible; auto; apply C.
        + intros k N. apply not_true_iff_false. intros F. apply K. eapply register_killed; eauto.
          now rewrite E in F.
    Qed.

    Lemma visible_key Z c : In c (visible Z) -> key_of (snd c) = Some (key c).
    Proof. intros I. apply visible_in in I as (_ & (s & E) & _). now rewrite E. Qed.

    (** [INV-6] One edge for each register. *)
    Lemma registers_Y c c' : In c (symbolic Y) -> In c' (symbolic Y) ->
      competes D (key c) (snd c') = true -> c = c'.
    Proof.
      intros [I R]%symbolic_in [I' R']%symbolic_in F.
      pose proof (visible_key _ _ I) as K. pose proof (visible_key _ _ I') as K'.
      destruct (visible_Y c I) as [[E N] | (J & _ & N)], (visible_Y c' I') as [[E' N'] | (J' & _ & N')].
      - apply (same_dot Y); auto using visible_records. congruence.
      - rewrite N' in F; auto. discriminate.
      - rewrite (competes_sym D _ _ _ _ K K') in F. rewrite N in F; auto. discriminate.
      - apply (one_edge_each_register _ _ _ U); auto; now apply symbolic_in.
    Qed.

    Lemma same_child Z c c' : In c (kinematic Z) -> In c' (kinematic Z) -> to c = to c' ->
      competes D (key c) (snd c') = true.
    Proof.
      intros (I & R & _)%kinematic_in (I' & R' & _)%kinematic_in E.
      apply visible_in in I' as (_ & (s & E') & _). rewrite E'. simpl. rewrite R'.
      apply eqb_eq in R, R'. rewrite R, R', E. now rewrite !eqb_refl.
    Qed.

    (** [INV-3] One kinematic parent. *)
    Lemma parents_Y c c' : In c (kinematic Y) -> In c' (kinematic Y) -> to c = to c' -> c = c'.
    Proof.
      intros I I' E. pose proof (same_child _ _ _ I I' E) as F. pose proof (same_child _ _ _ I' I (eq_sym E)) as F'.
      pose proof I as (V & R & T)%kinematic_in. pose proof I' as (V' & R' & T')%kinematic_in.
      destruct (visible_Y c V) as [[H N] | (J & _ & N)], (visible_Y c' V') as [[H' N'] | (J' & _ & N')].
      - apply (same_dot Y); auto using visible_records. congruence.
      - rewrite N' in F; auto. discriminate.
      - rewrite N in F'; auto. discriminate.
      - apply (one_kinematic_parent D allows X U c c'); [now apply kinematic_in | now apply kinematic_in | exact E].
    Qed.

    (** No vertex appears but the one that is added. *)
    Lemma vertices_Y v : In v (vertices Y) -> In v (vertices X) \/ exists n, new_vertex X a m = Some (v, n).
    Proof.
      rewrite !vertices_in. intros G. destruct (in_graph X v) eqn:E; [now left | right].
      unfold in_graph in *. apply orb_false_elim in E as [E F]. rewrite E in G. simpl in G.
      destruct (get Y v) as [[t n e s | |] |] eqn:H; try easy. apply held_Y in H as [H | [H _]].
      - apply made_spec in H; eauto.
      - rewrite H in F. discriminate.
    Qed.

    Lemma name_Y v n : name_of Y v = Some n -> name_of X v = Some n \/ new_vertex X a m = Some (v, n).
    Proof.
      unfold name_of. destruct (get Y v) as [[t n' e s | |] |] eqn:H; try easy. intros [= <-].
      apply held_Y in H as [H | [H _]]; [right | left; now rewrite H]. now apply made_spec in H.
    Qed.

    Lemma named_in_graph Z v n : name_of Z v = Some n -> In v (vertices Z).
    Proof.
      unfold name_of. rewrite vertices_in. unfold in_graph. destruct (get Z v) as [[] |]; try easy.
      now rewrite orb_true_r.
    Qed.

    (** [VIEW-7] One vertex for each name, by MUT-1.2 and MUT-1.3. *)
    Lemma names_Y v w n : In v (vertices Y) -> In w (vertices Y) ->
      name_of Y v = Some n -> name_of Y w = Some n -> v = w /\ reserved n = false.
    Proof.
      assert (F : forall v, new_vertex X a m = Some (v, n) ->
                  reserved n = false /\ forall u, name_of X u <> Some n).
      { intros u E. pose proof A as B'. destruct m; try easy. injection E as _ <-. cbn [accepts] in B'.
        rewrite !andb_true_iff, negb_true_iff in B'. destruct B' as (((((R & B) & _) & _) & _) & _).
        split; auto. intros w' E. pose proof (name_finds_oldest X name R) as F.
        destruct (by_name X name); [easy |]. apply (F w'); auto. eapply named_in_graph; eauto. }
      intros _ _ [Ev | Ev]%name_Y [Ew | Ew]%name_Y.
      - apply (one_vertex_each_name _ _ _ U); eauto using named_in_graph.
      - destruct (F _ Ew) as [_ N]. now apply N in Ev.
      - destruct (F _ Ev) as [_ N]. now apply N in Ew.
      - destruct (F _ Ev) as [R _]. split; [congruence | auto].
    Qed.

    (** [INV-5] Every write is declared, by MUT-3.2. *)
    Lemma declared_Y c : In c (live_writes Y) -> declared allows c = true.
    Proof.
      intros [I L]%filter_In. apply in_records in I. unfold is_live_write in L. destruct c as [d x].
      simpl in *. destruct x as [| | t n v z s]; try easy. apply held_Y in I as [I | [G _]].
      - now apply made_spec in I.
      - apply (all_declared _ _ _ U). apply filter_In. split; [now apply in_records |]. simpl.
        assert (H : In t (anchors (Write t n v z s))) by now left.
        unfold is_live_write, is_element, in_graph. simpl.
        destruct (clean_settled X C _ _ _ G H) as [-> | (y & E & M)]; [easy |]. rewrite E.
        destruct y; try easy; [now rewrite orb_true_r |].
        apply edge_visible, filter_In in E as [_ E]; try apply C. now rewrite E, orb_true_r.
    Qed.

    (** [WF-4] *)
    Lemma ends_Y : right_ends Y.
    Proof.
      intros d x G. destruct x as [| f t l s |]; try easy. simpl. apply held_Y in G as [G | [G _]].
      - apply made_spec in G as [G _]; auto. now apply new_key_ends in G.
      - now apply (clean_ends X C) in G.
    Qed.

    Lemma vertex_survives v : (forall u, m <> RemoveVertex u) -> In v (vertices X) -> In v (vertices Y).
    Proof. rewrite !vertices_in. intros N. now apply vertex_stays. Qed.

    Lemma edge_survives c : (forall u, m <> RemoveVertex u) -> In c (visible X) ->
      ~ In (fst c) (killed (plan D X a m)) -> In c (visible Y).
    Proof.
      intros N I K. apply visible_in in I as (G & (s & E) & NE & F & T).
      rewrite <- vertices_in in F, T. apply vertex_survives, vertices_in in F, T; auto.
      apply visible_in. repeat split; eauto.
      apply survives; auto; [intros b; apply (clean_settled X C _ _ b G) |]. now rewrite E.
    Qed.

    (** *** Mutations 1 to 3 kill no edge of a clean state, and so keep every path *)

    Lemma free_register Z k c : edge_possible Z k = true -> In c (shown D Z) -> competes D k (snd c) = false.
    Proof.
      unfold edge_possible. rewrite !andb_true_iff. intros ((_ & NS) & R) I. apply not_true_iff_false. intros F.
      pose proof I as V. apply shown_visible, visible_in in V as (_ & (s & E) & _). rewrite E in F. simpl in F.
      apply andb_prop in F as [L F]. apply eqb_eq in L. rewrite <- L in *. destruct (is_RT (label c)) eqn:Rt.
      - rewrite !andb_true_iff in R. destruct R as (((_ & R) & _) & _). apply eqb_eq in F.
        destruct (parent_of Z (key_to k)) eqn:Pk; [easy |]. rewrite parent_of_none in Pk.
        apply (Pk c); auto. now apply (shown_RT D Z).
      - apply andb_prop in F as [F T]. apply orb_prop in T as [T | T].
        + apply negb_true_iff, not_true_iff_false in NS. apply NS, existsb_exists. exists c. split; auto.
          unfold has_key. rewrite F, T. now apply eqb_eq.
        + rewrite T in R. simpl in R. apply negb_true_iff, not_true_iff_false in R. apply R, existsb_exists.
          exists c. split; auto. rewrite F. now apply eqb_eq.
    Qed.

    Lemma no_edge_killed c : adds m -> In c (visible X) -> ~ In (fst c) (killed (plan D X a m)).
    Proof.
      intros Gr V K. pose proof (unbroken_shows_all D allows X c (clean_ends X C) U V) as S.
      assert (R : forall k, In (fst c) (register D X k) -> competes D k (snd c) = true).
      { intros k (x & G & F)%register_in. apply visible_in in V as (G' & _). congruence. }
      pose proof A as A'. pose proof V as V'. apply visible_in in V' as (G & (s & E) & _ & F & T).
      destruct m as [ty nm ext ats other lb outgoing lats | k0 ats | tg up | k0 | old0 new0 ats | vx]; try easy;
        cbn [plan killed make_records accepts] in K, A'.
      - apply R in K. rewrite !andb_true_iff in A'. destruct A' as (_ & A').
        pose proof (next_dot_new X a W) as N. fold (next_dot X (me a)) in K.
        rewrite E in K. destruct outgoing; simpl in K; apply andb_prop in K as [L K]; apply eqb_eq in L;
          rewrite <- L in *; destruct (is_RT (label c)) eqn:Rt.
        + discriminate.
        + apply andb_prop in K as [K _]. apply eqb_eq in K. congruence.
        + apply eqb_eq in K. congruence.
        + apply andb_prop in K as [K1 K2]. apply orb_prop in K2 as [K2 | K2].
          * apply eqb_eq in K2. congruence.
          * rewrite K2 in A'. simpl in A'. apply negb_true_iff, not_true_iff_false in A'.
            apply A', existsb_exists. exists c. split; auto. rewrite K1. now apply eqb_eq.
      - apply R in K. apply andb_prop in A' as [A' _]. rewrite (free_register X k0 c) in K; auto. discriminate.
      - apply writes_in in K as (x & G' & n & v & z & s' & ->). congruence.
    Qed.

    Lemma grows_not_removal : adds m -> forall u, m <> RemoveVertex u.
    Proof. intros G u E. now rewrite E in G. Qed.

    Lemma grown_edges c : adds m -> In c (visible X) -> In c (visible Y).
    Proof. intros G I. apply edge_survives; auto using grows_not_removal, no_edge_killed. Qed.

    Lemma grown_kinematic c : adds m -> In c (kinematic X) -> In c (kinematic Y).
    Proof. rewrite !kinematic_in. intros G [I R]. auto using grown_edges. Qed.

    Lemma joined_incl (l l' : list Claim) u v : incl l l' -> joined (map ends l) u v -> joined (map ends l') u v.
    Proof.
      intros I J. induction J as [u w H | | |]; [| apply rst_refl | now apply rst_sym | eapply rst_trans; eauto].
      apply rst_step. apply in_map_iff in H as (c & <- & H). now apply in_map, I.
    Qed.

    Lemma no_report : repairs D allows X = [].
    Proof. now apply clean_reports_nothing. Qed.

    Lemma tree_reaches_root v : in_tree X v = true -> up from to (kinematic X) v ROOT.
    Proof.
      intros T. destruct (way_up_ends D allows X v T) as (t & Wt & [-> | H]).
      - eapply up_incl; [| exact Wt]. intros c. apply accepted_kinematic.
      - now rewrite no_report in H.
    Qed.

    Lemma grown_tree c : adds m -> In c (kinematic Y) -> up from to (kinematic Y) (from c) ROOT.
    Proof.
      intros G I. enough (H : up from to (kinematic X) (from c) ROOT).
      { eapply up_incl; [| exact H]. intros c'. now apply grown_kinematic. }
      apply kinematic_in in I as (I & R & T). destruct (visible_Y c I) as [[E N] | (J & _)].
      - apply tree_reaches_root. pose proof A as A'.
        destruct m as [ty nm ext ats other lb outgoing lats | k0 ats | tg up | k0 | old0 new0 ats | vx]; try easy;
        cbn [new_key accepts] in N, A'.
        + rewrite !andb_true_iff in A'. destruct A' as (_ & A'). destruct outgoing; injection N as Nf Nt Nl.
          * rewrite Nl, R in A'. discriminate.
          * rewrite Nl, R in A'. now rewrite <- Nf.
        + injection N as ->. apply andb_prop in A' as [A' _]. unfold edge_possible in A'. simpl in A'.
          rewrite R, !andb_true_iff in A'. tauto.
      - apply (one_kinematic_tree _ _ _ U). now apply kinematic_in.
    Qed.

    Lemma grown_paths v : adds m -> In v (vertices Y) -> joined (map ends (visible Y)) v ROOT.
    Proof.
      intros G I. assert (old : forall u, In u (vertices X) -> joined (map ends (visible Y)) u ROOT).
      { intros u J. apply joined_incl with (l := visible X); [intros c; now apply grown_edges |].
        now apply (all_paths _ _ _ U). }
      destruct (vertices_Y v I) as [J | (n & N)]; auto.
      assert (K : exists k, new_key X a m = Some k) by (destruct m; try easy; eexists; reflexivity).
      destruct K as (k & K). pose proof (new_edge_visible X a m k W A K) as S. apply (in_map ends) in S.
      unfold ends at 1, from, to in S. simpl in S. pose proof A as A'.
      destruct m as [ty nm ext ats other lb outgoing lats | k0 ats | tg up | k0 | old0 new0 ats | vx]; try easy.
      cbn [new_vertex new_key accepts] in *. injection N as <- _.
      rewrite !andb_true_iff in A'. destruct A' as ((_ & O) & _). apply vertices_in, old in O.
      destruct outgoing; injection K as <-; simpl in S.
      - eapply rst_trans; [apply rst_step; exact S | exact O].
      - eapply rst_trans; [apply rst_sym, rst_step; exact S | exact O].
    Qed.

    Lemma grown_clean : adds m -> clean Y.
    Proof.
      intros G. split; [apply wf_Y | apply settled_Y | apply ends_Y |]. split.
      - apply registers_Y.
      - apply parents_Y.
      - intros c. now apply grown_tree.
      - intros v. now apply grown_paths.
      - apply names_Y.
      - apply declared_Y.
    Qed.

    (** *** Mutations 4 to 6 strand nothing, and so leave nothing to reattach or to hang from ROOT *)

    Lemma none_stranded v : In v (vertices X) -> is_stranded D X v = false.
    Proof.
      intros I. apply not_true_iff_false. intros S. apply stranded_iff in S as [S | S].
      - apply (reported_detached D allows X) in S. now rewrite no_report in S.
      - apply S. apply joined_incl with (l := visible X); [| now apply (all_paths _ _ _ U)].
        intros c. apply (unbroken_shows_all D allows); [apply C | exact U].
    Qed.

    Lemma shrinks_strands_nothing : ~ adds m -> strands_nothing X Y = true.
    Proof.
      intros N. pose proof A as A'. unfold Y.
      destruct m as [ty nm ext ats other lb outgoing lats | k0 ats | tg up | k0 | old0 new0 ats | vx];
        cbn [accepts] in A'; rewrite ?andb_true_iff in A'; simpl in N; tauto.
    Qed.

    Lemma shrinks_not_stranded v : ~ adds m -> In v (vertices Y) -> is_stranded D Y v = false.
    Proof.
      intros N I. pose proof (shrinks_strands_nothing N) as S. unfold strands_nothing in S.
      rewrite forallb_forall in S. specialize (S v I). destruct (vertices_Y v I) as [J | (n & E)].
      - rewrite (none_stranded v J) in S. now destruct (is_stranded D Y v).
      - destruct m; simpl in *; try easy; tauto.
    Qed.

    (** What has no second parent, no cycle, and nobody stranded, is one tree with paths for all. *)
    Lemma shrunk_clean : ~ adds m -> acyclic from to (kinematic Y) -> clean Y.
    Proof.
      intros N Ac. split; [apply wf_Y | apply settled_Y | apply ends_Y |].
      assert (Up : unique_parents to (kinematic Y)) by (apply nodup_map; [apply kinematic_nodup | apply parents_Y]).
      destruct (nothing_hidden eq_dec Up Ac) as [Ay _]. fold (accepted Y) in Ay. split.
      - apply registers_Y.
      - apply parents_Y.
      - intros c I. assert (J : In c (accepted Y)) by (rewrite Ay; now apply -> in_rev).
        destruct (way_up_ends D allows Y (from c)) as (t & Wt & T).
        + unfold in_tree. pose proof (placement_spec Y (from c)) as Pl. destruct (placement Y (from c)); auto.
          destruct Pl as [_ Pl]. now destruct (Pl c J).
        + destruct T as [-> | T]; [eapply up_incl; [| exact Wt]; intros d; apply accepted_kinematic |].
          apply reported_detached in T. pose proof T as V. apply detached_in, filter_In in V as [V _].
          apply shrinks_not_stranded in V; auto. unfold is_stranded in V. now rewrite T in V.
      - intros v I. apply shrinks_not_stranded in I; auto. unfold is_stranded in I.
        apply orb_false_elim in I as [_ I]. apply negb_false_iff, eqb_eq in I.
        apply joined_incl with (l := shown D Y); [intros c; apply shown_visible |]. now apply same_component.
      - apply names_Y.
      - apply declared_Y.
    Qed.

    Lemma acyclic_incl l l' : incl l l' -> acyclic from to l' -> acyclic from to l.
    Proof. intros I Ac v T. apply (Ac v). eapply above_incl; eauto. Qed.

    Lemma acyclic_X : acyclic from to (kinematic X).
    Proof. eapply rooted_acyclic, U. Qed.

    (** Without a new kinematic edge there is no new cycle. *)
    Lemma removed_acyclic : (forall k, new_key X a m = Some k -> is_RT (key_label k) = false) ->
      acyclic from to (kinematic Y).
    Proof.
      intros N. apply acyclic_incl with (l' := kinematic X); [| apply acyclic_X].
      intros c (I & R & T)%kinematic_in. destruct (visible_Y c I) as [[_ K] | (J & _)].
      - apply N in K. simpl in K. congruence.
      - now apply kinematic_in.
    Qed.
  End Step.

  (** [MUT-5.3] A kinematic edge that moves closes no cycle: the conditions of the new key are asked where the
      old edge is gone. *)
  Lemma moved_acyclic X a old new l : clean X -> accepts X a (MoveEdge old new l) = true ->
    is_RT (key_label new) = true -> acyclic from to (kinematic (mutate D a (MoveEdge old new l) X)).
  Proof.
    intros C A Rn. set (m := MoveEdge old new l) in *. set (Y := mutate D a m X).
    set (Z := mutate D a (RemoveEdge old) X).
    pose proof (clean_wf X C) as W. pose proof (clean_unbroken X C) as U.
    assert (EP : edge_possible Z new = true).
    { unfold m in A. cbn [accepts] in A. rewrite !andb_true_iff in A. unfold Z. tauto. }
    (* What is left of the old edges is, in Z, accepted as it stands. *)
    assert (ZX : incl (kinematic Z) (kinematic X)).
    { intros c (I & R & T)%kinematic_in. apply kinematic_in. split; auto.
      apply visible_in in I as (G & (s & E) & _). rewrite E in G.
      apply mutate_held in G as [[] | [G _]]; auto. destruct c as [d x]. simpl in E, G. rewrite E.
      now apply edge_visible; try apply C. }
    assert (UZ : unique_parents to (kinematic Z)).
    { apply nodup_map; [apply kinematic_nodup |]. intros c c' I I'.
      apply (one_kinematic_parent _ _ _ U); auto. }
    assert (AZ : acyclic from to (kinematic Z)).
    { intros v T. eapply (rooted_acyclic _ _ _ U v), above_incl; eauto. }
    destruct (nothing_hidden eq_dec UZ AZ) as [E _]. fold (accepted Z) in E.
    assert (YZ : forall c, In c (kinematic Y) ->
      fst c = new_edge_dot X a m /\ Some new = Some (key c) \/ In c (accepted Z)).
    { intros c (I & R & T)%kinematic_in. destruct (visible_Y X a m C A c I) as [N | (J & K & _)]; [now left |].
      right. rewrite E, <- in_rev. apply kinematic_in. split; auto.
      apply visible_in in J as (G & (s & Ec) & Ne & F & To). pose proof (clean_settled X C) as S.
      assert (Vz : forall v, in_graph X v = true -> in_graph Z v = true).
      { intros v. now apply vertex_stays. }
      apply visible_in. repeat split; eauto.
      apply survives; auto; try easy; [intros b; apply (S _ _ b G) | now rewrite Ec |].
      intros I'. apply K. unfold m. cbn [plan killed make_records] in *. apply in_app_iff. now left. }
    destruct (existsb (fun c => eqb (fst c) (new_edge_dot X a m)) (kinematic Y)) eqn:B.
    - apply existsb_exists in B as (c & I & Ec). apply eqb_eq in Ec.
      assert (F : forest eq_dec from to (c :: accepted Z)).
      { constructor; [apply kinematic_forest |]. destruct (YZ c I) as [[_ K] | J].
        - injection K as K. unfold edge_possible in EP. rewrite Rn, K, !andb_true_iff in EP.
          destruct EP as (_ & ((_ & Pn) & _) & Tn).
          unfold View.key in Pn, Tn. cbn [key_from key_to] in Pn, Tn. apply judge_none. split.
          + apply parent_of_none. destruct (parent_of Z (to c)); [discriminate | reflexivity].
          + now apply eqb_neq, negb_true_iff.
        - (* its dot is new: it cannot be among the old *)
          exfalso. rewrite E, <- in_rev in J. apply ZX, kinematic_in in J as (J & _).
          apply visible_records, in_records in J. rewrite Ec in J.
          assert (H : holds X (new_edge_dot X a m) = true) by (unfold holds; now rewrite J).
          assert (Sn : seen X (new_edge_dot X a m) = false) by (apply next_dots_unseen; unfold m; lia).
          apply W in H. congruence. }
      eapply acyclic_incl; [| exact (forest_acyclic F)]. intros c' I'. destruct (YZ c' I') as [[E' _] | J].
      + left. apply (same_dot Y); [| | congruence]; eapply visible_records, kinematic_in; eassumption.
      + now right.
    - eapply acyclic_incl; [| exact AZ]. intros c I. destruct (YZ c I) as [[Ec _] | J].
      + apply not_true_iff_false in B. destruct B. apply existsb_exists. exists c. split; auto. now apply eqb_eq.
      + now apply accepted_kinematic in J.
  Qed.

  (** ** [VIEW-12] *)

  (** Each of the six, if its conditions hold, keeps a clean state clean. *)
  Theorem accepted_keeps_clean X a m : clean X -> accepts X a m = true -> clean (mutate D a m X).
  Proof.
    intros C A. destruct m as [ty nm ext ats other lb outgoing lats | k ats | tg up | k | old new ats | v].
    - now apply grown_clean.
    - now apply grown_clean.
    - now apply grown_clean.
    - apply shrunk_clean; auto. now apply removed_acyclic.
    - apply shrunk_clean; auto. destruct (is_RT (key_label new)) eqn:R.
      + now apply moved_acyclic.
      + apply removed_acyclic; auto. intros k [= <-]. exact R.
    - apply shrunk_clean; auto. now apply removed_acyclic.
  Qed.

  (** The states that mutations make, one after the other, by whatever authors. *)
  Inductive sequential : State -> Prop :=
  | sequential_bottom : sequential bottom
  | sequential_step X a m : sequential X -> accepts X a m = true -> sequential (mutate D a m X).

  Theorem sequential_clean X : sequential X -> clean X.
  Proof. induction 1; [apply clean_bottom | now apply accepted_keeps_clean]. Qed.

  (** [VIEW-12] One replica alone never sees a repair: under one dictionary the view reports nothing, *)
  Theorem sequential_reports_nothing X : sequential X -> repairs D allows X = [].
  Proof. intros S. now apply clean_reports_nothing, sequential_clean. Qed.

  (** and every edge and write held is shown as it is. *)
  Theorem sequential_shows_all X : sequential X ->
    (forall d f t l s, get X d = Some (Edge f t l s) -> In (d, Edge f t l s) (shown D X)) /\
    shown_writes allows X = live_writes X.
  Proof.
    intros S. apply sequential_clean in S. split.
    - intros d f t l s G. apply (unbroken_shows_all D allows); try apply S. now apply edge_visible; try apply S.
    - apply (unbroken_shows_all_writes D), S.
  Qed.
End Sequential.

(** ** Runs, and what VIEW-12 rests on *)

(** Mutations one after the other; none if one is refused. *)
Fixpoint run (D : Dictionary) (allows : Name -> N -> bool) (ms : list (Author * Mutation)) (X : State) : option State :=
  match ms with
  | [] => Some X
  | (a, m) :: ms => if accepts D allows X a m then run D allows ms (mutate D a m X) else None
  end.

Theorem run_is_sequential D allows ms : forall X Y,
  sequential D allows X -> run D allows ms X = Some Y -> sequential D allows Y.
Proof.
  induction ms as [| [a m] ms IH]; simpl; intros X Y S; [congruence |].
  destruct (accepts D allows X a m) eqn:A; [| easy]. apply IH. now constructor.
Qed.

Section Examples.
  Open Scope string_scope.
  Let by_agent (n : N) : Author := {| me := {| agent := n; incarnation := 0 |}; time_ns := 0 |}.
  Let one := by_agent 1.
  Let two := by_agent 2.
  Let no_attributes : Attributes := empty.
  Let k f l t : Key := {| key_from := f; key_to := t; key_label := l |}.
  Let true_ : Value := {| value_type := 4; items := [1%Z] |}.
  Let plain : Dictionary := {| functional := fun _ => false |}.
  Let rooms : Dictionary := {| functional := fun l => eqb l "in" |}.
  Let open_ : Name -> N -> bool := fun _ _ => true.

  (** The conditions are not void: a story of all six, by two authors, each of them accepted. Two rooms (r1.1,
      r1.3), a robot in the first (r2.1), a camera on the robot (r2.3); the robot sees the camera, moves, and sees
      it no more; the camera goes. *)
  Let story : list (Author * Mutation) :=
    [ (one, AddVertex "room" "kitchen" None no_attributes ROOT "RT" false no_attributes);
      (one, AddVertex "room" "hall" None no_attributes ROOT "RT" false no_attributes);
      (two, AddVertex "robot" "tim" None no_attributes (r 1 1) "RT" false no_attributes);
      (two, AddVertex "camera" "eye" None no_attributes (r 2 1) "RT" false no_attributes);
      (one, AddEdge (k (r 2 1) "in" (r 1 1)) no_attributes);
      (one, AddEdge (k (r 2 1) "sees" (r 2 3)) no_attributes);
      (one, UpdateAttributes (r 2 3) (insert "on" (Some true_) empty));
      (two, MoveEdge (k (r 2 1) "in" (r 1 1)) (k (r 2 1) "in" (r 1 3)) no_attributes);
      (two, MoveEdge (k (r 1 1) "RT" (r 2 1)) (k (r 1 3) "RT" (r 2 1)) no_attributes);
      (one, RemoveEdge (k (r 2 1) "sees" (r 2 3)));
      (one, RemoveVertex (r 2 3)) ].

  Theorem story_is_accepted :
    match run rooms open_ story bottom with
    | Some X => map fst (shown rooms X) = [r 2 5; r 1 2; r 1 4; r 2 6] /\ repairs rooms open_ X = []
    | None => False
    end.
  Proof. vm_compute. split; reflexivity. Qed.

  (** "Under one dictionary": two places are no repair until the dictionary calls the label functional. *)
  Theorem one_dictionary_is_needed :
    match run plain open_
      [ (one, AddVertex "room" "kitchen" None no_attributes ROOT "RT" false no_attributes);
        (one, AddVertex "room" "hall" None no_attributes ROOT "RT" false no_attributes);
        (one, AddVertex "robot" "tim" None no_attributes (r 1 1) "in" true no_attributes);
        (one, AddEdge (k (r 1 5) "in" (r 1 3)) no_attributes) ] bottom
    with
    | Some X => repairs plain open_ X = [] /\ repairs rooms open_ X = [Superseded (r 1 6) (r 1 7) Functional]
    | None => False
    end.
  Proof. vm_compute. split; reflexivity. Qed.

  (** "A view without repairs" alone is not kept: an accepted mutation can make a pending claim visible, if its author
      anchored the claim to a dot that was not made yet. Honest authors do not (NET-5); WF-1 to WF-6 allow it. *)
  Let waiting : State :=
    make (fun d => if eqb d (r 2 1) then Held (Vertex "room" "hall" None 1)
                   else if eqb d (r 2 2) then Held (Edge ROOT (r 2 1) "holds" 1)
                   else Held (Edge (r 1 1) (r 2 1) "RT" 2)) [r 2 1; r 2 2; r 2 3].
  Let newcomer : Mutation := AddVertex "robot" "tim" None no_attributes ROOT "in" true no_attributes.

  Theorem pending_claim_surfaces :
    check_wf waiting = true /\ check_anchors waiting = true /\ repairs plain open_ waiting = [] /\
    accepts plain open_ waiting one newcomer = true /\
    repairs plain open_ (mutate plain one newcomer waiting) = [Detached (r 1 1)].
  Proof. vm_compute. repeat split; reflexivity. Qed.

  (** MUT-4.2 is needed: each of these is refused, and would have stranded somebody. *)
  Theorem stranding_is_refused :
    match run plain open_
      [ (one, AddVertex "robot" "tim" None no_attributes ROOT "RT" false no_attributes);
        (one, AddVertex "camera" "eye" None no_attributes (r 1 1) "RT" false no_attributes) ] bottom
    with
    | Some X =>
        let cut := RemoveEdge (k ROOT "RT" (r 1 1)) in
        let drop := RemoveVertex (r 1 1) in
        accepts plain open_ X one cut = false /\ accepts plain open_ X one drop = false /\
        repairs plain open_ (mutate plain one cut X) = [Detached (r 1 1)] /\
        repairs plain open_ (mutate plain one drop X) = [Reattached (r 1 3)]
    | None => False
    end.
  Proof. vm_compute. repeat split; reflexivity. Qed.
End Examples.
