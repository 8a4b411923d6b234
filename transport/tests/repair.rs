//! What was lost comes: by requests, by digests, in answers that keep to their windows.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod lab;

use dsr_transport::memory::Faults;
use dsr_transport::wire::Item;
use dsr_transport::{Action, Cause, Config, Destination, Stats};
use lab::{Lab, config, image, room};
/// The last delta is lost; a beat shows it. `[spec: LINK-11]` `[spec: LINK-7]`
#[test]
fn law_a_lost_tail_shows_by_a_beat() {
    let mut lab = Lab::of(3);
    lab.filter = Box::new(|_, _, datagram| !matches!(datagram.items[..], [Item::Part(_)]));
    lab.mutate(0, &room("kitchen"));
    lab.filter = Box::new(|_, _, _| true);
    lab.pass(60);
    assert!(lab.are_equal());
    let stats = lab.session(0).stats();
    assert_eq!((stats.resent, stats.answers), (1, lab.session(0).stats().answers));
    // One of the two asked, and the other one heard it, or both asked at once: one answer served both.
    let asked: u64 = (1..3).map(|port| lab.session(port).stats().wants).sum();
    assert!((1..=2).contains(&asked));
}

/// Of many that lack the same few ask. `[spec: LINK-7]`
#[test]
fn law_requests_are_suppressed() {
    let mut lab = Lab::of(20);
    for at in 0..20 {
        lab.filter = Box::new(|_, _, datagram| !matches!(datagram.items[..], [Item::Part(_)]));
        lab.mutate(0, &room(&format!("lost{at}")));
        lab.filter = Box::new(|_, _, _| true);
        lab.mutate(0, &room(&format!("kept{at}")));
        lab.pass(100);
        assert!(lab.are_equal());
    }
    let sum =
        |lab: &mut Lab, of: fn(Stats) -> u64| (1..20).map(|port| of(lab.session(port).stats())).sum::<u64>();
    let (wants, suppressed) = (sum(&mut lab, |stats| stats.wants), sum(&mut lab, |stats| stats.suppressed));
    println!("{wants} requests, {suppressed} suppressed, {} parts sent again", lab.session(0).stats().resent);
    assert!(suppressed > 2 * wants && wants >= 20, "{wants} {suppressed}");
}

/// What is no longer kept comes by a digest. `[spec: LINK-8]` `[spec: LINK-9]` `[spec: LINK-12]` `[spec: LINK-13]`
#[test]
fn law_what_is_gone_comes_by_a_digest() {
    let mut lab = Lab::new(2, Faults::NONE);
    for agent in [1, 2] {
        let mut config = config(agent);
        config.bounds.kept_messages = 3;
        lab.start(agent as usize - 1, config);
    }
    lab.pass(1500);
    let digests = lab.session(1).stats().digests;
    lab.network.partition(1);
    for at in 0..10 {
        lab.mutate(0, &room(&format!("r{at}")));
    }
    lab.network.partition(0);
    lab.mutate(0, &room("last"));
    lab.pass(100);
    let stats = lab.session(1).stats();
    assert!(lab.are_equal());
    assert_eq!((stats.gone_heard, stats.digests - digests, stats.given_up), (1, 1, 0));
    let repairs = lab
        .told
        .iter()
        .filter(|told| matches!(told.2, Action::Changed { cause: Cause::Repair { .. }, .. }) && told.1 == 1);
    assert!(repairs.count() > 0);
}

/// A joiner gets a snapshot in pieces; its source dies, and another peer goes on. `[spec: LINK-13]`
/// `[spec: LINK-14]`
#[test]
fn law_a_snapshot_is_resumed_from_another_peer() {
    let mut lab = Lab::new(3, Faults::NONE);
    let slow = |agent: u32| {
        let mut config = config(agent);
        (config.bounds.bytes_per_second, config.bounds.burst_bytes) = (4_000_000, 3000);
        config
    };
    lab.start(0, slow(1));
    lab.start(1, slow(2));
    lab.pass(400);
    for at in 0..3000 {
        let now = lab.now;
        lab.session(0).mutate(&room(&format!("room {at}")), 0, now).unwrap();
        if at % 100 == 0 {
            lab.drain(0);
            lab.pass(10);
        }
    }
    lab.pass(500);
    assert!(lab.are_equal());
    lab.start(2, slow(3));
    let mut waited = 0;
    while lab.session(2).replica().is_empty() {
        lab.pass(1);
        waited += 1;
        assert!(waited < 1000);
    }
    let had = lab.session(2).replica().len();
    assert!(had < 6000, "{had}: not all in one piece");
    let source = lab.told.iter().find_map(|told| match told.2 {
        Action::Changed { cause: Cause::Repair { from }, .. } if told.1 == 2 => Some(from),
        _ => None,
    });
    let source = source.unwrap().replica.agent as usize - 1;
    lab.sessions[source] = None;
    lab.pass(1000);
    assert!(lab.are_equal());
    let stats = lab.session(2).stats();
    assert_eq!((stats.resumed, stats.stalled), (1, 1), "{stats:?}");
    // Nothing came twice: what it had was named by the second digest.
    assert!(stats.pieces < 30, "{stats:?}");
}

/// What a stream to one peer has under way is bounded. `[spec: LINK-10]`
#[test]
fn law_answers_keep_to_their_window() {
    let window = 30_000;
    let mut lab = Lab::new(2, Faults::NONE);
    let small = |agent: u32| {
        let mut config: Config = config(agent);
        config.bounds.window_bytes = window;
        config
    };
    lab.start(0, small(1));
    lab.pass(400);
    lab.mutate(0, &image("photo", 400_000));
    lab.pass(100);
    lab.start(1, small(2));
    let mut acknowledged = 0_u64;
    lab.pass(2000);
    assert!(lab.are_equal());
    let (mut sent, mut under_way) = (0_u64, 0);
    for (_, _, to, datagram, _) in &lab.sent {
        for item in &datagram.items {
            match item {
                Item::Part(part) if matches!(to, Destination::Peer(_)) && part.count > 9 => {
                    sent += part.bytes.len() as u64;
                    under_way = under_way.max(sent - acknowledged.min(sent));
                }
                Item::Ack { received, below, .. } if *below != u64::MAX => {
                    acknowledged = acknowledged.max(*received);
                }
                _ => {}
            }
        }
    }
    assert!(sent > 400_000 && under_way <= window + 1400 && under_way > window / 2, "{sent} {under_way}");
}
