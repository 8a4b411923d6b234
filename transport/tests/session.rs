//! Two sessions, and what they send.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod lab;

use dsr_core::encode;
use dsr_transport::memory::Faults;
use dsr_transport::{Action, Bounds, Cause, MutateError};
use lab::{Lab, config, image, room};

/// The whole path. `[spec: LINK-18]` `[spec: LINK-14]`
#[test]
fn law_two_sessions_end_equal() {
    let mut lab = Lab::of(2);
    lab.mutate(0, &room("kitchen"));
    lab.mutate(1, &room("hall"));
    lab.mutate(0, &image("photo", 100_000));
    lab.pass(50);
    assert!(lab.are_equal());
    assert!(lab.session(1).snapshot().vertex_by_name("photo").is_some());
    let causes: Vec<Cause> = lab
        .told
        .iter()
        .filter_map(|(_, port, action)| match action {
            Action::Changed { cause, .. } if *port == 1 => Some(*cause),
            _ => None,
        })
        .collect();
    let origin = lab.session(0).origin();
    assert_eq!(causes, [Cause::Local, Cause::Remote { origin }, Cause::Remote { origin }]);
    let synced = lab.told.iter().filter(|told| told.2 == Action::Synced).count();
    assert_eq!(synced, 2);
}

/// `[spec: LINK-3]` `[spec: LINK-1]` `[spec: LINK-5]`
#[test]
fn law_datagrams_are_small() {
    let mut lab = Lab::of(2);
    let before = lab.sent.len();
    let now = lab.now;
    let delta = lab.session(0).mutate(&room("kitchen"), 0, now).unwrap().delta;
    lab.drain(0);
    let beyond = lab.sent[before].4 - encode(&delta).len();
    println!("a small delta costs {beyond} bytes");
    assert!(beyond <= 60, "{beyond}");
    lab.mutate(0, &image("photo", 100_000));
    for at in 0..100 {
        lab.mutate(1, &room(&format!("r{at}")));
    }
    lab.pass(1000);
    let max = Bounds::default().datagram_bytes;
    assert!(lab.sent.iter().all(|sent| sent.4 <= max));
    assert!(lab.sent.iter().any(|sent| sent.4 > max - 60), "parts fill their datagrams");
    assert!(lab.are_equal());
}

/// Many small messages at once share datagrams. `[spec: LINK-5]`
#[test]
fn law_small_messages_share_datagrams() {
    let mut lab = Lab::of(2);
    let before = lab.sent.len();
    let now = lab.now;
    for at in 0..100 {
        lab.session(0).mutate(&room(&format!("r{at}")), 0, now).unwrap();
    }
    lab.drain(0);
    assert!(lab.sent.len() - before < 10);
    lab.pass(10);
    assert!(lab.are_equal());
}

/// A blob holds nothing up. `[spec: LINK-10]`
#[test]
fn law_small_messages_overtake_blobs() {
    let mut lab = Lab::new(2, Faults::NONE);
    for agent in [1, 2] {
        let mut config = config(agent);
        config.bounds.bytes_per_second = 1_000_000;
        config.bounds.burst_bytes = 3000;
        lab.start(agent as usize - 1, config);
    }
    lab.pass(400);
    lab.mutate(0, &image("photo", 200_000));
    lab.pass(20);
    lab.mutate(0, &room("kitchen"));
    lab.pass(5);
    let there = lab.session(1).snapshot();
    assert!(there.vertex_by_name("kitchen").is_some() && there.vertex_by_name("photo").is_none());
    assert!(lab.session(0).queued_bytes() > 0);
    lab.pass(300);
    assert!(lab.are_equal() && lab.session(0).queued_bytes() == 0);
    assert_eq!(lab.session(1).stats().wants, 0, "what is still coming is not asked for");
}

/// `[spec: LINK-10]` `[spec: LINK-17]`
#[test]
fn law_a_full_queue_refuses_before_anything_changes() {
    let mut lab = Lab::of(2);
    let now = lab.now;
    let mut made = 0;
    let refused = loop {
        // Nothing is polled, so nothing is sent.
        match lab.session(0).mutate(&image(&format!("i{made}"), 1 << 20), 0, now) {
            Ok(_) => made += 1,
            Err(error) => break error,
        }
    };
    assert!(matches!(refused, MutateError::Busy { queued, max } if queued >= max), "{refused}");
    assert_eq!(made, 16);
    let before = lab.session(0).replica().encode();
    lab.session(0).mutate(&room("kitchen"), 0, now).unwrap_err();
    assert_eq!(lab.session(0).replica().encode(), before);
    lab.drain(0);
    lab.pass(500);
    lab.mutate(0, &room("kitchen"));
    lab.pass(10);
    assert!(lab.are_equal());
}
