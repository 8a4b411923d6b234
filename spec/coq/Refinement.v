(** * States that run are states (Executable.v refines State.v)

    [represents S X]: the records of S are those of X, and its form stands for X's context. Every operation of
    Executable.v keeps it, so what is proved of State.v's states holds of what runs. *)

From DSR Require Export Executable.

(** ** What a state that runs represents *)

(** [STATE-1] [CTX-1] Look-ups are those of the state represented. *)
Theorem x_get_is S X d : represents S X -> x_get S d = get X d.
Proof. intros [E _]. unfold x_get, get. now rewrite E. Qed.

Theorem x_seen_is S X d : represents S X -> x_seen S d = seen X d.
Proof. intros [_ [_ E]]. apply E. Qed.

(** [STATE-3] *)
Theorem x_dead_is S X d : represents S X -> x_dead S d = is_dead X d.
Proof.
  intros R. unfold x_dead, is_dead, holds. rewrite (x_get_is _ _ _ R), (x_seen_is _ _ _ R).
  now destruct (get X d).
Qed.

Theorem x_bottom_represents : represents x_bottom bottom.
Proof. split; [reflexivity | split; [easy | reflexivity]]. Qed.

(** [CTX-1] [CTX-4] Every state with CTX-1 has one that represents it, and no other has; and none represents two. *)
Theorem represented X : events X -> represents {| held := store X; form := form_of (context X) |} X.
Proof. intros E. split; [reflexivity | now apply form_of_stands]. Qed.

Theorem represented_once S T X : represents S X -> represents T X -> S = T.
Proof.
  intros [H F] [I G]. destruct S, T. simpl in *. f_equal; [congruence | eapply forms_equal; eauto].
Qed.

Theorem represents_once S X Y : represents S X -> represents S Y -> X = Y.
Proof.
  intros [H [_ F]] [I [_ G]]. destruct X as [s c], Y as [t e]. simpl in *. f_equal; [congruence |].
  apply set_ext. intros d. now rewrite <- F, G.
Qed.

(** A form covers no dot of sequence 0: what is represented satisfies CTX-1. *)
Theorem represents_events S X : represents S X -> events X.
Proof. intros [_ [C E]] d M. apply (covers_events (form S)); auto. now rewrite E. Qed.

(** ** Join *)

Lemma tabulate_same {K V} `{Ordered K} (f g : K -> option V) ks ls :
  (forall k, (if member k ks then f k else None) = if member k ls then g k else None) ->
  tabulate f ks = tabulate g ls.
Proof. intros E. apply fmap_ext. intros k. now rewrite !find_tabulate. Qed.

(** [JOIN-1] *)
Lemma x_merge_parts S T X Y : represents S X -> represents T Y -> represents (x_merge S T) (merge_parts X Y).
Proof.
  intros R Q. split.
  - unfold x_merge, merge_parts. simpl. rewrite (proj1 R), (proj1 Q). apply tabulate_same. intros d.
    now rewrite (x_get_is _ _ d R), (x_get_is _ _ d Q), (x_seen_is _ _ d R), (x_seen_is _ _ d Q).
  - apply form_join_stands; [apply R | apply Q].
Qed.

Theorem x_merge_represents S T X Y : represents S X -> represents T Y -> held_seen X -> held_seen Y ->
  represents (x_merge S T) (merge X Y).
Proof. intros. rewrite <- merge_is_merge_parts by auto. now apply x_merge_parts. Qed.

Lemma x_stranded_is S X x : represents S X -> x_stranded S x = stranded X x.
Proof.
  intros R. unfold x_stranded, stranded. induction (anchors x) as [| a l IH]; simpl; auto.
  now rewrite IH, (x_dead_is _ _ a R).
Qed.

Lemma x_is_closed_is S X : represents S X -> x_is_closed S = is_closed X.
Proof.
  intros R. unfold x_is_closed, is_closed, records. rewrite (proj1 R).
  induction (entries (store X)) as [| e l IH]; simpl; auto. now rewrite IH, (x_stranded_is _ _ _ R).
Qed.

Lemma x_pass_represents S X : represents S X -> held_seen X -> represents (x_pass S) (pass X).
Proof.
  intros R W. rewrite <- pass_is_pass_parts by auto. split; [| apply R].
  unfold x_pass, pass_parts. simpl. rewrite (proj1 R). apply tabulate_same. intros d.
  rewrite (x_get_is _ _ d R). destruct (get X d); auto. now rewrite (x_stranded_is _ _ _ R).
Qed.

(** [CLOSE-1] *)
Theorem x_close_represents S X : represents S X -> held_seen X -> represents (x_close S) (close X).
Proof.
  intros R W. unfold x_close, close. rewrite (proj1 R). generalize (size (store X)). intros n.
  revert S X R W. induction n as [| n IH]; intros S X R W; simpl; auto.
  rewrite (x_is_closed_is _ _ R). destruct (is_closed X); auto.
  apply IH; auto using x_pass_represents, held_seen_pass.
Qed.

(** [JOIN-1] *)
Theorem x_join_represents S T X Y : represents S X -> represents T Y -> held_seen X -> held_seen Y ->
  represents (x_join S T) (X ⊔ Y).
Proof. intros. apply x_close_represents; auto using x_merge_represents, held_seen_merge. Qed.

(** ** Forms without others *)

Lemma cut_cons f l g m rs : cut f l ((g, m) :: rs) =
  (if (g <? f)%N then [(g, N.min m (f - 1))] else []) ++
  (if (l <? m)%N then [(N.max g (l + 1), m)] else []) ++ cut f l rs.
Proof. unfold cut. simpl. now rewrite <- app_assoc. Qed.

(** [CTX-2] Cutting a run out keeps a form compact, and takes exactly its dots. *)
Theorem cut_compact b f l rs : (f <= l)%N -> compact_from b rs -> compact_from b (cut f l rs).
Proof.
  intros L. revert b. induction rs as [| [g m] rs IH]; intros b; [auto |].
  intros (B & M & C). specialize (IH _ C). rewrite cut_cons.
  destruct (N.ltb_spec g f), (N.ltb_spec l m); simpl; repeat split; try lia; eapply compact_weaken; try exact IH; lia.
Qed.

Theorem cut_meaning f l rs k : (f <= l)%N ->
  in_runs (cut f l rs) k = true <-> in_runs rs k = true /\ ~ (f <= k <= l)%N.
Proof.
  intros L. induction rs as [| [g m] rs IH]; [easy |]. rewrite cut_cons, in_runs_cons.
  destruct (N.ltb_spec g f), (N.ltb_spec l m); cbn [app]; rewrite ?in_runs_cons, IH; split; intuition lia.
Qed.

Lemma cut_all_spec b c rs cuts : compact_from b rs -> compact_from c cuts ->
  compact_from b (cut_all rs cuts) /\
  forall k, in_runs (cut_all rs cuts) k = true <-> in_runs rs k = true /\ in_runs cuts k <> true.
Proof.
  intros C. revert c. induction cuts as [| [f l] cuts IH]; intros c; [simpl; intuition easy |].
  intros (_ & L & C'). destruct (IH _ C') as [K M].
  change (cut_all rs ((f, l) :: cuts)) with (cut f l (cut_all rs cuts)). split; [now apply cut_compact |].
  intros k. rewrite cut_meaning, M, in_runs_cons by auto. tauto.
Qed.

Lemma runs_of_minus F G p : runs_of (form_minus F G) p = cut_all (runs_of F p) (runs_of G p).
Proof.
  unfold runs_of at 1, form_minus. rewrite find_tabulate. destruct (member p (keys F)) eqn:M.
  - now destruct (cut_all (runs_of F p) (runs_of G p)).
  - rewrite <- not_true_iff_false, member_in, in_keys in M. unfold runs_of at 1.
    destruct (find F p); [exfalso; apply M; congruence |]. induction (runs_of G p) as [| i l IH]; auto.
    simpl. now rewrite <- IH.
Qed.

(** [CTX-1] [CTX-2] *)
Theorem form_minus_meaning F G : compact F -> compact G ->
  compact (form_minus F G) /\ forall d, covers (form_minus F G) d = covers F d && negb (covers G d).
Proof.
  intros CF CG. split.
  - intros p rs E. pose proof E as M. unfold form_minus in M. rewrite find_tabulate in M.
    destruct (member p (keys F)); [| easy].
    assert (R : runs_of (form_minus F G) p = rs) by (unfold runs_of; now rewrite E).
    rewrite runs_of_minus in R. rewrite R in M. split; [now destruct rs |].
    rewrite <- R. eapply cut_all_spec; apply compact_runs; auto.
  - intros d. unfold covers. rewrite runs_of_minus. apply eq_true_iff_eq.
    rewrite andb_true_iff, negb_true_iff, <- not_true_iff_false.
    eapply cut_all_spec; apply compact_runs; auto.
Qed.

Theorem form_meet_meaning F G : compact F -> compact G ->
  compact (form_meet F G) /\ forall d, covers (form_meet F G) d = covers F d && covers G d.
Proof.
  intros CF CG. destruct (form_minus_meaning F G CF CG) as [C E].
  destruct (form_minus_meaning F _ CF C) as [C' E']. split; auto.
  intros d. unfold form_meet. rewrite E', E. now destruct (covers F d), (covers G d).
Qed.

(** [CTX-1] The form of a list of dots. *)
Theorem form_of_list_stands ds : (forall d, In d ds -> sequence d <> 0%N) -> stands_for (form_of_list ds) (set_of ds).
Proof.
  intros E. destruct (form_of_dots ds E) as [C M]. split; [exact C |].
  intros d. apply eq_true_iff_eq. now rewrite mem_set_of, member_in, <- M.
Qed.

(** ** Mutations *)

(** [ID-3] *)
Theorem x_greatest_is S X p : represents S X -> x_greatest S p = greatest X p.
Proof.
  intros [_ [C E]]. pose proof (compact_runs (form S) p C) as R.
  assert (B : forall b rs k, compact_from b rs -> in_runs rs k = true ->
    (k <= fold_right (fun i m => N.max (snd i) m) 0 rs)%N).
  { intros b rs k. revert b. induction rs as [| [f l] rs IH]; intros b; [easy |].
    intros (_ & _ & K) [I | I]%in_runs_cons; simpl; [lia |]. specialize (IH _ K I). lia. }
  assert (A : forall b rs, compact_from b rs -> rs <> [] ->
    in_runs rs (fold_right (fun i m => N.max (snd i) m) 0%N rs) = true).
  { intros b rs. revert b. induction rs as [| [f l] rs IH]; intros b; [easy |].
    intros (_ & L & K) _. apply in_runs_cons. simpl. destruct rs as [| j rs]; [left; simpl; lia |].
    specialize (IH _ K ltac:(easy)).
    destruct (N.max_spec l (fold_right (fun i m => N.max (snd i) m) 0%N (j :: rs))) as [[H ->] | [H ->]]; auto.
    left. lia. }
  unfold x_greatest. apply N.le_antisymm.
  - destruct (runs_of (form S) p) as [| i rs] eqn:Z; [simpl; lia |]. rewrite <- Z in *.
    specialize (A _ _ R ltac:(congruence)).
    pose proof (E (dot_of p (fold_right (fun i m => N.max (snd i) m) 0%N (runs_of (form S) p)))) as M.
    unfold covers in M. simpl in M. rewrite A in M. symmetry in M.
    now apply (greatest_bounds X p) in M.
  - destruct (N.eq_dec (greatest X p) 0) as [-> | N0]; [lia |]. apply greatest_seen in N0.
    unfold seen in N0. rewrite <- E in N0. unfold covers in N0. simpl in N0. eapply B; eauto.
Qed.

Lemma plan_depends D X Y a m : store X = store Y -> greatest X (me a) = greatest Y (me a) ->
  plan D X a m = plan D Y a m.
Proof.
  intros E G. destruct X as [s c], Y as [t e]. simpl in E. subst t.
  destruct m; unfold plan, make_records; rewrite G; reflexivity.
Qed.

(** [MUT-0] A plan depends on the records, and of the context on the author's greatest sequence only. *)
Theorem x_plan_is D S X a m : represents S X -> x_plan D S a m = plan D X a m.
Proof.
  intros R. apply plan_depends; [apply R |]. rewrite <- (x_greatest_is S X (me a) R).
  unfold lift. destruct (N.eqb_spec (x_greatest S (me a)) 0) as [-> | N0]; [reflexivity |].
  set (n := x_greatest S (me a)) in *. set (L := {| store := held S; context := set_of [dot_of (me a) n] |}).
  assert (I : seen L (dot_of (me a) n) = true).
  { unfold seen, L. cbn [context]. rewrite mem_set_of. apply member_in. now left. }
  apply N.le_antisymm.
  - destruct (N.eq_dec (greatest L (me a)) 0) as [-> | M]; [lia |]. apply greatest_seen in M.
    unfold seen, L in M. cbn [context] in M. rewrite mem_set_of, member_in in M. destruct M as [M | []].
    apply (f_equal sequence) in M. apply N.eq_le_incl. symmetry. exact M.
  - now apply (greatest_bounds L (me a)) in I.
Qed.

(** [MUT-0.1] *)
Lemma x_delta_of_represents X p : wf X -> sound X p -> represents (x_delta_of p) (delta_of p).
Proof.
  intros W P. unfold x_delta_of, delta_of, make. split; cbn [held form store context].
  - apply tabulate_same. intros d. rewrite member_app.
    destruct (lookup d (made p)) eqn:L.
    + apply lookup_in, (in_map fst) in L; [| apply P]. apply member_in in L. simpl in L. now rewrite L.
    + now destruct (member d (map fst (made p))), (member d (killed p)).
  - destruct (form_of_list_stands (map fst (made p) ++ killed p)) as [C M].
    + intros d [I | I]%in_app_iff; [now apply P in I |]. apply W, W, P, I.
    + split; auto. intros d. rewrite M, mem_set_of, mem_collect.
      now destruct (lookup d (made p)); rewrite andb_true_r.
Qed.

(** [MUT-0] The delta, *)
Theorem x_delta_represents D S X a m : represents S X -> wf X -> possible X m = true ->
  represents (x_delta D a m S) (delta D a m X).
Proof.
  intros R W Q. unfold x_delta, delta. rewrite (x_plan_is _ _ _ _ _ R).
  apply (x_delta_of_represents X); auto using plan_sound.
Qed.

(** and the state after. *)
Theorem x_mutate_represents D S X a m : represents S X -> wf X -> possible X m = true ->
  represents (x_join S (x_delta D a m S)) (mutate D a m X).
Proof.
  intros R W Q. rewrite <- mutate_is_join by auto.
  apply x_join_represents; auto using x_delta_represents; [apply W | now apply wf_delta].
Qed.

(** ** Resynchronisation *)

(** An executable digest stands for a digest. *)
Definition digests (h : XDigest) (g : Digest) : Prop :=
  stands_for (x_context h) (digest_context g) /\ stands_for (x_live h) (digest_live g).

Lemma held_events S X : represents S X -> held_seen X -> stands_for (form_of_list (keys (held S))) (set_of (keys (store X))).
Proof.
  intros R W. rewrite (proj1 R). apply form_of_list_stands. intros d I.
  apply (represents_events _ _ R), W. apply in_keys in I. unfold holds, get. now destruct (find (store X) d).
Qed.

(** [SYNC-1] *)
Theorem x_digest_is S X : represents S X -> held_seen X -> digests (x_digest S) (digest X).
Proof. intros R W. split; [apply R | now apply held_events]. Qed.

(** [SYNC-3] *)
Theorem x_delta_for_represents S X h g : represents S X -> held_seen X -> digests h g ->
  represents (x_delta_for S h) (delta_for X g).
Proof.
  intros R W [[CC EC] [CL EL]]. pose proof (held_events S X R W) as [CH EH]. pose proof R as [_ [CF EF]].
  assert (H : forall d, mem (set_of (keys (store X))) d = holds X d) by (intros d; now rewrite <- mem_live).
  unfold x_delta_for, delta_for, make. split; cbn [held form store context].
  - rewrite (proj1 R). unfold domain. apply tabulate_same. intros d.
    rewrite EC, member_app, (x_get_is _ _ d R), member_elements. fold (seen X d).
    rewrite <- mem_set_of, H. specialize (W d). unfold cond, holds in *.
    destruct (mem (digest_context g) d), (mem (digest_live g) d), (get X d), (seen X d), (is_dead X d); auto.
  - destruct (form_minus_meaning _ _ CF CC) as [C1 E1]. destruct (form_minus_meaning _ _ CF CH) as [C2 E2].
    destruct (form_meet_meaning _ _ CL C2) as [C3 E3]. destruct (form_join_meaning _ _ C1 C3) as [C4 E4].
    split; auto. intros d. rewrite E4, E1, E3, E2, EF, EC, EL, EH, H. fold (seen X d).
    rewrite mem_collect. unfold domain. rewrite member_app, member_elements. fold (seen X d).
    rewrite <- mem_set_of, H. specialize (W d). unfold is_dead, cond, holds in *.
    destruct (mem (digest_context g) d), (mem (digest_live g) d), (get X d), (seen X d); simpl in *; auto; now discriminate W.
Qed.
