//! The six mutations: every condition, every error, every effect.

use crate::clauses_common::*;
use dsr_core::{
    AddEdgeError, AddVertexError, AttributeError, AttributeMap, AttributeUpdates, Author, CausalContext,
    Delta, Dictionary, Dot, EdgeId, ElementId, ExhaustedError, MoveEdgeError, Mutation, MutationError,
    MutationKind, NewEdgeError, NewVertex, Placement, RT, Record, RemoveEdgeError, RemoveVertexError,
    ReplicaId, State, StrandError, UpdateAttributesError, Value, ValueType, Vertex, VertexId, VertexLink,
    check_well_formed, delta_for, digest, limits,
};

/// Refused with exactly this error. Mutations are functions of a view, so nothing can have changed.
#[track_caller]
fn refused(peer: &Peer, mutation: &Mutation, expected: impl Into<MutationError>) {
    let before = peer.state.clone();
    assert_eq!(peer.attempt(mutation), Err(expected.into()));
    assert_eq!(peer.state, before);
}

fn dot(agent: u32, sequence: u64) -> Dot {
    Dot::new(ReplicaId::agent(agent), sequence)
}

const NOBODY: VertexId = VertexId(Dot::new(ReplicaId::agent(9), 9));

fn strands(vertices: &[VertexId]) -> StrandError {
    StrandError { vertices: vertices.to_vec() }
}

fn link_error(error: NewEdgeError) -> AddVertexError {
    error.into()
}

fn with_attributes(mutation: Mutation, given: &[(&str, Value)]) -> Mutation {
    let map: AttributeMap = given.iter().map(|(name, value)| ((*name).into(), value.clone())).collect();
    match mutation {
        Mutation::AddVertex { vertex, link } => {
            Mutation::AddVertex { vertex: NewVertex { attributes: map, ..vertex }, link }
        }
        Mutation::AddEdge { key, .. } => Mutation::AddEdge { key, attributes: map },
        Mutation::MoveEdge { from, to, .. } => Mutation::MoveEdge { from, to, attributes: map },
        other => other,
    }
}

/// The dots of a delta's context.
fn dots(delta: &Delta) -> Vec<Dot> {
    delta.context().runs().flat_map(dsr_core::Run::dots).collect()
}

fn held(delta: &Delta) -> Vec<Dot> {
    delta.records().map(|(dot, _)| dot).collect()
}

/// One accepted mutation of each kind in the small flat.
fn one_of_each(flat: &Flat) -> [Mutation; 6] {
    let each = [
        with_attributes(child(flat.kitchen, "chair"), &[("weight", Value::Int(3))]),
        with_attributes(edge(flat.drone, "in", flat.hall), &[("since", Value::Int(3))]),
        set(of(flat.hall), "light", 3_i32),
        remove(key(flat.drone, "sees", flat.hall)),
        relocate(parent(flat.table, flat.bowl), parent(flat.hall, flat.bowl)),
        destroy(flat.shelf),
    ];
    assert_eq!(each.clone().map(|mutation| mutation.kind()), MutationKind::ALL);
    each
}

/// [spec: MUT-0]
#[test]
fn law_mutations_are_pure_functions_of_the_view() {
    let flat = flat();
    for mutation in one_of_each(&flat) {
        let delta = flat.base.attempt(&mutation).unwrap();
        assert_eq!(flat.base.attempt(&mutation).unwrap(), delta, "the same again: nothing was changed");
    }
}

/// [spec: MUT-0.1] [spec: STATE-5]
#[test]
fn law_deltas_name_only_what_they_make_and_kill() {
    let flat = flat();
    for mutation in one_of_each(&flat) {
        let delta = flat.base.attempt(&mutation).unwrap();
        for dot in dots(&delta) {
            assert_ne!(
                delta.holds(dot),
                flat.base.state.holds(dot),
                "{dot} is new, or held before and killed"
            );
        }
        assert!(flat.base.state.is_below(&flat.base.state.joined(&delta)));
        assert!(delta.is_below(&flat.base.state.joined(&delta)));
    }
}

/// [spec: MUT-0.2] [spec: STAMP-1] [spec: ID-1]
#[test]
fn law_dots_of_a_delta_follow_each_other_under_one_stamp() {
    let mut flat = flat();
    flat.base.author.timestamp_ns = 77;
    for mutation in one_of_each(&flat) {
        let delta = flat.base.attempt(&mutation).unwrap();
        let expected: Vec<Dot> = (flat.base.next().sequence..).map(|n| dot(1, n)).take(delta.len()).collect();
        assert_eq!(held(&delta), expected);
        for (_, record) in delta.records() {
            assert_eq!(record.stamp(), flat.base.state.greatest_stamp() + 1);
            if let Record::Write(write) = record {
                assert_eq!(write.timestamp_ns, 77);
            }
        }
        if matches!(mutation.kind(), MutationKind::RemoveEdge | MutationKind::RemoveVertex) {
            assert!(delta.is_empty());
        }
    }
}

/// [spec: MUT-0.4]
#[test]
fn law_a_group_of_deltas_is_one_delta() {
    let mut flat = flat();
    let before = flat.base.state.clone();
    let mut group = Delta::new();
    group.join(&flat.base.apply(&remove(key(flat.drone, "sees", flat.hall))));
    group.join(&flat.base.apply(&edge(flat.drone, "in", flat.hall)));
    group.join(
        &flat.base.apply(&relocate(key(flat.drone, "in", flat.hall), key(flat.drone, "in", flat.kitchen))),
    );
    assert_eq!(before.joined(&group), flat.base.state);
    assert_eq!(group.len(), 1, "the step between is dead already");
}

/// [spec: MUT-1] [spec: MUT-1.1] [spec: MUT-1.5] [spec: ID-2]
#[test]
fn oracle_add_vertex_shows_vertex_and_link() {
    let flat = flat();
    let mut peer = flat.base.fork(3);
    let vertex = NewVertex {
        external_id: Some(100),
        attributes: AttributeMap::from([("b".into(), Value::Int(2)), ("a".into(), Value::Int(1))]),
        ..NewVertex::new("cat", "tom")
    };
    let link = VertexLink {
        attributes: AttributeMap::from([("since".into(), Value::Int(3))]),
        ..VertexLink::to("in", flat.hall)
    };
    let delta = peer.apply(&Mutation::AddVertex { vertex, link });
    let kinds: Vec<&str> = delta
        .records()
        .map(|(_, record)| match record {
            Record::Vertex(_) => "vertex",
            Record::Edge(_) => "edge",
            Record::Write(write) => &write.name,
        })
        .collect();
    assert_eq!(kinds, ["vertex", "edge", "since", "a", "b"]);
    let view = peer.view();
    let tom = VertexId(dot(3, 1));
    assert_eq!(view.vertex_by_name("tom"), Some(tom));
    assert_eq!(view.vertex(tom).unwrap().external_id, Some(100));
    assert!(view.edge(tom, "in", flat.hall).is_some_and(|shown| shown.id == EdgeId(dot(3, 2))));
    assert_eq!(view.attributes_of(tom).map(|(_, write)| &*write.name).collect::<Vec<_>>(), ["a", "b"]);
    assert_eq!(view.attributes_of(dot(3, 2)).count(), 1);
    assert_eq!(view.placement(tom), Some(Placement::Outside));
}

/// [spec: MUT-1.1] [spec: MUT-2.2]
#[test]
fn oracle_add_vertex_refuses_impossible_links() {
    let mut flat = flat();
    let functional = |existing| NewEdgeError::FunctionalTaken { label: "in".into(), existing };
    let cases = [
        (linked("x", "near", NOBODY), NewEdgeError::UnknownVertex { vertex: NOBODY }),
        (child(NOBODY, "x"), NewEdgeError::UnknownVertex { vertex: NOBODY }),
        (linked("x", "", flat.hall), NewEdgeError::LabelLength { bytes: 0 }),
        (linked("x", &"l".repeat(256), flat.hall), NewEdgeError::LabelLength { bytes: 256 }),
        (linked("x", RT, ROOT), NewEdgeError::IntoRoot),
        (linked("x", RT, flat.hall), NewEdgeError::NewVertexAsParent { child: flat.hall }),
        (child(flat.robot, "x"), NewEdgeError::ParentOutsideTree { parent: flat.robot }),
        (entered("x", "in", flat.robot), functional(key(flat.robot, "in", flat.kitchen))),
    ];
    for (mutation, error) in cases {
        refused(&flat.base, &mutation, link_error(error));
    }
    flat.base.dictionary.closed = true;
    flat.base.dictionary.vertex_types.insert("thing".into());
    let undeclared = NewEdgeError::UndeclaredLabel { label: "near".into() };
    refused(&flat.base, &linked("x", "near", flat.hall), link_error(undeclared));
    assert!(flat.base.attempt(&linked("x", "in", flat.hall)).is_ok());
}

/// [spec: MUT-1.2] [spec: MUT-1.3] [spec: LIMIT-2] [spec: STATE-4]
#[test]
fn oracle_add_vertex_refuses_bad_types_and_names() {
    let mut flat = flat();
    let vertex = |vertex_type: &str, name: &str| Mutation::AddVertex {
        vertex: NewVertex::new(vertex_type, name),
        link: VertexLink::child_of(ROOT),
    };
    let length = |bytes| AddVertexError::NameLength { bytes };
    refused(&flat.base, &vertex("", "x"), length(0));
    refused(&flat.base, &vertex("thing", ""), length(0));
    refused(&flat.base, &vertex(&"t".repeat(256), "x"), length(256));
    refused(&flat.base, &vertex("thing", &"é".repeat(128)), length(256));
    assert!(flat.base.attempt(&vertex(&"t".repeat(255), &"n".repeat(255))).is_ok());
    for name in ["root", "world"] {
        refused(&flat.base, &vertex("thing", name), AddVertexError::ReservedName { name: name.into() });
    }
    let taken = AddVertexError::NameTaken { name: "hall".into(), existing: flat.hall };
    refused(&flat.base, &vertex("thing", "hall"), taken);
    flat.base.dictionary.closed = true;
    refused(&flat.base, &vertex("cat", "tom"), AddVertexError::UndeclaredType { vertex_type: "cat".into() });
}

/// Each way in which an attribute cannot be written, with a dictionary under which it cannot.
fn bad_attributes() -> Vec<(Dictionary, AttributeMap, AttributeError)> {
    let open = || Dictionary::open().with_functional("in");
    let declared = Dictionary { attributes: [("light".into(), ValueType::Int)].into(), ..open() };
    let mut closed = Dictionary { closed: true, ..declared.clone() };
    closed.vertex_types.insert("thing".into());
    closed.edge_labels.extend(["sees".into(), "near".into()]);
    let one = |name: &str, value: Value| AttributeMap::from([(name.into(), value)]);
    let large = Value::ByteVec(vec![0; limits::VALUE_BYTES_MAX + 1].into());
    let many: AttributeMap =
        (0..=limits::ATTRIBUTES_MAX).map(|n| (format!("a{n}").into(), Value::Int(0))).collect();
    let wrong =
        AttributeError::WrongType { name: "light".into(), declared: ValueType::Int, given: ValueType::Bool };
    vec![
        (closed.clone(), one("heat", Value::Int(1)), AttributeError::Undeclared { name: "heat".into() }),
        (closed, one("light", Value::Bool(true)), wrong.clone()),
        (declared, one("light", Value::Bool(true)), wrong),
        (open(), one("", Value::Int(1)), AttributeError::NameLength { bytes: 0 }),
        (open(), one(&"n".repeat(256), Value::Int(1)), AttributeError::NameLength { bytes: 256 }),
        (
            open(),
            one("image", large),
            AttributeError::ValueSize { name: "image".into(), bytes: limits::VALUE_BYTES_MAX + 1 },
        ),
        (open(), many, AttributeError::TooMany { count: limits::ATTRIBUTES_MAX + 1 }),
    ]
}

/// [spec: MUT-3.2] [spec: MUT-1.4] [spec: MUT-2.7] [spec: MUT-5.5] [spec: DICT-2] [spec: LIMIT-1]
/// [spec: LIMIT-3] [spec: LIMIT-4]
#[test]
fn oracle_attributes_that_cannot_be_written_are_refused_by_all_who_take_some() {
    for (dictionary, attributes, error) in bad_attributes() {
        let flat = flat();
        let mut peer = flat.base.clone();
        peer.dictionary = dictionary;
        let vertex = NewVertex::new("thing", "x");
        let on_vertex = NewVertex { attributes: attributes.clone(), ..vertex.clone() };
        let link = VertexLink::child_of(ROOT);
        let on_link = VertexLink { attributes: attributes.clone(), ..link.clone() };
        let error = || error.clone();
        refused(&peer, &Mutation::AddVertex { vertex: on_vertex, link }, AddVertexError::from(error()));
        refused(&peer, &Mutation::AddVertex { vertex, link: on_link }, AddVertexError::from(error()));
        let to = key(flat.drone, "sees", flat.lamp);
        let addition = Mutation::AddEdge { key: to.clone(), attributes: attributes.clone() };
        refused(&peer, &addition, AddEdgeError::from(error()));
        let from = key(flat.drone, "sees", flat.hall);
        let moved = Mutation::MoveEdge { from, to, attributes: attributes.clone() };
        refused(&peer, &moved, MoveEdgeError::from(error()));
        let updates: AttributeUpdates =
            attributes.into_iter().map(|(name, value)| (name, Some(value))).collect();
        let update = Mutation::UpdateAttributes { target: of(flat.hall), updates };
        refused(&peer, &update, UpdateAttributesError::from(error()));
    }
}

/// [spec: LIMIT-2] [spec: LIMIT-3] [spec: LIMIT-4]
#[test]
fn oracle_attributes_at_the_limits_are_accepted() {
    let flat = flat();
    let many = (0..limits::ATTRIBUTES_MAX).map(|n| (format!("a{n}").into(), Some(Value::Int(0)))).collect();
    assert!(flat.base.attempt(&Mutation::UpdateAttributes { target: of(flat.hall), updates: many }).is_ok());
    let large = Value::ByteVec(vec![0; limits::VALUE_BYTES_MAX].into());
    assert!(flat.base.attempt(&set(of(flat.hall), &"n".repeat(255), large)).is_ok());
    let many: AttributeMap =
        (0..limits::ATTRIBUTES_MAX).map(|n| (format!("a{n}").into(), Value::Int(0))).collect();
    let vertex = NewVertex { attributes: many.clone(), ..NewVertex::new("thing", "x") };
    let link = VertexLink { attributes: many.clone(), ..VertexLink::child_of(ROOT) };
    assert!(flat.base.attempt(&Mutation::AddVertex { vertex, link }).is_ok());
    let key = key(flat.drone, "sees", flat.lamp);
    assert!(flat.base.attempt(&Mutation::AddEdge { key, attributes: many }).is_ok());
    assert!(flat.base.attempt(&edge(flat.drone, &"l".repeat(limits::NAME_BYTES_MAX), flat.lamp)).is_ok());
}

/// r1 holds an edge from the drone to an attic that it has not seen.
fn with_pending_claim(flat: &Flat) -> (Peer, EdgeId, VertexId) {
    let (mut one, mut two) = (flat.base.fork(1), flat.base.fork(2));
    let attic = two.child(ROOT, "attic");
    let known = digest(&two.state);
    let claim = two.edge(flat.drone, "in", attic);
    one.state.join(&delta_for(&two.state, &known));
    assert!(one.state.holds(claim.0) && !one.view().has_vertex(attic));
    (one, claim, attic)
}

/// [spec: MUT-1.6] [spec: MUT-2.6] [spec: CLOSE-4]
#[test]
fn oracle_pending_rivals_are_superseded() {
    let flat = flat();
    for mutation in [entered("cellar", "in", flat.drone), edge(flat.drone, "in", flat.hall)] {
        let (mut one, claim, _) = with_pending_claim(&flat);
        let delta = one.apply(&mutation);
        assert!(delta.is_dead(claim.0) && one.state.is_dead(claim.0));
    }
}

/// [spec: MUT-1.7] [spec: VIEW-5]
#[test]
fn oracle_a_new_vertex_shares_the_lot_of_what_it_is_linked_to() {
    let flat = flat();
    let mut alone = concurrent(&flat.base, &linked("parcel", "near", flat.drone), &destroy(flat.drone));
    let parcel = alone.view().vertex_by_name("parcel").unwrap();
    assert_eq!(alone.view().stranded(), [parcel]);
    let stamp = alone.linked("stamp", "near", parcel);
    assert_eq!(alone.view().stranded(), [parcel, stamp]);
}

/// [spec: MUT-2] [spec: MUT-2.7]
#[test]
fn oracle_add_edge_shows_it_with_its_attributes() {
    let flat = flat();
    let mut peer = flat.base.fork(3);
    let given = [("b", Value::Int(2)), ("a", Value::Int(1))];
    let delta = peer.apply(&with_attributes(edge(flat.drone, "in", flat.hall), &given));
    assert_eq!(held(&delta), [dot(3, 1), dot(3, 2), dot(3, 3)]);
    assert_eq!(peer.shown(flat.drone, "in", flat.hall), Some(EdgeId(dot(3, 1))));
    let view = peer.view();
    assert_eq!(view.attributes_of(dot(3, 1)).map(|(_, write)| &*write.name).collect::<Vec<_>>(), ["a", "b"]);
}

/// [spec: MUT-2.1] [spec: MUT-2.2] [spec: MUT-2.3] [spec: MUT-2.4] [spec: MUT-2.5] [spec: DICT-2]
#[test]
fn oracle_add_edge_refuses_impossible_edges() {
    let mut flat = flat();
    let (hall, drone, robot, kitchen) = (flat.hall, flat.drone, flat.robot, flat.kitchen);
    let cases = [
        (edge(NOBODY, "sees", hall), NewEdgeError::UnknownVertex { vertex: NOBODY }),
        (edge(hall, "sees", NOBODY), NewEdgeError::UnknownVertex { vertex: NOBODY }),
        (edge(hall, "sees", hall), NewEdgeError::SelfLoop { vertex: hall }),
        (edge(hall, "", drone), NewEdgeError::LabelLength { bytes: 0 }),
        (edge(hall, &"l".repeat(256), drone), NewEdgeError::LabelLength { bytes: 256 }),
        (
            edge(drone, "sees", hall),
            NewEdgeError::KeyPresent { key: key(drone, "sees", hall), existing: flat.sees },
        ),
        (
            edge(robot, "in", hall),
            NewEdgeError::FunctionalTaken { label: "in".into(), existing: key(robot, "in", kitchen) },
        ),
        (edge(hall, RT, ROOT), NewEdgeError::IntoRoot),
        (edge(hall, RT, flat.table), NewEdgeError::HasParent { child: flat.table, parent: kitchen }),
        (edge(robot, RT, drone), NewEdgeError::ParentOutsideTree { parent: robot }),
    ];
    for (mutation, error) in cases {
        refused(&flat.base, &mutation, AddEdgeError::from(error));
    }
    // A cycle by addition needs a detached top.
    let mut orphan = concurrent(&flat.base, &child(flat.lamp, "bulb"), &remove(parent(ROOT, flat.lamp)));
    let bulb = orphan.view().vertex_by_name("bulb").unwrap();
    let cycle = NewEdgeError::Cycle { child: flat.lamp, parent: bulb };
    refused(&orphan, &edge(bulb, RT, flat.lamp), AddEdgeError::from(cycle));
    orphan.apply(&edge(hall, RT, flat.lamp));
    flat.base.dictionary.closed = true;
    let undeclared = NewEdgeError::UndeclaredLabel { label: "eats".into() };
    refused(&flat.base, &edge(drone, "eats", hall), AddEdgeError::from(undeclared));
}

/// [spec: MUT-2.6] [spec: STAMP-4]
#[test]
fn oracle_a_new_claim_supersedes_hidden_ones() {
    let flat = flat();
    let kitchen_below = relocate(parent(ROOT, flat.kitchen), parent(flat.hall, flat.kitchen));
    let hall_below = relocate(parent(ROOT, flat.hall), parent(flat.kitchen, flat.hall));
    let mut cycle = concurrent(&flat.base, &kitchen_below, &hall_below);
    let hidden = match cycle.view().repairs() {
        [dsr_core::Repair::CycleBroken { hidden }, _] => *hidden,
        other => panic!("{other:?}"),
    };
    let delta = cycle.apply(&edge(ROOT, RT, flat.kitchen));
    assert!(delta.is_dead(hidden.0));
    assert_eq!(cycle.repairs(), [""; 0]);
}

/// [spec: MUT-3] [spec: MUT-3.5] [spec: MUT-3.6]
#[test]
fn oracle_update_attributes_replaces_what_is_held() {
    let flat = flat();
    let sees = on(flat.sees);
    let mut both = concurrent(&flat.base, &set(sees, "since", 1_i32), &set(sees, "since", 2_i32));
    assert_eq!(both.view().attribute_writes(flat.sees, "since").len(), 2);
    let delta = both.apply(&set(sees, "since", 3_i32));
    assert_eq!(both.view().attribute_writes(flat.sees, "since").len(), 1);
    assert_eq!(both.value(flat.sees, "since"), Some(Value::Int(3)));
    assert_eq!(delta.len(), 1);
    assert_eq!(dots(&delta).len(), 3, "two killed, one made, and the edge itself is left alone");

    let delta = both.apply(&unset(sees, "since"));
    assert_eq!(both.value(flat.sees, "since"), None);
    assert!(delta.is_empty() && dots(&delta).len() == 1);
    both.apply(&set(of(ROOT), "map", "flat"));
    assert_eq!(both.value(ROOT, "map"), Some(Value::from("flat")));
}

/// [spec: MUT-3.5] [spec: VIEW-8]
#[test]
fn oracle_update_attributes_kills_what_a_dictionary_hides() {
    let mut flat = flat();
    flat.base.apply(&set(of(flat.hall), "light", true));
    flat.base.dictionary.attributes.insert("light".into(), ValueType::Int);
    assert_eq!(flat.base.repairs(), ["undeclared"]);
    let not_set = UpdateAttributesError::NotSet { target: of(flat.hall), name: "light".into() };
    refused(&flat.base, &unset(of(flat.hall), "light"), not_set);
    flat.base.apply(&set(of(flat.hall), "light", 4_i32));
    assert_eq!(flat.base.repairs(), [""; 0]);
}

/// [spec: MUT-3.6]
#[test]
fn oracle_updating_an_edge_leaves_its_rivals_alone() {
    let flat = flat();
    let rooms = |room| relocate(key(flat.robot, "in", flat.kitchen), key(flat.robot, "in", room));
    let mut both = concurrent(&flat.base, &rooms(flat.hall), &rooms(flat.pole));
    let shown = both.shown(flat.robot, "in", flat.pole).unwrap();
    let before = both.state.len();
    both.apply(&set(on(shown), "since", 1_i32));
    assert_eq!(both.state.len(), before + 1);
    assert_eq!(both.repairs(), ["functional"], "the loser is still there");
}

/// [spec: MUT-3.1] [spec: MUT-3.3] [spec: MUT-3.4]
#[test]
fn oracle_update_attributes_refuses_bad_targets_and_nothing() {
    let flat = flat();
    let unknown = |target: ElementId| UpdateAttributesError::UnknownTarget { target };
    refused(&flat.base, &set(of(NOBODY), "light", 1_i32), unknown(of(NOBODY)));
    refused(&flat.base, &set(on(EdgeId(NOBODY.0)), "light", 1_i32), unknown(on(EdgeId(NOBODY.0))));
    refused(&flat.base, &set(of(VertexId(flat.sees.0)), "a", 1_i32), unknown(of(VertexId(flat.sees.0))));
    let empty = Mutation::UpdateAttributes { target: of(flat.hall), updates: AttributeUpdates::new() };
    refused(&flat.base, &empty, UpdateAttributesError::Empty);
    let not_set = UpdateAttributesError::NotSet { target: of(flat.hall), name: "light".into() };
    refused(&flat.base, &unset(of(flat.hall), "light"), not_set);

    // An instance that lost is not the one shown.
    let same = edge(flat.drone, "sees", flat.lamp);
    let both = concurrent(&flat.base, &same, &same);
    let view = both.view();
    let [dsr_core::Repair::Superseded { hidden, .. }] = view.repairs() else { panic!() };
    refused(&both, &set(on(*hidden), "light", 1_i32), unknown(on(*hidden)));
}

/// [spec: MUT-4] [spec: MUT-4.1] [spec: MUT-4.2]
#[test]
fn oracle_remove_edge_removes_the_whole_register() {
    let mut flat = flat();
    let nowhere = key(flat.drone, "sees", flat.lamp);
    refused(&flat.base, &remove(nowhere.clone()), RemoveEdgeError::UnknownEdge { key: nowhere });
    let inside = key(flat.robot, "in", flat.kitchen);
    refused(&flat.base, &remove(inside), RemoveEdgeError::from(strands(&[flat.robot])));
    refused(&flat.base, &remove(parent(flat.table, flat.bowl)), {
        // The spoon keeps its parent, but bowl and spoon lose their path.
        RemoveEdgeError::from(strands(&[flat.bowl, flat.spoon]))
    });

    flat.base.edge(flat.robot, "near", flat.hall);
    let rooms = |room| relocate(key(flat.robot, "in", flat.kitchen), key(flat.robot, "in", room));
    let mut both = concurrent(&flat.base, &rooms(flat.hall), &rooms(flat.pole));
    let delta = both.apply(&remove(key(flat.robot, "in", flat.pole)));
    assert!(delta.is_empty());
    assert_eq!(dots(&delta).len(), 2, "the loser goes with the winner");
    assert!(both.view().edges_from(flat.robot).iter().all(|shown| &*shown.edge.label != "in"));
    assert_eq!(both.repairs(), [""; 0]);
}

/// [spec: MUT-4.2]
#[test]
fn oracle_who_is_stranded_already_is_no_obstacle() {
    let flat = flat();
    let mut alone = concurrent(&flat.base, &linked("parcel", "near", flat.drone), &destroy(flat.drone));
    let parcel = alone.view().vertex_by_name("parcel").unwrap();
    let stamp = alone.linked("stamp", "near", parcel);
    alone.apply(&remove(key(stamp, "near", parcel)));
    alone.apply(&destroy(parcel));
    assert_eq!(alone.view().stranded(), [stamp]);
    alone.edge(stamp, "in", flat.hall);
    assert_eq!(alone.view().stranded(), []);
}

/// [spec: MUT-5] [spec: MUT-5.5]
#[test]
fn oracle_move_edge_supersedes_both_registers() {
    let mut flat = flat();
    flat.base.apply(&set(on(flat.sees), "since", 1_i32));
    let (mut one, claim, _) = with_pending_claim(&flat);
    let from = key(flat.drone, "sees", flat.hall);
    let to = key(flat.drone, "in", flat.hall);
    let mutation = with_attributes(relocate(from.clone(), to.clone()), &[("how", Value::Int(1))]);
    let delta = one.apply(&mutation);
    assert!(delta.is_dead(claim.0) && delta.is_dead(flat.sees.0));
    assert!(one.view().edge_by_key(&from).is_none());
    let new = one.view().edge_by_key(&to).unwrap().id;
    assert_ne!(new, flat.sees);
    assert_eq!(one.value(new, "how"), Some(Value::Int(1)));
    assert_eq!(one.value(new, "since"), None, "a new instance has the attributes given and no other");
}

/// [spec: MUT-5.1] [spec: MUT-5.2] [spec: MUT-5.3] [spec: MUT-5.4]
#[test]
fn oracle_move_edge_refuses() {
    let flat = flat();
    let (drone, hall, lamp) = (flat.drone, flat.hall, flat.lamp);
    let sees = key(drone, "sees", hall);
    let nowhere = key(drone, "sees", lamp);
    let unknown = MoveEdgeError::UnknownEdge { key: nowhere.clone() };
    refused(&flat.base, &relocate(nowhere, sees.clone()), unknown);
    refused(&flat.base, &relocate(sees.clone(), sees.clone()), MoveEdgeError::SameKey { key: sees.clone() });
    let near = key(drone, "near", flat.kitchen);
    let cases = [
        (
            sees.clone(),
            near.clone(),
            NewEdgeError::KeyPresent { existing: flat.base.view().edge_by_key(&near).unwrap().id, key: near },
        ),
        (sees.clone(), key(drone, "sees", drone), NewEdgeError::SelfLoop { vertex: drone }),
        (sees.clone(), key(NOBODY, "sees", hall), NewEdgeError::UnknownVertex { vertex: NOBODY }),
        (sees.clone(), key(drone, "", hall), NewEdgeError::LabelLength { bytes: 0 }),
        (
            sees.clone(),
            key(flat.robot, "in", hall),
            NewEdgeError::FunctionalTaken {
                label: "in".into(),
                existing: key(flat.robot, "in", flat.kitchen),
            },
        ),
        (sees.clone(), parent(drone, flat.robot), NewEdgeError::ParentOutsideTree { parent: drone }),
        (sees.clone(), parent(hall, ROOT), NewEdgeError::IntoRoot),
        (sees, parent(hall, lamp), NewEdgeError::HasParent { child: lamp, parent: ROOT }),
        (
            parent(flat.table, flat.bowl),
            parent(flat.spoon, flat.bowl),
            NewEdgeError::Cycle { child: flat.bowl, parent: flat.spoon },
        ),
    ];
    for (from, to, error) in cases {
        refused(&flat.base, &relocate(from, to), MoveEdgeError::from(error));
    }
    let inside = key(flat.robot, "in", flat.kitchen);
    let stranded = relocate(inside, key(drone, "in", hall));
    refused(&flat.base, &stranded, MoveEdgeError::from(strands(&[flat.robot])));
    let mut closed = flat.base.clone();
    closed.dictionary.closed = true;
    let undeclared = NewEdgeError::UndeclaredLabel { label: "eats".into() };
    let eats = relocate(key(drone, "sees", hall), key(drone, "eats", hall));
    refused(&closed, &eats, MoveEdgeError::from(undeclared));
}

/// [spec: MUT-6] [spec: MUT-6.1] [spec: MUT-6.2] [spec: MUT-6.3]
#[test]
fn oracle_remove_vertex_is_one_dead_dot() {
    let mut flat = flat();
    refused(&flat.base, &destroy(ROOT), RemoveVertexError::Root);
    refused(&flat.base, &destroy(NOBODY), RemoveVertexError::UnknownVertex { vertex: NOBODY });
    let with_the_table = [flat.table, flat.bowl, flat.spoon];
    let error = RemoveVertexError::from(strands(&[with_the_table.as_slice(), &[flat.robot]].concat()));
    let drone_free = {
        let mut peer = flat.base.clone();
        peer.apply(&remove(key(flat.drone, "near", flat.kitchen)));
        peer
    };
    refused(&drone_free, &destroy(flat.kitchen), error);
    flat.base.apply(&set(of(flat.drone), "battery", 1_i32));
    flat.base.apply(&set(on(flat.sees), "since", 1_i32));
    let delta = flat.base.apply(&destroy(flat.drone));
    assert!(delta.is_empty());
    assert_eq!(dots(&delta), [flat.drone.0]);
    assert!(!flat.base.view().has_vertex(flat.drone));
    assert!(flat.base.state.is_dead(flat.sees.0));
    assert_eq!(flat.base.view().writes(), []);
}

/// [spec: MUT-0.3] [spec: LIMIT-5] [spec: LIMIT-6] [spec: LIMIT-1]
#[test]
fn oracle_counters_run_out_with_an_error() {
    let flat = flat();
    let mut spent = Peer::new(2);
    let room = spent.child(ROOT, "room");
    spent.child(ROOT, "attic");
    let lamp = spent.child(ROOT, "lamp");
    spent.edge(lamp, "near", room);
    let mut all = CausalContext::new();
    all.insert_prefix(ReplicaId::agent(1), limits::SEQUENCE_MAX);
    spent.state.join(&State::assemble([], all));
    spent.author = Author::new(ReplicaId::agent(1));
    let error = ExhaustedError::Sequences { replica: ReplicaId::agent(1) };
    let to = relocate(key(lamp, "near", room), key(lamp, "in", room));
    refused(&spent, &child(ROOT, "x"), AddVertexError::from(error.clone()));
    refused(&spent, &edge(lamp, "in", room), AddEdgeError::from(error.clone()));
    refused(&spent, &set(of(room), "light", 1_i32), UpdateAttributesError::from(error.clone()));
    refused(&spent, &to, MoveEdgeError::from(error));
    assert!(spent.attempt(&remove(key(lamp, "near", room))).is_ok());
    assert!(spent.attempt(&destroy(lamp)).is_ok());

    let greatest =
        Vertex { vertex_type: "t".into(), name: "n".into(), external_id: None, stamp: limits::STAMP_MAX };
    let stamps = State::assemble([(dot(7, 1), Record::Vertex(greatest))], [dot(7, 1)].into_iter().collect());
    let mut late = flat.base.clone();
    late.state.join(&stamps);
    let error = ExhaustedError::Stamps;
    let to = relocate(key(flat.drone, "sees", flat.hall), key(flat.drone, "sees", flat.lamp));
    refused(&late, &child(ROOT, "x"), AddVertexError::from(error.clone()));
    refused(&late, &edge(flat.drone, "in", flat.hall), AddEdgeError::from(error.clone()));
    refused(&late, &set(of(flat.hall), "light", 1_i32), UpdateAttributesError::from(error.clone()));
    refused(&late, &to, MoveEdgeError::from(error));
    assert!(late.attempt(&remove(key(flat.drone, "sees", flat.hall))).is_ok());
    assert!(late.attempt(&destroy(flat.drone)).is_ok());
}

/// An error about an element says which, and whether it is a vertex or an edge. [spec: MUT-3.1]
#[test]
fn law_an_error_names_the_element() {
    let id = dot(1, 2);
    let unknown = |target| UpdateAttributesError::UnknownTarget { target }.to_string();
    assert_eq!(unknown(of(VertexId(id))), "vertex r1.2 is not in the graph");
    assert_eq!(unknown(on(EdgeId(id))), "edge r1.2 is not in the graph");
}

/// Six kinds, each found by its name, which is that of its function. [spec: MUT-0]
#[test]
fn law_a_kind_is_found_by_its_name() {
    let names = ["add_vertex", "add_edge", "update_attributes", "remove_edge", "move_edge", "remove_vertex"];
    assert_eq!(MutationKind::ALL.map(MutationKind::name), names);
    assert_eq!(names.map(MutationKind::from_name), MutationKind::ALL.map(Some));
    assert_eq!(MutationKind::from_name("remove"), None);
}

/// With as many dots left as a mutation makes records it is allowed, with one less it is not; the last stamp can be used.
/// [spec: MUT-0.3] [spec: LIMIT-5] [spec: LIMIT-6]
#[test]
fn law_the_last_dots_and_the_last_stamp_can_be_used() {
    let flat = flat();
    let given = [("light", Value::Int(1)), ("heat", Value::Int(2))];
    let replica = ReplicaId::agent(9);
    let mutations = [
        with_attributes(child(ROOT, "x"), &given),
        Mutation::AddVertex {
            vertex: NewVertex::new("thing", "x"),
            link: VertexLink {
                attributes: [("far".into(), Value::Int(3))].into(),
                ..VertexLink::child_of(ROOT)
            },
        },
        with_attributes(edge(flat.drone, "in", flat.hall), &given),
        with_attributes(
            relocate(key(flat.drone, "sees", flat.hall), key(flat.drone, "sees", flat.lamp)),
            &given,
        ),
        Mutation::UpdateAttributes {
            target: of(flat.hall),
            updates: given.iter().map(|(name, value)| ((*name).into(), Some(value.clone()))).collect(),
        },
    ];
    for mutation in mutations {
        let records = flat.base.attempt(&mutation).unwrap().len() as u64;
        for left in 0..=records + 1 {
            let mut used = CausalContext::new();
            used.insert_prefix(replica, limits::SEQUENCE_MAX - left);
            let mut peer = flat.base.clone();
            peer.author = Author::new(replica);
            peer.state.join(&State::assemble([], used));
            match peer.attempt(&mutation) {
                Ok(delta) => assert!(left >= records && check_well_formed(&delta).is_ok()),
                Err(error) => {
                    assert!(left < records && error.kind() == "Exhausted.Sequences", "{left}: {error}");
                }
            }
        }
        let mut peer = flat.base.clone();
        let (vertex_type, name) = ("t".into(), "n".into());
        let last = Vertex { vertex_type, name, external_id: None, stamp: limits::STAMP_MAX - 1 };
        peer.state
            .join(&State::assemble([(dot(7, 1), Record::Vertex(last))], [dot(7, 1)].into_iter().collect()));
        assert_eq!(peer.attempt(&mutation).unwrap().greatest_stamp(), limits::STAMP_MAX);
    }
}

/// [spec: MUT-4.2]
#[test]
fn law_who_would_be_stranded_is_told_by_name_up_to_five_and_then_counted() {
    let told = |count: u64| {
        let vertices = (1..=count).map(|n| VertexId(dot(1, n))).collect();
        StrandError { vertices }.to_string()
    };
    assert_eq!(told(1), "this would strand r1.1: move or remove them first");
    assert_eq!(told(5), "this would strand r1.1, r1.2, r1.3, r1.4, r1.5: move or remove them first");
    assert_eq!(
        told(7),
        "this would strand r1.1, r1.2, r1.3, r1.4, r1.5 and 2 more: move or remove them first"
    );
}

/// A move that needs more dots than are left is refused for that, before its new edge is looked at; and who has neither dots
/// nor stamps left is told of the dots.
/// [spec: MUT-0.3] [spec: MUT-5.3]
#[test]
fn regress_all_dots_of_a_move_are_counted_before_its_edge_is_judged() {
    let mut peer = Peer::new(2);
    let room = peer.child(ROOT, "room");
    let lamp = peer.child(ROOT, "lamp");
    peer.edge(lamp, "near", room);
    let author = ReplicaId::agent(1);
    let mut used = CausalContext::new();
    used.insert_prefix(author, limits::SEQUENCE_MAX - 1);
    peer.state.join(&State::assemble([], used));
    peer.author = Author::new(author);
    let (near, itself) = (key(lamp, "near", room), key(lamp, "near", lamp));
    let one = Mutation::MoveEdge { from: near.clone(), to: itself.clone(), attributes: AttributeMap::new() };
    refused(&peer, &one, MoveEdgeError::Edge(NewEdgeError::SelfLoop { vertex: lamp }));
    let attributes = AttributeMap::from([("light".into(), Value::Int(1))]);
    let two = Mutation::MoveEdge { from: near, to: itself, attributes };
    let error = ExhaustedError::Sequences { replica: author };
    refused(&peer, &two, MoveEdgeError::from(error.clone()));

    let greatest =
        Vertex { vertex_type: "t".into(), name: "n".into(), external_id: None, stamp: limits::STAMP_MAX };
    peer.state
        .join(&State::assemble([(dot(7, 1), Record::Vertex(greatest))], [dot(7, 1)].into_iter().collect()));
    refused(&peer, &child(ROOT, "x"), AddVertexError::from(error));
}

/// An unset makes no record: it needs no sequence and no stamp, and is refused for the want of neither.
/// [spec: MUT-0.3] [spec: MUT-0.2] [spec: MUT-3.5]
#[test]
fn regress_unsets_need_no_counter() {
    let mut room = Peer::new(1);
    let here = of(room.child(ROOT, "room"));
    room.apply(&set(here, "light", 1_i32));
    let write = room.view().attribute(here, "light").unwrap().0;
    let mut seen = CausalContext::new();
    seen.insert_prefix(ReplicaId::agent(1), limits::SEQUENCE_MAX);
    let greatest =
        Vertex { vertex_type: "t".into(), name: "n".into(), external_id: None, stamp: limits::STAMP_MAX };
    let without_sequences = room.state.joined(&State::assemble(
        room.state.records().map(|(dot, record)| (dot, record.clone())).collect::<Vec<_>>(),
        seen,
    ));
    let without_stamps = room
        .state
        .joined(&State::assemble([(dot(7, 1), Record::Vertex(greatest))], [dot(7, 1)].into_iter().collect()));
    let both = Mutation::UpdateAttributes {
        target: here,
        updates: AttributeUpdates::from([("light".into(), None), ("power".into(), Some(Value::Int(1)))]),
    };
    let spent = [
        (without_sequences, ExhaustedError::Sequences { replica: ReplicaId::agent(1) }),
        (without_stamps, ExhaustedError::Stamps),
    ];
    for (state, error) in spent {
        let mut peer = Peer { state, ..room.clone() };
        refused(&peer, &both, UpdateAttributesError::from(error));
        let delta = peer.apply(&unset(here, "light"));
        assert!(delta.is_empty());
        assert_eq!(dots(&delta), [write]);
        assert_eq!(peer.value(VertexId(here.dot()), "light"), None);
    }
}
