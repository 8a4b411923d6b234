//! Content made for tests.

#![allow(
    dead_code,
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "each test takes some of it; what fails here fails a test"
)]

use dsr_explorer::{Content, Origin, Shown, Side};
use dsr_model::gallery::{rows, run_row};
use dsr_model::graph::{Element, Graph};
use dsr_model::trace::{Act, Finding, FindingKind, Heading, Scribe, Trace, TraceReplica};
use serde_json::{Value, json};

/// Every row of the gallery with both runs, as `dsr gallery --report` shows them.
pub(crate) fn gallery() -> Content {
    let reports: Vec<_> = rows().iter().map(run_row).collect();
    let mut traces = Vec::new();
    let mut listed = Vec::new();
    for report in reports {
        let checked = report.checked.as_ref().map(dsr_model::gallery::Twin::verdict);
        listed.push(json!({
            "row": report.row, "title": report.title, "clause": report.breach.map(|breach| breach.clause),
            "steps": report.steps, "states": report.states, "checked": checked,
            "control": report.control.map(|control| json!({ "what": control.what, "found": control.found })),
        }));
        let row = |side| Origin::Row { row: report.row.into(), side };
        traces.extend(report.trace.map(|trace| Shown { trace, origin: row(Side::Published) }));
        let twin = report.checked.map(|twin| twin.trace);
        traces.extend(twin.map(|trace| Shown { trace, origin: row(Side::Checked) }));
    }
    Content { title: "Gallery".into(), report: None, gallery: Some(json!({ "rows": listed })), traces }
}

/// A result with every verdict, and traces of every kind.
pub(crate) fn check() -> Content {
    let property = |clause: &str, kind: &str, verdict: &str| json!({ "clause": clause, "kind": kind, "verdict": verdict, "claim": "L3", "what": "what it demands", "trace": null });
    let run = |layer: &str, verdict: &str| {
        let states = json!({ "unique": 1_534_664, "generated": 3_528_418, "judged": 521_002, "subsets": 0, "sampled": 0, "diamonds": 0 });
        json!({
            "name": format!("2 × 2, all six, {verdict}"), "layer": layer, "semantics": "checked", "replicas": 2,
            "mutations": 2, "focus": 2, "operations": 18, "states": states, "seconds": 11.9, "search_seconds": 6.0,
            "verdict": verdict, "notes": ["it stopped at its limit"], "second_engine": states, "collision_bound": 0.0,
            "properties": [property("JOIN-5", "always", verdict), property("INV-1", "always", "exhaustive"), property("a repair is seen", "sometimes", "exhaustive")],
        })
    };
    let runs: Vec<Value> =
        ["exhaustive", "bounded", "vacuous", "violated"].map(|verdict| run("L1", verdict)).into();
    let report = json!({
        "verdict": "violated", "seconds": 43.1, "runs": runs, "assumed": ["deltas arrive whole"], "not_checked": ["liveness"],
        "examples": [{ "layer": "L0", "run": "every state", "clause": "JOIN-3", "text": "X: …\nY: …" }],
    });
    let alone = |trace| Shown { trace, origin: Origin::Run("2 × 2, all six, violated".into()) };
    let traces = vec![alone(every_kind()), alone(large())];
    Content { title: "What the check found".into(), report: Some(report), gallery: None, traces }
}

/// Only this trace.
pub(crate) fn alone(trace: Trace) -> Content {
    let title = trace.title.clone();
    Content { title, report: None, gallery: None, traces: vec![Shown { trace, origin: Origin::Alone }] }
}

fn vertex(name: &str, attributes: &[(&str, &str)]) -> Element {
    Element::Vertex { name: name.into(), vertex_type: "thing".into(), attributes: texts(attributes) }
}

fn edge(from: &str, label: &str, to: &str, attributes: &[(&str, &str)]) -> Element {
    Element::Edge { from: from.into(), to: to.into(), label: label.into(), attributes: texts(attributes) }
}

fn texts(attributes: &[(&str, &str)]) -> dsr_model::graph::Attributes {
    attributes.iter().map(|&(name, value)| (name.into(), value.into())).collect()
}

/// Writes a trace down as it is made.
struct Maker {
    scribe: Scribe,
    graphs: Vec<Graph>,
}

impl Maker {
    fn new(names: &[&str], starts: &Graph) -> Self {
        let replicas = names.iter().enumerate().map(|(index, name)| TraceReplica {
            name: (*name).into(),
            index,
            starts: starts.clone(),
            state: None,
        });
        Self { scribe: Scribe::new(replicas.collect()), graphs: vec![starts.clone(); names.len()] }
    }

    fn step(&mut self, replica: usize, does: Act, change: impl FnOnce(&mut Graph)) {
        change(&mut self.graphs[replica]);
        let shows = self.graphs[replica].clone();
        let state = json!(shows);
        self.scribe.note(replica, does, shows, &state);
    }

    fn mutate(&mut self, replica: usize, text: &str, change: impl FnOnce(&mut Graph)) {
        let sends = vec![self.scribe.send(format!("{text}, told"), Value::Null)];
        self.step(replica, Act::Mutate { text: text.into(), mutations: Vec::new(), sends }, change);
    }

    fn deliver(&mut self, replica: usize, message: &str, again: bool, change: impl FnOnce(&mut Graph)) {
        self.step(replica, Act::Deliver { message: message.into(), again }, change);
    }

    fn finish(self, title: &str, detail: &str, shown_by: usize) -> Trace {
        let finding = Finding {
            kind: FindingKind::Broken,
            clause: "JOIN-5".into(),
            what: "who has received the same shows the same".into(),
            detail: detail.into(),
            replicas: self.scribe.names([shown_by]),
        };
        let heading = Heading {
            title: title.into(),
            semantics: "checked".into(),
            setup: Value::Null,
            layer: "L1".into(),
            bound: "3 × 2".into(),
        };
        self.scribe.finish(heading, finding)
    }
}

fn put(graph: &mut Graph, id: &str, element: Element) {
    graph.elements.insert(id.into(), element);
}

/// A flat of rooms and what is in them, with as many further things as asked for.
fn flat(things: usize) -> Graph {
    let mut graph = Graph::default();
    put(&mut graph, "0", vertex("world", &[]));
    for (id, name, parent) in [
        ("1", "kitchen", "0"),
        ("2", "hall", "0"),
        ("3", "table", "1"),
        ("4", "cup", "3"),
        ("5", "robot", "2"),
    ] {
        put(&mut graph, id, vertex(name, &[("size", "3"), ("mode", "idle")]));
        put(&mut graph, &format!("e{id}"), edge(parent, "RT", id, &[("pose", "[0, 0, 0]")]));
    }
    put(&mut graph, "on", edge("4", "on", "3", &[]));
    put(&mut graph, "near", edge("5", "near", "3", &[("since", "4")]));
    for number in 0..things {
        let id = format!("t{number:02}");
        put(&mut graph, &id, vertex("thing", &[("number", &number.to_string())]));
        put(&mut graph, &format!("e{id}"), edge(if number % 2 == 0 { "1" } else { "2" }, "RT", &id, &[]));
    }
    graph
}

/// Every kind of step, and every kind of change.
pub(crate) fn every_kind() -> Trace {
    let mut made = Maker::new(&["agent 1", "agent 2", "observer 1"], &flat(0));
    made.mutate(0, "removes the table", |graph| {
        for id in ["3", "e3", "on"] {
            graph.elements.remove(id);
        }
        put(graph, "e4", edge("1", "RT", "4", &[("pose", "[0, 0, 0]")]));
        graph.remarks.insert("cup hangs from kitchen: its parent is gone".into());
    });
    made.mutate(1, "adds a spoon and turns things round", |graph| {
        put(graph, "6", vertex("cup", &[("full", "yes")]));
        put(graph, "e6", edge("3", "RT", "6", &[]));
        put(graph, "self", edge("6", "likes", "6", &[("much", "very")]));
        put(graph, "lost", edge("6", "belongs to", "nobody", &[]));
        put(graph, "again", edge("1", "RT", "3", &[]));
        put(graph, "back", edge("4", "RT", "1", &[]));
    });
    made.mutate(1, "changes the robot", |graph| {
        put(graph, "5", vertex("robot", &[("size", "4"), ("task", "guide")]));
        put(graph, "near", edge("5", "near", "4", &[("since", "5")]));
    });
    made.deliver(0, "m2", false, |graph| {
        put(graph, "6", vertex("cup", &[("full", "yes")]));
        put(graph, "e6", edge("3", "RT", "6", &[]));
    });
    made.deliver(0, "m2", true, |graph| {
        graph.remarks.clear();
        graph.remarks.insert("held back: an edge".into());
    });
    made.step(2, Act::Lose { message: "m1".into() }, |_| {});
    made.step(1, Act::Restart { keeps: false }, |graph| *graph = flat(0));
    made.step(1, Act::Restart { keeps: true }, |_| {});
    let sends = vec![made.scribe.send("everything".into(), Value::Null)];
    made.step(0, Act::Answer { to: "observer 1".into(), sends }, |_| {});
    made.deliver(2, "m4", false, |graph| *graph = Graph::default());
    made.step(2, Act::Happen { text: "waits".into() }, |_| {});
    made.finish("Every kind of step", "agent 1 shows 3, observer 1 shows none", 2)
}

/// Seventy vertices, of which few are ever touched.
pub(crate) fn large() -> Trace {
    let mut made = Maker::new(&["agent 1", "agent 2"], &flat(64));
    made.mutate(0, "moves the cup", |graph| put(graph, "e4", edge("5", "RT", "4", &[])));
    made.deliver(1, "m1", false, |graph| {
        graph.elements.remove("e4");
    });
    made.finish("A large flat", "the cup has no parent at agent 2", 1)
}

/// A text that would like to be more than one.
pub(crate) const HOSTILE: &str =
    "</script><img src=x onerror=\"document.title='owned'\">{{script}}\u{202e}<!--";

/// Hostile and endless texts wherever there are texts.
pub(crate) fn hostile() -> Trace {
    let long = "long ".repeat(40) + &"x".repeat(10_000);
    let mut start = Graph::default();
    put(&mut start, HOSTILE, vertex(HOSTILE, &[(HOSTILE, HOSTILE)]));
    put(&mut start, &long, vertex(&long, &[(&long, &long)]));
    put(&mut start, "__proto__", edge(HOSTILE, HOSTILE, &long, &[("__proto__", "constructor")]));
    put(&mut start, "constructor", edge(&long, &long, HOSTILE, &[(&long, &long)]));
    start.remarks.insert(HOSTILE.into());
    let mut made = Maker::new(&[HOSTILE, &long], &start);
    made.mutate(0, HOSTILE, |graph| {
        put(graph, HOSTILE, vertex(&long, &[(HOSTILE, &long), ("__proto__", "toString")]));
        graph.remarks.insert(long.clone());
    });
    made.deliver(1, "m1", false, |graph| {
        graph.elements.remove("__proto__");
    });
    let mut trace = made.finish(HOSTILE, &format!("{HOSTILE}{long}"), 0);
    (trace.bound, trace.finding.clause) = (HOSTILE.into(), HOSTILE.into());
    trace
}
