//! The six mutations on any state, reachable or not: inflationary, exact in what they touch, refused without
//! a trace, and shown at once.
use dsr_core::{
    AttributeMap, Author, Delta, Dot, EdgeKey, Mutation, MutationKind, Record, ReplicaId, State, View,
    check_well_formed, decode, encode, invariant, view,
};
use dsr_testkit::{Anchors, History, World, candidates, cases, dictionary, histories, states};
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::collections::BTreeMap;

/// All laws of one mutation on one state; whether it was enabled.
fn check(state: &State, author: Author, mutation: &Mutation) -> Result<bool, TestCaseError> {
    let dictionary = dictionary();
    let before = view(state, &dictionary);
    let untouched = state.clone();
    let result = mutation.delta(&before, author);
    // MUT-0: refused or not, the state that was looked at is as it was, and the answer is the same again.
    prop_assert_eq!(state, &untouched);
    prop_assert_eq!(&mutation.delta(&before, author), &result);
    let delta = match result {
        Ok(delta) => delta,
        Err(refusal) => {
            prop_assert!(refusal.to_string().starts_with(mutation.kind().name()));
            return Ok(false);
        }
    };
    check_delta(state, author, mutation, &delta)?;
    let after_state = state.joined(&delta);
    prop_assert_eq!(check_well_formed(&after_state), Ok(()));
    // L2: inflationary; the delta is below what it leads to, so repeating it changes nothing.
    prop_assert!(state.is_below(&after_state) && delta.is_below(&after_state));
    prop_assert_eq!(&after_state.joined(&delta), &after_state);
    prop_assert_eq!(&delta.joined(state), &after_state);
    prop_assert_eq!(decode(&encode(&delta)), Ok(delta.clone()));
    let after = view(&after_state, &dictionary);
    prop_assert_eq!(invariant::check_view(&after), Ok(()));
    check_effect(&before, &after, author, mutation)?;
    Ok(true)
}

/// What the delta holds and kills: `[spec: MUT-0.1]` `[spec: MUT-0.2]`.
fn check_delta(
    state: &State,
    author: Author,
    mutation: &Mutation,
    delta: &Delta,
) -> Result<(), TestCaseError> {
    prop_assert_eq!(check_well_formed(delta), Ok(()));
    prop_assert!(!delta.context().is_empty(), "a delta that does nothing");
    let next = state.next_dot(author.replica).unwrap();
    for (at, (dot, record)) in (0_u64..).zip(delta.records()) {
        prop_assert_eq!(dot, Dot::new(author.replica, next.sequence + at), "fresh, without gap");
        prop_assert_eq!(record.stamp(), state.greatest_stamp() + 1, "above every stamp held");
        if let Record::Write(write) = record {
            prop_assert_eq!(write.timestamp_ns, author.timestamp_ns);
        }
    }
    for dot in delta.context().runs().flat_map(dsr_core::Run::dots) {
        prop_assert!(delta.holds(dot) || state.holds(dot), "{} is neither made nor killed", dot);
    }
    let makes =
        matches!(mutation.kind(), MutationKind::AddVertex | MutationKind::AddEdge | MutationKind::MoveEdge);
    prop_assert!(!makes || !delta.is_empty());
    let removes = matches!(mutation.kind(), MutationKind::RemoveEdge | MutationKind::RemoveVertex);
    prop_assert!(!removes || delta.is_empty());
    Ok(())
}

/// V3, at once: the view shows what the mutation says. `[spec: INTENT-1]`
fn check_effect(
    before: &View<'_>,
    after: &View<'_>,
    author: Author,
    mutation: &Mutation,
) -> Result<(), TestCaseError> {
    match mutation {
        Mutation::AddVertex { vertex, link } => {
            let new = dsr_core::VertexId(before.state().next_dot(author.replica).unwrap());
            prop_assert_eq!(after.vertex_by_name(&vertex.name), Some(new));
            prop_assert_eq!(after.vertex(new).map(|record| &record.vertex_type), Some(&vertex.vertex_type));
            prop_assert_eq!(attributes_of(after, new.0), vertex.attributes.clone());
            let (from, to) = if link.outgoing { (new, link.other) } else { (link.other, new) };
            check_new_edge(
                before,
                after,
                &EdgeKey { from, to, label: link.label.clone() },
                &link.attributes,
            )?;
        }
        Mutation::AddEdge { key, attributes } => check_new_edge(before, after, key, attributes)?,
        Mutation::MoveEdge { from, to, attributes } => {
            prop_assert!(after.edge_by_key(from).is_none());
            check_new_edge(before, after, to, attributes)?;
        }
        Mutation::UpdateAttributes { target, updates } => {
            for (name, value) in updates {
                let shown = after.attribute(*target, name).map(|(_, write)| &write.value);
                prop_assert_eq!(shown, value.as_ref());
                prop_assert_eq!(after.attribute_writes(*target, name).len(), usize::from(value.is_some()));
            }
        }
        Mutation::RemoveEdge { key } => prop_assert!(after.edge_by_key(key).is_none()),
        Mutation::RemoveVertex { vertex } => prop_assert!(!after.has_vertex(*vertex)),
    }
    // Nothing that the author could see is stranded, and everything else that was there still is.
    prop_assert!(
        after
            .stranded()
            .iter()
            .all(|vertex| before.stranded().contains(vertex) || before.vertex(*vertex).is_none())
    );
    let removed = |vertex| matches!(mutation, Mutation::RemoveVertex { vertex: gone } if *gone == vertex);
    prop_assert!(before.vertices().iter().all(|&vertex| after.has_vertex(vertex) != removed(vertex)));
    Ok(())
}

fn attributes_of(view: &View<'_>, element: Dot) -> AttributeMap {
    view.attributes_of(element).map(|(_, write)| (write.name.clone(), write.value.clone())).collect()
}

fn check_new_edge(
    before: &View<'_>,
    after: &View<'_>,
    key: &EdgeKey,
    attributes: &AttributeMap,
) -> Result<(), TestCaseError> {
    let shown = after.edge_by_key(key);
    prop_assert!(shown.is_some(), "{} is not shown", key);
    let id = shown.unwrap().id;
    prop_assert!(before.state().get(id.0).is_none(), "a new instance");
    prop_assert_eq!(&attributes_of(after, id.0), attributes);
    Ok(())
}

/// One of the universe's authors, or a newcomer: r4 is where dots lie that never come.
fn authors() -> impl Strategy<Value = Author> {
    (prop::sample::select(vec![1, 2, 3, 5]), any::<u64>())
        .prop_map(|(agent, timestamp_ns)| Author { replica: ReplicaId::agent(agent), timestamp_ns })
}

proptest! {
    #![proptest_config(cases(6000))]

    /// On states of hostile shape. `[spec: MUT-0]` `[spec: MUT-0.1]` `[spec: MUT-0.2]` `[spec: INTENT-1]`
    /// `[spec: STAMP-1]` `[spec: STAMP-3]`
    #[test]
    fn law_mutations_on_any_state(
        state in states(1, 16, Anchors::Right),
        author in authors(),
        choices in proptest::collection::vec(any::<Index>(), 24),
    ) {
        // Every author knows all that it ever did: universes end at sequence 6.
        let own = State::assemble([], [1, 2, 3].map(|agent| Dot::new(ReplicaId::agent(agent), 7)).into_iter().collect());
        let state = state[0].joined(&own);
        let dictionary = dictionary();
        let view = view(&state, &dictionary);
        for kind in MutationKind::ALL {
            let candidates = candidates(&view, kind);
            for choice in choices.iter().filter(|_| !candidates.is_empty()).take(4) {
                check(&state, author, choice.get(&candidates))?;
            }
        }
    }

    /// Deltas compose: one author's deltas joined are the delta of all its mutations. `[spec: MUT-0.4]`
    #[test]
    fn law_delta_groups_compose(state in states(1, 12, Anchors::Right), choices in proptest::collection::vec((0..6_usize, any::<usize>()), 1..4)) {
        let dictionary = dictionary();
        let author = Author::new(ReplicaId::agent(5));
        let (mut one_by_one, mut group) = (state[0].clone(), Delta::new());
        for (kind, choice) in choices {
            let picked = dsr_testkit::pick(&view(&one_by_one, &dictionary), author, MutationKind::ALL[kind], choice);
            if let Some(mutation) = picked {
                let delta = mutation.delta(&view(&one_by_one, &dictionary), author).unwrap();
                one_by_one.join(&delta);
                group.join(&delta);
            }
        }
        prop_assert_eq!(state[0].joined(&group), one_by_one);
        prop_assert_eq!(check_well_formed(&group), Ok(()));
    }
}

/// All concrete mutations of replicas after short histories: every candidate, not a sample.
/// `[spec: MUT-0]` `[spec: INTENT-1]`
#[test]
fn law_every_candidate_after_sampled_histories() {
    let mut runner = TestRunner::deterministic();
    let strategy = histories(3, 14);
    let mut counts: BTreeMap<(MutationKind, bool), usize> = BTreeMap::new();
    for _ in 0..60 {
        let history: History = strategy.new_tree(&mut runner).unwrap().current();
        let mut world = World::new(history.replicas, dictionary());
        history.run::<()>(&mut world, |_, _| Ok(())).unwrap();
        for (replica, state) in world.states.iter().enumerate() {
            let dictionary = dictionary();
            for kind in MutationKind::ALL {
                for mutation in candidates(&view(state, &dictionary), kind) {
                    let enabled = check(state, world.author(replica), &mutation).unwrap();
                    *counts.entry((kind, enabled)).or_default() += 1;
                }
            }
        }
    }
    println!("{counts:?}");
    assert!(
        counts.len() == 12 && counts.values().all(|&count| count > 5),
        "each both enabled and refused: {counts:?}"
    );
}
