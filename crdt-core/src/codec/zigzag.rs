//! Signed integers as unsigned ones. `[spec: ENC-3]`

/// Folds the sign into the lowest bit, so that small numbers stay short: 0, -1, 1, -2, … to 0, 1, 2, 3, …
pub(super) fn fold(item: i64) -> u64 {
    ((item << 1) ^ (item >> 63)).cast_unsigned()
}

/// What was folded.
pub(super) fn unfold(folded: u64) -> i64 {
    (folded >> 1).cast_signed() ^ -(folded & 1).cast_signed()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[spec: ENC-3]` `[spec: ENC-7]`
    #[test]
    fn law_zigzag_is_a_bijection_that_keeps_small_numbers_short() {
        let ints = [(i32::MAX.into(), u64::from(u32::MAX) - 1), (i32::MIN.into(), u32::MAX.into())];
        let longs = [(i64::MAX, u64::MAX - 1), (i64::MIN, u64::MAX)];
        for (item, folded) in [(0, 0), (-1, 1), (1, 2), (-2, 3)].into_iter().chain(ints).chain(longs) {
            assert_eq!(fold(item), folded);
            assert_eq!(unfold(folded), item);
        }
    }
}
