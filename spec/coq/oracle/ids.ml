(* Replicas and dots as texts (JSON-3). *)

open Kernel
module Z = Number.Z

let sequence_of = Z.of_string

(* A decimal of at most 64 bits that has no leading zero; fewer bits, if so asked. *)
let decimal ?(bits = 64) text =
  let is_digit = function '0' .. '9' -> true | _ -> false in
  let rec all at = at >= String.length text || (is_digit text.[at] && all (at + 1)) in
  if text = "" || (text.[0] = '0' && text <> "0") || String.length text > 20 || not (all 0) then None
  else
    let number = if String.length text < 18 then Z.of_int (int_of_string text) else sequence_of text in
    if Z.numbits number <= bits then Some number else None

let split char text =
  Option.map
    (fun at -> (String.sub text 0 at, String.sub text (at + 1) (String.length text - at - 1)))
    (String.index_opt text char)

let replica_opt text =
  if text = "" || text.[0] <> 'r' then None
  else
    let rest = String.sub text 1 (String.length text - 1) in
    match split '+' rest with
    | None -> Option.map (fun agent -> { agent; incarnation = Z.zero }) (decimal ~bits:32 rest)
    | Some (agent, later) -> (
      match (decimal ~bits:32 agent, decimal ~bits:32 later) with
      | Some agent, Some incarnation when Z.sign incarnation > 0 -> Some { agent; incarnation }
      | _ -> None)

let replica text =
  match replica_opt text with Some replica -> replica | None -> Json.unreadable "%S is no replica" text

let dot_opt text =
  match split '.' text with
  | None -> None
  | Some (replica, sequence) -> (
    match (replica_opt replica, decimal sequence) with
    | Some replica0, Some sequence -> Some { replica0; sequence }
    | _ -> None)

let dot text = match dot_opt text with Some dot -> dot | None -> Json.unreadable "%S is no dot" text
let vertex text = if text = "root" then rOOT else dot text

let replica_text { agent; incarnation } =
  if Z.sign incarnation = 0 then "r" ^ Z.to_string agent
  else String.concat "" [ "r"; Z.to_string agent; "+"; Z.to_string incarnation ]

let dot_text dot =
  if is_root dot then "root" else String.concat "." [ replica_text dot.replica0; Z.to_string dot.sequence ]
