(** * Order freedom (VIEW-11)

    Ranks compare dots only where claims, names or writes compete. Where a view has no repair and no attribute
    with two live writes, none do: under whatever renaming of replicas the view is the renamed view. *)

From DSR Require Export View.
From Coq Require Import Permutation Relations.

Section Renaming.
  (** A renaming of replicas tells them apart and leaves ROOT's alone. *)
  Context (rho : Replica -> Replica) (injective : forall p q, rho p = rho q -> p = q).
  Context (fixes_root : rho (replica ROOT) = replica ROOT).

  Definition rename (d : Dot) : Dot := {| replica := rho (replica d); sequence := sequence d |}.
  Definition rename_record (x : record) : record :=
    match x with
    | Vertex t n e s => Vertex t n e s
    | Edge f t l s => Edge (rename f) (rename t) l s
    | Write t n v z s => Write (rename t) n v z s
    end.
  Definition rename_claim (c : Claim) : Claim := (rename (fst c), rename_record (snd c)).
  Definition rename_state (X : State) : State :=
    let l := map rename_claim (records X) in
    {| store := tabulate (fun d => lookup d l) (map fst l);
       context := set_of (map rename (elements (context X))) |}.

  Lemma rename_injective d e : rename d = rename e -> d = e.
  Proof. destruct d, e. unfold rename. simpl. intros [= P ->]. now apply injective in P as ->. Qed.

  Lemma rename_root : rename ROOT = ROOT.
  Proof. unfold rename. rewrite fixes_root. reflexivity. Qed.

  Lemma rename_is_root d : rename d = ROOT <-> d = ROOT.
  Proof. split; [rewrite <- rename_root at 1; apply rename_injective | intros ->; apply rename_root]. Qed.

  Lemma eqb_rename d e : eqb (rename d) (rename e) = eqb d e.
  Proof. apply eq_true_iff_eq. rewrite !eqb_eq. split; [apply rename_injective | now intros ->]. Qed.

  (** ** What is held *)

  Lemma get_renamed X d : get (rename_state X) (rename d) = option_map rename_record (get X d).
  Proof.
    unfold get, rename_state. cbn [store]. rewrite find_tabulate.
    assert (L : forall l : list Claim, lookup (rename d) (map rename_claim l) = option_map rename_record (lookup d l)).
    { induction l as [| [e x] l IH]; simpl; auto. rewrite eqb_rename. now destruct (eqb d e). }
    unfold find. fold (records X). rewrite L. destruct (member (rename d) _) eqn:M; auto.
    destruct (lookup d (records X)) as [x |] eqn:G; auto. exfalso.
    apply not_true_iff_false in M. apply M, member_in. rewrite map_map. apply in_map_iff. exists (d, x). split; auto.
    apply records_get. exact G.
  Qed.

  Lemma held_renamed X e y : get (rename_state X) e = Some y -> exists d x,
    e = rename d /\ y = rename_record x /\ get X d = Some x.
  Proof.
    intros G. assert (I : exists d x, e = rename d /\ get X d = Some x).
    { unfold get, rename_state in G. cbn [store] in G. rewrite find_tabulate in G.
      destruct (member e _) eqn:M; [| easy]. apply member_in in M. rewrite map_map in M.
      apply in_map_iff in M as ([d x] & <- & I). exists d, x. split; auto. now apply records_get. }
    destruct I as (d & x & -> & H). rewrite get_renamed, H in G. injection G as <-. eauto 6.
  Qed.

  (** [CTX-1] What is seen is renamed as well. *)
  Lemma seen_renamed X d : seen (rename_state X) (rename d) = seen X d.
  Proof.
    unfold seen, rename_state. cbn [context]. rewrite mem_set_of. apply eq_true_iff_eq.
    rewrite member_in, in_map_iff, <- mem_elements. split; [intros (e & E & I) | eauto].
    now apply rename_injective in E as <-.
  Qed.

  Lemma in_graph_renamed X d : in_graph (rename_state X) (rename d) = in_graph X d.
  Proof.
    unfold in_graph, is_root. rewrite get_renamed. rewrite <- rename_root at 1. rewrite eqb_rename.
    destruct (get X d) as [[] |]; reflexivity.
  Qed.

  Lemma in_graph_from X e : in_graph (rename_state X) e = true -> exists d, e = rename d.
  Proof.
    unfold in_graph. intros [R | R]%orb_prop.
    - apply eqb_eq in R as ->. exists ROOT. now rewrite rename_root.
    - destruct (get (rename_state X) e) eqn:G; [| easy]. apply held_renamed in G as (d & x & -> & _). eauto.
  Qed.

  Lemma vertices_renamed X v : In (rename v) (vertices (rename_state X)) <-> In v (vertices X).
  Proof. rewrite !vertices_in. now rewrite in_graph_renamed. Qed.

  Lemma vertices_from X u : In u (vertices (rename_state X)) -> exists v, u = rename v /\ In v (vertices X).
  Proof.
    rewrite vertices_in. intros I. destruct (in_graph_from X u I) as (v & ->). exists v. split; auto.
    rewrite in_graph_renamed in I. now apply vertices_in.
  Qed.

  (** ** Claims *)

  Lemma rename_claim_injective c c' : rename_claim c = rename_claim c' -> c = c'.
  Proof.
    destruct c as [d x], c' as [e y]. intros K.
    assert (P : d = e) by (apply rename_injective; exact (f_equal fst K)).
    assert (Q : rename_record x = rename_record y) by exact (f_equal snd K).
    subst e. f_equal. clear K. destruct x as [| f t l s | t n v z s], y as [| f' t' l' s' | t' n' v' z' s'];
      cbn [rename_record] in Q; try discriminate; auto.
    - assert (A : f = f') by (apply rename_injective; congruence).
      assert (B : t = t') by (apply rename_injective; congruence). congruence.
    - assert (A : t = t') by (apply rename_injective; congruence). congruence.
  Qed.

  Lemma from_renamed c : from (rename_claim c) = rename (from c).
  Proof. unfold from. destruct c as [d []]; simpl; auto; now rewrite rename_root. Qed.
  Lemma to_renamed c : to (rename_claim c) = rename (to c).
  Proof. unfold to. destruct c as [d []]; simpl; auto; now rewrite rename_root. Qed.
  Lemma label_renamed c : label (rename_claim c) = label c.
  Proof. now destruct c as [d []]. Qed.

  Lemma records_renamed X c : In (rename_claim c) (records (rename_state X)) <-> In c (records X).
  Proof.
    rewrite !in_records. destruct c as [d x]. simpl. rewrite get_renamed. destruct (get X d) as [y |]; simpl; [| easy].
    split; intros [= E]; f_equal; [| now rewrite E].
    assert (K : rename_claim (d, y) = rename_claim (d, x)) by (unfold rename_claim; simpl; congruence).
    apply rename_claim_injective in K. congruence.
  Qed.

  Lemma records_from X c : In c (records (rename_state X)) -> exists b, c = rename_claim b /\ In b (records X).
  Proof.
    rewrite in_records. destruct c as [e y]. cbn [fst snd]. intros G. apply held_renamed in G as (d & x & -> & -> & G).
    exists (d, x). split; auto. now apply in_records.
  Qed.

  Lemma is_visible_renamed X c : is_visible (rename_state X) (rename_claim c) = is_visible X c.
  Proof.
    unfold is_visible. destruct c as [d []]; simpl; auto. now rewrite eqb_rename, !in_graph_renamed.
  Qed.

  Lemma visible_renamed X c : In (rename_claim c) (visible (rename_state X)) <-> In c (visible X).
  Proof. unfold visible. now rewrite !filter_In, records_renamed, is_visible_renamed. Qed.

  Lemma visible_from X c : In c (visible (rename_state X)) -> exists b, c = rename_claim b /\ In b (visible X).
  Proof.
    intros I. pose proof I as J. apply visible_records, records_from in J as (b & -> & _). exists b. split; auto.
    now apply visible_renamed.
  Qed.

  Lemma symbolic_renamed X c : In (rename_claim c) (symbolic (rename_state X)) <-> In c (symbolic X).
  Proof. now rewrite !symbolic_in, visible_renamed, label_renamed. Qed.

  Lemma kinematic_renamed X c : In (rename_claim c) (kinematic (rename_state X)) <-> In c (kinematic X).
  Proof. now rewrite !kinematic_in, visible_renamed, label_renamed, to_renamed, rename_is_root. Qed.

  Lemma symbolic_from X c : In c (symbolic (rename_state X)) -> exists b, c = rename_claim b /\ In b (symbolic X).
  Proof.
    intros I. pose proof I as J. apply symbolic_in in J as [J _]. apply visible_from in J as (b & -> & _).
    exists b. split; auto. now apply symbolic_renamed.
  Qed.

  Lemma kinematic_from X c : In c (kinematic (rename_state X)) -> exists b, c = rename_claim b /\ In b (kinematic X).
  Proof.
    intros I. pose proof I as J. apply kinematic_in in J as [J _]. apply visible_from in J as (b & -> & _).
    exists b. split; auto. now apply kinematic_renamed.
  Qed.

  Lemma competes_renamed D c x : competes D (key (rename_claim c)) (rename_record x) = competes D (key c) x.
  Proof.
    destruct x as [| f t l s |]; auto. unfold competes, key. cbn [rename_record key_from key_to key_label].
    now rewrite from_renamed, to_renamed, label_renamed, !eqb_rename.
  Qed.

  Lemma name_renamed X v : name_of (rename_state X) (rename v) = name_of X v.
  Proof. unfold name_of. rewrite get_renamed. now destruct (get X v) as [[] |]. Qed.

  Lemma is_element_renamed X d : is_element (rename_state X) (rename d) = is_element X d.
  Proof.
    unfold is_element. rewrite in_graph_renamed, get_renamed. destruct (get X d) as [x |]; auto. simpl.
    f_equal. apply (is_visible_renamed X (d, x)).
  Qed.

  Lemma live_renamed X c : In (rename_claim c) (live_writes (rename_state X)) <-> In c (live_writes X).
  Proof.
    unfold live_writes. rewrite !filter_In, records_renamed. unfold is_live_write.
    destruct c as [d []]; simpl; try tauto. now rewrite is_element_renamed.
  Qed.

  Lemma declared_renamed allows c : declared allows (rename_claim c) = declared allows c.
  Proof. now destruct c as [d []]. Qed.

  Lemma shown_writes_renamed allows X c :
    In (rename_claim c) (shown_writes allows (rename_state X)) <-> In c (shown_writes allows X).
  Proof. unfold shown_writes. now rewrite !filter_In, live_renamed, declared_renamed. Qed.

  Lemma shown_writes_from allows X c : In c (shown_writes allows (rename_state X)) ->
    exists b, c = rename_claim b /\ In b (shown_writes allows X).
  Proof.
    intros I. pose proof I as J. apply filter_In in J as [J _]. apply filter_In in J as [J _].
    apply records_from in J as (b & -> & _). exists b. split; auto. now apply shown_writes_renamed.
  Qed.

  (** ** Paths *)

  Lemma joined_renamed X u v : joined (map ends (visible X)) u v ->
    joined (map ends (visible (rename_state X))) (rename u) (rename v).
  Proof.
    intros J. induction J as [u v I | | |]; [| apply rst_refl | now apply rst_sym | eapply rst_trans; eauto].
    apply rst_step. apply in_map_iff in I as (c & [= <- <-] & I). apply in_map_iff. exists (rename_claim c).
    split; [unfold ends; now rewrite from_renamed, to_renamed | now apply visible_renamed].
  Qed.

  Lemma up_renamed X u v : up from to (kinematic X) u v ->
    up from to (kinematic (rename_state X)) (rename u) (rename v).
  Proof.
    intros J. induction J as [u v (c & I & <- & <-) | |]; [| apply rt_refl | eapply rt_trans; eauto].
    apply rt_step. exists (rename_claim c). rewrite from_renamed, to_renamed. split; auto. now apply kinematic_renamed.
  Qed.

  (** ** The six conditions of VIEW-9 compare no ranks *)

  Theorem unbroken_renamed D allows X : unbroken D allows X -> unbroken D allows (rename_state X).
  Proof.
    intros U. split.
    - intros c c' I I' C. apply symbolic_from in I as (b & -> & I), I' as (b' & -> & I').
      cbn [rename_claim snd] in C. rewrite competes_renamed in C. f_equal. now apply U.
    - intros c c' I I' E. apply kinematic_from in I as (b & -> & I), I' as (b' & -> & I').
      rewrite !to_renamed in E. apply rename_injective in E. f_equal. now apply (one_kinematic_parent _ _ _ U).
    - intros c I. apply kinematic_from in I as (b & -> & I). rewrite from_renamed, <- rename_root.
      apply up_renamed. now apply (one_kinematic_tree _ _ _ U).
    - intros u I. apply vertices_from in I as (v & -> & I). rewrite <- rename_root.
      apply joined_renamed. now apply (all_paths _ _ _ U).
    - intros u w n I J E F. apply vertices_from in I as (v & -> & I), J as (v' & -> & J).
      rewrite name_renamed in E, F. destruct (one_vertex_each_name _ _ _ U v v' n I J E F) as [-> R]. auto.
    - intros c I. pose proof I as J. apply filter_In in J as [J _]. apply records_from in J as (b & -> & _).
      rewrite declared_renamed. apply (all_declared _ _ _ U). now apply live_renamed.
  Qed.

  Lemma right_ends_renamed X : right_ends X -> right_ends (rename_state X).
  Proof.
    intros E e y G. apply held_renamed in G as (d & x & -> & -> & G). apply E in G.
    destruct x as [| f t l s |]; auto. destruct G as [N R]. split.
    - intros F. now apply rename_injective in F.
    - intros L Z. apply (proj1 (rename_is_root t)) in Z. exact (R L Z).
  Qed.

  (** ** [VIEW-11] *)

  Section Free.
    Context (D : Dictionary) (allows : Name -> N -> bool) (X : State).
    Context (NR : get X ROOT = None) (E : right_ends X).
    Context (silent : repairs D allows X = []).
    Context (uncontested : forall t n, length (attribute_writes allows X t n) <= 1).
    Let Y := rename_state X.
    Let U : unbroken D allows X := silent_only_if_unbroken D allows X NR silent.
    Let V : unbroken D allows Y := unbroken_renamed D allows X U.

    (** The view of the renamed state reports nothing either, *)
    Lemma renamed_reports_nothing : repairs D allows Y = [].
    Proof. apply unbroken_reports_nothing; [now apply right_ends_renamed | exact V]. Qed.

    Lemma accepted_renamed c : In (rename_claim c) (accepted Y) <-> In c (accepted X).
    Proof.
      rewrite (proj1 (all_accepted _ _ _ U)), (proj1 (all_accepted _ _ _ V)), <- !in_rev. apply kinematic_renamed.
    Qed.

    (** shows the same edges, renamed, *)
    Lemma shown_renamed c : In c (shown D Y) <-> exists b, c = rename_claim b /\ In b (shown D X).
    Proof.
      assert (S : forall Z, unbroken D allows Z -> forall c, In c (shown D Z) <-> In c (symbolic Z) \/ In c (kinematic Z)).
      { intros Z UZ d. unfold shown. rewrite in_app_iff, (proj1 (all_accepted _ _ _ UZ)), <- in_rev.
        apply or_iff_compat_r. split; [now intros [I _]%filter_In | now apply (all_win D allows)]. }
      rewrite (S Y V). split.
      - intros [I | I]; [apply symbolic_from in I | apply kinematic_from in I]; destruct I as (b & -> & I);
          exists b; rewrite (S X U); auto.
      - intros (b & -> & I). rewrite (S X U) in I. unfold Y. now rewrite symbolic_renamed, kinematic_renamed.
    Qed.

    (** places vertices alike, *)
    Definition rename_placement (p : Placement) : Placement :=
      match p with Child parent edge => Child (rename parent) (rename edge) | _ => p end.

    Lemma placement_renamed v : placement Y (rename v) = rename_placement (placement X v).
    Proof.
      unfold placement, is_root. rewrite <- rename_root at 1. rewrite eqb_rename. destruct (eqb v ROOT); auto.
      destruct (parent_of X v) as [c |] eqn:P.
      - apply parent_of_child in P as [I <-]. pose proof I as J. apply accepted_renamed in J.
        destruct (parent_of Y (rename (to c))) as [c' |] eqn:Q.
        + apply parent_of_child in Q as [I' T]. rewrite <- to_renamed in T.
          rewrite (one_kinematic_parent _ _ _ V c' (rename_claim c)) by (auto using accepted_kinematic).
          simpl. now rewrite from_renamed.
        + exfalso. rewrite parent_of_none in Q. apply (Q _ J). apply to_renamed.
      - rewrite parent_of_none in P. destruct (parent_of Y (rename v)) as [c' |] eqn:Q.
        + exfalso. apply parent_of_child in Q as [I' T]. pose proof I' as J'.
          apply accepted_kinematic, kinematic_from in J' as (b & -> & _). apply accepted_renamed in I'.
          apply (P _ I'). rewrite to_renamed in T. now apply rename_injective.
        + assert (H : has_child Y (rename v) = has_child X v); [| rewrite H; now destruct (has_child X v)].
          apply eq_true_iff_eq. rewrite !has_child_iff. split.
          * intros (c & I & F). pose proof I as J. apply accepted_kinematic, kinematic_from in J as (b & -> & _).
            exists b. apply accepted_renamed in I. rewrite from_renamed in F. split; auto. now apply rename_injective.
          * intros (c & I & <-). exists (rename_claim c). split; [now apply accepted_renamed | apply from_renamed].
    Qed.

    (** strands nobody, *)
    Lemma unbroken_strands_nobody Z : right_ends Z -> unbroken D allows Z -> repairs D allows Z = [] ->
      forall v, In v (vertices Z) -> is_stranded D Z v = false.
    Proof.
      intros EZ UZ N v I. apply not_true_iff_false. intros S. apply stranded_iff in S as [S | S].
      - apply (reported_detached D allows) in S. now rewrite N in S.
      - apply S. pose proof (all_paths _ _ _ UZ v I) as J. clear - EZ UZ J.
        induction J as [u w I | | |]; [| apply rst_refl | now apply rst_sym | eapply rst_trans; eauto].
        apply rst_step. apply in_map_iff in I as (c & <- & I). apply in_map. now apply (unbroken_shows_all D allows).
    Qed.

    Lemma nobody_stranded v : In v (vertices X) -> is_stranded D X v = false /\ is_stranded D Y (rename v) = false.
    Proof.
      intros I. split; [now apply unbroken_strands_nobody |].
      apply unbroken_strands_nobody; [now apply right_ends_renamed | exact V | exact renamed_reports_nothing |].
      now apply vertices_renamed.
    Qed.

    (** finds the same vertices by name, *)
    Lemma by_name_renamed n : by_name Y n = option_map rename (by_name X n).
    Proof.
      destruct (reserved n) eqn:R; [rewrite !reserved_finds_root by auto; simpl; now rewrite rename_root |].
      pose proof (name_finds_oldest X n R) as F. pose proof (name_finds_oldest Y n R) as G.
      destruct (by_name X n) as [v |], (by_name Y n) as [w |]; simpl; auto.
      - destruct F as (I & N & _), G as (J & M & _). f_equal. apply vertices_from in J as (w' & -> & J).
        unfold Y in M. rewrite name_renamed in M. f_equal. now apply (one_vertex_each_name _ _ _ U w' v n).
      - exfalso. destruct F as (I & N & _). apply (G (rename v)); [now apply vertices_renamed |].
        unfold Y. now rewrite name_renamed.
      - exfalso. destruct G as (J & M & _). apply vertices_from in J as (w' & -> & J). unfold Y in M.
        rewrite name_renamed in M. now apply (F w').
    Qed.

    (** and reads the same writes. *)
    Lemma attribute_renamed t n : attribute_writes allows Y (rename t) n = map rename_claim (attribute_writes allows X t n).
    Proof.
      assert (W : forall c, writes (rename t) n (snd (rename_claim c)) = writes t n (snd c)).
      { intros [d []]; simpl; auto. now rewrite eqb_rename. }
      assert (M : forall c, In c (attribute_writes allows Y (rename t) n) <->
        In c (map rename_claim (attribute_writes allows X t n))).
      { intros c. rewrite in_map_iff, attribute_writes_in. split.
        - intros [I C]. apply shown_writes_from in I as (b & -> & I). rewrite W in C. exists b. split; auto.
          apply attribute_writes_in. auto.
        - intros (b & <- & I). apply attribute_writes_in in I as [I C]. rewrite W.
          split; auto. now apply shown_writes_renamed. }
      assert (N : NoDup (attribute_writes allows Y (rename t) n)).
      { eapply Permutation_NoDup; [apply descending_permutation |]. repeat apply NoDup_filter. apply records_nodup. }
      specialize (uncontested t n). destruct (attribute_writes allows X t n) as [| c [| c' l]]; simpl in *; try lia.
      - destruct (attribute_writes allows Y (rename t) n) as [| d l]; auto. now destruct (proj1 (M d) (or_introl eq_refl)).
      - destruct (attribute_writes allows Y (rename t) n) as [| d [| d' l]].
        + now destruct (proj2 (M _) (or_introl eq_refl)).
        + now destruct (proj1 (M d) (or_introl eq_refl)) as [<- | []].
        + exfalso. inversion N as [| ? ? F _]; subst. apply F.
          destruct (proj1 (M d) (or_introl eq_refl)) as [<- | []].
          destruct (proj1 (M d') (or_intror (or_introl eq_refl))) as [<- | []]. now left.
    Qed.
  End Free.

  (** [VIEW-11] Of a state in which the view has no repair, and no attribute two live writes, the view of the
      renamed state is the renamed view. *)
  Theorem order_freedom D allows X : get X ROOT = None -> right_ends X -> repairs D allows X = [] ->
    (forall t n, length (attribute_writes allows X t n) <= 1) ->
    let Y := rename_state X in
    (forall u, In u (vertices Y) <-> exists v, u = rename v /\ In v (vertices X)) /\
    (forall c, In c (shown D Y) <-> exists b, c = rename_claim b /\ In b (shown D X)) /\
    (forall v, placement Y (rename v) = rename_placement (placement X v)) /\
    (forall v, In v (vertices X) -> is_stranded D X v = false /\ is_stranded D Y (rename v) = false) /\
    (forall n, by_name Y n = option_map rename (by_name X n)) /\
    (forall c, In c (shown_writes allows Y) <-> exists b, c = rename_claim b /\ In b (shown_writes allows X)) /\
    (forall t n, attribute_writes allows Y (rename t) n = map rename_claim (attribute_writes allows X t n)) /\
    repairs D allows Y = [].
  Proof.
    intros NR E S O Y. repeat split; try (now apply vertices_from) || (now apply shown_writes_from).
    - intros (v & -> & I). now apply vertices_renamed.
    - eapply shown_renamed; eauto.
    - intros B. eapply shown_renamed; eauto.
    - intros v. eapply placement_renamed; eauto.
    - eapply nobody_stranded; eauto.
    - eapply nobody_stranded; eauto.
    - intros n. eapply by_name_renamed; eauto.
    - intros (b & -> & I). now apply shown_writes_renamed.
    - intros t n. now apply attribute_renamed.
    - eapply renamed_reports_nothing; eauto.
  Qed.
End Renaming.

(** Where there is a repair it does depend on them: two claims of one key and one stamp, their authors swapped. *)
Definition swapped (p : Replica) : Replica :=
  {| agent := match agent p with 1 => 2 | 2 => 1 | n => n end%N; incarnation := incarnation p |}.

Theorem repairs_follow_dots :
  let X := make (fun d => Held (if eqb d (r 3 1) then Vertex "cup" "cup" None 1 else Edge ROOT (r 3 1) "sees" 2))
             [r 3 1; r 1 1; r 2 1] in
  let D := {| functional := fun _ => false |} in
  map fst (shown D X) = [r 2 1] /\ map fst (shown D (rename_state swapped X)) = [rename swapped (r 1 1)].
Proof. vm_compute. split; reflexivity. Qed.
