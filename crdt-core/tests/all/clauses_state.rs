//! Identity, context, state, well-formedness, join and closure.

use crate::clauses_common::history::{history, part, parts};
use crate::clauses_common::*;
use dsr_core::{
    CausalContext, Delta, Dictionary, Dot, Edge, Malformed, Record, ReplicaId, Run, State, Value, Vertex,
    VertexId, Write, check_well_formed, limits,
};
use std::collections::BTreeSet;

fn dot(agent: u32, sequence: u64) -> Dot {
    Dot::new(ReplicaId::agent(agent), sequence)
}

/// A state of records, with a context of their dots and some more.
fn state(records: &[(Dot, Record)], seen: &[Dot]) -> State {
    let context = records.iter().map(|(dot, _)| *dot).chain(seen.iter().copied()).collect();
    State::assemble(records.iter().cloned(), context)
}

fn vertex(name: &str, stamp: u64) -> Record {
    Record::Vertex(Vertex { vertex_type: "thing".into(), name: name.into(), external_id: None, stamp })
}

fn link(from: Dot, label: &str, to: Dot) -> Record {
    Record::Edge(Edge { from: VertexId(from), to: VertexId(to), label: label.into(), stamp: 1 })
}

fn write(target: Dot, value: Value) -> Record {
    Record::Write(Write { target, name: "light".into(), value, timestamp_ns: 0, stamp: 1 })
}

fn all_dots(context: &CausalContext) -> BTreeSet<Dot> {
    context.runs().flat_map(Run::dots).collect()
}

/// 0 unseen, 1 held, 2 dead.
fn condition(state: &State, dot: Dot) -> u8 {
    if state.holds(dot) {
        1
    } else if state.is_dead(dot) {
        2
    } else {
        0
    }
}

/// [spec: ID-1] [spec: ID-3]
#[test]
fn law_the_next_dot_follows_the_greatest_seen_over_gaps() {
    let seen = |dots: &[Dot]| State::assemble([], dots.iter().copied().collect());
    let one = ReplicaId::agent(1);
    assert_eq!(seen(&[]).next_dot(one), Some(dot(1, 1)));
    assert_eq!(seen(&[dot(1, 1), dot(1, 2), dot(2, 9)]).next_dot(one), Some(dot(1, 3)));
    assert_eq!(seen(&[dot(1, 1), dot(1, 7)]).next_dot(one), Some(dot(1, 8)), "2 to 6 are events that wait");
    let later = one.next_incarnation().unwrap();
    assert_eq!(seen(&[dot(1, 7)]).next_dot(later), Some(Dot::new(later, 1)));
}

/// [spec: ID-1]
#[test]
fn law_dots_are_ordered_by_agent_incarnation_sequence() {
    let of = |text: &str| text.parse::<Dot>().unwrap();
    let ascending = ["r0.9", "r1.1", "r1.2", "r1.10", "r1+1.1", "r1+2.1", "r2.1"].map(of);
    assert!(ascending.is_sorted_by(|l, r| l < r));
}

/// [spec: ID-2]
#[test]
fn law_equal_names_and_keys_are_different_elements() {
    let peer = concurrent(&Peer::new(1), &child(ROOT, "chair"), &child(ROOT, "chair"));
    assert_eq!(peer.view().vertices().len(), 3);
}

/// [spec: CRASH-2]
#[test]
fn law_a_fresh_incarnation_has_dots_of_its_own() {
    let mut before = Peer::new(1);
    before.child(ROOT, "kitchen");
    let mut after = Peer::new(1);
    after.author.replica = before.author.replica.next_incarnation().unwrap();
    assert_eq!(after.author.replica.to_string(), "r1+1");
    after.child(ROOT, "hall");
    assert_eq!(before.state.reused_dot(&after.state), None);
    let both = met(&before, &after);
    assert_eq!(both.view().vertices().len(), 3);
    let last = ReplicaId { agent: 1, incarnation: u32::MAX };
    assert_eq!(last.next_incarnation(), None);
}

/// The counterexample of the specification: after a reuse the order of delivery shows, and the reuse can be
/// named. [spec: CRASH-3] [spec: JOIN-2]
#[test]
fn regress_a_reused_dot_breaks_association() {
    let mut base = Peer::new(1);
    let lamp = base.child(ROOT, "lamp");
    let (mut one, mut other, mut remover) = (base.clone(), base.clone(), base.fork(2));
    let edge = one.apply(&edge(lamp, "near", ROOT));
    let write = other.apply(&set(of(ROOT), "map", 1_i32));
    let death = remover.apply(&destroy(lamp));
    assert_eq!(one.state.reused_dot(&other.state), Some(dot(1, 3)));
    assert_eq!(other.state.reused_dot(&one.state), Some(dot(1, 3)));
    assert_eq!(one.state.reused_dot(&remover.state), None);

    assert_eq!(edge.joined(&write), write.joined(&edge), "the greater record, whoever merges into whom");
    assert!(edge.joined(&write).write(dot(1, 3)).is_some());
    let left = edge.joined(&death).joined(&write);
    let right = edge.joined(&death.joined(&write));
    assert!(left.is_dead(dot(1, 3)) && right.holds(dot(1, 3)));
}

/// [spec: CTX-1] [spec: CTX-3] [spec: STATE-4]
#[test]
fn oracle_contexts_of_states_are_sets_of_dots() {
    let states = parts(&history([1, 2]));
    for x in &states {
        assert!(!x.context().contains(VertexId::ROOT.0) && !x.is_dead(VertexId::ROOT.0));
        for y in states.iter().step_by(7) {
            let (left, right) = (all_dots(x.context()), all_dots(y.context()));
            assert_eq!(all_dots(x.joined(y).context()), &left | &right);
            assert_eq!(x.context().includes(y.context()), left.is_superset(&right));
        }
    }
}

/// [spec: CTX-2] [spec: CTX-4]
#[test]
fn law_a_context_is_compact() {
    let mut context: CausalContext = [dot(1, 4), dot(1, 2), dot(1, 1)].into_iter().collect();
    assert_eq!(context.vector().collect::<Vec<_>>(), [(ReplicaId::agent(1), 2)]);
    let run = |first, last| Run { replica: ReplicaId::agent(1), first, last };
    assert_eq!(context.cloud_runs().collect::<Vec<_>>(), [run(4, 4)]);
    assert_eq!(context.runs().collect::<Vec<_>>(), [run(1, 2), run(4, 4)]);
    context.insert(dot(1, 3));
    assert_eq!(context.vector().collect::<Vec<_>>(), [(ReplicaId::agent(1), 4)]);
    assert_eq!(context.cloud_runs().count(), 0);
    let mut again = CausalContext::new();
    context.runs().for_each(|run| again.insert_run(run));
    assert_eq!(again, context);
}

/// [spec: STATE-1] [spec: STATE-2]
#[test]
fn law_records_are_anchored_to_what_they_need() {
    let anchors = |record: Record| record.anchors().collect::<Vec<_>>();
    assert_eq!(anchors(vertex("a", 1)), []);
    assert_eq!(anchors(link(dot(1, 1), "near", dot(1, 2))), [dot(1, 1), dot(1, 2)]);
    assert_eq!(anchors(link(VertexId::ROOT.0, "RT", dot(1, 2))), [VertexId::ROOT.0, dot(1, 2)]);
    assert_eq!(anchors(write(dot(1, 3), Value::Int(1))), [dot(1, 3)]);
}

/// [spec: STATE-3] [spec: JOIN-1]
#[test]
fn oracle_merge_is_the_maximum_of_unseen_held_dead() {
    let deltas = history([1, 2]);
    let states = parts(&deltas);
    let dots = all_dots(part(&deltas, usize::MAX >> 1).context());
    for x in &states {
        for y in states.iter().step_by(3) {
            let mut merged = x.clone();
            merged.merge(y);
            let joined = x.joined(y);
            for &dot in &dots {
                assert_eq!(condition(&merged, dot), condition(x, dot).max(condition(y, dot)));
                assert!(condition(&joined, dot) >= condition(&merged, dot), "closure moves only forwards");
                assert!(joined.get(dot).is_none_or(|record| x.get(dot).or(y.get(dot)) == Some(record)));
            }
        }
    }
}

/// [spec: STATE-4] [spec: STATE-6] [spec: CTX-2]
#[test]
fn law_nothing_is_kept_of_what_is_dead() {
    let mut peer = Peer::new(1);
    let room = peer.child(ROOT, "room");
    for light in 0..100 {
        peer.apply(&set(of(room), "light", light));
    }
    assert_eq!(peer.state.len(), 3, "the vertex, its link, the last write");
    assert_eq!(peer.state.context().cloud_runs().count(), 0);
    peer.apply(&destroy(room));
    assert!(peer.state.is_empty());
    assert_eq!(peer.state.context().runs().count(), 1);
    assert_eq!(peer.view().vertices(), [ROOT]);
    assert_eq!(peer.view().vertex_by_name("root"), Some(ROOT));
    assert_eq!(peer.view().vertex_by_name("world"), Some(ROOT));
}

/// [spec: JOIN-3] [spec: JOIN-4]
#[test]
fn law_join_is_associative_commutative_idempotent() {
    let states = parts(&history([1, 2]));
    assert!(states.len() > 100, "{}", states.len());
    let sample: Vec<&State> = states.iter().step_by(97).collect();
    for x in &states {
        assert_eq!(x.joined(x), *x);
        assert_eq!(x.joined(&State::new()), *x);
        assert!(State::new().is_below(x));
        for y in &states {
            let joined = x.joined(y);
            assert_eq!(joined, y.joined(x));
            check_well_formed(&joined).unwrap();
            assert!(x.is_below(&joined));
            assert_eq!(x.is_below(y), joined == *y);
            for z in &sample {
                assert_eq!(joined.joined(z), x.joined(&y.joined(z)));
            }
        }
    }
}

/// [spec: JOIN-5]
#[test]
fn law_order_repetition_and_grouping_do_not_matter() {
    let deltas: Vec<Delta> = history([1, 2]);
    for mask in 0..1 << deltas.len() {
        let chosen: Vec<&Delta> =
            deltas.iter().enumerate().filter(|(at, _)| mask >> at & 1 == 1).map(|(_, delta)| delta).collect();
        let forwards = part(&deltas, mask);
        let mut backwards = State::new();
        chosen.iter().rev().chain(&chosen).for_each(|delta| backwards.join(delta));
        let (left, right) = chosen.split_at(chosen.len() / 2);
        let group = |deltas: &[&Delta]| deltas.iter().fold(State::new(), |group, delta| group.joined(delta));
        assert_eq!(forwards, backwards);
        assert_eq!(forwards, group(left).joined(&group(right)));
    }
}

/// [spec: CLOSE-1] [spec: CLOSE-3] [spec: CLOSE-4]
#[test]
fn oracle_closure_takes_what_is_anchored_to_the_dead_and_leaves_what_waits() {
    let records = [
        (dot(1, 2), link(dot(1, 1), "near", dot(1, 9))),
        (dot(1, 3), write(dot(1, 2), Value::Int(1))),
        (dot(1, 4), link(dot(1, 8), "near", dot(1, 9))),
    ];
    let mut closed = state(&records, &[dot(1, 1)]);
    closed.close();
    assert!(closed.is_dead(dot(1, 2)) && closed.is_dead(dot(1, 3)), "the edge, then its write");
    assert!(closed.holds(dot(1, 4)), "r1.8 and r1.9 have not been seen: it waits");
    closed.join(&state(&[], &[dot(1, 9)]));
    assert!(closed.is_dead(dot(1, 4)), "an anchor that arrives dead");
}

/// [spec: CLOSE-2]
#[test]
fn law_closure_is_a_closure_operator() {
    // Merges of parts are not closed: a removal meets what hung from the removed.
    let states = parts(&history([1, 2]));
    let closed = |state: &State| {
        let mut closed = state.clone();
        closed.close();
        closed
    };
    let merged = |x: &State, y: &State| {
        let mut merged = x.clone();
        merged.merge(y);
        merged
    };
    let mut open = 0;
    for x in states.iter().step_by(5) {
        for y in &states {
            let both = merged(x, y);
            open += usize::from(closed(&both) != both);
            assert_eq!(closed(&closed(&both)), closed(&both));
            for z in states.iter().step_by(23) {
                assert_eq!(closed(&merged(&closed(&both), z)), closed(&merged(&both, z)));
            }
        }
    }
    assert!(open > 0, "some merge was not closed");
}

/// [spec: WF-1] [spec: WF-2] [spec: WF-3] [spec: WF-4] [spec: WF-5] [spec: WF-6]
#[test]
fn oracle_each_fault_of_form_is_named() {
    let (a, b, c) = (dot(1, 1), dot(1, 2), dot(1, 3));
    let two = || [(a, vertex("a", 1)), (b, vertex("b", 1))];
    let with = |record: Record| {
        let [first, second] = two();
        state(&[first, second, (c, record)], &[])
    };
    let odd = Value::Float(f32::from_bits(0x7fc0_0001));
    let large = Value::ByteVec(vec![0; limits::VALUE_BYTES_MAX + 1].into());
    let mut late = CausalContext::new();
    late.insert(dot(3, limits::SEQUENCE_MAX + 1));
    let cases = [
        (State::assemble(two(), CausalContext::new()), Malformed::HeldUnseen { dot: a }),
        (state(&[(c, link(a, "near", b))], &[a]), Malformed::NotClosed { dot: c, anchor: a }),
        (
            state(&[(c, write(c, Value::Int(1)))], &[]),
            Malformed::WrongAnchor { dot: c, anchor: c, expected: "vertex or edge" },
        ),
        (state(&[(a, write(VertexId::ROOT.0, Value::Int(1))), (c, link(a, "near", b))], &[]), {
            Malformed::WrongAnchor { dot: c, anchor: a, expected: "vertex" }
        }),
        (with(link(dot(7, 0), "near", a)), Malformed::NoSuchAnchor { dot: c, anchor: dot(7, 0) }),
        (with(link(a, "near", a)), Malformed::SelfLoop { dot: c, vertex: a }),
        (with(link(a, "RT", VertexId::ROOT.0)), Malformed::IntoRoot { dot: c }),
        (with(link(a, "", b)), Malformed::NameLength { dot: c, bytes: 0 }),
        (with(vertex(&"n".repeat(256), 1)), Malformed::NameLength { dot: c, bytes: 256 }),
        (with(vertex("c", 0)), Malformed::Stamp { dot: c, stamp: 0 }),
        (with(vertex("c", limits::STAMP_MAX + 1)), {
            Malformed::Stamp { dot: c, stamp: limits::STAMP_MAX + 1 }
        }),
        (with(write(a, large)), Malformed::ValueSize { dot: c, bytes: limits::VALUE_BYTES_MAX + 1 }),
        (with(write(a, odd)), Malformed::Nan { dot: c }),
        (State::assemble([], late), {
            Malformed::Sequence { replica: ReplicaId::agent(3), sequence: limits::SEQUENCE_MAX + 1 }
        }),
    ];
    let mut kinds = BTreeSet::new();
    for (state, expected) in cases {
        // The name in the chapter, which is what other languages report.
        let variant = format!("{expected:?}");
        assert_eq!(variant.split(' ').next(), Some(expected.kind()));
        assert!(include_str!("../../../spec/wellformed.md").contains(&format!("`{}`", expected.kind())));
        kinds.insert(expected.kind());
        assert_eq!(check_well_formed(&state), Err(expected));
    }
    assert_eq!(kinds.len(), 11, "every fault has a case");
    check_well_formed(&with(link(a, "near", VertexId::ROOT.0))).unwrap();
    let full = Value::ByteVec(vec![0; limits::VALUE_BYTES_MAX].into());
    check_well_formed(&with(write(a, full))).unwrap();
    check_well_formed(&with(vertex(&"n".repeat(limits::NAME_BYTES_MAX), limits::STAMP_MAX))).unwrap();
    let mut last = CausalContext::new();
    last.insert(dot(3, limits::SEQUENCE_MAX));
    check_well_formed(&State::assemble([], last)).unwrap();
    check_well_formed(&with(write(a, Value::Float(f32::NAN).with_canonical_nans()))).unwrap();
}

/// A join of well-formed states whose authors guessed at dots. It is still joined and viewed.
/// [spec: WF-3] [spec: VIEW-1.1]
#[test]
fn regress_a_guessed_anchor_is_found_by_no_one_alone() {
    let guess = state(&[(dot(2, 1), link(dot(1, 1), "near", VertexId::ROOT.0))], &[]);
    let truth = state(&[(dot(1, 1), write(VertexId::ROOT.0, Value::Int(1)))], &[]);
    check_well_formed(&guess).unwrap();
    check_well_formed(&truth).unwrap();
    let joined = guess.joined(&truth);
    assert!(matches!(check_well_formed(&joined), Err(Malformed::WrongAnchor { .. })));
    let dictionary = Dictionary::open();
    let view = dsr_core::view(&joined, &dictionary);
    assert_eq!(view.edges(), []);
    dsr_core::invariant::check_view(&view).unwrap();
}
