//! The clauses that the published semantics can be held to. `[spec: CHECK-12]`

use super::hidden::hidden;
use super::{Compared, Held, Published};
use crate::published::local::{LEVEL, PARENT, RT};
use crate::published::property::{Property, only};
use crate::published::{Operation, Replica, Value};
use crate::semantics::{Breach, Clause, Step};

/// What is judged: of one state, of a call, of a delivery. That replicas end equal, L2 judges (`JOIN-5`).
pub const CLAUSES: [Clause; 8] = [
    clause("JOIN-3", "L3", "the same deltas in any order lead to the same state"),
    clause("MUT-0", "L2", "whoever receives a delta comes to the state of its author"),
    clause("VIEW-1", "V1", "what replicas have can be read: nobody crashes"),
    clause("INV-2", "V1", "no edge and no `parent` leads to a deleted node"),
    clause(
        "INV-3",
        "V1",
        "a node has one kinematic parent, `parent` and `level` say so, and there is no circle",
    ),
    clause("VIEW-7", "V1", "a node is found by its name"),
    clause("STATE-3", "R1", "what is removed stays removed"),
    clause("INTENT-1", "V3", "a call shows its effect to its author"),
];

const fn clause(id: &'static str, claim: &'static str, what: &'static str) -> Clause {
    Clause { id, claim, what }
}

impl Published {
    /// Of one state.
    pub(super) fn judge_state(&self, state: &Held) -> Result<(), Breach> {
        let replica = &state.replica;
        if let Some(crash) = replica.crash {
            let judged = self.is_judged(Property::Unreadable.clause());
            // Of a replica that no longer runs nothing else can be asked.
            return if judged { Err(Breach::new(Property::Unreadable.clause(), crash)) } else { Ok(()) };
        }
        let nodes = || replica.nodes.keys().copied();
        let always =
            [Property::Unreadable, Property::Dangling(None), Property::ParentLoop, Property::NameIndex];
        let each = nodes().flat_map(|node| {
            [
                Property::Orphan(node),
                Property::SeveralParents(node),
                Property::ParentMismatch(node),
                Property::LevelMismatch(node),
            ]
        });
        let judged = always.into_iter().chain(each).filter(|property| self.is_judged(property.clause()));
        let mut judged = judged.map(|property| property.judge(&[replica]));
        judged.find(Result::is_err).unwrap_or(Ok(()))
    }

    /// Of a call.
    pub(super) fn judge_call(
        &self,
        before: &Held,
        operation: &Operation,
        step: &Step<Self>,
    ) -> Result<(), Breach> {
        let after = &step.after;
        if after.replica.crash.is_some() {
            return self.judge_state(after);
        }
        if self.is_judged("INTENT-1") && !shows_effect(&after.replica, operation) {
            return Err(Breach::new("INTENT-1", format!("its author does not show it: {operation}")));
        }
        let received = before.of_nobody().received(&step.delta);
        match self.difference(&after.of_nobody(), &received).filter(|_| self.is_judged("MUT-0")) {
            Some(what) => Err(Breach::new(
                "MUT-0",
                format!(
                    "the author (first) and whoever receives the delta in the same state (second) differ: {what}"
                ),
            )),
            None => Ok(()),
        }
    }

    /// Of a delivery.
    pub(super) fn judge_received(&self, before: &Held, after: &Held) -> Result<(), Breach> {
        if !self.is_judged("STATE-3") {
            return Ok(());
        }
        let revived = before.replica.deleted.iter().map(|&node| Property::Revived(node));
        let mut judged = revived.map(|property| property.judge(&[&before.replica, &after.replica]));
        judged.find(Result::is_err).unwrap_or(Ok(()))
    }

    /// How two states differ that ought to be equal.
    pub(super) fn difference(&self, left: &Held, right: &Held) -> Option<String> {
        let (mine, theirs) = (left.facts(), right.facts());
        if mine != theirs {
            let (mine, theirs) = only(&mine, &theirs);
            return Some(format!("only the first shows {mine}; only the second shows {theirs}"));
        }
        if self.compared == Compared::Shown || left.of_nobody() == right.of_nobody() {
            return None;
        }
        let (mine, theirs) = only(&hidden(left), &hidden(right));
        Some(format!(
            "both show the same, and differ in what is hidden: the first has {mine}; the second has {theirs}"
        ))
    }
}

/// Whether an author sees what it has done.
fn shows_effect(after: &Replica, operation: &Operation) -> bool {
    let number = |node, key, value| after.attribute(node, key).is_some_and(|held| held.value == value);
    match *operation {
        Operation::InsertNode { id, .. } => after.node(id).is_some(),
        Operation::Set { node, key, value } => number(node, key, Value::Number(value)),
        Operation::Remove { node, key } => after.attribute(node, key).is_none(),
        Operation::DeleteNode { node } => !after.nodes.contains_key(&node),
        Operation::AssignEdge { from, to, kind, attributes } => {
            let edge = after.edge((from, to, kind));
            edge.is_some_and(|edge| {
                attributes.iter().all(|(key, value)| {
                    let held = edge.attributes.get(key).and_then(|register| register.value());
                    held.is_some_and(|held| held.value == Value::Number(*value))
                })
            })
        }
        Operation::DeleteEdge { from, to, kind } => after.edge((from, to, kind)).is_none(),
        Operation::Place { from, to, .. } => {
            let level = match after.attribute(from, LEVEL).map(|held| held.value) {
                Some(Value::Number(level)) => Value::Number(level + 1),
                _ => return false,
            };
            after.edge((from, to, RT)).is_some()
                && number(to, PARENT, Value::Node(from))
                && number(to, LEVEL, level)
        }
        Operation::Get { .. } | Operation::PutBack { .. } => true,
    }
}
