(* The oracle: what Coq's definitions say, for whoever asks.

   dsr-oracle          an adapter of the conformance protocol, over standard input and output
   dsr-oracle facts    a server of facts about states *)

let usage = "usage: dsr-oracle [facts]\n\
  without arguments: an adapter of the conformance protocol (spec/conformance.md)\n\
  facts: one question about states a line, one answer a line (spec/oracle.md)\n"

(* Answers are kept back while more questions stand ready. *)
let serve ~longest reply =
  set_binary_mode_out stdout true;
  let input = Input.make ~longest Unix.stdin in
  let rec go_on () =
    match Input.line input with
    | None -> flush stdout
    | Some line ->
      print_string (reply line);
      print_char '\n';
      if not (Input.has_line input) then flush stdout;
      go_on ()
  in
  go_on ()

let stop why =
  flush stdout;
  prerr_endline ("dsr-oracle: " ^ why);
  exit 2

(* [CONF-1], and for facts what hexadecimal digits of great states need. *)
let line_bytes_max = 1_048_576
let facts_line_bytes_max = 1_073_741_824

let () =
  match Array.to_list Sys.argv with
  | [ _ ] -> (
    try serve ~longest:line_bytes_max Adapter.reply with
    | Json.Unreadable why -> stop ("no request: " ^ why)
    | Input.Too_long -> stop "a line has more than 1 048 576 bytes")
  | [ _; "facts" ] -> (
    try serve ~longest:facts_line_bytes_max Facts.reply
    with Input.Too_long -> stop "a line has more than 1 GiB")
  | [ _; ("--help" | "-h") ] -> print_string usage
  | _ -> prerr_string usage; exit 2
