(** * Claims (claims.md)

    The claims of the whole, each from the theorems of its chapters. V1 to V3 are about the view and are not
    here. [D] is any dictionary, [es] any run (Network.v). *)

From DSR Require Export Checker Context.

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
