(* A server of facts (ORACLE-1): each line is a question about states, and is answered by one line. *)

open Kernel
module Z = Number.Z

let words = ref Dictionary.none

(* A target is not of the kind that it is named as: in the model, where elements are dots, that cannot be said. *)
exception Other_kind

(* How questions name vertices and edges: by their dots. *)
let names state =
  let target ~is_edge dot = if in_graph (shade state) dot = is_edge then raise Other_kind else dot in
  { Mutations.vertex = Ids.vertex; edge = (fun json -> Ids.dot (Json.string json)); target; bind = ignore }

let author text =
  match Ids.split '@' text with
  | Some (replica, time) -> (
    match Ids.decimal time with
    | Some time_ns -> { me = Ids.replica replica; time_ns }
    | None -> Json.unreadable "%S is no time" time)
  | None -> Json.unreadable "%S is no author such as r1@17" text

let state hex = Codec.state (Codec.of_hex hex)
let hex state = Codec.hex (Codec.state_bytes state)

(* The word that a line begins with, and the rest. *)
let word line = match Ids.split ' ' line with Some parts -> parts | None -> (line, "")

let answer line =
  let question, rest = word line in
  match question with
  | "dictionary" ->
    words := Dictionary.read (Json.read rest);
    "ok"
  | "join" -> (
    match List.map state (String.split_on_char ' ' rest) with
    | first :: others -> hex (List.fold_left x_join first others)
    | [] -> Json.unreadable "states are due")
  | "delta" -> (
    let who, rest = word rest in
    let before, mutation = word rest in
    let before = state before in
    match
      let mutation = Mutations.read ~extra:[ "external_id" ] (names before) (Json.read mutation) in
      attempt !words before (author who) mutation
    with
    | exception Other_kind -> "refused " ^ Errors.refusal UnknownTarget
    | Either.Left why -> "refused " ^ Errors.refusal why
    | Either.Right (delta, after) -> String.concat " " [ "made"; hex delta; hex after ])
  | "view" -> Seen.text !words (state rest)
  | "digest" ->
    let digest = x_digest (state rest) in
    String.concat " " [ Codec.hex (Codec.digest_bytes digest); Codec.hex (Fingerprint.of_digest digest) ]
  | "answer" ->
    let ours, theirs = word rest in
    hex (x_delta_for (state ours) (Codec.digest (Codec.of_hex theirs)))
  | "accepts" -> (
    match Codec.state (Codec.of_hex rest) with
    | _ -> "yes"
    | exception (Codec.Undecodable _ | States.Unsound _) -> "no")
  | _ -> Json.unreadable "%S is no question" question

let reply line =
  match answer line with
  | answer -> answer
  | exception Json.Unreadable why -> "error " ^ why
  | exception Codec.Undecodable why -> "error no state: " ^ why
  | exception States.Unsound fault -> "error no well-formed state: " ^ Errors.fault fault
