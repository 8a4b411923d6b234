//! The published semantics of whole replicas, rule by rule.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that cannot go on has failed"
)]

mod published_common;

use dsr_model::published::{
    Attribute, Crash, Message, Node, NodeName, Operation, Payload, Register, Replica, Stamps, Value, Variant,
    Workers,
};
use published_common::{counters, dot, number, of};
use std::collections::{BTreeMap, BTreeSet};

#[test]
fn oracle_nodes_compare_without_name_and_agent() {
    let node = |name, agent| Node {
        id: 1,
        kind: "room",
        name: NodeName::Given(name),
        agent,
        attributes: BTreeMap::new(),
        edges: BTreeMap::new(),
    };
    assert!(node("a", 1).same_value(&node("b", 2)));
    assert!(!node("a", 1).same_value(&Node { kind: "door", ..node("a", 1) }));
}

fn replica(agent: u32, variant: Variant) -> Replica {
    Replica::new(agent, variant, BTreeSet::new())
}

#[track_caller]
fn call(replica: &mut Replica, operation: Operation, time: u64) -> Vec<Message> {
    replica.call(&operation, time).unwrap().expect("enabled")
}

const fn insert(id: u32, name: &'static str) -> Operation {
    Operation::InsertNode { id, kind: "thing", name, attributes: &[("x", 1)] }
}

const fn link(from: u32, to: u32) -> Operation {
    Operation::AssignEdge { from, to, kind: "in", attributes: &[("p", 1)] }
}

const SET: Operation = Operation::Set { node: 1, key: "x", value: 2 };

fn x(replica: &Replica) -> Option<Value> {
    replica.attribute(1, "x").map(|held| held.value)
}

#[test]
fn oracle_what_travels_inside_a_node_keeps_its_dot_only() {
    let mut a = replica(1, Variant::STAMPED);
    call(&mut a, insert(1, "n"), 10);
    call(&mut a, SET, 20);
    let Message::Graph { nodes, .. } = a.snapshot(30) else { panic!("a graph") };
    let inside = &nodes[&1].value().unwrap().attributes["x"];
    assert_eq!((counters(inside), number(inside)), ((Some(2), vec![]), Some(2)));
}

#[test]
fn oracle_own_messages_are_passed_over() {
    let mut a = replica(1, Variant::STAMPED);
    let sent = call(&mut a, insert(1, "n"), 10);
    let mut again = replica(1, Variant::STAMPED);
    again.receive(&sent[0]).unwrap();
    assert!(again.nodes.is_empty());
}

/// The removal of an attribute says that it is from whoever made the node, who passes it over.
#[test]
fn oracle_removals_are_signed_by_the_author_of_the_node() {
    for (variant, kept) in [(Variant::STAMPED, true), (Variant::UPSTREAM, false)] {
        let (mut a, mut b) = (replica(1, variant), replica(2, variant));
        for sent in call(&mut a, insert(1, "n"), 10) {
            b.receive(&sent).unwrap();
        }
        for sent in call(&mut b, Operation::Remove { node: 1, key: "x" }, 20) {
            a.receive(&sent).unwrap();
        }
        assert_eq!((x(&a).is_some(), x(&b)), (kept, None));
    }
}

/// What was held back is taken in only if its clock is later than the node's.
#[test]
fn oracle_what_waited_is_taken_in_if_its_clock_is_later() {
    for (write, taken) in [(9, 1), (10, 1), (11, 2)] {
        let (mut a, mut b) = (replica(1, Variant::STAMPED), replica(2, Variant::STAMPED));
        let node = call(&mut a, insert(1, "n"), 10);
        let set = call(&mut a, SET, write);
        b.receive(&set[0]).unwrap();
        assert_eq!(b.buffers.node_attributes.len(), 1);
        b.receive(&node[0]).unwrap();
        assert!(b.buffers.node_attributes.is_empty());
        assert_eq!(x(&b), Some(Value::Number(taken)), "written at {write}");
    }
}

/// The buffer keeps the clock of the first delta, so a later one is dropped with it.
#[test]
fn oracle_what_waits_keeps_its_first_clock() {
    let (mut a, mut b) = (replica(1, Variant::STAMPED), replica(2, Variant::STAMPED));
    let node = call(&mut a, insert(1, "n"), 10);
    let early = call(&mut a, SET, 9);
    let late = call(&mut a, Operation::Set { node: 1, key: "x", value: 3 }, 11);
    for message in early.iter().chain(&late).chain(&node) {
        b.receive(message).unwrap();
    }
    assert_eq!(x(&b), Some(Value::Number(1)));
}

#[test]
fn oracle_edges_wait_for_their_ends() {
    let (mut a, mut b) = (replica(1, Variant::STAMPED), replica(2, Variant::STAMPED));
    let first = call(&mut a, insert(1, "f"), 10);
    let second = call(&mut a, insert(2, "t"), 20);
    let edge = call(&mut a, link(1, 2), 30);
    b.receive(&edge[0]).unwrap();
    assert_eq!((b.buffers.edges_from.len(), b.buffers.edges_to.len()), (1, 0));
    // Taken in with its start, before its end is known.
    b.receive(&first[0]).unwrap();
    assert!(b.edge((1, 2, "in")).is_some() && b.buffers.edges_from.is_empty());
    let mut c = replica(3, Variant::STAMPED);
    for message in [&first, &edge] {
        c.receive(&message[0]).unwrap();
    }
    assert_eq!((c.buffers.edges_from.len(), c.buffers.edges_to.len()), (0, 1));
    c.receive(&second[0]).unwrap();
    assert!(c.edge((1, 2, "in")).is_some() && c.buffers.edges_to.is_empty());
}

#[test]
fn oracle_the_fork_drops_every_edge_that_waits_for_a_start() {
    for (workers, waiting) in [(Workers::Several, 1), (Workers::One, 0)] {
        let variant = Variant { workers, stamps: Stamps::Author };
        let (mut a, mut b) = (replica(1, variant), replica(2, variant));
        for (at, (id, name)) in [(1, "f"), (2, "t"), (3, "u")].into_iter().enumerate() {
            call(&mut a, insert(id, name), at as u64);
        }
        let waits = call(&mut a, link(1, 2), 10);
        let gone = call(&mut a, Operation::DeleteNode { node: 3 }, 20);
        b.receive(&waits[0]).unwrap();
        b.receive(&gone[0]).unwrap();
        let deleted =
            Message::Edge { sender: 1, time: 30, from: 1, to: 3, kind: "in", delta: Register::default() };
        b.receive(&deleted).unwrap();
        assert_eq!(b.buffers.edges_from.len(), waiting, "{workers:?}");
    }
}

#[test]
fn oracle_a_node_goes_with_the_edges_that_the_index_knows() {
    let mut a = replica(1, Variant::STAMPED);
    for operation in [insert(1, "f"), insert(2, "t"), link(1, 2)] {
        call(&mut a, operation, 10);
    }
    let sent = call(&mut a, Operation::DeleteNode { node: 2 }, 20);
    assert!(matches!(&sent[..], [Message::Node { id: 2, .. }, Message::Edge { from: 1, to: 2, .. }]));
    assert!(a.edge((1, 2, "in")).is_none() && a.deleted.contains(&2));
    assert!(a.call(&insert(2, "t"), 30).unwrap().is_none(), "deleted is final for its own agent");
}

#[test]
fn oracle_a_taken_name_is_replaced() {
    let mut a = replica(1, Variant::STAMPED);
    call(&mut a, insert(1, "n"), 10);
    call(&mut a, insert(26, "n"), 20);
    assert_eq!(a.node(26).unwrap().name.to_string(), "thing_1a");
}

#[test]
fn oracle_placing_writes_parent_and_level_for_nobody() {
    let mut a = replica(1, Variant::STAMPED);
    let root = Operation::InsertNode { id: 1, kind: "root", name: "root", attributes: &[("level", 0)] };
    call(&mut a, root, 10);
    call(&mut a, insert(2, "t"), 20);
    let place = Operation::Place { from: 1, to: 2, pose: 5 };
    let sent = call(&mut a, place, 30);
    assert!(
        matches!(&sent[..], [Message::Edge { .. }, Message::NodeAttributes { parts, .. }] if parts.len() == 2)
    );
    assert_eq!(a.attribute(2, "parent"), Some(Attribute { value: Value::Node(1), agent: 0 }));
    assert_eq!(a.attribute(2, "level"), Some(of(0, 1)));
    // Nothing changes: an empty list, and no second message.
    assert!(
        matches!(&call(&mut a, place, 40)[..], [Message::EdgeAttributes { parts, .. }] if parts.is_empty())
    );
    // Without a level nothing can be placed below.
    assert!(a.call(&Operation::Place { from: 3, to: 2, pose: 0 }, 50).unwrap().is_none());
}

#[test]
fn oracle_a_known_node_is_kept_as_it_is_by_a_snapshot() {
    let (mut a, mut b) = (replica(1, Variant::STAMPED), replica(2, Variant::STAMPED));
    let node = call(&mut a, insert(1, "n"), 10);
    b.receive(&node[0]).unwrap();
    call(&mut a, SET, 20);
    b.receive(&a.snapshot(30)).unwrap();
    assert_eq!(x(&b), Some(Value::Number(1)));
}

#[test]
fn oracle_a_snapshot_of_a_deleted_node_leaves_an_empty_register() {
    let (mut a, mut b) = (replica(1, Variant::STAMPED), replica(2, Variant::STAMPED));
    let node = call(&mut a, insert(1, "n"), 10);
    b.receive(&node[0]).unwrap();
    let snapshot = a.snapshot(20);
    call(&mut b, Operation::DeleteNode { node: 1 }, 30);
    b.receive(&snapshot).unwrap();
    assert!(b.nodes[&1].is_empty());
    assert_eq!(b.call(&SET, 40), Err(Crash::EmptyRegister));
    // Whoever joins there deletes the node.
    let mut c = replica(3, Variant::STAMPED);
    c.receive(&b.snapshot(50)).unwrap();
    assert!(c.deleted.contains(&1) && c.nodes.is_empty());
}

#[test]
fn oracle_an_ignored_attribute_starts_again_at_every_write() {
    let mut a = Replica::new(1, Variant::STAMPED, BTreeSet::from(["x"]));
    call(&mut a, Operation::InsertNode { id: 1, kind: "thing", name: "n", attributes: &[] }, 10);
    for value in [5, 6] {
        let sent = call(&mut a, Operation::Set { node: 1, key: "x", value }, 20);
        let [Message::NodeAttributes { parts, .. }] = &sent[..] else { panic!("one list") };
        assert_eq!(parts[0].delta.values().keys().next(), Some(&dot(1)));
        assert_eq!(x(&a), None);
    }
}
