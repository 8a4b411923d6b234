(** What the oracle is made of: the definitions that the theorems are about, as OCaml. Beside OCaml's own booleans,
    options, pairs and lists, three things are put in the place of what Coq would write: numbers are Zarith's, names
    are OCaml's strings, and both are compared by OCaml. They are trusted, as the compiler is. *)

From DSR Require Import Conditions.
From Coq Require Import Extraction.

Extraction Language OCaml.

Extract Inductive bool => "bool" [ "true" "false" ].
Extract Inductive sumbool => "bool" [ "true" "false" ].
Extract Inductive unit => "unit" [ "()" ].
Extract Inductive option => "option" [ "Some" "None" ].
Extract Inductive prod => "( * )" [ "" ].
Extract Inductive list => "list" [ "[]" "( :: )" ].
Extract Inductive sum => "Either.t" [ "Either.Left" "Either.Right" ].
Extract Inlined Constant andb => "( && )".
Extract Inlined Constant orb => "( || )".
Extract Inlined Constant negb => "not".
Extract Inlined Constant fst => "fst".
Extract Inlined Constant snd => "snd".

(** Numbers: see number.ml. *)
Extract Inductive nat => "int" [ "0" "succ" ] "Number.on_count".
Extract Inductive positive => "Number.t" [ "Number.next_double" "Number.double" "Number.one" ] "Number.on_positive".
Extract Inductive N => "Number.t" [ "Number.zero" "" ] "Number.on_natural".
Extract Inductive Z => "Number.t" [ "Number.zero" "" "Number.opposite" ] "Number.on_integer".
Extract Constant N.compare => "(fun x y -> if Number.equal x y then Eq else if Number.below x y then Lt else Gt)".
Extract Constant Z.compare => "(fun x y -> if Number.equal x y then Eq else if Number.below x y then Lt else Gt)".
Extract Inlined Constant N.eqb => "Number.equal".
Extract Inlined Constant Z.eqb => "Number.equal".
Extract Inlined Constant N.leb => "Number.at_most".
Extract Inlined Constant Z.leb => "Number.at_most".
Extract Inlined Constant N.ltb => "Number.below".
Extract Inlined Constant N.add => "Number.add".
Extract Inlined Constant Z.add => "Number.add".
Extract Inlined Constant N.sub => "Number.less".
Extract Inlined Constant Z.sub => "Number.subtract".
Extract Inlined Constant N.mul => "Number.multiply".
Extract Inlined Constant Z.opp => "Number.opposite".
Extract Inlined Constant N.max => "Number.max".
Extract Inlined Constant N.min => "Number.min".

(** Names. *)
Extract Inductive Ascii.ascii => "char" [ "(fun _ -> assert false)" ] "(fun _ _ -> assert false)".
Extract Inductive String.string => "string" [ """""" "(fun (first, rest) -> String.make 1 first ^ rest)" ]
  "(fun none some s -> if s = """" then none () else some s.[0] (String.sub s 1 (String.length s - 1)))".
Extract Constant bytes => "Number.bytes".
Extract Constant ordered_string => "(fun x y -> let c = String.compare x y in if c < 0 then Lt else if c > 0 then Gt else Eq)".

(** What the driver calls. *)
Extraction "kernel.ml" x_bottom x_join x_greatest x_digest x_delta_for form_minus state_fault
  attempt sight seen_shown seen_placement seen_stranded seen_repairs shown_writes by_name has_key in_graph.
