(* Records, states and digests as JSON (JSON-10, JSON-12, JSON-13). *)

open Kernel
module Z = Number.Z

(* A state is not well-formed. *)
exception Unsound of fault

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
let sound state = match state_fault state with None -> state | Some fault -> raise (Unsound fault)

let read json =
  let members = Json.members [ "context"; "store" ] json in
  let form0 = Dots.context (Json.required "context" members) in
  let held = List.map (fun (dot, given) -> (Ids.dot dot, record given)) (Json.entries (Json.required "store" members)) in
  if List.compare_length_with held Dots.records_max > 0 then Json.unreadable "too many records stand";
  sound { held = Order.by_dot held; form0 }

let to_json state =
  let record (dot, record) = (Ids.dot_text dot, record_json record) in
  Json.Object [ ("context", Dots.to_json state.form0); ("store", Json.Object (List.map record state.held)) ]

let digest_json digest =
  Json.Object [ ("context", Dots.to_json digest.x_context); ("live", Dots.to_json digest.x_live) ]
