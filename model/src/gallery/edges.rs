//! Edges, and the nodes that they need.

use super::{END, NODE, Row, free, link, setup};
use crate::published::{CALL_TIME, Guard, Operation, Order, Property, Setup, When};

/// From node 1 to node 2.
const EDGE: Operation = link(1, 2);
const DELETE_END: Operation = Operation::DeleteNode { node: 2 };
const UNLINKED: Guard = Guard::Unlinked(1, 2, "in");

/// The edge with `p`.
const fn with(p: &'static [(&'static str, i64)]) -> Operation {
    Operation::AssignEdge { from: 1, to: 2, kind: "in", attributes: p }
}

pub(super) fn rows() -> Vec<Row> {
    [replaced(), dangling(), waiting(), ghost()].concat()
}

/// Edges that are inserted twice.
fn replaced() -> Vec<Row> {
    let twice: [&[_]; 2] =
        [&[free(with(&[("p", 1)])), free(with(&[("p", 2)]))], &[(UNLINKED, with(&[("p", 9)]))]];
    let twice = setup(&[2, 1], &[NODE, END], &twice, Property::Divergence);
    let again: [&[_]; 2] = [&[free(DELETE_EDGE), free(with(&[("p", 5)]))], &[]];
    let mut again = setup(&[1, 2], &[NODE, END, EDGE], &again, Property::Divergence);
    again.powers.order = Order::Pool;
    let seen: [&[_]; 3] = [&[free(EDGE)], &[(Guard::Linked(1, 2, "in"), DELETE_EDGE)], &[]];
    let seen = setup(&[1, 2, 3], &[NODE, END], &seen, Property::Divergence);
    vec![
        Row::new("34", "the removal of an edge overtakes its insertion", seen)
            .unless("messages arrive after what caused them", |setup| setup.powers.order = Order::Causal),
        Row::new("7", "an edge inserted twice, and an update of one of them", twice)
            .unless("neither is updated", |setup| setup.plays[0].calls_max = 1),
        Row::new("8", "an edge inserted again overtakes its deletion", again)
            .unless("each topic keeps its order", |setup| setup.powers.order = Order::Topic),
    ]
}

const DELETE_EDGE: Operation = Operation::DeleteEdge { from: 1, to: 2, kind: "in" };

/// Edges whose end is deleted.
fn dangling() -> Vec<Row> {
    let any = Property::Dangling(None);
    let left = setup(&[1, 2], &[NODE, END, EDGE], &[&[free(DELETE_END)], &[]], any);
    let both: [&[_]; 2] = [&[free(DELETE_END)], &[free(EDGE)]];
    let both = setup(&[1, 2], &[NODE, END], &both, any);
    let other = Operation::AssignEdge { from: 1, to: 2, kind: "has", attributes: &[] };
    let labels: [&[_]; 1] = [&[free(DELETE_EDGE), free(DELETE_END)]];
    let labels = setup(&[1], &[NODE, END, EDGE, other], &labels, any);
    vec![
        Row::new("9", "a deleted node leaves edges behind that ended at it", left)
            .unless("no edge ends at it", |setup| setup.before.truncate(2)),
        Row::new("10", "a node is deleted while an edge to it is inserted", both)
            .unless("no node is deleted", |setup| setup.plays[0].calls_max = 0),
        Row::new(
            "28",
            "deleting one of two edges hides the other from the deletion of its end",
            Setup { when: When::Always, ..labels },
        )
        .unless("there is one edge", |setup| setup.before.truncate(3)),
    ]
}

/// Edges that arrive before their nodes.
fn waiting() -> Vec<Row> {
    let back = Operation::AssignEdge { from: 2, to: 1, kind: "in", attributes: &[] };
    let reversed: [&[_]; 2] = [&[free(NODE), free(END), free(back), free(EDGE)], &[]];
    let mut reversed = setup(&[1, 2], &[], &reversed, Property::Divergence);
    reversed.powers.order = Order::Topic;
    let late: [&[_]; 3] = [&[free(NODE), free(DELETE_END)], &[free(END), free(EDGE)], &[]];
    let late = setup(&[1, 2, 3], &[], &late, Property::Dangling(Some(2)));
    let mut late = Setup { when: When::Finished, ..late };
    late.powers.order = Order::Pool;
    late.powers.slow = Some((1, 2));
    vec![
        Row::new("17", "an edge that waits is joined into one of the opposite direction", reversed).unless(
            "there is no opposite edge",
            |setup| {
                setup.plays[0].calls.remove(2);
                setup.plays[0].calls_max = 3;
            },
        ),
        Row::new("29", "an edge waits for its start while its end is deleted", late)
            .unless("the end is not deleted", |setup| setup.plays[0].calls_max = 1),
    ]
}

/// Attributes that wait for an edge.
fn ghost() -> Vec<Row> {
    let update = (Guard::Linked(1, 2, "in"), with(&[("p", 7)]));
    let calls: [&[_]; 3] = [&[free(DELETE_EDGE)], &[update], &[(UNLINKED, EDGE)]];
    let mut ghost =
        setup(&[1, 2, 3], &[NODE, END, with(&[("p", 1)])], &calls, Property::OnlyAt(0, 1, 2, "p"));
    ghost.powers.order = Order::Causal;
    ghost.powers.ahead = vec![100 * CALL_TIME, 100 * CALL_TIME, 0];
    vec![
        Row::new("30", "an update of a deleted edge returns with the next edge", ghost)
            .unless("clocks are right", |setup| setup.powers.ahead.clear()),
    ]
}
