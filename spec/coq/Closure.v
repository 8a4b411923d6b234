(** * Closure (closure.md) *)

From DSR Require Export Merge.

(** ** Definition *)

Definition stranded (X : State) (x : record) : bool := existsb (is_dead X) (anchors x).

(** One pass drops every record that has a dead anchor; its dot stays seen, hence is dead. *)
Definition pass (X : State) : State :=
  make (fun d => match cond X d with Held x => if stranded X x then Dead else Held x | c => c end)
       (domain X).

Definition is_closed (X : State) : bool := forallb (fun e => negb (stranded X (snd e))) (records X).

(** [CLOSE-1] Passes until none has a dead anchor. Each pass before that drops a record, so there are at most
    as many as records ([close_closed]). *)
Fixpoint close_within (n : nat) (X : State) : State :=
  match n with
  | O => X
  | S n => if is_closed X then X else close_within n (pass X)
  end.
Definition close (X : State) : State := close_within (size (store X)) X.

(** ** One pass *)

Lemma stranded_iff X x : stranded X x = true <-> exists a, In a (anchors x) /\ is_dead X a = true.
Proof. apply existsb_exists. Qed.

Lemma is_closed_iff X : is_closed X = true <-> closed X.
Proof.
  unfold is_closed. rewrite forallb_forall. split.
  - intros F d x a G I. apply records_get in G. specialize (F _ G). simpl in F.
    destruct (is_dead X a) eqn:D; auto.
    assert (S : stranded X x = true) by (apply stranded_iff; eauto). now rewrite S in F.
  - intros C [d x] I. apply records_get in I. simpl. destruct (stranded X x) eqn:S; auto.
    apply stranded_iff in S as (a & J & D). rewrite (C _ _ _ I J) in D. discriminate.
Qed.

Lemma cond_pass X d :
  cond (pass X) d = match cond X d with Held x => if stranded X x then Dead else Held x | c => c end.
Proof.
  unfold pass. rewrite cond_make. destruct (member d (domain X)) eqn:M; auto.
  apply domain_spec_not in M. now rewrite M.
Qed.

Lemma held_seen_pass X : held_seen (pass X).
Proof. apply held_seen_make. Qed.

Lemma pass_inflationary X : X ≤ pass X.
Proof. intros d. rewrite cond_pass. destruct (cond X d); try constructor. destruct stranded; constructor. Qed.

Lemma pass_monotone X Y : X ≤ Y -> pass X ≤ pass Y.
Proof.
  intros L d. pose proof (L d) as B. rewrite !cond_pass.
  destruct (cond X d); inversion B; subst; try constructor.
  destruct (stranded X x) eqn:S; [| destruct (stranded Y x); constructor].
  apply stranded_iff in S as (a & I & D). apply (dead_for_ever _ _ _ L) in D.
  assert (T : stranded Y x = true) by (apply stranded_iff; eauto). rewrite T. constructor.
Qed.

Lemma pass_closed X : closed X -> pass X ≤ X.
Proof.
  intros C d. rewrite cond_pass. destruct (cond X d) eqn:E; try constructor.
  apply cond_held in E. destruct (stranded X x) eqn:S; [| constructor]. apply stranded_iff in S as (a & I & D).
  rewrite (C _ _ _ E I) in D. discriminate.
Qed.

Lemma pass_from X d x : get (pass X) d = Some x -> get X d = Some x.
Proof.
  rewrite <- !cond_held, cond_pass. destruct (cond X d); try easy. now destruct (stranded X x0).
Qed.

Lemma pass_drops X : closed X \/ size (store (pass X)) < size (store X).
Proof.
  destruct (is_closed X) eqn:C; [left; now apply is_closed_iff | right].
  unfold is_closed in C. rewrite <- not_true_iff_false, forallb_forall in C.
  assert (exists e, In e (records X) /\ stranded X (snd e) = true) as ([d x] & I & S).
  { destruct (existsb (fun e => stranded X (snd e)) (records X)) eqn:E; [now apply existsb_exists |].
    exfalso. apply C. intros e I. destruct (stranded X (snd e)) eqn:S; auto.
    rewrite <- not_true_iff_false in E. destruct E. apply existsb_exists. eauto. }
  apply records_get in I. simpl in S. unfold size.
  rewrite <- (map_length fst (entries (store X))), <- (map_length fst (entries (store (pass X)))).
  apply (NoDup_incl_length (l := d :: keys (store (pass X)))).
  - constructor; [| apply keys_nodup]. rewrite in_keys. fold (get (pass X) d).
    destruct (get (pass X) d) eqn:G; [| auto]. apply cond_held in G. rewrite cond_pass in G.
    apply cond_held in I. rewrite I, S in G. discriminate.
  - intros a [<- | J]; apply in_keys; unfold get in *; [congruence |].
    apply in_keys in J. destruct (find (store (pass X)) a) eqn:G; [| easy].
    apply pass_from in G. unfold get in G. congruence.
Qed.

(** The same by store and context apart, as an implementation has it: this is a round of [State::close]. *)
Definition pass_parts (X : State) : State :=
  {| store := tabulate (fun d => match get X d with
       | Some x => if stranded X x then None else Some x
       | None => None
       end) (keys (store X));
     context := context X |}.

Theorem pass_is_pass_parts X : held_seen X -> pass_parts X = pass X.
Proof.
  intros W.
  assert (G : forall d, get (pass_parts X) d =
    match get X d with Some x => if stranded X x then None else Some x | None => None end).
  { intros d. unfold pass_parts. unfold get at 1. simpl. rewrite find_tabulate.
    destruct (member d (keys (store X))) eqn:M; auto.
    rewrite <- not_true_iff_false, member_in, in_keys in M. unfold get.
    destruct (find (store X) d); auto. now destruct M. }
  apply state_ext; auto using held_seen_pass.
  - intros d. unfold holds. rewrite G. intros H. apply W. unfold holds. now destruct (get X d).
  - intros d. rewrite cond_pass. specialize (W d). unfold cond, holds in *. rewrite G.
    change (seen (pass_parts X) d) with (seen X d).
    destruct (get X d) as [x |]; [| now destruct (seen X d)].
    destruct (stranded X x); auto. now rewrite W.
Qed.

(** ** Closure reaches the fixed point *)

Theorem close_closed X : closed (close X).
Proof.
  unfold close. assert (L : size (store X) <= size (store X)) by auto. revert L.
  generalize (size (store X)) at 2 3. intros n. revert X. induction n as [| n IH]; intros X L; simpl.
  - intros d x a G. apply find_in in G. unfold size in L. destruct (entries (store X)); [easy | simpl in L; lia].
  - destruct (is_closed X) eqn:C; [now apply is_closed_iff |]. apply IH.
    destruct (pass_drops X) as [D | D]; [apply is_closed_iff in D; congruence | lia].
Qed.

Lemma close_ind (P : State -> Prop) X : P X -> (forall Y, P Y -> P (pass Y)) -> P (close X).
Proof.
  intros B I. unfold close. generalize (size (store X)). intros n. revert X B.
  induction n; simpl; intros; auto. destruct (is_closed X); auto.
Qed.

Lemma held_seen_close X : held_seen X -> held_seen (close X).
Proof. intros. apply close_ind; auto using held_seen_pass. Qed.

(** Nothing but what was held is held. *)
Lemma close_from X d x : get (close X) d = Some x -> get X d = Some x.
Proof. apply (close_ind (fun Y => get Y d = Some x -> get X d = Some x)); auto using pass_from. Qed.

(** [CLOSE-1] The dropped dots stay in the context; nothing else changes in it. *)
Theorem close_context X d : held_seen X -> seen (close X) d = seen X d.
Proof.
  intros W. apply (close_ind (fun Y => held_seen Y /\ seen Y d = seen X d)); auto.
  intros Y [V <-]. split; [apply held_seen_pass |].
  rewrite (seen_cond (pass Y)), (seen_cond Y), cond_pass by auto using held_seen_pass.
  destruct (cond Y d); auto. now destruct (stranded Y x).
Qed.

(** ** [CLOSE-2] Closure is a closure operator *)

Theorem close_inflationary X : X ≤ close X.
Proof.
  apply (close_ind (fun Y => X ≤ Y)); auto using le_refl. intros Y L.
  eapply le_trans; eauto using pass_inflationary.
Qed.

(** It is the least closed state above. *)
Theorem close_least X Y : X ≤ Y -> closed Y -> close X ≤ Y.
Proof.
  intros L C. apply (close_ind (fun Z => Z ≤ Y)); auto. intros Z M.
  eapply le_trans; eauto using pass_monotone, pass_closed.
Qed.

Theorem close_monotone X Y : X ≤ Y -> close X ≤ close Y.
Proof. intros L. apply close_least, close_closed. eapply le_trans; eauto using close_inflationary. Qed.

Lemma close_fixed X : closed X -> close X = X.
Proof.
  intros C. apply is_closed_iff in C. unfold close. destruct (size (store X)); simpl; auto. now rewrite C.
Qed.

Theorem close_idempotent X : close (close X) = close X.
Proof. apply close_fixed, close_closed. Qed.

Lemma agree_close X Y : agree X Y -> agree (close X) Y.
Proof. intros A d x y G H. apply close_from in G. eauto. Qed.

(** Closing the parts before a merge does not change the closure of the whole. *)
Theorem close_merge X Y : agree X Y -> close (merge (close X) Y) = close (merge X Y).
Proof.
  intros A. apply le_antisym; try apply held_seen_close, held_seen_merge.
  - apply close_least, close_closed. apply merge_least.
    + now apply close_monotone, merge_upper_left.
    + apply (le_trans _ (merge X Y)); [now apply merge_upper_right | apply close_inflationary].
  - apply close_monotone, merge_least.
    + apply (le_trans _ (close X)); [apply close_inflationary | now apply merge_upper_left, agree_close].
    + now apply merge_upper_right, agree_close.
Qed.

(** ** [CLOSE-1] What closure drops *)

(** A record is doomed if an anchor is dead, or holds a doomed record. *)
Inductive doomed (X : State) : Dot -> Prop :=
| doomed_by_dead d x a : get X d = Some x -> In a (anchors x) -> is_dead X a = true -> doomed X d
| doomed_by_doomed d x a : get X d = Some x -> In a (anchors x) -> doomed X a -> doomed X d.

Lemma doomed_dies X d : doomed X d -> is_dead (close X) d = true.
Proof.
  pose proof (close_closed X) as C. pose proof (close_inflationary X) as L.
  induction 1 as [d x a G I D | d x a G I _ D]; [apply (dead_for_ever _ _ _ L) in D |];
    apply cond_dead; specialize (L d); apply cond_held in G; rewrite G in L; inversion L; auto;
    symmetry in H; apply cond_held in H; rewrite (C _ _ _ H I) in D; discriminate.
Qed.

Theorem close_drops X d : is_dead (close X) d = true <-> is_dead X d = true \/ doomed X d.
Proof.
  split.
  - apply (close_ind (fun Y => (forall e x, get Y e = Some x -> get X e = Some x) /\
      (is_dead Y d = true -> is_dead X d = true \/ doomed X d) /\
      forall e, is_dead Y e = true -> is_dead X e = true \/ doomed X e)); auto.
    intros Y (G & _ & D).
    assert (E : forall e, is_dead (pass Y) e = true -> is_dead X e = true \/ doomed X e).
    { intros e. rewrite <- cond_dead, cond_pass. destruct (cond Y e) eqn:E; try easy.
      - destruct (stranded Y x) eqn:S; [intros _; right | easy].
        apply stranded_iff in S as (a & I & B). apply cond_held, G in E.
        destruct (D _ B); [eapply doomed_by_dead | eapply doomed_by_doomed]; eauto.
      - intros _. apply D. now apply cond_dead. }
    split; auto. intros e x H. apply G. now apply pass_from.
  - intros [D | D]; [| now apply doomed_dies].
    eapply dead_for_ever; eauto using close_inflationary.
Qed.

(** ** [CLOSE-3] Two passes reach the fixed point *)

(** A vertex takes its edges and writes, an edge its writes, and nothing is anchored to a write. *)
Theorem two_passes X : held_seen X -> right_anchors X -> close X = pass (pass X).
Proof.
  intros W K.
  (* Whatever one pass makes dead was anchored to what was dead before; were it to take another pass to be
     found, its anchor would be a record that died in the first, and so on: at most an edge, at most a vertex. *)
  assert (D : forall Y d, (forall e x, get Y e = Some x -> get X e = Some x) -> is_dead (pass Y) d = true ->
    is_dead Y d = true \/ exists x a, get Y d = Some x /\ In a (anchors x) /\ is_dead Y a = true).
  { intros Y d _. rewrite <- !cond_dead, cond_pass. destruct (cond Y d) eqn:E; auto; try easy.
    destruct (stranded Y x) eqn:S; [| easy]. intros _. right. apply stranded_iff in S as (a & I & B).
    apply cond_held in E. eauto. }
  assert (C : closed (pass (pass X))).
  { intros d x a G I. destruct (is_dead (pass (pass X)) a) eqn:A; auto. exfalso.
    assert (F := pass_from (pass X) _ _ G). assert (F' := pass_from X _ _ F).
    (* x outlived both passes, so none of its anchors was dead before either. *)
    assert (N : is_dead (pass X) a = false).
    { destruct (is_dead (pass X) a) eqn:B; auto. apply cond_held in G, F. rewrite cond_pass, F in G.
      replace (stranded (pass X) x) with true in G; [discriminate |]. symmetry. apply stranded_iff. eauto. }
    apply D in A as [A | (y & b & Gy & J & B)]; [congruence | | eauto using pass_from].
    assert (Gy' := pass_from X _ _ Gy). destruct (K _ _ _ F' I) as [_ Ky]. specialize (Ky _ Gy').
    apply D in B as [B | (z & c & Gz & L & B)]; auto.
    - (* y has an anchor that is dead in X: it cannot have outlived the first pass. *)
      apply cond_held in Gy. rewrite cond_pass in Gy. apply cond_held in Gy'. rewrite Gy' in Gy.
      replace (stranded X y) with true in Gy; [discriminate |]. symmetry. apply stranded_iff. eauto.
    - (* Else its anchor held a record z that died in the first pass: x on y on z on c. *)
      destruct (K _ _ _ Gy' J) as [_ Kz]. specialize (Kz _ Gz).
      destruct x, y, z; simpl in *; easy. }
  apply le_antisym; auto using held_seen_pass, held_seen_close.
  - apply close_least; auto. eapply le_trans; apply pass_inflationary.
  - assert (P : forall Y, Y ≤ close X -> pass Y ≤ close X).
    { intros Y L. eapply le_trans; [apply pass_monotone, L | apply pass_closed, close_closed]. }
    auto using close_inflationary.
Qed.

(** Depth two is reached: a vertex dies, its edge in the first pass, the edge's write in the second. *)
Definition depth_two : State :=
  make (fun d => match sequence d with
    | 1 => Dead | 2 => Held (Edge (r 1 1) ROOT "in" 2) | _ => Held (Write (r 1 2) "a" {| value_type := 4; items := [1%Z] |} 0 3)
    end%N) [r 1 1; r 1 2; r 1 3].

Theorem one_pass_is_not_enough : right_anchors depth_two /\ pass depth_two <> pass (pass depth_two).
Proof.
  split; [now apply check_anchors_iff |].
  intros E. apply (f_equal (fun X => is_dead X (r 1 3))) in E. vm_compute in E. discriminate.
Qed.

(** With anchors of the wrong kind closure can take more than two passes, and still ends: here a write is
    anchored to a write. *)
Definition depth_three : State :=
  let w a := Held (Write a "a" {| value_type := 4; items := [1%Z] |} 0 1) in
  make (fun d => match sequence d with 1 => Dead | 2 => w (r 1 1) | 3 => w (r 1 2) | _ => w (r 1 3) end%N)
    [r 1 1; r 1 2; r 1 3; r 1 4].

Theorem wrong_anchors_take_longer : close depth_three <> pass (pass depth_three).
Proof. intros E. apply (f_equal (fun X => is_dead X (r 1 4))) in E. vm_compute in E. discriminate. Qed.

