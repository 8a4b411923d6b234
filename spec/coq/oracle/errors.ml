(* The names of errors and faults, as the chapters have them (CONF-8). *)

open Kernel

let rec refusal = function
  | NameLength -> "NameLength"
  | UndeclaredType -> "UndeclaredType"
  | ReservedName -> "ReservedName"
  | NameTaken -> "NameTaken"
  | LabelLength -> "LabelLength"
  | UndeclaredLabel -> "UndeclaredLabel"
  | UnknownVertex -> "UnknownVertex"
  | SelfLoop -> "SelfLoop"
  | KeyPresent -> "KeyPresent"
  | FunctionalTaken -> "FunctionalTaken"
  | IntoRoot -> "IntoRoot"
  | HasParent -> "HasParent"
  | ParentOutsideTree -> "ParentOutsideTree"
  | NewVertexAsParent -> "NewVertexAsParent"
  | Cycle -> "Cycle"
  | TooMany -> "TooMany"
  | UndeclaredName -> "Undeclared"
  | WrongType -> "WrongType"
  | ValueSize -> "ValueSize"
  | UnknownTarget -> "UnknownTarget"
  | NoUpdates -> "Empty"
  | NotSet -> "NotSet"
  | UnknownEdge -> "UnknownEdge"
  | SameKey0 -> "SameKey"
  | RefusedRoot -> "Root"
  | Strands -> "Strands"
  | Sequences -> "Sequences"
  | Stamps -> "Stamps"
  | Link why -> "Link." ^ refusal why
  | OfEdge why -> "Edge." ^ refusal why
  | OfAttribute why -> "Attribute." ^ refusal why
  | Exhausted why -> "Exhausted." ^ refusal why

let fault = function
  | Sequence_ -> "Sequence"
  | HeldUnseen -> "HeldUnseen"
  | NotClosed -> "NotClosed"
  | WrongAnchor -> "WrongAnchor"
  | NoSuchAnchor -> "NoSuchAnchor"
  | FaultSelfLoop -> "SelfLoop"
  | FaultIntoRoot -> "IntoRoot"
  | FaultNameLength -> "NameLength"
  | FaultValueSize -> "ValueSize"
  | Stamp_ -> "Stamp"
  | Nan -> "Nan"
