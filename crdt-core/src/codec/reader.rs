//! Reading bytes that nobody vouches for.

use super::error::DecodeError;
use super::{KIND_DIGEST, KIND_STATE, VERSION, zigzag};
use crate::limits;

/// A position in bytes; every read checks what remains first.
#[derive(Debug)]
pub(super) struct Reader<'b> {
    bytes: &'b [u8],
    offset: usize,
}

impl<'b> Reader<'b> {
    /// Reads version and kind. `[spec: ENC-2]`
    pub(super) fn new(bytes: &'b [u8], kind: u8) -> Result<Self, DecodeError> {
        if bytes.len() > limits::ENCODED_BYTES_MAX {
            return Err(DecodeError::TooLong { bytes: bytes.len() });
        }
        let mut reader = Self { bytes, offset: 0 };
        let first = reader.byte()?;
        let (version, found) = (first & 0x0f, first >> 4);
        if version != VERSION {
            return Err(DecodeError::Version { found: version });
        }
        if found == kind {
            return Ok(reader);
        }
        let what = if kind == KIND_STATE { "state" } else { "digest" };
        debug_assert!(kind == KIND_STATE || kind == KIND_DIGEST);
        Err(DecodeError::Tag { offset: 0, what, found })
    }

    /// Where the next read begins.
    pub(super) fn offset(&self) -> usize {
        self.offset
    }

    /// Refuses bytes after the end. `[spec: ENC-9]`
    pub(super) fn finish(&self) -> Result<(), DecodeError> {
        match self.left() {
            0 => Ok(()),
            bytes => Err(DecodeError::Trailing { offset: self.offset, bytes }),
        }
    }

    fn left(&self) -> usize {
        self.bytes.len() - self.offset
    }

    /// The next `count` bytes.
    pub(super) fn take(&mut self, count: usize) -> Result<&'b [u8], DecodeError> {
        let (offset, left) = (self.offset, self.left());
        let end = DecodeError::End { offset, needed: count as u64, left };
        let taken = self.bytes[offset..].get(..count).ok_or(end)?;
        self.offset += count;
        Ok(taken)
    }

    /// The next `N` bytes.
    pub(super) fn array<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    /// The next byte.
    pub(super) fn byte(&mut self) -> Result<u8, DecodeError> {
        let [byte] = self.array()?;
        Ok(byte)
    }

    /// A 64-bit integer in its shortest spelling. `[spec: ENC-3]`
    pub(super) fn varint(&mut self) -> Result<u64, DecodeError> {
        let offset = self.offset;
        let mut value = 0_u64;
        for shift in (0..u64::BITS).step_by(7) {
            let byte = self.byte()?;
            let group = u64::from(byte & 0x7f);
            if group << shift >> shift != group {
                break;
            }
            value |= group << shift;
            if byte < 0x80 {
                // A last group of zero adds nothing, so it could have been left out.
                return if byte == 0 && shift > 0 {
                    Err(DecodeError::LongVarint { offset })
                } else {
                    Ok(value)
                };
            }
        }
        Err(DecodeError::TooGreat { offset, what: "an integer", max: u64::MAX })
    }

    /// A varint of at most `max`.
    pub(super) fn varint_up_to(&mut self, max: u64, what: &'static str) -> Result<u64, DecodeError> {
        let offset = self.offset;
        let value = self.varint()?;
        if value > max { Err(DecodeError::TooGreat { offset, what, max }) } else { Ok(value) }
    }

    /// What differs from `before` as the next varint says, and is from then on what was before.
    /// `[spec: ENC-8]`
    pub(super) fn difference(&mut self, before: &mut u64) -> Result<u64, DecodeError> {
        *before = before.wrapping_add(zigzag::unfold(self.varint()?).cast_unsigned());
        Ok(*before)
    }

    /// How many items follow, at most `max` and each of at least `bytes_each` bytes: what is returned may be
    /// reserved. `[spec: ENC-10]`
    pub(super) fn count(
        &mut self,
        max: usize,
        bytes_each: usize,
        what: &'static str,
    ) -> Result<usize, DecodeError> {
        let count = self.varint_up_to(max as u64, what)?;
        let needed = count.saturating_mul(bytes_each as u64);
        let left = self.left();
        match usize::try_from(count) {
            Ok(count) if needed <= left as u64 => Ok(count),
            _ => Err(DecodeError::End { offset: self.offset, needed, left }),
        }
    }

    /// The next `count` bytes as text.
    pub(super) fn text(&mut self, count: usize) -> Result<&'b str, DecodeError> {
        let offset = self.offset;
        let bytes = self.take(count)?;
        core::str::from_utf8(bytes)
            .map_err(|error| DecodeError::NotUtf8 { offset: offset.saturating_add(error.valid_up_to()) })
    }
}
