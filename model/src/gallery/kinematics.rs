//! Names, parents and levels.

use super::{Row, free, node, setup};
use crate::published::{Operation, Property, Setup, When};

/// A node that others can be placed below.
const fn base(id: u32, name: &'static str) -> Operation {
    Operation::InsertNode { id, kind: "transform", name, attributes: &[("level", 1)] }
}

/// The same, further down.
const fn deep(id: u32, name: &'static str) -> Operation {
    Operation::InsertNode { id, kind: "transform", name, attributes: &[("level", 5)] }
}

const fn place(from: u32, to: u32) -> Operation {
    Operation::Place { from, to, pose: 0 }
}

pub(super) fn rows() -> Vec<Row> {
    let names: [&[_]; 2] = [&[free(node(1, "m"))], &[free(node(2, "m"))]];
    let names = setup(&[1, 2], &[], &names, Property::NameIndex);
    let parents: [&[_]; 2] = [&[free(place(1, 3))], &[free(place(2, 3))]];
    let before = [base(1, "left"), base(2, "right"), node(3, "child")];
    let parents = setup(&[1, 2], &before, &parents, Property::TwoParents(3));
    let circle: [&[_]; 2] = [&[free(place(1, 2))], &[free(place(2, 1))]];
    let circle = setup(&[1, 2], &before[..2], &circle, Property::ParentLoop);
    let halves: [&[_]; 2] = [&[free(place(1, 3))], &[]];
    let halves = setup(&[1, 2], &before, &halves, Property::ParentMismatch(3));
    let moved: [&[_]; 1] = [&[free(place(1, 2)), free(place(2, 3)), free(place(4, 2))]];
    let before = [base(1, "top"), node(2, "arm"), node(3, "hand"), deep(4, "high")];
    let moved = setup(&[1], &before, &moved, Property::LevelMismatch(3));
    let orphan: [&[_]; 1] = [&[free(place(1, 3)), free(Operation::DeleteNode { node: 1 })]];
    let orphan = setup(&[1], &[base(1, "left"), node(3, "child")], &orphan, Property::Orphan(3));
    vec![
        Row::new("36", "what is below a node that moves keeps its level", moved).unless(
            "nothing is below it",
            |setup| {
                setup.plays[0].calls.remove(1);
                setup.plays[0].calls_max = 2;
            },
        ),
        Row::new("37", "a deleted node stays the parent of its children", orphan)
            .unless("it is not deleted", |setup| setup.plays[0].calls_max = 1),
        Row::new("20", "two nodes of one name: each replica finds the other's", names)
            .unless("the names differ", |setup| setup.plays[1].calls[0].1 = node(2, "n")),
        Row::new("21", "a node gets two parents, and replicas answer by different ones", parents)
            .unless("one places it", |setup| setup.plays[1].calls_max = 0),
        Row::new("22", "two nodes are placed below each other: transforms never end", circle)
            .unless("one is placed", |setup| setup.plays[1].calls_max = 0),
        Row::new(
            "33",
            "a kinematic edge is seen before its parent and level",
            Setup { when: When::Always, ..halves },
        )
        .unless("only moments at rest are judged", |setup| setup.when = When::Quiet),
    ]
}
