(** * The kinematic forest: claims accepted greedily [VIEW-3]

    A claim says "my child hangs from my parent". Claims come in a list, the greatest rank first. Each is
    accepted unless its child has an accepted parent already, or unless it would close a cycle with those
    accepted, whatever their direction. Nothing here knows of states: [V] are vertices, [C] claims. *)

Require Import List Arith Lia Bool Permutation Relations.
Import ListNotations.
Set Implicit Arguments.

Section Forest.

Variable V C : Type.
Variable V_eq_dec : forall u v : V, {u = v} + {u <> v}.
Variables parent child : C -> V.

(** ** Relations that a set of claims makes *)

(** [v] is a parent of [u]. *)
Definition step (claims : list C) (u v : V) : Prop :=
  exists c, In c claims /\ child c = u /\ parent c = v.

(** The way up, of any number of steps. *)
Definition up (claims : list C) : V -> V -> Prop := clos_refl_trans V (step claims).

(** Joined by a path of claims, whatever their direction. *)
Definition connected (claims : list C) : V -> V -> Prop := clos_refl_sym_trans V (step claims).

(** No vertex has two parents: no two claims have the same child. *)
Definition unique_parents (claims : list C) : Prop := NoDup (map child claims).

(** No vertex is above itself. *)
Definition acyclic (claims : list C) : Prop := forall v, ~ clos_trans V (step claims) v v.

(** No cycle whatever the direction: without a claim nothing joins its two ends. *)
Definition acyclic_undirected (claims : list C) : Prop :=
  forall before c after, claims = before ++ c :: after -> ~ connected (before ++ after) (parent c) (child c).

(** ** The algorithm *)

(** The top of the tree that [v] is in. [accepted] holds the newest claim first; a claim hangs the tree
    whose top is its child below its parent. *)
Fixpoint top (accepted : list C) (v : V) : V :=
  match accepted with
  | [] => v
  | c :: older =>
      let t := top older v in
      if V_eq_dec t (child c) then top older (parent c) else t
  end.

(** The accepted claim that gives [v] a parent. *)
Definition parent_claim (accepted : list C) (v : V) : option C :=
  find (fun c => if V_eq_dec (child c) v then true else false) accepted.

(** Why a claim is refused. *)
Inductive reason : Type :=
| OtherParent (shown : C)  (** its child has a parent by [shown] *)
| ClosesCycle.             (** it would close a cycle *)

(** What becomes of a claim, after those accepted: [None] if it is accepted as well. *)
Definition judge (accepted : list C) (c : C) : option reason :=
  match parent_claim accepted (child c) with
  | Some shown => Some (OtherParent shown)
  | None => if V_eq_dec (top accepted (parent c)) (child c) then Some ClosesCycle else None
  end.

(** Accepted claims, the newest first, and the refused with the reason, as they came. *)
Fixpoint grow (accepted claims : list C) : list C * list (C * reason) :=
  match claims with
  | [] => (accepted, [])
  | c :: rest =>
      match judge accepted c with
      | None => grow (c :: accepted) rest
      | Some why => let (shown, hidden) := grow accepted rest in (shown, (c, why) :: hidden)
      end
  end.

Definition shown (claims : list C) : list C := fst (grow [] claims).
Definition hidden (claims : list C) : list (C * reason) := snd (grow [] claims).

(** ** What acceptance keeps *)

(** What is built by accepting. *)
Inductive forest : list C -> Prop :=
| forest_nil : forest []
| forest_cons c accepted :
    forest accepted -> judge accepted c = None -> forest (c :: accepted).

Lemma parent_claim_none accepted v :
  parent_claim accepted v = None <-> (forall c, In c accepted -> child c <> v).
Proof.
  unfold parent_claim; split.
  - intros none c Hin Hc. apply (find_none _ _ none) in Hin.
    destruct (V_eq_dec (child c) v); congruence.
  - induction accepted as [|c older IH]; intros no; simpl; auto.
    destruct (V_eq_dec (child c) v) as [e|_].
    + exfalso; apply (no c); simpl; auto.
    + apply IH; intros; apply no; simpl; auto.
Qed.

Lemma parent_claim_some accepted v c :
  parent_claim accepted v = Some c -> In c accepted /\ child c = v.
Proof.
  unfold parent_claim; intros H. apply find_some in H as [Hin H].
  destruct (V_eq_dec (child c) v); intuition congruence.
Qed.

Lemma judge_none accepted c :
  judge accepted c = None <->
  (forall c', In c' accepted -> child c' <> child c) /\ top accepted (parent c) <> child c.
Proof.
  unfold judge. rewrite <- parent_claim_none.
  destruct (parent_claim accepted (child c)); [intuition congruence|].
  destruct (V_eq_dec (top accepted (parent c)) (child c)); intuition congruence.
Qed.

(** Whoever has no parent is the top of its tree. *)
Lemma top_of_top accepted v : (forall c, In c accepted -> child c <> v) -> top accepted v = v.
Proof.
  induction accepted as [|c older IH]; intros no; simpl; auto.
  rewrite IH by (intros; apply no; simpl; auto).
  destruct (V_eq_dec v (child c)) as [e|]; auto.
  exfalso; apply (no c); simpl; auto.
Qed.

Lemma step_incl l l' u v : incl l l' -> step l u v -> step l' u v.
Proof. intros i (c & ? & ?). exists c; auto. Qed.

Lemma above_incl l l' u v : incl l l' -> clos_trans V (step l) u v -> clos_trans V (step l') u v.
Proof. intros i H. induction H; [apply t_step | eapply t_trans]; eauto using step_incl. Qed.

Lemma up_incl l l' u v : incl l l' -> up l u v -> up l' u v.
Proof.
  intros i H. induction H; [apply rt_step | apply rt_refl | eapply rt_trans]; eauto using step_incl.
Qed.

Lemma connected_incl l l' u v : incl l l' -> connected l u v -> connected l' u v.
Proof.
  intros i H. induction H;
    [apply rst_step | apply rst_refl | apply rst_sym | eapply rst_trans]; eauto using step_incl.
Qed.

Lemma up_connected l u v : up l u v -> connected l u v.
Proof. intros H. induction H; [apply rst_step | apply rst_refl | eapply rst_trans]; eauto. Qed.

(** The way up ends at the top. *)
Lemma up_to_top accepted v : forest accepted -> up accepted v (top accepted v).
Proof.
  intros F; revert v. induction F as [|c older F IH J]; intros v; simpl; [apply rt_refl|].
  assert (lift : forall u w, up older u w -> up (c :: older) u w)
    by (intros; eapply up_incl; eauto; intros ?; simpl; auto).
  destruct (V_eq_dec (top older v) (child c)) as [e|]; [|auto].
  eapply rt_trans; [apply lift, IH|]. rewrite e.
  eapply rt_trans; [apply rt_step; exists c; simpl; eauto | apply lift, IH].
Qed.

(** The top has no parent. *)
Lemma top_has_no_parent accepted v c : forest accepted -> In c accepted -> child c <> top accepted v.
Proof.
  intros F; revert v c. induction F as [|c0 older F IH J]; intros v c Hin; simpl in *; [tauto|].
  apply judge_none in J as [new apart].
  destruct (V_eq_dec (top older v) (child c0)) as [e|n].
  - destruct Hin as [<-|Hin]; auto.
  - destruct Hin as [<-|Hin]; auto.
Qed.

(** *** Merging two classes

    If [f] gives two elements one value exactly when [R] joins them, and [a] and [b] are joined as well, then
    let whoever had the value of [a] have that of [b]. The same lemma serves trees here and components of
    the whole graph [VIEW-5]. *)
Lemma merge_classes (R R' : relation V) (f f' : V -> V) (a b : V) :
  (forall u v, f u = f v <-> clos_refl_sym_trans V R u v) ->
  (forall u v, R' u v <-> R u v \/ (u = a /\ v = b)) ->
  (forall u, f' u = if V_eq_dec (f u) (f a) then f b else f u) ->
  forall u v, f' u = f' v <-> clos_refl_sym_trans V R' u v.
Proof.
  intros Hf HR Hf' u v.
  assert (sub : forall x y, clos_refl_sym_trans V R x y -> clos_refl_sym_trans V R' x y).
  { intros x y H; induction H; [apply rst_step, HR; auto | apply rst_refl | apply rst_sym; auto
                               | eapply rst_trans; eauto]. }
  assert (ab : clos_refl_sym_trans V R' a b) by (apply rst_step, HR; auto).
  split.
  - assert (rep : forall x, exists y, f y = f' x /\ clos_refl_sym_trans V R' x y).
    { intros x. rewrite Hf'. destruct (V_eq_dec (f x) (f a)) as [e|].
      - exists b; split; auto. eapply rst_trans; [apply sub, Hf, e | exact ab].
      - exists x; split; auto using rst_refl. }
    intros H. destruct (rep u) as (u' & eu & Hu), (rep v) as (v' & ev & Hv).
    eapply rst_trans; [exact Hu|]. eapply rst_trans; [|apply rst_sym; exact Hv].
    apply sub, Hf. congruence.
  - intros H; induction H as [x y H| | |]; try congruence.
    rewrite 2 Hf'. apply HR in H as [H|[-> ->]].
    + assert (e : f x = f y) by (apply Hf, rst_step; auto).
      rewrite e; reflexivity.
    + destruct (V_eq_dec (f a) (f a)); [|congruence]. destruct (V_eq_dec (f b) (f a)); congruence.
Qed.

(** Two vertices have one top exactly if claims join them, whatever the direction: [top] is the union-find
    of the implementation. *)
Theorem same_top_iff_connected accepted :
  forest accepted -> forall u v, top accepted u = top accepted v <-> connected accepted u v.
Proof.
  intros F. induction F as [|c older F IH J].
  - intros u v; simpl; split; [intros ->; apply rst_refl|].
    intros H; induction H as [x y (? & [] & _)| | |]; congruence.
  - apply judge_none in J as [new apart].
    apply merge_classes with (R := step older) (f := top older) (a := child c) (b := parent c); auto.
    + intros u v; split.
      * intros (c' & [<-|Hin] & <- & <-); [auto | left; exists c'; auto].
      * intros [(c' & ? & ?)|[-> ->]]; [exists c' | exists c]; simpl; auto.
    + intros u; simpl. rewrite (top_of_top (v := child c) older) by auto. reflexivity.
Qed.

(** [VIEW-3] The rule, as the chapter states it: a claim is refused for its child's other parent, or else
    if its two ends are joined already, whatever the direction. Asking whether the child is above the parent
    is enough, since the child has no parent by then. *)
Theorem judge_is_the_rule accepted c :
  forest accepted ->
  match judge accepted c with
  | Some (OtherParent s) => In s accepted /\ child s = child c
  | Some ClosesCycle =>
      (forall c', In c' accepted -> child c' <> child c) /\ connected accepted (parent c) (child c)
  | None =>
      (forall c', In c' accepted -> child c' <> child c) /\ ~ connected accepted (parent c) (child c)
  end.
Proof.
  intros F. unfold judge. destruct (parent_claim accepted (child c)) as [s|] eqn:E.
  - apply parent_claim_some; auto.
  - assert (new : forall c', In c' accepted -> child c' <> child c) by (apply parent_claim_none; auto).
    assert (same : top accepted (parent c) = child c <-> connected accepted (parent c) (child c)).
    { rewrite <- same_top_iff_connected by auto. rewrite (top_of_top (v := child c) accepted) by auto. tauto. }
    destruct (V_eq_dec (top accepted (parent c)) (child c)); rewrite <- same; auto.
Qed.

Lemma forest_cons_iff c accepted :
  forest (c :: accepted) <->
  forest accepted /\ (forall c', In c' accepted -> child c' <> child c)
  /\ ~ connected accepted (parent c) (child c).
Proof.
  split.
  - inversion 1 as [|? ? F J]; subst. pose proof (judge_is_the_rule c F) as R. rewrite J in R. tauto.
  - intros (F & new & apart). constructor; auto. apply judge_none; split; auto.
    intros e. apply apart. rewrite <- same_top_iff_connected by auto. rewrite e. symmetry. apply top_of_top; auto.
Qed.

(** Steps up lead to where the depth is less. *)
Lemma forest_depth accepted :
  forest accepted -> exists depth : V -> nat, forall u v, step accepted u v -> depth v < depth u.
Proof.
  intros F. induction F as [|c older F [d Hd] J].
  - exists (fun _ => 0). intros u v (c & [] & _).
  - apply judge_none in J as [new apart].
    exists (fun v => if V_eq_dec (top older v) (child c) then d v + 1 + d (parent c) else d v).
    intros u v (c' & [<-|Hin] & <- & <-).
    + rewrite (top_of_top (v := child c) older) by auto.
      destruct (V_eq_dec (child c) (child c)); [|congruence].
      destruct (V_eq_dec (top older (parent c)) (child c)); [congruence | lia].
    + assert (s : step older (child c') (parent c')) by (exists c'; auto).
      assert (t : top older (child c') = top older (parent c'))
        by (apply same_top_iff_connected; auto; apply rst_step; auto).
      apply Hd in s. rewrite t. destruct (V_eq_dec (top older (parent c')) (child c)); lia.
Qed.

Lemma forest_unique accepted : forest accepted -> unique_parents accepted.
Proof.
  unfold unique_parents. induction 1 as [|c older F IH J]; simpl; constructor; auto.
  apply judge_none in J as [new _]. rewrite in_map_iff. intros (c' & e & Hin). apply (new c'); auto.
Qed.

Lemma forest_acyclic accepted : forest accepted -> acyclic accepted.
Proof.
  intros F v H. destruct (forest_depth F) as [d Hd].
  assert (less : forall x y, clos_trans V (step accepted) x y -> d y < d x).
  { intros x y T; induction T; [auto | lia]. }
  apply less in H; lia.
Qed.

Lemma up_then_step l u v w : up l u v -> step l v w -> clos_trans V (step l) u w.
Proof.
  intros H; revert w; apply clos_rt_rt1n in H; induction H as [|x y z Hxy H IH]; intros w Hw.
  - apply t_step; auto.
  - eapply t_trans; [apply t_step; exact Hxy | auto].
Qed.

(** What acceptance builds is exactly what has unique parents and no cycle: the order does not matter. *)
Theorem forest_iff l : forest l <-> unique_parents l /\ acyclic l.
Proof.
  split; [auto using forest_unique, forest_acyclic|].
  induction l as [|c older IH]; intros [U A]; [constructor|].
  inversion U as [|? ? new U']; subst.
  assert (F : forest older).
  { apply IH; split; auto. intros v H. apply (A v). eapply above_incl; eauto. intros ?; simpl; auto. }
  assert (none : forall c', In c' older -> child c' <> child c).
  { intros c' Hin e. apply new. rewrite <- e. apply in_map; auto. }
  constructor; auto. apply judge_none; split; auto.
  intros e. apply (A (parent c)). eapply up_then_step; [|exists c; simpl; eauto].
  eapply up_incl with (l := older); [intros ?; simpl; auto|]. rewrite <- e. apply up_to_top; auto.
Qed.

Lemma forest_permutation l l' : Permutation l l' -> forest l -> forest l'.
Proof.
  intros P F. apply forest_iff in F as [U A]. apply forest_iff; split.
  - unfold unique_parents. eapply Permutation_NoDup; [apply Permutation_map; eauto | auto].
  - intros v H. apply (A v). eapply above_incl; eauto. intros c Hin.
    eapply Permutation_in; [apply Permutation_sym|]; eauto.
Qed.

(** With unique parents a cycle of any direction is a cycle upwards. *)
Theorem forest_iff_undirected l : forest l <-> unique_parents l /\ acyclic_undirected l.
Proof.
  split.
  - intros F; split; [apply forest_unique; auto|]. intros before c after ->.
    apply forest_permutation with (l' := c :: before ++ after) in F;
      [|apply Permutation_sym, Permutation_middle].
    apply forest_cons_iff in F; tauto.
  - induction l as [|c older IH]; intros [U A]; [constructor|].
    inversion U as [|? ? new U']; subst. apply forest_cons_iff; repeat split.
    + apply IH; split; auto. intros before c' after -> conn.
      apply (A (c :: before) c' after); auto.
      eapply connected_incl; eauto. intros ?; simpl; auto.
    + intros c' Hin e. apply new. rewrite <- e. apply in_map; auto.
    + apply (A [] c older); auto.
Qed.

(** ** What the algorithm returns *)

Lemma grow_forest claims : forall accepted, forest accepted -> forest (fst (grow accepted claims)).
Proof.
  induction claims as [|c rest IH]; intros accepted F; simpl; auto.
  destruct (judge accepted c) as [why|] eqn:J.
  - specialize (IH accepted F). destruct (grow accepted rest); auto.
  - apply IH. constructor; auto.
Qed.

Lemma grow_keeps claims : forall accepted, incl accepted (fst (grow accepted claims)).
Proof.
  induction claims as [|c rest IH]; intros accepted; simpl; [apply incl_refl|].
  destruct (judge accepted c).
  - specialize (IH accepted). destruct (grow accepted rest); auto.
  - intros x Hx. apply IH. simpl; auto.
Qed.

(** Each claim is accepted or refused, and none is invented. *)
Lemma grow_partition claims : forall accepted,
  Permutation (accepted ++ claims) (fst (grow accepted claims) ++ map fst (snd (grow accepted claims))).
Proof.
  induction claims as [|c rest IH]; intros accepted; simpl; auto.
  destruct (judge accepted c).
  - specialize (IH accepted). destruct (grow accepted rest) as [s h]; simpl in *.
    eapply Permutation_trans; [apply Permutation_sym, Permutation_middle|].
    eapply Permutation_trans; [|apply Permutation_middle]. auto.
  - eapply Permutation_trans; [|apply IH]. simpl. apply Permutation_sym, Permutation_middle.
Qed.

Lemma grow_app before : forall after accepted,
  fst (grow accepted (before ++ after)) = fst (grow (fst (grow accepted before)) after).
Proof.
  induction before as [|c rest IH]; intros after accepted; simpl; auto.
  destruct (judge accepted c); auto.
  specialize (IH after accepted).
  destruct (grow accepted (rest ++ after)), (grow accepted rest); auto.
Qed.

(** The reason of a refusal is what [judge] said after the claims that came before. *)
Lemma grow_reason claims : forall accepted h why,
  In (h, why) (snd (grow accepted claims)) ->
  exists before after,
    claims = before ++ h :: after /\ judge (fst (grow accepted before)) h = Some why.
Proof.
  induction claims as [|c rest IH]; intros accepted h why; simpl; [tauto|].
  destruct (judge accepted c) as [why'|] eqn:J.
  - specialize (IH accepted h why). destruct (grow accepted rest) as [s hs]; simpl in *.
    intros [e|Hin].
    + injection e as -> ->. exists [], rest; auto.
    + destruct (IH Hin) as (b & a & -> & Hj). exists (c :: b), a; split; auto. simpl.
      rewrite J. destruct (grow accepted b); auto.
  - intros Hin. destruct (IH _ _ _ Hin) as (b & a & -> & Hj).
    exists (c :: b), a; split; auto. simpl. rewrite J; auto.
Qed.

(** [VIEW-3] What is shown is a forest: [forest_iff] and [forest_iff_undirected] say what that is. *)
Theorem shown_forest claims : forest (shown claims).
Proof. apply grow_forest; constructor. Qed.

(** [VIEW-3] Each claim is shown or hidden with a reason, and not both. *)
Theorem shown_or_hidden claims : Permutation claims (shown claims ++ map fst (hidden claims)).
Proof. apply (grow_partition claims []). Qed.

(** [VIEW-3] Why a claim is hidden: a claim taken before it, so a greater one, is shown and gives its child
    a parent; or claims taken before it join its ends. *)
Theorem hidden_has_cause claims h why :
  In (h, why) (hidden claims) ->
  exists before after,
    claims = before ++ h :: after /\
    match why with
    | OtherParent s => In s (shown before) /\ In s (shown claims) /\ child s = child h
    | ClosesCycle =>
        (forall c, In c (shown before) -> child c <> child h)
        /\ connected (shown before) (parent h) (child h)
    end.
Proof.
  intros Hin. destruct (grow_reason _ _ _ _ Hin) as (before & after & -> & J).
  exists before, after; split; auto.
  pose proof (judge_is_the_rule h (shown_forest before)) as R. unfold shown in *. rewrite J in R.
  destruct why; auto. destruct R as [R1 R2]; repeat split; auto.
  rewrite grow_app. apply grow_keeps; auto.
Qed.

(** [VIEW-3] Acceptance is maximal: no hidden claim could be added to what is shown. *)
Theorem acceptance_maximal claims h why : In (h, why) (hidden claims) -> ~ forest (h :: shown claims).
Proof.
  intros Hin F. apply forest_cons_iff in F as (_ & new & apart).
  destruct (hidden_has_cause _ _ _ Hin) as (before & after & -> & cause). destruct why as [s|].
  - destruct cause as (_ & Hs & e). apply (new s); auto.
  - destruct cause as [_ conn]. apply apart. eapply connected_incl; eauto.
    unfold shown. rewrite grow_app. apply grow_keeps.
Qed.

Lemma grow_all claims : forall accepted,
  forest (rev claims ++ accepted) -> grow accepted claims = (rev claims ++ accepted, []).
Proof.
  induction claims as [|c rest IH]; intros accepted F; simpl in *; auto.
  rewrite <- app_assoc in *; simpl in *.
  assert (J : judge accepted c = None).
  { assert (drop : forall l l', forest (l ++ l') -> forest l').
    { induction l; simpl; auto. inversion 1; auto. }
    apply drop in F. inversion F; auto. }
  rewrite J. auto.
Qed.

(** [VIEW-10] If the claims are a forest already, all are shown and none is hidden. *)
Theorem nothing_hidden claims :
  unique_parents claims -> acyclic claims -> shown claims = rev claims /\ hidden claims = [].
Proof.
  intros U A. unfold shown, hidden. rewrite (grow_all claims []); rewrite app_nil_r; auto.
  eapply forest_permutation; [apply Permutation_rev | apply forest_iff; auto].
Qed.

(** [VIEW-9] And only then. *)
Theorem nothing_hidden_only_if claims :
  hidden claims = [] -> unique_parents claims /\ acyclic claims.
Proof.
  intros none. apply forest_iff. pose proof (shown_or_hidden claims) as P. rewrite none in P.
  rewrite app_nil_r in P. eapply forest_permutation; [apply Permutation_sym; exact P | apply shown_forest].
Qed.

(** ** A new claim, and one that goes [INTENT-1] [INTENT-4] *)

Lemma forest_app l l' : forest (l ++ l') -> forest l'.
Proof. induction l; simpl; auto. inversion 1; auto. Qed.

Lemma grow_suffix claims : forall accepted, exists new, fst (grow accepted claims) = new ++ accepted.
Proof.
  induction claims as [|c rest IH]; intros accepted; simpl; [exists []; auto|].
  destruct (judge accepted c).
  - destruct (IH accepted) as [new E]. destruct (grow accepted rest); exists new; auto.
  - destruct (IH (c :: accepted)) as [new E]. exists (new ++ [c]). rewrite E, <- app_assoc; auto.
Qed.

Lemma grow_beside e claims : forall accepted with_e,
  Permutation with_e (e :: accepted) -> forest (e :: fst (grow accepted claims)) ->
  Permutation (fst (grow with_e claims)) (e :: fst (grow accepted claims)).
Proof.
  induction claims as [|c rest IH]; intros accepted with_e P F; auto.
  destruct (judge accepted c) as [why|] eqn:J; simpl in *; rewrite J in *.
  - assert (Fe : forest (e :: accepted)).
    { destruct (grow_suffix rest accepted) as [new E]. destruct (grow accepted rest); simpl in *; subst.
      eapply forest_app with (l := new). eapply forest_permutation; [|exact F]. apply Permutation_middle. }
    assert (Fw : forest with_e) by (eapply forest_permutation; [apply Permutation_sym|]; eauto).
    specialize (IH accepted with_e P).
    destruct (judge with_e c) eqn:J'; [destruct (grow with_e rest), (grow accepted rest); auto|].
    exfalso. assert (Fc : forest (e :: c :: accepted)).
    { eapply forest_permutation with (l := c :: with_e); [|constructor; auto].
      eapply Permutation_trans; [apply perm_skip; eauto | apply perm_swap]. }
    inversion Fc as [|? ? Fc']; subst. inversion Fc'; congruence.
  - destruct (grow_suffix rest (c :: accepted)) as [new E].
    assert (Fc : forest (c :: with_e)).
    { rewrite E in F. eapply forest_permutation with (l := c :: e :: accepted); [auto using Permutation_sym|].
      eapply forest_app with (l := new). eapply forest_permutation; [|exact F].
      eapply Permutation_trans; [|apply Permutation_app_head, perm_swap]. apply Permutation_middle. }
    inversion Fc as [|? ? _ J']; subst. rewrite J'. apply IH; auto.
    eapply Permutation_trans; [apply perm_skip; eauto | apply perm_swap].
Qed.

(** [INTENT-1] A new claim has the greatest rank, so it is taken first. If it fits what is shown, which is what
    MUT-2.5 asks, then it is shown, and nothing else changes, whatever is hidden. *)
Theorem new_claim_shown claims e :
  forest (e :: shown claims) -> Permutation (shown (e :: claims)) (e :: shown claims).
Proof.
  intros F. unfold shown in *. simpl. destruct (grow_suffix claims []) as [new E].
  assert (F1 : forest [e]).
  { rewrite E in F. eapply forest_app with (l := new).
    eapply forest_permutation; [|exact F]. rewrite app_nil_r. apply Permutation_cons_append. }
  inversion F1 as [|? ? _ J]; subst. rewrite J. apply grow_beside; auto.
Qed.

(** [INTENT-4] A hidden claim can go without a trace. (To let a claim go that is shown is another matter: see
    [freed_claim_unseats].) *)
Theorem hidden_claim_goes before h after :
  judge (shown before) h <> None -> shown (before ++ h :: after) = shown (before ++ after).
Proof.
  intros J. unfold shown in *. rewrite 2 grow_app. simpl.
  destruct (judge (fst (grow [] before)) h); [|congruence].
  destruct (grow (fst (grow [] before)) after); auto.
Qed.

End Forest.

(** [INTENT-4] The limit is real. Vertex 1 hangs below 2, by the greatest claim, and 2 below ROOT, by the least; that
    1 be above 2 is hidden. When the claim of 1 goes, the hidden one is shown and unseats the claim of 2, which
    nobody touched. *)
Theorem freed_claim_unseats :
  let one_below_two := (2, 1) in let two_below_one := (1, 2) in let two_below_root := (0, 2) in
  let shown := shown Nat.eq_dec fst snd in
  shown [one_below_two; two_below_one; two_below_root] = [two_below_root; one_below_two]
  /\ shown [two_below_one; two_below_root] = [two_below_one].
Proof. split; reflexivity. Qed.
