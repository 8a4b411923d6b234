//! The view: each rule, its repairs, order freedom, the invariants, and what an author may expect.

use crate::clauses_common::history::{history, part, parts};
use crate::clauses_common::*;
use dsr_core::invariant::{check_repairs, check_view};
use dsr_core::{
    AttributeMap, Dictionary, Dot, Edge, EdgeId, Mutation, MutationKind, Placement, RT, Record, Repair,
    ReplicaId, Rule, State, Value, ValueType, Vertex, VertexId, Write, delta_for, digest, view,
};
use std::collections::BTreeMap;

fn edges(peer: &Peer) -> Vec<EdgeId> {
    peer.view().edges().iter().map(|shown| shown.id).collect()
}

/// [spec: VIEW-1] [spec: VIEW-9] [spec: VIEW-10] [spec: INV-1, INV-2, INV-3, INV-4, INV-5, INV-6]
#[test]
fn law_every_state_has_a_view_that_keeps_the_invariants() {
    let dictionaries = [
        Dictionary::open().with_functional("in").with_functional("near"),
        Dictionary { closed: true, ..Dictionary::default() },
        Dictionary { attributes: [("light".into(), ValueType::Bool)].into(), ..Dictionary::default() },
    ];
    for state in parts(&history([1, 2])) {
        for dictionary in &dictionaries {
            let before = state.clone();
            let shown = view(&state, dictionary);
            check_view(&shown).unwrap();
            check_repairs(&shown).unwrap();
            let again = view(&before, dictionary);
            assert_eq!(shown.repairs(), again.repairs());
            assert_eq!(shown.edges(), again.edges());
        }
    }
}

/// [spec: VIEW-1.1] [spec: CLOSE-4]
#[test]
fn oracle_what_waits_is_neither_shown_nor_reported() {
    let mut two = Peer::new(2);
    let lamp = two.child(ROOT, "lamp");
    let known = digest(&two.state);
    let near = two.edge(lamp, "near", ROOT);
    two.apply(&set(on(near), "since", 1_i32));
    let waiting = delta_for(&two.state, &known);
    let mut one = Peer::new(1);
    one.state.join(&waiting);
    assert_eq!(one.state.len(), 2);
    assert_eq!(one.view().vertices(), [ROOT]);
    assert_eq!((one.view().edges().len(), one.view().writes().len(), one.repairs().len()), (0, 0, 0));
    one.state.join(&two.state);
    assert!(one.shows(lamp, "near", ROOT));
    assert_eq!(one.value(near, "since"), Some(Value::Int(1)));
}

/// No well-formed state has one, but a view is asked of any. [spec: VIEW-1.1] [spec: INV-4]
#[test]
fn oracle_an_edge_from_a_vertex_to_itself_is_neither_shown_nor_reported() {
    let mut one = Peer::new(1);
    let lamp = one.child(ROOT, "lamp");
    let before = one.state.clone();
    let dots = [50, 51, 52, 53].map(|sequence| Dot::new(ReplicaId::agent(7), sequence));
    let loop_at = |vertex: VertexId, label: &str| {
        Record::Edge(Edge { from: vertex, to: vertex, label: label.into(), stamp: 9 })
    };
    let write =
        Write { target: dots[1], name: "since".into(), value: 1_i32.into(), timestamp_ns: 0, stamp: 9 };
    let looped = [loop_at(lamp, RT), loop_at(lamp, "near"), loop_at(ROOT, "near"), Record::Write(write)];
    let state = before.joined(&State::assemble(dots.into_iter().zip(looped), dots.into_iter().collect()));
    assert_eq!(state.len(), before.len() + 4);
    let (shown, plain) = (view(&state, &one.dictionary), view(&before, &one.dictionary));
    assert_eq!(shown.edges(), plain.edges());
    assert_eq!(shown.placement(lamp), plain.placement(lamp));
    assert_eq!((shown.writes().len(), shown.repairs().len()), (plain.writes().len(), 0));
    check_view(&shown).unwrap();
    check_repairs(&shown).unwrap();
}

/// [spec: VIEW-2] [spec: STAMP-2] [spec: STAMP-4]
#[test]
fn oracle_same_key_shows_the_greatest() {
    let flat = flat();
    let same = edge(flat.drone, "sees", flat.lamp);
    // Three instances; r1's has the greatest stamp, since r1 has seen more, and wins over greater replicas.
    let (mut one, mut two, mut three) = (flat.base.fork(1), flat.base.fork(2), flat.base.fork(3));
    one.child(ROOT, "chair");
    let ids = [&mut one, &mut two, &mut three].map(|peer| {
        let id = EdgeId(peer.next());
        peer.apply(&same);
        id
    });
    let all = met(&met(&one, &two), &three);
    let [first, second, third] = ids;
    assert_eq!(all.shown(flat.drone, "sees", flat.lamp), Some(first));
    let superseded = |hidden| Repair::Superseded { hidden, shown: first, rule: Rule::SameKey };
    assert_eq!(all.view().repairs(), [superseded(second), superseded(third)]);
    assert!(all.state.rank(third.0) > all.state.rank(second.0));
}

/// [spec: VIEW-3] [spec: STAMP-2] [spec: STAMP-4]
#[test]
fn oracle_kinematic_claims_are_accepted_greatest_first() {
    let flat = flat();
    let to = |parent_vertex| relocate(parent(flat.shelf, flat.cup), parent(parent_vertex, flat.cup));
    let both = concurrent(&flat.base, &to(flat.kitchen), &to(flat.hall));
    let shown = both.shown(flat.hall, RT, flat.cup).unwrap();
    let [Repair::Superseded { hidden, shown: by, rule: Rule::RtParent }] = *both.view().repairs() else {
        panic!()
    };
    assert_eq!((by, both.state.edge(hidden.0).unwrap().from), (shown, flat.kitchen));
    assert_eq!(both.view().placement(flat.cup), Some(Placement::Child { parent: flat.hall, edge: shown }));
}

/// [spec: VIEW-4] [spec: VIEW-5] [spec: INV-3]
#[test]
fn oracle_placements_and_detached_tops() {
    let flat = flat();
    let orphan = concurrent(&flat.base, &child(flat.lamp, "bulb"), &remove(parent(ROOT, flat.lamp)));
    let seen = orphan.view();
    let bulb = seen.vertex_by_name("bulb").unwrap();
    assert_eq!(seen.placement(ROOT), Some(Placement::Root));
    assert_eq!(seen.placement(flat.lamp), Some(Placement::Detached));
    assert!(matches!(seen.placement(bulb), Some(Placement::Child { parent, .. }) if parent == flat.lamp));
    assert_eq!(seen.placement(flat.robot), Some(Placement::Outside));
    assert_eq!(seen.placement(VertexId(Dot::new(ReplicaId::agent(9), 9))), None);
    assert_eq!(seen.ancestors(bulb).collect::<Vec<_>>(), [bulb, flat.lamp], "no way to the root is invented");
    assert!(seen.in_tree(bulb) && !seen.in_tree(flat.robot));
    assert_eq!(seen.stranded(), [flat.lamp], "the bulb has a path over the lamp's other edge");
    assert!(seen.edge(ROOT, RT, flat.lamp).is_none(), "the link of a repair is no edge");
}

/// [spec: VIEW-5] [spec: INV-1]
#[test]
fn oracle_a_component_without_path_hangs_by_its_oldest_vertex() {
    let flat = flat();
    let (mut one, mut two) = (flat.base.fork(1), flat.base.fork(2));
    let parcel = one.linked("parcel", "near", flat.drone);
    let stamp = one.linked("stamp", "near", parcel);
    two.apply(&destroy(flat.drone));
    let alone = met(&one, &two);
    assert_eq!(alone.view().repairs(), [Repair::Reattached { vertex: parcel }]);
    assert_eq!(alone.view().stranded(), [parcel, stamp]);
    // With a detached top in it, the component hangs by that alone.
    let (mut one, mut two) = (flat.base.fork(1), flat.base.fork(2));
    let tray = one.linked("tray", "on", flat.bowl);
    two.apply(&relocate(parent(flat.table, flat.bowl), parent(flat.pole, flat.bowl)));
    one.apply(&destroy(flat.pole));
    let orphan = met(&one, &two);
    assert_eq!(orphan.view().repairs(), [Repair::Detached { vertex: flat.bowl }]);
    assert_eq!(orphan.view().stranded(), [flat.bowl, flat.spoon, tray]);
}

/// [spec: VIEW-6] [spec: STAMP-4] [spec: DICT-3] [spec: INV-6]
#[test]
fn oracle_functional_labels_show_one_target() {
    let flat = flat();
    let to = |room| relocate(key(flat.robot, "in", flat.kitchen), key(flat.robot, "in", room));
    let both = concurrent(&flat.base, &to(flat.hall), &to(flat.pole));
    let shown = both.shown(flat.robot, "in", flat.pole).unwrap();
    let [Repair::Superseded { shown: by, rule: Rule::Functional, .. }] = *both.view().repairs() else {
        panic!()
    };
    assert_eq!(by, shown);
    assert_eq!(both.view().edges_from(flat.robot).len(), 1);
    let plain = Peer { dictionary: Dictionary::open(), ..both };
    assert_eq!(plain.view().edges_from(flat.robot).len(), 2);
}

/// [spec: VIEW-7]
#[test]
fn oracle_a_name_finds_the_least_rank() {
    let base = Peer::new(1);
    // r1's chair has the greater stamp: r2's is the older one.
    let (mut one, mut two) = (base.fork(1), base.fork(2));
    one.child(ROOT, "table");
    let (newer, older) = (one.child(ROOT, "chair"), two.child(ROOT, "chair"));
    let both = met(&one, &two);
    assert_eq!(both.view().vertex_by_name("chair"), Some(older));
    let clash = Repair::NameClash { name: "chair".into(), shown: older, hidden: newer };
    assert_eq!(both.view().repairs(), [clash]);
    assert!(both.view().has_vertex(newer) && both.shows(ROOT, RT, newer));
    let mut after = both;
    after.apply(&destroy(older));
    assert_eq!(after.view().vertex_by_name("chair"), Some(newer));
}

/// Records that no mutation makes: two vertices that have the root's names, one of them twice.
/// [spec: VIEW-7] [spec: VIEW-9]
#[test]
fn regress_the_names_of_the_root_are_taken() {
    let mut peer = Peer::new(1);
    for name in ["root", "world", "root"] {
        let id = peer.child(ROOT, "tmp");
        let rename = |(dot, record): (Dot, &Record)| match record {
            Record::Vertex(vertex) if dot == id.0 => {
                (dot, Record::Vertex(Vertex { name: name.into(), ..vertex.clone() }))
            }
            _ => (dot, record.clone()),
        };
        let records: Vec<_> = peer.state.records().map(rename).collect();
        peer.state = State::assemble(records, peer.state.context().clone());
        check(&peer.state, &peer.dictionary);
        assert_eq!(peer.view().vertex_by_name(name), Some(ROOT));
    }
    let clash = |name: &str, sequence| Repair::NameClash {
        name: name.into(),
        shown: ROOT,
        hidden: VertexId(Dot::new(ReplicaId::agent(1), sequence)),
    };
    let clashes = [clash("root", 1), clash("root", 5), clash("world", 3)];
    assert_eq!(peer.view().repairs(), clashes);
    assert_eq!(clashes[0].to_string(), "r1.1 is named \"root\" as well: the name finds root");
}

/// [spec: VIEW-8] [spec: STAMP-2] [spec: STAMP-3] [spec: INV-5]
#[test]
fn oracle_attributes_are_registers_that_time_does_not_order() {
    let (mut one, mut two) = (Peer::new(1), Peer::new(2));
    one.author.timestamp_ns = 1_000_000;
    one.apply(&set(of(ROOT), "light", 1_i32));
    two.apply(&set(of(ROOT), "light", 2_i32));
    let both = met(&one, &two);
    let writes = both.view().attribute_writes(ROOT, "light").to_vec();
    assert_eq!(writes.iter().map(|(dot, _)| dot.replica.agent).collect::<Vec<_>>(), [2, 1]);
    assert_eq!(writes.iter().map(|(_, write)| write.timestamp_ns).collect::<Vec<_>>(), [0, 1_000_000]);
    assert_eq!(both.repairs(), [""; 0], "several writes are no repair");

    let mut typed = both;
    typed.dictionary.attributes.insert("light".into(), ValueType::Bool);
    assert_eq!(typed.repairs(), ["undeclared", "undeclared"]);
    assert_eq!(typed.value(ROOT, "light"), None);
}

/// [spec: STAMP-3]
#[test]
fn law_time_changes_no_outcome() {
    let play = |times: [u64; 2]| {
        let (mut one, mut two) = (Peer::new(1), Peer::new(2));
        one.author.timestamp_ns = times[0];
        two.author.timestamp_ns = times[1];
        let lamp = one.child(ROOT, "lamp");
        let same = two.child(ROOT, "lamp");
        one.apply(&set(of(lamp), "light", 1_i32));
        two.apply(&set(of(same), "light", 1_i32));
        let both = met(&one, &two);
        (edges(&both), both.view().repairs().to_vec(), both.value(lamp, "light"))
    };
    assert_eq!(play([1, 2]), play([2, 1]));
    assert_eq!(play([1, 2]), play([u64::MAX, 0]));
}

/// What a view shows, by names alone.
fn by_names(state: &State, dictionary: &Dictionary) -> Vec<String> {
    let seen = view(state, dictionary);
    let name = |id: VertexId| seen.vertex(id).map_or_else(|| "root".into(), |vertex| vertex.name.to_string());
    let element = |dot: Dot| match state.edge(dot) {
        Some(edge) => format!("{} {} {}", name(edge.from), edge.label, name(edge.to)),
        None => name(VertexId(dot)),
    };
    let edges = seen.edges().iter().map(|shown| element(shown.id.0));
    let winners = seen.writes().iter().filter(|(dot, write)| {
        seen.attribute(write.target, &write.name).is_some_and(|(winner, _)| winner == *dot)
    });
    let writes =
        winners.map(|(_, write)| format!("{} {} {}", element(write.target), write.name, write.value));
    let placements = seen.vertices().iter().map(|&id| match seen.placement(id) {
        Some(Placement::Child { parent, .. }) => format!("{} below {}", name(id), name(parent)),
        other => format!("{} {other:?}", name(id)),
    });
    let mut lines: Vec<String> = edges.chain(writes).chain(placements).collect();
    lines.sort_unstable();
    lines
}

/// [spec: VIEW-11]
#[test]
fn law_without_repair_and_contest_the_order_of_dots_has_no_effect() {
    let dictionary = Dictionary::open();
    let (forwards, backwards) = (history([1, 2]), history([2, 1]));
    let (mut free, mut tied) = (0, 0);
    for mask in 0..1 << forwards.len() {
        let (state, renamed) = (part(&forwards, mask), part(&backwards, mask));
        let seen = view(&state, &dictionary);
        let contested = seen.writes().chunk_by(|(_, l), (_, r)| (l.target, &l.name) == (r.target, &r.name));
        if seen.repairs().is_empty() && contested.into_iter().all(|register| register.len() == 1) {
            assert_eq!(by_names(&state, &dictionary), by_names(&renamed, &dictionary));
            free += 1;
        } else {
            tied += usize::from(by_names(&state, &dictionary) != by_names(&renamed, &dictionary));
        }
    }
    assert!(free > 50 && tied > 0, "{free} states without ties; in {tied} others the order shows");
}

/// A fixed sequence of numbers that look random.
struct Dice(u64);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % bound
    }
}

/// Any mutation, sensible or not.
fn thrown(dice: &mut Dice, peer: &Peer, step: usize) -> Mutation {
    let seen = peer.view();
    let vertices = seen.vertices();
    let mut vertex = || vertices[dice.below(vertices.len())];
    let (here, there) = (vertex(), vertex());
    let label = ["near", "in", RT][dice.below(3)];
    let shown = seen.edges();
    let any_key = |dice: &mut Dice| match shown.len() {
        0 => key(here, label, there),
        many => shown[dice.below(many)].edge.key(),
    };
    match dice.below(8) {
        0 | 1 if label == RT => child(here, &format!("v{step}")),
        0 | 1 => linked(&format!("v{step}"), label, here),
        2 => edge(here, label, there),
        3 => set(of(here), "light", i32::try_from(step).unwrap()),
        4 => unset(of(here), "light"),
        5 => remove(any_key(dice)),
        6 => relocate(any_key(dice), key(here, label, there)),
        _ => destroy(here),
    }
}

/// Whether the view shows what the mutation says under "afterwards".
fn shows_effect(peer: &Peer, before: &Peer, mutation: &Mutation) -> bool {
    let seen = peer.view();
    match mutation {
        Mutation::AddVertex { vertex, link } => {
            let new = VertexId(before.next());
            let (from, to) = if link.outgoing { (new, link.other) } else { (link.other, new) };
            seen.vertex_by_name(&vertex.name) == Some(new) && seen.edge(from, &link.label, to).is_some()
        }
        Mutation::AddEdge { key, .. } => {
            seen.edge_by_key(key).is_some_and(|shown| shown.id.0 == before.next())
        }
        Mutation::UpdateAttributes { target, updates } => updates.iter().all(|(name, value)| {
            let writes = seen.attribute_writes(*target, name);
            writes.iter().map(|(_, write)| Some(write.value.clone())).eq(value.iter().cloned().map(Some))
        }),
        Mutation::RemoveEdge { key } => seen.edge_by_key(key).is_none(),
        Mutation::MoveEdge { from, to, .. } => {
            seen.edge_by_key(from).is_none()
                && seen.edge_by_key(to).is_some_and(|shown| shown.id.0 == before.next())
        }
        Mutation::RemoveVertex { vertex } => !seen.has_vertex(*vertex),
    }
}

/// [spec: VIEW-12] [spec: INTENT-1] [spec: MUT-4.2]
#[test]
fn law_one_replica_alone_sees_every_effect_and_no_repair() {
    let mut accepted: BTreeMap<MutationKind, u32> = BTreeMap::new();
    for seed in 0..40 {
        let (mut dice, mut peer) = (Dice(seed), Peer::new(1));
        for step in 0..150 {
            let mutation = thrown(&mut dice, &peer, step);
            let Ok(delta) = peer.attempt(&mutation) else { continue };
            let before = peer.clone();
            peer.state.join(&delta);
            assert_eq!(peer.repairs(), [""; 0], "seed {seed}, step {step}: {mutation:?}");
            assert_eq!(peer.view().stranded(), []);
            check(&peer.state, &peer.dictionary);
            assert!(shows_effect(&peer, &before, &mutation), "seed {seed}, step {step}: {mutation:?}");
            *accepted.entry(mutation.kind()).or_default() += 1;
        }
    }
    assert!(MutationKind::ALL.iter().all(|kind| accepted.get(kind).is_some_and(|&n| n > 20)), "{accepted:?}");
}

/// Two replicas that meet now and then: the effect shows at once in states with conflicts too.
/// [spec: INTENT-1] [spec: VIEW-9] [spec: VIEW-10] [spec: STATE-3] [spec: MUT-4.2]
#[test]
fn law_effects_show_at_once_after_conflicts_too() {
    let mut with_repairs = 0;
    for seed in 0..40 {
        let mut dice = Dice(1000 + seed);
        let mut peers = [Peer::new(1), Peer::new(2)];
        for step in 0..150 {
            let turn = dice.below(2);
            if dice.below(6) == 0 {
                let other = peers[1 - turn].state.clone();
                let dead = peers[turn].state.clone();
                peers[turn].state.join(&other);
                dsr_core::invariant::check_removal_is_final(&dead, &peers[turn].state).unwrap();
            }
            let peer = &mut peers[turn];
            let mutation = thrown(&mut dice, peer, step);
            let Ok(delta) = peer.attempt(&mutation) else { continue };
            let before = peer.clone();
            peer.state.join(&delta);
            check(&peer.state, &peer.dictionary);
            assert!(shows_effect(peer, &before, &mutation), "seed {seed}, step {step}: {mutation:?}");
            let (was, new) = (before.view().stranded().to_vec(), VertexId(before.next()));
            let stranded = peer.view().stranded().iter().all(|vertex| was.contains(vertex) || *vertex == new);
            assert!(stranded, "seed {seed}, step {step}: {mutation:?} strands a vertex");
            with_repairs += usize::from(!before.repairs().is_empty());
        }
    }
    assert!(with_repairs > 200, "{with_repairs}");
}

/// [spec: INTENT-2]
#[test]
fn oracle_an_effect_stays_while_others_do_other_things() {
    let flat = flat();
    let elsewhere = [
        child(flat.hall, "chair"),
        edge(flat.drone, "in", flat.hall),
        set(of(flat.kitchen), "light", 2_i32),
        remove(key(flat.drone, "sees", flat.hall)),
        relocate(parent(flat.shelf, flat.cup), parent(flat.kitchen, flat.cup)),
        destroy(flat.post),
    ];
    let mine = [
        child(flat.kitchen, "stool"),
        edge(flat.drone, "sees", flat.lamp),
        set(of(flat.hall), "light", 1_i32),
        remove(parent(ROOT, flat.lamp)),
        relocate(key(flat.robot, "in", flat.kitchen), key(flat.robot, "in", flat.hall)),
        destroy(flat.pole),
    ];
    for mutation in &mine {
        for agents in [[1, 2], [2, 1]] {
            let (mut one, mut two) = (flat.base.fork(agents[0]), flat.base.fork(agents[1]));
            let before = one.clone();
            one.apply(mutation);
            for other in &elsewhere {
                two.apply(other);
                let both = met(&one, &two);
                assert!(shows_effect(&both, &before, mutation), "{mutation:?} after {other:?}");
                assert_eq!(both.repairs(), [""; 0]);
            }
        }
    }
}

/// The note of the specification: a removed claim of a great stamp, and a later one of a small stamp.
/// [spec: STAMP-1] [spec: INTENT-2]
#[test]
fn regress_without_its_removal_a_claim_may_outrank_its_successor() {
    let mut author = Peer::new(1);
    let (hall, kitchen) = (author.child(ROOT, "hall"), author.child(ROOT, "kitchen"));
    let drone = author.linked("drone", "near", hall);
    let mut reader = author.fork(2);
    let mut deltas: Vec<_> = (0..4).map(|light| author.apply(&set(of(hall), "light", light))).collect();
    deltas.push(author.apply(&edge(drone, "in", hall)));
    let removal = author.apply(&remove(key(drone, "in", hall)));
    deltas.push(author.apply(&unset(of(hall), "light")));
    deltas.push(author.apply(&edge(drone, "in", kitchen)));
    for delta in &deltas {
        reader.state.join(delta);
    }
    assert!(author.shows(drone, "in", kitchen));
    assert!(reader.shows(drone, "in", hall), "the removed claim has the greater stamp");
    assert_eq!(reader.repairs(), ["functional"], "and the view says that it hides another");
    reader.state.join(&removal);
    assert_eq!(reader.state, author.state);
}

/// The cup of the specification. [spec: INTENT-3]
#[test]
fn oracle_a_loser_surfaces_by_closure_and_never_by_hand() {
    let flat = flat();
    let to = |place| relocate(parent(flat.shelf, flat.cup), parent(place, flat.cup));
    let both = concurrent(&flat.base, &to(flat.pole), &to(flat.post));
    assert!(both.shows(flat.post, RT, flat.cup));
    let loser = match *both.view().repairs() {
        [Repair::Superseded { hidden, .. }] => hidden,
        ref other => panic!("{other:?}"),
    };

    let mut by_hand = both.clone();
    by_hand.apply(&relocate(parent(flat.post, flat.cup), parent(flat.hall, flat.cup)));
    assert!(by_hand.state.is_dead(loser.0));
    by_hand.apply(&remove(parent(flat.hall, flat.cup)));
    assert_eq!(by_hand.view().placement(flat.cup), Some(Placement::Outside));

    let mut by_closure = both;
    by_closure.apply(&destroy(flat.post));
    assert_eq!(by_closure.shown(flat.pole, RT, flat.cup), Some(loser));
    assert_eq!(by_closure.repairs(), [""; 0]);
}

/// Greedy acceptance: moving the cup away frees a claim on the lamp, which unseats a weaker one.
/// [spec: INTENT-4] [spec: VIEW-3]
#[test]
fn regress_a_freed_claim_unseats_a_weaker_one_elsewhere() {
    let flat = flat();
    let lamp_to = |place| relocate(parent(ROOT, flat.lamp), parent(place, flat.lamp));
    let (mut one, mut two, mut three) = (flat.base.fork(1), flat.base.fork(2), flat.base.fork(3));
    let weak = EdgeId(one.next());
    one.apply(&lamp_to(flat.hall));
    two.apply(&lamp_to(flat.cup));
    three.apply(&set(of(flat.hall), "light", 1_i32)); // raises the stamp of what follows
    three.apply(&relocate(parent(flat.shelf, flat.cup), parent(flat.lamp, flat.cup)));
    let mut all = met(&met(&one, &two), &three);
    assert_eq!(all.repairs(), ["cycle-broken"]);
    assert!(all.shows(flat.hall, RT, flat.lamp) && all.shows(flat.lamp, RT, flat.cup));

    all.apply(&relocate(parent(flat.lamp, flat.cup), parent(flat.pole, flat.cup)));
    assert!(all.shows(flat.pole, RT, flat.cup), "the author's own effect shows");
    assert!(all.shows(flat.cup, RT, flat.lamp), "the freed claim is greater than the hall's");
    let [Repair::Superseded { hidden, rule: Rule::RtParent, .. }] = *all.view().repairs() else { panic!() };
    assert_eq!(hidden, weak);
}

/// [spec: VIEW-8]
#[test]
fn oracle_attributes_of_hidden_instances_stay_theirs() {
    let flat = flat();
    let addition = |value: i32| Mutation::AddEdge {
        key: key(flat.drone, "sees", flat.lamp),
        attributes: AttributeMap::from([("since".into(), Value::Int(value))]),
    };
    let both = concurrent(&flat.base, &addition(1), &addition(2));
    let shown = both.shown(flat.drone, "sees", flat.lamp).unwrap();
    assert_eq!(both.value(shown, "since"), Some(Value::Int(2)));
    assert_eq!(both.view().attribute_writes(shown, "since").len(), 1);
}
