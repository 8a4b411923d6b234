(* Dictionaries, mutations, records, states and digests as JSON (JSON-7 to JSON-13). *)

open Kernel
module Z = Number.Z

exception Refused of fault

(* ** Maps in canonical form: ascending lists of entries *)

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

(* ** Dictionaries *)

let dictionary json =
  let members = Json.members [ "closed"; "vertex_types"; "edge_labels"; "functional_labels"; "attributes" ] json in
  let get name read otherwise = Option.fold ~none:otherwise ~some:read (Json.optional name members) in
  let name text =
    let bytes = String.length text in
    if bytes = 0 || bytes > 255 then Json.unreadable "the name %S has %d bytes; allowed are 1 to 255" text bytes;
    text
  in
  let names json =
    let names = List.map (fun item -> name (Json.string item)) (Json.list json) in
    if List.compare_lengths (List.sort_uniq String.compare names) names <> 0 then
      Json.unreadable "a name stands twice";
    names
  in
  let attribute (n, kind) = (name n, Values.numbers.(Values.number_of_name (Json.string kind))) in
  let words =
    {
      closed_words = get "closed" Json.bool false;
      vertex_types = get "vertex_types" names [];
      edge_labels = get "edge_labels" names [];
      functional_labels = get "functional_labels" names [];
      attribute_types = get "attributes" (fun json -> List.map attribute (Json.entries json)) [];
    }
  in
  if List.mem "RT" words.functional_labels then Json.unreadable "\"RT\" is never functional";
  let is_known label = List.mem label words.edge_labels in
  if words.closed_words && not (List.for_all is_known words.functional_labels) then
    Json.unreadable "a functional label of a closed dictionary is not among its edge labels";
  words

let no_dictionary = dictionary (Json.Object [])

(* ** Mutations; how vertices and edges are named is another matter *)

type names = {
  vertex : string -> dot;
  edge : Json.t -> dot;
  bind : (string * Json.t) list -> unit;  (** what else stands in `add_vertex` *)
}

let attributes json = by_name (List.map (fun (name, value) -> (name, Values.of_json value)) (Json.entries json))

let attributes_of members =
  match Json.optional "attributes" members with None -> [] | Some json -> attributes json

let key_of names members =
  let vertex name = names.vertex (Json.string (Json.required name members)) in
  { key_from = vertex "from"; key_to = vertex "to"; key_label = Json.string (Json.required "label" members) }

let key names json = key_of names (Json.members [ "from"; "label"; "to" ] json)

let update = function
  | name, Json.Null -> (name, None)
  | name, value -> (name, Some (Values.of_json value))

(* With `extra`, the members that `add_vertex` may have beside those that say what it does. *)
let mutation ~extra names json =
  match Json.entries json with
  | [ ("add_vertex", json) ] ->
    let members = Json.members ([ "type"; "name"; "attributes"; "link" ] @ extra) json in
    let link = Json.members [ "from"; "label"; "to"; "attributes" ] (Json.required "link" members) in
    let other, outgoing =
      match (Json.optional "from" link, Json.optional "to" link) with
      | Some from, None -> (names.vertex (Json.string from), false)
      | None, Some target -> (names.vertex (Json.string target), true)
      | _ -> Json.unreadable "a link has either `from` or `to`"
    in
    let external_id = Option.map Values.wide (Json.optional "external_id" members) in
    let name member = Json.string (Json.required member members) in
    let made =
      AddVertex
        ( name "type", name "name", external_id, attributes_of members, other,
          Json.string (Json.required "label" link), outgoing, attributes_of link )
    in
    names.bind members;
    made
  | [ ("add_edge", json) ] ->
    let members = Json.members [ "from"; "label"; "to"; "attributes" ] json in
    AddEdge (key_of names members, attributes_of members)
  | [ ("update_attributes", json) ] ->
    let members = Json.members [ "vertex"; "edge"; "attributes" ] json in
    let updates = by_name (List.map update (Json.entries (Json.required "attributes" members))) in
    let target =
      match (Json.optional "vertex" members, Json.optional "edge" members) with
      | Some vertex, None -> names.vertex (Json.string vertex)
      | None, Some edge -> names.edge edge
      | _ -> Json.unreadable "update_attributes has either `vertex` or `edge`"
    in
    UpdateAttributes (target, updates)
  | [ ("remove_edge", json) ] -> RemoveEdge (key names json)
  | [ ("move_edge", json) ] ->
    let members = Json.members [ "old"; "new"; "attributes" ] json in
    MoveEdge
      ( key names (Json.required "old" members), key names (Json.required "new" members), attributes_of members )
  | [ ("remove_vertex", json) ] ->
    RemoveVertex (names.vertex (Json.string (Json.required "vertex" (Json.members [ "vertex" ] json))))
  | _ -> Json.unreadable "no mutation"

(* ** Sets of dots *)

let runs_text runs =
  let run (first, last) =
    if Z.equal first last then Z.to_string first else String.concat "-" [ Z.to_string first; Z.to_string last ]
  in
  String.concat "," (List.map run runs)

let form_json form = Json.Object (List.map (fun (replica, runs) -> (Ids.replica_text replica, Json.Text (runs_text runs))) form)

let runs text =
  let bad () = Json.unreadable "%S is not ascending, maximal runs such as \"1-5,7\"" text in
  let number text = match Ids.decimal text with Some number -> number | None -> bad () in
  let run least part =
    let first, last =
      match Ids.split '-' part with
      | None -> let only = number part in (only, only)
      | Some (first, last) ->
        let first = number first and last = number last in
        if Z.geq first last then bad ();
        (first, last)
    in
    if Z.lt first least then bad ();
    (Z.add last (Z.of_int 2), (first, last))
  in
  snd (List.fold_left_map run Z.one (String.split_on_char ',' text))

let form json =
  by_replica (List.map (fun (replica, text) -> (Ids.replica replica, runs (Json.string text))) (Json.entries json))

(* The most runs that do not begin at 1 (LIMIT-7), and records (LIMIT-8). *)
let cloud_runs_max = 1_048_576
let records_max = 16_777_216

let context json =
  let form = form json in
  let beyond = List.filter (fun (first, _) -> Z.gt first Z.one) (List.concat_map snd form) in
  let over (_, last) = Z.gt last sequence_max in
  if List.exists (fun (_, runs) -> List.exists over runs) form then
    Json.unreadable "a sequence is above the greatest, %s" (Z.to_string sequence_max);
  if List.compare_length_with beyond cloud_runs_max > 0 then Json.unreadable "too many runs stand beyond gaps";
  form

(* ** Records and states *)

(* An element or ROOT, as a record names it. *)
let anchor json =
  let dot = Ids.vertex (Json.string json) in
  if Z.sign dot.sequence = 0 && not (Json.string json = "root") then Json.unreadable "sequence 0 names no event";
  dot

let stamp members = Values.integer Z.zero Values.greatest64 (Json.required "stamp" members)

let record json =
  let text name members = Json.string (Json.required name members) in
  match Json.entries json with
  | [ ("vertex", json) ] ->
    let members = Json.members [ "type"; "name"; "external_id"; "stamp" ] json in
    Vertex
      ( text "type" members, text "name" members, Option.map Values.wide (Json.optional "external_id" members),
        stamp members )
  | [ ("edge", json) ] ->
    let members = Json.members [ "from"; "label"; "to"; "stamp" ] json in
    Edge
      ( anchor (Json.required "from" members), anchor (Json.required "to" members), text "label" members,
        stamp members )
  | [ ("write", json) ] ->
    let members = Json.members [ "target"; "name"; "value"; "timestamp_ns"; "stamp" ] json in
    let time = Option.fold ~none:Z.zero ~some:Values.wide (Json.optional "timestamp_ns" members) in
    Write
      ( anchor (Json.required "target" members), text "name" members, Values.of_json (Json.required "value" members),
        time, stamp members )
  | _ -> Json.unreadable "no record"

let record_json record =
  let text name = Json.Text name and number n = Json.Number (Z.to_string n) and dot d = Json.Text (Ids.dot_text d) in
  match record with
  | Vertex (kind, name, external_id, stamp) ->
    let id = Option.to_list (Option.map (fun id -> ("external_id", text (Z.to_string id))) external_id) in
    Json.Object
      [ ("vertex", Json.Object ([ ("type", text kind); ("name", text name) ] @ id @ [ ("stamp", number stamp) ])) ]
  | Edge (from, target, label, stamp) ->
    Json.Object
      [ ( "edge",
          Json.Object [ ("from", dot from); ("label", text label); ("to", dot target); ("stamp", number stamp) ] ) ]
  | Write (target, name, value, time, stamp) ->
    Json.Object
      [ ( "write",
          Json.Object
            [ ("target", dot target); ("name", text name); ("value", Values.to_json value);
              ("timestamp_ns", text (Z.to_string time)); ("stamp", number stamp) ] ) ]

(* A state, if it is well-formed. *)
let sound state = match state_fault state with None -> state | Some fault -> raise (Refused fault)

let state json =
  let members = Json.members [ "context"; "store" ] json in
  let form0 = context (Json.required "context" members) in
  let held = List.map (fun (dot, given) -> (Ids.dot dot, record given)) (Json.entries (Json.required "store" members)) in
  if List.compare_length_with held records_max > 0 then Json.unreadable "too many records stand";
  sound { held = by_dot held; form0 }

let state_json state =
  let record (dot, record) = (Ids.dot_text dot, record_json record) in
  Json.Object [ ("context", form_json state.form0); ("store", Json.Object (List.map record state.held)) ]

let digest_json digest =
  Json.Object [ ("context", form_json digest.x_context); ("live", form_json digest.x_live) ]

(* ** Names of errors and faults *)

let rec refusal_name = function
  | NameLength -> "NameLength"
  | UndeclaredType -> "UndeclaredType"
  | ReservedName -> "ReservedName"
  | NameTaken -> "NameTaken"
  | LabelLength -> "LabelLength"
  | UndeclaredLabel -> "UndeclaredLabel"
  | UnknownVertex -> "UnknownVertex"
  | SelfLoop -> "SelfLoop"
  | KeyPresent -> "KeyPresent"
  | FunctionalTaken -> "FunctionalTaken"
  | IntoRoot -> "IntoRoot"
  | HasParent -> "HasParent"
  | ParentOutsideTree -> "ParentOutsideTree"
  | NewVertexAsParent -> "NewVertexAsParent"
  | Cycle -> "Cycle"
  | TooMany -> "TooMany"
  | UndeclaredName -> "Undeclared"
  | WrongType -> "WrongType"
  | ValueSize -> "ValueSize"
  | UnknownTarget -> "UnknownTarget"
  | NoUpdates -> "Empty"
  | NotSet -> "NotSet"
  | UnknownEdge -> "UnknownEdge"
  | SameKey0 -> "SameKey"
  | RefusedRoot -> "Root"
  | Strands -> "Strands"
  | Sequences -> "Sequences"
  | Stamps -> "Stamps"
  | Link why -> "Link." ^ refusal_name why
  | OfEdge why -> "Edge." ^ refusal_name why
  | OfAttribute why -> "Attribute." ^ refusal_name why
  | Exhausted why -> "Exhausted." ^ refusal_name why

let fault_name = function
  | Sequence_ -> "Sequence"
  | HeldUnseen -> "HeldUnseen"
  | NotClosed -> "NotClosed"
  | WrongAnchor -> "WrongAnchor"
  | NoSuchAnchor -> "NoSuchAnchor"
  | FaultSelfLoop -> "SelfLoop"
  | FaultIntoRoot -> "IntoRoot"
  | FaultNameLength -> "NameLength"
  | FaultValueSize -> "ValueSize"
  | Stamp_ -> "Stamp"
  | Nan -> "Nan"
