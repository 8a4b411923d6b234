//! Judgement: ends, and every delivered subset of a maximal history with every diamond in it.
//! `[spec: SCEN-11]`

use super::explore::Replicated;
use super::memo::{DeltaId, StateId};
use super::space::{Broken, Node, SUBSET_DELTAS_MAX, Space, subset};
use crate::semantics::Breach;

impl<S: Replicated> Space<S> {
    /// Asks the properties of ends, if the history has ended; whether it has.
    pub(super) fn judge_end(&mut self, node: &Node) -> Result<bool, Broken> {
        let Some((state, done)) = self.end(node)? else { return Ok(false) };
        let answers = self.memo.answers(state);
        let scenario = self.memo.scenario.clone();
        for (property, decided) in scenario.properties.iter().zip(&mut self.decided) {
            if property.kind.is_of_ends() && property.is_decided_by(property.predicate.holds(answers, done)) {
                *decided = true;
            }
        }
        Ok(true)
    }

    /// Judges every subset of the deltas of a maximal history, unless there are too many.
    pub(super) fn judge_subsets(&mut self, node: &Node) -> Result<(), Broken> {
        if node.pool.len() > SUBSET_DELTAS_MAX {
            self.large.insert(node.pool.clone());
        } else if !self.judged.contains(&node.pool) {
            self.states_of(&node.pool)?;
            self.judged.insert(node.pool.clone());
        }
        Ok(())
    }

    /// The state of every subset, by its bits, the same by every last delivery. If all agree, on all subsets,
    /// then every order of delivery agrees: each order is a path through the subsets. `[spec: JOIN-3]`
    pub(super) fn states_of(&mut self, pool: &[DeltaId]) -> Result<Vec<StateId>, Broken> {
        let mut states = vec![self.initial];
        for mask in 1..1_usize << pool.len() {
            let mut known: Option<StateId> = None;
            for (at, &delta) in pool.iter().enumerate().filter(|(at, _)| mask >> at & 1 == 1) {
                let rest = mask ^ 1 << at;
                let state = self.memo.join(states[rest], delta);
                let broken = |breach| {
                    let received = subset(pool, rest).into_iter().chain([delta]).collect();
                    Err(Broken { breach, replica: None, received })
                };
                if let Some((breach, _)) = &self.memo.fault {
                    return broken(breach.clone());
                }
                if *known.get_or_insert(state) != state {
                    return broken(Breach::new(
                        "JOIN-3",
                        "the same deltas in another order lead to another state",
                    ));
                }
                // One delta of each set is delivered twice, another one for the next set.
                let is_repeated = at == mask % pool.len() || mask.is_power_of_two();
                if is_repeated && self.memo.join(state, delta) != state {
                    return broken(Breach::new("JOIN-3", "a delta delivered twice is not the same as once"));
                }
            }
            states.push(known.unwrap_or(self.initial));
        }
        Ok(states)
    }
}
