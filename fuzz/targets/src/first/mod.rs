//! Inputs to begin with, made without chance: what the readers accept, of every kind.

mod faulty;

use crate::noise::Noise;
use arbitrary::{Arbitrary, Unstructured};
use dsr_conformance::adapter::Core;
use dsr_conformance::case;
use dsr_conformance::case::{Case, CaseFile};
use dsr_conformance::corpus::FILES;
use dsr_conformance::log::LogWriter;
use dsr_conformance::report::Outcome;
use dsr_conformance::run::{InProcess, Watch, run_watched};
use dsr_core::scene::{Scene, TINY};
use dsr_core::{
    Author, CausalContext, Dictionary, Digest, Dot, Edge, Mutation, MutationKind, Record, ReplicaId, Run,
    State, Value, Vertex, VertexId, Write, digest, encode, encode_digest, limits, view,
};
use dsr_model::alarms::{self, A, B, subject};
use dsr_model::course::Event;
use dsr_model::gallery;
use dsr_model::semantics::Semantics;
use dsr_model::trace::{Finding, FindingKind, Recorder, Trace};
use dsr_model::walks::{Faults, Walk, find};
use dsr_testkit::{Anchors, bytes};
use serde::Serialize;
use std::sync::Arc;

/// Bytes of many lengths.
pub(crate) fn structured() -> Vec<Vec<u8>> {
    (0..200).map(|seed| Noise::new(seed).bytes(8 + 3 * usize::try_from(seed).unwrap_or_default())).collect()
}

/// Bytes to make something small of.
fn noise(count: u64) -> impl Iterator<Item = Vec<u8>> {
    (0..count).map(|seed| Noise::new(seed).bytes(512))
}

/// Something arbitrary, `count` times.
fn some<T: for<'a> Arbitrary<'a>>(count: u64) -> Vec<T> {
    noise(count).filter_map(|bytes| Unstructured::new(&bytes).arbitrary().ok()).collect()
}

fn shape(u: &mut Unstructured<'_>) -> arbitrary::Result<State> {
    let universe = bytes::universe(u, 6, Anchors::Right)?;
    let fates = bytes::fates(u, &universe)?;
    Ok(universe.state(&fates))
}

/// States of any shape, of any values, and with many gaps.
fn all_states() -> Vec<State> {
    let shapes = noise(24).filter_map(|bytes| shape(&mut Unstructured::new(&bytes)).ok()).collect();
    let gaps = |count: u64| {
        let runs = (1..=count).map(|at| Run { replica: ReplicaId::agent(1), first: 3 * at, last: 3 * at });
        State::assemble([], runs.collect::<CausalContext>())
    };
    [shapes, some(4), vec![gaps(3), gaps(20), State::new()]].concat()
}

/// States that are not well-formed, one for each way not to be: no encoder meets them, and every reader may.
fn malformed() -> Vec<State> {
    let dot = |sequence| Dot::new(ReplicaId::agent(1), sequence);
    let vertex = |stamp| {
        Record::Vertex(Vertex { vertex_type: "t".into(), name: "a".into(), external_id: None, stamp })
    };
    let edge = |from, label: &str, to| Record::Edge(Edge { from, to, label: label.into(), stamp: 1 });
    let write =
        |target, value| Record::Write(Write { target, name: "a".into(), value, timestamp_ns: 0, stamp: 1 });
    let odd_nan = f32::from_bits(0x7fc0_0001);
    let all = vec![
        vec![(dot(1), vertex(0))],
        vec![(dot(1), vertex(limits::STAMP_MAX + 1))],
        vec![(dot(limits::SEQUENCE_MAX + 1), vertex(1))],
        vec![(dot(1), edge(VertexId(dot(2)), "in", VertexId(dot(2))))],
        vec![(dot(1), edge(VertexId(dot(2)), "RT", VertexId::ROOT))],
        vec![(dot(1), edge(VertexId(dot(0)), "in", VertexId::ROOT))],
        vec![(dot(1), write(dot(2), Value::Int(1))), (dot(2), write(VertexId::ROOT.0, Value::Int(1)))],
        vec![(dot(1), edge(VertexId(dot(2)), "in", VertexId::ROOT)), (dot(2), write(dot(3), Value::Int(1)))],
        vec![(dot(1), write(dot(2), Value::Float(odd_nan)))],
        vec![(dot(1), write(dot(2), Value::Vec2([odd_nan; 2])))],
    ];
    let seen = all.into_iter().map(|records| {
        let context = records.iter().map(|(dot, _)| *dot).collect();
        State::assemble(records, context)
    });
    let unseen = State::assemble([(dot(1), vertex(1))], CausalContext::new());
    let dead =
        State::assemble([(dot(1), write(dot(2), Value::Int(1)))], [dot(1), dot(2)].into_iter().collect());
    seen.chain([unseen, dead]).collect()
}

pub(crate) fn states() -> Vec<Vec<u8>> {
    all_states().iter().chain(&malformed()).map(encode).collect()
}

fn all_digests() -> Vec<Digest> {
    all_states().iter().map(digest).collect()
}

pub(crate) fn digests() -> Vec<Vec<u8>> {
    all_digests().iter().map(encode_digest).collect()
}

fn bytes_of(texts: Vec<String>) -> Vec<Vec<u8>> {
    texts.into_iter().map(String::into_bytes).collect()
}

fn texts<T: Serialize>(values: &[T]) -> Vec<Vec<u8>> {
    values.iter().filter_map(|value| serde_json::to_vec(value).ok()).collect()
}

pub(crate) fn state_texts() -> Vec<Vec<u8>> {
    let states = all_states();
    let records: Vec<_> =
        states.iter().flat_map(State::records).take(24).map(|(_, record)| record.clone()).collect();
    let dictionaries = crate::laws::dictionaries();
    let repairs: Vec<_> = states
        .iter()
        .flat_map(|state| dictionaries.iter().map(move |dictionary| view(state, dictionary)))
        .flat_map(|shown| shown.repairs().to_vec())
        .collect();
    [
        texts(&states),
        texts(&malformed()),
        texts(&all_digests()),
        texts(&records),
        texts(&repairs),
        bytes_of(faulty::states()),
    ]
    .concat()
}

pub(crate) fn mutation_texts() -> Vec<Vec<u8>> {
    let authors: Vec<Author> = some(4);
    [texts(&some::<Mutation>(48)), texts(&some::<Value>(48)), texts(&authors), bytes_of(faulty::mutations())]
        .concat()
}

pub(crate) fn dictionary_texts() -> Vec<Vec<u8>> {
    [texts(&crate::laws::dictionaries()), bytes_of(faulty::dictionaries())].concat()
}

pub(crate) fn scene_texts() -> Vec<Vec<u8>> {
    let open = Dictionary::open();
    let written = all_states().into_iter().map(|state| Scene::of(state).write(&open));
    bytes_of(written.chain([TINY.to_owned()]).chain(faulty::scenes()).collect())
}

/// A history of the core, and short ones of cores broken on purpose.
pub(crate) fn trace_texts() -> Vec<Vec<u8>> {
    let broken = ["closure-skipped", "resurrection", "tie-by-arrival", "reused-dot"];
    let walk = Walk { replicas: 2, mutations_max: 3, events_max: 24, seed: 1, faults: Faults::ALL };
    let found = alarms::all().into_iter().filter(|alarm| broken.contains(&alarm.name)).filter_map(|alarm| {
        let core = Arc::new(alarm.core(&MutationKind::ALL, &[A, B]));
        find(&core, walk, 400)?.trace().ok()
    });
    let sound = sound_trace();
    let spoiled = sound.iter().flat_map(faulty::traces).map(String::into_bytes);
    let published = gallery::rows().into_iter().take(1).filter_map(|row| gallery::run_row(&row).trace);
    let all: Vec<Trace> = found.chain(published).chain(sound.clone()).collect();
    texts(&all).into_iter().chain(spoiled).collect()
}

fn sound_trace() -> Option<Trace> {
    let core = subject(&MutationKind::ALL, &[B]);
    let mut recorder = Recorder::new(&core, ["r1", "r2"].map(String::from));
    let first = core.mutations(&recorder.states()[0], 0).into_iter().next()?;
    let last = core.mutations(&recorder.states()[1], 1).into_iter().next_back()?;
    let events = [
        Event::Mutate { replica: 0, mutations: vec![first] },
        Event::Mutate { replica: 1, mutations: vec![last] },
        Event::Deliver { replica: 1, message: 0 },
        Event::Lose { replica: 0, message: 1 },
        Event::Restart { replica: 0, keeps: true },
        Event::Answer { replica: 1, to: 0 },
    ];
    for event in &events {
        recorder.record(event).ok()?;
    }
    let nothing = String::new;
    let (clause, what, detail) = (nothing(), nothing(), nothing());
    let finding = Finding { kind: FindingKind::Holds, clause, what, detail, replicas: Vec::new() };
    Some(recorder.finish("a history".into(), "L1", "6 events".into(), finding))
}

/// The lines of both sides.
#[derive(Default)]
struct Lines {
    sent: String,
    came: String,
}

impl Watch for Lines {
    fn sent(&mut self, line: &str) {
        self.sent.extend([line.trim_end(), "\n"]);
    }

    fn came(&mut self, line: &str) {
        self.came.extend([line.trim_end(), "\n"]);
    }
}

/// The first case of each file that ships: its lines, its replies, its file, its log; and expectations.
pub(crate) fn protocol_texts() -> Vec<Vec<u8>> {
    let mut texts = Vec::new();
    let files = FILES.iter().filter(|(path, _)| !path.contains("model-"));
    for (path, text) in files {
        let Ok(file) = case::read(path, text) else { continue };
        let Some(case) = file.cases.iter().min_by_key(|case| case.steps.len()).cloned() else { continue };
        let one = CaseFile { cases: vec![case.clone()], ..file };
        texts.extend(case::write(&one).ok());
        texts.extend(conversation(&case));
    }
    let excuse =
        r#"{"implementation":"x","expected":[{"case":"universal/*","verdict":"fail","reason":"so"}]}"#;
    texts.push(excuse.to_owned());
    texts.extend(faulty::protocol());
    bytes_of(texts)
}

fn conversation(case: &Case) -> [String; 3] {
    let cases = std::slice::from_ref(case);
    let mut lines = Lines::default();
    run_watched(&mut InProcess(Core::default), cases, &mut lines);
    let mut log = Vec::new();
    let mut writer = LogWriter::new(&mut log, &[], ("*", None), 1, None);
    let report = run_watched(&mut InProcess(Core::default), cases, &mut writer);
    // Vectors take whatever is written.
    let _ = writer.finish(&report, Outcome::Expected);
    [lines.sent, lines.came, String::from_utf8_lossy(&log).into_owned()]
}
