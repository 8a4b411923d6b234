//! What occurred, and what had to: a comparison in which something never occurs shows nothing of it. `[spec: ORACLE-5]`

use super::world::{Event, History, Outcome};
use crate::fact::Question;
use dsr_core::{Dictionary, Record, Repair, Rule, State, ValueType, decode, view};
use std::collections::BTreeMap;

/// What must occur: every refusal that can (all of the chapter on mutations but `ValueSize`, which takes 64 MiB, and what
/// comes after another condition that is then broken), every repair, and every odd thing that a network or a stranger can do.
pub const EXPECTED: [&[&str]; 4] = [&REFUSALS, &REPAIRS, &VALUES, &ODDITIES];

const REFUSALS: [&str; 66] = [
    "refused: add_vertex Attribute.NameLength",
    "refused: add_vertex Attribute.TooMany",
    "refused: add_vertex Attribute.Undeclared",
    "refused: add_vertex Attribute.WrongType",
    "refused: add_vertex Exhausted.Sequences",
    "refused: add_vertex Exhausted.Stamps",
    "refused: add_vertex Link.FunctionalTaken",
    "refused: add_vertex Link.IntoRoot",
    "refused: add_vertex Link.LabelLength",
    "refused: add_vertex Link.NewVertexAsParent",
    "refused: add_vertex Link.ParentOutsideTree",
    "refused: add_vertex Link.UndeclaredLabel",
    "refused: add_vertex Link.UnknownVertex",
    "refused: add_vertex NameLength",
    "refused: add_vertex NameTaken",
    "refused: add_vertex ReservedName",
    "refused: add_vertex UndeclaredType",
    "refused: add_edge Attribute.NameLength",
    "refused: add_edge Attribute.TooMany",
    "refused: add_edge Attribute.Undeclared",
    "refused: add_edge Attribute.WrongType",
    "refused: add_edge Cycle",
    "refused: add_edge Exhausted.Sequences",
    "refused: add_edge Exhausted.Stamps",
    "refused: add_edge FunctionalTaken",
    "refused: add_edge HasParent",
    "refused: add_edge IntoRoot",
    "refused: add_edge KeyPresent",
    "refused: add_edge LabelLength",
    "refused: add_edge ParentOutsideTree",
    "refused: add_edge SelfLoop",
    "refused: add_edge UndeclaredLabel",
    "refused: add_edge UnknownVertex",
    "refused: update_attributes Empty",
    "refused: update_attributes Exhausted.Sequences",
    "refused: update_attributes Exhausted.Stamps",
    "refused: update_attributes NameLength",
    "refused: update_attributes NotSet",
    "refused: update_attributes TooMany",
    "refused: update_attributes Undeclared",
    "refused: update_attributes UnknownTarget",
    "refused: update_attributes WrongType",
    "refused: remove_edge Strands",
    "refused: remove_edge UnknownEdge",
    "refused: move_edge Attribute.NameLength",
    "refused: move_edge Attribute.TooMany",
    "refused: move_edge Attribute.Undeclared",
    "refused: move_edge Attribute.WrongType",
    "refused: move_edge Edge.Cycle",
    "refused: move_edge Edge.FunctionalTaken",
    "refused: move_edge Edge.HasParent",
    "refused: move_edge Edge.IntoRoot",
    "refused: move_edge Edge.KeyPresent",
    "refused: move_edge Edge.LabelLength",
    "refused: move_edge Edge.ParentOutsideTree",
    "refused: move_edge Edge.SelfLoop",
    "refused: move_edge Edge.UndeclaredLabel",
    "refused: move_edge Edge.UnknownVertex",
    "refused: move_edge Exhausted.Sequences",
    "refused: move_edge Exhausted.Stamps",
    "refused: move_edge SameKey",
    "refused: move_edge Strands",
    "refused: move_edge UnknownEdge",
    "refused: remove_vertex Root",
    "refused: remove_vertex Strands",
    "refused: remove_vertex UnknownVertex",
];

const REPAIRS: [&str; 8] = [
    "repair: same-key",
    "repair: functional",
    "repair: rt-parent",
    "repair: cycle-broken",
    "repair: detached",
    "repair: reattached",
    "repair: name-clash",
    "repair: undeclared",
];

const VALUES: [&str; 14] = [
    "value: string",
    "value: int",
    "value: float",
    "value: float_vec",
    "value: bool",
    "value: byte_vec",
    "value: uint",
    "value: uint64",
    "value: double",
    "value: u64_vec",
    "value: vec2",
    "value: vec3",
    "value: vec4",
    "value: vec6",
];

const ODDITIES: [&str; 17] = [
    "a mutation that is made",
    "a group of mutations",
    "deltas as one message",
    "a whole state taken over",
    "an answer to a digest",
    "a restart",
    "a state from outside",
    "bytes that are no state",
    "bytes that are a state",
    "a wrong anchor after a join",
    "a dot used twice",
    "a gap in a context",
    "a pending record",
    "two live writes of one attribute",
    "equal stamps that compete",
    "the name of the root, from outside",
    "replicas under different dictionaries",
];

/// How often each thing occurred.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Counts {
    /// Histories.
    pub histories: u64,
    /// Events of them.
    pub events: u64,
    /// By name; what had to occur and did not is not there.
    pub seen: BTreeMap<String, u64>,
}

impl Counts {
    /// What had to occur and never did.
    pub fn never(&self) -> Vec<&'static str> {
        EXPECTED.into_iter().flatten().copied().filter(|name| !self.seen.contains_key(*name)).collect()
    }

    /// Adds what others have seen.
    pub fn add(&mut self, other: &Self) {
        self.histories += other.histories;
        self.events += other.events;
        for (name, count) in &other.seen {
            *self.seen.entry(name.clone()).or_default() += count;
        }
    }

    fn see(&mut self, name: &str) {
        if let Some(count) = self.seen.get_mut(name) {
            *count += 1;
        } else {
            self.seen.insert(name.into(), 1);
        }
    }

    fn see_if(&mut self, is_so: bool, name: &str) {
        if is_so {
            self.see(name);
        }
    }

    pub(super) fn begin(&mut self, history: &History) {
        self.histories += 1;
        let mut dictionaries = history.replicas.iter().map(|(_, dictionary)| dictionary);
        let first = dictionaries.next();
        self.see_if(dictionaries.any(|other| Some(other) != first), "replicas under different dictionaries");
    }

    pub(super) fn event(&mut self, event: &Event, outcome: &Outcome) {
        self.events += 1;
        match outcome {
            Outcome::Refused(kind) => self.see(&format!("refused: {kind}")),
            Outcome::NotTaken => self.see("a wrong anchor after a join"),
            Outcome::Nothing => {}
            Outcome::Done => match event {
                Event::Mutate { mutations, .. } if mutations.len() > 1 => self.see("a group of mutations"),
                Event::Mutate { .. } => self.see("a mutation that is made"),
                Event::Group { .. } => self.see("deltas as one message"),
                Event::Join { .. } => self.see("a whole state taken over"),
                Event::Answer { .. } => self.see("an answer to a digest"),
                Event::Restart { .. } => self.see("a restart"),
                Event::Outside { .. } => self.see("a state from outside"),
                Event::Bytes { bytes } => {
                    let is_state = decode(bytes).is_ok();
                    self.see(if is_state { "bytes that are a state" } else { "bytes that are no state" });
                }
                Event::Deliver { .. } | Event::Tell { .. } => {}
            },
        }
    }

    pub(super) fn question(&mut self, question: &Question, dictionary: &Dictionary) {
        match question {
            Question::Join(states) => {
                let reused = states.windows(2).any(|pair| pair[0].reused_dot(&pair[1]).is_some());
                self.see_if(reused, "a dot used twice");
            }
            Question::View(state) => self.view(state, dictionary),
            _ => {}
        }
    }

    fn view(&mut self, state: &State, dictionary: &Dictionary) {
        let view = view(state, dictionary);
        for repair in view.repairs() {
            self.see(&format!("repair: {}", repair.kind()));
            match repair {
                Repair::Superseded { hidden, shown, rule } => {
                    let stamp = |dot| state.rank(dot).map(|(stamp, _)| stamp);
                    let equal = *rule != Rule::Functional && stamp(hidden.0) == stamp(shown.0);
                    self.see_if(equal, "equal stamps that compete");
                }
                Repair::NameClash { shown, .. } => {
                    self.see_if(shown.is_root(), "the name of the root, from outside");
                }
                _ => {}
            }
        }
        for (_, record) in state.records() {
            if let Record::Write(write) = record {
                self.see(value_name(write.value.value_type()));
            }
        }
        self.see_if(state.context().cloud_runs().next().is_some(), "a gap in a context");
        let waits =
            |record: &Record| record.anchors().any(|dot| dot.sequence != 0 && !state.context().contains(dot));
        self.see_if(state.records().any(|(_, record)| waits(record)), "a pending record");
        let is_register = |pair: &[(dsr_core::Dot, &dsr_core::Write)]| {
            (pair[0].1.target, &pair[0].1.name) == (pair[1].1.target, &pair[1].1.name)
        };
        self.see_if(view.writes().windows(2).any(is_register), "two live writes of one attribute");
    }
}

fn value_name(value_type: ValueType) -> &'static str {
    VALUES[usize::from(value_type.number()).min(VALUES.len() - 1)]
}
