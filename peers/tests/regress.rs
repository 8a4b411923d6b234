//! What went wrong once, or would go wrong with a little less care.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::adapter::Adapter;
use dsr_conformance::protocol::{AnswerFor, CaseBegin, Deliver, Mutate, Mutation, Read, Restart};
use dsr_peers::replica::Replica;
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, YrsGraph};
use serde_json::{Value, json};

fn mutate<R: Replica>(peer: &mut Peer<R>, mutation: Value) -> String {
    let mutations: Vec<Mutation> = vec![serde_json::from_value(mutation).unwrap()];
    peer.mutate(&Mutate { replica: "a".into(), mutations }).unwrap().delta
}

fn begun<R: Replica>() -> Peer<R> {
    let mut peer = Peer::<R>::default();
    let replicas = vec!["a".into(), "b".into()];
    peer.begin(&CaseBegin { case: "regress".into(), replicas, dictionary: None }).unwrap();
    peer
}

fn kitchen() -> Value {
    let link = json!({"from": "root", "label": "RT"});
    json!({"add_vertex": {"as": "k", "type": "room", "name": "kitchen", "link": link}})
}

fn deliver<R: Replica>(peer: &mut Peer<R>, deltas: Vec<String>) {
    for delta in deltas {
        peer.deliver(&Deliver { replica: "b".into(), delta }).unwrap();
    }
}

fn set(name: &str) -> Value {
    json!({"update_attributes": {"vertex": "k", "attributes": {name: {"type": "int", "value": 1}}}})
}

/// With its garbage collection, yrs 0.28.1 subtracts below zero here: what it has collected arrives as one range, over a
/// gap and what follows that.
#[test]
fn regress_yrs_collects_over_a_gap() {
    let mut peer = begun::<YrsGraph>();
    let first = mutate(&mut peer, kitchen());
    let _lost = mutate(&mut peer, set("x"));
    let third = mutate(&mut peer, set("y"));
    let removal = mutate(&mut peer, json!({"remove_vertex": {"vertex": "k"}}));
    deliver(&mut peer, vec![first, third, removal]);
    let delta = peer.resynchronise(&AnswerFor { from: "a".into(), to: "b".into() }).unwrap().delta;
    deliver(&mut peer, vec![delta]);
    let view = peer.read(&Read { replica: "b".into() }).unwrap().view;
    assert!(view.vertices.is_empty());
}

/// What has come before its cause is there when the cause comes, though the replica has restarted meanwhile.
fn waits<R: Replica>() {
    let mut peer = begun::<R>();
    let (cause, effect) = (mutate(&mut peer, kitchen()), mutate(&mut peer, set("x")));
    deliver(&mut peer, vec![effect]);
    peer.restart(&Restart { replica: "b".into(), keeps: true }).unwrap();
    deliver(&mut peer, vec![cause]);
    let view = peer.read(&Read { replica: "b".into() }).unwrap().view;
    assert_eq!(view.vertices.0["k"].attributes.0.len(), 1, "{}", R::implementation().name);
}

#[test]
fn regress_what_waits_survives_a_restart() {
    waits::<AutomergeGraph>();
    waits::<LoroGraph>();
    waits::<YrsGraph>();
}
