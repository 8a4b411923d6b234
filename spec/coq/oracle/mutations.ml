(* Mutations as JSON (JSON-9, CONF-6); how vertices and edges are named is another matter. *)

open Kernel
module Z = Number.Z

type names = {
  vertex : string -> dot;
  edge : Json.t -> dot;
  target : is_edge:bool -> dot -> dot;  (** whether it is of the kind that it is named as *)
  bind : (string * Json.t) list -> unit;  (** what else stands in `add_vertex` *)
}

let attributes json = Order.by_name (List.map (fun (name, value) -> (name, Values.of_json value)) (Json.entries json))

let attributes_of members =
  match Json.optional "attributes" members with None -> [] | Some json -> attributes json

let key_of find members =
  let vertex name = find (Json.string (Json.required name members)) in
  { key_from = vertex "from"; key_to = vertex "to"; key_label = Json.string (Json.required "label" members) }

let key find json = key_of find (Json.members [ "from"; "label"; "to" ] json)

let update = function
  | name, Json.Null -> (name, None)
  | name, value -> (name, Some (Values.of_json value))

(* With `extra`, the members that `add_vertex` may have beside those that say what it does. *)
let read ~extra names json =
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
    AddEdge (key_of names.vertex members, attributes_of members)
  | [ ("update_attributes", json) ] ->
    let members = Json.members [ "vertex"; "edge"; "attributes" ] json in
    let updates = Order.by_name (List.map update (Json.entries (Json.required "attributes" members))) in
    let target =
      match (Json.optional "vertex" members, Json.optional "edge" members) with
      | Some vertex, None -> names.target ~is_edge:false (names.vertex (Json.string vertex))
      | None, Some edge -> names.target ~is_edge:true (names.edge edge)
      | _ -> Json.unreadable "update_attributes has either `vertex` or `edge`"
    in
    UpdateAttributes (target, updates)
  | [ ("remove_edge", json) ] -> RemoveEdge (key names.vertex json)
  | [ ("move_edge", json) ] ->
    let members = Json.members [ "old"; "new"; "attributes" ] json in
    MoveEdge
      ( key names.vertex (Json.required "old" members), key names.vertex (Json.required "new" members), attributes_of members )
  | [ ("remove_vertex", json) ] ->
    RemoveVertex (names.vertex (Json.string (Json.required "vertex" (Json.members [ "vertex" ] json))))
  | _ -> Json.unreadable "no mutation"
