//! Messages come together in any order, once; what is missing is known.

use super::{Inbox, Taken};
use crate::config::{Bounds, Times};
use crate::wire::{Missing, Part, part_bounds};

fn part(number: u64, index: u32, count: u32) -> Part {
    let total = count * 10 - 3;
    let bounds = part_bounds(total, count, index);
    let bytes = bounds.map(|(first, end)| (first..end).map(|at| at.to_le_bytes()[0]).collect());
    Part { stream: 0, to: 0, number, index, count, total, bytes: bytes.unwrap_or_default() }
}

fn take(inbox: &mut Inbox, number: u64, index: u32, count: u32) -> Taken {
    inbox.take(part(number, index, count), 0, &mut 1_000_000, &Bounds::default())
}

/// Every order of the parts of two messages. `[spec: LINK-6]`
#[test]
fn law_every_order_of_parts_delivers_once() {
    let parts = [(1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)];
    let mut orders = vec![vec![]];
    for _ in 0..parts.len() {
        let longer = |order: &Vec<usize>| {
            let order = order.clone();
            (0..6).filter(move |at| !order.contains(at)).collect::<Vec<_>>()
        };
        let all = orders
            .iter()
            .flat_map(|order: &Vec<usize>| longer(order).into_iter().map(|at| [&order[..], &[at]].concat()));
        orders = all.collect();
    }
    assert_eq!(orders.len(), 720);
    for order in orders {
        let mut inbox = Inbox::from(1);
        let mut room = 60;
        let mut delivered = Vec::new();
        for at in order {
            let (number, index) = parts[at];
            for again in [false, true] {
                match inbox.take(part(number, index, 3), 0, &mut room, &Bounds::default()) {
                    Taken::Complete(bytes) => delivered.push((number, bytes)),
                    Taken::Known => assert!(again),
                    other => assert!(!again && other == Taken::Kept, "{other:?}"),
                }
            }
        }
        delivered.sort();
        let whole: Vec<u8> = (0..27).collect();
        assert_eq!(delivered, [(1, whole.clone()), (2, whole)]);
        assert!(inbox.is_complete() && room == 60 && inbox.received() == 54);
    }
}

/// `[spec: LINK-7]`
#[test]
fn law_what_is_missing_is_known() {
    let missing = |first, last| Missing { first, last, parts: vec![] };
    let mut inbox = Inbox::from(3);
    take(&mut inbox, 3, 0, 1);
    assert!(inbox.is_complete());
    take(&mut inbox, 6, 1, 4);
    take(&mut inbox, 9, 0, 1);
    inbox.exists(12);
    let of_six = |parts| Missing { first: 6, last: 6, parts };
    // While parts come in, what follows the last one is not missing.
    let expected = [of_six(vec![(0, 0)]), missing(4, 5), missing(7, 8), missing(10, 12)];
    assert_eq!(inbox.missing(5, 10), expected);
    assert_eq!(inbox.missing(10, 10)[0], of_six(vec![(0, 0), (2, 3)]));
    // Gone below 8: the parts are given back.
    let mut room = 0;
    assert!(inbox.skip(8, &mut room) && room == 10);
    assert_eq!(inbox.missing(10, 10), [missing(8, 8), missing(10, 12)]);
    assert!(inbox.give_up(&mut room) && inbox.is_complete());
    // What comes late is delivered all the same.
    assert!(matches!(take(&mut inbox, 4, 0, 1), Taken::Complete(_)));
    assert_eq!(take(&mut inbox, 4, 0, 1), Taken::Known);
}

/// Begun below what is asked for, as after a lie about numbers: its parts are asked for, and given up.
/// `[spec: LINK-7]` `[spec: LINK-9]`
#[test]
fn regress_a_message_begun_below_the_floor() {
    let mut inbox = Inbox::from(40);
    take(&mut inbox, 40, 0, 1);
    take(&mut inbox, 1, 1, 3);
    assert!(!inbox.is_complete());
    assert_eq!(inbox.missing(10, 10), [Missing { first: 1, last: 1, parts: vec![(0, 0), (2, 2)] }]);
    let mut room = 0;
    assert!(inbox.give_up(&mut room) && inbox.is_complete() && room == 9);
}

/// `[spec: LINK-6]` `[spec: LINK-17]`
#[test]
fn law_bounds_hold() {
    let bounds = Bounds { begun_messages: 2, runs: 3, ..Bounds::default() };
    let mut inbox = Inbox::from(1);
    let mut room = 25;
    for number in [1, 2] {
        assert_eq!(inbox.take(part(number, 0, 4), 0, &mut room, &bounds), Taken::Kept);
    }
    assert_eq!(inbox.take(part(3, 0, 4), 0, &mut room, &bounds), Taken::NoRoom, "two have begun");
    assert_eq!(inbox.take(part(2, 1, 4), 0, &mut room, &bounds), Taken::NoRoom, "5 bytes are left");
    let contradiction = Part { total: 36, ..part(2, 1, 4) };
    room = 100;
    assert_eq!(inbox.take(contradiction, 0, &mut room, &bounds), Taken::Contradicts);
    // A fourth run: the lowest is forgotten, with the gap before it.
    for number in [11, 13, 15] {
        inbox.take(part(number, 0, 1), 0, &mut room, &bounds);
        assert!(!inbox.was_overrun());
    }
    inbox.take(part(17, 0, 1), 0, &mut room, &bounds);
    assert!(inbox.was_overrun() && !inbox.was_overrun());
}

/// Each request is later, up to a bound. `[spec: LINK-7]`
#[test]
fn law_requests_back_off() {
    let times = Times { want_max: 1000, ..Times::default() };
    let mut inbox = Inbox::from(1);
    inbox.exists(2);
    inbox.watch(0, 10);
    let mut now = 10;
    let mut waits = Vec::new();
    for _ in 0..8 {
        assert_eq!(inbox.want_at(), Some(now));
        inbox.back_off(now, 10, &times);
        let next = inbox.want_at().unwrap_or(0);
        waits.push(next - now);
        now = next;
    }
    assert_eq!(waits, [20, 40, 80, 160, 320, 640, 1000, 1000]);
    take(&mut inbox, 1, 0, 1);
    assert_eq!(inbox.tries(), 0, "what was asked for comes");
    take(&mut inbox, 2, 0, 1);
    inbox.watch(now, 10);
    assert_eq!(inbox.want_at(), None);
}
