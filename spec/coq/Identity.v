(** * Identity (identity.md)

    Dots name events. Their uniqueness (ID-1) is a fact about whole runs of a system, not about one state:
    it is proved in Network.v from ID-3 and CRASH-1. *)

From DSR Require Export FiniteMap.

(** An agent and its incarnation (ID-1). *)
Record Replica := { agent : N; incarnation : N }.
Record Dot := { replica : Replica; sequence : N }.

(** The spec's r1.3 is [r 1 3]: an event of agent 1 in its incarnation 0. *)
Definition r (a n : N) : Dot := {| replica := {| agent := a; incarnation := 0 |}; sequence := n |}.

Lemma replica_fields_injective (x y : Replica) :
  (agent x, incarnation x) = (agent y, incarnation y) -> x = y.
Proof. destruct x, y; simpl. congruence. Qed.

#[export] Instance ordered_replica : Ordered Replica :=
  ordered_by (fun x => (agent x, incarnation x)) replica_fields_injective.

Lemma dot_fields_injective (x y : Dot) : (replica x, sequence x) = (replica y, sequence y) -> x = y.
Proof. destruct x, y; simpl. congruence. Qed.

#[export] Instance ordered_dot : Ordered Dot :=
  ordered_by (fun x => (replica x, sequence x)) dot_fields_injective.

(** [ID-1] Dots are ordered by agent, then incarnation, then sequence. *)
Theorem dot_order a i n a' i' n' :
  cmp {| replica := {| agent := a; incarnation := i |}; sequence := n |}
      {| replica := {| agent := a'; incarnation := i' |}; sequence := n' |} = Lt
  <-> (a < a' \/ a = a' /\ (i < i' \/ i = i' /\ n < n'))%N.
Proof.
  cbn -[N.compare]. destruct (N.compare_spec a a'); destruct (N.compare_spec i i');
    destruct (N.compare_spec n n'); simpl; split; try easy; lia.
Qed.

(** ROOT's dot, r0.0 (STATE-4). Sequence 0 names no event (ID-1). *)
Definition ROOT : Dot := r 0 0.
Definition is_root (d : Dot) : bool := eqb d ROOT.

(** [CRASH-2] The next incarnation differs from all before it. *)
Definition next_incarnation (x : Replica) : Replica :=
  {| agent := agent x; incarnation := incarnation x + 1 |}.

Theorem next_incarnation_fresh x : agent (next_incarnation x) = agent x /\
  forall y, agent y = agent x -> (incarnation y <= incarnation x)%N -> next_incarnation x <> y.
Proof. split; auto. intros y _ L <-. simpl in L. lia. Qed.
