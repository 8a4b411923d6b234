//! Join is the join of a semilattice: exhaustively over small universes, then by sampling over large ones.
use dsr_core::{Dot, State, check_well_formed, invariant};
use dsr_testkit::{Anchors, Fate, Universe, cases, fates, parse_state, state, states};
use proptest::prelude::*;

/// Small universes in which everything that closure and join can do occurs.
fn small_universes() -> Vec<Universe> {
    let well_formed = [
        // A vertex, its edge, the edge's write: closure in two passes.
        "r1.1 vertex t a @1
         r1.2 edge root -RT-> r1.1 @1
         r1.3 write r1.2 level=1 @1
         r2.1 write r1.1 level=2 @2",
        // Two vertices, two edges between them that compete, of two replicas.
        "r1.1 vertex t a @1
         r2.1 vertex t a @1
         r1.2 edge r1.1 -RT-> r2.1 @2
         r2.2 edge r2.1 -RT-> r1.1 @2",
        // A chain of replacements, and what waits for an anchor that never comes.
        "r1.1 edge root -in-> r3.1 @1
         r1.2 edge root -in-> r3.1 @2
         r1.3 edge root -in-> r3.1 @3
         r2.1 write r1.2 level=1 @4",
    ];
    let mut universes: Vec<Universe> = well_formed.iter().map(|text| Universe::of(&state(text))).collect();
    // Anchors of the wrong kind: whoever is dishonest can send these, and join must stay associative.
    universes.push(wrong_anchors());
    universes
}

/// An edge on a write, and a write on that edge.
fn wrong_anchors() -> Universe {
    let parts = ["r1.1 write root level=1 @1", "r1.2 edge root -near-> r1.1 @1\nr1.3 write r1.2 level=2 @1"];
    let states = parts.map(|text| parse_state(text).unwrap());
    let records = states.iter().flat_map(|state| state.records().map(|(dot, record)| (dot, record.clone())));
    Universe { records: records.collect() }
}

/// Every pair and triple of every closed state of every small universe.
/// `[spec: JOIN-3]` `[spec: JOIN-4]` `[spec: CLOSE-3]`
#[test]
fn law_join_is_a_semilattice_on_small_universes() {
    let mut triples = 0_usize;
    for universe in small_universes() {
        let states = universe.all_states();
        let index = |state: &State| states.binary_search(state).expect("the states are closed under join");
        let table: Vec<Vec<usize>> = states
            .iter()
            .map(|left| states.iter().map(|right| index(&left.joined(right))).collect())
            .collect();
        let bottom = index(&State::new());
        for a in 0..states.len() {
            assert_eq!((table[a][a], table[a][bottom]), (a, a), "idempotent, with a neutral element");
            for b in 0..states.len() {
                assert_eq!(table[a][b], table[b][a], "commutative");
                assert_eq!(states[a].is_below(&states[b]), table[a][b] == b);
                for (c, &b_c) in table[b].iter().enumerate() {
                    assert_eq!(
                        table[table[a][b]][c], table[a][b_c],
                        "associative:\n{:?}\n{:?}\n{:?}",
                        states[a], states[b], states[c]
                    );
                    triples += 1;
                }
            }
        }
    }
    println!("{triples} triples");
    assert!(triples > 100_000, "{triples}");
}

/// Closure on every state over every small universe, closed or not, against its definition.
/// `[spec: CLOSE-1]` `[spec: CLOSE-2]` `[spec: CLOSE-3]` `[spec: CLOSE-4]`
#[test]
fn law_closure_is_a_closure_operator_on_small_universes() {
    for universe in small_universes() {
        let all: Vec<(Vec<Fate>, Vec<Fate>)> =
            universe.all_fates().map(|fates| (closed(&universe, &fates), fates)).collect();
        for (closure, fates) in &all {
            let mut state = universe.unclosed(fates);
            state.close();
            assert_eq!(&universe.fates_in(&state), closure);
            assert!(is_below(fates, closure), "extensive");
            assert_eq!(&closed(&universe, closure), closure, "idempotent");
            for (other_closure, other) in &all {
                assert!(!is_below(fates, other) || is_below(closure, other_closure), "monotone");
            }
        }
    }
}

fn is_below(left: &[Fate], right: &[Fate]) -> bool {
    left.iter().zip(right).all(|(left, right)| left <= right)
}

/// The closure of fates, straight from its definition.
fn closed(universe: &Universe, fates: &[Fate]) -> Vec<Fate> {
    let mut fates = fates.to_vec();
    let at = |dot: Dot| universe.records.keys().position(|&known| known == dot);
    loop {
        let before = fates.clone();
        for (index, record) in universe.records.values().enumerate() {
            let stranded =
                record.anchors().any(|anchor| at(anchor).is_some_and(|at| before[at] == Fate::Dead));
            if fates[index] == Fate::Held && stranded {
                fates[index] = Fate::Dead;
            }
        }
        if fates == before {
            return fates;
        }
    }
}

/// What the definition says of a join: the pointwise maximum, closed.
fn expected_join(universe: &Universe, left: &[Fate], right: &[Fate]) -> Vec<Fate> {
    let maximum: Vec<Fate> = left.iter().zip(right).map(|(left, right)| *left.max(right)).collect();
    closed(universe, &maximum)
}

proptest! {
    #![proptest_config(cases(10_000))]

    /// `[spec: JOIN-3]`
    #[test]
    fn law_join_is_associative_commutative_idempotent(triple in states(3, 20, Anchors::Right)) {
        check_semilattice(&triple)?;
    }

    /// The same where anchors may be of the wrong kind. `[spec: JOIN-3]` `[spec: CLOSE-3]`
    #[test]
    fn law_join_is_associative_whatever_the_anchors(triple in states(3, 12, Anchors::Any)) {
        check_semilattice(&triple)?;
    }

    /// Merge and join against their definition, by the fates of dots.
    /// `[spec: JOIN-1]` `[spec: JOIN-3]` `[spec: CLOSE-2]`
    #[test]
    fn oracle_join_is_the_closed_maximum((universe, fates) in fates(2, 16, Anchors::Any)) {
        let closures: Vec<Vec<Fate>> = fates.iter().map(|fates| closed(&universe, &padded(&universe, fates))).collect();
        let [left, right] = [&closures[0], &closures[1]].map(|fates| universe.state(fates));
        let joined = left.joined(&right);
        prop_assert_eq!(universe.fates_in(&joined), expected_join(&universe, &closures[0], &closures[1]));
        // Closing the parts first changes nothing.
        let mut merged = universe.unclosed(&fates[0]);
        merged.merge(&universe.unclosed(&fates[1]));
        merged.close();
        prop_assert_eq!(merged, joined);
    }

    /// `[spec: JOIN-4]`
    #[test]
    fn law_join_is_the_least_upper_bound(triple in states(3, 16, Anchors::Right)) {
        let [a, b, c] = [&triple[0], &triple[1], &triple[2]];
        let joined = a.joined(b);
        prop_assert!(a.is_below(&joined) && b.is_below(&joined));
        let above = joined.joined(c);
        prop_assert!(joined.is_below(&above));
        prop_assert_eq!(a.is_below(c) && b.is_below(c), joined.is_below(c));
        prop_assert_eq!(a.is_below(b) && b.is_below(a), a == b);
        prop_assert!(State::new().is_below(a));
    }

    /// What is known already is merged without a trace: nothing is left to close. `[spec: JOIN-4]` `[spec: CLOSE-1]`
    #[test]
    fn law_what_is_known_needs_no_closure(pair in states(2, 16, Anchors::Any)) {
        let joined = pair[0].joined(&pair[1]);
        for known in pair.iter().chain([&joined]) {
            let mut merged = joined.clone();
            prop_assert!(!merged.merge(known));
            prop_assert_eq!(&merged, &joined);
        }
    }

    /// `[spec: JOIN-3]` `[spec: STATE-3]` `[spec: STATE-6]`
    #[test]
    fn law_join_keeps_states_well_formed_and_removal_final(pair in states(2, 20, Anchors::Right)) {
        let joined = pair[0].joined(&pair[1]);
        prop_assert_eq!(check_well_formed(&joined), Ok(()));
        for before in &pair {
            prop_assert_eq!(invariant::check_removal_is_final(before, &joined), Ok(()));
            prop_assert!(joined.context().includes(before.context()));
        }
        prop_assert_eq!(pair[0].reused_dot(&pair[1]), None);
    }

    /// Even where a dot was used twice, who merges into whom does not matter. `[spec: JOIN-2]`
    #[test]
    fn law_merge_of_reused_dots_is_commutative(left in states(1, 8, Anchors::Right), right in states(1, 8, Anchors::Right)) {
        let (mut one, mut other) = (left[0].clone(), right[0].clone());
        one.merge(&right[0]);
        other.merge(&left[0]);
        prop_assert_eq!(&one, &other);
        let differs = left[0].records().any(|(dot, record)| right[0].get(dot).is_some_and(|held| held != record));
        prop_assert_eq!(left[0].reused_dot(&right[0]).is_some(), differs);
    }
}

fn padded(universe: &Universe, fates: &[Fate]) -> Vec<Fate> {
    let all = fates.iter().copied().chain(std::iter::repeat(Fate::Unseen));
    all.take(universe.records.len()).collect()
}

fn check_semilattice(triple: &[State]) -> Result<(), TestCaseError> {
    let [a, b, c] = [&triple[0], &triple[1], &triple[2]];
    prop_assert_eq!(&a.joined(a), a);
    prop_assert_eq!(a.joined(b), b.joined(a));
    prop_assert_eq!(a.joined(b).joined(c), a.joined(&b.joined(c)));
    Ok(())
}

/// A record of the wrong kind dies, and what somebody dishonest anchored to it must die too, whoever joins first.
/// `[spec: JOIN-3]` `[spec: CLOSE-3]`
#[test]
fn regress_anchor_of_the_wrong_kind_dies() {
    let edge = state("r1.1 edge root -near-> r2.1 @1");
    let write = state("r2.1 write root level=1 @1");
    let death = state("dead r2.1");
    let one_way = edge.joined(&write).joined(&death);
    let other_way = edge.joined(&write.joined(&death));
    assert!(other_way.is_empty());
    assert_eq!(one_way, other_way);
}
