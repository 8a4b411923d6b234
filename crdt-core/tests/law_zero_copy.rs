//! Payloads are shared, never copied: what is allocated does not depend on how large a value is.
//!
//! One test alone in this file: the allocator counts for the whole process.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test fails by panicking")]

use dsr_core::{
    AttributeUpdates, Delta, Dictionary, ElementId, Mutation, NewVertex, Replica, ReplicaId, Value, VertexId,
    VertexLink,
};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::hint::black_box;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// A camera's image.
const LARGE: usize = 5_000_000;
const SMALL: usize = 1;

/// Bytes allocated meanwhile, freed again or not.
fn bytes<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let region = Region::new(ALLOCATOR);
    let made = work();
    let change = region.change();
    (made, change.bytes_allocated + usize::try_from(change.bytes_reallocated.max(0)).unwrap())
}

/// Bytes allocated by each way that a payload goes.
fn ways(size: usize) -> Vec<(&'static str, usize)> {
    let replica = |agent| Replica::new(ReplicaId::agent(agent), Dictionary::open());
    let (mut here, mut there, mut late) = (replica(1), replica(2), replica(3));
    let vertex = NewVertex::new("camera", "camera");
    let made = here.mutate(&Mutation::AddVertex { vertex, link: VertexLink::child_of(VertexId::ROOT) }, 0);
    there.apply(&made.unwrap().delta);
    let target = ElementId::Vertex(here.vertex_by_name("camera").unwrap());
    let update = |value: Option<Value>| Mutation::UpdateAttributes {
        target,
        updates: AttributeUpdates::from([("image".into(), value)]),
    };
    let image = |byte: u8| Some(Value::ByteVec(vec![byte; size].into()));

    let set = update(image(1));
    let (made, mutating) = bytes(|| here.mutate(&set, 0).unwrap());
    let (delta, cloning) = bytes(|| black_box(made.delta.clone()));
    let (_, applying) = bytes(|| there.apply(&delta));
    let (snapshot, snapping) = bytes(|| there.snapshot());
    let again = update(image(2));
    let (made, replacing) = bytes(|| there.mutate(&again, 0).unwrap());
    let (_, replaced) = bytes(|| here.apply(&made.delta));
    let (answer, answering): (Delta, usize) = bytes(|| here.delta_for(&late.digest()));
    let (_, catching_up) = bytes(|| late.apply(&answer));
    let (_, state) = bytes(|| black_box(late.state()));
    let read = |replica: &dsr_core::Graph| replica.attribute(target, "image").unwrap().1;
    let (seen, reading) = bytes(|| read(&late));
    assert_eq!(Some(seen.value), image(2));
    assert_eq!(Some(read(&snapshot).value), image(1));
    vec![
        ("a mutation", mutating),
        ("a clone of its delta", cloning),
        ("its delivery", applying),
        ("a snapshot", snapping),
        ("a mutation after a snapshot", replacing),
        ("the delivery of what replaces a payload", replaced),
        ("an answer to a digest", answering),
        ("its delivery to a late joiner", catching_up),
        ("the state", state),
        ("reading", reading),
    ]
}

/// `[spec: REPLICA-3]`
#[test]
fn law_no_payload_is_copied() {
    // The first time, whatever is allocated once for all.
    ways(SMALL);
    let (small, large) = (ways(SMALL), ways(LARGE));
    for ((way, small), (_, large)) in small.into_iter().zip(large) {
        println!("{way}: {small} and {large} bytes");
        assert!(large <= 2 * small, "{way} allocates {small} bytes for one byte and {large} for {LARGE}");
        assert!(large < 100_000, "{way}: {large}");
    }
    // The count sees what is copied.
    let payload = vec![0_u8; LARGE];
    assert!(bytes(|| black_box(payload.clone())).1 >= LARGE);
}
