(** * What is refused, and with what (mutations.md, wellformed.md)

    The conditions of each mutation as one list, in their order, asked of a state of State.v. What runs
    (Conditions.v) refuses with the first that fails and with nothing else; what fulfils all is accepted in the
    sense of Sequential.v, and conversely. The same of the faults of states. *)

From DSR Require Export Refinement Conditions.

(** ** What is worked out once is the view *)

Section Sight.
  Context (W : Words) (X Y : State) (E : store Y = store X).

  Ltac same := destruct X, Y; simpl in E; subst; reflexivity.

  (** [VIEW-2] [VIEW-3] [VIEW-6] *)
  Theorem sight_shown : seen_shown (sight W Y) = shown (dictionary W) X.
  Proof. same. Qed.

  Theorem sight_accepted : seen_accepted (sight W Y) = accepted X.
  Proof. same. Qed.

  Theorem sight_vertices : seen_vertices (sight W Y) = vertices X.
  Proof. same. Qed.

  (** [VIEW-4] *)
  Theorem sight_placement v : seen_placement (sight W Y) v = placement X v.
  Proof. same. Qed.

  Lemma sight_in_tree v : seen_in_tree (sight W Y) v = in_tree X v.
  Proof. same. Qed.

  (** [VIEW-5] *)
  Theorem sight_stranded v : seen_stranded (sight W Y) v = is_stranded (dictionary W) X v.
  Proof. same. Qed.

  Theorem sight_reattached : seen_reattached (sight W Y) = reattached (dictionary W) X.
  Proof. same. Qed.

  Lemma sight_in_graph v : in_graph (seen_state (sight W Y)) v = in_graph X v.
  Proof. same. Qed.

  Lemma sight_by_name n : by_name (seen_state (sight W Y)) n = by_name X n.
  Proof. same. Qed.

  Lemma sight_attribute t n : View.attribute (allows W) (seen_state (sight W Y)) t n = View.attribute (allows W) X t n.
  Proof. same. Qed.

  Lemma sight_shows_key k : shows_key (sight W Y) k = is_shown (dictionary W) X k.
  Proof. unfold shows_key, is_shown. now rewrite sight_shown. Qed.

  Lemma sight_shows_label v l : shows_label (sight W Y) v l = is_taken (dictionary W) X v l.
  Proof. unfold shows_label, is_taken. now rewrite sight_shown. Qed.

  Lemma filter_filter {A} (p q : A -> bool) l : filter p (filter q l) = filter q (filter p l).
  Proof.
    induction l as [| a l IH]; simpl; auto.
    destruct (p a) eqn:P, (q a) eqn:Q; simpl; rewrite ?P, ?Q, ?IH; auto.
  Qed.

  (** [VIEW-9] The same reports, in the same order. *)
  Theorem sight_repairs : seen_repairs W (sight W Y) = repairs (dictionary W) (allows W) X.
  Proof.
    assert (S : seen_superseded W (sight W Y) = superseded (dictionary W) X).
    { destruct X as [s c], Y as [t e]. simpl in E. subst t.
      set (Z := {| store := s; context := c |}). set (Z' := {| store := s; context := e |}).
      change (seen_superseded W (sight W Z')) with
        (flat_map (fun h => if member h (winners (dictionary W) Z) then [] else
           map (fun w => Superseded (fst h) (fst w) (rule_of (dictionary W) h))
             (filter (fun c => competes (dictionary W) (key h) (snd c)) (winners (dictionary W) Z))) (symbolic Z)).
      unfold superseded. rewrite !flat_map_concat_map. f_equal. apply map_ext_in. intros h I.
      assert (M : member h (winners (dictionary W) Z) = wins (dictionary W) Z h).
      { apply eq_true_iff_eq. rewrite member_in. unfold winners. rewrite filter_In. tauto. }
      rewrite M. unfold winners, competitors. now rewrite filter_filter. }
    unfold seen_repairs, repairs. rewrite S. same.
  Qed.
End Sight.

(** ** Conditions in their order *)

Definition Condition : Type := bool * refusal.
Definition first_failing (l : list Condition) : option refusal :=
  option_map snd (List.find (fun c => negb (fst c)) l).
Definition all_hold (l : list Condition) : bool := forallb fst l.
Definition under (f : refusal -> refusal) (l : list Condition) : list Condition :=
  map (fun c => (fst c, f (snd c))) l.

Section Conditions.
  Context (W : Words).
  Let D := dictionary W.

  (** [DICT-2] *)
  Definition lists_name (n : Name) : bool :=
    match lookup n (attribute_types W) with Some _ => true | None => negb (closed_words W) end.
  Definition right_type (n : Name) (v : Value) : bool :=
    match lookup n (attribute_types W) with Some t => eqb t (value_type v) | None => true end.

  (** [MUT-3.2] *)
  Definition attribute_conditions (n : Name) (v : Value) : list Condition :=
    [(name_fits n, NameLength); (lists_name n, UndeclaredName); (right_type n v, WrongType);
     (value_fits v, ValueSize)].
  Definition attributes_conditions (l : Attributes) : list Condition :=
    under OfAttribute (((count (entries l) <=? attributes_max)%N, TooMany) ::
      flat_map (fun e => attribute_conditions (fst e) (snd e)) (entries l)).

  (** [MUT-2.2] *)
  Definition label_conditions (l : Name) : list Condition :=
    [(name_fits l, LabelLength); (allows_label W l, UndeclaredLabel)].

  (** [MUT-2.2] [MUT-2.1] [MUT-2.3] [MUT-2.5] [MUT-2.4] *)
  Definition edge_conditions (X : State) (k : Key) : list Condition :=
    label_conditions (key_label k) ++
    [(in_graph X (key_from k) && in_graph X (key_to k), UnknownVertex);
     (negb (eqb (key_from k) (key_to k)), SelfLoop);
     (negb (is_shown D X k), KeyPresent)] ++
    if is_RT (key_label k) then
      [(negb (is_root (key_to k)), IntoRoot);
       (match parent_of X (key_to k) with Some _ => false | None => true end, HasParent);
       (in_tree X (key_from k), ParentOutsideTree);
       (negb (eqb (top eq_dec from to (accepted X) (key_from k)) (key_to k)), Cycle)]
    else [(implb (functional D (key_label k)) (negb (is_taken D X (key_from k) (key_label k))), FunctionalTaken)].

  (** [MUT-1.1] *)
  Definition link_conditions (X : State) (other : Dot) (l : Name) (outgoing : bool) : list Condition :=
    label_conditions l ++ (in_graph X other, UnknownVertex) ::
    if is_RT l then
      [(negb (outgoing && is_root other), IntoRoot); (negb outgoing, NewVertexAsParent);
       (in_tree X other, ParentOutsideTree)]
    else [(implb (negb outgoing && functional D l) (negb (is_taken D X other l)), FunctionalTaken)].

  (** [MUT-1.2] [MUT-1.3] *)
  Definition vertex_conditions (X : State) (type name : Name) : list Condition :=
    [(name_fits type && name_fits name, NameLength); (allows_type W type, UndeclaredType);
     (negb (reserved name), ReservedName);
     (match by_name X name with Some _ => false | None => true end, NameTaken)].

  (** [MUT-3.1] to [MUT-3.4] *)
  Definition update_conditions (X : State) (target : Dot) (updates : Updates) : list Condition :=
    [(in_graph X target || existsb (fun c => eqb (fst c) target) (shown D X), UnknownTarget);
     (match entries updates with [] => false | _ => true end, NoUpdates);
     ((count (entries updates) <=? attributes_max)%N, TooMany)] ++
    flat_map (fun e => match snd e with
      | Some v => attribute_conditions (fst e) v
      | None => [(match View.attribute (allows W) X target (fst e) with Some _ => true | None => false end, NotSet)]
      end) (entries updates).

  (** [MUT-0.3] [LIMIT-5] [LIMIT-6] *)
  Definition number_conditions (p : Plan) : list Condition :=
    [(forallb (fun e => (sequence (fst e) <=? sequence_max)%N) (made p), Exhausted Sequences);
     (forallb (fun e => (stamp_of (snd e) <=? stamp_max)%N) (made p), Exhausted Stamps)].

  Definition same_key (k l : Key) : bool :=
    eqb (key_from k) (key_from l) && eqb (key_to k) (key_to l) && eqb (key_label k) (key_label l).

  Definition conditions (X : State) (a : Author) (m : Mutation) : list Condition :=
    match m with
    | AddVertex type name _ attributes other l outgoing link_attributes =>
        vertex_conditions X type name ++ attributes_conditions attributes ++
        attributes_conditions link_attributes ++ under Link (link_conditions X other l outgoing) ++
        number_conditions (plan D X a m)
    | AddEdge k attributes =>
        edge_conditions X k ++ attributes_conditions attributes ++ number_conditions (plan D X a m)
    | UpdateAttributes target updates => update_conditions X target updates ++ number_conditions (plan D X a m)
    | RemoveEdge k =>
        [(is_shown D X k, UnknownEdge); (strands_nothing D X (mutate D a m X), Strands)]
    | MoveEdge old new attributes =>
        [(is_shown D X old, UnknownEdge); (negb (same_key old new), SameKey)] ++
        attributes_conditions attributes ++ number_conditions (plan D X a m) ++
        under OfEdge (edge_conditions (mutate D a (RemoveEdge old) X) new) ++
        [(strands_nothing D X (mutate D a m X), Strands)]
    | RemoveVertex v =>
        [(negb (is_root v), RefusedRoot); (in_graph X v, UnknownVertex);
         (strands_nothing D X (mutate D a m X), Strands)]
    end.

  (** ** What runs judges them in this order *)

  Lemma failing_cons b why l : first_failing ((b, why) :: l) = (unless b why then_ first_failing l).
  Proof. now destruct b. Qed.

  Lemma failing_app l l' : first_failing (l ++ l') = (first_failing l then_ first_failing l').
  Proof. induction l as [| [[] why] l IH]; auto. Qed.

  Lemma failing_under f l : first_failing (under f l) = option_map f (first_failing l).
  Proof. induction l as [| [[] why] l IH]; auto. Qed.

  Lemma failing_flat_map {A} (f : A -> list Condition) l :
    first_failing (flat_map f l) = first_of (fun x => first_failing (f x)) l.
  Proof. induction l as [| x l IH]; auto. simpl. rewrite failing_app. unfold first_of in *. simpl. now rewrite IH. Qed.

  Lemma first_of_ext {A} (f g : A -> option refusal) l : (forall x, f x = g x) -> first_of f l = first_of g l.
  Proof. intros E. induction l as [| x l IH]; auto. unfold first_of in *. simpl. now rewrite E, IH. Qed.

  Lemma attribute_judged n v : attribute_refusal W n v = first_failing (attribute_conditions n v).
  Proof.
    unfold attribute_refusal, attribute_conditions, lists_name, right_type. rewrite !failing_cons.
    destruct (name_fits n); auto. simpl. destruct (lookup n (attribute_types W)) as [t |].
    - now destruct (eqb t (value_type v)), (value_fits v).
    - now destruct (closed_words W), (value_fits v).
  Qed.

  Lemma attributes_judged l : attributes_refusal W l = first_failing (attributes_conditions l).
  Proof.
    unfold attributes_refusal, attributes_conditions. rewrite failing_under, failing_cons, failing_flat_map.
    rewrite (first_of_ext _ _ _ (fun e => attribute_judged (fst e) (snd e))).
    destruct (count (entries l) <=? attributes_max)%N; simpl; auto.
  Qed.

  Lemma label_judged l : label_refusal W l = first_failing (label_conditions l).
  Proof. unfold label_refusal, label_conditions. rewrite !failing_cons. now destruct (name_fits l), (allows_label W l). Qed.

  Lemma then_assoc (a b c : option refusal) : ((a then_ b) then_ c) = (a then_ (b then_ c)).
  Proof. now destruct a. Qed.

  Lemma unless_true b why : unless b why = if b then None else Some why.
  Proof. reflexivity. Qed.

  Section Judged.
    Context (X Y : State) (E : store Y = store X).

    Lemma edge_judged k : edge_refusal W (sight W Y) k = first_failing (edge_conditions X k).
    Proof.
      unfold edge_refusal, edge_conditions. rewrite !(sight_in_graph W X Y E), (sight_shows_key W X Y E),
        (sight_in_tree W X Y E), (sight_accepted W X Y E), (sight_shows_label W X Y E), !failing_app, label_judged.
      fold D. fold (parent_of X (key_to k)). destruct (first_failing (label_conditions _)); auto.
      rewrite !failing_cons. destruct (in_graph X (key_from k) && in_graph X (key_to k)); auto.
      destruct (negb (eqb (key_from k) (key_to k))); auto. destruct (negb (is_shown D X k)); auto.
      cbn [unless]. destruct (is_RT (key_label k)); rewrite !failing_cons.
      - destruct (negb (is_root (key_to k))); auto. destruct (parent_of X (key_to k)); auto.
        destruct (in_tree X (key_from k)); auto.
        now destruct (negb (eqb (top eq_dec from to (accepted X) (key_from k)) (key_to k))).
      - now destruct (implb _ _).
    Qed.

    Lemma link_judged other l outgoing :
      link_refusal W (sight W Y) other l outgoing = first_failing (link_conditions X other l outgoing).
    Proof.
      unfold link_refusal, link_conditions. rewrite (sight_in_graph W X Y E), (sight_in_tree W X Y E),
        (sight_shows_label W X Y E), failing_app, label_judged. fold D.
      destruct (first_failing (label_conditions _)); auto. rewrite failing_cons.
      destruct (in_graph X other); auto. cbn [unless]. destruct (is_RT l); rewrite !failing_cons.
      - destruct outgoing; simpl.
        + now destruct (is_root other).
        + now destruct (in_tree X other).
      - now destruct (implb _ _).
    Qed.

    Lemma vertex_judged type name : vertex_refusal W (sight W Y) type name = first_failing (vertex_conditions X type name).
    Proof.
      unfold vertex_refusal, vertex_conditions. rewrite (sight_by_name W X Y E), !failing_cons.
      destruct (name_fits type && name_fits name), (allows_type W type), (negb (reserved name)), (by_name X name); auto.
    Qed.

    Lemma update_judged t u : update_refusal W (sight W Y) t u = first_failing (update_conditions X t u).
    Proof.
      unfold update_refusal, update_conditions.
      rewrite (sight_in_graph W X Y E), (sight_shown W X Y E), failing_app, !failing_cons, failing_flat_map.
      fold D. destruct (in_graph X t || existsb (fun c => eqb (fst c) t) (shown D X)); auto.
      destruct (entries u) as [| e l]; auto. cbn [unless].
      destruct (count (e :: l) <=? attributes_max)%N; auto. cbn [unless].
      apply first_of_ext. intros [n [v |]]; simpl fst; simpl snd; cbv iota beta; [apply attribute_judged |].
      rewrite (sight_attribute W X Y E), failing_cons. now destruct (View.attribute _ _ _ _).
    Qed.
  End Judged.

  Lemma numbers_judged S p : exhausted S p = first_failing (number_conditions p).
  Proof.
    unfold exhausted, number_conditions. rewrite !failing_cons. destruct (made p); auto.
    destruct (forallb (fun e => (sequence (fst e) <=? sequence_max)%N) _), (forallb (fun e => (stamp_of (snd e) <=? stamp_max)%N) _); auto.
  Qed.

  Lemma strand_judged X X' Y Y' : store Y = store X -> store Y' = store X' ->
    strand_refusal (sight W Y) (sight W Y') = first_failing [(strands_nothing D X X', Strands)].
  Proof.
    intros E E'. unfold strand_refusal, strands_nothing. rewrite failing_cons, (sight_vertices W X' Y' E').
    assert (F : forall l, forallb (fun v => implb (seen_stranded (sight W Y') v) (seen_stranded (sight W Y) v)) l =
      forallb (fun v => implb (is_stranded D X' v) (is_stranded D X v)) l).
    { induction l as [| v l IH]; simpl; auto. now rewrite IH, (sight_stranded W X' Y' E'), (sight_stranded W X Y E). }
    rewrite F. now destruct (forallb _ _).
  Qed.

  Ltac judge := match goal with |- context [first_failing ?l] =>
    destruct (first_failing l); [reflexivity |]; cbn [option_map] end.

  (** What becomes of a mutation is said by the first condition that fails. [MUT-0] *)
  Theorem attempt_is S X a m : represents S X -> wf X ->
    attempt W S a m = match first_failing (conditions X a m) with
                      | Some why => inl why
                      | None => inr (x_delta D a m S, x_join S (x_delta D a m S))
                      end.
  Proof.
    intros R V. assert (E : store (shade S) = store X) by apply R.
    assert (A : forall m', possible X m' = true ->
      store (shade (x_join S (x_delta_of (x_plan D S a m')))) = store (mutate D a m' X)).
    { intros m' Q. now apply (x_mutate_represents D S X a m' R V Q). }
    pose proof (x_plan_is D S X a m R) as P.
    destruct m as [ty nm ext ats other lb outgoing lats | k ats | tg up | k | old new ats | v];
      unfold attempt, conditions; fold D; rewrite ?failing_app, ?failing_under, <- ?P.
    - rewrite (vertex_judged X), !attributes_judged, (link_judged X), numbers_judged by exact E.
      repeat judge. reflexivity.
    - rewrite (edge_judged X), attributes_judged, numbers_judged by exact E. repeat judge. reflexivity.
    - rewrite (update_judged X), numbers_judged by exact E. repeat judge. reflexivity.
    - rewrite (strand_judged X (mutate D a (RemoveEdge k) X)), (sight_shows_key W X) by auto.
      fold D. rewrite !failing_cons. now destruct (is_shown D X k), (strands_nothing _ _ _).
    - rewrite attributes_judged, numbers_judged, (sight_shows_key W X), (edge_judged (mutate D a (RemoveEdge old) X)) by auto.
      fold D. rewrite !failing_cons. destruct (is_shown D X old); [| reflexivity]. fold (same_key old new).
      destruct (negb (same_key old new)); [| reflexivity]. cbn [unless].
      change (first_failing []) with (@None refusal). cbv iota.
      do 2 judge. destruct (first_failing (edge_conditions _ _)) eqn:Fe; [reflexivity |]. cbn [option_map].
      rewrite (strand_judged X (mutate D a (MoveEdge old new ats) X)); auto; [rewrite ?failing_cons; now destruct (strands_nothing _ _ _) |].
      apply A. cbn [possible]. unfold edge_conditions in Fe. rewrite !failing_app in Fe.
      destruct (first_failing (label_conditions _)); [easy |]. rewrite failing_cons in Fe.
      destruct (in_graph (mutate D a (RemoveEdge old) X) (key_from new) &&
        in_graph (mutate D a (RemoveEdge old) X) (key_to new)) eqn:G; [| easy].
      apply andb_prop in G as [G G'].
      assert (Old : forall d, in_graph (mutate D a (RemoveEdge old) X) d = true -> in_graph X d = true).
      { intros d. now apply in_graph_old. }
      apply andb_true_intro. split; apply Old; assumption.
    - rewrite (sight_in_graph W X) by auto. rewrite !failing_cons.
      destruct (is_root v) eqn:Rt; [reflexivity |]. destruct (in_graph X v) eqn:G; [| reflexivity]. cbn [negb unless].
      rewrite (strand_judged X (mutate D a (RemoveVertex v) X)); auto; [rewrite ?failing_cons; now destruct (strands_nothing _ _ _) |].
      apply A. cbn [possible]. rewrite Rt. exact G.
  Qed.

  (** ** All conditions hold: accepted, and within the dictionary and the limits *)

  (** What limits and the dictionary ask beyond [accepts]. *)
  Definition attribute_fits (n : Name) (v : Value) : bool := name_fits n && value_fits v.
  Definition attributes_fit (l : Attributes) : bool :=
    (count (entries l) <=? attributes_max)%N && forallb (fun e => attribute_fits (fst e) (snd e)) (entries l).
  Definition label_fits (l : Name) : bool := name_fits l && allows_label W l.
  Definition numbers_fit (p : Plan) : bool := all_hold (number_conditions p).
  Definition fits (X : State) (a : Author) (m : Mutation) : bool :=
    match m with
    | AddVertex type name _ attributes _ l _ link_attributes =>
        name_fits type && name_fits name && allows_type W type && attributes_fit attributes &&
        attributes_fit link_attributes && label_fits l && numbers_fit (plan D X a m)
    | AddEdge k attributes | MoveEdge _ k attributes =>
        label_fits (key_label k) && attributes_fit attributes && numbers_fit (plan D X a m)
    | UpdateAttributes _ updates =>
        (count (entries updates) <=? attributes_max)%N &&
        forallb (fun e => match snd e with Some v => attribute_fits (fst e) v | None => true end)
          (entries updates) && numbers_fit (plan D X a m)
    | RemoveEdge _ | RemoveVertex _ => true
    end.

  Lemma all_app l l' : all_hold (l ++ l') = all_hold l && all_hold l'.
  Proof. apply forallb_app. Qed.

  Lemma all_under f l : all_hold (under f l) = all_hold l.
  Proof. unfold all_hold. induction l as [| c l IH]; simpl; auto. now rewrite IH. Qed.

  Lemma all_flat_map {A} (f : A -> list Condition) l :
    all_hold (flat_map f l) = forallb (fun x => all_hold (f x)) l.
  Proof. induction l as [| x l IH]; simpl; auto. now rewrite all_app, IH. Qed.

  Lemma failing_none l : first_failing l = None <-> all_hold l = true.
  Proof. unfold all_hold. induction l as [| [[] why] l IH]; simpl; [easy | exact IH | easy]. Qed.

  (** [DICT-1] What the dictionary says of an attribute is what the view asks of it. *)
  Lemma allows_is n v : lists_name n && right_type n v = allows W n (value_type v).
  Proof.
    unfold lists_name, right_type, allows. destruct (lookup n (attribute_types W)); auto. apply andb_true_r.
  Qed.

  Lemma attribute_all n v : all_hold (attribute_conditions n v) = allows W n (value_type v) && attribute_fits n v.
  Proof.
    rewrite <- allows_is. unfold attribute_conditions, attribute_fits, all_hold. simpl.
    now destruct (name_fits n), (lists_name n), (right_type n v), (value_fits v).
  Qed.

  Lemma forallb_and {A} (p q : A -> bool) l : forallb (fun x => p x && q x) l = forallb p l && forallb q l.
  Proof. induction l as [| x l IH]; simpl; auto. rewrite IH. now destruct (p x), (q x), (forallb p l). Qed.

  Lemma forallb_same {A} (p q : A -> bool) l : (forall x, p x = q x) -> forallb p l = forallb q l.
  Proof. intros E. induction l as [| x l IH]; simpl; auto. now rewrite E, IH. Qed.

  Lemma attributes_all l : all_hold (attributes_conditions l) = attributes_ok (allows W) l && attributes_fit l.
  Proof.
    unfold attributes_conditions. rewrite all_under. unfold attributes_ok, attributes_fit.
    change (all_hold (((count (entries l) <=? attributes_max)%N, TooMany) ::
      flat_map (fun e => attribute_conditions (fst e) (snd e)) (entries l))) with
      ((count (entries l) <=? attributes_max)%N &&
       all_hold (flat_map (fun e => attribute_conditions (fst e) (snd e)) (entries l))).
    rewrite all_flat_map, (forallb_same _ _ _ (fun e => attribute_all (fst e) (snd e))), forallb_and.
    now destruct (count (entries l) <=? attributes_max)%N, (forallb (fun e => allows W (fst e) (value_type (snd e))) (entries l)).
  Qed.

  Lemma edge_all X k : all_hold (edge_conditions X k) = label_fits (key_label k) && edge_possible D X k.
  Proof.
    unfold edge_conditions, label_conditions, label_fits, edge_possible, all_hold. simpl.
    rewrite !andb_assoc. f_equal. destruct (is_RT (key_label k)); simpl; now rewrite ?andb_true_r, ?andb_assoc.
  Qed.

  Lemma same_key_has old new : has_key old (ROOT, Edge (key_from new) (key_to new) (key_label new) 0) = same_key old new.
  Proof.
    unfold has_key, same_key, from, to, label. simpl. apply eq_true_iff_eq.
    rewrite !andb_true_iff, !eqb_eq. intuition congruence.
  Qed.

  (* Questions become variables, so that nothing tries to compute them. *)
  Ltac shuffle := rewrite ?andb_true_iff;
    repeat match goal with |- context [?b = true] =>
      assert_fails (is_var b); assert_fails (is_constructor b); generalize b; intro end;
    split; let all := fresh in intros all; decompose [and] all; try discriminate; repeat split; assumption.

  (** [MUT-1] – [MUT-6] *)
  Theorem conditions_accept X a m :
    all_hold (conditions X a m) = accepts D (allows W) X a m && fits X a m.
  Proof.
    assert (V : forall l : list Condition, all_hold l = forallb fst l) by reflexivity.
    destruct m as [ty nm ext ats other lb outgoing lats | k ats | tg up | k | old new ats | v];
      cbn [conditions accepts fits]; rewrite ?all_app, ?all_under, ?attributes_all, ?edge_all;
      apply eq_true_iff_eq; unfold numbers_fit; rewrite ?andb_true_iff.
    - (* add_vertex *)
      unfold vertex_conditions, link_conditions, label_conditions, label_fits. rewrite !V. simpl.
      destruct (is_RT lb), outgoing; simpl; shuffle.
    - shuffle.
    - (* update_attributes *)
      assert (F : forall l : list (Name * option Value), forallb (fun e => all_hold (match snd e with
          | Some v => attribute_conditions (fst e) v
          | None => [(match View.attribute (allows W) X tg (fst e) with Some _ => true | None => false end, NotSet)]
          end)) l =
        forallb (fun e => match snd e with
          | Some v => allows W (fst e) (value_type v)
          | None => match View.attribute (allows W) X tg (fst e) with Some _ => true | None => false end
          end) l &&
        forallb (fun e => match snd e with Some v => attribute_fits (fst e) v | None => true end) l).
      { intros l. rewrite <- forallb_and. apply forallb_same. intros [n [v |]]; cbn [fst snd].
        - apply attribute_all.
        - now destruct (View.attribute _ _ _ _). }
      assert (K : negb (eqb (keys up) []) = match entries up with [] => false | _ => true end).
      { unfold keys. now destruct (entries up). }
      unfold update_conditions. rewrite all_app, all_flat_map, F, K, !V. simpl. shuffle.
    - rewrite V. cbn [forallb fst]. shuffle.
    - rewrite same_key_has, (V [_; _]), (V [_]). cbn [forallb fst]. shuffle.
    - rewrite V. cbn [forallb fst]. shuffle.
  Qed.

  (** ** What is accepted, and what is refused *)

  Section Attempt.
    Context (S : Exec) (X : State) (R : represents S X) (V : wf X).

    (** [MUT-0] An attempt succeeds if and only if the mutation is accepted and within limits and dictionary; *)
    Theorem attempt_succeeds a m :
      (exists d after, attempt W S a m = inr (d, after)) <->
      accepts D (allows W) X a m = true /\ fits X a m = true.
    Proof.
      rewrite (attempt_is S X a m R V), <- andb_true_iff, <- conditions_accept, <- failing_none.
      destruct (first_failing _); split; try easy; eauto. now intros (d & after & ?).
    Qed.

    (** it then hands out the delta and the state after. *)
    Theorem attempt_accepted a m d after : attempt W S a m = inr (d, after) ->
      accepts D (allows W) X a m = true /\ fits X a m = true /\
      represents d (delta D a m X) /\ represents after (mutate D a m X).
    Proof.
      intros A. destruct (proj1 (attempt_succeeds a m)) as [Ac F]; [eauto |].
      rewrite (attempt_is S X a m R V) in A. destruct (first_failing _); [easy |]. injection A as <- <-.
      pose proof (accepts_possible D (allows W) X a m V Ac). auto using x_delta_represents, x_mutate_represents.
    Qed.

    (** A refusal names a condition that fails, all those before it hold; and what is refused is not accepted, or
        breaks a limit or the dictionary. *)
    Theorem attempt_refused a m why : attempt W S a m = inl why ->
      (exists before after, conditions X a m = before ++ (false, why) :: after /\ all_hold before = true) /\
      accepts D (allows W) X a m && fits X a m = false.
    Proof.
      rewrite (attempt_is S X a m R V), <- conditions_accept.
      generalize (conditions X a m). intros l. destruct (first_failing l) as [w |] eqn:F; [| easy].
      intros [= ->]. unfold all_hold. induction l as [| [b w] l IH]; [easy |]. destruct b.
      - destruct (IH F) as ((before & after & -> & H) & N). split; [| exact N].
        exists ((true, w) :: before), after. now split.
      - injection F as ->. split; [| reflexivity]. now exists [], l.
    Qed.

    (** [MUT-4.2] In particular a mutation that is refused with [Strands] would strand a vertex that was not. *)
    Theorem strands_somebody a m : attempt W S a m = inl Strands ->
      exists v, In v (vertices (mutate D a m X)) /\
        is_stranded D (mutate D a m X) v = true /\ is_stranded D X v = false.
    Proof.
      intros A. apply attempt_refused in A as ((before & after & E & _) & _).
      enough (N : strands_nothing D X (mutate D a m X) = false).
      { unfold strands_nothing in N. rewrite <- not_true_iff_false, forallb_forall in N.
        destruct (existsb (fun v => is_stranded D (mutate D a m X) v && negb (is_stranded D X v))
          (vertices (mutate D a m X))) eqn:F.
        - apply existsb_exists in F as (v & I & F). apply andb_prop in F as [F G]. apply negb_true_iff in G. eauto.
        - exfalso. apply N. intros v I. destruct (is_stranded D (mutate D a m X) v) eqn:T; auto.
          destruct (is_stranded D X v) eqn:U; auto. rewrite <- not_true_iff_false in F. destruct F.
          apply existsb_exists. exists v. now rewrite T, U. }
      assert (I : In (false, Strands) (conditions X a m)) by (rewrite E; apply in_app_iff; right; now left).
      clear E before after.
      assert (Nu : forall f l, (forall w, f w <> Strands) -> ~ In (false, Strands) (under f l)).
      { intros f l Nf J. apply in_map_iff in J as ([b w] & [= _ J] & _). now apply Nf in J. }
      assert (Nn : forall p, ~ In (false, Strands) (number_conditions p)) by (intros p [J | [J | []]]; discriminate).
      assert (Ne : forall k, ~ In (false, Strands) (edge_conditions X k)).
      { intros k J. unfold edge_conditions, label_conditions in J. apply in_app_iff in J as [J | J].
        - now destruct J as [J | [J | []]].
        - apply in_app_iff in J as [J | J]; [now destruct J as [J | [J | [J | []]]] |].
          destruct (is_RT (key_label k)); simpl in J; intuition discriminate. }
      destruct m as [ty nm ext ats other lb outgoing lats | k ats | tg up | k | old new ats | v];
        cbn [conditions] in I; rewrite ?in_app_iff in I.
      - exfalso. destruct I as [I | [I | [I | [I | I]]]]; try now apply Nu in I.
        + now destruct I as [I | [I | [I | [I | []]]]].
        + now apply Nn in I.
      - exfalso. destruct I as [I | [I | I]]; [now apply Ne in I | now apply Nu in I | now apply Nn in I].
      - exfalso. destruct I as [I | I]; [| now apply Nn in I]. unfold update_conditions in I.
        apply in_app_iff in I as [I | I]; [now destruct I as [I | [I | [I | []]]] |].
        apply in_flat_map in I as ([n [u |]] & _ & I); simpl in I; intuition discriminate.
      - destruct I as [I | [I | []]]; [discriminate | now injection I].
      - destruct I as [I | [I | [I | [I | I]]]]; try now (apply Nu in I || apply Nn in I).
        + now destruct I as [I | [I | []]].
        + destruct I as [I | []]. now injection I.
      - destruct I as [I | [I | [I | []]]]; [discriminate | discriminate | now injection I].
    Qed.
  End Attempt.
End Conditions.
