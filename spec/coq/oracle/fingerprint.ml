(* The fingerprint of a digest: SipHash-2-4 of 128 bits with key 0 (SYNC-4). *)

open Kernel
module Z = Number.Z

let rotate word bits = Int64.logor (Int64.shift_left word bits) (Int64.shift_right_logical word (64 - bits))

let siphash bytes =
  let v0 = ref 0x736f6d6570736575L and v1 = ref (Int64.logxor 0x646f72616e646f6dL 0xeeL) in
  let v2 = ref 0x6c7967656e657261L and v3 = ref 0x7465646279746573L in
  let rounds count =
    for _ = 1 to count do
      v0 := Int64.add !v0 !v1; v1 := rotate !v1 13; v1 := Int64.logxor !v1 !v0; v0 := rotate !v0 32;
      v2 := Int64.add !v2 !v3; v3 := rotate !v3 16; v3 := Int64.logxor !v3 !v2;
      v0 := Int64.add !v0 !v3; v3 := rotate !v3 21; v3 := Int64.logxor !v3 !v0;
      v2 := Int64.add !v2 !v1; v1 := rotate !v1 17; v1 := Int64.logxor !v1 !v2; v2 := rotate !v2 32
    done
  in
  let mix word = v3 := Int64.logxor !v3 word; rounds 2; v0 := Int64.logxor !v0 word in
  let length = String.length bytes in
  for at = 0 to (length / 8) - 1 do mix (String.get_int64_le bytes (8 * at)) done;
  let last = Bytes.make 8 '\000' in
  Bytes.blit_string bytes (length land lnot 7) last 0 (length land 7);
  Bytes.set last 7 (Char.chr (length land 255));
  mix (Bytes.get_int64_le last 0);
  let out () = Int64.logxor (Int64.logxor !v0 !v1) (Int64.logxor !v2 !v3) in
  v2 := Int64.logxor !v2 0xeeL;
  rounds 4;
  let low = out () in
  v1 := Int64.logxor !v1 0xddL;
  rounds 4;
  (low, out ())

(* The bytes of the fingerprint as a number, the highest first. *)
let of_digest digest =
  let buffer = Buffer.create 256 in
  let half number = Buffer.add_int32_le buffer (Z.to_int32 (Z.signed_extract number 0 32)) in
  let whole number = Buffer.add_int64_le buffer (Z.to_int64 number) in
  let part form =
    let count = List.fold_left (fun count (_, runs) -> count + List.length runs) 0 form in
    whole (Z.of_int count);
    let run replica (first, last) = half replica.agent; half replica.incarnation; whole first; whole last in
    List.iter (fun (replica, runs) -> List.iter (run replica) runs) form
  in
  part digest.x_context;
  part digest.x_live;
  let low, high = siphash (Buffer.contents buffer) in
  let bytes = Bytes.create 16 in
  Bytes.set_int64_be bytes 0 high;
  Bytes.set_int64_be bytes 8 low;
  Bytes.to_string bytes
