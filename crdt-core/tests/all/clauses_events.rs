//! The clauses on changes, each by an example that says what is told, word for word.
use dsr_core::{
    Change, Changes, Dictionary, Dot, EdgeId, EdgeKey, Repair, Replica, ReplicaId, Rule, State, VertexId,
    view,
};
use dsr_testkit::state;

fn dictionary() -> Dictionary {
    Dictionary::open().with_functional("in")
}

fn dot(agent: u32, sequence: u64) -> Dot {
    Dot::new(ReplicaId::agent(agent), sequence)
}

fn edge(agent: u32, sequence: u64) -> EdgeId {
    EdgeId(dot(agent, sequence))
}

/// What a replica tells of a delta after a state, and what the readable reference says of both views.
#[track_caller]
fn check(before: &State, delta: &State, expected: &[Change]) {
    let mut replica = Replica::new(ReplicaId::agent(9), dictionary());
    replica.apply(before);
    let expected: Changes = expected.iter().cloned().collect();
    assert_eq!(replica.apply(delta), expected, "told");
    let (dictionary, after) = (dictionary(), before.joined(delta));
    assert_eq!(
        Changes::between(&view(before, &dictionary), &view(&after, &dictionary)),
        expected,
        "from scratch"
    );
}

/// Their deaths, and nothing else.
fn deaths(dead: &[Dot]) -> State {
    State::assemble([], dead.iter().copied().collect())
}

const ROOM: &str = "r1.1 vertex room kitchen @1
     r1.2 edge root -RT-> r1.1 @1
     r1.3 vertex robot robot @2
     r1.4 edge root -RT-> r1.3 @2
     r1.5 edge r1.3 -in-> r1.1 @3";

/// What comes is told with its author in its dot, what goes with its name and key; attributes with their element.
/// `[spec: EVENT-2]` `[spec: EVENT-3]` `[spec: EVENT-5]`
#[test]
fn oracle_a_vertex_comes_and_goes() {
    let before = state(ROOM);
    let whole = state(
        "r2.1 vertex cup cup @4
         r2.2 edge r1.1 -RT-> r2.1 @4
         r2.3 write r2.1 level=5 @4",
    );
    let (cup, level) = (VertexId(dot(2, 1)), "level".into());
    let key = EdgeKey::new(VertexId(dot(1, 1)), "RT", cup);
    check(
        &before,
        &whole,
        &[
            Change::VertexAdded { vertex: cup },
            Change::EdgeShown { edge: edge(2, 2), key: key.clone() },
            Change::Attribute { target: cup.0, name: level, before: None, after: Some(dot(2, 3)) },
        ],
    );
    let after = before.joined(&whole);
    check(
        &after,
        &deaths(&[cup.0]),
        &[
            Change::VertexRemoved { vertex: cup, name: "cup".into() },
            Change::EdgeHidden { edge: edge(2, 2), key },
            Change::Attribute { target: cup.0, name: "level".into(), before: Some(dot(2, 3)), after: None },
        ],
    );
}

/// A move hides the one and shows the other; a concurrent one is repaired, and that is told.
/// `[spec: EVENT-1]` `[spec: EVENT-2]` `[spec: EVENT-4]`
#[test]
fn oracle_two_moves_of_one_robot() {
    let before = state(ROOM).joined(&state("r1.6 vertex room hall @4\nr1.7 edge root -RT-> r1.6 @4"));
    let (robot, kitchen, hall) = (VertexId(dot(1, 3)), VertexId(dot(1, 1)), VertexId(dot(1, 6)));
    let (mine, theirs) = ("r2.1 edge r1.3 -in-> r1.6 @5", "r3.1 edge r1.3 -in-> r1.1 @6");
    let dead = deaths(&[dot(1, 5)]);
    let (mine, theirs) = (state(mine).joined(&dead), state(theirs).joined(&dead));
    let moved = Change::EdgeShown { edge: edge(2, 1), key: EdgeKey::new(robot, "in", hall) };
    let left = Change::EdgeHidden { edge: edge(1, 5), key: EdgeKey::new(robot, "in", kitchen) };
    check(&before, &mine, &[moved, left]);
    check(
        &before.joined(&mine),
        &theirs,
        &[
            Change::EdgeHidden { edge: edge(2, 1), key: EdgeKey::new(robot, "in", hall) },
            Change::EdgeShown { edge: edge(3, 1), key: EdgeKey::new(robot, "in", kitchen) },
            Change::RepairMade(Repair::Superseded {
                hidden: edge(2, 1),
                shown: edge(3, 1),
                rule: Rule::Functional,
            }),
        ],
    );
}

/// Of a write that loses it is told that other writes are shown, with one winner before and after; what is
/// repeated, and what changes nothing that is shown, is not told. `[spec: EVENT-3]` `[spec: EVENT-6]`
#[test]
fn oracle_losers_and_silence() {
    let before = state(ROOM).joined(&state("r2.1 write r1.1 level=5 @9"));
    let kitchen = dot(1, 1);
    let told = |before, after| Change::Attribute { target: kitchen, name: "level".into(), before, after };
    let winner = Some(dot(2, 1));
    check(&before, &state("r3.1 write r1.1 level=6 @4"), &[told(winner, winner)]);
    check(&before, &state("r3.1 write r1.1 level=6 @10"), &[told(winner, Some(dot(3, 1)))]);
    check(&before, &before, &[]);
    // It waits for its vertex.
    check(&before, &state("r4.2 write r4.1 level=1 @1"), &[]);
}
