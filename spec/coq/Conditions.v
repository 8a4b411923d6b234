(** * The conditions of mutations, in order, and the faults of states (mutations.md, dictionary.md,
    limits.md, wellformed.md)

    Sequential.v says when a mutation is accepted; here is what it is refused with, judged in the order of
    mutations.md, under a dictionary as users write it and within the limits. *)

From DSR Require Export Executable.

(** ** Dictionaries [DICT-1] *)

Record Words := {
  closed_words : bool;
  vertex_types : list Name;
  edge_labels : list Name;
  functional_labels : list Name;
  attribute_types : list (Name * N)
}.

(** [DICT-3] RT is never functional. *)
Definition dictionary (W : Words) : Dictionary :=
  {| functional := fun l => negb (is_RT l) && member l (functional_labels W) |}.
(** [DICT-2] *)
Definition allows_type (W : Words) (t : Name) : bool := implb (closed_words W) (member t (vertex_types W)).
Definition allows_label (W : Words) (l : Name) : bool :=
  implb (closed_words W) (is_RT l || member l (edge_labels W)).
Definition allows (W : Words) (n : Name) (t : N) : bool :=
  match lookup n (attribute_types W) with Some t' => eqb t' t | None => negb (closed_words W) end.

(** ** Limits *)

Definition name_bytes_max : N := 255.
Definition value_bytes_max : N := 67108864.
Definition attributes_max : N := 1024.
Definition stamp_max : N := 9007199254740991.
Definition sequence_max : N := 9007199254740991.

Definition count {A} (l : list A) : N := fold_left (fun n _ => (n + 1)%N) l 0%N.
(** [LIMIT-2] *)
Definition name_fits (n : Name) : bool := let b := count (bytes n) in (1 <=? b)%N && (b <=? name_bytes_max)%N.
(** [VALUE-1] How many bytes an item of a value has, by the number of its type. *)
Definition item_bytes (t : N) : N :=
  match t with
  | 1 | 2 | 3 | 6 | 10 | 11 | 12 | 13 => 4
  | 7 | 8 | 9 => 8
  | _ => 1
  end%N.
(** [LIMIT-3] *)
Definition value_fits (v : Value) : bool :=
  (count (items v) * item_bytes (value_type v) <=? value_bytes_max)%N.

(** ** Refusals *)

Inductive refusal :=
| NameLength | UndeclaredType | ReservedName | NameTaken
| LabelLength | UndeclaredLabel | UnknownVertex | SelfLoop | KeyPresent | FunctionalTaken
| IntoRoot | HasParent | ParentOutsideTree | NewVertexAsParent | Cycle
| TooMany | UndeclaredName | WrongType | ValueSize
| UnknownTarget | NoUpdates | NotSet
| UnknownEdge | SameKey | RefusedRoot | Strands
| Sequences | Stamps
| Link (why : refusal) | OfEdge (why : refusal) | OfAttribute (why : refusal) | Exhausted (why : refusal).

(** The first condition that does not hold. *)
Definition unless (holds : bool) (why : refusal) : option refusal := if holds then None else Some why.
Notation "a 'then_' b" := (match a with None => b | Some why => Some why end) (at level 60, right associativity).
Definition first_of {A} (f : A -> option refusal) (l : list A) : option refusal :=
  fold_right (fun x rest => f x then_ rest) None l.

(** ** What is asked of a view, worked out once *)

Section Sight.
  Context (W : Words).
  Let D := dictionary W.

  Record Sight := {
    seen_state : State;
    seen_vertices : list Dot;
    seen_symbolic : list Claim;
    seen_winners : list Claim;
    seen_accepted : list Claim;
    seen_refused : list (Claim * reason Claim);
    seen_labels : list (Dot * Dot)
  }.

  Definition sight (X : State) : Sight :=
    let vs := vertices X in
    let claims := visible X in
    let symbolic := filter (fun c => negb (is_RT (label c))) claims in
    let rivals c := filter (fun c' => competes D (key c) (snd c')) symbolic in
    let winners := filter (fun c => is_greatest claim_rank (rivals c) c) symbolic in
    let kinematic := descending claim_rank (filter (fun c => is_RT (label c) && negb (is_root (to c))) claims) in
    let grown := grow eq_dec from to [] kinematic in
    {| seen_state := X; seen_vertices := vs; seen_symbolic := symbolic; seen_winners := winners;
       seen_accepted := fst grown; seen_refused := snd grown;
       seen_labels := components vs (map ends (winners ++ fst grown)) |}.

  Definition seen_shown (s : Sight) : list Claim := seen_winners s ++ seen_accepted s.
  Definition seen_placement (s : Sight) (v : Dot) : Placement :=
    if is_root v then Root else
    match parent_claim eq_dec to (seen_accepted s) v with
    | Some c => Child (from c) (fst c)
    | None => if existsb (fun c => eqb (from c) v) (seen_accepted s) then DetachedTop else Outside
    end.
  Definition seen_detached (s : Sight) (v : Dot) : bool :=
    match seen_placement s v with DetachedTop => true | _ => false end.
  Definition seen_in_tree (s : Sight) (v : Dot) : bool :=
    match seen_placement s v with Outside => false | _ => true end.
  Definition seen_stranded (s : Sight) (v : Dot) : bool :=
    seen_detached s v || negb (eqb (look (seen_labels s) v) (look (seen_labels s) ROOT)).
  Definition seen_reattached (s : Sight) : list Dot :=
    let at_ := look (seen_labels s) in
    let lost := filter (seen_detached s) (seen_vertices s) in
    filter (fun v =>
      let own := filter (fun u => eqb (at_ u) (at_ v)) (seen_vertices s) in
      negb (eqb (at_ v) (at_ ROOT)) && forallb (fun u => negb (eqb (at_ u) (at_ v))) lost &&
      is_least (rank (seen_state s)) own v) (seen_vertices s).
  Definition seen_superseded (s : Sight) : list Repair :=
    let wins c := member c (seen_winners s) in
    flat_map (fun h => if wins h then [] else
      map (fun w => Superseded (fst h) (fst w) (rule_of D h))
          (filter (fun c => competes D (key h) (snd c)) (seen_winners s))) (seen_symbolic s).
  (** [VIEW-9] *)
  Definition seen_repairs (s : Sight) : list Repair :=
    seen_superseded s ++ map View.refusal (seen_refused s) ++ map Detached (filter (seen_detached s) (seen_vertices s)) ++
    map Reattached (seen_reattached s) ++ clashes (seen_state s) ++
    map (fun c => Undeclared (fst c)) (undeclared (allows W) (seen_state s)).

  (** ** Conditions, in their order *)

  (** [MUT-3.2] *)
  Definition attribute_refusal (n : Name) (v : Value) : option refusal :=
    unless (name_fits n) NameLength then_
    match lookup n (attribute_types W) with
    | None => unless (negb (closed_words W)) UndeclaredName
    | Some t => unless (eqb t (value_type v)) WrongType
    end then_
    unless (value_fits v) ValueSize.
  Definition attributes_refusal (l : Attributes) : option refusal :=
    match unless (count (entries l) <=? attributes_max)%N TooMany then_
          first_of (fun e => attribute_refusal (fst e) (snd e)) (entries l) with
    | Some why => Some (OfAttribute why)
    | None => None
    end.

  (** [MUT-2.2] *)
  Definition label_refusal (l : Name) : option refusal :=
    unless (name_fits l) LabelLength then_ unless (allows_label W l) UndeclaredLabel.

  Definition shows_key (s : Sight) (k : Key) : bool := existsb (has_key k) (seen_shown s).
  Definition shows_label (s : Sight) (source : Dot) (l : Name) : bool :=
    existsb (fun c => eqb (from c) source && eqb (label c) l) (seen_shown s).

  (** [MUT-2.2] [MUT-2.1] [MUT-2.3] [MUT-2.5] [MUT-2.4] *)
  Definition edge_refusal (s : Sight) (k : Key) : option refusal :=
    let X := seen_state s in
    label_refusal (key_label k) then_
    unless (in_graph X (key_from k) && in_graph X (key_to k)) UnknownVertex then_
    unless (negb (eqb (key_from k) (key_to k))) SelfLoop then_
    unless (negb (shows_key s k)) KeyPresent then_
    if is_RT (key_label k) then
      unless (negb (is_root (key_to k))) IntoRoot then_
      unless (match parent_claim eq_dec to (seen_accepted s) (key_to k) with Some _ => false | None => true end)
        HasParent then_
      unless (seen_in_tree s (key_from k)) ParentOutsideTree then_
      unless (negb (eqb (top eq_dec from to (seen_accepted s) (key_from k)) (key_to k))) Cycle
    else unless (implb (functional D (key_label k)) (negb (shows_label s (key_from k) (key_label k))))
           FunctionalTaken.

  (** [MUT-1.1] *)
  Definition link_refusal (s : Sight) (other : Dot) (l : Name) (outgoing : bool) : option refusal :=
    label_refusal l then_
    unless (in_graph (seen_state s) other) UnknownVertex then_
    if is_RT l then
      (if outgoing then Some (if is_root other then IntoRoot else NewVertexAsParent) else None) then_
      unless (seen_in_tree s other) ParentOutsideTree
    else unless (implb (negb outgoing && functional D l) (negb (shows_label s other l))) FunctionalTaken.

  (** [MUT-1.2] [MUT-1.3] *)
  Definition vertex_refusal (s : Sight) (type name : Name) : option refusal :=
    unless (name_fits type && name_fits name) NameLength then_
    unless (allows_type W type) UndeclaredType then_
    unless (negb (reserved name)) ReservedName then_
    unless (match by_name (seen_state s) name with Some _ => false | None => true end) NameTaken.

  (** [MUT-3.1] to [MUT-3.4] *)
  Definition update_refusal (s : Sight) (target : Dot) (updates : Updates) : option refusal :=
    unless (in_graph (seen_state s) target || existsb (fun c => eqb (fst c) target) (seen_shown s))
      UnknownTarget then_
    unless (match entries updates with [] => false | _ => true end) NoUpdates then_
    unless (count (entries updates) <=? attributes_max)%N TooMany then_
    first_of (fun e => match snd e with
      | Some v => attribute_refusal (fst e) v
      | None => unless (match attribute (allows W) (seen_state s) target (fst e) with
                        | Some _ => true | None => false end) NotSet
      end) (entries updates).

  (** [MUT-0.3] A mutation that makes no record is never refused so. *)
  Definition exhausted (S : Exec) (p : Plan) : option refusal :=
    match made p with
    | [] => None
    | _ =>
        unless (forallb (fun e => (sequence (fst e) <=? sequence_max)%N) (made p)) (Exhausted Sequences) then_
        unless (forallb (fun e => (stamp_of (snd e) <=? stamp_max)%N) (made p)) (Exhausted Stamps)
    end.

  (** [MUT-4.2] *)
  Definition strand_refusal (before after : Sight) : option refusal :=
    unless (forallb (fun v => implb (seen_stranded after v) (seen_stranded before v)) (seen_vertices after))
      Strands.

  (** What becomes of a mutation: why it is refused, or its delta and the state after. *)
  Definition attempt (S : Exec) (a : Author) (m : Mutation) : refusal + (Exec * Exec) :=
    let s := sight (shade S) in
    let p := x_plan D S a m in
    let d := x_delta_of p in
    let after := x_join S d in
    let within (why : option refusal) := match why with Some why => inl why | None => inr (d, after) end in
    let wrapped (f : refusal -> refusal) (why : option refusal) := option_map f why in
    match m with
    | AddVertex type name _ attributes other l outgoing link_attributes =>
        within (vertex_refusal s type name then_
                attributes_refusal attributes then_ attributes_refusal link_attributes then_
                wrapped Link (link_refusal s other l outgoing) then_ exhausted S p)
    | AddEdge k attributes =>
        within (edge_refusal s k then_ attributes_refusal attributes then_ exhausted S p)
    | UpdateAttributes target updates => within (update_refusal s target updates then_ exhausted S p)
    | RemoveEdge k =>
        within (unless (shows_key s k) UnknownEdge then_ strand_refusal s (sight (shade after)))
    | MoveEdge old new attributes =>
        within (unless (shows_key s old) UnknownEdge then_
                unless (negb (eqb (key_from old) (key_from new) && eqb (key_to old) (key_to new) &&
                              eqb (key_label old) (key_label new))) SameKey then_
                attributes_refusal attributes then_ exhausted S p then_
                wrapped OfEdge (edge_refusal
                  (sight (shade (x_join S (x_delta_of (x_plan D S a (RemoveEdge old)))))) new) then_
                strand_refusal s (sight (shade after)))
    | RemoveVertex v =>
        within (unless (negb (is_root v)) RefusedRoot then_
                unless (in_graph (seen_state s) v) UnknownVertex then_
                strand_refusal s (sight (shade after)))
    end.

End Sight.

(** ** Faults [WF-1] to [WF-6] *)

Inductive fault :=
| Sequence_ | HeldUnseen | NotClosed | WrongAnchor | NoSuchAnchor | FaultSelfLoop | FaultIntoRoot
| FaultNameLength | FaultValueSize | Stamp_ | Nan.

Definition first_fault {A} (f : A -> option fault) (l : list A) : option fault :=
  fold_right (fun x rest => f x then_ rest) None l.
Definition sound_or (holds : bool) (why : fault) : option fault := if holds then None else Some why.

(** [VALUE-4] A float's item is its place in the total order: of the bits b below the sign's it is b, of the
    others -(b - 2^31) - 1, and so for 64 bits. NaNs are beyond the infinities, and one is canonical. *)
Definition canonical_item (infinity nan i : Z) : bool :=
  (Z.eqb i nan || (Z.leb i infinity && Z.leb (- infinity - 1) i))%Z.
Definition nans_canonical (v : Value) : bool :=
  match value_type v with
  | 2 | 3 | 10 | 11 | 12 | 13 => forallb (canonical_item 2139095040 2143289344) (items v)
  | 8 => forallb (canonical_item 9218868437227405312 9221120237041090560) (items v)
  | _ => true
  end%N.

Definition anchor_fault (S : Exec) (x : record) (b : Dot) : option fault :=
  if is_root b then None else
  sound_or (negb (sequence b =? 0)%N) NoSuchAnchor then_
  sound_or (negb (x_dead S b)) NotClosed then_
  sound_or (match x_get S b with Some y => may_anchor x y | None => true end) WrongAnchor.

Definition record_fault (S : Exec) (d : Dot) (x : record) : option fault :=
  sound_or (x_seen S d) HeldUnseen then_
  sound_or ((1 <=? stamp_of x)%N && (stamp_of x <=? stamp_max)%N) Stamp_ then_
  first_fault (anchor_fault S x) (anchors x) then_
  match x with
  | Vertex t n _ _ => sound_or (name_fits t && name_fits n) FaultNameLength
  | Edge f t l _ =>
      sound_or (negb (eqb f t)) FaultSelfLoop then_
      sound_or (negb (is_RT l && is_root t)) FaultIntoRoot then_
      sound_or (name_fits l) FaultNameLength
  | Write _ n v _ _ =>
      sound_or (value_fits v) FaultValueSize then_ sound_or (nans_canonical v) Nan then_
      sound_or (name_fits n) FaultNameLength
  end.

(** The first fault of a state: the context is judged first, then record by record in the order of dots. *)
Definition state_fault (S : Exec) : option fault :=
  sound_or (forallb (fun e => forallb (fun i => (snd i <=? sequence_max)%N) (snd e)) (entries (form S))) Sequence_
  then_ first_fault (fun e => record_fault S (fst e) (snd e)) (entries (held S)).
