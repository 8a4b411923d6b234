//! The judges of views are not blind: whatever breaks an invariant is told by its clause and its place, and what looks like
//! it and breaks nothing is let pass.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use dsr_core::invariant::{Violation, check_no_remains, check_removal_is_final, check_repairs, check_view};
use dsr_core::{
    Dictionary, Dot, Edge, EdgeId, Malformed, Placement, Record, Repair, ShownEdge, Shows, State, ValueType,
    VertexId, View, Write, view,
};
use dsr_testkit::state;
use std::collections::BTreeMap;

/// What somebody shows of a state: at first what the view does, then what a test makes of it.
struct Shown<'s> {
    view: View<'s>,
    vertices: Vec<VertexId>,
    edges: Vec<ShownEdge<'s>>,
    placements: BTreeMap<VertexId, Placement>,
    names: BTreeMap<&'static str, Option<VertexId>>,
    writes: Vec<(Dot, &'s Write)>,
    repairs: Vec<Repair>,
}

impl<'s> Shown<'s> {
    fn of(state: &'s State, dictionary: &'s Dictionary) -> Self {
        let view = view(state, dictionary);
        let placements = view.vertices().iter().map(|&vertex| (vertex, view.placement(vertex).unwrap()));
        Self {
            vertices: view.vertices().to_vec(),
            edges: view.edges().to_vec(),
            placements: placements.collect(),
            names: BTreeMap::new(),
            writes: view.writes().to_vec(),
            repairs: view.repairs().to_vec(),
            view,
        }
    }

    fn show(&mut self, id: EdgeId, edge: Edge) {
        self.edges.push(ShownEdge { id, edge: Box::leak(Box::new(edge)) });
    }

    fn hide(&mut self, id: EdgeId) {
        self.edges.retain(|shown| shown.id != id);
    }

    fn write(&mut self, dot: Dot) {
        self.writes.push((dot, self.view.state().write(dot).unwrap()));
    }
}

impl Shows for Shown<'_> {
    fn state(&self) -> &State {
        self.view.state()
    }

    fn dictionary(&self) -> &Dictionary {
        self.view.dictionary()
    }

    fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    fn edges(&self) -> &[ShownEdge<'_>] {
        &self.edges
    }

    fn placement(&self, vertex: VertexId) -> Option<Placement> {
        self.placements.get(&vertex).copied()
    }

    fn vertex_by_name(&self, name: &str) -> Option<VertexId> {
        self.names.get(name).copied().unwrap_or_else(|| self.view.vertex_by_name(name))
    }

    fn writes(&self) -> &[(Dot, &Write)] {
        &self.writes
    }

    fn repairs(&self) -> &[Repair] {
        &self.repairs
    }
}

fn dot(text: &str) -> Dot {
    text.parse().unwrap()
}

fn vertex(text: &str) -> VertexId {
    text.parse().unwrap()
}

fn edge(text: &str) -> EdgeId {
    text.parse().unwrap()
}

fn claim(from: &str, label: &str, to: &str) -> Edge {
    Edge { from: vertex(from), to: vertex(to), label: label.into(), stamp: 1 }
}

/// Kitchen and robot in the tree, a table and a chair that only symbolic edges hold, and what waits for r9.
fn house() -> State {
    state(
        "r1.1 vertex room kitchen @1
         r1.2 edge root -RT-> r1.1 @1
         r1.3 vertex robot bob @2
         r1.4 edge r1.1 -RT-> r1.3 @2
         r1.5 vertex table table @3
         r1.6 edge r1.5 -in-> r1.1 @3
         r1.7 vertex chair chair @4
         r1.8 edge r1.5 -near-> r1.7 @4
         r1.9 write r1.3 level=1 @5
         r2.1 write r1.3 level=2 @5
         r2.2 write r1.6 far=2 @5
         r2.3 write root hour=3 @4
         r2.4 edge root -near-> r9.1 @1
         r2.5 write r2.4 far=5 @1
         r2.6 edge r9.1 -near-> root @1
         r2.7 write r2.6 far=5 @1
         r2.8 write r9.2 level=5 @1",
    )
}

fn dictionary() -> Dictionary {
    Dictionary::open().with_functional("in")
}

/// What the judges say of a house that is shown otherwise than it is.
fn judged(change: impl FnOnce(&mut Shown<'_>)) -> Result<(), Violation> {
    let (state, dictionary) = (house(), dictionary());
    let mut shown = Shown::of(&state, &dictionary);
    assert_eq!(check_view(&shown), Ok(()));
    assert_eq!(check_repairs(&shown), Ok(()));
    change(&mut shown);
    check_view(&shown)
}

/// [property: INV-1]
#[test]
fn canary_a_vertex_without_a_path_is_told() {
    let cut = |shown: &mut Shown<'_>| shown.hide(edge("r1.6"));
    assert_eq!(judged(cut), Err(Violation::NoPath { vertex: vertex("r1.5") }));
    assert_eq!(judged(|shown| shown.hide(edge("r1.8"))), Err(Violation::NoPath { vertex: vertex("r1.7") }));
    // A link that is reported is a path, whichever vertex of the component it holds.
    for held in ["r1.5", "r1.7"] {
        let linked = |shown: &mut Shown<'_>| {
            cut(shown);
            shown.repairs.push(Repair::Reattached { vertex: vertex(held) });
        };
        assert_eq!(judged(linked), Ok(()));
    }
    let elsewhere = |shown: &mut Shown<'_>| {
        cut(shown);
        shown.repairs.push(Repair::Reattached { vertex: vertex("r1.3") });
    };
    assert_eq!(judged(elsewhere), Err(Violation::NoPath { vertex: vertex("r1.5") }));
}

/// [property: INV-2]
#[test]
fn canary_edges_and_writes_on_what_is_not_there_are_told() {
    let (nobody, id) = (vertex("r9.1"), edge("r2.4"));
    let shown_too = |from, to| judged(move |shown| shown.show(id, claim(from, "near", to)));
    assert_eq!(shown_too("r1.1", "r9.1"), Err(Violation::Dangling { edge: id, vertex: nobody }));
    assert_eq!(shown_too("r9.1", "r1.1"), Err(Violation::Dangling { edge: id, vertex: nobody }));
    assert_eq!(shown_too("r1.1", "r1.3"), Ok(()));
    assert_eq!(shown_too("root", "r1.3"), Ok(()));
    // Held, but not shown.
    let hidden = judged(|shown| shown.vertices.retain(|&known| known != vertex("r1.7")));
    assert_eq!(hidden, Err(Violation::Dangling { edge: edge("r1.8"), vertex: vertex("r1.7") }));
    for (write, target) in [("r2.5", "r2.4"), ("r2.7", "r2.6"), ("r2.8", "r9.2")] {
        let (write, target) = (dot(write), dot(target));
        assert_eq!(judged(|shown| shown.write(write)), Err(Violation::DanglingWrite { write, target }));
    }
}

/// [property: INV-3]
#[test]
fn canary_what_is_no_tree_is_told() {
    let (kitchen, bob) = (vertex("r1.1"), vertex("r1.3"));
    let two = judged(|shown| shown.show(edge("r2.4"), claim("root", "RT", "r1.3")));
    assert_eq!(two, Err(Violation::TwoParents { child: bob, first: edge("r2.4"), second: edge("r1.4") }));
    let placements = [
        (VertexId::ROOT, Placement::Outside),
        (VertexId::ROOT, Placement::Detached),
        (kitchen, Placement::Root),
        (kitchen, Placement::Detached),
        (kitchen, Placement::Outside),
        (bob, Placement::Child { parent: VertexId::ROOT, edge: edge("r1.4") }),
        (bob, Placement::Child { parent: kitchen, edge: edge("r1.2") }),
        (vertex("r1.5"), Placement::Detached),
        (vertex("r1.5"), Placement::Child { parent: kitchen, edge: edge("r1.6") }),
    ];
    for (vertex, placement) in placements {
        let placed = judged(|shown| {
            shown.placements.insert(vertex, placement);
        });
        assert_eq!(placed, Err(Violation::Misplaced { vertex }), "{placement:?}");
    }
    let unplaced = judged(|shown| {
        shown.placements.remove(&bob);
    });
    assert_eq!(unplaced, Err(Violation::Misplaced { vertex: bob }));

    let topless = |shown: &mut Shown<'_>| {
        shown.hide(edge("r1.2"));
        shown.placements.insert(kitchen, Placement::Outside);
    };
    assert_eq!(judged(topless), Err(Violation::NotRooted { vertex: bob }));
    let detached = |shown: &mut Shown<'_>| {
        shown.hide(edge("r1.2"));
        shown.placements.insert(kitchen, Placement::Detached);
        shown.repairs.push(Repair::Detached { vertex: kitchen });
    };
    assert_eq!(judged(detached), Ok(()));
    let cycle = |shown: &mut Shown<'_>| {
        shown.hide(edge("r1.2"));
        shown.show(edge("r2.4"), claim("r1.3", "RT", "r1.1"));
        shown.placements.insert(kitchen, Placement::Child { parent: bob, edge: edge("r2.4") });
    };
    assert_eq!(judged(cycle), Err(Violation::NotRooted { vertex: kitchen }));
}

/// A long way up, whose vertices are asked in every order, is no cycle. [property: INV-3]
#[test]
fn law_long_ways_up_the_tree_are_walked_to_the_root() {
    for chain in
        [["r1.1", "r1.2", "r1.3", "r1.4"], ["r1.4", "r1.3", "r1.2", "r1.1"], ["r1.2", "r1.4", "r1.1", "r1.3"]]
    {
        let vertices = (1..=4).map(|n| format!("r1.{n} vertex t v{n} @1"));
        let parents = [&["root"], &chain[..3]].concat();
        let claims = parents.iter().zip(chain).enumerate();
        let claims =
            claims.map(|(at, (parent, child))| format!("r2.{} edge {parent} -RT-> {child} @2", at + 1));
        let (state, dictionary) =
            (state(&vertices.chain(claims).collect::<Vec<_>>().join("\n")), dictionary());
        let mut shown = Shown::of(&state, &dictionary);
        assert_eq!(check_view(&shown), Ok(()));
        assert_eq!(check_repairs(&shown), Ok(()));
        shown.hide(edge("r2.1"));
        shown.placements.insert(vertex(chain[0]), Placement::Outside);
        assert!(matches!(check_view(&shown), Err(Violation::NotRooted { .. })));
    }
}

/// [property: INV-4] [property: INV-5] [property: INV-6]
#[test]
fn canary_loops_undeclared_attributes_and_twins_are_told() {
    let (id, kitchen) = (edge("r2.4"), vertex("r1.1"));
    let looped = judged(|shown| shown.show(id, claim("r1.1", "near", "r1.1")));
    assert_eq!(looped, Err(Violation::SelfLoop { edge: id, vertex: kitchen }));

    let twin = |from, label, to| judged(move |shown| shown.show(id, claim(from, label, to)));
    let told = |key, first: &str| Err(Violation::TwoShown { key, first: edge(first), second: id });
    let key = |from: &str, label, to: &str| dsr_core::EdgeKey::new(vertex(from), label, vertex(to));
    assert_eq!(twin("r1.5", "near", "r1.7"), told(key("r1.5", "near", "r1.7"), "r1.8"));
    assert_eq!(twin("r1.5", "in", "r1.7"), told(key("r1.5", "in", "r1.1"), "r1.6"));
    // The same label of another source, to another target where it is not functional, another label.
    for (from, label, to) in [("r1.7", "in", "r1.1"), ("r1.5", "near", "r1.1"), ("r1.5", "far", "r1.7")] {
        assert_eq!(twin(from, label, to), Ok(()));
    }

    let state = house();
    for (value_type, closed) in [(ValueType::Int, true), (ValueType::Bool, false)] {
        let open = dictionary();
        let attributes = ["level", "far", "hour"].map(|name| (name.into(), value_type)).into();
        let mut strict = Dictionary { attributes, closed, ..open.clone() };
        let mut shown = Shown::of(&state, &strict);
        shown.writes = view(&state, &open).writes().to_vec();
        let is_sound = value_type == ValueType::Int;
        assert_eq!(check_view(&shown).is_ok(), is_sound);
        let broken = Violation::Undeclared { name: "hour".into(), given: ValueType::Int };
        assert!(is_sound || check_view(&shown) == Err(broken));
        strict.attributes.clear();
        strict.closed = true;
        let mut shown = Shown::of(&state, &strict);
        assert_eq!(shown.writes, []);
        shown.writes = view(&state, &open).writes().to_vec();
        assert!(matches!(check_view(&shown), Err(Violation::Undeclared { .. })));
    }
}

/// [property: VIEW-7]
#[test]
fn canary_a_name_that_finds_another_is_told() {
    let bob = vertex("r1.3");
    for found in [None, Some(bob), Some(VertexId::ROOT)] {
        let misnamed = judged(|shown| {
            shown.names.insert("kitchen", found);
        });
        assert_eq!(misnamed, Err(Violation::Misnamed { name: "kitchen".into(), expected: vertex("r1.1") }));
    }
    let state = state(
        "r1.1 vertex room hall @2
         r1.2 edge root -RT-> r1.1 @2
         r2.1 vertex room hall @1
         r2.2 edge root -RT-> r2.1 @1
         r3.1 vertex room world @1
         r3.2 edge root -RT-> r3.1 @1",
    );
    let dictionary = dictionary();
    for (name, found, expected) in [("hall", "r1.1", "r2.1"), ("world", "r3.1", "root")] {
        let mut shown = Shown::of(&state, &dictionary);
        assert_eq!(check_view(&shown), Ok(()));
        shown.names.insert(name, Some(vertex(found)));
        assert_eq!(
            check_view(&shown),
            Err(Violation::Misnamed { name: name.into(), expected: vertex(expected) })
        );
    }
}

/// [property: VIEW-8]
#[test]
fn canary_a_lesser_write_before_a_greater_one_is_told() {
    let text = |first: &str, second: &str| {
        state(&format!(
            "r1.1 vertex room hall @1
             r1.2 edge root -RT-> r1.1 @1
             r2.1 write {first} @2
             r2.2 write {second} @3"
        ))
    };
    let dictionary = dictionary();
    let swapped = |state: &State| {
        let mut shown = Shown::of(state, &dictionary);
        assert_eq!(check_view(&shown), Ok(()));
        shown.writes.sort_by_key(|(dot, _)| *dot);
        check_view(&shown)
    };
    let outranked = Violation::Outranked { winner: dot("r2.1"), greater: dot("r2.2") };
    assert_eq!(swapped(&text("r1.1 level=1", "r1.1 level=2")), Err(outranked));
    assert_eq!(swapped(&text("r1.1 level=1", "r1.1 light=2")), Ok(()));
    assert_eq!(swapped(&text("r1.1 level=1", "r1.2 level=2")), Ok(()));
    // Of one stamp, the greater dot is the greater write.
    let of_one_stamp = judged(|shown| shown.writes.sort_by_key(|(dot, _)| *dot));
    assert_eq!(of_one_stamp, Err(Violation::Outranked { winner: dot("r1.9"), greater: dot("r2.1") }));
}

/// [property: VIEW-10]
#[test]
fn canary_a_repair_of_what_is_whole_is_told() {
    let (state, dictionary) = (house(), dictionary());
    let repairs = [
        Repair::Detached { vertex: vertex("r1.1") },
        Repair::Undeclared { write: dot("r1.9") },
        Repair::CycleBroken { hidden: edge("r1.4") },
    ];
    for repair in repairs {
        let mut shown = Shown::of(&state, &dictionary);
        shown.repairs.push(repair.clone());
        assert_eq!(check_repairs(&shown), Err(Violation::Needless { repair }));
    }
}

/// Each thing that can be broken, beside what resembles it and is not. [property: VIEW-9] [property: VIEW-10]
#[test]
fn canary_silence_about_what_is_broken_is_told() {
    const BASE: &str = "r1.1 vertex t a @1
         r1.2 vertex t b @1
         r1.3 edge root -near-> r1.1 @1
         r1.4 edge root -near-> r1.2 @1\n";
    let open = dictionary();
    let typed = Dictionary { attributes: [("light".into(), ValueType::Bool)].into(), ..dictionary() };
    let register = Some("one edge per register");
    let declared = Some("declared attributes");
    let cases: [(&Dictionary, &str, Option<&str>); 21] = [
        (&open, "", None),
        (&open, "r2.1 edge root -near-> r1.1 @1", register),
        (&open, "r2.1 edge root -far-> r1.1 @1", None),
        (&open, "r2.1 edge r1.1 -in-> r1.2 @1\nr2.2 edge r1.1 -in-> root @1", register),
        (&open, "r2.1 edge r1.1 -far-> r1.2 @1\nr2.2 edge r1.1 -far-> root @1", None),
        (&open, "r2.1 edge root -near-> r9.1 @1\nr2.2 edge root -near-> r9.1 @1", None),
        (&open, "r2.1 edge r9.1 -near-> root @1\nr2.2 edge r9.1 -near-> root @1", None),
        (&open, "r2.1 edge root -RT-> r1.1 @1\nr2.2 edge root -RT-> r1.2 @1", None),
        (&open, "r2.1 edge root -RT-> r1.1 @1\nr2.2 edge r1.2 -RT-> r1.1 @1", Some("one kinematic parent")),
        (&open, "r2.1 edge root -RT-> r1.1 @1\nr2.2 edge r1.1 -RT-> r1.2 @1", None),
        (&open, "r2.1 edge r1.1 -RT-> r1.2 @1", Some("one kinematic tree")),
        (&open, "r2.1 edge r1.1 -RT-> r1.2 @1\nr2.2 edge r1.2 -RT-> r1.1 @1", Some("one kinematic tree")),
        (&open, "r2.1 vertex t c @1", Some("a path to the root")),
        (&open, "r2.1 vertex t c @1\nr2.2 edge r2.1 -far-> r1.2 @1", None),
        (&open, "r2.1 vertex t a @1\nr2.2 edge r2.1 -far-> r1.2 @1", Some("one vertex per name")),
        (&open, "r2.1 vertex t world @1\nr2.2 edge r2.1 -far-> r1.2 @1", Some("one vertex per name")),
        (&typed, "r2.1 write r1.1 light=true @1\nr2.2 write r1.1 heat=5 @1", None),
        (&typed, "r2.1 write r1.1 light=5 @1", declared),
        (&typed, "r2.1 write r1.3 light=5 @1", declared),
        (&typed, "r2.1 write root light=5 @1", declared),
        (
            &typed,
            "r2.1 write r9.1 light=5 @1\nr2.2 edge root -far-> r9.1 @1\nr2.3 write r2.2 light=5 @1",
            None,
        ),
    ];
    for (dictionary, text, what) in cases {
        let state = state(&format!("{BASE}{text}"));
        let mut shown = Shown::of(&state, dictionary);
        assert_eq!(check_repairs(&shown), Ok(()), "{text}");
        assert_eq!(shown.repairs.is_empty(), what.is_none(), "{text}");
        shown.repairs.clear();
        assert_eq!(
            check_repairs(&shown),
            what.map_or(Ok(()), |what| Err(Violation::Silent { what })),
            "{text}"
        );
    }
}

/// [property: STATE-3] [property: STATE-6]
#[test]
fn canary_what_comes_back_from_the_dead_is_told() {
    let records = |dots: &[&str]| {
        let lines: Vec<String> = dots.iter().map(|dot| format!("{dot} vertex t v @1")).collect();
        state(&lines.join("\n"))
    };
    let mut before = records(&["r1.1", "r1.3", "r3.1"]);
    before.join(&state("dead r1.2 r1.4 r2.1"));
    for (after, expected) in [
        (&["r1.1", "r1.3", "r3.1"][..], Ok(())),
        (&["r1.3", "r1.5", "r2.2", "r3.1", "r3.2"], Ok(())),
        (&[], Ok(())),
        (&["r1.1", "r1.2", "r1.3"], Err(dot("r1.2"))),
        (&["r1.4", "r3.1"], Err(dot("r1.4"))),
        (&["r1.3", "r2.1"], Err(dot("r2.1"))),
    ] {
        assert_eq!(check_removal_is_final(&before, &records(after)), expected, "{after:?}");
    }

    assert_eq!(check_no_remains(&house()), Ok(()));
    let (edge, anchor) = (dot("r1.1"), dot("r2.1"));
    let record = Record::Edge(claim("root", "near", "r2.1"));
    let remains = State::assemble([(edge, record)], [edge, anchor].into_iter().collect());
    assert_eq!(check_no_remains(&remains), Err(Malformed::NotClosed { dot: edge, anchor }));
}
