//! Writing bytes.

use super::{VERSION, zigzag};
use alloc::vec::Vec;

/// Room for the delta of a usual mutation.
const BYTES_USUAL: usize = 64;

/// Version and kind, ready for the rest. `[spec: ENC-2]`
pub(super) fn begin(kind: u8) -> Vec<u8> {
    let mut out = Vec::with_capacity(BYTES_USUAL);
    out.push(VERSION | kind << 4);
    out
}

/// A 64-bit integer, seven bits a byte, least first, in as few bytes as possible. `[spec: ENC-3]`
pub(super) fn varint(out: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        #[allow(clippy::cast_possible_truncation, reason = "the low seven bits are what is meant")]
        out.push(value as u8 | 0x80);
        value >>= 7;
    }
    #[allow(clippy::cast_possible_truncation, reason = "below 0x80")]
    out.push(value as u8);
}

/// How `value` differs from the one `before`, whose place it takes. `[spec: ENC-8]`
pub(super) fn difference(out: &mut Vec<u8>, before: &mut u64, value: u64) {
    varint(out, zigzag::fold(value.wrapping_sub(*before).cast_signed()));
    *before = value;
}

/// How many items follow.
pub(super) fn count(out: &mut Vec<u8>, count: usize) {
    varint(out, count as u64);
}

/// A length, then the bytes.
pub(super) fn bytes(out: &mut Vec<u8>, bytes: &[u8]) {
    count(out, bytes.len());
    out.extend_from_slice(bytes);
}
