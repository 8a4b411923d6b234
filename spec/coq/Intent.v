(** * Intent: what stays shown, and what surfaces (intent.md)

    [X ≤ Y]: Y is some later state, whatever was joined in between. What X shows Y shows, unless it died or
    something that X did not show outranks it. INTENT-2's table of conflicts is not modelled; INTENT-3's "in one
    way only" is not so: see the counterexamples. *)

From DSR Require Import Join Mutations.
From DSR Require Export Sequential.
From Coq Require Import Relations.

Definition nothing_functional : Dictionary := {| functional := fun _ => false |}.

(** Of two states whatever: a kinematic claim that one shows and the other hides is hidden by what only the other
    shows. *)
Lemma displaced X Y c : In c (accepted X) -> In c (kinematic Y) -> In c (accepted Y) \/
  exists s, In s (accepted Y) /\ ltb (claim_rank s) (claim_rank c) = false /\ ~ In s (accepted X).
Proof.
  intros A K. destruct (kinematic_shown_or_refused Y c K) as [S | (why & H)]; [now left | right].
  pose proof (refused_not_accepted Y c why H) as N.
  pose proof (refused_has_cause Y c why H) as Ca. destruct why as [s |].
  - destruct Ca as (S & Ts & Lt). exists s. repeat split; auto. intros B. apply N.
    destruct (proj2 (shown_RT nothing_functional X s) B) as [Bs Rs],
      (proj2 (shown_RT nothing_functional X c) A) as [Ac Rc].
    now rewrite <- (unique_parent nothing_functional X s c).
  - destruct Ca as (g & G & F & Co). rewrite Forall_forall in F.
    destruct (existsb (fun s => negb (member s (accepted X))) g) eqn:B.
    + apply existsb_exists in B as (s & M & B). exists s. repeat split; auto.
      intros Q. apply member_in in Q. now rewrite Q in B.
    + exfalso. destruct (kinematic_acyclic X) as [_ Ac].
      destruct (in_split _ _ A) as (before & after & E). apply (Ac _ _ _ E). eapply connected_incl; [| exact Co].
      intros s M. assert (Q : In s (accepted X)).
      { apply member_in. rewrite <- not_true_iff_false in B. destruct (member s (accepted X)) eqn:Q; auto.
        exfalso. apply B, existsb_exists. exists s. now rewrite Q. }
      rewrite E in Q. apply in_app_iff in Q as [Q | [<- | Q]]; apply in_app_iff; auto.
      now apply G, N in M.
Qed.

Section Later.
  Context (D : Dictionary) (allows : Name -> N -> bool).
  Context (X Y : State) (L : X ≤ Y) (C : closed Y).

  Lemma later_held d x : get X d = Some x -> is_dead Y d = true \/ get Y d = Some x.
  Proof.
    intros G. apply cond_held in G. pose proof (L d) as B. rewrite G in B. rewrite <- cond_held, <- cond_dead.
    destruct (cond Y d); inversion B; auto.
  Qed.

  (** [INTENT-2] A vertex stays in the graph until it is removed. *)
  Theorem vertex_stays_in_graph v : In v (vertices X) -> is_dead Y v = true \/ In v (vertices Y).
  Proof.
    rewrite !vertices_in. unfold in_graph. destruct (is_root v); [auto |]. simpl.
    destruct (get X v) as [x |] eqn:G; [| easy]. intros V. destruct (later_held _ _ G) as [K | ->]; auto.
  Qed.

  (** A visible claim stays visible until it dies. *)
  Lemma stays_visible c : In c (visible X) -> is_dead Y (fst c) = true \/ In c (visible Y).
  Proof.
    intros I. apply visible_in in I as (G & (s & E) & N & F & T).
    destruct (later_held _ _ G) as [K | H]; [now left | right].
    assert (A : forall b, In b (anchors (snd c)) -> in_graph X b = true -> in_graph Y b = true).
    { intros b J B. apply vertices_in in B. apply vertex_stays_in_graph in B as [K | B]; [| now apply vertices_in].
      rewrite (C _ _ _ H J) in K. discriminate. }
    apply visible_in. repeat split; eauto; apply A; auto; rewrite E; simpl; auto.
  Qed.

  (** [INTENT-2] A symbolic edge that is shown stays so until it dies, or a greater claim on its register comes
      that was not visible before. *)
  Theorem symbolic_edge_stays c : In c (winners D X) ->
    is_dead Y (fst c) = true \/ In c (winners D Y) \/
    exists s, In s (winners D Y) /\ competes D (key c) (snd s) = true /\
      ltb (claim_rank c) (claim_rank s) = true /\ ~ In s (visible X).
  Proof.
    intros Wc. pose proof Wc as I. apply filter_In in I as [I _]. apply symbolic_in in I as [I R].
    destruct (stays_visible _ I) as [K | J]; [now left | right].
    destruct (shown_or_superseded D allows Y c) as [S | (s & S & Co & Lt & _)]; [now apply symbolic_in | now left |].
    right. exists s. repeat split; auto. intros V.
    rewrite (winner_is_greatest D X c s) in Lt; auto; [discriminate |]. apply symbolic_in. split; auto.
    apply filter_In in S as [S _]. now apply symbolic_in in S.
  Qed.

  (** [INTENT-2] [INTENT-4] So does a kinematic edge, until it dies or a claim is shown above it that was not shown
      before: it came, or was pending, or was hidden. *)
  Theorem kinematic_edge_stays c : In c (accepted X) ->
    is_dead Y (fst c) = true \/ In c (accepted Y) \/
    exists s, In s (accepted Y) /\ ltb (claim_rank s) (claim_rank c) = false /\ ~ In s (accepted X).
  Proof.
    intros A. pose proof A as K. apply accepted_kinematic, kinematic_in in K as (I & R & T).
    destruct (stays_visible _ I) as [Z | J]; [now left | right]. apply displaced; auto. now apply kinematic_in.
  Qed.

  (** [INTENT-2] The write that is read stays so until it dies, or a greater write of the attribute comes that was
      not shown before. *)
  Theorem attribute_stays t n c : attribute allows X t n = Some c ->
    is_dead Y (fst c) = true \/ attribute allows Y t n = Some c \/
    exists s, attribute allows Y t n = Some s /\ ltb (claim_rank c) (claim_rank s) = true /\ ~ In s (shown_writes allows X).
  Proof.
    intros A. pose proof (attribute_is_greatest allows X t n) as Gx. rewrite A in Gx. destruct Gx as (I & Wr & Best).
    pose proof I as J. apply filter_In in J as [J De]. apply filter_In in J as [G Li]. apply in_records in G.
    destruct (later_held _ _ G) as [K | H]; [now left | right].
    assert (S : In c (shown_writes allows Y)).
    { apply filter_In. split; auto. apply filter_In. split; [now apply in_records |].
      unfold is_live_write in *. destruct (snd c) as [| | u m v z st] eqn:Ec; try easy.
      assert (N : is_dead Y u = false) by (apply (C _ _ u H); now left).
      unfold is_element in *. apply orb_prop in Li as [Li | Li].
      - apply vertices_in, vertex_stays_in_graph in Li as [K | Li]; [congruence |]. apply vertices_in in Li. now rewrite Li.
      - destruct (get X u) as [x |] eqn:Gu; [| easy].
        destruct (stays_visible (u, x)) as [K | V]; [apply filter_In; split; [now apply in_records | exact Li] | |].
        + simpl in K. congruence.
        + apply filter_In in V as [V W]. apply in_records in V. simpl in V. rewrite V, W. apply orb_true_r. }
    pose proof (attribute_is_greatest allows Y t n) as Gy. destruct (attribute allows Y t n) as [s |].
    - destruct Gy as (Is & Ws & Bs). destruct (eqb c s) eqn:E; [left; apply eqb_eq in E; congruence | right].
      apply eqb_neq in E. exists s. pose proof (Bs c S Wr E) as Lt. repeat split; auto.
      intros V. assert (N : s <> c) by congruence. pose proof (Best s V Ws N) as Q. apply ltb_asym in Q. congruence.
    - now rewrite (Gy c S) in Wr.
  Qed.

  (** [INTENT-3] A symbolic claim that is hidden surfaces only if the claim shown in its place has died. *)
  Theorem loser_surfaces_by_death h : In h (symbolic X) -> ~ In h (winners D X) -> In h (winners D Y) ->
    exists s, In s (winners D X) /\ competes D (key h) (snd s) = true /\
      ltb (claim_rank h) (claim_rank s) = true /\ is_dead Y (fst s) = true.
  Proof.
    intros I N W. destruct (shown_or_superseded D allows X h I) as [S | (s & S & Co & Lt & _)]; [easy |].
    exists s. repeat split; auto. pose proof S as V. apply filter_In in V as [V _]. apply symbolic_in in V as [V R].
    destruct (stays_visible _ V) as [K | J]; auto. exfalso.
    rewrite (winner_is_greatest D Y h s) in Lt; auto; [discriminate |]. now apply symbolic_in.
  Qed.
  (** [INTENT-3] [INTENT-4] A kinematic one only if a claim of greater rank that was shown is shown no more: it died,
      or is hidden itself. *)
  Theorem kinematic_loser_surfaces h : In h (kinematic X) -> ~ In h (accepted X) -> In h (accepted Y) ->
    exists s, In s (accepted X) /\ ltb (claim_rank s) (claim_rank h) = false /\ ~ In s (accepted Y).
  Proof. intros K N A. destruct (displaced Y X h A K) as [B | B]; [easy | exact B]. Qed.
End Later.

(** ** [INTENT-3] The two ways in which a loser surfaces without closure *)

Section Examples.
  Open Scope string_scope.
  Let by_agent (n : N) : Author := {| me := {| agent := n; incarnation := 0 |}; time_ns := 0 |}.
  Let none : Attributes := empty.
  Let k f l t : Key := {| key_from := f; key_to := t; key_label := l |}.
  Let plain : Dictionary := {| functional := fun _ => false |}.
  Let open_ : Name -> N -> bool := fun _ _ => true.
  Let add name := (by_agent 1, AddVertex "thing" name None none ROOT "RT" false none).
  Let base : State := match run plain open_ [add "a"; add "b"; add "c"] bottom with Some X => X | None => bottom end.
  Let a := r 1 1.
  Let b := r 1 3.
  Let c := r 1 5.
  (** What a replica that has the base alone says, and whether it may. *)
  Let says n m := delta plain (by_agent n) m base.
  Let may n m := accepts plain open_ base (by_agent n) m.

  (** A removal by somebody who never saw the loser: r2 and r3 draw one edge, r4 has r3's alone and takes it away.
      Nothing dies by closure. *)
  Theorem loser_surfaces_by_removal :
    let edge := AddEdge (k a "sees" b) none in
    let seen_by_r4 := base ⊔ says 3 edge in
    let cut := RemoveEdge (k a "sees" b) in
    let X := seen_by_r4 ⊔ says 2 edge in
    let Y := X ⊔ delta plain (by_agent 4) cut seen_by_r4 in
    let sees Z := map fst (filter (fun e => negb (is_RT (label e))) (shown plain Z)) in
    may 2 edge && may 3 edge && accepts plain open_ seen_by_r4 (by_agent 4) cut = true /\
    sees X = [r 3 1] /\ sees Y = [r 2 1].
  Proof. vm_compute. repeat split; reflexivity. Qed.

  (** A kinematic winner can be hidden while it lives: r2 hangs c from a, r3 hangs c from b, r4 hangs b from c. r3's
      claim wins over r2's, until r4's makes it a cycle; then r2's is shown again, and nothing has died. *)
  Theorem loser_surfaces_by_cycle :
    let m2 := MoveEdge (k ROOT "RT" c) (k a "RT" c) none in
    let m3 := MoveEdge (k ROOT "RT" c) (k b "RT" c) none in
    let m4 := MoveEdge (k ROOT "RT" b) (k c "RT" b) none in
    let X := base ⊔ says 2 m2 ⊔ says 3 m3 in
    let Y := X ⊔ says 4 m4 in
    may 2 m2 && may 3 m3 && may 4 m4 = true /\
    repairs plain open_ X = [Superseded (r 2 1) (r 3 1) RtParent] /\
    repairs plain open_ Y = [CycleBroken (r 3 1)] /\ holds Y (r 3 1) = true.
  Proof. vm_compute. repeat split; reflexivity. Qed.
End Examples.
