//! The view of any state keeps the invariants, repairs only what is broken, and says so.
use dsr_core::{Dictionary, MutationKind, State, ValueType, VertexId, decode, encode, invariant, view};
use dsr_testkit::{Anchors, Step, Universe, World, cases, dictionary, history, state, states};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::collections::BTreeMap;

/// Open, open with functional and typed names, closed to almost everything.
fn dictionaries() -> [Dictionary; 3] {
    let mut closed = Dictionary { closed: true, ..Dictionary::open().with_functional("in") };
    closed.attributes.insert("a".into(), ValueType::Int);
    [Dictionary::open(), dictionary(), closed]
}

#[track_caller]
fn check(state: &State) {
    for dictionary in dictionaries() {
        let shown = view(state, &dictionary);
        assert_eq!(invariant::check_view(&shown), Ok(()), "{state:#?}");
        assert_eq!(invariant::check_repairs(&shown), Ok(()), "{state:#?}");
    }
}

/// Every state over small universes of competing claims. `[spec: VIEW-1]` `[spec: INV-1]` `[spec: INV-2]`
/// `[spec: INV-3]` `[spec: INV-4]` `[spec: INV-5]` `[spec: INV-6]` `[spec: VIEW-9]` `[spec: VIEW-10]`
#[test]
fn law_invariants_on_every_state_of_small_universes() {
    let universes = [
        // Two kinematic cycles and two parents.
        "r1.1 vertex t a @1
         r2.1 vertex t b @1
         r1.2 edge root -RT-> r1.1 @1
         r1.3 edge r2.1 -RT-> r1.1 @2
         r2.2 edge root -RT-> r2.1 @1
         r2.3 edge r1.1 -RT-> r2.1 @2
         r2.4 write r2.3 a=5 @3
         r2.5 write r2.3 a=text @4",
        // Functional claims, equal keys, one name twice, a link that is the only path.
        "r1.1 vertex t a @1
         r2.1 vertex t a @1
         r1.2 edge r1.1 -in-> root @1
         r1.3 edge r1.1 -in-> r2.1 @1
         r2.2 edge r1.1 -in-> r2.1 @2
         r2.3 edge r2.1 -near-> r1.1 @2
         r2.4 edge r2.1 -RT-> r1.1 @3",
    ];
    let mut count = 0;
    for text in universes {
        for state in Universe::of(&state(text)).all_states() {
            check(&state);
            count += 1;
        }
    }
    println!("{count} states");
    assert!(count > 1000, "{count}");
}

proptest! {
    #![proptest_config(cases(8000))]

    /// `[spec: VIEW-1]` `[spec: VIEW-9]` `[spec: VIEW-10]`
    #[test]
    fn law_invariants_on_any_state(state in states(1, 24, Anchors::Right)) {
        check(&state[0]);
    }

    /// Not even dishonest anchors break a view. `[spec: VIEW-1]`
    #[test]
    fn law_invariants_whatever_the_anchors(state in states(1, 16, Anchors::Any)) {
        check(&state[0]);
    }

    /// The view depends on the state alone, not on how it came about. `[spec: VIEW-1]`
    #[test]
    fn law_views_are_deterministic(pair in states(2, 20, Anchors::Right)) {
        let dictionary = dictionary();
        let joined = pair[0].joined(&pair[1]);
        let read = decode(&encode(&pair[1].joined(&pair[0]))).unwrap();
        prop_assert_eq!(format!("{:?}", view(&joined, &dictionary)), format!("{:?}", view(&read, &dictionary)));
    }

    /// Look-ups agree with the lists. `[spec: VIEW-2]` `[spec: VIEW-4]` `[spec: VIEW-7]` `[spec: VIEW-8]`
    #[test]
    fn oracle_look_ups_find_what_the_lists_show(state in states(1, 20, Anchors::Right)) {
        let dictionary = dictionary();
        let shown = view(&state[0], &dictionary);
        for edge in shown.edges() {
            prop_assert_eq!(shown.edge_by_key(&edge.edge.key()), Some(*edge));
            prop_assert!(shown.shows_edge(edge.id));
        }
        for &from in shown.vertices() {
            let out: Vec<_> = shown.edges().iter().filter(|edge| edge.edge.from == from).copied().collect();
            prop_assert_eq!(shown.edges_from(from), &out[..]);
            prop_assert!(shown.has_vertex(from));
            let last = shown.ancestors(from).last();
            prop_assert_eq!(last.is_some(), shown.in_tree(from));
            if let Some(vertex) = shown.vertex(from) {
                let oldest = shown.vertices().iter().filter_map(|&id| shown.vertex(id).map(|v| (v.stamp, id, &v.name)));
                let oldest = oldest.filter(|found| *found.2 == vertex.name).min();
                prop_assert_eq!(shown.vertex_by_name(&vertex.name), oldest.map(|found| found.1));
            }
        }
        for &(dot, write) in shown.writes() {
            let register = shown.attribute_writes(write.target, &write.name);
            let rank = |&(dot, write): &(_, &dsr_core::Write)| (write.stamp, dot);
            prop_assert!(register.iter().any(|found| found.0 == dot));
            prop_assert_eq!(shown.attribute(write.target, &write.name), register.iter().copied().max_by_key(rank));
        }
    }

    /// A replica alone never sees a repair. `[spec: VIEW-10]`
    #[test]
    fn law_a_lone_replica_sees_no_repair(steps in proptest::collection::vec(history::step(1), 0..25)) {
        let mut world = World::new(1, dictionary());
        for step in &steps {
            world.step(step);
            let shown = view(&world.states[0], &world.dictionary);
            prop_assert_eq!(shown.repairs(), &[]);
            prop_assert_eq!(shown.stranded(), &[] as &[VertexId]);
        }
    }
}

/// The sampling above reaches every kind of repair, and a lone replica gets every mutation through: the laws
/// are not checked on nothing.
#[test]
fn law_samples_reach_every_repair_and_every_mutation() {
    let mut runner = TestRunner::deterministic();
    let mut repairs: BTreeMap<&str, usize> = BTreeMap::new();
    let mut unrepaired = 0;
    let strategy = states(1, 24, Anchors::Right);
    for _ in 0..2000 {
        let sample = strategy.new_tree(&mut runner).unwrap().current();
        let [_, _, dictionary] = dictionaries();
        let shown = view(&sample[0], &dictionary);
        unrepaired += usize::from(shown.repairs().is_empty() && shown.vertices().len() > 1);
        shown.repairs().iter().for_each(|repair| *repairs.entry(repair.kind()).or_default() += 1);
    }
    println!("{repairs:?}, {unrepaired} of 2000 need none");
    assert_eq!(repairs.len(), 8, "{repairs:?}");
    assert!(unrepaired > 10 && repairs.values().all(|&count| count > 10), "{repairs:?}");

    let mut mutations: BTreeMap<MutationKind, usize> = BTreeMap::new();
    let steps = proptest::collection::vec(history::step(1), 25);
    for _ in 0..100 {
        let mut world = World::new(1, dictionary());
        for step in steps.new_tree(&mut runner).unwrap().current() {
            let before = world.sent.len();
            world.step(&step);
            if let (Step::Mutate { kind, .. }, true) = (step, world.sent.len() > before) {
                *mutations.entry(kind).or_default() += 1;
            }
        }
    }
    println!("{mutations:?}");
    assert!(mutations.len() == 6 && mutations.values().all(|&count| count > 10), "{mutations:?}");
}
