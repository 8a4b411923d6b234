//! Whoever joins, restarts, or does not hear.

use super::{NODE, Row, free, in_order, set, setup};
use crate::published::{CALL_TIME, Guard, Joiner, Operation, Order, Property, Setup, When};

const DELETE: Operation = Operation::DeleteNode { node: 1 };
const WRITTEN: Guard = Guard::Shows(1, "x", 2);

fn joined(mut setup: Setup, server: usize, hears: &[usize], asks: Guard) -> Setup {
    let replica = setup.replicas() - 1;
    let (early, again) = (false, false);
    setup.powers.joiner = Some(Joiner { replica, server, hears: hears.to_vec(), asks, early, again });
    setup
}

fn ask_when(setup: &mut Setup, guard: Guard) {
    if let Some(joiner) = &mut setup.powers.joiner {
        joiner.asks = guard;
    }
}

fn hear(setup: &mut Setup, replicas: &[usize]) {
    if let Some(joiner) = &mut setup.powers.joiner {
        joiner.hears = replicas.to_vec();
    }
}

fn tell_early(setup: &mut Setup, early: bool) {
    if let Some(joiner) = &mut setup.powers.joiner {
        joiner.early = early;
    }
}

pub(super) fn rows() -> Vec<Row> {
    [snapshots(), deleted(), clocks(), failures(), identity()].concat()
}

/// Writes that a joiner misses.
fn snapshots() -> Vec<Row> {
    let diverge = Property::Divergence;
    let missed: [&[_]; 3] = [&[free(NODE)], &[free(set(2))], &[]];
    let missed = joined(setup(&[1, 2, 3], &[], &missed, diverge), 0, &[0], WRITTEN);
    let late: [&[_]; 3] = [&[free(set(2))], &[], &[]];
    let late = joined(setup(&[1, 2, 3], &[NODE], &late, diverge), 1, &[0, 1], Guard::Always);
    let between: [&[_]; 3] = [&[], &[(Guard::Encoded, set(2))], &[]];
    let between = joined(setup(&[1, 2, 3], &[NODE], &between, diverge), 0, &[0], Guard::Always);
    let after = (Guard::Encoded, set(3));
    let first: [&[_]; 3] = [&[free(set(2)), after], &[], &[]];
    // In any order there is a shorter one, which is that of row 14.
    let first = in_order(setup(&[1, 2, 3], &[NODE], &first, diverge));
    let first = joined(first, 1, &[0, 1], Guard::Always);
    vec![
        Row::new("13", "a joiner keeps the nodes that it knows as they are", missed)
            .unless("it hears everybody from the start", |setup| hear(setup, &[0, 1])),
        Row::new("14", "a joiner drops a write that its snapshot has not", late)
            .unless("the server is asked after it has got the write", |setup| ask_when(setup, WRITTEN)),
        Row::new(
            "35",
            "a joiner misses what is written between its snapshot and finding the writer",
            between,
        )
        .unless("it hears everybody from the start", |setup| hear(setup, &[0, 1])),
        Row::new(
            "15",
            "a joiner drops a write together with an older one",
            Setup { when: When::Finished, ..first },
        )
        .unless("there is no older one", |setup| {
            setup.plays[0].calls.remove(0);
            setup.plays[0].calls_max = 1;
        }),
    ]
}

/// What joiners do not learn of deletions.
fn deleted() -> Vec<Row> {
    let back: [&[_]; 3] = [&[free(NODE)], &[free(DELETE)], &[]];
    let back = joined(setup(&[1, 2, 3], &[], &back, Property::Revived(1)), 0, &[0], Guard::Gone(1));
    let hollow: [&[_]; 2] = [&[free(DELETE)], &[]];
    let hollow = setup(&[1, 2], &[NODE], &hollow, Property::Unreadable);
    let mut hollow = Setup { when: When::Always, ..joined(hollow, 0, &[0], Guard::Always) };
    hollow.powers.order = Order::Topic;
    vec![
        Row::new("18", "a joiner keeps a node that was deleted before it heard of it", back)
            .unless("it hears everybody from the start", |setup| hear(setup, &[0, 1])),
        Row::new("19", "a snapshot of a deleted node leaves an empty register", hollow)
            .unless("each pair keeps its order", |setup| setup.powers.order = Order::Pair),
    ]
}

/// Clocks that differ.
fn clocks() -> Vec<Row> {
    let early: [&[_]; 3] = [&[free(NODE)], &[free(set(2))], &[]];
    let mut early = setup(&[1, 2, 3], &[], &early, Property::Divergence);
    early.powers.ahead = vec![100 * CALL_TIME, 0, 0];
    vec![
        Row::new("16", "a write with a slow clock is dropped where it comes before its node", early)
            .unless("clocks are right", |setup| setup.powers.ahead.clear()),
    ]
}

/// What is never repaired.
fn failures() -> Vec<Row> {
    let mut lost = setup(&[1, 2], &[NODE], &[&[free(set(2))], &[]], Property::Divergence);
    lost.powers.losses_max = 1;
    let restart: [&[_]; 3] = [&[free(set(2))], &[], &[]];
    let restart = setup(&[1, 2, 3], &[NODE], &restart, Property::Divergence);
    let mut restart = joined(restart, 1, &[1], Guard::Restarted);
    restart.powers.restarts = Some((1, WRITTEN));
    let own = (Guard::Made(1, 1), set(2));
    let other = Operation::InsertNode { id: 2, kind: "agent", name: "other", attributes: &[] };
    let apart: [&[_]; 2] = [&[free(Operation::DeleteNode { node: 2 }), own], &[free(DELETE)]];
    let mut apart = setup(&[1, 2], &[NODE, other], &apart, Property::Unreconciled);
    apart.powers.losses_max = 2;
    vec![
        Row::new("23", "a lost message is never sent again", lost)
            .unless("nothing is lost", |setup| setup.powers.losses_max = 0),
        Row::new("24", "a server that restarts serves what it began with", restart).unless(
            "it does not restart, and is asked after it has got the write",
            |setup| {
                setup.powers.restarts = None;
                ask_when(setup, WRITTEN);
            },
        ),
        Row::new(
            "25",
            "after a partition each side keeps what the other has deleted",
            Setup { when: When::Finished, ..apart },
        )
        .unless("nothing is lost", |setup| setup.powers.losses_max = 0),
    ]
}

/// Who is who, and when one is in.
fn identity() -> Vec<Row> {
    let early = setup(&[1, 2], &[NODE], &[&[], &[]], Property::Missing(1));
    let mut early = Setup { when: When::Always, ..joined(early, 0, &[0], Guard::Always) };
    tell_early(&mut early, true);
    let again = setup(&[1, 2], &[NODE], &[&[], &[]], Property::Missing(1));
    let mut again = joined(again, 0, &[0], Guard::Always);
    again.powers.restarts = Some((1, Guard::Shows(1, "x", 1)));
    if let Some(joiner) = &mut again.powers.joiner {
        joiner.again = true;
    }
    let same = setup(&[1, 1], &[], &[&[free(NODE)], &[]], Property::Divergence);
    vec![
        Row::new("31", "joining returns before the graph is there", early)
            .unless("the graph is taken in first", |setup| tell_early(setup, false)),
        Row::new("32", "two agents with one number pass over each other's messages", same)
            .unless("their numbers differ", |setup| setup.agents = vec![1, 2]),
        Row::new("32b", "a joiner that restarts is refused as a duplicate of itself", again)
            .unless("it does not restart", |setup| setup.powers.restarts = None),
    ]
}
