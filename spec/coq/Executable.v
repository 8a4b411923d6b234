(** * States that run

    State.v keeps of a context the set that it means (CTX-1); a program keeps its form (CTX-2), in which a
    million dots are one run. Here are join, deltas, digests and answers on forms: what Oracle.v hands to OCaml.
    [represents] says which state of State.v such a state is; each operation keeps it. *)

From DSR Require Export Context Mutations View Sequential Sync.

(** The records held, and the form of the context. *)
Record Exec := { held : fmap Dot record; form : Form }.

Definition represents (S : Exec) (X : State) : Prop := held S = store X /\ stands_for (form S) (context X).

Definition x_bottom : Exec := {| held := empty; form := empty |}.
Definition x_get (S : Exec) (d : Dot) : option record := find (held S) d.
Definition x_seen (S : Exec) (d : Dot) : bool := covers (form S) d.
Definition x_dead (S : Exec) (d : Dot) : bool := match x_get S d with Some _ => false | None => x_seen S d end.

(** The state of the records alone: whatever asks about records asks this one. *)
Definition shade (S : Exec) : State := {| store := held S; context := empty |}.

(** ** Join *)

(** [JOIN-1] *)
Definition x_merge (S T : Exec) : Exec :=
  {| held := tabulate (fun d =>
       match x_get S d, x_get T d with
       | Some x, Some y => Some (greater x y)
       | Some x, None => if x_seen T d then None else Some x
       | None, Some y => if x_seen S d then None else Some y
       | None, None => None
       end) (keys (held S) ++ keys (held T));
     form := form_join (form S) (form T) |}.

Definition x_stranded (S : Exec) (x : record) : bool := existsb (x_dead S) (anchors x).
Definition x_is_closed (S : Exec) : bool := forallb (fun e => negb (x_stranded S (snd e))) (entries (held S)).
Definition x_pass (S : Exec) : Exec :=
  {| held := tabulate (fun d => match x_get S d with
                                | Some x => if x_stranded S x then None else Some x
                                | None => None
                                end) (keys (held S));
     form := form S |}.
(** [CLOSE-1] *)
Fixpoint x_close_within (n : nat) (S : Exec) : Exec :=
  match n with
  | O => S
  | Datatypes.S n => if x_is_closed S then S else x_close_within n (x_pass S)
  end.
Definition x_close (S : Exec) : Exec := x_close_within (size (held S)) S.
Definition x_join (S T : Exec) : Exec := x_close (x_merge S T).

(** ** Forms without others *)

(** What is left of runs without those from f to l. *)
Definition cut (f l : N) (rs : list run_) : list run_ :=
  flat_map (fun i =>
    (if (fst i <? f)%N then [(fst i, N.min (snd i) (f - 1))] else []) ++
    (if (l <? snd i)%N then [(N.max (fst i) (l + 1), snd i)] else [])) rs.
Definition cut_all (rs cuts : list run_) : list run_ := fold_right (fun i => cut (fst i) (snd i)) rs cuts.
Definition form_minus (F G : Form) : Form :=
  tabulate (fun p => match cut_all (runs_of F p) (runs_of G p) with [] => None | rs => Some rs end) (keys F).
Definition form_meet (F G : Form) : Form := form_minus F (form_minus F G).

(** ** Mutations *)

(** [ID-3] *)
Definition x_greatest (S : Exec) (p : Replica) : N :=
  fold_right (fun i m => N.max (snd i) m) 0%N (runs_of (form S) p).

(** A plan asks of the context one thing, the greatest sequence of its author: so one dot stands for it. *)
Definition lift (S : Exec) (p : Replica) : State :=
  {| store := held S;
     context := if (x_greatest S p =? 0)%N then empty else set_of [dot_of p (x_greatest S p)] |}.
Definition x_plan (D : Dictionary) (S : Exec) (a : Author) (m : Mutation) : Plan := plan D (lift S (me a)) a m.

Definition form_of_list (ds : list Dot) : Form :=
  fold_right (fun d => insert_run (replica d) (sequence d) (sequence d)) empty ds.
Definition x_delta_of (p : Plan) : Exec :=
  {| held := tabulate (fun d => lookup d (made p)) (map fst (made p));
     form := form_of_list (map fst (made p) ++ killed p) |}.
(** [MUT-0] *)
Definition x_delta (D : Dictionary) (a : Author) (m : Mutation) (S : Exec) : Exec := x_delta_of (x_plan D S a m).

(** ** Resynchronisation *)

(** [SYNC-1] *)
Record XDigest := { x_context : Form; x_live : Form }.
Definition x_digest (S : Exec) : XDigest :=
  {| x_context := form S; x_live := form_of_list (keys (held S)) |}.

(** [SYNC-3] *)
Definition x_delta_for (S : Exec) (g : XDigest) : Exec :=
  {| held := tabulate (fun d => if covers (x_context g) d then None else x_get S d) (keys (held S));
     form := form_join (form_minus (form S) (x_context g))
                       (form_meet (x_live g) (form_minus (form S) (form_of_list (keys (held S))))) |}.
