(** * Claims (claims.md)

    The claims of the whole, each from the theorems of its chapters; of V3 the part that INTENT-1 says. [D] is
    any dictionary, [es] any run (Network.v). *)

From DSR Require Import Sequential.
From DSR Require Export Checker Context.
From Coq Require Import Relations.

(** [CLAIM-L1] Join is associative, commutative and idempotent with a neutral element on states that can occur;
    closure is a closure operator. *)
Theorem claim_L1 (U : Dot -> record -> Prop) : once U ->
  (forall X Y Z, proper U X -> proper U Y -> proper U Z ->
    proper U (X ⊔ Y) /\ (X ⊔ Y) ⊔ Z = X ⊔ (Y ⊔ Z) /\ X ⊔ Y = Y ⊔ X /\ X ⊔ X = X /\ bottom ⊔ X = X) /\
  (forall X, X ≤ close X) /\ (forall X Y, X ≤ Y -> close X ≤ close Y) /\
  (forall X, close (close X) = close X).
Proof.
  intros once. pose proof (proper_agree U once) as A. split; [| split; [| split]].
  - intros X Y Z PX PY PZ. split; [now apply proper_join |]. split; [now apply join_assoc; auto |].
    split; [apply join_comm |]. split; [apply join_idem, PX | apply join_bottom, PX].
  - apply close_inflationary.
  - apply close_monotone.
  - apply close_idempotent.
Qed.

(** [CLAIM-L2] X ⊔ mᵟ(X) = m(X), and every mutation is inflationary. *)
Theorem claim_L2 D a m X : wf X -> possible X m = true ->
  X ⊔ delta D a m X = mutate D a m X /\ X ⊑ mutate D a m X.
Proof. split; [now apply mutate_is_join | now apply mutate_inflationary]. Qed.

(** [CLAIM-L3] Who has received the same has the same state; and who, by resynchronisation or otherwise, has
    caught up with all that was sent, has the same state as all others of whom this is true. *)
Theorem claim_L3 D es p q :
  ((forall M, In M (got (run D es) p) <-> In M (got (run D es) q)) -> at_ (run D es) p = at_ (run D es) q) /\
  ((forall M, In M (messages (run D es)) -> M ≤ at_ (run D es) p /\ M ≤ at_ (run D es) q) ->
    at_ (run D es) p = at_ (run D es) q).
Proof.
  split; [apply strong_eventual_consistency |]. intros A.
  rewrite (all_received D es p), (all_received D es q); auto; apply A.
Qed.

(** [CLAIM-R1] What is removed stays removed, whatever happens then, and whatever a state that has seen it die
    is joined with. *)
Theorem claim_R1 D es es' p d : is_dead (at_ (run D es) p) d = true ->
  is_dead (at_ (run D (es ++ es')) p) d = true /\
  forall q, is_dead (at_ (run D (es ++ es')) q ⊔ at_ (run D es) p) d = true.
Proof.
  intros R. split; [now apply stays_removed |]. intros q. rewrite join_comm.
  apply removal_is_final; auto; apply (run_sound D).
Qed.

(** [CLAIM-S1] [STATE-6] The store holds only live and pending records: each anchor of a held record is held,
    or ROOT, or has not been seen. *)
Theorem claim_S1_store D es p d x b : get (at_ (run D es) p) d = Some x -> In b (anchors x) ->
  holds (at_ (run D es) p) b = true \/ b = ROOT \/ seen (at_ (run D es) p) b = false.
Proof. apply live_or_pending, (state_wf _ (run_sound D es)). Qed.

(** Nothing is pending, and everything held lives, once all that was sent has been received. *)
Theorem claim_S1_nothing_pending D es p d x b :
  (forall M, In M (messages (run D es)) -> M ≤ at_ (run D es) p) ->
  get (at_ (run D es) p) d = Some x -> In b (anchors x) -> b = ROOT \/ holds (at_ (run D es) p) b = true.
Proof.
  intros A G I. pose proof (run_sound D es) as S.
  destruct (claim_S1_store _ _ _ _ _ _ G I) as [H | [H | U]]; auto.
  destruct (said_anchored _ S _ _ _ (state_filed _ S p _ _ G) I) as [| (y & (M & J & K) & _)]; auto.
  (* Its anchor was filed in a message, which has been received: so it has been seen. *)
  exfalso. specialize (A M J b). apply cond_held in K. rewrite K in A.
  rewrite seen_cond in U by apply (state_wf _ S). destruct (cond (at_ (run D es) p) b); inversion A; easy.
Qed.

(** The context is one number for each replica once gaps are filled: its form has no cloud. *)
Theorem claim_S1_context D es p q :
  (forall M, In M (messages (run D es)) -> M ≤ at_ (run D es) p) ->
  let F := form_of (context (at_ (run D es) p)) in
  stands_for F (context (at_ (run D es) p)) /\ cloud F q = [].
Proof.
  intros A F. assert (S : stands_for F (context (at_ (run D es) p))).
  { apply form_of_stands. apply (state_wf _ (run_sound D es) p). }
  split; auto. apply (gapless_cloud F _ S). intros d k I B. now apply (no_gaps D es p A d k).
Qed.

(** [CLAIM-V1] The view of any state whatever keeps INV-1 to INV-6: a path to ROOT for each vertex; nothing
    dangles, and no self-loops; shown writes are declared; the kinematic edges with the reported detachments are
    one tree from ROOT; one edge is shown for each register. *)
Theorem claim_V1 D allows X :
  (forall v, In v (View.vertices X) -> clos_refl_sym_trans Dot (View.held_together D allows X) v ROOT) /\
  (forall c, In c (View.shown D X) -> get X (fst c) = Some (snd c) /\
    In (View.from c) (View.vertices X) /\ In (View.to c) (View.vertices X) /\ View.from c <> View.to c /\
    (is_RT (View.label c) = true -> View.to c <> ROOT)) /\
  (forall c, In c (View.shown_writes allows X) -> View.declared allows c = true /\
    exists target, In target (anchors (snd c)) /\
      (In target (View.vertices X) \/ exists x, get X target = Some x /\ In (target, x) (View.visible X))) /\
  (Forest.unique_parents snd (View.tree_edges X) /\ Forest.acyclic fst snd (View.tree_edges X) /\
    forall v, View.in_tree X v = true -> Forest.up fst snd (View.tree_edges X) v ROOT) /\
  (forall c c', In c (View.winners D X) -> In c' (View.winners D X) ->
    competes D (View.key c) (snd c') = true -> c = c').
Proof.
  split; [| split; [| split; [| split]]].
  - apply View.path_to_root.
  - intros c I. pose proof (View.no_dangling_edge D X c I) as (G & F & T). repeat split; auto.
    + exact (View.no_self_loop D X c I).
    + exact (View.nothing_enters_root D X c I).
  - intros c I. split; [exact (View.shown_writes_declared allows X c I) | exact (View.no_dangling_write allows X c I)].
  - exact (View.one_tree_rooted_at_root D allows X).
  - exact (View.one_shown D X).
Qed.

(** [CLAIM-V2] No needless repair: a view reports nothing exactly where the visible claims break nothing, and shows
    them all then; so the view of whoever is alone reports nothing. *)
Theorem claim_V2 D allows :
  (forall X, get X ROOT = None -> View.right_ends X ->
    (View.repairs D allows X = [] <-> View.unbroken D allows X)) /\
  (forall X, View.right_ends X -> View.unbroken D allows X ->
    (forall c, In c (View.visible X) -> In c (View.shown D X)) /\
    View.shown_writes allows X = View.live_writes X) /\
  (forall X, sequential D allows X -> View.repairs D allows X = []).
Proof.
  split; [| split].
  - exact (View.repairs_iff_broken D allows).
  - intros X E U. split; [| exact (View.unbroken_shows_all_writes D allows X U)].
    intros c. now apply (View.unbroken_shows_all D allows).
  - exact (sequential_reports_nothing D allows).
Qed.

(** [CLAIM-V3] [INTENT-1] What an accepted mutation says is shown at once, of any well-formed state: of V3 what
    does not ask who wins later. *)
Theorem claim_V3_at_once D allows X a m : wf X -> accepts D allows X a m = true ->
  (forall k, new_key X a m = Some k -> In (new_edge X a m k) (View.shown D (mutate D a m X))) /\
  (forall v n, new_vertex X a m = Some (v, n) -> View.by_name (mutate D a m X) n = Some v) /\
  match m with
  | UpdateAttributes t u => forall n w, In (n, w) (entries u) ->
      match w with
      | Some v => exists d, View.attribute_writes allows (mutate D a m X) t n
                  = [(d, Write t n v (time_ns a) (1 + greatest_stamp X))]
      | None => View.attribute_writes allows (mutate D a m X) t n = []
      end
  | RemoveEdge k => forall c, In c (View.shown D (mutate D a m X)) -> competes D k (snd c) = false
  | MoveEdge old _ _ => forall c, In c (View.shown D (mutate D a m X)) -> competes D old (snd c) = true ->
      fst c = new_edge_dot X a m
  | RemoveVertex v => ~ In v (View.vertices (mutate D a m X))
  | _ => True
  end.
Proof.
  intros W A. split; [| split].
  - intros k. exact (new_edge_shown D allows X a m k W A).
  - intros v n. exact (new_vertex_found D allows X a m v n W A).
  - destruct m as [ty nm ext ats other lb outgoing lats | k ats | t u | k | old new ats | v]; auto.
    + intros n [v |] I; [exact (set_attribute_shown D allows X a t u n v W A I) |].
      exact (unset_attribute_gone D allows X a t u n W A I).
    + intros c. exact (removed_edge_hidden D X a k c W).
    + intros c. exact (moved_edge_hidden D allows X a old new ats c W A).
    + exact (removed_vertex_gone D allows X a v W A).
Qed.
