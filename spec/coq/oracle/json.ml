(* JSON (RFC 8259), strictly: no member stands twice, texts are UTF-8, numbers keep their spelling. *)

type t =
  | Null
  | Bool of bool
  | Number of string
  | Text of string
  | List of t list
  | Object of (string * t) list

(* Why a text is not what it should be. *)
exception Unreadable of string

let unreadable format = Printf.ksprintf (fun why -> raise (Unreadable why)) format

(* Deeper ones are refused, so that no text exhausts the stack. *)
let depth_max = 128

(* ** Reading *)

type reader = { text : string; mutable at : int }

let here reader what = unreadable "%s at byte %d" what reader.at
let peek reader = if reader.at < String.length reader.text then reader.text.[reader.at] else '\000'
let skip reader = reader.at <- reader.at + 1

let rec skip_space reader =
  match peek reader with
  | ' ' | '\t' | '\n' | '\r' -> skip reader; skip_space reader
  | _ -> ()

let expect reader char =
  skip_space reader;
  if peek reader <> char then here reader (Printf.sprintf "`%c` is due" char);
  skip reader

let digits reader =
  let first = reader.at in
  while match peek reader with '0' .. '9' -> true | _ -> false do skip reader done;
  if reader.at = first then here reader "a digit is due"

let number reader =
  let first = reader.at in
  if peek reader = '-' then skip reader;
  if peek reader = '0' then skip reader else digits reader;
  if peek reader = '.' then (skip reader; digits reader);
  (match peek reader with
   | 'e' | 'E' ->
     skip reader;
     (match peek reader with '+' | '-' -> skip reader | _ -> ());
     digits reader
   | _ -> ());
  String.sub reader.text first (reader.at - first)

let hexadecimal reader =
  let digit () =
    let value =
      match peek reader with
      | '0' .. '9' as c -> Char.code c - Char.code '0'
      | 'a' .. 'f' as c -> Char.code c - Char.code 'a' + 10
      | 'A' .. 'F' as c -> Char.code c - Char.code 'A' + 10
      | _ -> here reader "a hexadecimal digit is due"
    in
    skip reader; value
  in
  let a = digit () in let b = digit () in let c = digit () in
  (((((a * 16) + b) * 16) + c) * 16) + digit ()

let escape reader buffer =
  let plain char = skip reader; Buffer.add_char buffer char in
  match peek reader with
  | ('"' | '\\' | '/') as char -> plain char
  | 'b' -> plain '\b'
  | 'f' -> plain '\012'
  | 'n' -> plain '\n'
  | 'r' -> plain '\r'
  | 't' -> plain '\t'
  | 'u' ->
    skip reader;
    let first = hexadecimal reader in
    let code =
      if first < 0xd800 || first > 0xdfff then first
      else begin
        if first > 0xdbff then here reader "half a surrogate pair ends";
        if peek reader <> '\\' then here reader "half a surrogate pair stands";
        skip reader;
        if peek reader <> 'u' then here reader "half a surrogate pair stands";
        skip reader;
        let second = hexadecimal reader in
        if second < 0xdc00 || second > 0xdfff then here reader "half a surrogate pair stands";
        0x10000 + ((first - 0xd800) lsl 10) + (second - 0xdc00)
      end
    in
    Buffer.add_utf_8_uchar buffer (Uchar.of_int code)
  | _ -> here reader "an unknown escape stands"

(* Whether bytes are UTF-8: no surrogates, no longer spelling than needed, nothing above U+10FFFF. *)
let is_utf8 text =
  let length = String.length text in
  let byte at = Char.code (String.unsafe_get text at) in
  let continues at = at < length && byte at land 0xc0 = 0x80 in
  let rec from at =
    if at >= length then true
    else
      let first = byte at in
      if first < 0x80 then from (at + 1)
      else if first < 0xc2 then false
      else if first < 0xe0 then continues (at + 1) && from (at + 2)
      else if first < 0xf0 then
        continues (at + 1) && continues (at + 2)
        && (first <> 0xe0 || byte (at + 1) >= 0xa0)
        && (first <> 0xed || byte (at + 1) < 0xa0)
        && from (at + 3)
      else
        first < 0xf5
        && continues (at + 1) && continues (at + 2) && continues (at + 3)
        && (first <> 0xf0 || byte (at + 1) >= 0x90)
        && (first <> 0xf4 || byte (at + 1) < 0x90)
        && from (at + 4)
  in
  from 0

let text reader =
  skip reader;
  let first = reader.at in
  (* Most texts have no escapes. *)
  let rec plain () =
    match peek reader with
    | '"' | '\\' -> ()
    | char when char < ' ' -> here reader "a control character or the end stands in a text"
    | _ -> skip reader; plain ()
  in
  plain ();
  if peek reader = '"' then begin
    let found = String.sub reader.text first (reader.at - first) in
    skip reader; found
  end
  else begin
    let buffer = Buffer.create 64 in
    Buffer.add_substring buffer reader.text first (reader.at - first);
    let rec rest () =
      match peek reader with
      | '"' -> skip reader
      | '\\' -> skip reader; escape reader buffer; rest ()
      | char when char < ' ' -> here reader "a control character or the end stands in a text"
      | char -> skip reader; Buffer.add_char buffer char; rest ()
    in
    rest ();
    Buffer.contents buffer
  end

let word reader spelling value =
  let length = String.length spelling in
  if reader.at + length <= String.length reader.text && String.sub reader.text reader.at length = spelling
  then (reader.at <- reader.at + length; value)
  else here reader "no value stands"

let rec value depth reader =
  if depth > depth_max then here reader "too many levels stand";
  skip_space reader;
  match peek reader with
  | '{' -> skip reader; Object (members depth reader)
  | '[' -> skip reader; List (items depth reader)
  | '"' -> Text (text reader)
  | '-' | '0' .. '9' -> Number (number reader)
  | 't' -> word reader "true" (Bool true)
  | 'f' -> word reader "false" (Bool false)
  | 'n' -> word reader "null" Null
  | _ -> here reader "no value stands"

and members depth reader =
  skip_space reader;
  if peek reader = '}' then (skip reader; [])
  else
    let rec from found =
      skip_space reader;
      if peek reader <> '"' then here reader "a member's name is due";
      let name = text reader in
      expect reader ':';
      let found = (name, value (depth + 1) reader) :: found in
      skip_space reader;
      match peek reader with
      | ',' -> skip reader; from found
      | '}' -> skip reader; List.rev found
      | _ -> here reader "`,` or `}` is due"
    in
    unique (from [])

and unique members =
  let rec twice = function
    | [] -> None
    | (name, _) :: rest -> if List.mem_assoc name rest then Some name else twice rest
  in
  let found =
    if List.compare_length_with members 16 <= 0 then twice members
    else
      let names = Hashtbl.create 64 in
      let is_known (name, _) = Hashtbl.mem names name || (Hashtbl.add names name (); false) in
      Option.map fst (List.find_opt is_known members)
  in
  match found with
  | Some name -> unreadable "the member %S stands twice" name
  | None -> members

and items depth reader =
  skip_space reader;
  if peek reader = ']' then (skip reader; [])
  else
    let rec from found =
      let found = value (depth + 1) reader :: found in
      skip_space reader;
      match peek reader with
      | ',' -> skip reader; from found
      | ']' -> skip reader; List.rev found
      | _ -> here reader "`,` or `]` is due"
    in
    from []

let read text =
  if not (is_utf8 text) then unreadable "the text is not UTF-8";
  let reader = { text; at = 0 } in
  let found = value 0 reader in
  skip_space reader;
  if reader.at < String.length text then here reader "something stands behind the value";
  found

(* ** Writing *)

let write_text buffer text =
  Buffer.add_char buffer '"';
  String.iter
    (function
      | '"' -> Buffer.add_string buffer "\\\""
      | '\\' -> Buffer.add_string buffer "\\\\"
      | char when char < ' ' -> Printf.bprintf buffer "\\u%04x" (Char.code char)
      | char -> Buffer.add_char buffer char)
    text;
  Buffer.add_char buffer '"'

let rec write buffer = function
  | Null -> Buffer.add_string buffer "null"
  | Bool true -> Buffer.add_string buffer "true"
  | Bool false -> Buffer.add_string buffer "false"
  | Number spelling -> Buffer.add_string buffer spelling
  | Text text -> write_text buffer text
  | List items ->
    Buffer.add_char buffer '[';
    List.iteri (fun at item -> if at > 0 then Buffer.add_char buffer ','; write buffer item) items;
    Buffer.add_char buffer ']'
  | Object members ->
    Buffer.add_char buffer '{';
    List.iteri
      (fun at (name, item) ->
        if at > 0 then Buffer.add_char buffer ',';
        write_text buffer name;
        Buffer.add_char buffer ':';
        write buffer item)
      members;
    Buffer.add_char buffer '}'

(* ** Taking apart *)

let string = function Text text -> text | _ -> unreadable "a text is due"
let bool = function Bool value -> value | _ -> unreadable "true or false is due"
let list = function List items -> items | _ -> unreadable "a list is due"
let entries = function Object members -> members | _ -> unreadable "an object is due"

(* The members of an object that has no others than these. *)
let members allowed json =
  let members = entries json in
  match List.find_opt (fun (name, _) -> not (List.mem name allowed)) members with
  | Some (name, _) -> unreadable "the member %S is not known" name
  | None -> members

let optional name members = List.assoc_opt name members

let required name members =
  match List.assoc_opt name members with Some value -> value | None -> unreadable "the member %S is missing" name
