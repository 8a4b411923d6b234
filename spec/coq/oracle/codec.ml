(* The binary encoding of states and digests (ENC-1 to ENC-11). *)

open Kernel
module Z = Number.Z

exception Undecodable of string

let undecodable format = Printf.ksprintf (fun why -> raise (Undecodable why)) format

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
  write_small buffer (Z.to_int value.value_type);
  match (Values.kind_of value, value.items) with
  | (String | Byte_vec), items -> write_bytes buffer (Values.bytes_of_items items)
  | Int, [ item ] ->
    write_varint buffer
      (if Z.sign item >= 0 then Z.shift_left item 1 else Z.pred (Z.neg (Z.shift_left item 1)))
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
  write_small buffer 1;
  write_small buffer kind;
  write_small buffer (List.length replicas);
  let replica { agent; incarnation } = write_varint buffer agent; write_varint buffer incarnation in
  List.iter replica replicas

let state_bytes state =
  let buffer = Buffer.create 512 in
  let anchored (dot, record) =
    dot.replica0
    :: List.filter_map (fun anchor -> if is_root anchor then None else Some anchor.replica0) (anchors record)
  in
  let replicas =
    List.sort_uniq Order.compare_replicas (List.map fst state.form0 @ List.concat_map anchored state.held)
  in
  let names =
    List.sort_uniq String.compare (List.concat_map (fun (_, record) -> names_of record) state.held)
  in
  begin_ buffer 0 replicas;
  write_runs buffer replicas state.form0;
  write_small buffer (List.length names);
  List.iter (write_bytes buffer) names;
  let name text = write_small buffer (index String.equal text names) in
  let anchor dot =
    if is_root dot then write_small buffer 0
    else begin
      write_small buffer (1 + index same_replica dot.replica0 replicas);
      write_varint buffer dot.sequence
    end
  in
  let head kind stamp = write_small buffer kind; write_varint buffer stamp in
  let record least (dot, record) =
    write_varint buffer (Z.sub dot.sequence least);
    (match record with
     | Vertex (kind, text, external_id, stamp) ->
       head (if external_id = None then 0 else 1) stamp;
       name kind; name text;
       Option.iter (write_varint buffer) external_id
     | Edge (from, target, label, stamp) -> head 2 stamp; anchor from; anchor target; name label
     | Write (target, text, value, time, stamp) ->
       head 3 stamp; anchor target; name text; write_varint buffer time; write_value buffer value);
    Z.succ dot.sequence
  in
  let rec records replicas held =
    match replicas with
    | [] -> ()
    | replica :: replicas ->
      let own, others = List.partition (fun (dot, _) -> same_replica dot.replica0 replica) held in
      write_small buffer (List.length own);
      ignore (List.fold_left record Z.one own);
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
  let replica () = let agent = word reader in { agent; incarnation = word reader } in
  let number = count 3 reader in
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
  table names

let value_bytes_max = 67_108_864

let read_value reader =
  let number = byte reader in
  if number >= Array.length Values.kinds then undecodable "at byte %d: %d is no type" reader.at number;
  let length each = count ~most:(value_bytes_max / each) each reader in
  let float () = Values.place32 (String.get_int32_le (take reader 4) 0) in
  let wide () = String.get_int64_le (take reader 8) 0 in
  let items =
    match snd Values.kinds.(number) with
    | String -> let bytes = length 1 in Values.items_of_bytes (utf8 reader bytes)
    | Byte_vec -> let bytes = length 1 in Values.items_of_bytes (take reader bytes)
    | Int ->
      let folded = word reader in
      let half = Z.shift_right folded 1 in
      [ (if Z.is_odd folded then Z.pred (Z.neg half) else half) ]
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

let read_record reader replicas names =
  let kind = byte reader in
  if kind > 3 then undecodable "at byte %d: %d is no kind of record" reader.at kind;
  let stamp = varint reader in
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
  let name () = look names (varint reader) in
  match kind with
  | 2 ->
    let from = anchor () in
    let target = anchor () in
    Edge (from, target, name (), stamp)
  | 3 ->
    let target = anchor () in
    let text = name () in
    let time = varint reader in
    Write (target, text, read_value reader, time, stamp)
  | _ ->
    let vertex_type = name () in
    let text = name () in
    Vertex (vertex_type, text, (if kind = 1 then Some (varint reader) else None), stamp)

let start bytes kind =
  if String.length bytes > 1_073_741_824 then undecodable "over 1 GiB";
  let reader = { bytes; at = 0 } in
  let version = byte reader in
  if version <> 1 then undecodable "version %d" version;
  let found = byte reader in
  if found <> kind then undecodable "kind %d" found;
  reader

let finish reader = if left reader > 0 then undecodable "at byte %d: %d bytes follow the end" reader.at (left reader)

(* A state; raises `Undecodable`, or `States.Unsound` if it is not well-formed. *)
let state bytes =
  let reader = start bytes 0 in
  let replicas = read_replicas reader in
  let form0 = read_runs ~most_beyond:Dots.cloud_runs_max reader replicas in
  let names = read_names reader in
  let total = ref 0 in
  let records replica0 =
    let number = count ~most:(Dots.records_max - !total) 5 reader in
    total := !total + number;
    let least = ref Z.one in
    let record () =
      let sequence = Z.add !least (varint reader) in
      if Z.gt sequence sequence_max then undecodable "at byte %d: a sequence is too great" reader.at;
      least := Z.succ sequence;
      ({ replica0; sequence }, read_record reader replicas names)
    in
    times number record
  in
  let held = List.concat_map records (Array.to_list replicas.items) in
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
