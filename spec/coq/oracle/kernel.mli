
val implb : bool -> bool -> bool

val option_map : ('a1 -> 'a2) -> 'a1 option -> 'a2 option

val length : 'a1 list -> int

val app : 'a1 list -> 'a1 list -> 'a1 list

type comparison =
| Eq
| Lt
| Gt

module Pos :
 sig
  type mask =
  | IsNul
  | IsPos of Number.t
  | IsNeg
 end

module Coq_Pos :
 sig
  val succ : Number.t -> Number.t

  val add : Number.t -> Number.t -> Number.t

  val add_carry : Number.t -> Number.t -> Number.t

  val pred_double : Number.t -> Number.t

  type mask = Pos.mask =
  | IsNul
  | IsPos of Number.t
  | IsNeg

  val succ_double_mask : mask -> mask

  val double_mask : mask -> mask

  val double_pred_mask : Number.t -> mask

  val sub_mask : Number.t -> Number.t -> mask

  val sub_mask_carry : Number.t -> Number.t -> mask

  val mul : Number.t -> Number.t -> Number.t

  val compare_cont : comparison -> Number.t -> Number.t -> comparison

  val compare : Number.t -> Number.t -> comparison

  val eqb : Number.t -> Number.t -> bool
 end

module N :
 sig
  val compare : Number.t -> Number.t -> comparison
 end

val hd_error : 'a1 list -> 'a1 option

val map : ('a1 -> 'a2) -> 'a1 list -> 'a2 list

val flat_map : ('a1 -> 'a2 list) -> 'a1 list -> 'a2 list

val fold_left : ('a1 -> 'a2 -> 'a1) -> 'a2 list -> 'a1 -> 'a1

val fold_right : ('a2 -> 'a1 -> 'a1) -> 'a1 -> 'a2 list -> 'a1

val existsb : ('a1 -> bool) -> 'a1 list -> bool

val forallb : ('a1 -> bool) -> 'a1 list -> bool

val filter : ('a1 -> bool) -> 'a1 list -> 'a1 list

val find : ('a1 -> bool) -> 'a1 list -> 'a1 option

module Z :
 sig
  val double : Number.t -> Number.t

  val succ_double : Number.t -> Number.t

  val pred_double : Number.t -> Number.t

  val pos_sub : Number.t -> Number.t -> Number.t

  val compare : Number.t -> Number.t -> comparison
 end

type 'a ordered =
  'a -> 'a -> comparison
  (* singleton inductive, whose constructor was Build_Ordered *)

val cmp : 'a1 ordered -> 'a1 -> 'a1 -> comparison

val eqb0 : 'a1 ordered -> 'a1 -> 'a1 -> bool

val ltb : 'a1 ordered -> 'a1 -> 'a1 -> bool

val eq_dec : 'a1 ordered -> 'a1 -> 'a1 -> bool

val member : 'a1 ordered -> 'a1 -> 'a1 list -> bool

val greater : 'a1 ordered -> 'a1 -> 'a1 -> 'a1

val ordered_N : Number.t ordered

val ordered_Z : Number.t ordered

val ordered_by : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 ordered

val then_cmp : comparison -> comparison -> comparison

val ordered_pair : 'a1 ordered -> 'a2 ordered -> ('a1 * 'a2) ordered

val cmp_option : 'a1 ordered -> 'a1 option -> 'a1 option -> comparison

val ordered_option : 'a1 ordered -> 'a1 option ordered

val cmp_list : 'a1 ordered -> 'a1 list -> 'a1 list -> comparison

val ordered_list : 'a1 ordered -> 'a1 list ordered

val bytes : string -> Number.t list

val ordered_string : string ordered

type ('k, 'v) fmap =
  ('k * 'v) list
  (* singleton inductive, whose constructor was FMap *)

val entries : 'a1 ordered -> ('a1, 'a2) fmap -> ('a1 * 'a2) list

val lookup : 'a1 ordered -> 'a1 -> ('a1 * 'a2) list -> 'a2 option

val find0 : 'a1 ordered -> ('a1, 'a2) fmap -> 'a1 -> 'a2 option

val keys : 'a1 ordered -> ('a1, 'a2) fmap -> 'a1 list

val size : 'a1 ordered -> ('a1, 'a2) fmap -> int

val insert_entry :
  'a1 ordered -> 'a1 -> 'a2 -> ('a1 * 'a2) list -> ('a1 * 'a2) list

val empty : 'a1 ordered -> ('a1, 'a2) fmap

val insert : 'a1 ordered -> 'a1 -> 'a2 -> ('a1, 'a2) fmap -> ('a1, 'a2) fmap

val tabulate :
  'a1 ordered -> ('a1 -> 'a2 option) -> 'a1 list -> ('a1, 'a2) fmap

type 'k fset = ('k, unit) fmap

val elements : 'a1 ordered -> 'a1 fset -> 'a1 list

val collect : 'a1 ordered -> ('a1 -> bool) -> 'a1 list -> 'a1 fset

val set_of : 'a1 ordered -> 'a1 list -> 'a1 fset

type replica = { agent : Number.t; incarnation : Number.t }

type dot = { replica0 : replica; sequence : Number.t }

val r : Number.t -> Number.t -> dot

val ordered_replica : replica ordered

val ordered_dot : dot ordered

val rOOT : dot

val is_root : dot -> bool

type name = string

type value = { value_type : Number.t; items : Number.t list }

type record =
| Vertex of name * name * Number.t option * Number.t
| Edge of dot * dot * name * Number.t
| Write of dot * name * value * Number.t * Number.t

val stamp_of : record -> Number.t

val anchors : record -> dot list

val value_fields : value -> Number.t * Number.t list

val ordered_value : value ordered

val vertex_fields :
  record -> (name * (name * (Number.t option * Number.t))) option

val edge_fields : record -> (dot * (dot * (name * Number.t))) option

val write_fields :
  record -> (dot * (name * (value * (Number.t * Number.t)))) option

val record_fields :
  record -> (dot * (name * (value * (Number.t * Number.t))))
  option * ((dot * (dot * (name * Number.t)))
  option * (name * (name * (Number.t option * Number.t))) option)

val ordered_record : record ordered

type state = { store : (dot, record) fmap; context : dot fset }

val get : state -> dot -> record option

val records : state -> (dot * record) list

val may_anchor : record -> record -> bool

val rT : name

type run_ = Number.t * Number.t

val within : Number.t -> run_ -> bool

val in_runs : run_ list -> Number.t -> bool

val add_run : Number.t -> Number.t -> run_ list -> run_ list

type form = (replica, run_ list) fmap

val runs_of : form -> replica -> run_ list

val covers : form -> dot -> bool

val insert_run : replica -> Number.t -> Number.t -> form -> form

val form_join : form -> form -> form

type rank = Number.t * dot

val rank_of : dot -> record -> rank

val rank0 : state -> dot -> rank option

val greatest_stamp : state -> Number.t

type key = { key_from : dot; key_to : dot; key_label : name }

type dictionary =
  name -> bool
  (* singleton inductive, whose constructor was Build_Dictionary *)

val functional : dictionary -> name -> bool

val is_RT : name -> bool

val competes : dictionary -> key -> record -> bool

val writes : dot -> name -> record -> bool

type author = { me : replica; time_ns : Number.t }

val greatest : state -> replica -> Number.t

val dot_of : replica -> Number.t -> dot

val numbered : replica -> Number.t -> record list -> (dot * record) list

type plan = { made : (dot * record) list; killed : dot list }

type attributes = (name, value) fmap

type updates = (name, value option) fmap

type mutation =
| AddVertex of name * name * Number.t option * attributes * dot * name * 
   bool * attributes
| AddEdge of key * attributes
| UpdateAttributes of dot * updates
| RemoveEdge of key
| MoveEdge of key * key * attributes
| RemoveVertex of dot

val register : dictionary -> state -> key -> dot list

val writes_of : state -> dot -> name -> dot list

val edge_record : state -> key -> record

val set : state -> author -> dot -> attributes -> record list

val updated : state -> author -> dot -> updates -> record list

val make_records : state -> author -> record list -> dot list -> plan

val plan0 : dictionary -> state -> author -> mutation -> plan

val top :
  ('a1 -> 'a1 -> bool) -> ('a2 -> 'a1) -> ('a2 -> 'a1) -> 'a2 list -> 'a1 ->
  'a1

val parent_claim :
  ('a1 -> 'a1 -> bool) -> ('a2 -> 'a1) -> 'a2 list -> 'a1 -> 'a2 option

type 'c reason =
| OtherParent of 'c
| ClosesCycle

val judge :
  ('a1 -> 'a1 -> bool) -> ('a2 -> 'a1) -> ('a2 -> 'a1) -> 'a2 list -> 'a2 ->
  'a2 reason option

val grow :
  ('a1 -> 'a1 -> bool) -> ('a2 -> 'a1) -> ('a2 -> 'a1) -> 'a2 list -> 'a2
  list -> 'a2 list * ('a2 * 'a2 reason) list

val is_greatest : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 list -> 'a1 -> bool

val is_least : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 list -> 'a1 -> bool

val file : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 -> 'a1 list -> 'a1 list

val descending : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 list -> 'a1 list

type claim = dot * record

val from : claim -> dot

val to0 : claim -> dot

val label : claim -> name

val key0 : claim -> key

val claim_rank : claim -> rank

val in_graph : state -> dot -> bool

val vertices : state -> dot list

val is_visible : state -> claim -> bool

val visible : state -> claim list

type rule =
| SameKey
| Functional
| RtParent

type repair =
| Superseded of dot * dot * rule
| CycleBroken of dot
| Detached of dot
| Reattached of dot
| NameClash of name * dot * dot
| Undeclared of dot

type placement =
| Root
| Child of dot * dot
| DetachedTop
| Outside

val look : (dot * dot) list -> dot -> dot

val unite : (dot * dot) -> (dot * dot) list -> (dot * dot) list

val components : dot list -> (dot * dot) list -> (dot * dot) list

val ends : claim -> dot * dot

val rule_of : dictionary -> claim -> rule

val refusal : (claim * claim reason) -> repair

val name_of : state -> dot -> name option

val reserved : name -> bool

val namesakes : state -> name -> dot list

val by_name : state -> name -> dot option

val clashes : state -> repair list

val is_element : state -> dot -> bool

val is_live_write : state -> claim -> bool

val declared : (name -> Number.t -> bool) -> claim -> bool

val live_writes : state -> claim list

val shown_writes : (name -> Number.t -> bool) -> state -> claim list

val attribute_writes :
  (name -> Number.t -> bool) -> state -> dot -> name -> claim list

val attribute :
  (name -> Number.t -> bool) -> state -> dot -> name -> claim option

val undeclared : (name -> Number.t -> bool) -> state -> claim list

val has_key : key -> claim -> bool

type exec = { held : (dot, record) fmap; form0 : form }

val x_bottom : exec

val x_get : exec -> dot -> record option

val x_seen : exec -> dot -> bool

val x_dead : exec -> dot -> bool

val shade : exec -> state

val x_merge : exec -> exec -> exec

val x_stranded : exec -> record -> bool

val x_is_closed : exec -> bool

val x_pass : exec -> exec

val x_close_within : int -> exec -> exec

val x_close : exec -> exec

val x_join : exec -> exec -> exec

val cut : Number.t -> Number.t -> run_ list -> run_ list

val cut_all : run_ list -> run_ list -> run_ list

val form_minus : form -> form -> form

val form_meet : form -> form -> form

val x_greatest : exec -> replica -> Number.t

val lift : exec -> replica -> state

val x_plan : dictionary -> exec -> author -> mutation -> plan

val form_of_list : dot list -> form

val x_delta_of : plan -> exec

val x_delta : dictionary -> author -> mutation -> exec -> exec

type xDigest = { x_context : form; x_live : form }

val x_digest : exec -> xDigest

val x_delta_for : exec -> xDigest -> exec

type words = { closed_words : bool; vertex_types : name list;
               edge_labels : name list; functional_labels : name list;
               attribute_types : (name * Number.t) list }

val dictionary0 : words -> dictionary

val allows_type : words -> name -> bool

val allows_label : words -> name -> bool

val allows : words -> name -> Number.t -> bool

val name_bytes_max : Number.t

val value_bytes_max : Number.t

val attributes_max : Number.t

val stamp_max : Number.t

val sequence_max : Number.t

val count : 'a1 list -> Number.t

val name_fits : name -> bool

val item_bytes : Number.t -> Number.t

val value_fits : value -> bool

type refusal0 =
| NameLength
| UndeclaredType
| ReservedName
| NameTaken
| LabelLength
| UndeclaredLabel
| UnknownVertex
| SelfLoop
| KeyPresent
| FunctionalTaken
| IntoRoot
| HasParent
| ParentOutsideTree
| NewVertexAsParent
| Cycle
| TooMany
| UndeclaredName
| WrongType
| ValueSize
| UnknownTarget
| NoUpdates
| NotSet
| UnknownEdge
| SameKey0
| RefusedRoot
| Strands
| Sequences
| Stamps
| Link of refusal0
| OfEdge of refusal0
| OfAttribute of refusal0
| Exhausted of refusal0

val unless : bool -> refusal0 -> refusal0 option

val first_of : ('a1 -> refusal0 option) -> 'a1 list -> refusal0 option

type sight = { seen_state : state; seen_vertices : dot list;
               seen_symbolic : claim list; seen_winners : claim list;
               seen_accepted : claim list;
               seen_refused : (claim * claim reason) list;
               seen_labels : (dot * dot) list }

val sight0 : words -> state -> sight

val seen_shown : sight -> claim list

val seen_placement : sight -> dot -> placement

val seen_detached : sight -> dot -> bool

val seen_in_tree : sight -> dot -> bool

val seen_stranded : sight -> dot -> bool

val seen_reattached : sight -> dot list

val seen_superseded : words -> sight -> repair list

val seen_repairs : words -> sight -> repair list

val attribute_refusal : words -> name -> value -> refusal0 option

val attributes_refusal : words -> attributes -> refusal0 option

val label_refusal : words -> name -> refusal0 option

val shows_key : sight -> key -> bool

val shows_label : sight -> dot -> name -> bool

val edge_refusal : words -> sight -> key -> refusal0 option

val link_refusal : words -> sight -> dot -> name -> bool -> refusal0 option

val vertex_refusal : words -> sight -> name -> name -> refusal0 option

val update_refusal : words -> sight -> dot -> updates -> refusal0 option

val exhausted : exec -> plan -> refusal0 option

val strand_refusal : sight -> sight -> refusal0 option

val attempt :
  words -> exec -> author -> mutation -> (refusal0, exec * exec) Either.t

type fault =
| Sequence_
| HeldUnseen
| NotClosed
| WrongAnchor
| NoSuchAnchor
| FaultSelfLoop
| FaultIntoRoot
| FaultNameLength
| FaultValueSize
| Stamp_
| Nan

val first_fault : ('a1 -> fault option) -> 'a1 list -> fault option

val sound_or : bool -> fault -> fault option

val canonical_item : Number.t -> Number.t -> Number.t -> bool

val nans_canonical : value -> bool

val anchor_fault : exec -> record -> dot -> fault option

val record_fault : exec -> dot -> record -> fault option

val state_fault : exec -> fault option
