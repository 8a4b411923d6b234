(* What a state shows: as text, for facts, and by handles, as the protocol has it (CONF-7). *)

open Kernel

let repair_text repair =
  let list items = Json.List (List.map (fun item -> Json.Text item) items) in
  let dot = Ids.dot_text in
  let shown =
    match repair with
    | Superseded (hidden, shown, SameKey) -> list [ "same-key"; dot hidden; dot shown ]
    | Superseded (hidden, shown, Functional) -> list [ "functional"; dot hidden; dot shown ]
    | Superseded (hidden, shown, RtParent) -> list [ "rt-parent"; dot hidden; dot shown ]
    | CycleBroken hidden -> list [ "cycle-broken"; dot hidden ]
    | Detached vertex -> list [ "detached"; dot vertex ]
    | Reattached vertex -> list [ "reattached"; dot vertex ]
    | NameClash (_, shown, hidden) -> list [ "name-clash"; dot shown; dot hidden ]
    | Undeclared write -> list [ "undeclared"; dot write ]
  in
  let buffer = Buffer.create 64 in
  Json.write buffer shown;
  Buffer.contents buffer

(* The writes of each attribute that are looked for, by target and name, the greatest first. *)
let registers words state =
  let place (dot, record) =
    match record with Write (target, name, _, _, stamp) -> (target, name, (stamp, dot)) | _ -> (rOOT, "", (Number.zero, dot))
  in
  let order left right =
    let target, name, (stamp, dot) = place left and target', name', (stamp', dot') = place right in
    match Order.compare_dots target target' with
    | 0 -> (
      match String.compare name name' with
      | 0 -> (
        match Number.Z.compare stamp' stamp with 0 -> Order.compare_dots dot' dot | order -> order)
      | order -> order)
    | order -> order
  in
  let is_one left right =
    let target, name, _ = place left and target', name', _ = place right in
    Order.compare_dots target target' = 0 && String.equal name name'
  in
  let group write = function
    | (other :: _ as register) :: registers when is_one write other -> (write :: register) :: registers
    | registers -> [ write ] :: registers
  in
  List.fold_right group (List.sort order (shown_writes (allows words) state)) []

let dots_json writes = Json.List (List.map (fun (dot, _) -> Json.Text (Ids.dot_text dot)) writes)

(* The view as one line. *)
let text words state =
  let shade = shade state in
  let sight = sight0 words shade in
  let dot d = Json.Text (Ids.dot_text d) in
  let vertex id =
    let place =
      match seen_placement sight id with
      | Root -> Json.Text "root"
      | Child (parent, edge) -> Json.List [ dot parent; dot edge ]
      | DetachedTop -> Json.Text "detached"
      | Outside -> Json.Text "outside"
    in
    let found =
      match Option.map (by_name shade) (name_of shade id) with
      | Some (Some found) -> dot found
      | Some None | None -> Json.Null
    in
    Json.List [ dot id; place; Json.Bool (seen_stranded sight id); found ]
  in
  let edges = List.sort Order.compare_dots (List.map fst (seen_shown sight)) in
  let buffer = Buffer.create 1024 in
  Json.write buffer
    (Json.Object
       [ ("vertices", Json.List (List.map vertex sight.seen_vertices));
         ("edges", Json.List (List.map dot edges));
         ("writes", Json.List (List.map dots_json (registers words shade))) ]);
  Buffer.truncate buffer (Buffer.length buffer - 1);
  let repairs = List.sort String.compare (List.map repair_text (seen_repairs words sight)) in
  Printf.bprintf buffer ",\"repairs\":[%s]}" (String.concat "," repairs);
  Buffer.contents buffer

let repair_kind = function
  | Superseded (_, _, SameKey) -> "same-key"
  | Superseded (_, _, Functional) -> "functional"
  | Superseded (_, _, RtParent) -> "rt-parent"
  | CycleBroken _ -> "cycle-broken"
  | Detached _ -> "detached"
  | Reattached _ -> "reattached"
  | NameClash _ -> "name-clash"
  | Undeclared _ -> "undeclared"

(* The view, with the names that `handle` gives vertices. *)
let json handle words state =
  let shade = shade state in
  let sight = sight0 words shade in
  let winner = function
    | (_, Write (target, name, value, _, _)) :: _ -> Some (target, (name, Values.to_json value))
    | _ -> None
  in
  let winners = List.filter_map winner (registers words shade) in
  let attributes id =
    match List.filter (fun (target, _) -> Order.compare_dots target id = 0) winners with
    | [] -> []
    | own -> [ ("attributes", Json.Object (List.map snd own)) ]
  in
  let text t = Json.Text t in
  let vertex id =
    match get shade id with
    | Some (Vertex (kind, name, _, _)) ->
      Some (handle id, Json.Object ([ ("type", text kind); ("name", text name) ] @ attributes id))
    | _ -> None
  in
  let edge (id, record) =
    match record with
    | Edge (from, target, label, _) ->
      Some
        (Json.Object
           ([ ("from", text (handle from)); ("label", text label); ("to", text (handle target)) ] @ attributes id))
    | _ -> None
  in
  let repairs = seen_repairs words sight in
  let hung = function Detached vertex | Reattached vertex -> Some (text (handle vertex)) | _ -> None in
  Json.Object
    [ ("vertices", Json.Object (List.filter_map vertex sight.seen_vertices));
      ("edges", Json.List (List.filter_map edge (seen_shown sight)));
      ("root", Json.Object (attributes rOOT));
      ("hung", Json.List (List.filter_map hung repairs));
      ("repairs", Json.List (List.map (fun repair -> text (repair_kind repair)) repairs)) ]
