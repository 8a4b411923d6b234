(* Sets of dots as JSON, and contexts within their limits (JSON-11). *)

open Kernel
module Z = Number.Z

let runs_text runs =
  let run (first, last) =
    if Z.equal first last then Z.to_string first else String.concat "-" [ Z.to_string first; Z.to_string last ]
  in
  String.concat "," (List.map run runs)

let to_json form = Json.Object (List.map (fun (replica, runs) -> (Ids.replica_text replica, Json.Text (runs_text runs))) form)

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

let read json =
  Order.by_replica (List.map (fun (replica, text) -> (Ids.replica replica, runs (Json.string text))) (Json.entries json))

(* The most runs that do not begin at 1 (LIMIT-7), and records (LIMIT-8). *)
let cloud_runs_max = 1_048_576
let records_max = 16_777_216

let context json =
  let form = read json in
  let beyond = List.filter (fun (first, _) -> Z.gt first Z.one) (List.concat_map snd form) in
  let over (_, last) = Z.gt last sequence_max in
  if List.exists (fun (_, runs) -> List.exists over runs) form then
    Json.unreadable "a sequence is above the greatest, %s" (Z.to_string sequence_max);
  if List.compare_length_with beyond cloud_runs_max > 0 then Json.unreadable "too many runs stand beyond gaps";
  form
