//! Every fate of the first datagrams, in small scopes: all end equal.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod lab;

use dsr_core::{EdgeKey, Mutation, VertexId};
use dsr_transport::memory::Faults;
use dsr_transport::{Config, Flaw};
use lab::{Fate, Lab, config, image, room};

const FATES: [Fate; 4] = [Fate::Arrives, Fate::IsLost, Fate::ComesTwice, Fate::IsLate(30)];

/// Runs a course under every combination of fates of its first datagrams; from when on is for it to say. How many
/// courses there are, or the fates under which sessions differ.
fn try_each(datagrams: u32, course: impl Fn(&mut Lab, Vec<Fate>)) -> Result<usize, Vec<Fate>> {
    for code in 0..FATES.len().pow(datagrams) {
        let fates: Vec<Fate> = (0..datagrams).map(|at| FATES[code >> (2 * at) & 3]).collect();
        let mut lab = Lab::new(3, Faults::NONE);
        course(&mut lab, fates.clone());
        let mut waited = 0;
        while !lab.are_equal() || lab.sessions.iter().flatten().any(dsr_transport::Session::has_gaps) {
            lab.pass(20);
            waited += 20;
            if waited >= 4000 {
                return Err(fates);
            }
        }
        assert!(lab.sessions.iter().flatten().all(|session| session.begun_bytes() == 0));
    }
    Ok(FATES.len().pow(datagrams))
}

#[track_caller]
fn each(datagrams: u32, course: impl Fn(&mut Lab, Vec<Fate>)) {
    assert_eq!(try_each(datagrams, course), Ok(FATES.len().pow(datagrams)));
}

/// One gap, or several: an edge that is replaced twice, where a context alone finds nothing to send.
/// `[spec: LINK-18]` `[spec: LINK-7]`
#[test]
fn law_every_fate_of_three_deltas() {
    let mut met = Lab::new(3, Faults::NONE);
    met.start(0, config(1));
    met.start(1, config(2));
    met.pass(400);
    for name in ["kitchen", "hall", "lamp"] {
        met.mutate(0, &room(name));
    }
    met.pass(400);
    let vertex = |name: &str| met.sessions[0].as_ref().unwrap().snapshot().vertex_by_name(name).unwrap();
    let (kitchen, hall, lamp) = (vertex("kitchen"), vertex("hall"), vertex("lamp"));
    let key = |to: VertexId| EdgeKey::new(lamp, "in", to);
    let relocate = |from, to| Mutation::MoveEdge { from: key(from), to: key(to), attributes: [].into() };
    let sessions = met.sessions.clone();
    let now = met.now;
    each(6, |lab, fates| {
        lab.sessions.clone_from(&sessions);
        lab.now = now;
        lab.fates = fates.into();
        lab.mutate(0, &Mutation::AddEdge { key: key(VertexId::ROOT), attributes: [].into() });
        lab.mutate(0, &relocate(VertexId::ROOT, kitchen));
        lab.mutate(0, &relocate(kitchen, hall));
        lab.pass(50);
    });
}

/// Two that have met; one sends a message of three parts, and a small one.
fn parts(flaw: Option<Flaw>) -> impl Fn(&mut Lab, Vec<Fate>) {
    move |lab, fates| {
        for agent in [1, 2] {
            let config = Config { flaw, ..config(agent) };
            lab.start(agent as usize - 1, config);
        }
        lab.pass(400);
        lab.fates = fates.into();
        lab.mutate(0, &image("photo", 3500));
        lab.mutate(0, &room("kitchen"));
        lab.pass(50);
    }
}

/// `[spec: LINK-18]` `[spec: LINK-6]`
#[test]
fn law_every_fate_of_parts() {
    each(5, parts(None));
}

/// What is broken is found in this small scope, too. `[spec: LINK-7]` `[spec: LINK-6]`
#[test]
fn alarm_every_fate_of_parts() {
    for flaw in [Flaw::ForgetsToWant, Flaw::PartsReversed] {
        assert!(try_each(5, parts(Some(flaw))).is_err(), "{flaw:?}");
    }
}

/// A joiner, from its first word on. `[spec: LINK-18]` `[spec: LINK-14]`
#[test]
fn law_every_fate_of_a_join() {
    each(6, |lab, fates| {
        lab.start(0, config(1));
        lab.pass(400);
        lab.mutate(0, &image("photo", 3500));
        lab.pass(100);
        lab.fates = fates.into();
        lab.start(1, config(2));
        lab.pass(600);
    });
}

/// A restart that has forgotten everything, while the other one writes. `[spec: LINK-18]` `[spec: LINK-4]`
#[test]
fn law_every_fate_of_a_restart() {
    each(5, |lab, fates| {
        lab.start(0, config(1));
        lab.start(1, config(2));
        lab.pass(400);
        lab.mutate(1, &room("before"));
        lab.pass(20);
        lab.fates = fates.into();
        let mut again = config(2);
        (again.replica.incarnation, again.nonce) = (1, 77);
        lab.start(1, again);
        lab.pass(100);
        lab.mutate(0, &room("meanwhile"));
        lab.pass(100);
        lab.mutate(1, &room("after"));
        lab.pass(50);
    });
}
