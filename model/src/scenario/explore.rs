//! One exploration from start to report. `[spec: SCEN-12]`

use super::Scenario;
use super::memo::Memo;
use super::model::{Inner, ScenarioModel};
use super::property::PropertyKind;
use super::report::{Coverage, IdleStep, PropertyReport, Report, ScenarioBreach, Verdict};
use super::script::Replica;
use super::shortest::Shortest;
use super::space::Space;
use super::trace::Trace;
use crate::checked::Act;
use crate::semantics::Semantics;
use dsr_core::{Delta, State};
use stateright::{Checker, Model};
use std::sync::Arc;
use std::time::Instant;

/// A semantics of DSR graphs: that of the core, or a broken copy of it.
pub trait Replicated:
    Semantics<State = State, Delta = Delta, Mutation = Act> + std::fmt::Debug + 'static
{
}

impl<S: Semantics<State = State, Delta = Delta, Mutation = Act> + std::fmt::Debug + 'static> Replicated
    for S
{
}

/// How far an exploration may go, and how.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Options {
    /// The most different replica states; each takes some kilobytes on a flat.
    pub states_max: usize,
    /// The most histories.
    pub histories_max: u64,
    /// Whether counterexamples and witnesses are searched for.
    pub traces: bool,
    /// Whether every set of deliveries is followed, not only the least ones: the same verdicts, slower.
    /// `[spec: SCEN-10]`
    pub every_delivery: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { states_max: 100_000, histories_max: 1_000_000, traces: true, every_delivery: false }
    }
}

pub(super) fn explore<S: Replicated>(scenario: &Arc<Scenario>, semantics: S, options: Options) -> Report {
    let start = Instant::now();
    let space = Space::new(Memo::new(scenario.clone(), semantics), options);
    let checker = ScenarioModel::new(space).checker().threads(1).spawn_dfs().join();
    let unique = checker.unique_state_count() as u64;
    let mut inner = checker.model().inner();
    let mut report = summary(scenario, &inner, unique);
    if options.traces {
        add_traces(&mut inner, &mut report);
    }
    report.seconds = start.elapsed().as_secs_f64();
    report
}

/// The report without traces.
fn summary<S: Replicated>(scenario: &Scenario, inner: &Inner<S>, unique: u64) -> Report {
    let (space, counts) = (&inner.space, inner.counts);
    // stateright's count must be ours: no history may be left unexpanded in silence.
    let complete = inner.broken.is_none() && !space.is_bounded && counts.expanded == unique;
    let coverage = match space.large.len() {
        0 => Coverage::EverySubset,
        histories => Coverage::ReachedOnly { histories },
    };
    let properties = scenario.properties.iter().enumerate().map(|(at, property)| {
        let decided = space.decided[at] || space.memo.decided[at];
        PropertyReport {
            name: property.name.clone(),
            why: property.why.clone(),
            kind: property.kind,
            verdict: verdict(property.kind, decided, complete),
            trace: None,
        }
    });
    Report {
        name: scenario.name.clone(),
        replicas: scenario.replicas().map(str::to_owned).collect(),
        mutations: scenario.replicas.iter().map(Replica::mutations_max).sum(),
        histories: unique,
        generated: counts.generated,
        ends: counts.ends,
        states: space.memo.states() as u64,
        deliveries: space.memo.joins() as u64,
        seconds: 0.0,
        complete,
        coverage,
        repairs: space.memo.repairs.iter().copied().collect(),
        idle: idle(scenario, &space.memo.taken),
        breach: inner.broken.as_ref().map(|broken| ScenarioBreach {
            clause: broken.breach.clause,
            detail: broken.breach.detail.clone(),
            trace: None,
        }),
        properties: properties.collect(),
    }
}

fn verdict(kind: PropertyKind, decided: bool, complete: bool) -> Verdict {
    match (kind.is_universal(), decided) {
        (true, true) => Verdict::Violated,
        (false, true) => Verdict::Witnessed,
        _ if !complete => Verdict::Undecided,
        (true, false) => Verdict::Holds,
        (false, false) => Verdict::NotWitnessed,
    }
}

fn idle(scenario: &Scenario, taken: &[Vec<bool>]) -> Vec<IdleStep> {
    let replicas = scenario.replicas.iter().zip(taken);
    let steps = replicas.flat_map(|(replica, taken)| {
        let idle = taken.iter().enumerate().filter(|(_, taken)| !**taken);
        idle.map(|(step, _)| IdleStep { replica: replica.name.clone(), step })
    });
    steps.collect()
}

/// Searches again, breadth first, for the shortest way to what was found.
fn add_traces<S: Replicated>(inner: &mut Inner<S>, report: &mut Report) {
    let decided =
        |property: &PropertyReport| matches!(property.verdict, Verdict::Violated | Verdict::Witnessed);
    let wanted: Vec<usize> =
        report.properties.iter().enumerate().filter(|(_, it)| decided(it)).map(|(at, _)| at).collect();
    inner.space.memo.fault = None;
    let mut shortest = Shortest::new(&mut inner.space);
    if let Some(breach) = &mut report.breach {
        breach.trace = shortest.breach();
        return;
    }
    let found: Vec<(usize, Trace)> = shortest.properties(wanted);
    for (at, trace) in found {
        report.properties[at].trace = Some(trace);
    }
}
