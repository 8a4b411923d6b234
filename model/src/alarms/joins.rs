//! Flaws of merge and closure.

use super::broken::{Flaw, Sound};
use super::parts::{Parts, compete, dictionary, is_below, with_stamp};
use dsr_core::{Author, CausalContext, Delta, Dot, ElementId, Mutation, Record, Repair, State, View, view};

/// The dots of a removal are not remembered unless the record was there.
#[derive(Debug)]
pub(super) struct ForgottenContext;

impl Flaw for ForgottenContext {
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = Parts::of(&Sound.merge(left, right));
        merged.context = left.context().clone();
        merged.context.extend(right.records().map(|(dot, _)| dot));
        merged.build()
    }
}

/// A record is taken in though its dot is dead here.
#[derive(Debug)]
pub(super) struct Resurrection;

impl Flaw for Resurrection {
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = Parts::of(&Sound.merge(left, right));
        let dead = right.records().filter(|(dot, _)| left.is_dead(*dot));
        merged.records.extend(dead.map(|(dot, record)| (dot, record.clone())));
        merged.build()
    }
}

/// Contexts are version vectors: a gap counts as seen.
#[derive(Debug)]
pub(super) struct GapsTakenAsSeen;

impl Flaw for GapsTakenAsSeen {
    fn merge(&self, left: &State, right: &State) -> State {
        let filled = |state: &State| {
            let mut parts = Parts::of(state);
            let runs: Vec<_> = parts.context.runs().collect();
            for run in runs {
                parts.context.insert_prefix(run.replica, run.last);
            }
            parts.build()
        };
        // What arrives is taken as it is; only the own context has lost its gaps.
        filled(&Sound.merge(&filled(left), right))
    }
}

/// Nothing dies with its anchor.
#[derive(Debug)]
pub(super) struct NoClosure;

impl Flaw for NoClosure {
    fn close(&self, state: State) -> State {
        state
    }
}

/// Closure makes one pass only.
#[derive(Debug)]
pub(super) struct ShallowClosure;

impl Flaw for ShallowClosure {
    fn close(&self, state: State) -> State {
        let mut parts = Parts::of(&state);
        parts.records.retain(|_, record| !record.anchors().any(|anchor| state.is_dead(anchor)));
        parts.build()
    }
}

/// Each merge counts: a record that both sides hold gets a greater stamp.
#[derive(Debug)]
pub(super) struct Counting;

impl Flaw for Counting {
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = Parts::of(&Sound.merge(left, right));
        for (dot, record) in &mut merged.records {
            if left.holds(*dot) && right.holds(*dot) {
                *record = with_stamp(record.clone(), record.stamp() + 1);
            }
        }
        merged.build()
    }
}

/// The write that is delivered last replaces every other of its register.
#[derive(Debug)]
pub(super) struct LastDelivered;

impl Flaw for LastDelivered {
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = Parts::of(&Sound.merge(left, right));
        let fresh: Vec<(Dot, &Record)> =
            right.records().filter(|(dot, _)| !left.context().contains(*dot)).collect();
        merged.records.retain(|dot, record| {
            let replaced = |(new, by): &(Dot, &Record)| {
                new != dot && matches!(record, Record::Write(_)) && compete(record, by)
            };
            !left.holds(*dot) || !fresh.iter().any(replaced)
        });
        merged.build()
    }
}

/// Of two concurrent claims with one stamp, the one that arrives first stays.
#[derive(Debug)]
pub(super) struct FirstArrival;

impl Flaw for FirstArrival {
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = Parts::of(&Sound.merge(left, right));
        merged.records.retain(|dot, record| {
            let ties = |(_, held): (Dot, &Record)| held.stamp() == record.stamp() && compete(held, record);
            left.holds(*dot) || !left.records().any(ties)
        });
        merged.build()
    }
}

/// A kinematic edge that would close a cycle with those that are here already is not taken in.
#[derive(Debug)]
pub(super) struct LocalCycleOrder;

impl Flaw for LocalCycleOrder {
    fn merge(&self, left: &State, right: &State) -> State {
        let here = Parts::of(left).records;
        let mut merged = Parts::of(&Sound.merge(left, right));
        merged.records.retain(|dot, record| match record {
            Record::Edge(edge) if edge.is_rt() && !left.holds(*dot) => !is_below(&here, edge.from, edge.to),
            _ => true,
        });
        merged.build()
    }
}

/// An update carries its vertex along, and a write that arrives brings back the vertex that it is on.
#[derive(Debug)]
pub(super) struct RevivingUpdate;

impl Flaw for RevivingUpdate {
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = Parts::of(&Sound.merge(left, right));
        for (dot, record) in right.records() {
            if let Record::Write(write) = record
                && !left.context().contains(dot)
                && left.is_dead(write.target)
                && let Some(target) = right.get(write.target)
            {
                merged.records.insert(write.target, target.clone());
            }
        }
        merged.build()
    }

    fn delta(&self, before: &View<'_>, author: Author, mutation: &Mutation) -> Option<Delta> {
        let delta = Sound.delta(before, author, mutation)?;
        let Mutation::UpdateAttributes { target: ElementId::Vertex(vertex), .. } = mutation else {
            return Some(delta);
        };
        let Some(record) = before.state().get(vertex.0) else { return Some(delta) };
        let mut parts = Parts::of(&delta);
        parts.records.insert(vertex.0, record.clone());
        parts.context.insert(vertex.0);
        Some(parts.build())
    }
}

/// What arrives before its anchors is thrown away.
#[derive(Debug)]
pub(super) struct DroppedPending;

impl Flaw for DroppedPending {
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = Parts::of(&Sound.merge(left, right));
        let context: CausalContext = merged.context.clone();
        merged.records.retain(|_, record| {
            record.anchors().all(|anchor| anchor.sequence == 0 || context.contains(anchor))
        });
        merged.build()
    }
}

/// The loser of a conflict is thrown away wherever the conflict is seen.
#[derive(Debug)]
pub(super) struct DroppedLosers;

impl Flaw for DroppedLosers {
    fn merge(&self, left: &State, right: &State) -> State {
        let state = Sound.merge(left, right);
        let mut merged = Parts::of(&state);
        for repair in view(&state, &dictionary()).repairs() {
            if let Repair::Superseded { hidden, .. } = repair {
                merged.records.remove(&hidden.0);
            }
        }
        merged.build()
    }
}
