(* The adapter of the conformance protocol (CONF-1 to CONF-8), with all profiles and features. *)

open Kernel
module Z = Number.Z

(* What is replied in the place of `ok`. *)
exception Decline of { code : string; message : string; kind : string option }

let decline ?kind code format = Printf.ksprintf (fun message -> raise (Decline { code; message; kind })) format
let rejected format = decline "rejected_input" format

type replica = { place : int; mutable incarnation : Z.t; mutable state : exec }

type case = {
  words : words;
  replicas : (string, replica) Hashtbl.t;
  mutable ids : (string * dot) list;  (** of handles *)
  mutable deltas : exec list;  (** the newest first *)
}

let replicas_max = 64
let no_case () = { words = Dictionary.none; replicas = Hashtbl.create 8; ids = []; deltas = [] }
let case = ref (no_case ())

let replica name =
  match Hashtbl.find_opt !case.replicas name with
  | Some replica -> replica
  | None -> decline "unknown" "no replica %S in this case" name

let keep delta =
  !case.deltas <- delta :: !case.deltas;
  Json.Object [ ("delta", Json.Text (Printf.sprintf "d%d" (List.length !case.deltas))) ]

let delta name =
  let count = List.length !case.deltas in
  let number =
    if name <> "" && name.[0] = 'd' then Ids.decimal (String.sub name 1 (String.length name - 1)) else None
  in
  match number with
  | Some number when Z.sign number > 0 && Z.leq number (Z.of_int count) ->
    List.nth !case.deltas (count - Z.to_int number)
  | _ -> decline "unknown" "no delta %S in this case" name

(* ** Handles [CONF-5] *)

let handle_of ids id =
  if is_root id then "root"
  else
    match List.find_opt (fun (_, known) -> Order.compare_dots known id = 0) ids with
    | Some (handle, _) -> handle
    | None -> Ids.dot_text id

let vertex_of ids handle =
  if handle = "root" then rOOT
  else
    match List.assoc_opt handle ids with
    | Some id -> id
    | None -> decline "unknown" "no vertex has the handle %S" handle

(* ** Mutations [CONF-6] *)

let author replica =
  { me = { agent = Z.of_int (replica.place + 1); incarnation = replica.incarnation }; time_ns = Z.zero }

let shown_edge state (key : key) =
  let sight = sight0 !case.words (shade state) in
  List.find_opt (has_key key) (seen_shown sight)

(* One mutation of a group: the state after it, the handles, the delta. *)
let mutate_once author (state, ids, whole) json =
  let ids = ref ids in
  let vertex handle = vertex_of !ids handle in
  let edge json =
    match shown_edge state (Mutations.key vertex json) with
    | Some (id, _) -> id
    | None -> decline ~kind:"UnknownTarget" "refused" "no such edge is shown"
  in
  (* Handles name vertices, and an edge's name an edge. *)
  let target ~is_edge:_ dot = dot in
  let bind members =
    let handle = Json.string (Json.required "as" members) in
    if handle = "root" || List.mem_assoc handle !ids then rejected "the handle %S names a vertex already" handle;
    let id = { replica0 = author.me; sequence = Z.succ (x_greatest state author.me) } in
    ids := (handle, id) :: !ids
  in
  let mutation = Mutations.read ~extra:[ "as" ] { Mutations.vertex; edge; target; bind } json in
  match attempt !case.words state author mutation with
  | Either.Left why ->
    let kind = Errors.refusal why in
    decline ~kind "refused" "%s" kind
  | Either.Right (delta, after) -> (after, !ids, x_join whole delta)

(* ** Commands [CONF-4] *)

let text name members = Json.string (Json.required name members)
let no_members = Json.Object []

let hello members =
  let protocols = List.map (Values.integer Z.zero (Z.of_int 0xffffffff)) (Json.list (Json.required "protocols" members)) in
  ignore (text "spec" members);
  ignore (text "corpus" members);
  if not (List.exists (Z.equal Z.one) protocols) then decline "unsupported" "this adapter speaks protocol 1";
  let texts names = Json.List (List.map (fun name -> Json.Text name) names) in
  Json.Object
    [ ("protocol", Json.Number "1");
      ( "implementation",
        Json.Object
          [ ("name", Json.Text "dsr-oracle"); ("version", Json.Text "0.1.0"); ("language", Json.Text "OCaml");
            ("source", Json.Text "spec/coq") ] );
      ("profiles", texts [ "observe"; "causal"; "wire" ]);
      ( "features",
        texts
          [ "dictionary"; "error-kinds"; "grouping"; "lookup"; "repairs"; "restart"; "resynchronisation" ] );
      ( "limits",
        Json.Object [ ("line_bytes", Json.Number "1048576"); ("replicas", Json.Number (string_of_int replicas_max)) ] ) ]

let begin_ members =
  ignore (text "case" members);
  let names = List.map Json.string (Json.list (Json.required "replicas" members)) in
  let words = Option.fold ~none:Dictionary.none ~some:Dictionary.read (Json.optional "dictionary" members) in
  let begun = { (no_case ()) with words } in
  if List.compare_length_with names replicas_max > 0 then rejected "over %d replicas" replicas_max;
  let add place name =
    if Hashtbl.mem begun.replicas name then rejected "two replicas %S" name;
    Hashtbl.add begun.replicas name { place; incarnation = Z.zero; state = x_bottom }
  in
  List.iteri add names;
  case := begun;
  no_members

let mutate members =
  let replica = replica (text "replica" members) in
  let group = Json.list (Json.required "mutations" members) in
  let state, ids, whole = List.fold_left (mutate_once (author replica)) (replica.state, !case.ids, x_bottom) group in
  replica.state <- state;
  !case.ids <- ids;
  keep whole

let deliver members =
  let replica = replica (text "replica" members) in
  replica.state <- x_join replica.state (delta (text "delta" members));
  no_members

let read members =
  let replica = replica (text "replica" members) in
  Json.Object [ ("view", Seen.json (handle_of !case.ids) !case.words replica.state) ]

let group members =
  let deltas = List.map (fun name -> delta (Json.string name)) (Json.list (Json.required "deltas" members)) in
  keep (List.fold_left x_join x_bottom deltas)

let lookup members =
  let replica = replica (text "replica" members) in
  let found = by_name (shade replica.state) (text "name" members) in
  Json.Object
    [ ("vertex", Option.fold ~none:Json.Null ~some:(fun id -> Json.Text (handle_of !case.ids id)) found) ]

let restart members =
  let replica = replica (text "replica" members) in
  let keeps = Json.bool (Json.required "keeps" members) in
  let next = Z.succ replica.incarnation in
  if Z.numbits next > 32 then decline "refused" "the incarnations are used up";
  replica.incarnation <- next;
  if not keeps then replica.state <- x_bottom;
  no_members

let resynchronise members =
  let ours = replica (text "from" members) and theirs = replica (text "to" members) in
  keep (x_delta_for ours.state (x_digest theirs.state))

let shown name json = Json.Object [ (name, json) ]
let bytes found = shown "bytes" (Json.Text (Codec.hex found))
let state_of members = (replica (text "replica" members)).state

(* What comes from outside, or why it is refused (CONF-8). *)
let from_outside read =
  match read () with
  | found -> found
  | exception Json.Unreadable why -> decline "refused" "%s" why
  | exception Codec.Undecodable why -> decline "refused" "%s" why
  | exception States.Unsound fault ->
    let kind = Errors.fault fault in
    decline ~kind "refused" "%s" kind

let commands =
  [
    ("hello", ([ "protocols"; "spec"; "corpus" ], hello));
    ("case_begin", ([ "case"; "replicas"; "dictionary" ], begin_));
    ("mutate", ([ "replica"; "mutations" ], mutate));
    ("deliver", ([ "replica"; "delta" ], deliver));
    ("read", ([ "replica" ], read));
    ("group", ([ "deltas" ], group));
    ("lookup", ([ "replica"; "name" ], lookup));
    ("restart", ([ "replica"; "keeps" ], restart));
    ("answer", ([ "from"; "to" ], resynchronise));
    ("state", ([ "replica" ], fun members -> shown "state" (States.to_json (state_of members))));
    ("delta", ([ "delta" ], fun members -> shown "state" (States.to_json (delta (text "delta" members)))));
    ("digest", ([ "replica" ], fun members -> shown "digest" (States.digest_json (x_digest (state_of members)))));
    ( "load",
      ( [ "state" ],
        fun members ->
          let given = Json.required "state" members in
          keep (from_outside (fun () -> States.read given)) ) );
    ("encode", ([ "delta" ], fun members -> bytes (Codec.state_bytes (delta (text "delta" members)))));
    ( "encode_digest",
      ([ "replica" ], fun members -> bytes (Codec.digest_bytes (x_digest (state_of members)))) );
    ( "fingerprint",
      ([ "replica" ], fun members -> bytes (Fingerprint.of_digest (x_digest (state_of members)))) );
    ( "decode",
      ( [ "bytes" ],
        fun members ->
          let given = Codec.of_hex (text "bytes" members) in
          keep (from_outside (fun () -> Codec.state given)) ) );
    ( "answer_digest",
      ( [ "from"; "bytes" ],
        fun members ->
          let ours = (replica (text "from" members)).state in
          let given = Codec.of_hex (text "bytes" members) in
          keep (x_delta_for ours (from_outside (fun () -> Codec.digest given))) ) );
  ]

let answer json =
  match Json.entries json with
  | [ (command, arguments) ] -> (
    match List.assoc_opt command commands with
    | Some (allowed, run) -> run (Json.members allowed arguments)
    | None -> rejected "no command %S" command)
  | _ -> rejected "one command is due"

(* The number of a request, if it can be read at all. *)
let id_of json =
  match json with
  | Json.Object members -> (
    match Json.optional "id" members with
    | Some (Json.Number spelling as number)
      when Values.is_whole spelling && spelling.[0] <> '-' && Z.numbits (Z.of_string spelling) <= 64 ->
      number
    | _ -> Json.unreadable "a request has an id from 0 to 2^64 - 1")
  | _ -> Json.unreadable "a request is an object"

let reply line =
  let json = Json.read line in
  let id = id_of json in
  let error code message kind =
    let kind = Option.to_list (Option.map (fun kind -> ("kind", Json.Text kind)) kind) in
    ("error", Json.Object ([ ("code", Json.Text code); ("message", Json.Text message) ] @ kind))
  in
  let what =
    match answer (Json.required "do" (Json.members [ "id"; "do" ] json)) with
    | ok -> ("ok", ok)
    | exception Decline { code; message; kind } -> error code message kind
    | exception Json.Unreadable why -> error "rejected_input" why None
  in
  let buffer = Buffer.create 1024 in
  Json.write buffer (Json.Object [ ("id", id); what ]);
  Buffer.contents buffer
