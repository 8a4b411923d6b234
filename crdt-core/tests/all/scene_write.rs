//! Scenes of any state: conflicts, repairs, vertices that no file ever had.

use crate::scene_support::{check_lossless, link, scene, symbol};
use dsr_core::scene::{Note, Scene, Strictness, TINY};
use dsr_core::{
    Author, Delta, Dictionary, EdgeKey, ElementId, NewVertex, ReplicaId, State, VertexId, VertexLink,
    add_edge, add_vertex, remove_vertex, update_attributes, view,
};

fn author(agent: u32) -> Author {
    Author::new(ReplicaId::agent(agent))
}

/// A vertex of this name below the root, added by this agent; and which it is.
fn added(state: &State, agent: u32, new: &NewVertex) -> (Delta, VertexId) {
    let dictionary = Dictionary::open();
    let vertex = VertexId(state.next_dot(ReplicaId::agent(agent)).unwrap());
    let delta =
        add_vertex(&view(state, &dictionary), author(agent), new, &VertexLink::child_of(VertexId::ROOT))
            .unwrap();
    (delta, vertex)
}

fn thing(name: &str, external_id: Option<u64>) -> NewVertex {
    NewVertex { external_id, ..NewVertex::new("thing", name) }
}

/// [spec: SCENE-15]
#[test]
fn law_the_winner_of_concurrent_writes_is_written_and_losers_are_counted() {
    let dictionary = Dictionary::open();
    let mut state = State::new();
    let (delta, hub) = added(&state, 1, &thing("hub", None));
    state.join(&delta);
    let write = |agent: u32, value: i32| {
        let updates = [("a".into(), Some(value.into()))].into();
        update_attributes(&view(&state, &dictionary), author(agent), ElementId::Vertex(hub), &updates)
            .unwrap()
    };
    let deltas = [write(1, 1), write(2, 2)];
    for delta in &deltas {
        state.join(delta);
    }
    let written = Scene::of(state).written(&dictionary);
    assert_eq!(written.notes, [Note::Hidden { records: 1 }]);
    let again = check_lossless(&written.text, &dictionary);
    let graph = view(&again.state, &dictionary);
    let value = &graph.attribute(graph.vertex_by_name("hub").unwrap(), "a").unwrap().1.value;
    assert_eq!(*value, 2.into(), "the greater dot wins");
}

/// [spec: SCENE-15]
#[test]
fn law_vertices_without_an_id_get_the_smallest_unused() {
    let mut state = State::new();
    for (name, id) in [("a", None), ("b", Some(2)), ("c", None), ("d", Some(u64::MAX)), ("e", Some(0))] {
        let (delta, _) = added(&state, 1, &thing(name, id));
        state.join(&delta);
    }
    let written = Scene::of(state).written(&Dictionary::open());
    assert_eq!(written.notes, []);
    let again = check_lossless(&written.text, &Dictionary::open());
    let ids: Vec<_> = again.state.records().filter_map(|(dot, _)| again.state.vertex(dot)).collect();
    let ids: Vec<_> = ids.iter().map(|vertex| (&*vertex.name, vertex.external_id.unwrap())).collect();
    assert_eq!(again.root.external_id, Some(1));
    assert_eq!(ids, [("e", 0), ("b", 2), ("a", 3), ("c", 4), ("d", u64::MAX)]);
}

/// [spec: SCENE-15]
#[test]
fn law_clashing_ids_names_and_the_roots_type_are_changed_and_told() {
    let nothing = State::new();
    let (first, _) = added(&nothing, 1, &thing("hub", Some(5)));
    let (second, younger) = added(&nothing, 2, &thing("hub", Some(5)));
    let odd = NewVertex { vertex_type: "world".into(), ..thing("map", Some(9)) };
    let (third, map) = added(&nothing, 3, &odd);
    let state = [first, second, third].iter().fold(nothing, |state, delta| state.joined(delta));
    let written = Scene::of(state).written(&Dictionary::open());
    assert_eq!(
        written.notes,
        [
            Note::Renumbered { vertex: younger, from: 5, to: 2 },
            Note::Renamed { vertex: younger, from: "hub".into(), to: "hub~2".into() },
            Note::Retyped { vertex: map, from: "world".into(), to: "world~9".into() },
        ]
    );
    assert!(written.notes.iter().all(|note| note.to_string().contains("in the file")));
    let again = check_lossless(&written.text, &Dictionary::open());
    assert!(view(&again.state, &Dictionary::open()).vertex_by_name("hub~2").is_some());
}

/// [spec: SCENE-15]
#[test]
fn law_links_of_repairs_are_not_written_and_told() {
    let dictionary = Dictionary::open();
    let mut state = State::new();
    let (delta, table) = added(&state, 1, &thing("table", None));
    state.join(&delta);
    // One removes the table while another puts a cup on it.
    let removed = remove_vertex(&view(&state, &dictionary), table).unwrap();
    let cup = VertexId(state.next_dot(ReplicaId::agent(2)).unwrap());
    let put =
        add_vertex(&view(&state, &dictionary), author(2), &thing("cup", None), &VertexLink::child_of(table))
            .unwrap();
    let state = state.joined(&removed).joined(&put);
    assert_eq!(view(&state, &dictionary).stranded(), [cup]);
    let written = Scene::of(state).written(&dictionary);
    assert_eq!(written.notes, [Note::Stranded { vertex: cup }]);
    let refused = Scene::read(&written.text, &dictionary, Strictness::Strict).unwrap_err();
    assert_eq!(refused.faults.len(), 1);
    let lenient = Scene::read(&written.text, &dictionary, Strictness::Lenient).unwrap();
    assert!(lenient.scene.state.is_empty());
}

/// [spec: SCENE-14]
#[test]
fn law_one_graph_has_one_state_however_its_file_is_laid_out() {
    let symbols = [
        symbol(2, "a", "\"x\": {\"type\": 1, \"value\": 1}, \"w\": {\"type\": 4, \"value\": true}", ""),
        symbol(10, "b", "", ""),
    ];
    let reversed = [
        symbols[1].clone(),
        symbols[0].replace(
            "\"x\": {\"type\": 1, \"value\": 1}, \"w\": {\"type\": 4, \"value\": true}",
            "\"w\":{\"value\":true,\"type\":4},\"x\":{\"value\":1,\"type\":1}",
        ),
    ];
    let one = scene(&[link(1, "RT", 2), link(1, "RT", 10), link(1, "has", 2)].join(","), &symbols.join(","));
    let other =
        scene(&[link(1, "has", 2), link(1, "RT", 10), link(1, "RT", 2)].join(","), &reversed.join(","));
    let left = check_lossless(&one, &Dictionary::open());
    assert!(left == check_lossless(&other, &Dictionary::open()));
    let dots: Vec<String> = left.state.records().map(|(dot, _)| dot.to_string()).collect();
    assert_eq!(dots, ["r0.1", "r0.2", "r0.3", "r0.4", "r0.5", "r0.6", "r0.7"]);
    assert!(left.state.records().all(|(_, record)| record.stamp() == 1));
}

/// [spec: SCENE-14]
#[test]
fn law_a_scene_can_be_mutated_on() {
    let dictionary = Dictionary::aal();
    let scene = check_lossless(TINY, &dictionary);
    let graph = view(&scene.state, &dictionary);
    let (robot, world) = (graph.vertex_by_name("robot").unwrap(), VertexId::ROOT);
    let delta = add_edge(&graph, author(7), &EdgeKey::new(world, "has", robot), &[].into()).unwrap();
    let scene = Scene { state: scene.state.joined(&delta), ..scene };
    let again = check_lossless(&scene.write(&dictionary), &dictionary);
    let graph = view(&again.state, &dictionary);
    assert!(graph.edge(world, "has", graph.vertex_by_name("robot").unwrap()).is_some());
}
