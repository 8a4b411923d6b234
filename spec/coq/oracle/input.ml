(* Lines of a descriptor, and whether another one stands ready. *)

exception Too_long

type t = {
  descriptor : Unix.file_descr;
  mutable bytes : Bytes.t;
  mutable first : int;
  mutable last : int;
  longest : int;  (** its end excluded *)
}

let make ~longest descriptor = { descriptor; bytes = Bytes.create 65536; first = 0; last = 0; longest }

let end_of_line input =
  match Bytes.index_from_opt input.bytes input.first '\n' with
  | Some at when at < input.last -> Some at
  | _ -> None

let has_line input = end_of_line input <> None

(* Reads more; false at the end. *)
let fill input =
  if input.first > 0 then begin
    Bytes.blit input.bytes input.first input.bytes 0 (input.last - input.first);
    input.last <- input.last - input.first;
    input.first <- 0
  end;
  if input.last > input.longest then raise Too_long;
  if input.last = Bytes.length input.bytes then input.bytes <- Bytes.extend input.bytes 0 (Bytes.length input.bytes);
  let count = Unix.read input.descriptor input.bytes input.last (Bytes.length input.bytes - input.last) in
  input.last <- input.last + count;
  count > 0

let rec line input =
  match end_of_line input with
  | Some at when at - input.first > input.longest -> raise Too_long
  | Some at ->
    let line = Bytes.sub_string input.bytes input.first (at - input.first) in
    input.first <- at + 1;
    Some line
  | None ->
    if fill input then line input
    else if input.first = input.last then None
    else begin
      let line = Bytes.sub_string input.bytes input.first (input.last - input.first) in
      input.first <- input.last;
      Some line
    end
