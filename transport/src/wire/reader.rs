//! Reading bytes that nobody vouches for.

use super::WireError;

/// A position in bytes; every read checks what remains first.
pub(super) struct Reader<'b> {
    bytes: &'b [u8],
    offset: usize,
}

impl<'b> Reader<'b> {
    pub(super) fn new(bytes: &'b [u8]) -> Self {
        Self { bytes, offset: 0 }
    }

    pub(super) fn offset(&self) -> usize {
        self.offset
    }

    pub(super) fn left(&self) -> usize {
        self.bytes.len() - self.offset
    }

    pub(super) fn rest(&self) -> &'b [u8] {
        &self.bytes[self.offset..]
    }

    pub(super) fn take(&mut self, count: usize, what: &'static str) -> Result<&'b [u8], WireError> {
        let end = WireError::End { offset: self.offset, what, needed: count as u64, left: self.left() };
        let taken = self.rest().get(..count).ok_or(end)?;
        self.offset += count;
        Ok(taken)
    }

    pub(super) fn array<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], WireError> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N, what)?);
        Ok(array)
    }

    pub(super) fn u32(&mut self, what: &'static str) -> Result<u32, WireError> {
        Ok(u32::from_le_bytes(self.array(what)?))
    }

    pub(super) fn u64(&mut self, what: &'static str) -> Result<u64, WireError> {
        Ok(u64::from_le_bytes(self.array(what)?))
    }

    /// A number from `min` to `max`.
    pub(super) fn number(&mut self, what: &'static str, min: u64, max: u64) -> Result<u64, WireError> {
        let offset = self.offset;
        let mut value = 0_u64;
        for shift in (0..u64::BITS).step_by(7) {
            let [byte] = self.array(what)?;
            let group = u64::from(byte & 0x7f);
            if group << shift >> shift != group {
                break;
            }
            value |= group << shift;
            if byte < 0x80 {
                let range = WireError::Range { offset, what, found: value, min, max };
                return if (min..=max).contains(&value) { Ok(value) } else { Err(range) };
            }
        }
        Err(WireError::Range { offset, what, found: u64::MAX, min, max })
    }

    /// A number from `min` to `max` of 32 bits.
    pub(super) fn small(&mut self, what: &'static str, min: u32, max: u32) -> Result<u32, WireError> {
        let offset = self.offset;
        let value = self.number(what, min.into(), max.into())?;
        u32::try_from(value).map_err(|_too_great: std::num::TryFromIntError| WireError::Range {
            offset,
            what,
            found: value,
            min: min.into(),
            max: max.into(),
        })
    }

    /// How many items of at least `bytes_each` bytes follow: what is returned may be reserved.
    pub(super) fn count(
        &mut self,
        what: &'static str,
        max: usize,
        bytes_each: usize,
    ) -> Result<usize, WireError> {
        let count = self.number(what, 0, max as u64)?;
        let needed = count.saturating_mul(bytes_each as u64);
        match usize::try_from(count) {
            Ok(count) if needed <= self.left() as u64 => Ok(count),
            _ => Err(WireError::End { offset: self.offset, what, needed, left: self.left() }),
        }
    }

    pub(super) fn text(&mut self, what: &'static str, max: usize) -> Result<String, WireError> {
        let offset = self.offset;
        let count = self.count(what, max, 1)?;
        let text = std::str::from_utf8(self.take(count, what)?);
        text.map(String::from).map_err(|_not_utf8: std::str::Utf8Error| WireError::NotUtf8 { offset })
    }
}
