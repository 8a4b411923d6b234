(* Dictionaries as JSON (JSON-7). *)

open Kernel
module Z = Number.Z

let read json =
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

(* Everything is allowed, and no label functional. *)
let none = read (Json.Object [])
