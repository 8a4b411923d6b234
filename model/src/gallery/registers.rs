//! One attribute that several write.

use super::{NODE, REMOVE, Row, free, in_order, set, setup};
use crate::published::{Guard, Operation, Order, Play, Property, Setup, Variant, When};

/// Node 1 without attributes.
const BARE: Operation = Operation::InsertNode { id: 1, kind: "thing", name: "k", attributes: &[] };
const LACKS_X: Guard = Guard::Lacks(1, "x");
/// Node 1 with two attributes.
const TWO: Operation =
    Operation::InsertNode { id: 1, kind: "thing", name: "k", attributes: &[("w", 1), ("z", 1)] };

fn causal(setup: &mut Setup) {
    setup.powers.order = Order::Causal;
}

pub(super) fn rows() -> Vec<Row> {
    [empty(), races(), removals(), users()].concat()
}

/// Writes on a gap.
fn empty() -> Vec<Row> {
    let plays: [&[_]; 3] = [&[free(set(40))], &[free(set(20)), free(set(30))], &[free(set(99))]];
    let on =
        |before| Setup { when: When::Always, ..setup(&[1, 2, 3], &[before], &plays, Property::Unreadable) };
    let any = |value| Play::any(&[set(value), REMOVE], 2);
    let two = setup(&[1, 2], &[NODE], &[&[], &[]], Property::Unreadable);
    let two = Setup { plays: vec![any(11), any(21)], when: When::Always, ..two };
    vec![
        Row::new(
            "38",
            "two agents suffice: a removal leaves a gap, and a write on it empties the register",
            two,
        )
        .unless("nobody removes", |setup| {
            setup.plays = vec![Play::any(&[set(11)], 2), Play::any(&[set(21)], 2)];
        }),
        Row::new("1", "a write on a gap empties the register elsewhere", on(NODE))
            .unless("messages arrive after what caused them", causal),
        Row::new("1b", "a first write, on a gap, empties the register elsewhere", on(BARE))
            .unless("messages arrive after what caused them", causal),
    ]
}

/// Who wins.
fn races() -> Vec<Row> {
    let tie = setup(&[1, 2], &[NODE], &[&[free(set(10))], &[free(set(20))]], Property::Divergence);
    let tie = Setup { variant: Variant::UPSTREAM, ..tie };
    let later = (Guard::Made(0, 2), set(50));
    let race: [&[_]; 2] = [&[free(set(20)), free(set(30))], &[later]];
    let race = setup(&[2, 1], &[NODE], &race, Property::Lost(1, "x", 50));
    vec![
        Row::new("3", "two writes of agent 0: each replica keeps its own", tie)
            .unless("writes carry their agents", |setup| setup.variant = Variant::STAMPED),
        Row::new("26", "who writes twice beats who writes later", Setup { when: When::Finished, ..race })
            .unless("both write once", |setup| {
                setup.plays[0].calls.truncate(1);
                setup.plays[0].calls_max = 1;
                setup.plays[1].calls[0].0 = Guard::Made(0, 1);
            }),
    ]
}

/// Attributes that are removed.
fn removals() -> Vec<Row> {
    let delete_write = setup(&[1, 2], &[NODE], &[&[free(REMOVE)], &[free(set(2))]], Property::Divergence);
    let again = (LACKS_X, set(7));
    let overtakes: [&[_]; 3] = [&[free(REMOVE)], &[again], &[]];
    let overtakes = setup(&[1, 2, 3], &[NODE], &overtakes, Property::Divergence);
    let older: [&[_]; 2] = [&[free(REMOVE), again], &[free(set(60))]];
    let history = [NODE, set(2), set(3), set(4), set(5)];
    let older = setup(&[1, 2], &history, &older, Property::Divergence);
    let sees = (Guard::Shows(1, "x", 2), REMOVE);
    let early: [&[_]; 3] = [&[free(set(2))], &[sees], &[]];
    let early = setup(&[1, 2, 3], &[NODE], &early, Property::Divergence);
    // Else who made the node would pass over the removal (row 12).
    let early = Setup { variant: Variant::UPSTREAM, ..early };
    vec![
        Row::new("2", "a removal against a write: they cross", delete_write)
            .unless("nobody writes", |setup| setup.plays[1].calls_max = 0),
        Row::new("4", "a new attribute overtakes the removal of the old one", overtakes)
            .unless("messages arrive after what caused them", causal),
        Row::new(
            "5",
            "a new attribute loses to a write on the removed one",
            Setup { when: When::Finished, ..older },
        )
        .unless("nobody writes the removed one", |setup| setup.plays[1].calls_max = 0),
        Row::new("6", "a removal overtakes the write that it saw", early)
            .unless("messages arrive after what caused them", causal),
    ]
}

/// What users do without knowing.
fn users() -> Vec<Row> {
    let put_back = Operation::PutBack { key: "w", value: 5 };
    let other = Operation::Set { node: 1, key: "z", value: 7 };
    let stale: [&[_]; 2] = [&[free(Operation::Get { node: 1 }), free(put_back)], &[free(other)]];
    let stale = setup(&[1, 2], &[TWO], &stale, Property::Lost(1, "z", 7));
    let signed = setup(&[1, 2], &[NODE], &[&[], &[free(REMOVE)]], Property::Divergence);
    let ignoring: [&[_]; 2] = [&[free(set(5)), free(set(6))], &[]];
    // In any order the other write may be the last one.
    let ignoring = in_order(setup(&[1, 2], &[BARE], &ignoring, Property::Lost(1, "x", 6)));
    vec![
        Row::new(
            "11",
            "an update from an old copy undoes what arrived meanwhile",
            Setup { when: When::Finished, ..stale },
        )
        .unless("getting and updating is one step", |setup| {
            setup.plays[0].calls = vec![free(Operation::Set { node: 1, key: "w", value: 5 })];
            setup.plays[0].calls_max = 1;
        }),
        Row::new("12", "who made a node passes over removals of its attributes", signed)
            .unless("nodes say that they are from agent 0", |setup| setup.variant = Variant::UPSTREAM),
        Row::new(
            "27",
            "writes of an ignored attribute all count as the first",
            Setup { when: When::Finished, ignored: vec!["x"], ..ignoring },
        )
        .unless("it is not ignored", |setup| setup.ignored.clear()),
    ]
}
