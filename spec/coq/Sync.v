(** * Digests and resynchronisation (sync.md) *)

From DSR Require Export Join.

(** [SYNC-1] A state's context together with the dots that it holds. *)
Record Digest := { digest_context : fset Dot; digest_live : fset Dot }.
Definition digest (X : State) : Digest :=
  {| digest_context := context X; digest_live := set_of (keys (store X)) |}.

(** [SYNC-3] What B answers: the records that B holds and A has not seen, and in the context what A has not
    seen and what A holds and B has seen die. *)
Definition delta_for (B : State) (g : Digest) : State :=
  make (fun d => if mem (digest_context g) d
                 then if mem (digest_live g) d && is_dead B d then Dead else Unseen
                 else cond B d) (domain B).

Lemma mem_live X d : mem (digest_live (digest X)) d = holds X d.
Proof.
  simpl. rewrite mem_set_of. apply eq_true_iff_eq. rewrite member_in, in_keys. unfold holds, get.
  destruct (find (store X) d); split; congruence.
Qed.

Lemma cond_delta_for A B d : held_seen A -> cond (delta_for B (digest A)) d =
  match cond A d, cond B d with
  | Unseen, c => c
  | Held _, Dead => Dead
  | _, _ => Unseen
  end.
Proof.
  intros S. unfold delta_for. rewrite cond_make, mem_live. simpl. fold (seen A d).
  rewrite (seen_cond A d S), holds_cond.
  assert (D : is_dead B d = match cond B d with Dead => true | _ => false end).
  { unfold is_dead, cond, holds. now destruct (get B d), (seen B d). }
  rewrite D. destruct (member d (domain B)) eqn:M.
  - destruct (cond A d), (cond B d); reflexivity.
  - apply domain_spec_not in M. rewrite M. now destruct (cond A d).
Qed.

(** [SYNC-3] Its context, as the clause has it: (C(B) ∖ C(A)) ∪ (held by A ∩ dead in B). *)
Theorem delta_for_context A B d : held_seen A -> held_seen B ->
  seen (delta_for B (digest A)) d = seen B d && negb (seen A d) || holds A d && is_dead B d.
Proof.
  intros SA SB. rewrite (seen_cond (delta_for _ _)), cond_delta_for by (auto; apply held_seen_make).
  rewrite (seen_cond A), (seen_cond B) by auto.
  assert (D : is_dead B d = match cond B d with Dead => true | _ => false end).
  { unfold is_dead, cond, holds. now destruct (get B d), (seen B d). }
  rewrite D, holds_cond. now destruct (cond A d), (cond B d).
Qed.

Lemma delta_for_from A B d x : held_seen A -> get (delta_for B (digest A)) d = Some x -> get B d = Some x.
Proof.
  intros S. rewrite <- !cond_held, cond_delta_for by auto. now destruct (cond A d), (cond B d).
Qed.

(** [SYNC-3] It is a well-formed state. *)
Theorem wf_delta_for A B : wf A -> wf B -> wf (delta_for B (digest A)).
Proof.
  intros (EA & SA & CA) (EB & SB & CB). split; [| split].
  - intros d. rewrite delta_for_context by auto. unfold is_dead.
    intros [[S _]%andb_prop | [_ [_ S]%andb_prop]%andb_prop]%orb_prop; auto.
  - apply held_seen_make.
  - intros d x a G I. apply delta_for_from in G; auto. specialize (CB _ _ _ G I).
    rewrite <- not_true_iff_false, <- cond_dead in *. rewrite cond_delta_for by auto.
    destruct (cond A a), (cond B a); congruence.
Qed.

(** [SYNC-3] It brings A to the merge, and so to the join, of both. *)
Theorem delta_for_merge A B : held_seen A -> agree A B -> merge A (delta_for B (digest A)) = merge A B.
Proof.
  intros S G. apply state_ext; auto using held_seen_merge. intros d. specialize (G d).
  rewrite !cond_merge, cond_delta_for by auto. destruct (cond A d) eqn:EA, (cond B d) eqn:EB; auto.
  apply cond_held in EA, EB. simpl. now rewrite (G _ _ EA EB), greater_idem.
Qed.

Theorem delta_for_join A B : held_seen A -> agree A B -> A ⊔ delta_for B (digest A) = A ⊔ B.
Proof. intros. unfold join. now rewrite delta_for_merge. Qed.

(** [SYNC-3] Of all states with that merge it is the least. *)
Theorem delta_for_least A B D : held_seen A -> agree A B ->
  merge A D = merge A B -> delta_for B (digest A) ≤ D.
Proof.
  intros S G E d. apply (f_equal (fun X => cond X d)) in E. rewrite !cond_merge in E.
  rewrite cond_delta_for by auto.
  destruct (cond A d), (cond B d), (cond D d); simpl in E; try discriminate E; try constructor.
  injection E as ->. constructor.
Qed.

(** [SYNC-5] After one exchange each way both are equal, whatever either had lost. *)
Theorem exchange A B : held_seen A -> held_seen B -> agree A B ->
  A ⊔ delta_for B (digest A) = B ⊔ delta_for A (digest B).
Proof.
  intros SA SB G. rewrite !delta_for_join by auto using agree_sym. apply join_comm.
Qed.

(** [SYNC-5] An answer that arrives late does as well: A has become A' meanwhile. *)
Theorem late_answer A A' B : wf A -> wf B -> wf A' -> agree A B -> agree A' B -> A ≤ A' ->
  A' ⊔ delta_for B (digest A) = A' ⊔ B.
Proof.
  intros WA WB WA' G G' L.
  assert (M : agree A' A) by now apply agree_sym, le_agree.
  assert (J : A' ⊔ A = A') by (rewrite join_comm; apply below_iff_le; auto using agree_sym).
  assert (D : agree A' (delta_for B (digest A))) by
    (intros d x y P Q; apply delta_for_from in Q; [eauto | apply WA]).
  assert (D' : agree A (delta_for B (digest A))) by
    (intros d x y P Q; apply delta_for_from in Q; [eauto | apply WA]).
  rewrite <- J at 1. rewrite join_assoc, delta_for_join, <- join_assoc, J; auto. apply WA.
Qed.

(** [SYNC-4] Equal digests mean equal states, where no dot was used twice. (A fingerprint is a hash of the
    digest; that hashes do not collide is no theorem.) *)
Theorem digest_determines X Y : held_seen X -> held_seen Y -> agree X Y -> digest X = digest Y -> X = Y.
Proof.
  intros SX SY G E. apply state_ext; auto. intros d.
  assert (H : holds X d = holds Y d) by now rewrite <- !mem_live, E.
  assert (S : seen X d = seen Y d) by (unfold seen; now injection E as -> _).
  specialize (G d). unfold cond, holds in *. rewrite S.
  destruct (get X d), (get Y d); try discriminate; auto. now rewrite (G _ _ eq_refl eq_refl).
Qed.

(** ** [SYNC-2] A context alone is no digest *)

(** Edge r1.3 is replaced by r1.4, and that by r1.5. Who gets the first delta and the third, and loses the
    second, has seen all three dots and holds r1.3 and r1.5. *)
Module Lost.
  Definition edge (n : N) := Edge (r 1 1) (r 1 2) "in" n.
  Definition start := make (fun d => Held (Vertex "room" "v" None 1)) [r 1 1; r 1 2].
  (** The delta that files edge r1.n and kills the dots listed. *)
  Definition claim (n : N) (killed : list Dot) :=
    make (fun d => if eqb d (r 1 n) then Held (edge n) else Dead) (r 1 n :: killed).
  Definition d3 := claim 3 [].
  Definition d4 := claim 4 [r 1 3].
  Definition d5 := claim 5 [r 1 4].
  Definition author := joins [start; d3; d4; d5].
  Definition reader := joins [start; d3; d5].
End Lost.

Theorem context_is_no_digest :
  wf Lost.author /\ wf Lost.reader /\ agree Lost.author Lost.reader /\
  context Lost.author = context Lost.reader /\ Lost.author <> Lost.reader.
Proof.
  split; [now apply check_wf_iff |]. split; [now apply check_wf_iff |].
  split; [now apply reused_dot_none |]. split; [now apply entries_injective |].
  intros E. apply (f_equal (fun X => is_dead X (r 1 3))) in E. vm_compute in E. discriminate.
Qed.

(** So whoever compares contexts, and sends nothing where they are equal, can leave the two different for
    ever. *)
Corollary no_repair_by_context (answer : State -> fset Dot -> State) :
  (forall B, answer B (context B) = bottom) ->
  exists A B, wf A /\ wf B /\ agree A B /\ A ⊔ answer B (context A) <> A ⊔ B.
Proof.
  intros N. exists Lost.reader, Lost.author.
  destruct context_is_no_digest as (WA & WR & G & E & D). repeat split; try apply WA; try apply WR.
  - now apply agree_sym.
  - rewrite <- E, N, join_comm, join_bottom by auto. intros F.
    apply (f_equal (fun X => is_dead X (r 1 3))) in F. vm_compute in F. discriminate.
Qed.

(** [SYNC-3] The delta is least for merge, not for join: it names deaths that closure would find. B has seen
    vertex r1.1 die, and with it the edge r1.2; A holds both. *)
Theorem least_for_merge_only : exists A B D, wf A /\ wf B /\ agree A B /\
  A ⊔ D = A ⊔ B /\ D ≤ delta_for B (digest A) /\ D <> delta_for B (digest A).
Proof.
  exists (make (fun d => if eqb d (r 1 1) then Held (Vertex "room" "v" None 1)
                         else Held (Edge (r 1 1) ROOT "in" 1)) [r 1 1; r 1 2]),
         (make (fun _ => Dead) [r 1 1; r 1 2]), (make (fun _ => Dead) [r 1 1]).
  repeat split; try now apply check_wf_iff.
  - now apply reused_dot_none.
  - now apply state_eqb_eq.
  - now apply check_le_iff.
  - intros E. apply (f_equal (fun X => is_dead X (r 1 2))) in E. vm_compute in E. discriminate.
Qed.
