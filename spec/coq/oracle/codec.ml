(* The binary encoding of states and digests (ENC-1 to ENC-12). *)

open Kernel
module Z = Number.Z

exception Undecodable of string

let undecodable format = Printf.ksprintf (fun why -> raise (Undecodable why)) format

let version = 2

(* The static table (ENC-12). *)
let vocabulary =
  [|
    "RT"; "agent"; "agent_description"; "agent_id"; "agent_name"; "battery_load"; "cam_depth"; "cam_rgb";
    "color"; "cpu_usage"; "depth"; "door"; "finished"; "has"; "height"; "in"; "is_performing"; "laser";
    "laser_angles"; "laser_dists"; "level"; "mass"; "memory_usage"; "mesh"; "name"; "num_procs"; "object";
    "omnirobot"; "parent"; "path"; "person"; "plane"; "pos_x"; "pos_y"; "priority"; "rgbd"; "robot";
    "robot_current_advance_speed"; "robot_current_angular_speed"; "robot_current_side_speed";
    "robot_local_angular_velocity"; "robot_local_linear_velocity"; "robot_ref_adv_speed";
    "robot_ref_rot_speed"; "robot_ref_side_speed"; "room"; "rt_quaternion"; "rt_rotation_euler_xyz";
    "rt_rotation_euler_xyz_velocity"; "rt_se2_covariance"; "rt_timestamps"; "rt_translation";
    "rt_translation_velocity"; "scalex"; "scaley"; "scalez"; "source"; "texture"; "timestamp_agent";
    "timestamp_alivetime"; "timestamp_creation"; "transform"; "wants_to"; "width";
  |]

let places =
  let places = Hashtbl.create 128 in
  Array.iteri (fun place name -> Hashtbl.add places name place) vocabulary;
  places

(* A signed integer as an unsigned one, and back (ENC-3). *)
let fold number =
  let twice = Z.shift_left number 1 in
  if Z.sign number >= 0 then twice else Z.pred (Z.neg twice)

let unfold folded =
  let half = Z.shift_right folded 1 in
  if Z.is_odd folded then Z.pred (Z.neg half) else half

(* ** Writing *)

let low_seven = Z.of_int 0x7f

let rec write_varint buffer number =
  if Z.fits_int number then write_small buffer (Z.to_int number)
  else begin
    Buffer.add_char buffer (Char.chr (Z.to_int (Z.logand number low_seven) lor 0x80));
    write_varint buffer (Z.shift_right number 7)
  end

and write_small buffer number =
  if number < 0x80 then Buffer.add_char buffer (Char.unsafe_chr number)
  else begin
    Buffer.add_char buffer (Char.unsafe_chr (number land 0x7f lor 0x80));
    write_small buffer (number lsr 7)
  end

let write_bytes buffer bytes =
  write_small buffer (String.length bytes);
  Buffer.add_string buffer bytes

(* What differs from the number before, whose place it takes. *)
let write_difference buffer before number =
  write_varint buffer (fold (Z.signed_extract (Z.sub number !before) 0 64));
  before := number

let write_runs buffer replicas form =
  let run least (first, last) =
    write_varint buffer (Z.sub first least);
    write_varint buffer (Z.sub last first);
    Z.add last (Z.of_int 2)
  in
  let runs replica =
    let runs = runs_of form replica in
    write_small buffer (List.length runs);
    ignore (List.fold_left run Z.one runs)
  in
  List.iter runs replicas

let names_of = function
  | Vertex (kind, name, _, _) -> [ kind; name ]
  | Edge (_, _, label, _) -> [ label ]
  | Write (_, name, _, _, _) -> [ name ]

let index equal item table =
  let rec from at = function
    | [] -> invalid_arg "what is written is in its table"
    | known :: rest -> if equal known item then at else from (at + 1) rest
  in
  from 0 table

let same_replica left right = Order.compare_replicas left right = 0

let write_value buffer value =
  let words bits = List.iter bits value.items in
  match (Values.kind_of value, value.items) with
  | (String | Byte_vec), items -> write_bytes buffer (Values.bytes_of_items items)
  | Int, [ item ] ->
    write_varint buffer (fold item)
  | (Uint | Uint64 | Bool), [ item ] -> write_varint buffer item
  | Double, _ -> words (fun item -> Buffer.add_int64_le buffer (Values.bits64 item))
  | U64_vec, items ->
    write_small buffer (List.length items);
    words (fun item -> Buffer.add_int64_le buffer (Z.to_int64 (Z.signed_extract item 0 64)))
  | Float_vec, items ->
    write_small buffer (List.length items);
    words (fun item -> Buffer.add_int32_le buffer (Values.bits32 item))
  | (Float | Vec _), _ -> words (fun item -> Buffer.add_int32_le buffer (Values.bits32 item))
  | (Int | Uint | Uint64 | Bool), _ -> invalid_arg "a number is one item"

let begin_ buffer kind replicas =
  Buffer.add_uint8 buffer (version lor (kind lsl 4));
  write_small buffer (List.length replicas);
  let replica { agent; incarnation } =
    let twice = Z.shift_left agent 1 in
    if Z.sign incarnation = 0 then write_varint buffer twice
    else begin
      write_varint buffer (Z.succ twice);
      write_varint buffer (Z.pred incarnation)
    end
  in
  List.iter replica replicas

(* How many of the dots, which stand in runs, come before a sequence that is one of them; and those after it. *)
let rec skip_to sequence passed = function
  | (first, last) :: runs when Z.lt last sequence ->
    skip_to sequence (Z.add passed (Z.succ (Z.sub last first))) runs
  | (first, last) :: runs when Z.leq first sequence ->
    let left = if Z.equal sequence last then runs else (Z.succ sequence, last) :: runs in
    (Z.add passed (Z.sub sequence first), left)
  | _ -> invalid_arg "what is held has been seen"

let state_bytes state =
  let buffer = Buffer.create 512 in
  let anchored (dot, record) =
    dot.replica0
    :: List.filter_map (fun anchor -> if is_root anchor then None else Some anchor.replica0) (anchors record)
  in
  let replicas =
    List.sort_uniq Order.compare_replicas (List.map fst state.form0 @ List.concat_map anchored state.held)
  in
  let own (_, record) = List.filter (fun name -> not (Hashtbl.mem places name)) (names_of record) in
  let names = List.sort_uniq String.compare (List.concat_map own state.held) in
  begin_ buffer 0 replicas;
  write_runs buffer replicas state.form0;
  write_small buffer (List.length names);
  List.iter (write_bytes buffer) names;
  let name text =
    write_small buffer
      (match Hashtbl.find_opt places text with
       | Some place -> place
       | None -> Array.length vocabulary + index String.equal text names)
  in
  let anchor dot =
    if is_root dot then write_small buffer 0
    else begin
      write_small buffer (1 + index same_replica dot.replica0 replicas);
      write_varint buffer dot.sequence
    end
  in
  let stamp_before = ref Z.zero in
  let time_before = ref Z.zero in
  let head kind stamp = write_small buffer kind; write_difference buffer stamp_before stamp in
  let record seen (dot, record) =
    let skip, left = skip_to dot.sequence Z.zero seen in
    write_varint buffer skip;
    (match record with
     | Vertex (kind, text, external_id, stamp) ->
       head (if external_id = None then 0 else 1) stamp;
       name kind; name text;
       Option.iter (write_varint buffer) external_id
     | Edge (from, target, label, stamp) -> head 2 stamp; anchor from; anchor target; name label
     | Write (target, text, value, time, stamp) ->
       head (3 + Z.to_int value.value_type) stamp;
       anchor target; name text;
       write_difference buffer time_before time;
       write_value buffer value);
    left
  in
  let rec records replicas held =
    match replicas with
    | [] -> ()
    | replica :: replicas ->
      let own, others = List.partition (fun (dot, _) -> same_replica dot.replica0 replica) held in
      let seen = runs_of state.form0 replica in
      if seen <> [] then begin
        write_small buffer (List.length own);
        ignore (List.fold_left record seen own)
      end;
      records replicas others
  in
  records replicas state.held;
  Buffer.contents buffer

let digest_bytes digest =
  let buffer = Buffer.create 128 in
  let replicas = List.sort_uniq Order.compare_replicas (List.map fst (digest.x_context @ digest.x_live)) in
  begin_ buffer 1 replicas;
  write_runs buffer replicas digest.x_context;
  write_runs buffer replicas digest.x_live;
  Buffer.contents buffer

(* ** Reading *)

type reader = { bytes : string; mutable at : int }

let left reader = String.length reader.bytes - reader.at

let take reader count =
  if count > left reader then undecodable "at byte %d: %d bytes are due" reader.at count;
  let taken = String.sub reader.bytes reader.at count in
  reader.at <- reader.at + count;
  taken

let byte reader =
  if left reader = 0 then undecodable "at byte %d: the end" reader.at;
  let byte = Char.code reader.bytes.[reader.at] in
  reader.at <- reader.at + 1;
  byte

(* At most 64 bits, in the fewest bytes. *)
let varint reader =
  let rec from shift value =
    let next = byte reader in
    if next = 0 && shift > 0 then undecodable "at byte %d: an integer has a shorter spelling" reader.at;
    let group = next land 0x7f in
    if shift < 56 then
      let value = value lor (group lsl shift) in
      if next < 0x80 then Z.of_int value else from (shift + 7) value
    else large shift (Z.of_int value) next
  and large shift value next =
    if next = 0 && shift > 0 then undecodable "at byte %d: an integer has a shorter spelling" reader.at;
    let value = Z.logor value (Z.shift_left (Z.of_int (next land 0x7f)) shift) in
    if Z.numbits value > 64 then undecodable "at byte %d: an integer has over 64 bits" reader.at;
    if next < 0x80 then value
    else if shift >= 63 then undecodable "at byte %d: an integer has over 64 bits" reader.at
    else large (shift + 7) value (byte reader)
  in
  from 0 0

let up_to greatest reader =
  let number = varint reader in
  if Z.gt number greatest then undecodable "at byte %d: a number is above %s" reader.at (Z.to_string greatest);
  number

let word = up_to (Z.pred (Z.shift_left Z.one 32))

let read_difference reader before =
  before := Z.extract (Z.add !before (unfold (varint reader))) 0 64;
  !before

(* A number of things, each of at least so many bytes: no more than what remains has room for. *)
let count ?(most = max_int) each reader =
  let number = varint reader in
  if Z.gt number (Z.of_int (min most (left reader / each))) then
    undecodable "at byte %d: %s things are announced" reader.at (Z.to_string number);
  Z.to_int number

(* So many things read one after the other. *)
let times number read =
  let rec from at found = if at = number then List.rev found else from (at + 1) (read () :: found) in
  from 0 []

let ascending compare what items =
  let rec check = function
    | left :: (right :: _ as rest) ->
      if compare left right >= 0 then undecodable "the %s do not ascend" what;
      check rest
    | _ -> ()
  in
  check items

(* A table, and which of its entries were used. *)
type 'a table = { items : 'a array; used : bool array }

let table items = { items = Array.of_list items; used = Array.make (List.length items) false }

let look table number =
  if Z.geq number (Z.of_int (Array.length table.items)) then undecodable "no entry %s of a table" (Z.to_string number);
  let at = Z.to_int number in
  table.used.(at) <- true;
  table.items.(at)

let check_used what table = if not (Array.for_all Fun.id table.used) then undecodable "a %s is never used" what

let read_replicas reader =
  let replica () =
    let agent_and_bit = up_to (Z.pred (Z.shift_left Z.one 33)) reader in
    let incarnation =
      if Z.is_odd agent_and_bit then Z.succ (up_to (Z.of_int 0xffff_fffe) reader) else Z.zero
    in
    { agent = Z.shift_right agent_and_bit 1; incarnation }
  in
  let number = count 2 reader in
  let replicas = times number replica in
  ascending Order.compare_replicas "replicas" replicas;
  table replicas

let read_runs ?(most_beyond = max_int) reader replicas =
  let beyond = ref 0 in
  let runs at replica =
    let least = ref Z.one in
    let run () =
      let first = Z.add !least (varint reader) in
      let last = Z.add first (varint reader) in
      if Z.gt last sequence_max then undecodable "at byte %d: a sequence is too great" reader.at;
      if Z.gt first Z.one then incr beyond;
      if !beyond > most_beyond then undecodable "at byte %d: too many runs stand beyond gaps" reader.at;
      least := Z.add last (Z.of_int 2);
      (first, last)
    in
    let number = count 2 reader in
    let runs = times number run in
    if runs <> [] then replicas.used.(at) <- true;
    (replica, runs)
  in
  let found = List.mapi runs (Array.to_list replicas.items) in
  List.filter (fun (_, runs) -> runs <> []) found

let utf8 reader count =
  let text = take reader count in
  if not (Json.is_utf8 text) then undecodable "at byte %d: a text is not UTF-8" reader.at;
  text

let read_names reader =
  let name () =
    let bytes = varint reader in
    if Z.sign bytes = 0 || Z.gt bytes (Z.of_int 255) then undecodable "at byte %d: a name's length" reader.at;
    utf8 reader (Z.to_int bytes)
  in
  let number = count 2 reader in
  let names = times number name in
  ascending String.compare "names" names;
  let known name = if Hashtbl.mem places name then undecodable "%S is a name of the static table" name in
  List.iter known names;
  table names

let value_bytes_max = 67_108_864

let read_value reader number =
  let length each = count ~most:(value_bytes_max / each) each reader in
  let float () = Values.place32 (String.get_int32_le (take reader 4) 0) in
  let wide () = String.get_int64_le (take reader 8) 0 in
  let items =
    match snd Values.kinds.(number) with
    | String -> let bytes = length 1 in Values.items_of_bytes (utf8 reader bytes)
    | Byte_vec -> let bytes = length 1 in Values.items_of_bytes (take reader bytes)
    | Int -> [ unfold (word reader) ]
    | Uint -> [ word reader ]
    | Uint64 -> [ varint reader ]
    | Bool -> (
      match byte reader with
      | (0 | 1) as truth -> [ Z.of_int truth ]
      | found -> undecodable "at byte %d: %d is no truth" reader.at found)
    | Float -> [ float () ]
    | Double -> [ Values.place64 (wide ()) ]
    | Float_vec -> let number = length 4 in times number float
    | U64_vec -> let number = length 8 in times number (fun () -> Values.unsigned64 (wide ()))
    | Vec number -> times number float
  in
  Values.make number items

let read_record reader replicas names stamp_before time_before =
  let kind = byte reader in
  if kind >= 3 + Array.length Values.kinds then undecodable "at byte %d: %d is no kind of record" reader.at kind;
  let stamp = read_difference reader stamp_before in
  let anchor () =
    let index = varint reader in
    if Z.sign index = 0 then rOOT
    else begin
      let replica0 = look replicas (Z.pred index) in
      let sequence = varint reader in
      if Z.sign sequence = 0 then undecodable "at byte %d: sequence 0 names no event" reader.at;
      { replica0; sequence }
    end
  in
  let name () =
    let index = varint reader in
    let own = Z.sub index (Z.of_int (Array.length vocabulary)) in
    if Z.sign own < 0 then vocabulary.(Z.to_int index) else look names own
  in
  match kind with
  | 2 ->
    let from = anchor () in
    let target = anchor () in
    Edge (from, target, name (), stamp)
  | 0 | 1 ->
    let vertex_type = name () in
    let text = name () in
    Vertex (vertex_type, text, (if kind = 1 then Some (varint reader) else None), stamp)
  | _ ->
    let target = anchor () in
    let text = name () in
    let time = read_difference reader time_before in
    Write (target, text, read_value reader (kind - 3), time, stamp)

let start bytes kind =
  if String.length bytes > 1_073_741_824 then undecodable "over 1 GiB";
  let reader = { bytes; at = 0 } in
  let first = byte reader in
  if first land 15 <> version then undecodable "version %d" (first land 15);
  if first lsr 4 <> kind then undecodable "kind %d" (first lsr 4);
  reader

let finish reader = if left reader > 0 then undecodable "at byte %d: %d bytes follow the end" reader.at (left reader)

(* The dot that so many come before, of those that stand in runs; leaves those after it. *)
let rec pass reader skip left =
  match !left with
  | [] -> undecodable "at byte %d: a record's dot is beyond the context" reader.at
  | (first, last) :: runs ->
    let dots = Z.succ (Z.sub last first) in
    if Z.geq skip dots then begin
      left := runs;
      pass reader (Z.sub skip dots) left
    end
    else begin
      let sequence = Z.add first skip in
      left := if Z.equal sequence last then runs else (Z.succ sequence, last) :: runs;
      sequence
    end

(* A state; raises `Undecodable`, or `States.Unsound` if it is not well-formed. *)
let state bytes =
  let reader = start bytes 0 in
  let replicas = read_replicas reader in
  let form0 = read_runs ~most_beyond:Dots.cloud_runs_max reader replicas in
  let names = read_names reader in
  let total = ref 0 in
  let stamp_before = ref Z.zero in
  let time_before = ref Z.zero in
  let records (replica0, seen) =
    let number = count ~most:(Dots.records_max - !total) 5 reader in
    total := !total + number;
    let left = ref seen in
    let record () =
      let sequence = pass reader (varint reader) left in
      ({ replica0; sequence }, read_record reader replicas names stamp_before time_before)
    in
    times number record
  in
  let held = List.concat_map records form0 in
  finish reader;
  check_used "replica" replicas;
  check_used "name" names;
  States.sound { held; form0 }

let digest bytes =
  let reader = start bytes 1 in
  let replicas = read_replicas reader in
  let x_context = read_runs ~most_beyond:Dots.cloud_runs_max reader replicas in
  let x_live = read_runs reader replicas in
  finish reader;
  check_used "replica" replicas;
  let unseen = form_minus x_live x_context in
  if unseen <> [] then undecodable "live dots are not in the context";
  let add live (first, last) = Z.add live (Z.succ (Z.sub last first)) in
  let live = List.fold_left (fun live (_, runs) -> List.fold_left add live runs) Z.zero x_live in
  if Z.gt live (Z.of_int Dots.records_max) then undecodable "too many live dots";
  { x_context; x_live }

(* ** Hexadecimal *)

let hex bytes =
  let digits = "0123456789abcdef" in
  String.init (2 * String.length bytes) (fun at ->
      let byte = Char.code bytes.[at / 2] in
      digits.[if at land 1 = 0 then byte lsr 4 else byte land 15])

let of_hex text =
  let digit at =
    match text.[at] with
    | '0' .. '9' as c -> Char.code c - Char.code '0'
    | 'a' .. 'f' as c -> Char.code c - Char.code 'a' + 10
    | _ -> Json.unreadable "%S are no lower-case hexadecimal digits" text
  in
  if String.length text land 1 = 1 then Json.unreadable "half a byte stands in %S" text;
  String.init (String.length text / 2) (fun at -> Char.chr ((digit (2 * at) lsl 4) lor digit ((2 * at) + 1)))
