//! Histories against schedules: the reduction that L1 relies on, checked on what both layers reached.
//! `[spec: CHECK-7]`

use super::ScheduleBound;
use super::space::{ScheduleFault, Schedules};
use crate::histories::{Bound, Histories, MUTATIONS_MAX, REPLICAS_MAX};
use crate::search;
use crate::semantics::Semantics;
use crate::tables::{DeltaId, NONE, StateId};
use rustc_hash::FxHashSet;
use std::sync::Arc;

/// What was compared, and found to agree.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Reduction {
    /// Schedules reached by L2.
    pub schedules: usize,
    /// Histories reached by L1.
    pub histories: usize,
    /// Pools of deltas: the same in both.
    pub pools: usize,
    /// (pool, replica state) of L2, all of which L1 judges.
    pub states: usize,
    /// (pool, state of a delivered subset) of L1.
    pub subsets: usize,
    /// (pool, state of a reader) of L2: with a reader, the same as `subsets`.
    pub read: usize,
}

/// How the layers differ.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReductionFault {
    /// A schedule broke a clause.
    #[error("[{}] {}", .0.breach.clause, .0.breach.detail)]
    Schedule(ScheduleFault),
    /// A history broke a clause.
    #[error("a step of a history breaks a clause: {0}")]
    History(String),
    /// The pools differ.
    #[error("{only_schedules} pools are reached by schedules only, {only_histories} by histories only")]
    Pools {
        /// By schedules only.
        only_schedules: usize,
        /// By histories only.
        only_histories: usize,
    },
    /// A replica state of a schedule is no delivered subset.
    #[error("{count} replica states of schedules are no state of a delivered subset")]
    Beyond {
        /// How many.
        count: usize,
    },
    /// A reader never has the state of some delivered subset.
    #[error("{count} delivered subsets are never what a reader has")]
    Unread {
        /// How many.
        count: usize,
    },
}

type Pool = [[DeltaId; MUTATIONS_MAX]; REPLICAS_MAX];

/// Explores schedules without restarts and resynchronisation, and histories of the same bound. The pools
/// of deltas must be the same; each replica state of a schedule must be that of a delivered subset of its
/// pool; and where there is a reader, its states must be all of these. `[spec: CHECK-7]`
pub fn check_reduction<S: Semantics>(
    semantics: &Arc<S>,
    bound: ScheduleBound,
) -> Result<Reduction, ReductionFault> {
    let bound = ScheduleBound { restarts: 0, resynchronisations: 0, ..bound };
    let mut schedules = Schedules::new(semantics.clone(), bound);
    let reached = search::all(&mut schedules).map_err(ReductionFault::Schedule)?;
    let histories = all_histories(semantics, bound, &mut schedules)?;

    let schedule_pools: FxHashSet<Pool> = reached.iter().map(|schedule| schedule.deltas).collect();
    let history_pools: FxHashSet<Pool> = histories.iter().copied().collect();
    let (only_schedules, only_histories) = (
        schedule_pools.difference(&history_pools).count(),
        history_pools.difference(&schedule_pools).count(),
    );
    if only_schedules + only_histories > 0 {
        return Err(ReductionFault::Pools { only_schedules, only_histories });
    }
    let mut subsets = FxHashSet::default();
    let mut pools: Vec<&Pool> = history_pools.iter().collect();
    pools.sort_unstable();
    for pool in pools {
        subsets.extend(delivered_subsets(&mut schedules, pool).into_iter().map(|state| (*pool, state)));
    }
    let of = |range: std::ops::Range<usize>| -> FxHashSet<(Pool, StateId)> {
        reached.iter().flat_map(|at| range.clone().map(|replica| (at.deltas, at.states[replica]))).collect()
    };
    let (states, read) = (of(0..bound.everybody()), of(bound.replicas..bound.everybody()));
    let beyond = states.difference(&subsets).count();
    if beyond > 0 {
        return Err(ReductionFault::Beyond { count: beyond });
    }
    let unread = subsets.difference(&read).count();
    if bound.readers > 0 && unread > 0 {
        return Err(ReductionFault::Unread { count: unread });
    }
    Ok(Reduction {
        schedules: reached.len(),
        histories: histories.len(),
        pools: history_pools.len(),
        states: states.len(),
        subsets: subsets.len(),
        read: read.len(),
    })
}

/// The pool of every history of L1, in the numbers of L2.
fn all_histories<S: Semantics>(
    semantics: &Arc<S>,
    bound: ScheduleBound,
    schedules: &mut Schedules<S>,
) -> Result<Vec<Pool>, ReductionFault> {
    let bound = Bound { replicas: bound.replicas, mutations: bound.mutations };
    let mut space = Histories::new(semantics.clone(), bound, false);
    let all = search::all(&mut space);
    let all = all.map_err(|fault| ReductionFault::History(fault.breach().clause.into()))?;
    let mut translate = |delta: DeltaId| {
        if delta == NONE {
            return NONE;
        }
        schedules.tables.intern_delta((*space.tables().delta(delta)).clone(), 0)
    };
    Ok(all.iter().map(|history| history.deltas.map(|of_one| of_one.map(&mut translate))).collect())
}

/// The states of all subsets of a pool.
fn delivered_subsets<S: Semantics>(schedules: &mut Schedules<S>, pool: &Pool) -> FxHashSet<StateId> {
    let mut states = FxHashSet::from_iter([schedules.initial()]);
    for &delta in pool.iter().flatten().filter(|&&delta| delta != NONE) {
        let mut before: Vec<StateId> = states.iter().copied().collect();
        before.sort_unstable();
        states.extend(
            before.into_iter().map(|state| schedules.tables.join(&schedules.semantics, state, delta)),
        );
    }
    states
}
