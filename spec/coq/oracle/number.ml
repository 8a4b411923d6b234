(* Natural numbers and integers, as the extracted program has them. *)

module Z = Z

type t = Z.t

(* Whether a number is kept as a machine's integer, as nearly all are: Zarith keeps two equal ones the same way. *)
let is_small (x : t) = Obj.is_int (Obj.repr x)

let zero = Z.zero
let one = Z.one
let double p = Z.shift_left p 1
let next_double p = Z.succ (double p)
let opposite = Z.neg
let add = Z.add
let subtract = Z.sub
let multiply = Z.mul

(* Of natural numbers: 0 where the second is greater. *)
let less x y = if Z.lt x y then Z.zero else Z.sub x y
let min = Z.min
let max = Z.max
let equal (x : t) (y : t) = x == y || ((not (is_small x && is_small y)) && Z.equal x y)
let below (x : t) (y : t) = if is_small x && is_small y then (Obj.magic x : int) < Obj.magic y else Z.lt x y
let at_most x y = not (below y x)

let on_positive odd even one p =
  if Z.equal p Z.one then one ()
  else if Z.testbit p 0 then odd (Z.shift_right p 1)
  else even (Z.shift_right p 1)

let on_natural zero positive n = if Z.sign n = 0 then zero () else positive n

let on_integer zero positive negative z =
  let sign = Z.sign z in
  if sign = 0 then zero () else if sign > 0 then positive z else negative (Z.neg z)

let on_count zero next n = if n = 0 then zero () else next (n - 1)
let bytes text = List.init (String.length text) (fun at -> Z.of_int (Char.code text.[at]))
