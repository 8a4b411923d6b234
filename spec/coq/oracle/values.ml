(* Values: their types (VALUE-1), their items as integers in the order of VALUE-3, and their JSON (JSON-4 to
   JSON-6). *)

open Kernel
module Z = Number.Z

type kind = String | Int | Float | Float_vec | Bool | Byte_vec | Uint | Uint64 | Double | U64_vec | Vec of int

let kinds =
  [| "string", String; "int", Int; "float", Float; "float_vec", Float_vec; "bool", Bool; "byte_vec", Byte_vec;
     "uint", Uint; "uint64", Uint64; "double", Double; "u64_vec", U64_vec; "vec2", Vec 2; "vec3", Vec 3;
     "vec4", Vec 4; "vec6", Vec 6 |]

let numbers = Array.init (Array.length kinds) Z.of_int
let name_of value = fst kinds.(Z.to_int value.value_type)
let kind_of value = snd kinds.(Z.to_int value.value_type)

let number_of_name name =
  let rec from at =
    if at >= Array.length kinds then Json.unreadable "%S is no type of values" name
    else if fst kinds.(at) = name then at
    else from (at + 1)
  in
  from 0

let make number items = { value_type = numbers.(number); items }

(* ** Items *)

let bytes_of_items items = String.of_seq (Seq.map (fun item -> Char.chr (Z.to_int item)) (List.to_seq items))
let small = Array.init 256 Z.of_int
let items_of_bytes bytes = List.init (String.length bytes) (fun at -> small.(Char.code bytes.[at]))

(* A float's place in the total order of IEEE 754, from the bits that it is written with, and back. *)
let place ~bits written =
  let sign = Z.shift_left Z.one (bits - 1) in
  if Z.lt written sign then written else Z.neg (Z.succ (Z.sub written sign))

let written ~bits place =
  if Z.sign place >= 0 then place else Z.add (Z.shift_left Z.one (bits - 1)) (Z.pred (Z.neg place))

let unsigned64 bits = Z.extract (Z.of_int64 bits) 0 64
let place32 bits = place ~bits:32 (Z.logand (Z.of_int32 bits) (Z.of_string "0xffffffff"))
let place64 bits = place ~bits:64 (unsigned64 bits)
let bits32 place = Z.to_int32 (Z.signed_extract (written ~bits:32 place) 0 32)
let bits64 place = Z.to_int64 (Z.signed_extract (written ~bits:64 place) 0 64)

(* NaNs are read as the canonical one (VALUE-4). *)
let place_of_float32 float = if Float.is_nan float then Z.of_int 0x7fc00000 else place32 (Int32.bits_of_float float)

let place_of_float64 float =
  if Float.is_nan float then Z.of_string "0x7ff8000000000000" else place64 (Int64.bits_of_float float)

(* ** Base64 (RFC 4648 §4) *)

let alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"

let base64 bytes =
  let length = String.length bytes in
  let buffer = Buffer.create ((length * 4 / 3) + 4) in
  let byte at = if at < length then Char.code bytes.[at] else 0 in
  let rec from at =
    if at < length then begin
      let group = (byte at lsl 16) lor (byte (at + 1) lsl 8) lor byte (at + 2) in
      for digit = 0 to 3 do
        if at + digit <= length then Buffer.add_char buffer alphabet.[(group lsr (18 - (6 * digit))) land 63]
        else Buffer.add_char buffer '='
      done;
      from (at + 3)
    end
  in
  from 0;
  Buffer.contents buffer

let of_base64 text =
  let length = String.length text in
  let bad () = Json.unreadable "%S is not base64" text in
  if length mod 4 <> 0 then bad ();
  let padding =
    if length > 0 && text.[length - 1] = '=' then if text.[length - 2] = '=' then 2 else 1 else 0
  in
  let digit at =
    if at >= length - padding then 0
    else match String.index_opt alphabet text.[at] with Some digit -> digit | None -> bad ()
  in
  let buffer = Buffer.create (length * 3 / 4) in
  for group = 0 to (length / 4) - 1 do
    let at = 4 * group in
    let bits = (digit at lsl 18) lor (digit (at + 1) lsl 12) lor (digit (at + 2) lsl 6) lor digit (at + 3) in
    let count = if group = (length / 4) - 1 then 3 - padding else 3 in
    for byte = 0 to 2 do
      let value = (bits lsr (16 - (8 * byte))) land 255 in
      if byte < count then Buffer.add_char buffer (Char.chr value) else if value <> 0 then bad ()
    done
  done;
  Buffer.contents buffer

(* ** JSON *)

let is_whole spelling = not (String.exists (function '.' | 'e' | 'E' -> true | _ -> false) spelling)

(* An integer of JSON between two bounds. *)
let integer least greatest json =
  match json with
  | Json.Number spelling when is_whole spelling && String.length spelling <= 20 ->
    let number = Z.of_string spelling in
    if Z.geq number least && Z.leq number greatest then number
    else Json.unreadable "%s is out of range" spelling
  | _ -> Json.unreadable "an integer is due"

let power bits = Z.shift_left Z.one bits
let greatest64 = Z.pred (power 64)
let exact_max = Z.pred (power 53)

(* A decimal in a text, or an integer that every reader of JSON keeps. *)
let wide = function
  | Json.Text text -> (
    match Ids.decimal text with Some number -> number | None -> Json.unreadable "%S is no 64-bit decimal" text)
  | json -> integer Z.zero exact_max json

let float64 = function
  | Json.Number spelling ->
    let float = float_of_string spelling in
    if Float.is_integer float || Float.abs float < Float.infinity then float
    else Json.unreadable "%s is beyond the range of floats" spelling
  | Json.Text "NaN" -> Float.nan
  | Json.Text "inf" -> Float.infinity
  | Json.Text "-inf" -> Float.neg_infinity
  | _ -> Json.unreadable "a number, \"NaN\", \"inf\" or \"-inf\" is due"

let float32 json =
  let wide = float64 json in
  let narrow = Int32.float_of_bits (Int32.bits_of_float wide) in
  if Float.abs narrow = Float.infinity && Float.abs wide < Float.infinity then
    Json.unreadable "%h is beyond the range of 32-bit floats" wide
  else narrow

let vector count json =
  let items = Json.list json in
  if List.compare_length_with items count <> 0 then Json.unreadable "%d items are due" count;
  items

let of_json json =
  let members = Json.members [ "type"; "value" ] json in
  let number = number_of_name (Json.string (Json.required "type" members)) in
  let given = Json.required "value" members in
  let floats items = List.map (fun item -> place_of_float32 (float32 item)) items in
  make number
    (match snd kinds.(number) with
     | String -> items_of_bytes (Json.string given)
     | Int -> [ integer (Z.neg (power 31)) (Z.pred (power 31)) given ]
     | Bool -> [ (if Json.bool given then Z.one else Z.zero) ]
     | Byte_vec -> items_of_bytes (of_base64 (Json.string given))
     | Uint -> [ integer Z.zero (Z.pred (power 32)) given ]
     | Uint64 -> [ wide given ]
     | Double -> [ place_of_float64 (float64 given) ]
     | U64_vec -> List.map wide (Json.list given)
     | Float -> floats [ given ]
     | Float_vec -> floats (Json.list given)
     | Vec count -> floats (vector count given))

(* The shortest decimal that reads back the same. *)
let shortest least greatest float reads_back =
  let rec from digits =
    let spelling = Printf.sprintf "%.*g" digits float in
    if digits >= greatest || reads_back (float_of_string spelling) then spelling else from (digits + 1)
  in
  let spelling = from least in
  if is_whole spelling then spelling ^ ".0" else spelling

let float_json float shortest =
  if Float.is_nan float then Json.Text "NaN"
  else if float = Float.infinity then Json.Text "inf"
  else if float = Float.neg_infinity then Json.Text "-inf"
  else Json.Number (shortest ())

let float32_json item =
  let bits = bits32 item in
  let float = Int32.float_of_bits bits in
  float_json float (fun () -> shortest 6 9 float (fun read -> Int32.equal (Int32.bits_of_float read) bits))

let float64_json item =
  let bits = bits64 item in
  let float = Int64.float_of_bits bits in
  float_json float (fun () -> shortest 15 17 float (fun read -> Int64.equal (Int64.bits_of_float read) bits))

let to_json value =
  let items = value.items in
  let decimal item = Json.Text (Z.to_string item) in
  let one write = match items with [ item ] -> write item | _ -> Json.Null in
  let shown =
    match kind_of value with
    | String -> Json.Text (bytes_of_items items)
    | Int | Uint -> one (fun item -> Json.Number (Z.to_string item))
    | Bool -> one (fun item -> Json.Bool (Z.sign item <> 0))
    | Byte_vec -> Json.Text (base64 (bytes_of_items items))
    | Uint64 -> one decimal
    | Double -> one float64_json
    | Float -> one float32_json
    | U64_vec -> Json.List (List.map decimal items)
    | Float_vec | Vec _ -> Json.List (List.map float32_json items)
  in
  Json.Object [ ("type", Json.Text (name_of value)); ("value", shown) ]
