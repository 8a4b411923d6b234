//! The conflict table: each row played on two replicas, joined both ways. The claims of r2 are the greater
//! ones, because both authors start from one state and so use one stamp.

use crate::clauses_common::*;
use dsr_core::{AttributeMap, Mutation, Placement, RT, Repair, Value, VertexId};

fn named(peer: &Peer, name: &str) -> VertexId {
    peer.view().vertex_by_name(name).unwrap()
}

fn detached(peer: &Peer, vertex: VertexId) -> bool {
    let reported = peer.view().repairs().contains(&Repair::Detached { vertex });
    assert_eq!(reported, peer.view().placement(vertex) == Some(Placement::Detached));
    reported
}

fn reattached(peer: &Peer, vertex: VertexId) -> bool {
    peer.view().repairs().contains(&Repair::Reattached { vertex })
}

fn has(peer: &Peer, vertex: VertexId) -> bool {
    peer.view().has_vertex(vertex)
}

/// The first rule of all rows, with the second: an edge to a removed vertex goes, a new edge stays.
/// [spec: CONFLICT-0]
#[test]
fn oracle_removal_of_a_vertex_beats_a_new_edge_which_beats_removal_of_an_older_one() {
    let flat = flat();
    let again = concurrent(&flat.base, &edge(flat.drone, "sees", flat.pole), &destroy(flat.pole));
    assert!(!again.shows(flat.drone, "sees", flat.pole));
    let again = concurrent(
        &flat.base,
        &relocate(key(flat.drone, "sees", flat.hall), key(flat.drone, "sees", flat.pole)),
        &remove(key(flat.drone, "sees", flat.hall)),
    );
    assert!(again.shows(flat.drone, "sees", flat.pole));
}

/// [spec: CONFLICT-1]
#[test]
fn oracle_add_vertex_add_vertex() {
    let flat = flat();
    let both = concurrent(&flat.base, &child(ROOT, "chair"), &child(ROOT, "stool"));
    assert_eq!(both.repairs(), [""; 0]);
    assert!(both.view().vertex_by_name("chair").is_some() && both.view().vertex_by_name("stool").is_some());

    let clash = concurrent(&flat.base, &child(ROOT, "chair"), &child(ROOT, "chair"));
    assert_eq!(clash.repairs(), ["name-clash"]);
    assert_eq!(named(&clash, "chair").0.replica.agent, 1, "equal stamps: the least dot");
    assert_eq!(clash.view().vertices().len(), flat.base.view().vertices().len() + 2);

    let rooms =
        concurrent(&flat.base, &entered("attic", "in", flat.drone), &entered("cellar", "in", flat.drone));
    assert_eq!(rooms.repairs(), ["functional", "reattached"]);
    assert!(rooms.shows(flat.drone, "in", named(&rooms, "cellar")));
    assert!(reattached(&rooms, named(&rooms, "attic")));
}

/// [spec: CONFLICT-2]
#[test]
fn oracle_add_vertex_add_edge() {
    let flat = flat();
    let both = concurrent(&flat.base, &child(ROOT, "chair"), &edge(flat.drone, "in", flat.hall));
    assert_eq!(both.repairs(), [""; 0]);
    assert!(both.shows(flat.drone, "in", flat.hall) && has(&both, named(&both, "chair")));

    let (link, rival) = (entered("attic", "in", flat.drone), edge(flat.drone, "in", flat.hall));
    let edge_wins = concurrent(&flat.base, &link, &rival);
    assert_eq!(edge_wins.repairs(), ["functional", "reattached"]);
    assert!(edge_wins.shows(flat.drone, "in", flat.hall));
    assert!(reattached(&edge_wins, named(&edge_wins, "attic")));
    let link_wins = concurrent(&flat.base, &rival, &link);
    assert_eq!(link_wins.repairs(), ["functional"]);
    assert!(link_wins.shows(flat.drone, "in", named(&link_wins, "attic")));
}

/// [spec: CONFLICT-3]
#[test]
fn oracle_add_vertex_update_attributes() {
    let flat = flat();
    let both = concurrent(&flat.base, &child(flat.kitchen, "chair"), &set(of(flat.kitchen), "area", 12_i32));
    assert_eq!(both.repairs(), [""; 0]);
    assert!(both.shows(flat.kitchen, RT, named(&both, "chair")));
    assert_eq!(both.value(flat.kitchen, "area"), Some(Value::Int(12)));
}

/// [spec: CONFLICT-4]
#[test]
fn oracle_add_vertex_remove_edge() {
    let flat = flat();
    let both =
        concurrent(&flat.base, &child(flat.lamp, "bulb"), &remove(key(flat.lamp, "near", flat.kitchen)));
    assert_eq!(both.repairs(), [""; 0]);
    assert!(!both.shows(flat.lamp, "near", flat.kitchen) && both.shows(flat.lamp, RT, named(&both, "bulb")));

    let orphan = concurrent(&flat.base, &child(flat.lamp, "bulb"), &remove(parent(ROOT, flat.lamp)));
    assert_eq!(orphan.repairs(), ["detached"]);
    assert!(detached(&orphan, flat.lamp) && orphan.shows(flat.lamp, RT, named(&orphan, "bulb")));
}

/// [spec: CONFLICT-5]
#[test]
fn oracle_add_vertex_move_edge() {
    let flat = flat();
    let away = relocate(parent(ROOT, flat.lamp), parent(flat.hall, flat.lamp));
    let follows = concurrent(&flat.base, &child(flat.lamp, "bulb"), &away);
    assert_eq!(follows.repairs(), [""; 0]);
    let way: Vec<VertexId> = follows.view().ancestors(named(&follows, "bulb")).skip(1).collect();
    assert_eq!(way, [flat.lamp, flat.hall, ROOT]);

    let rival = relocate(key(flat.drone, "near", flat.kitchen), key(flat.drone, "in", flat.hall));
    let rooms = concurrent(&flat.base, &entered("attic", "in", flat.drone), &rival);
    assert_eq!(rooms.repairs(), ["functional", "reattached"]);
    assert!(rooms.shows(flat.drone, "in", flat.hall));

    let out = relocate(parent(ROOT, flat.lamp), key(flat.lamp, "beside", flat.hall));
    let orphan = concurrent(&flat.base, &child(flat.lamp, "bulb"), &out);
    assert_eq!(orphan.repairs(), ["detached"]);
    assert!(detached(&orphan, flat.lamp));
}

/// [spec: CONFLICT-6]
#[test]
fn oracle_add_vertex_remove_vertex() {
    let flat = flat();
    let alone = concurrent(&flat.base, &linked("parcel", "near", flat.drone), &destroy(flat.drone));
    assert_eq!(alone.repairs(), ["reattached"]);
    assert!(reattached(&alone, named(&alone, "parcel")) && !has(&alone, flat.drone));

    let orphan = concurrent(&flat.base, &child(flat.cup, "tea"), &destroy(flat.shelf));
    assert_eq!(orphan.repairs(), ["detached"]);
    assert!(detached(&orphan, flat.cup) && orphan.shows(flat.cup, RT, named(&orphan, "tea")));
}

/// [spec: CONFLICT-7]
#[test]
fn oracle_add_edge_add_edge() {
    let flat = flat();
    let both =
        concurrent(&flat.base, &edge(flat.drone, "sees", flat.lamp), &edge(flat.drone, "sees", flat.cup));
    assert_eq!(both.repairs(), [""; 0]);
    assert!(both.shows(flat.drone, "sees", flat.lamp) && both.shows(flat.drone, "sees", flat.cup));

    let same = edge(flat.drone, "sees", flat.lamp);
    let same = concurrent(&flat.base, &same, &same);
    assert_eq!(same.repairs(), ["same-key"]);
    assert_eq!(same.shown(flat.drone, "sees", flat.lamp).unwrap().0.replica.agent, 2);

    let rooms =
        concurrent(&flat.base, &edge(flat.drone, "in", flat.kitchen), &edge(flat.drone, "in", flat.hall));
    assert_eq!(rooms.repairs(), ["functional"]);
    assert!(rooms.shows(flat.drone, "in", flat.hall) && !rooms.shows(flat.drone, "in", flat.kitchen));

    let parents =
        concurrent(&flat.base, &edge(flat.kitchen, RT, flat.drone), &edge(flat.hall, RT, flat.drone));
    assert_eq!(parents.repairs(), ["rt-parent"]);
    assert!(parents.shows(flat.hall, RT, flat.drone) && !parents.shows(flat.kitchen, RT, flat.drone));

    // Each has taken its own child out of the tree before.
    let (mut one, mut two) = (flat.base.fork(1), flat.base.fork(2));
    one.apply(&remove(parent(ROOT, flat.lamp)));
    two.apply(&remove(parent(flat.shelf, flat.cup)));
    one.edge(flat.cup, RT, flat.lamp);
    two.edge(flat.lamp, RT, flat.cup);
    let cycle = met(&one, &two);
    assert_eq!(cycle.repairs(), ["cycle-broken", "detached"]);
    assert!(cycle.shows(flat.lamp, RT, flat.cup) && detached(&cycle, flat.lamp));
}

/// [spec: CONFLICT-8]
#[test]
fn oracle_add_edge_update_attributes() {
    let flat = flat();
    let both =
        concurrent(&flat.base, &edge(flat.drone, "sees", flat.lamp), &set(on(flat.sees), "since", 3_i32));
    assert_eq!(both.repairs(), [""; 0]);
    assert!(both.shows(flat.drone, "sees", flat.lamp));
    assert_eq!(both.value(flat.sees, "since"), Some(Value::Int(3)));

    // r1 holds the edge to the attic as pending, and supersedes it; r2 updates it.
    let (mut one, mut two) = (flat.base.fork(1), flat.base.fork(2));
    let attic = two.child(ROOT, "attic");
    let claim = two.edge(flat.drone, "in", attic);
    let mut half = flat.base.fork(2);
    half.apply(&child(ROOT, "attic"));
    one.state.join(&dsr_core::delta_for(&two.state, &dsr_core::digest(&half.state)));
    assert!(one.state.holds(claim.0) && !one.shows(flat.drone, "in", attic));
    one.edge(flat.drone, "in", flat.hall);
    two.apply(&set(on(claim), "since", 3_i32));
    let superseded = met(&one, &two);
    assert_eq!(superseded.repairs(), [""; 0]);
    assert!(superseded.shows(flat.drone, "in", flat.hall));
    assert_eq!(superseded.value(claim, "since"), None);
}

/// [spec: CONFLICT-9]
#[test]
fn oracle_add_edge_remove_edge() {
    let flat = flat();
    let both = concurrent(
        &flat.base,
        &edge(flat.drone, "in", flat.hall),
        &remove(key(flat.drone, "sees", flat.hall)),
    );
    assert_eq!(both.repairs(), [""; 0]);
    assert!(both.shows(flat.drone, "in", flat.hall) && !both.shows(flat.drone, "sees", flat.hall));

    // The same key: r1 removes and adds again, r2 removes.
    let (mut one, mut two) = (flat.base.fork(1), flat.base.fork(2));
    let removal = remove(key(flat.drone, "sees", flat.hall));
    one.apply(&removal);
    two.apply(&removal);
    let again = one.edge(flat.drone, "sees", flat.hall);
    let stays = met(&one, &two);
    assert_eq!(stays.repairs(), [""; 0]);
    assert_eq!(stays.shown(flat.drone, "sees", flat.hall), Some(again));

    let orphan = concurrent(&flat.base, &edge(flat.lamp, RT, flat.drone), &remove(parent(ROOT, flat.lamp)));
    assert_eq!(orphan.repairs(), ["detached"]);
    assert!(detached(&orphan, flat.lamp) && orphan.shows(flat.lamp, RT, flat.drone));
}

/// [spec: CONFLICT-10]
#[test]
fn oracle_add_edge_move_edge() {
    let flat = flat();
    let near = key(flat.drone, "near", flat.kitchen);
    let lamp = parent(ROOT, flat.lamp);
    let cases = [
        (edge(flat.lamp, RT, flat.drone), lamp.clone(), parent(flat.hall, flat.lamp), vec![]),
        (
            edge(flat.drone, "sees", flat.lamp),
            near.clone(),
            key(flat.drone, "sees", flat.lamp),
            vec!["same-key"],
        ),
        (edge(flat.drone, "in", flat.kitchen), near, key(flat.drone, "in", flat.hall), vec!["functional"]),
        (edge(flat.kitchen, RT, flat.drone), lamp.clone(), parent(flat.hall, flat.drone), vec!["rt-parent"]),
        (edge(flat.lamp, RT, flat.drone), lamp, key(flat.lamp, "beside", flat.hall), vec!["detached"]),
    ];
    for (addition, from, to, repairs) in cases {
        let both = concurrent(&flat.base, &addition, &relocate(from.clone(), to.clone()));
        assert_eq!(both.repairs(), repairs);
        assert!(both.view().edge_by_key(&from).is_none(), "gone from its old key: {from}");
        assert_eq!(both.view().edge_by_key(&to).unwrap().id.0.replica.agent, 2, "shown: {to}");
    }
}

/// [spec: CONFLICT-11]
#[test]
fn oracle_add_edge_remove_vertex() {
    let flat = flat();
    let attributes = AttributeMap::from([("since".into(), Value::Int(3))]);
    let addition = Mutation::AddEdge { key: key(flat.drone, "sees", flat.lamp), attributes };
    let gone = concurrent(&flat.base, &addition, &destroy(flat.lamp));
    assert_eq!(gone.repairs(), [""; 0]);
    assert!(!gone.shows(flat.drone, "sees", flat.lamp) && has(&gone, flat.drone));
    assert_eq!(gone.view().writes(), []);

    let orphan = concurrent(&flat.base, &edge(flat.cup, RT, flat.drone), &destroy(flat.shelf));
    assert_eq!(orphan.repairs(), ["detached"]);
    assert!(detached(&orphan, flat.cup));
}

/// [spec: CONFLICT-12]
#[test]
fn oracle_update_attributes_update_attributes() {
    let mut flat = flat();
    let hall = of(flat.hall);
    let sets = concurrent(&flat.base, &set(hall, "light", 9_i32), &set(hall, "light", 1_i32));
    assert_eq!(sets.repairs(), [""; 0]);
    let values: Vec<Value> = sets
        .view()
        .attribute_writes(flat.hall, "light")
        .iter()
        .map(|(_, write)| write.value.clone())
        .collect();
    assert_eq!(values, [Value::Int(1), Value::Int(9)], "the greatest rank first, not the greatest value");

    let different = concurrent(&flat.base, &set(hall, "light", 9_i32), &set(hall, "heat", 1_i32));
    assert_eq!(different.value(flat.hall, "light"), Some(Value::Int(9)));
    assert_eq!(different.value(flat.hall, "heat"), Some(Value::Int(1)));

    flat.base.apply(&set(hall, "light", 5_i32));
    let survives = concurrent(&flat.base, &set(hall, "light", 9_i32), &unset(hall, "light"));
    assert_eq!(survives.value(flat.hall, "light"), Some(Value::Int(9)));
    let gone = concurrent(&flat.base, &unset(hall, "light"), &unset(hall, "light"));
    assert_eq!(gone.value(flat.hall, "light"), None);
    assert_eq!(gone.repairs(), [""; 0]);
}

/// [spec: CONFLICT-13]
#[test]
fn oracle_update_attributes_remove_edge() {
    let flat = flat();
    let removal = remove(key(flat.drone, "sees", flat.hall));
    let gone = concurrent(&flat.base, &set(on(flat.sees), "since", 3_i32), &removal);
    assert_eq!(gone.repairs(), [""; 0]);
    assert!(!gone.shows(flat.drone, "sees", flat.hall));
    assert_eq!(gone.state.records().filter(|(dot, _)| gone.state.write(*dot).is_some()).count(), 0);
    let both = concurrent(&flat.base, &set(of(flat.drone), "battery", 3_i32), &removal);
    assert_eq!(both.value(flat.drone, "battery"), Some(Value::Int(3)));
    assert!(!both.shows(flat.drone, "sees", flat.hall));
}

/// [spec: CONFLICT-14]
#[test]
fn oracle_update_attributes_move_edge() {
    let flat = flat();
    let attributes = AttributeMap::from([("since".into(), Value::Int(7))]);
    let to = key(flat.drone, "sees", flat.lamp);
    let away = Mutation::MoveEdge { from: key(flat.drone, "sees", flat.hall), to: to.clone(), attributes };
    let moved = concurrent(&flat.base, &set(on(flat.sees), "since", 3_i32), &away);
    assert_eq!(moved.repairs(), [""; 0]);
    let id = moved.view().edge_by_key(&to).unwrap().id;
    assert_eq!(moved.value(id, "since"), Some(Value::Int(7)));
    assert_eq!(moved.view().writes().len(), 1, "the write on the old instance is gone");
    let both = concurrent(&flat.base, &set(of(flat.drone), "battery", 3_i32), &away);
    assert_eq!(both.value(flat.drone, "battery"), Some(Value::Int(3)));
    assert!(both.shows(flat.drone, "sees", flat.lamp));
}

/// [spec: CONFLICT-15]
#[test]
fn oracle_update_attributes_remove_vertex() {
    let flat = flat();
    for target in [of(flat.drone), on(flat.sees)] {
        let gone = concurrent(&flat.base, &set(target, "since", 3_i32), &destroy(flat.drone));
        assert_eq!(gone.repairs(), [""; 0]);
        assert!(!has(&gone, flat.drone));
        assert_eq!(gone.view().writes(), []);
    }
    let both = concurrent(&flat.base, &set(of(flat.hall), "light", 3_i32), &destroy(flat.drone));
    assert_eq!(both.value(flat.hall, "light"), Some(Value::Int(3)));
}

/// [spec: CONFLICT-16]
#[test]
fn oracle_remove_edge_remove_edge() {
    let flat = flat();
    let (near, sees) = (key(flat.drone, "near", flat.kitchen), key(flat.drone, "sees", flat.hall));
    let once = concurrent(&flat.base, &remove(sees.clone()), &remove(sees.clone()));
    assert_eq!(once.repairs(), [""; 0]);
    assert!(once.view().edge_by_key(&sees).is_none());
    let alone = concurrent(&flat.base, &remove(near), &remove(sees));
    assert_eq!(alone.repairs(), ["reattached"]);
    assert!(reattached(&alone, flat.drone));
}

/// [spec: CONFLICT-17]
#[test]
fn oracle_remove_edge_move_edge() {
    let flat = flat();
    let sees = key(flat.drone, "sees", flat.hall);
    let moved = concurrent(
        &flat.base,
        &relocate(sees.clone(), key(flat.drone, "sees", flat.lamp)),
        &remove(sees.clone()),
    );
    assert_eq!(moved.repairs(), [""; 0]);
    assert!(moved.shows(flat.drone, "sees", flat.lamp) && moved.view().edge_by_key(&sees).is_none());
    let lamp = parent(ROOT, flat.lamp);
    let moved =
        concurrent(&flat.base, &relocate(lamp.clone(), parent(flat.hall, flat.lamp)), &remove(lamp.clone()));
    assert_eq!(moved.repairs(), [""; 0]);
    assert!(moved.shows(flat.hall, RT, flat.lamp));

    let below = relocate(parent(flat.shelf, flat.cup), parent(flat.lamp, flat.cup));
    let orphan = concurrent(&flat.base, &below, &remove(lamp));
    assert_eq!(orphan.repairs(), ["detached"]);
    assert!(detached(&orphan, flat.lamp) && orphan.shows(flat.lamp, RT, flat.cup));

    let away = relocate(sees, key(flat.robot, "sees", flat.hall));
    let alone = concurrent(&flat.base, &away, &remove(key(flat.drone, "near", flat.kitchen)));
    assert_eq!(alone.repairs(), ["reattached"]);
    assert!(reattached(&alone, flat.drone));
}

/// [spec: CONFLICT-18]
#[test]
fn oracle_remove_edge_remove_vertex() {
    let mut flat = flat();
    let sees = key(flat.drone, "sees", flat.hall);
    let both = concurrent(&flat.base, &remove(sees), &destroy(flat.drone));
    assert_eq!(both.repairs(), [""; 0]);
    assert!(!has(&both, flat.drone));
    let kite = flat.base.linked("kite", "near", flat.pole);
    flat.base.edge(kite, "near", flat.hall);
    let alone = concurrent(&flat.base, &remove(key(kite, "near", flat.hall)), &destroy(flat.pole));
    assert_eq!(alone.repairs(), ["reattached"]);
    assert!(reattached(&alone, kite));
}

/// [spec: CONFLICT-19]
#[test]
fn oracle_move_edge_move_edge() {
    let flat = flat();
    let (inside, cup, sees) = (
        key(flat.robot, "in", flat.kitchen),
        parent(flat.shelf, flat.cup),
        key(flat.drone, "sees", flat.hall),
    );
    let cases = [
        (&inside, key(flat.robot, "in", flat.hall), key(flat.robot, "in", flat.pole), "functional"),
        (&cup, parent(flat.kitchen, flat.cup), parent(flat.hall, flat.cup), "rt-parent"),
        (&sees, key(flat.drone, "sees", flat.cup), key(flat.drone, "sees", flat.cup), "same-key"),
    ];
    for (from, first, second, repair) in cases {
        let one = concurrent(
            &flat.base,
            &relocate(from.clone(), first.clone()),
            &relocate(from.clone(), second.clone()),
        );
        assert_eq!(one.repairs(), [repair]);
        assert_eq!(one.view().edge_by_key(&second).unwrap().id.0.replica.agent, 2);
        assert!(first == second || one.view().edge_by_key(&first).is_none());
        assert!(one.view().edge_by_key(from).is_none());
    }

    let (lamp, cup) = (key(flat.drone, "sees", flat.lamp), key(flat.drone, "sees", flat.cup));
    let both = concurrent(&flat.base, &relocate(sees.clone(), lamp), &relocate(sees, cup));
    assert_eq!(both.repairs(), [""; 0]);
    assert!(both.shows(flat.drone, "sees", flat.lamp) && both.shows(flat.drone, "sees", flat.cup));

    let kitchen_below = relocate(parent(ROOT, flat.kitchen), parent(flat.hall, flat.kitchen));
    let hall_below = relocate(parent(ROOT, flat.hall), parent(flat.kitchen, flat.hall));
    let cycle = concurrent(&flat.base, &kitchen_below, &hall_below);
    assert_eq!(cycle.repairs(), ["cycle-broken", "detached"]);
    assert!(cycle.shows(flat.kitchen, RT, flat.hall) && detached(&cycle, flat.kitchen));
}

/// [spec: CONFLICT-20]
#[test]
fn oracle_move_edge_remove_vertex() {
    let flat = flat();
    let room = relocate(key(flat.robot, "in", flat.kitchen), key(flat.robot, "in", flat.pole));
    let alone = concurrent(&flat.base, &room, &destroy(flat.pole));
    assert_eq!(alone.repairs(), ["reattached"]);
    assert!(reattached(&alone, flat.robot));
    assert_eq!(alone.view().edges_from(flat.robot), []);

    let bowl = relocate(parent(flat.table, flat.bowl), parent(flat.pole, flat.bowl));
    let orphan = concurrent(&flat.base, &bowl, &destroy(flat.pole));
    assert_eq!(orphan.repairs(), ["detached"]);
    assert!(detached(&orphan, flat.bowl) && orphan.shows(flat.bowl, RT, flat.spoon));

    let cup = relocate(parent(flat.shelf, flat.cup), parent(flat.hall, flat.cup));
    let moved = concurrent(&flat.base, &cup, &destroy(flat.shelf));
    assert_eq!(moved.repairs(), [""; 0]);
    assert!(moved.shows(flat.hall, RT, flat.cup));
}

/// [spec: CONFLICT-21]
#[test]
fn oracle_remove_vertex_remove_vertex() {
    let mut flat = flat();
    let gone = concurrent(&flat.base, &destroy(flat.pole), &destroy(flat.pole));
    assert_eq!(gone.repairs(), [""; 0]);
    assert!(!has(&gone, flat.pole));

    let (mut one, mut two) = (flat.base.fork(1), flat.base.fork(2));
    one.apply(&relocate(parent(flat.table, flat.bowl), parent(flat.pole, flat.bowl)));
    two.apply(&relocate(parent(flat.table, flat.bowl), parent(flat.post, flat.bowl)));
    let claimed = met(&one, &two);
    assert_eq!(claimed.repairs(), ["rt-parent"]);
    let orphan = concurrent(&claimed, &destroy(flat.pole), &destroy(flat.post));
    assert_eq!(orphan.repairs(), ["detached"]);
    assert!(detached(&orphan, flat.bowl));

    let kite = flat.base.linked("kite", "near", flat.pole);
    flat.base.edge(kite, "near", flat.post);
    let alone = concurrent(&flat.base, &destroy(flat.pole), &destroy(flat.post));
    assert_eq!(alone.repairs(), ["reattached"]);
    assert!(reattached(&alone, kite));
}
