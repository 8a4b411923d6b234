(* The orders of Coq's maps, by which lists of entries become such maps: they ascend. *)

open Kernel
module Z = Number.Z

(* Names are ordered by their bytes, as OCaml orders strings. *)
let by_name entries = List.sort (fun (left, _) (right, _) -> String.compare left right) entries

let compare_replicas left right =
  match Z.compare left.agent right.agent with 0 -> Z.compare left.incarnation right.incarnation | order -> order

let compare_dots left right =
  match compare_replicas left.replica0 right.replica0 with
  | 0 -> Z.compare left.sequence right.sequence
  | order -> order

let by_dot entries = List.sort (fun (left, _) (right, _) -> compare_dots left right) entries
let by_replica entries = List.sort (fun (left, _) (right, _) -> compare_replicas left right) entries
