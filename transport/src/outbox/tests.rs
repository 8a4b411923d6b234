//! What is kept is sent again; what is not is gone.

use super::Outbox;
use crate::wire::Missing;

fn drain(outbox: &mut Outbox) -> Vec<(u64, u32)> {
    let parts = std::iter::from_fn(|| outbox.take_small().or_else(|| outbox.take_large(true)));
    parts.map(|part| (part.number, part.index)).collect()
}

fn all(first: u64, last: u64) -> Vec<Missing> {
    vec![Missing { first, last, parts: Vec::new() }]
}

/// Small messages overtake parts of large ones. `[spec: LINK-10]` `[spec: LINK-5]`
#[test]
fn law_small_messages_go_first() {
    let mut outbox = Outbox::new(0, 0, 100);
    assert_eq!(outbox.push(vec![1; 250]), 1);
    assert_eq!(outbox.take_large(true).map(|part| (part.index, part.bytes.len())), Some((0, 84)));
    outbox.push(vec![2; 10]);
    assert_eq!(drain(&mut outbox), [(2, 0), (1, 1), (1, 2)]);
    assert_eq!((outbox.high(), outbox.queued_bytes(), outbox.sent_bytes()), (2, 0, 260));
}

/// `[spec: LINK-8]` `[spec: LINK-9]`
#[test]
fn law_what_is_asked_for_is_sent_again_once() {
    let mut outbox = Outbox::new(0, 0, 100);
    for _ in 0..4 {
        outbox.push(vec![7; 250]);
    }
    // Nothing has been sent yet, so nothing is sent again.
    assert_eq!(outbox.want(&all(1, 4), 0, 5).parts, 0);
    drain(&mut outbox);
    let parts = vec![Missing { first: 3, last: 3, parts: vec![(0, 0), (2, 2)] }];
    assert_eq!(outbox.want(&parts, 10, 5).parts, 2);
    assert_eq!(outbox.want(&all(3, 3), 12, 5).parts, 1, "two of them were sent just now");
    assert_eq!(drain(&mut outbox), [(3, 0), (3, 1), (3, 2)]);
    assert_eq!(outbox.want(&all(3, 3), 15, 5).parts, 3);
    // Two are dropped; who asks for them is told.
    outbox.trim(500, 100);
    assert_eq!(outbox.oldest(), 3);
    let answered = outbox.want(&all(1, u64::MAX - 1), 30, 5);
    assert!(answered.gone && answered.parts == 3, "{answered:?}: those of 3 wait already");
    assert!(!outbox.want(&all(3, 9), 30, 5).gone);
}

/// What has not been sent is never dropped. `[spec: LINK-8]`
#[test]
fn law_what_waits_is_kept() {
    let mut outbox = Outbox::new(0, 0, 100);
    for _ in 0..4 {
        outbox.push(vec![7; 250]);
    }
    outbox.trim(0, 0);
    assert_eq!(outbox.oldest(), 1);
    assert_eq!(drain(&mut outbox).len(), 12);
    outbox.trim(0, 0);
    assert_eq!(outbox.oldest(), 4);
}
