//! What strangers send.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]
#![allow(clippy::cast_possible_truncation, reason = "numbers drawn are small")]

mod lab;

use dsr_transport::memory::Network;
use dsr_transport::wire::{Datagram, Item};
use dsr_transport::{Address, Bounds, Event, MS};
use lab::{Lab, image, room};
/// Fifty thousand damaged and lying datagrams: no panic, no growth, no wrong state. `[spec: LINK-1]`
/// `[spec: LINK-17]`
#[test]
fn law_hostile_datagrams_do_no_harm() {
    let mut lab = Lab::of(2);
    lab.mutate(0, &image("photo", 20_000));
    lab.mutate(1, &room("kitchen"));
    lab.pass(1000);
    let genuine: Vec<Datagram> = lab.sent.iter().map(|sent| sent.3.clone()).collect();
    let state = lab.session(0).replica().encode();
    let from = Address { host: 9, port: 9 };
    let mut dice = 1_u64;
    let mut draw = move |end: usize| {
        dice ^= dice << 13;
        dice ^= dice >> 7;
        dice ^= dice << 17;
        (dice % end as u64) as usize
    };
    let now = lab.now;
    let session = lab.session(0);
    let group = dsr_transport::wire::group_key("lab");
    for round in 0..50_000 {
        let mut datagram = genuine[draw(genuine.len())].clone();
        // Strangers by the thousand, with everything but deltas of their own.
        datagram.sender.nonce = draw(5000) as u64;
        for item in &mut datagram.items {
            match item {
                Item::Part(part) => {
                    (part.number, part.stream) = (1 + draw(1 << 40) as u64, draw(3) as u32);
                    part.to = if draw(2) == 0 { session.origin().nonce } else { part.to };
                    part.bytes.fill(9);
                }
                Item::Want { origin, stream, .. } => (*origin, *stream) = (session.origin(), draw(9) as u32),
                Item::Beat { high, oldest, .. } => {
                    (*high, *oldest) = (draw(1 << 50) as u64, 1 + draw(1 << 50) as u64);
                }
                _ => {}
            }
        }
        let mut bytes = datagram.encode(group);
        if draw(2) == 0 {
            let at = draw(bytes.len());
            bytes[at] ^= 1 << draw(8);
        }
        session.handle(Event::Datagram { from, bytes: &bytes }, now + round * MS / 100);
        while session.poll_action().is_some() {}
    }
    assert_eq!(session.replica().encode(), state);
    let (counts, bounds) = (session.stats(), Bounds::default());
    assert!(session.peers().count() <= bounds.peers && session.begun_bytes() <= bounds.begun_bytes);
    assert!(counts.refused > 10_000 && counts.overflows > 1000, "{counts:?}");
    lab.now += 600 * MS;
    lab.pass(10_000);
    lab.mutate(1, &room("hall"));
    lab.pass(1000);
    assert!(lab.are_equal() && lab.session(0).begun_bytes() == 0);
}

/// A stranger makes up numbers in a member's name; the member's next beat ends the belief, and what is lost is asked
/// for again. `[spec: LINK-11]` `[spec: LINK-7]`
#[test]
fn regress_made_up_numbers_are_not_believed_for_long() {
    let mut lab = Lab::of(2);
    let sender = lab.session(0).origin();
    let beat = Item::Beat { high: 1 << 40, oldest: 1 << 40, fingerprint: None, name: "a1".into() };
    let bytes = Datagram { sender, items: vec![beat] }.encode(dsr_transport::wire::group_key("lab"));
    let now = lab.now;
    lab.session(1).handle(Event::Datagram { from: Network::address(0), bytes: &bytes }, now);
    lab.drain(1);
    lab.pass(3000);
    let asked = lab.session(1).stats().wants;
    lab.filter = Box::new(|_, _, datagram| !matches!(datagram.items[..], [Item::Part(_)]));
    lab.mutate(0, &room("lost"));
    lab.filter = Box::new(|_, _, _| true);
    lab.pass(50);
    let stats = lab.session(1).stats();
    assert!(lab.are_equal() && stats.wants > asked, "{stats:?}");
    assert_eq!(lab.session(0).stats().resent, 1);
}
