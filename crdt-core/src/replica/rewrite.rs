//! The commonest delta, by a way of its own: one write in place of the only one of its register.
//!
//! Streams of poses and of measurements are made of these. Its register, the stamps and the dots are all that it
//! touches, so nothing else is looked at; what comes of it is what [`plan`](super::plan) and
//! [`settle`](super::settle) would make of it.

use super::graph::Graph;
use super::held::{Exposure, Held, NONE, WriteAt, WriteKey};
use crate::changes::{Change, Changes};
use crate::context::{CausalContext, Run};
use crate::dot::Dot;
use crate::record::Record;
use crate::state::Delta;
use alloc::sync::Arc;

impl Graph {
    /// Joins a well-formed delta if it is a rewrite; `None` if it is another, or its register has to be looked at
    /// more closely: nothing has changed then. O(log n). `[spec: JOIN-3]` `[spec: EVENT-1]`
    pub(super) fn rewrite(&mut self, delta: &Delta) -> Option<Changes> {
        let mut records = delta.records();
        let (Some((dot, Record::Write(write))), None) = (records.next(), records.next()) else { return None };
        let old = the_other(delta.context(), dot)?;
        let is_declared = self.dictionary.allows_attribute(&write.name, write.value.value_type());
        if self.context.contains(dot) || !self.loose.is_empty() || !is_declared {
            return None;
        }
        let (target, name) = (write.target, self.names.find(&write.name)?);
        let is_of_register = |key: &WriteKey| (key.0, key.1) == (target, name);
        let (key, held) = self.writes.only_of(&(target, name, NONE), is_of_register)?;
        if key.2 != old || held.exposure != Exposure::Shown {
            return None;
        }
        // Where a write is shown, its target is in the graph; and this delta does not remove it.
        key.2 = dot;
        held.value.clone_from(&write.value);
        held.timestamp_ns = write.timestamp_ns;
        let stamp = core::mem::replace(&mut held.stamp, write.stamp);
        self.records.remove(&old);
        self.records.insert(dot, Held::Write(WriteAt { target, name }));
        self.count_stamp(write.stamp);
        self.discount_stamp(stamp);
        Arc::make_mut(&mut self.context).insert(dot);
        // The name that is held, not one of its own that the delta has brought.
        let name = self.names.name(name);
        Some(Changes::one(Change::Attribute { target, name, before: Some(old), after: Some(dot) }))
    }
}

/// The dot beside `dot` in a context of these two.
fn the_other(context: &CausalContext, dot: Dot) -> Option<Dot> {
    let prefixes = context.vector().map(|(replica, last)| Run { replica, first: 1, last });
    let mut other = None;
    for run in prefixes.chain(context.cloud_runs()) {
        if run.last - run.first > 1 {
            return None;
        }
        for seen in run.dots().filter(|&seen| seen != dot) {
            if other.replace(seen).is_some() {
                return None;
            }
        }
    }
    other
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dictionary::Dictionary;
    use crate::dot::{EdgeId, ReplicaId, VertexId};
    use crate::mutation::{ElementId, Mutation, NewVertex, VertexLink};
    use crate::record::Write;
    use crate::replica::Replica;
    use crate::state::State;
    use crate::value::{Value, ValueType};
    use alloc::vec::Vec;

    const AUTHORS: [ReplicaId; 2] = [ReplicaId::agent(1), ReplicaId::agent(2)];
    const TARGET: Dot = Dot::new(AUTHORS[0], 1);

    /// A write of an attribute that the dictionary wants to be an int, in a delta that kills some dots.
    fn write(dot: Dot, value: &Value, stamp: u64, killed: &[Dot]) -> Delta {
        let write =
            Write { target: TARGET, name: "level".into(), value: value.clone(), timestamp_ns: 7, stamp };
        let context = killed.iter().copied().chain([dot]).collect();
        State::assemble([(dot, Record::Write(write))], context)
    }

    /// Graphs with no, one and two writes of a register, declared or not, whose target is there, or waited for.
    fn graphs() -> Vec<Replica> {
        let mut dictionary = Dictionary::open();
        dictionary.attributes.insert("level".into(), ValueType::Int);
        let mut empty = Replica::new(AUTHORS[0], dictionary);
        let mut graphs = Vec::from([empty.clone()]);
        let link = VertexLink::child_of(VertexId::ROOT);
        empty.mutate(&Mutation::AddVertex { vertex: NewVertex::new("thing", "lamp"), link }, 0).unwrap();
        graphs.push(empty);
        let values = [Value::Int(1), Value::from("dim")];
        for (author, sequence, stamp) in [(AUTHORS[0], 3, 2), (AUTHORS[1], 1, 3)] {
            for mut graph in graphs.clone() {
                for value in &values {
                    let mut more = graph.clone();
                    more.apply(&write(Dot::new(author, sequence), value, stamp, &[]));
                    graphs.push(more);
                }
                graph.apply(&write(Dot::new(author, 9), &values[0], 2, &[]));
                graphs.push(graph);
            }
        }
        graphs
    }

    /// Every small delta of one write, in every such graph. `[spec: REPLICA-1]` `[spec: EVENT-1]`
    #[test]
    fn oracle_a_rewrite_is_what_merge_closure_and_settling_make() {
        let held = [Dot::new(AUTHORS[0], 3), Dot::new(AUTHORS[1], 1), Dot::new(AUTHORS[0], 9)];
        let fresh = [Dot::new(AUTHORS[0], 4), Dot::new(AUTHORS[1], 2), held[0]];
        let kills = [&[][..], &held[..1], &held[1..2], &held[2..], &held[..2], &[TARGET]];
        let (mut taken, mut left) = (0, 0);
        for graph in graphs() {
            for dot in fresh {
                for value in [Value::Int(5), Value::from("bright")] {
                    for (stamp, killed) in
                        [0, 2, 9].into_iter().flat_map(|stamp| kills.map(|kill| (stamp, kill)))
                    {
                        let delta = write(dot, &value, stamp, killed);
                        if crate::wellformed::check_well_formed(&delta).is_err() {
                            continue;
                        }
                        let mut slow = graph.clone();
                        let plan = slow.graph.plan(&delta);
                        let changes = slow.graph.commit(plan.removed, plan.added, false).changes;
                        slow.see(&delta);
                        let (mut fast, before) = (graph.clone(), graph.encode());
                        if let Some(told) = fast.graph.rewrite(&delta) {
                            taken += 1;
                            assert_eq!((told, fast.encode()), (changes, slow.encode()));
                        } else {
                            left += 1;
                            assert_eq!(fast.encode(), before);
                        }
                        fast.graph.check_indexes();
                    }
                }
            }
        }
        assert!(taken > 10 && left > taken, "{taken} of {}", taken + left);
    }

    /// The commonest mutations take this way. `[spec: REPLICA-1]`
    #[test]
    fn law_a_second_value_is_a_rewrite_here_and_elsewhere() {
        let mut here = graphs().swap_remove(1);
        let mut there = here.clone();
        let edge = here.edges().next().unwrap().0;
        for target in [ElementId::Vertex(VertexId(TARGET)), ElementId::Edge(EdgeId(edge.0))] {
            for (round, value) in [1, 2, 3].into_iter().enumerate() {
                let updates = [("level".into(), Some(Value::Int(value)))].into();
                let made = here.mutate(&Mutation::UpdateAttributes { target, updates }, 0).unwrap();
                assert_eq!(there.clone().graph.rewrite(&made.delta).is_some(), round > 0);
                assert_eq!(there.apply(&made.delta), made.changes);
            }
        }
        assert_eq!(here.encode(), there.encode());
    }
}
