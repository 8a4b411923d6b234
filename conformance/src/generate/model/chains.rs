//! Ways through all sets of some deltas.

use super::script::Set;

/// Chains of sets, each set one delta more than the one before it, that together have every set of `count` deltas
/// once: as few as there can be. The longest first. (De Bruijn, Tengbergen and Kruyswijk 1951.)
pub(super) fn chains(count: usize) -> Vec<Vec<Set>> {
    let mut chains: Vec<Vec<Set>> = vec![vec![0]];
    for next in 0..count {
        let with = |set: &Set| set | 1 << next;
        let mut longer = Vec::new();
        for chain in &chains {
            longer.push(chain.iter().copied().chain(chain.last().map(with)).collect());
            if let [all_but_the_last @ .., _] = chain.as_slice()
                && !all_but_the_last.is_empty()
            {
                longer.push(all_but_the_last.iter().map(with).collect());
            }
        }
        chains = longer;
    }
    chains.sort_by_key(|chain| std::cmp::Reverse(chain.len()));
    chains
}

#[cfg(test)]
mod tests {
    use super::chains;

    #[test]
    fn law_chains_have_every_set_once_and_are_few() {
        for (count, few) in [(0, 1), (1, 1), (2, 2), (3, 3), (4, 6)] {
            let chains = chains(count);
            assert_eq!(chains.len(), few);
            let mut sets: Vec<u32> = chains.concat();
            sets.sort_unstable();
            assert_eq!(sets, (0..1 << count).collect::<Vec<_>>());
            let grows = |pair: &[u32]| pair[0] & !pair[1] == 0 && (pair[0] ^ pair[1]).is_power_of_two();
            assert!(chains.iter().all(|chain| chain.windows(2).all(grows)));
        }
    }
}
