
(** val implb : bool -> bool -> bool **)

let implb b1 b2 =
  if b1 then b2 else true

(** val option_map : ('a1 -> 'a2) -> 'a1 option -> 'a2 option **)

let option_map f = function
| Some a -> Some (f a)
| None -> None

(** val length : 'a1 list -> int **)

let rec length = function
| [] -> 0
| _ :: l' -> succ (length l')

(** val app : 'a1 list -> 'a1 list -> 'a1 list **)

let rec app l m =
  match l with
  | [] -> m
  | a :: l1 -> a :: (app l1 m)

type comparison =
| Eq
| Lt
| Gt

module Pos =
 struct
  type mask =
  | IsNul
  | IsPos of Number.t
  | IsNeg
 end

module Coq_Pos =
 struct
  (** val succ : Number.t -> Number.t **)

  let rec succ x =
    Number.on_positive
      (fun p -> Number.double (succ p))
      (fun p -> Number.next_double p)
      (fun _ -> Number.double Number.one)
      x

  (** val add : Number.t -> Number.t -> Number.t **)

  let rec add x y =
    Number.on_positive
      (fun p ->
      Number.on_positive
        (fun q -> Number.double (add_carry p q))
        (fun q -> Number.next_double (add p q))
        (fun _ -> Number.double (succ p))
        y)
      (fun p ->
      Number.on_positive
        (fun q -> Number.next_double (add p q))
        (fun q -> Number.double (add p q))
        (fun _ -> Number.next_double p)
        y)
      (fun _ ->
      Number.on_positive
        (fun q -> Number.double (succ q))
        (fun q -> Number.next_double q)
        (fun _ -> Number.double Number.one)
        y)
      x

  (** val add_carry : Number.t -> Number.t -> Number.t **)

  and add_carry x y =
    Number.on_positive
      (fun p ->
      Number.on_positive
        (fun q -> Number.next_double (add_carry p q))
        (fun q -> Number.double (add_carry p q))
        (fun _ -> Number.next_double (succ p))
        y)
      (fun p ->
      Number.on_positive
        (fun q -> Number.double (add_carry p q))
        (fun q -> Number.next_double (add p q))
        (fun _ -> Number.double (succ p))
        y)
      (fun _ ->
      Number.on_positive
        (fun q -> Number.next_double (succ q))
        (fun q -> Number.double (succ q))
        (fun _ -> Number.next_double Number.one)
        y)
      x

  (** val pred_double : Number.t -> Number.t **)

  let rec pred_double x =
    Number.on_positive
      (fun p -> Number.next_double (Number.double p))
      (fun p -> Number.next_double (pred_double p))
      (fun _ -> Number.one)
      x

  type mask = Pos.mask =
  | IsNul
  | IsPos of Number.t
  | IsNeg

  (** val succ_double_mask : mask -> mask **)

  let succ_double_mask = function
  | IsNul -> IsPos Number.one
  | IsPos p -> IsPos (Number.next_double p)
  | IsNeg -> IsNeg

  (** val double_mask : mask -> mask **)

  let double_mask = function
  | IsPos p -> IsPos (Number.double p)
  | x0 -> x0

  (** val double_pred_mask : Number.t -> mask **)

  let double_pred_mask x =
    Number.on_positive
      (fun p -> IsPos (Number.double (Number.double p)))
      (fun p -> IsPos (Number.double (pred_double p)))
      (fun _ -> IsNul)
      x

  (** val sub_mask : Number.t -> Number.t -> mask **)

  let rec sub_mask x y =
    Number.on_positive
      (fun p ->
      Number.on_positive
        (fun q -> double_mask (sub_mask p q))
        (fun q -> succ_double_mask (sub_mask p q))
        (fun _ -> IsPos (Number.double p))
        y)
      (fun p ->
      Number.on_positive
        (fun q -> succ_double_mask (sub_mask_carry p q))
        (fun q -> double_mask (sub_mask p q))
        (fun _ -> IsPos (pred_double p))
        y)
      (fun _ ->
      Number.on_positive
        (fun _ -> IsNeg)
        (fun _ -> IsNeg)
        (fun _ -> IsNul)
        y)
      x

  (** val sub_mask_carry : Number.t -> Number.t -> mask **)

  and sub_mask_carry x y =
    Number.on_positive
      (fun p ->
      Number.on_positive
        (fun q -> succ_double_mask (sub_mask_carry p q))
        (fun q -> double_mask (sub_mask p q))
        (fun _ -> IsPos (pred_double p))
        y)
      (fun p ->
      Number.on_positive
        (fun q -> double_mask (sub_mask_carry p q))
        (fun q -> succ_double_mask (sub_mask_carry p q))
        (fun _ -> double_pred_mask p)
        y)
      (fun _ -> IsNeg)
      x

  (** val mul : Number.t -> Number.t -> Number.t **)

  let rec mul x y =
    Number.on_positive
      (fun p -> add y (Number.double (mul p y)))
      (fun p -> Number.double (mul p y))
      (fun _ -> y)
      x

  (** val compare_cont : comparison -> Number.t -> Number.t -> comparison **)

  let rec compare_cont r0 x y =
    Number.on_positive
      (fun p ->
      Number.on_positive
        (fun q -> compare_cont r0 p q)
        (fun q -> compare_cont Gt p q)
        (fun _ -> Gt)
        y)
      (fun p ->
      Number.on_positive
        (fun q -> compare_cont Lt p q)
        (fun q -> compare_cont r0 p q)
        (fun _ -> Gt)
        y)
      (fun _ -> Number.on_positive
                  (fun _ -> Lt)
                  (fun _ -> Lt)
                  (fun _ -> r0)
                  y)
      x

  (** val compare : Number.t -> Number.t -> comparison **)

  let compare =
    compare_cont Eq

  (** val eqb : Number.t -> Number.t -> bool **)

  let rec eqb p q =
    Number.on_positive
      (fun p0 ->
      Number.on_positive
        (fun q0 -> eqb p0 q0)
        (fun _ -> false)
        (fun _ -> false)
        q)
      (fun p0 ->
      Number.on_positive
        (fun _ -> false)
        (fun q0 -> eqb p0 q0)
        (fun _ -> false)
        q)
      (fun _ ->
      Number.on_positive
        (fun _ -> false)
        (fun _ -> false)
        (fun _ -> true)
        q)
      p
 end

module N =
 struct
  (** val compare : Number.t -> Number.t -> comparison **)

  let compare = (fun x y -> if Number.equal x y then Eq else if Number.below x y then Lt else Gt)
 end

(** val hd_error : 'a1 list -> 'a1 option **)

let hd_error = function
| [] -> None
| x :: _ -> Some x

(** val map : ('a1 -> 'a2) -> 'a1 list -> 'a2 list **)

let rec map f = function
| [] -> []
| a :: t -> (f a) :: (map f t)

(** val flat_map : ('a1 -> 'a2 list) -> 'a1 list -> 'a2 list **)

let rec flat_map f = function
| [] -> []
| x :: t -> app (f x) (flat_map f t)

(** val fold_left : ('a1 -> 'a2 -> 'a1) -> 'a2 list -> 'a1 -> 'a1 **)

let rec fold_left f l a0 =
  match l with
  | [] -> a0
  | b :: t -> fold_left f t (f a0 b)

(** val fold_right : ('a2 -> 'a1 -> 'a1) -> 'a1 -> 'a2 list -> 'a1 **)

let rec fold_right f a0 = function
| [] -> a0
| b :: t -> f b (fold_right f a0 t)

(** val existsb : ('a1 -> bool) -> 'a1 list -> bool **)

let rec existsb f = function
| [] -> false
| a :: l0 -> ( || ) (f a) (existsb f l0)

(** val forallb : ('a1 -> bool) -> 'a1 list -> bool **)

let rec forallb f = function
| [] -> true
| a :: l0 -> ( && ) (f a) (forallb f l0)

(** val filter : ('a1 -> bool) -> 'a1 list -> 'a1 list **)

let rec filter f = function
| [] -> []
| x :: l0 -> if f x then x :: (filter f l0) else filter f l0

(** val find : ('a1 -> bool) -> 'a1 list -> 'a1 option **)

let rec find f = function
| [] -> None
| x :: tl -> if f x then Some x else find f tl

module Z =
 struct
  (** val double : Number.t -> Number.t **)

  let double x =
    Number.on_integer
      (fun _ -> Number.zero)
      (fun p -> (Number.double p))
      (fun p -> Number.opposite (Number.double p))
      x

  (** val succ_double : Number.t -> Number.t **)

  let succ_double x =
    Number.on_integer
      (fun _ -> Number.one)
      (fun p -> (Number.next_double p))
      (fun p -> Number.opposite (Coq_Pos.pred_double p))
      x

  (** val pred_double : Number.t -> Number.t **)

  let pred_double x =
    Number.on_integer
      (fun _ -> Number.opposite Number.one)
      (fun p -> (Coq_Pos.pred_double p))
      (fun p -> Number.opposite (Number.next_double p))
      x

  (** val pos_sub : Number.t -> Number.t -> Number.t **)

  let rec pos_sub x y =
    Number.on_positive
      (fun p ->
      Number.on_positive
        (fun q -> double (pos_sub p q))
        (fun q -> succ_double (pos_sub p q))
        (fun _ -> (Number.double p))
        y)
      (fun p ->
      Number.on_positive
        (fun q -> pred_double (pos_sub p q))
        (fun q -> double (pos_sub p q))
        (fun _ -> (Coq_Pos.pred_double p))
        y)
      (fun _ ->
      Number.on_positive
        (fun q -> Number.opposite (Number.double q))
        (fun q -> Number.opposite (Coq_Pos.pred_double q))
        (fun _ -> Number.zero)
        y)
      x

  (** val compare : Number.t -> Number.t -> comparison **)

  let compare = (fun x y -> if Number.equal x y then Eq else if Number.below x y then Lt else Gt)
 end

type 'a ordered =
  'a -> 'a -> comparison
  (* singleton inductive, whose constructor was Build_Ordered *)

(** val cmp : 'a1 ordered -> 'a1 -> 'a1 -> comparison **)

let cmp ordered0 =
  ordered0

(** val eqb0 : 'a1 ordered -> 'a1 -> 'a1 -> bool **)

let eqb0 h x y =
  match cmp h x y with
  | Eq -> true
  | _ -> false

(** val ltb : 'a1 ordered -> 'a1 -> 'a1 -> bool **)

let ltb h x y =
  match cmp h x y with
  | Lt -> true
  | _ -> false

(** val eq_dec : 'a1 ordered -> 'a1 -> 'a1 -> bool **)

let eq_dec h x y =
  let b = eqb0 h x y in if b then true else false

(** val member : 'a1 ordered -> 'a1 -> 'a1 list -> bool **)

let member h x l =
  existsb (eqb0 h x) l

(** val greater : 'a1 ordered -> 'a1 -> 'a1 -> 'a1 **)

let greater h x y =
  match cmp h x y with
  | Lt -> y
  | _ -> x

(** val ordered_N : Number.t ordered **)

let ordered_N =
  N.compare

(** val ordered_Z : Number.t ordered **)

let ordered_Z =
  Z.compare

(** val ordered_by : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 ordered **)

let ordered_by h f x y =
  cmp h (f x) (f y)

(** val then_cmp : comparison -> comparison -> comparison **)

let then_cmp c d =
  match c with
  | Eq -> d
  | _ -> c

(** val ordered_pair : 'a1 ordered -> 'a2 ordered -> ('a1 * 'a2) ordered **)

let ordered_pair h h0 x y =
  then_cmp (cmp h (fst x) (fst y)) (cmp h0 (snd x) (snd y))

(** val cmp_option : 'a1 ordered -> 'a1 option -> 'a1 option -> comparison **)

let cmp_option h x y =
  match x with
  | Some a -> (match y with
               | Some b -> cmp h a b
               | None -> Gt)
  | None -> (match y with
             | Some _ -> Lt
             | None -> Eq)

(** val ordered_option : 'a1 ordered -> 'a1 option ordered **)

let ordered_option =
  cmp_option

(** val cmp_list : 'a1 ordered -> 'a1 list -> 'a1 list -> comparison **)

let rec cmp_list h x y =
  match x with
  | [] -> (match y with
           | [] -> Eq
           | _ :: _ -> Lt)
  | a :: x0 ->
    (match y with
     | [] -> Gt
     | b :: y0 -> then_cmp (cmp h a b) (cmp_list h x0 y0))

(** val ordered_list : 'a1 ordered -> 'a1 list ordered **)

let ordered_list =
  cmp_list

(** val bytes : string -> Number.t list **)

let bytes = Number.bytes

(** val ordered_string : string ordered **)

let ordered_string = (fun x y -> let c = String.compare x y in if c < 0 then Lt else if c > 0 then Gt else Eq)

type ('k, 'v) fmap =
  ('k * 'v) list
  (* singleton inductive, whose constructor was FMap *)

(** val entries : 'a1 ordered -> ('a1, 'a2) fmap -> ('a1 * 'a2) list **)

let entries _ f =
  f

(** val lookup : 'a1 ordered -> 'a1 -> ('a1 * 'a2) list -> 'a2 option **)

let rec lookup h k = function
| [] -> None
| p :: rest ->
  let (k', v) = p in if eqb0 h k k' then Some v else lookup h k rest

(** val find0 : 'a1 ordered -> ('a1, 'a2) fmap -> 'a1 -> 'a2 option **)

let find0 h m k =
  lookup h k (entries h m)

(** val keys : 'a1 ordered -> ('a1, 'a2) fmap -> 'a1 list **)

let keys h m =
  map fst (entries h m)

(** val size : 'a1 ordered -> ('a1, 'a2) fmap -> int **)

let size h m =
  length (entries h m)

(** val insert_entry :
    'a1 ordered -> 'a1 -> 'a2 -> ('a1 * 'a2) list -> ('a1 * 'a2) list **)

let rec insert_entry h k v l = match l with
| [] -> (k, v) :: []
| p :: rest ->
  let (k', v') = p in
  (match cmp h k k' with
   | Eq -> (k, v) :: rest
   | Lt -> (k, v) :: l
   | Gt -> (k', v') :: (insert_entry h k v rest))

(** val empty : 'a1 ordered -> ('a1, 'a2) fmap **)

let empty _ =
  []

(** val insert :
    'a1 ordered -> 'a1 -> 'a2 -> ('a1, 'a2) fmap -> ('a1, 'a2) fmap **)

let insert h k v m =
  insert_entry h k v (entries h m)

(** val tabulate :
    'a1 ordered -> ('a1 -> 'a2 option) -> 'a1 list -> ('a1, 'a2) fmap **)

let tabulate h f ks =
  fold_right (fun k m -> match f k with
                         | Some v -> insert h k v m
                         | None -> m) (empty h) ks

type 'k fset = ('k, unit) fmap

(** val elements : 'a1 ordered -> 'a1 fset -> 'a1 list **)

let elements =
  keys

(** val collect : 'a1 ordered -> ('a1 -> bool) -> 'a1 list -> 'a1 fset **)

let collect h p ks =
  tabulate h (fun k -> if p k then Some () else None) ks

(** val set_of : 'a1 ordered -> 'a1 list -> 'a1 fset **)

let set_of h ks =
  collect h (fun _ -> true) ks

type replica = { agent : Number.t; incarnation : Number.t }

type dot = { replica0 : replica; sequence : Number.t }

(** val r : Number.t -> Number.t -> dot **)

let r a n0 =
  { replica0 = { agent = a; incarnation = Number.zero }; sequence = n0 }

(** val ordered_replica : replica ordered **)

let ordered_replica =
  ordered_by (ordered_pair ordered_N ordered_N) (fun x -> (x.agent,
    x.incarnation))

(** val ordered_dot : dot ordered **)

let ordered_dot =
  ordered_by (ordered_pair ordered_replica ordered_N) (fun x -> (x.replica0,
    x.sequence))

(** val rOOT : dot **)

let rOOT =
  r Number.zero Number.zero

(** val is_root : dot -> bool **)

let is_root d =
  eqb0 ordered_dot d rOOT

type name = string

type value = { value_type : Number.t; items : Number.t list }

type record =
| Vertex of name * name * Number.t option * Number.t
| Edge of dot * dot * name * Number.t
| Write of dot * name * value * Number.t * Number.t

(** val stamp_of : record -> Number.t **)

let stamp_of = function
| Vertex (_, _, _, s) -> s
| Edge (_, _, _, s) -> s
| Write (_, _, _, _, s) -> s

(** val anchors : record -> dot list **)

let anchors = function
| Vertex (_, _, _, _) -> []
| Edge (from0, to1, _, _) -> from0 :: (to1 :: [])
| Write (target, _, _, _, _) -> target :: []

(** val value_fields : value -> Number.t * Number.t list **)

let value_fields v =
  (v.value_type, v.items)

(** val ordered_value : value ordered **)

let ordered_value =
  ordered_by (ordered_pair ordered_N (ordered_list ordered_Z)) value_fields

(** val vertex_fields :
    record -> (name * (name * (Number.t option * Number.t))) option **)

let vertex_fields = function
| Vertex (t, n0, e, s) -> Some (t, (n0, (e, s)))
| _ -> None

(** val edge_fields : record -> (dot * (dot * (name * Number.t))) option **)

let edge_fields = function
| Edge (f, t, l, s) -> Some (f, (t, (l, s)))
| _ -> None

(** val write_fields :
    record -> (dot * (name * (value * (Number.t * Number.t)))) option **)

let write_fields = function
| Write (d, n0, v, t, s) -> Some (d, (n0, (v, (t, s))))
| _ -> None

(** val record_fields :
    record -> (dot * (name * (value * (Number.t * Number.t))))
    option * ((dot * (dot * (name * Number.t)))
    option * (name * (name * (Number.t option * Number.t))) option) **)

let record_fields x =
  ((write_fields x), ((edge_fields x), (vertex_fields x)))

(** val ordered_record : record ordered **)

let ordered_record =
  ordered_by
    (ordered_pair
      (ordered_option
        (ordered_pair ordered_dot
          (ordered_pair ordered_string
            (ordered_pair ordered_value (ordered_pair ordered_N ordered_N)))))
      (ordered_pair
        (ordered_option
          (ordered_pair ordered_dot
            (ordered_pair ordered_dot (ordered_pair ordered_string ordered_N))))
        (ordered_option
          (ordered_pair ordered_string
            (ordered_pair ordered_string
              (ordered_pair (ordered_option ordered_N) ordered_N))))))
    record_fields

type state = { store : (dot, record) fmap; context : dot fset }

(** val get : state -> dot -> record option **)

let get x d =
  find0 ordered_dot x.store d

(** val records : state -> (dot * record) list **)

let records x =
  entries ordered_dot x.store

(** val may_anchor : record -> record -> bool **)

let may_anchor x y =
  match x with
  | Vertex (_, _, _, _) -> false
  | Edge (_, _, _, _) ->
    (match y with
     | Vertex (_, _, _, _) -> true
     | _ -> false)
  | Write (_, _, _, _, _) ->
    (match y with
     | Write (_, _, _, _, _) -> false
     | _ -> true)

(** val rT : name **)

let rT =
  "RT"

type run_ = Number.t * Number.t

(** val within : Number.t -> run_ -> bool **)

let within k i =
  ( && ) (Number.at_most (fst i) k) (Number.at_most k (snd i))

(** val in_runs : run_ list -> Number.t -> bool **)

let in_runs rs k =
  existsb (within k) rs

(** val add_run : Number.t -> Number.t -> run_ list -> run_ list **)

let rec add_run f l rs = match rs with
| [] -> (f, l) :: []
| r0 :: rest ->
  let (f', l') = r0 in
  if Number.below (Number.add l Number.one) f'
  then (f, l) :: rs
  else if Number.below (Number.add l' Number.one) f
       then (f', l') :: (add_run f l rest)
       else add_run (Number.min f f') (Number.max l l') rest

type form = (replica, run_ list) fmap

(** val runs_of : form -> replica -> run_ list **)

let runs_of f p =
  match find0 ordered_replica f p with
  | Some rs -> rs
  | None -> []

(** val covers : form -> dot -> bool **)

let covers f d =
  in_runs (runs_of f d.replica0) d.sequence

(** val insert_run : replica -> Number.t -> Number.t -> form -> form **)

let insert_run p f l f0 =
  insert ordered_replica p (add_run f l (runs_of f0 p)) f0

(** val form_join : form -> form -> form **)

let form_join f g =
  fold_right (fun e h ->
    fold_right (fun i -> insert_run (fst e) (fst i) (snd i)) h (snd e)) f
    (entries ordered_replica g)

type rank = Number.t * dot

(** val rank_of : dot -> record -> rank **)

let rank_of d x =
  ((stamp_of x), d)

(** val rank0 : state -> dot -> rank option **)

let rank0 x d =
  option_map (rank_of d) (get x d)

(** val greatest_stamp : state -> Number.t **)

let greatest_stamp x =
  fold_right (fun e m -> Number.max (stamp_of (snd e)) m) Number.zero
    (records x)

type key = { key_from : dot; key_to : dot; key_label : name }

type dictionary =
  name -> bool
  (* singleton inductive, whose constructor was Build_Dictionary *)

(** val functional : dictionary -> name -> bool **)

let functional d =
  d

(** val is_RT : name -> bool **)

let is_RT label0 =
  eqb0 ordered_string label0 rT

(** val competes : dictionary -> key -> record -> bool **)

let competes d k = function
| Edge (from0, to1, label0, _) ->
  ( && ) (eqb0 ordered_string label0 k.key_label)
    (if is_RT label0
     then eqb0 ordered_dot to1 k.key_to
     else ( && ) (eqb0 ordered_dot from0 k.key_from)
            (( || ) (eqb0 ordered_dot to1 k.key_to) (functional d label0)))
| _ -> false

(** val writes : dot -> name -> record -> bool **)

let writes target name0 = function
| Write (t, n0, _, _, _) ->
  ( && ) (eqb0 ordered_dot t target) (eqb0 ordered_string n0 name0)
| _ -> false

type author = { me : replica; time_ns : Number.t }

(** val greatest : state -> replica -> Number.t **)

let greatest x p =
  fold_right (fun d m ->
    if eqb0 ordered_replica d.replica0 p then Number.max d.sequence m else m)
    Number.zero (elements ordered_dot x.context)

(** val dot_of : replica -> Number.t -> dot **)

let dot_of p n0 =
  { replica0 = p; sequence = n0 }

(** val numbered :
    replica -> Number.t -> record list -> (dot * record) list **)

let rec numbered p n0 = function
| [] -> []
| x :: xs0 ->
  ((dot_of p n0), x) :: (numbered p (Number.add n0 Number.one) xs0)

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

(** val register : dictionary -> state -> key -> dot list **)

let register d x k =
  map fst (filter (fun e -> competes d k (snd e)) (records x))

(** val writes_of : state -> dot -> name -> dot list **)

let writes_of x target name0 =
  map fst (filter (fun e -> writes target name0 (snd e)) (records x))

(** val edge_record : state -> key -> record **)

let edge_record x =
  let stamp = Number.add Number.one (greatest_stamp x) in
  (fun k -> Edge (k.key_from, k.key_to, k.key_label, stamp))

(** val set : state -> author -> dot -> attributes -> record list **)

let set x a =
  let stamp = Number.add Number.one (greatest_stamp x) in
  (fun target attributes0 ->
  map (fun e -> Write (target, (fst e), (snd e), a.time_ns, stamp))
    (entries ordered_string attributes0))

(** val updated : state -> author -> dot -> updates -> record list **)

let updated x a =
  let stamp = Number.add Number.one (greatest_stamp x) in
  (fun target updates0 ->
  flat_map (fun e ->
    match snd e with
    | Some v -> (Write (target, (fst e), v, a.time_ns, stamp)) :: []
    | None -> []) (entries ordered_string updates0))

(** val make_records : state -> author -> record list -> dot list -> plan **)

let make_records x a =
  let first = Number.add Number.one (greatest x a.me) in
  (fun xs kill -> { made = (numbered a.me first xs); killed = kill })

(** val plan0 : dictionary -> state -> author -> mutation -> plan **)

let plan0 d x a =
  let stamp = Number.add Number.one (greatest_stamp x) in
  let first = Number.add Number.one (greatest x a.me) in
  let dot0 = dot_of a.me in
  (fun m ->
  match m with
  | AddVertex (type0, name0, ext, attributes0, other, label0, outgoing,
               link_attributes) ->
    let new0 = dot0 first in
    let k =
      if outgoing
      then { key_from = new0; key_to = other; key_label = label0 }
      else { key_from = other; key_to = new0; key_label = label0 }
    in
    make_records x a ((Vertex (type0, name0, ext,
      stamp)) :: ((edge_record x k) :: (app
                                         (set x a
                                           (dot0
                                             (Number.add first Number.one))
                                           link_attributes)
                                         (set x a new0 attributes0))))
      (register d x k)
  | AddEdge (k, attributes0) ->
    make_records x a
      ((edge_record x k) :: (set x a (dot0 first) attributes0))
      (register d x k)
  | UpdateAttributes (target, updates0) ->
    make_records x a (updated x a target updates0)
      (flat_map (writes_of x target) (keys ordered_string updates0))
  | RemoveEdge k -> make_records x a [] (register d x k)
  | MoveEdge (old, new0, attributes0) ->
    make_records x a
      ((edge_record x new0) :: (set x a (dot0 first) attributes0))
      (app (register d x old) (register d x new0))
  | RemoveVertex v -> make_records x a [] (v :: []))

(** val top :
    ('a1 -> 'a1 -> bool) -> ('a2 -> 'a1) -> ('a2 -> 'a1) -> 'a2 list -> 'a1
    -> 'a1 **)

let rec top v_eq_dec parent child accepted v =
  match accepted with
  | [] -> v
  | c :: older ->
    let t = top v_eq_dec parent child older v in
    if v_eq_dec t (child c)
    then top v_eq_dec parent child older (parent c)
    else t

(** val parent_claim :
    ('a1 -> 'a1 -> bool) -> ('a2 -> 'a1) -> 'a2 list -> 'a1 -> 'a2 option **)

let parent_claim v_eq_dec child accepted v =
  find (fun c -> if v_eq_dec (child c) v then true else false) accepted

type 'c reason =
| OtherParent of 'c
| ClosesCycle

(** val judge :
    ('a1 -> 'a1 -> bool) -> ('a2 -> 'a1) -> ('a2 -> 'a1) -> 'a2 list -> 'a2
    -> 'a2 reason option **)

let judge v_eq_dec parent child accepted c =
  match parent_claim v_eq_dec child accepted (child c) with
  | Some shown -> Some (OtherParent shown)
  | None ->
    if v_eq_dec (top v_eq_dec parent child accepted (parent c)) (child c)
    then Some ClosesCycle
    else None

(** val grow :
    ('a1 -> 'a1 -> bool) -> ('a2 -> 'a1) -> ('a2 -> 'a1) -> 'a2 list -> 'a2
    list -> 'a2 list * ('a2 * 'a2 reason) list **)

let rec grow v_eq_dec parent child accepted = function
| [] -> (accepted, [])
| c :: rest ->
  (match judge v_eq_dec parent child accepted c with
   | Some why ->
     let (shown, hidden) = grow v_eq_dec parent child accepted rest in
     (shown, ((c, why) :: hidden))
   | None -> grow v_eq_dec parent child (c :: accepted) rest)

(** val is_greatest :
    'a2 ordered -> ('a1 -> 'a2) -> 'a1 list -> 'a1 -> bool **)

let is_greatest h f l a =
  forallb (fun b -> not (ltb h (f a) (f b))) l

(** val is_least : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 list -> 'a1 -> bool **)

let is_least h f l a =
  forallb (fun b -> not (ltb h (f b) (f a))) l

(** val file : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 -> 'a1 list -> 'a1 list **)

let rec file h f a l = match l with
| [] -> a :: []
| b :: rest -> if ltb h (f a) (f b) then b :: (file h f a rest) else a :: l

(** val descending : 'a2 ordered -> ('a1 -> 'a2) -> 'a1 list -> 'a1 list **)

let descending h f l =
  fold_right (file h f) [] l

type claim = dot * record

(** val from : claim -> dot **)

let from c =
  match snd c with
  | Edge (f, _, _, _) -> f
  | _ -> rOOT

(** val to0 : claim -> dot **)

let to0 c =
  match snd c with
  | Edge (_, t, _, _) -> t
  | _ -> rOOT

(** val label : claim -> name **)

let label c =
  match snd c with
  | Edge (_, _, l, _) -> l
  | _ -> ""

(** val key0 : claim -> key **)

let key0 c =
  { key_from = (from c); key_to = (to0 c); key_label = (label c) }

(** val claim_rank : claim -> rank **)

let claim_rank c =
  rank_of (fst c) (snd c)

(** val in_graph : state -> dot -> bool **)

let in_graph x d =
  ( || ) (is_root d)
    (match get x d with
     | Some r0 -> (match r0 with
                   | Vertex (_, _, _, _) -> true
                   | _ -> false)
     | None -> false)

(** val vertices : state -> dot list **)

let vertices x =
  rOOT :: (map fst
            (filter (fun c ->
              match snd c with
              | Vertex (_, _, _, _) -> true
              | _ -> false) (records x)))

(** val is_visible : state -> claim -> bool **)

let is_visible x c =
  match snd c with
  | Edge (f, t, _, _) ->
    ( && ) (( && ) (not (eqb0 ordered_dot f t)) (in_graph x f)) (in_graph x t)
  | _ -> false

(** val visible : state -> claim list **)

let visible x =
  filter (is_visible x) (records x)

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

(** val look : (dot * dot) list -> dot -> dot **)

let look labels v =
  match lookup ordered_dot v labels with
  | Some l -> l
  | None -> v

(** val unite : (dot * dot) -> (dot * dot) list -> (dot * dot) list **)

let unite edge labels =
  let a = look labels (fst edge) in
  let b = look labels (snd edge) in
  map (fun p -> ((fst p),
    (if eq_dec ordered_dot (snd p) a then b else snd p))) labels

(** val components : dot list -> (dot * dot) list -> (dot * dot) list **)

let components vs edges =
  fold_right unite (map (fun v -> (v, v)) vs) edges

(** val ends : claim -> dot * dot **)

let ends c =
  ((from c), (to0 c))

(** val rule_of : dictionary -> claim -> rule **)

let rule_of d c =
  if functional d (label c) then Functional else SameKey

(** val refusal : (claim * claim reason) -> repair **)

let refusal h =
  match snd h with
  | OtherParent s -> Superseded ((fst (fst h)), (fst s), RtParent)
  | ClosesCycle -> CycleBroken (fst (fst h))

(** val name_of : state -> dot -> name option **)

let name_of x v =
  match get x v with
  | Some r0 -> (match r0 with
                | Vertex (_, n0, _, _) -> Some n0
                | _ -> None)
  | None -> None

(** val reserved : name -> bool **)

let reserved n0 =
  ( || ) (eqb0 ordered_string n0 "root") (eqb0 ordered_string n0 "world")

(** val namesakes : state -> name -> dot list **)

let namesakes x n0 =
  filter (fun v ->
    eqb0 (ordered_option ordered_string) (name_of x v) (Some n0)) (vertices x)

(** val by_name : state -> name -> dot option **)

let by_name x n0 =
  if reserved n0
  then Some rOOT
  else find
         (is_least (ordered_option (ordered_pair ordered_N ordered_dot))
           (rank0 x) (namesakes x n0)) (namesakes x n0)

(** val clashes : state -> repair list **)

let clashes x =
  flat_map (fun v ->
    match name_of x v with
    | Some n0 ->
      (match by_name x n0 with
       | Some w ->
         if eqb0 ordered_dot w v then [] else (NameClash (n0, w, v)) :: []
       | None -> [])
    | None -> []) (vertices x)

(** val is_element : state -> dot -> bool **)

let is_element x d =
  ( || ) (in_graph x d)
    (match get x d with
     | Some x0 -> is_visible x (d, x0)
     | None -> false)

(** val is_live_write : state -> claim -> bool **)

let is_live_write x c =
  match snd c with
  | Write (t, _, _, _, _) -> is_element x t
  | _ -> false

(** val declared : (name -> Number.t -> bool) -> claim -> bool **)

let declared allows0 c =
  match snd c with
  | Write (_, n0, v, _, _) -> allows0 n0 v.value_type
  | _ -> false

(** val live_writes : state -> claim list **)

let live_writes x =
  filter (is_live_write x) (records x)

(** val shown_writes : (name -> Number.t -> bool) -> state -> claim list **)

let shown_writes allows0 x =
  filter (declared allows0) (live_writes x)

(** val attribute_writes :
    (name -> Number.t -> bool) -> state -> dot -> name -> claim list **)

let attribute_writes allows0 x target name0 =
  descending (ordered_pair ordered_N ordered_dot) claim_rank
    (filter (fun c -> writes target name0 (snd c)) (shown_writes allows0 x))

(** val attribute :
    (name -> Number.t -> bool) -> state -> dot -> name -> claim option **)

let attribute allows0 x target name0 =
  hd_error (attribute_writes allows0 x target name0)

(** val undeclared : (name -> Number.t -> bool) -> state -> claim list **)

let undeclared allows0 x =
  filter (fun c -> not (declared allows0 c)) (live_writes x)

(** val has_key : key -> claim -> bool **)

let has_key k c =
  ( && )
    (( && ) (eqb0 ordered_dot (from c) k.key_from)
      (eqb0 ordered_dot (to0 c) k.key_to))
    (eqb0 ordered_string (label c) k.key_label)

type exec = { held : (dot, record) fmap; form0 : form }

(** val x_bottom : exec **)

let x_bottom =
  { held = (empty ordered_dot); form0 = (empty ordered_replica) }

(** val x_get : exec -> dot -> record option **)

let x_get s d =
  find0 ordered_dot s.held d

(** val x_seen : exec -> dot -> bool **)

let x_seen s d =
  covers s.form0 d

(** val x_dead : exec -> dot -> bool **)

let x_dead s d =
  match x_get s d with
  | Some _ -> false
  | None -> x_seen s d

(** val shade : exec -> state **)

let shade s =
  { store = s.held; context = (empty ordered_dot) }

(** val x_merge : exec -> exec -> exec **)

let x_merge s t =
  { held =
    (tabulate ordered_dot (fun d ->
      match x_get s d with
      | Some x ->
        (match x_get t d with
         | Some y -> Some (greater ordered_record x y)
         | None -> if x_seen t d then None else Some x)
      | None ->
        (match x_get t d with
         | Some y -> if x_seen s d then None else Some y
         | None -> None))
      (app (keys ordered_dot s.held) (keys ordered_dot t.held))); form0 =
    (form_join s.form0 t.form0) }

(** val x_stranded : exec -> record -> bool **)

let x_stranded s x =
  existsb (x_dead s) (anchors x)

(** val x_is_closed : exec -> bool **)

let x_is_closed s =
  forallb (fun e -> not (x_stranded s (snd e))) (entries ordered_dot s.held)

(** val x_pass : exec -> exec **)

let x_pass s =
  { held =
    (tabulate ordered_dot (fun d ->
      match x_get s d with
      | Some x -> if x_stranded s x then None else Some x
      | None -> None) (keys ordered_dot s.held)); form0 = s.form0 }

(** val x_close_within : int -> exec -> exec **)

let rec x_close_within n0 s =
  Number.on_count
    (fun _ -> s)
    (fun n1 -> if x_is_closed s then s else x_close_within n1 (x_pass s))
    n0

(** val x_close : exec -> exec **)

let x_close s =
  x_close_within (size ordered_dot s.held) s

(** val x_join : exec -> exec -> exec **)

let x_join s t =
  x_close (x_merge s t)

(** val cut : Number.t -> Number.t -> run_ list -> run_ list **)

let cut f l rs =
  flat_map (fun i ->
    app
      (if Number.below (fst i) f
       then ((fst i), (Number.min (snd i) (Number.less f Number.one))) :: []
       else [])
      (if Number.below l (snd i)
       then ((Number.max (fst i) (Number.add l Number.one)), (snd i)) :: []
       else [])) rs

(** val cut_all : run_ list -> run_ list -> run_ list **)

let cut_all rs cuts =
  fold_right (fun i -> cut (fst i) (snd i)) rs cuts

(** val form_minus : form -> form -> form **)

let form_minus f g =
  tabulate ordered_replica (fun p ->
    match cut_all (runs_of f p) (runs_of g p) with
    | [] -> None
    | r0 :: l -> Some (r0 :: l)) (keys ordered_replica f)

(** val form_meet : form -> form -> form **)

let form_meet f g =
  form_minus f (form_minus f g)

(** val x_greatest : exec -> replica -> Number.t **)

let x_greatest s p =
  fold_right (fun i m -> Number.max (snd i) m) Number.zero (runs_of s.form0 p)

(** val lift : exec -> replica -> state **)

let lift s p =
  { store = s.held; context =
    (if Number.equal (x_greatest s p) Number.zero
     then empty ordered_dot
     else set_of ordered_dot ((dot_of p (x_greatest s p)) :: [])) }

(** val x_plan : dictionary -> exec -> author -> mutation -> plan **)

let x_plan d s a m =
  plan0 d (lift s a.me) a m

(** val form_of_list : dot list -> form **)

let form_of_list ds =
  fold_right (fun d -> insert_run d.replica0 d.sequence d.sequence)
    (empty ordered_replica) ds

(** val x_delta_of : plan -> exec **)

let x_delta_of p =
  { held =
    (tabulate ordered_dot (fun d -> lookup ordered_dot d p.made)
      (map fst p.made)); form0 =
    (form_of_list (app (map fst p.made) p.killed)) }

(** val x_delta : dictionary -> author -> mutation -> exec -> exec **)

let x_delta d a m s =
  x_delta_of (x_plan d s a m)

type xDigest = { x_context : form; x_live : form }

(** val x_digest : exec -> xDigest **)

let x_digest s =
  { x_context = s.form0; x_live = (form_of_list (keys ordered_dot s.held)) }

(** val x_delta_for : exec -> xDigest -> exec **)

let x_delta_for s g =
  { held =
    (tabulate ordered_dot (fun d ->
      if covers g.x_context d then None else x_get s d)
      (keys ordered_dot s.held)); form0 =
    (form_join (form_minus s.form0 g.x_context)
      (form_meet g.x_live
        (form_minus s.form0 (form_of_list (keys ordered_dot s.held))))) }

type words = { closed_words : bool; vertex_types : name list;
               edge_labels : name list; functional_labels : name list;
               attribute_types : (name * Number.t) list }

(** val dictionary0 : words -> dictionary **)

let dictionary0 w l =
  ( && ) (not (is_RT l)) (member ordered_string l w.functional_labels)

(** val allows_type : words -> name -> bool **)

let allows_type w t =
  implb w.closed_words (member ordered_string t w.vertex_types)

(** val allows_label : words -> name -> bool **)

let allows_label w l =
  implb w.closed_words
    (( || ) (is_RT l) (member ordered_string l w.edge_labels))

(** val allows : words -> name -> Number.t -> bool **)

let allows w n0 t =
  match lookup ordered_string n0 w.attribute_types with
  | Some t' -> eqb0 ordered_N t' t
  | None -> not w.closed_words

(** val name_bytes_max : Number.t **)

let name_bytes_max =
  (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double Number.one)))))))

(** val value_bytes_max : Number.t **)

let value_bytes_max =
  (Number.double (Number.double (Number.double (Number.double (Number.double
    (Number.double (Number.double (Number.double (Number.double
    (Number.double (Number.double (Number.double (Number.double
    (Number.double (Number.double (Number.double (Number.double
    (Number.double (Number.double (Number.double (Number.double
    (Number.double (Number.double (Number.double (Number.double
    (Number.double Number.one))))))))))))))))))))))))))

(** val attributes_max : Number.t **)

let attributes_max =
  (Number.double (Number.double (Number.double (Number.double (Number.double
    (Number.double (Number.double (Number.double (Number.double
    (Number.double Number.one))))))))))

(** val stamp_max : Number.t **)

let stamp_max =
  (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double
    Number.one))))))))))))))))))))))))))))))))))))))))))))))))))))

(** val sequence_max : Number.t **)

let sequence_max =
  (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double (Number.next_double (Number.next_double
    (Number.next_double
    Number.one))))))))))))))))))))))))))))))))))))))))))))))))))))

(** val count : 'a1 list -> Number.t **)

let count l =
  fold_left (fun n0 _ -> Number.add n0 Number.one) l Number.zero

(** val name_fits : name -> bool **)

let name_fits n0 =
  let b = count (bytes n0) in
  ( && ) (Number.at_most Number.one b) (Number.at_most b name_bytes_max)

(** val item_bytes : Number.t -> Number.t **)

let item_bytes t =
  Number.on_natural
    (fun _ -> Number.one)
    (fun p ->
    Number.on_positive
      (fun p0 ->
      Number.on_positive
        (fun p1 ->
        Number.on_positive
          (fun _ -> Number.one)
          (fun p2 ->
          Number.on_positive
            (fun _ -> Number.one)
            (fun _ -> Number.one)
            (fun _ -> (Number.double (Number.double Number.one)))
            p2)
          (fun _ -> (Number.double (Number.double (Number.double
          Number.one))))
          p1)
        (fun p1 ->
        Number.on_positive
          (fun p2 ->
          Number.on_positive
            (fun _ -> Number.one)
            (fun _ -> Number.one)
            (fun _ -> (Number.double (Number.double Number.one)))
            p2)
          (fun p2 ->
          Number.on_positive
            (fun _ -> Number.one)
            (fun _ -> Number.one)
            (fun _ -> (Number.double (Number.double (Number.double
            Number.one))))
            p2)
          (fun _ -> Number.one)
          p1)
        (fun _ -> (Number.double (Number.double Number.one)))
        p0)
      (fun p0 ->
      Number.on_positive
        (fun p1 ->
        Number.on_positive
          (fun _ -> Number.one)
          (fun p2 ->
          Number.on_positive
            (fun _ -> Number.one)
            (fun _ -> Number.one)
            (fun _ -> (Number.double (Number.double Number.one)))
            p2)
          (fun _ -> (Number.double (Number.double Number.one)))
          p1)
        (fun p1 ->
        Number.on_positive
          (fun p2 ->
          Number.on_positive
            (fun _ -> Number.one)
            (fun _ -> Number.one)
            (fun _ -> (Number.double (Number.double Number.one)))
            p2)
          (fun p2 ->
          Number.on_positive
            (fun _ -> Number.one)
            (fun _ -> Number.one)
            (fun _ -> (Number.double (Number.double (Number.double
            Number.one))))
            p2)
          (fun _ -> Number.one)
          p1)
        (fun _ -> (Number.double (Number.double Number.one)))
        p0)
      (fun _ -> (Number.double (Number.double Number.one)))
      p)
    t

(** val value_fits : value -> bool **)

let value_fits v =
  Number.at_most (Number.multiply (count v.items) (item_bytes v.value_type))
    value_bytes_max

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

(** val unless : bool -> refusal0 -> refusal0 option **)

let unless holds why =
  if holds then None else Some why

(** val first_of : ('a1 -> refusal0 option) -> 'a1 list -> refusal0 option **)

let first_of f l =
  fold_right (fun x rest ->
    match f x with
    | Some why -> Some why
    | None -> rest) None l

type sight = { seen_state : state; seen_vertices : dot list;
               seen_symbolic : claim list; seen_winners : claim list;
               seen_accepted : claim list;
               seen_refused : (claim * claim reason) list;
               seen_labels : (dot * dot) list }

(** val sight0 : words -> state -> sight **)

let sight0 w =
  let d = dictionary0 w in
  (fun x ->
  let vs = vertices x in
  let claims = visible x in
  let symbolic = filter (fun c -> not (is_RT (label c))) claims in
  let rivals = fun c ->
    filter (fun c' -> competes d (key0 c) (snd c')) symbolic
  in
  let winners =
    filter (fun c ->
      is_greatest (ordered_pair ordered_N ordered_dot) claim_rank (rivals c) c)
      symbolic
  in
  let kinematic =
    descending (ordered_pair ordered_N ordered_dot) claim_rank
      (filter (fun c -> ( && ) (is_RT (label c)) (not (is_root (to0 c))))
        claims)
  in
  let grown = grow (eq_dec ordered_dot) from to0 [] kinematic in
  { seen_state = x; seen_vertices = vs; seen_symbolic = symbolic;
  seen_winners = winners; seen_accepted = (fst grown); seen_refused =
  (snd grown); seen_labels =
  (components vs (map ends (app winners (fst grown)))) })

(** val seen_shown : sight -> claim list **)

let seen_shown s =
  app s.seen_winners s.seen_accepted

(** val seen_placement : sight -> dot -> placement **)

let seen_placement s v =
  if is_root v
  then Root
  else (match parent_claim (eq_dec ordered_dot) to0 s.seen_accepted v with
        | Some c -> Child ((from c), (fst c))
        | None ->
          if existsb (fun c -> eqb0 ordered_dot (from c) v) s.seen_accepted
          then DetachedTop
          else Outside)

(** val seen_detached : sight -> dot -> bool **)

let seen_detached s v =
  match seen_placement s v with
  | DetachedTop -> true
  | _ -> false

(** val seen_in_tree : sight -> dot -> bool **)

let seen_in_tree s v =
  match seen_placement s v with
  | Outside -> false
  | _ -> true

(** val seen_stranded : sight -> dot -> bool **)

let seen_stranded s v =
  ( || ) (seen_detached s v)
    (not (eqb0 ordered_dot (look s.seen_labels v) (look s.seen_labels rOOT)))

(** val seen_reattached : sight -> dot list **)

let seen_reattached s =
  let at_ = look s.seen_labels in
  let lost = filter (seen_detached s) s.seen_vertices in
  filter (fun v ->
    let own =
      filter (fun u -> eqb0 ordered_dot (at_ u) (at_ v)) s.seen_vertices
    in
    ( && )
      (( && ) (not (eqb0 ordered_dot (at_ v) (at_ rOOT)))
        (forallb (fun u -> not (eqb0 ordered_dot (at_ u) (at_ v))) lost))
      (is_least (ordered_option (ordered_pair ordered_N ordered_dot))
        (rank0 s.seen_state) own v)) s.seen_vertices

(** val seen_superseded : words -> sight -> repair list **)

let seen_superseded w =
  let d = dictionary0 w in
  (fun s ->
  let wins = fun c ->
    member (ordered_pair ordered_dot ordered_record) c s.seen_winners
  in
  flat_map (fun h ->
    if wins h
    then []
    else map (fun w0 -> Superseded ((fst h), (fst w0), (rule_of d h)))
           (filter (fun c -> competes d (key0 h) (snd c)) s.seen_winners))
    s.seen_symbolic)

(** val seen_repairs : words -> sight -> repair list **)

let seen_repairs w s =
  app (seen_superseded w s)
    (app (map refusal s.seen_refused)
      (app
        (map (fun x -> Detached x) (filter (seen_detached s) s.seen_vertices))
        (app (map (fun x -> Reattached x) (seen_reattached s))
          (app (clashes s.seen_state)
            (map (fun c -> Undeclared (fst c))
              (undeclared (allows w) s.seen_state))))))

(** val attribute_refusal : words -> name -> value -> refusal0 option **)

let attribute_refusal w n0 v =
  match unless (name_fits n0) NameLength with
  | Some why -> Some why
  | None ->
    (match match lookup ordered_string n0 w.attribute_types with
           | Some t -> unless (eqb0 ordered_N t v.value_type) WrongType
           | None -> unless (not w.closed_words) UndeclaredName with
     | Some why -> Some why
     | None -> unless (value_fits v) ValueSize)

(** val attributes_refusal : words -> attributes -> refusal0 option **)

let attributes_refusal w l =
  match match unless
                (Number.at_most (count (entries ordered_string l))
                  attributes_max) TooMany with
        | Some why -> Some why
        | None ->
          first_of (fun e -> attribute_refusal w (fst e) (snd e))
            (entries ordered_string l) with
  | Some why -> Some (OfAttribute why)
  | None -> None

(** val label_refusal : words -> name -> refusal0 option **)

let label_refusal w l =
  match unless (name_fits l) LabelLength with
  | Some why -> Some why
  | None -> unless (allows_label w l) UndeclaredLabel

(** val shows_key : sight -> key -> bool **)

let shows_key s k =
  existsb (has_key k) (seen_shown s)

(** val shows_label : sight -> dot -> name -> bool **)

let shows_label s source l =
  existsb (fun c ->
    ( && ) (eqb0 ordered_dot (from c) source)
      (eqb0 ordered_string (label c) l)) (seen_shown s)

(** val edge_refusal : words -> sight -> key -> refusal0 option **)

let edge_refusal w =
  let d = dictionary0 w in
  (fun s k ->
  let x = s.seen_state in
  (match label_refusal w k.key_label with
   | Some why -> Some why
   | None ->
     (match unless (( && ) (in_graph x k.key_from) (in_graph x k.key_to))
              UnknownVertex with
      | Some why -> Some why
      | None ->
        (match unless (not (eqb0 ordered_dot k.key_from k.key_to)) SelfLoop with
         | Some why -> Some why
         | None ->
           (match unless (not (shows_key s k)) KeyPresent with
            | Some why -> Some why
            | None ->
              if is_RT k.key_label
              then (match unless (not (is_root k.key_to)) IntoRoot with
                    | Some why -> Some why
                    | None ->
                      (match unless
                               (match parent_claim (eq_dec ordered_dot) to0
                                        s.seen_accepted k.key_to with
                                | Some _ -> false
                                | None -> true) HasParent with
                       | Some why -> Some why
                       | None ->
                         (match unless (seen_in_tree s k.key_from)
                                  ParentOutsideTree with
                          | Some why -> Some why
                          | None ->
                            unless
                              (not
                                (eqb0 ordered_dot
                                  (top (eq_dec ordered_dot) from to0
                                    s.seen_accepted k.key_from) k.key_to))
                              Cycle)))
              else unless
                     (implb (functional d k.key_label)
                       (not (shows_label s k.key_from k.key_label)))
                     FunctionalTaken)))))

(** val link_refusal :
    words -> sight -> dot -> name -> bool -> refusal0 option **)

let link_refusal w =
  let d = dictionary0 w in
  (fun s other l outgoing ->
  match label_refusal w l with
  | Some why -> Some why
  | None ->
    (match unless (in_graph s.seen_state other) UnknownVertex with
     | Some why -> Some why
     | None ->
       if is_RT l
       then if outgoing
            then let why =
                   if is_root other then IntoRoot else NewVertexAsParent
                 in
                 Some why
            else unless (seen_in_tree s other) ParentOutsideTree
       else unless
              (implb (( && ) (not outgoing) (functional d l))
                (not (shows_label s other l))) FunctionalTaken))

(** val vertex_refusal : words -> sight -> name -> name -> refusal0 option **)

let vertex_refusal w s type0 name0 =
  match unless (( && ) (name_fits type0) (name_fits name0)) NameLength with
  | Some why -> Some why
  | None ->
    (match unless (allows_type w type0) UndeclaredType with
     | Some why -> Some why
     | None ->
       (match unless (not (reserved name0)) ReservedName with
        | Some why -> Some why
        | None ->
          unless
            (match by_name s.seen_state name0 with
             | Some _ -> false
             | None -> true) NameTaken))

(** val update_refusal :
    words -> sight -> dot -> updates -> refusal0 option **)

let update_refusal w s target updates0 =
  match unless
          (( || ) (in_graph s.seen_state target)
            (existsb (fun c -> eqb0 ordered_dot (fst c) target)
              (seen_shown s))) UnknownTarget with
  | Some why -> Some why
  | None ->
    (match unless
             (match entries ordered_string updates0 with
              | [] -> false
              | _ :: _ -> true) NoUpdates with
     | Some why -> Some why
     | None ->
       (match unless
                (Number.at_most (count (entries ordered_string updates0))
                  attributes_max) TooMany with
        | Some why -> Some why
        | None ->
          first_of (fun e ->
            match snd e with
            | Some v -> attribute_refusal w (fst e) v
            | None ->
              unless
                (match attribute (allows w) s.seen_state target (fst e) with
                 | Some _ -> true
                 | None -> false) NotSet) (entries ordered_string updates0)))

(** val exhausted : exec -> plan -> refusal0 option **)

let exhausted _ p =
  match p.made with
  | [] -> None
  | _ :: _ ->
    (match unless
             (forallb (fun e -> Number.at_most (fst e).sequence sequence_max)
               p.made) (Exhausted Sequences) with
     | Some why -> Some why
     | None ->
       unless
         (forallb (fun e -> Number.at_most (stamp_of (snd e)) stamp_max)
           p.made) (Exhausted Stamps))

(** val strand_refusal : sight -> sight -> refusal0 option **)

let strand_refusal before after =
  unless
    (forallb (fun v ->
      implb (seen_stranded after v) (seen_stranded before v))
      after.seen_vertices) Strands

(** val attempt :
    words -> exec -> author -> mutation -> (refusal0, exec * exec) Either.t **)

let attempt w =
  let d = dictionary0 w in
  (fun s a m ->
  let s0 = sight0 w (shade s) in
  let p = x_plan d s a m in
  let d0 = x_delta_of p in
  let after = x_join s d0 in
  let within0 = fun why ->
    match why with
    | Some why0 -> Either.Left why0
    | None -> Either.Right (d0, after)
  in
  (match m with
   | AddVertex (type0, name0, _, attributes0, other, l, outgoing,
                link_attributes) ->
     within0
       (match vertex_refusal w s0 type0 name0 with
        | Some why -> Some why
        | None ->
          (match attributes_refusal w attributes0 with
           | Some why -> Some why
           | None ->
             (match attributes_refusal w link_attributes with
              | Some why -> Some why
              | None ->
                (match option_map (fun x -> Link x)
                         (link_refusal w s0 other l outgoing) with
                 | Some why -> Some why
                 | None -> exhausted s p))))
   | AddEdge (k, attributes0) ->
     within0
       (match edge_refusal w s0 k with
        | Some why -> Some why
        | None ->
          (match attributes_refusal w attributes0 with
           | Some why -> Some why
           | None -> exhausted s p))
   | UpdateAttributes (target, updates0) ->
     within0
       (match update_refusal w s0 target updates0 with
        | Some why -> Some why
        | None -> exhausted s p)
   | RemoveEdge k ->
     within0
       (match unless (shows_key s0 k) UnknownEdge with
        | Some why -> Some why
        | None -> strand_refusal s0 (sight0 w (shade after)))
   | MoveEdge (old, new0, attributes0) ->
     within0
       (match unless (shows_key s0 old) UnknownEdge with
        | Some why -> Some why
        | None ->
          (match unless
                   (not
                     (( && )
                       (( && ) (eqb0 ordered_dot old.key_from new0.key_from)
                         (eqb0 ordered_dot old.key_to new0.key_to))
                       (eqb0 ordered_string old.key_label new0.key_label)))
                   SameKey0 with
           | Some why -> Some why
           | None ->
             (match attributes_refusal w attributes0 with
              | Some why -> Some why
              | None ->
                (match exhausted s p with
                 | Some why -> Some why
                 | None ->
                   (match option_map (fun x -> OfEdge x)
                            (edge_refusal w
                              (sight0 w
                                (shade
                                  (x_join s
                                    (x_delta_of
                                      (x_plan d s a (RemoveEdge old))))))
                              new0) with
                    | Some why -> Some why
                    | None -> strand_refusal s0 (sight0 w (shade after)))))))
   | RemoveVertex v ->
     within0
       (match unless (not (is_root v)) RefusedRoot with
        | Some why -> Some why
        | None ->
          (match unless (in_graph s0.seen_state v) UnknownVertex with
           | Some why -> Some why
           | None -> strand_refusal s0 (sight0 w (shade after))))))

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

(** val first_fault : ('a1 -> fault option) -> 'a1 list -> fault option **)

let first_fault f l =
  fold_right (fun x rest ->
    match f x with
    | Some why -> Some why
    | None -> rest) None l

(** val sound_or : bool -> fault -> fault option **)

let sound_or holds why =
  if holds then None else Some why

(** val canonical_item : Number.t -> Number.t -> Number.t -> bool **)

let canonical_item infinity nan i =
  ( || ) (Number.equal i nan)
    (( && ) (Number.at_most i infinity)
      (Number.at_most (Number.subtract (Number.opposite infinity) Number.one)
        i))

(** val nans_canonical : value -> bool **)

let nans_canonical v =
  Number.on_natural
    (fun _ -> true)
    (fun p ->
    Number.on_positive
      (fun p0 ->
      Number.on_positive
        (fun p1 ->
        Number.on_positive
          (fun _ -> true)
          (fun p2 ->
          Number.on_positive
            (fun _ -> true)
            (fun _ -> true)
            (fun _ ->
            forallb
              (canonical_item (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double Number.one))))))))))))))))))))))))))))))
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double Number.one)))))))))))))))))))))))))))))))
              v.items)
            p2)
          (fun _ -> true)
          p1)
        (fun p1 ->
        Number.on_positive
          (fun p2 ->
          Number.on_positive
            (fun _ -> true)
            (fun _ -> true)
            (fun _ ->
            forallb
              (canonical_item (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double Number.one))))))))))))))))))))))))))))))
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double Number.one)))))))))))))))))))))))))))))))
              v.items)
            p2)
          (fun _ -> true)
          (fun _ -> true)
          p1)
        (fun _ ->
        forallb
          (canonical_item (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.next_double (Number.next_double (Number.next_double
            (Number.next_double (Number.next_double (Number.next_double
            (Number.next_double Number.one))))))))))))))))))))))))))))))
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.next_double
            (Number.next_double (Number.next_double (Number.next_double
            (Number.next_double (Number.next_double (Number.next_double
            (Number.next_double Number.one)))))))))))))))))))))))))))))))
          v.items)
        p0)
      (fun p0 ->
      Number.on_positive
        (fun p1 ->
        Number.on_positive
          (fun _ -> true)
          (fun p2 ->
          Number.on_positive
            (fun _ -> true)
            (fun _ -> true)
            (fun _ ->
            forallb
              (canonical_item (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double Number.one))))))))))))))))))))))))))))))
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double Number.one)))))))))))))))))))))))))))))))
              v.items)
            p2)
          (fun _ -> true)
          p1)
        (fun p1 ->
        Number.on_positive
          (fun p2 ->
          Number.on_positive
            (fun _ -> true)
            (fun _ -> true)
            (fun _ ->
            forallb
              (canonical_item (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double Number.one))))))))))))))))))))))))))))))
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double Number.one)))))))))))))))))))))))))))))))
              v.items)
            p2)
          (fun p2 ->
          Number.on_positive
            (fun _ -> true)
            (fun _ -> true)
            (fun _ ->
            forallb
              (canonical_item (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double
                Number.one))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double (Number.double
                (Number.double (Number.double (Number.double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double (Number.next_double
                (Number.next_double (Number.next_double
                Number.one)))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))
              v.items)
            p2)
          (fun _ -> true)
          p1)
        (fun _ ->
        forallb
          (canonical_item (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.next_double (Number.next_double (Number.next_double
            (Number.next_double (Number.next_double (Number.next_double
            (Number.next_double Number.one))))))))))))))))))))))))))))))
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.double (Number.double
            (Number.double (Number.double (Number.next_double
            (Number.next_double (Number.next_double (Number.next_double
            (Number.next_double (Number.next_double (Number.next_double
            (Number.next_double Number.one)))))))))))))))))))))))))))))))
          v.items)
        p0)
      (fun _ -> true)
      p)
    v.value_type

(** val anchor_fault : exec -> record -> dot -> fault option **)

let anchor_fault s x b =
  if is_root b
  then None
  else (match sound_or (not (Number.equal b.sequence Number.zero))
                NoSuchAnchor with
        | Some why -> Some why
        | None ->
          (match sound_or (not (x_dead s b)) NotClosed with
           | Some why -> Some why
           | None ->
             sound_or
               (match x_get s b with
                | Some y -> may_anchor x y
                | None -> true) WrongAnchor))

(** val record_fault : exec -> dot -> record -> fault option **)

let record_fault s d x =
  match sound_or (x_seen s d) HeldUnseen with
  | Some why -> Some why
  | None ->
    (match sound_or
             (( && ) (Number.at_most Number.one (stamp_of x))
               (Number.at_most (stamp_of x) stamp_max)) Stamp_ with
     | Some why -> Some why
     | None ->
       (match first_fault (anchor_fault s x) (anchors x) with
        | Some why -> Some why
        | None ->
          (match x with
           | Vertex (t, n0, _, _) ->
             sound_or (( && ) (name_fits t) (name_fits n0)) FaultNameLength
           | Edge (f, t, l, _) ->
             (match sound_or (not (eqb0 ordered_dot f t)) FaultSelfLoop with
              | Some why -> Some why
              | None ->
                (match sound_or (not (( && ) (is_RT l) (is_root t)))
                         FaultIntoRoot with
                 | Some why -> Some why
                 | None -> sound_or (name_fits l) FaultNameLength))
           | Write (_, n0, v, _, _) ->
             (match sound_or (value_fits v) FaultValueSize with
              | Some why -> Some why
              | None ->
                (match sound_or (nans_canonical v) Nan with
                 | Some why -> Some why
                 | None -> sound_or (name_fits n0) FaultNameLength)))))

(** val state_fault : exec -> fault option **)

let state_fault s =
  match sound_or
          (forallb (fun e ->
            forallb (fun i -> Number.at_most (snd i) sequence_max) (snd e))
            (entries ordered_replica s.form0)) Sequence_ with
  | Some why -> Some why
  | None ->
    first_fault (fun e -> record_fault s (fst e) (snd e))
      (entries ordered_dot s.held)
