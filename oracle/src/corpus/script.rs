//! A case as requests, and what the core replies to each. `[spec: ORACLE-4]`

use super::expected::Expected;
use crate::program::{Trouble, excerpt};
use dsr_conformance::adapter::{Adapter, Core, answer};
use dsr_conformance::case::{Case, Encoded, Step};
use dsr_conformance::corpus;
use dsr_conformance::protocol::{
    Answer, AnswerDigest, AnswerFor, CaseBegin, Command, Decline, Decode, Deliver, DeltaName, Group, Hello,
    Load, Lookup, Mutate, PROTOCOL, Profile, Read, Reply, Request, Restart, View,
};
use rustc_hash::FxHashSet;
use serde_json::Value;
use siphasher::sip::SipHasher13;
use std::collections::BTreeMap;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// A request, and what is due.
#[derive(Debug)]
pub(super) struct Want {
    /// The step that it is for, counted from 1.
    pub(super) step: usize,
    /// The request.
    pub(super) asked: String,
    id: u64,
    ours: Arc<Ours>,
    /// What the file expects of this reply.
    pub(super) expected: Vec<Expected>,
}

/// What the core replies.
#[derive(Debug)]
struct Ours {
    answered: Result<Answer, Decline>,
    /// Its line, behind the number.
    tail: String,
}

impl Ours {
    fn of(answered: Result<Answer, Decline>) -> Self {
        // Replies are maps of strings: writing one cannot fail.
        let line = serde_json::to_string(&Reply::new(0, answered.clone())).unwrap_or_default();
        let tail = line.strip_prefix("{\"id\":0,").unwrap_or_default().into();
        Self { answered, tail }
    }
}

/// A reply without its number and without words.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Said {
    /// `ok`, views in canonical form.
    Ok(Value),
    /// The code, and the kind if there is one.
    Declined(Value, Value),
}

impl Said {
    fn text(&self) -> String {
        match self {
            Self::Ok(value) => value.to_string(),
            Self::Declined(code, Value::Null) => format!("declined: {code}"),
            Self::Declined(code, kind) => format!("declined: {code}, {kind}"),
        }
    }

    fn ours(answered: &Result<Answer, Decline>) -> Self {
        match answered {
            Ok(Answer::View(shown)) => {
                Self::Ok(serde_json::json!({ "view": shown.view.clone().canonical() }))
            }
            Ok(answer) => Self::Ok(serde_json::to_value(answer).unwrap_or_default()),
            Err(Decline::Error(error)) => Self::Declined(
                serde_json::to_value(error.code).unwrap_or_default(),
                error.kind.clone().into(),
            ),
            Err(Decline::Skip(_)) => Self::Declined("skip".into(), Value::Null),
        }
    }

    fn theirs(mut reply: Value) -> Option<Self> {
        if let Some(ok) = reply.get_mut("ok") {
            let mut ok = ok.take();
            if let Some(view) = ok.get_mut("view") {
                let read: View = serde_json::from_value(view.take()).ok()?;
                *view = serde_json::to_value(read.canonical()).ok()?;
            }
            return Some(Self::Ok(ok));
        }
        let error = reply.get("error")?;
        Some(Self::Declined(error.get("code")?.clone(), error.get("kind").cloned().unwrap_or(Value::Null)))
    }
}

impl Want {
    /// What is due and what came, where they differ. Of replies without an expectation `known` keeps which ones are as the
    /// core's: most come again and again. Two pairs are taken for the same with a chance of about 2⁻⁶⁴.
    pub(super) fn judge(&self, reply: &str, known: &mut Known) -> Result<Vec<(String, String)>, Trouble> {
        let rest = || reply.strip_prefix("{\"id\":")?.strip_prefix(&self.id.to_string())?.strip_prefix(',');
        let pair = rest().filter(|_| self.expected.is_empty()).map(|rest| {
            let mut hasher = SipHasher13::new();
            (&self.ours.tail, rest).hash(&mut hasher);
            hasher.finish()
        });
        if pair.is_some_and(|pair| known.0.contains(&pair)) {
            return Ok(Vec::new());
        }
        let garbage = || Trouble::Garbage { answer: excerpt(reply), question: excerpt(&self.asked) };
        let Ok(read) = serde_json::from_str::<Value>(reply) else { return Err(garbage()) };
        if read.get("id").and_then(Value::as_u64) != Some(self.id) {
            return Err(garbage());
        }
        let theirs = Said::theirs(read).ok_or_else(garbage)?;
        let mut differences = Vec::new();
        let ours = Said::ours(&self.ours.answered);
        if theirs != ours {
            differences.push((ours.text(), theirs.text()));
        }
        differences.extend(self.expected.iter().filter_map(|expected| expected.differs(&theirs)));
        if differences.is_empty() {
            known.0.extend(pair);
        }
        Ok(differences)
    }
}

/// Replies that have been compared, each with the core's, and are as they should be.
#[derive(Debug, Default)]
pub(super) struct Known(FxHashSet<u64>);

/// The requests of a case.
#[derive(Debug)]
pub(super) struct Script {
    pub(super) lines: Vec<u8>,
    pub(super) wants: Vec<Want>,
}

/// The line of the handshake.
pub(super) fn hello() -> String {
    line(0, Command::Hello(greeting()))
}

fn greeting() -> Hello {
    Hello { protocols: vec![PROTOCOL], spec: corpus::SPEC_VERSION.into(), corpus: corpus::VERSION.into() }
}

fn line(id: u64, command: Command) -> String {
    // Requests are maps of strings: writing one cannot fail.
    serde_json::to_string(&Request { id, r#do: command }).unwrap_or_default()
}

impl Script {
    /// Carries the case out on the core, and writes down what is asked, from this number on. After every step all that can
    /// be asked of the replicas that it may have changed is asked, and in the end of all.
    pub(super) fn of(case: &Case, id: u64) -> Self {
        let mut maker = Maker {
            core: Core::default(),
            script: Self { lines: Vec::new(), wants: Vec::new() },
            id: id + 1,
            step: 0,
            deltas: BTreeMap::new(),
            seen: BTreeMap::new(),
        };
        // The core shakes hands with whom it is made for.
        let _ = maker.core.hello(&greeting());
        maker.ask(
            Command::CaseBegin(CaseBegin {
                case: case.id.clone(),
                replicas: case.replicas.clone(),
                dictionary: case.dictionary.clone(),
            }),
            Vec::new(),
        );
        for (at, step) in case.steps.iter().enumerate() {
            maker.step = at + 1;
            maker.step(step);
            maker.look(case, step);
        }
        maker.script
    }
}

struct Maker<'c> {
    core: Core,
    script: Script,
    id: u64,
    step: usize,
    /// The core's name for each delta that the case names.
    deltas: BTreeMap<&'c str, String>,
    /// What replicas have been seen to be, which nothing has happened to since.
    seen: BTreeMap<&'c str, Vec<Arc<Ours>>>,
}

impl<'c> Maker<'c> {
    fn ask(&mut self, command: Command, expected: Vec<Expected>) -> Option<Answer> {
        let ours = Arc::new(Ours::of(answer(&mut self.core, &command)));
        let said = ours.answered.as_ref().ok().cloned();
        self.want(command, ours, expected);
        said
    }

    fn want(&mut self, command: Command, ours: Arc<Ours>, expected: Vec<Expected>) {
        let asked = line(self.id, command);
        self.script.lines.extend_from_slice(asked.as_bytes());
        self.script.lines.push(b'\n');
        self.script.wants.push(Want { step: self.step, asked, id: self.id, ours, expected });
        self.id += 1;
    }

    fn make(&mut self, command: Command, name: Option<&'c str>) {
        if let (Some(Answer::Delta(made)), Some(name)) = (self.ask(command, Vec::new()), name) {
            self.deltas.insert(name, made.delta);
        }
    }

    fn delta(&self, name: &str) -> String {
        self.deltas.get(name).cloned().unwrap_or_default()
    }

    fn step(&mut self, step: &'c Step) {
        let read = |replica: &String| Read { replica: replica.clone() };
        match step {
            Step::Mutate { replica, mutations, r#as } => {
                let mutate = Mutate { replica: replica.clone(), mutations: mutations.clone() };
                self.make(Command::Mutate(mutate), r#as.as_deref());
            }
            Step::Deliver { replica, delta } => {
                let deliver = Deliver { replica: replica.clone(), delta: self.delta(delta) };
                self.make(Command::Deliver(deliver), None);
            }
            Step::Restart { replica, keeps } => {
                self.make(Command::Restart(Restart { replica: replica.clone(), keeps: *keeps }), None);
            }
            Step::Answer { from, to, r#as } => {
                self.make(Command::Answer(AnswerFor { from: from.clone(), to: to.clone() }), Some(r#as));
            }
            Step::Group { deltas, r#as } => {
                let deltas = deltas.iter().map(|delta| self.delta(delta)).collect();
                self.make(Command::Group(Group { deltas }), Some(r#as));
            }
            Step::Load { state, r#as } => self.make(Command::Load(Load { state: state.clone() }), Some(r#as)),
            Step::Decode { bytes, r#as } => {
                self.make(Command::Decode(Decode { bytes: bytes.clone() }), Some(r#as));
            }
            Step::AnswerDigest { from, bytes, r#as } => {
                let answer = AnswerDigest { from: from.clone(), bytes: bytes.clone() };
                self.make(Command::AnswerDigest(answer), Some(r#as));
            }
            Step::Expect { replica, view } => {
                self.expect(Command::Read(read(replica)), Expected::View(view.clone()));
            }
            Step::ExpectEqual { replicas } => self.expect_equal(replicas),
            Step::ExpectRefused { replica, mutations, kind } => {
                let mutate = Mutate { replica: replica.clone(), mutations: mutations.clone() };
                self.expect(Command::Mutate(mutate), Expected::Refused(Some(kind.clone())));
            }
            Step::ExpectVertex { replica, name, vertex } => {
                let lookup = Lookup { replica: replica.clone(), name: name.clone() };
                self.expect(Command::Lookup(lookup), Expected::Vertex(vertex.clone()));
            }
            Step::ExpectState { replica, state } => {
                self.expect(Command::State(read(replica)), Expected::State(state.clone()));
            }
            Step::ExpectDelta { delta, state } => {
                let name = DeltaName { delta: self.delta(delta) };
                self.expect(Command::Delta(name), Expected::State(state.clone()));
            }
            Step::ExpectDigest { replica, digest } => {
                self.expect(Command::Digest(read(replica)), Expected::Digest(digest.clone()));
            }
            Step::ExpectBytes { of, bytes } => {
                let command = match of {
                    Encoded::Delta(delta) => Command::Encode(DeltaName { delta: self.delta(delta) }),
                    Encoded::Digest(replica) => Command::EncodeDigest(read(replica)),
                    Encoded::Fingerprint(replica) => Command::Fingerprint(read(replica)),
                };
                self.expect(command, Expected::Bytes(bytes.clone()));
            }
            Step::ExpectUnloadable { state, kind } => {
                self.expect(Command::Load(Load { state: state.clone() }), Expected::Refused(kind.clone()));
            }
            Step::ExpectUndecodable { bytes, kind } => {
                self.expect(
                    Command::Decode(Decode { bytes: bytes.clone() }),
                    Expected::Refused(kind.clone()),
                );
            }
            Step::ExpectUnanswerable { from, bytes } => {
                let answer = AnswerDigest { from: from.clone(), bytes: bytes.clone() };
                self.expect(Command::AnswerDigest(answer), Expected::Refused(None));
            }
        }
    }

    fn expect(&mut self, command: Command, expected: Expected) {
        self.ask(command, vec![expected]);
    }

    /// Each of them shows what the core says that the first one shows.
    fn expect_equal(&mut self, replicas: &[String]) {
        let mut first: Option<View> = None;
        for replica in replicas {
            let read = Read { replica: replica.clone() };
            let expected = first.clone().map(Expected::View).into_iter().collect();
            if let (None, Some(Answer::View(shown))) = (&first, self.ask(Command::Read(read), expected)) {
                first = Some(shown.view);
            }
        }
    }

    /// All that can be asked, as deep as the case goes: of each replica that may show something else since it was asked
    /// last, and at the end of every one, so that nobody changes unasked. What is answered is a function of a replica's
    /// state and of what vertices are called.
    fn look(&mut self, case: &'c Case, step: &Step) {
        match step {
            Step::Deliver { replica, .. } | Step::Restart { replica, .. } => {
                self.seen.remove(replica.as_str());
            }
            Step::Mutate { .. } | Step::ExpectRefused { .. } => self.seen.clear(),
            _ => {}
        }
        let is_last = self.step == case.steps.len();
        for replica in &case.replicas {
            if !is_last && self.seen.contains_key(replica.as_str()) {
                continue;
            }
            let read = || Read { replica: replica.clone() };
            let mut commands = vec![Command::Read(read())];
            if case.profile >= Profile::Causal {
                commands.extend([Command::State(read()), Command::Digest(read())]);
            }
            if case.profile >= Profile::Wire {
                commands.extend([Command::EncodeDigest(read()), Command::Fingerprint(read())]);
            }
            let core = &mut self.core;
            let look = || commands.iter().map(|command| Arc::new(Ours::of(answer(core, command)))).collect();
            let seen: Vec<Arc<Ours>> = self.seen.entry(replica.as_str()).or_insert_with(look).clone();
            for (command, ours) in commands.into_iter().zip(seen) {
                self.want(command, ours, Vec::new());
            }
        }
    }
}
