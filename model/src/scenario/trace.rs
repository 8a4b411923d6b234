//! What happened, as a list of steps. `[spec: SCEN-13]`

use super::Scenario;
use super::explore::Replicated;
use super::memo::{DeltaId, MoveKind, StateId};
use super::script::Conduct;
use super::space::{Broken, Choice, Space};
use crate::checked::Act;
use crate::course::Event;
use crate::graph::Names;
use crate::replay::replay_with;
use crate::semantics::Breach;
use crate::trace::{CannotHappen, FindingKind, Recorder};
use serde::Serialize;
use serde_json::Value as Json;
use std::cmp::Reverse;
use std::collections::BTreeSet;
use std::fmt;

/// A counterexample or a witness.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Trace {
    /// How many of the steps mutate; no trace to the same finding has fewer.
    pub mutations: usize,
    /// How many deliveries and other steps the search met on its way that the finding does not need, and that are
    /// left out. `[spec: CHECK-14]`
    #[serde(skip_serializing_if = "is_nought")]
    pub left_out: usize,
    /// What happened, in order.
    pub steps: Vec<ScenarioStep>,
    /// The same as every layer tells it, unless it cannot be run again.
    #[serde(skip)]
    pub run: Option<crate::trace::Trace>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_nought(count: &usize) -> bool {
    *count == 0
}

impl Trace {
    /// How many things happen in it: deliveries one by one, mutations, and steps without one.
    pub(super) fn happenings(&self) -> usize {
        let counts = self.steps.iter().map(|step| match step {
            ScenarioStep::Receive { deltas, .. } => deltas.len(),
            ScenarioStep::Mutate { .. } | ScenarioStep::Go { .. } => 1,
            ScenarioStep::See { .. } | ScenarioStep::Break { .. } => 0,
        });
        counts.sum()
    }
}

/// One step of a trace.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(tag = "step", rename_all = "snake_case")]
pub enum ScenarioStep {
    /// Deltas are delivered.
    Receive {
        /// To whom; `a reader` only reads.
        replica: String,
        /// Their numbers, in order of delivery.
        deltas: Vec<usize>,
    },
    /// A mutation is made and broadcast.
    Mutate {
        /// By whom.
        replica: String,
        /// The step of its script, from 0.
        #[serde(skip_serializing_if = "Option::is_none")]
        script_step: Option<usize>,
        /// What is made, in the script's words.
        text: Vec<String>,
        /// What is made, with ids.
        mutations: Vec<Json>,
        /// The number of its delta, from 1.
        number: usize,
        /// Its delta.
        delta: Json,
    },
    /// A guard holds that was waited for, or a step is left out, or a script ends early.
    Go {
        /// Whose.
        replica: String,
        /// The step of its script, from 0.
        script_step: usize,
        /// `passes`, `skips` or `stops`.
        how: &'static str,
    },
    /// What somebody sees in the end, as changes of the initial graph.
    See {
        /// Who.
        replica: String,
        /// A line for each change.
        changes: Vec<String>,
    },
    /// A clause is broken here.
    Break {
        /// The clause.
        clause: &'static str,
        /// How.
        detail: String,
    },
}

/// How a trace ends.
#[derive(Clone, Debug)]
pub(super) enum Last {
    /// Somebody has received these and sees this.
    View(StateId, Vec<DeltaId>),
    /// Everybody receives everything and sees this.
    End(StateId),
    /// A clause is broken.
    Broken(Broken),
}

/// What a trace shows, and what a reduced one has to show as well.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Sought {
    /// The property of this index is decided.
    Property(usize),
    /// This clause breaks.
    Breach(&'static str),
}

/// Tells a way and its end, and records it.
pub(super) fn tell<S: Replicated>(space: &Space<S>, way: &[Choice], last: Last, sought: Sought) -> Trace {
    let scenario = &space.memo.scenario;
    let names = scenario.replicas().map(str::to_owned).chain([READER.to_owned()]);
    let mut teller = Teller {
        space,
        made: Vec::new(),
        known: vec![BTreeSet::new(); scenario.replicas.len()],
        steps: Vec::new(),
        record: Ok(Recorder::new(&*space.memo.semantics, names)),
    };
    for choice in way {
        teller.choose(choice);
    }
    let shown_by = match last {
        Last::View(state, seen) => teller.view(state, &seen.into_iter().collect()),
        Last::End(state) => teller.end(state),
        Last::Broken(broken) => teller.broken(broken),
    };
    let mutations = teller.steps.iter().filter(|step| matches!(step, ScenarioStep::Mutate { .. })).count();
    let run = teller.record.ok().map(|recorder| finish(recorder, scenario, sought, &teller.steps, shown_by));
    // What a step that is not made would break cannot be shown by those that are.
    let run = run.filter(|run| {
        run.finding.kind != FindingKind::Broken || replay_with(&*space.memo.semantics, run).is_ok()
    });
    Trace { mutations, left_out: 0, steps: teller.steps, run }
}

/// The run as every layer tells it.
fn finish<S: Replicated>(
    mut recorder: Recorder<'_, S>,
    scenario: &Scenario,
    sought: Sought,
    steps: &[ScenarioStep],
    shown_by: Vec<usize>,
) -> crate::trace::Trace {
    let replicas = recorder.scribe().names(shown_by);
    let finding = match (sought, steps.last()) {
        (Sought::Breach(_), Some(ScenarioStep::Break { clause, detail })) => {
            let breach = Breach::new(clause, detail);
            crate::trace::Finding::broken(&recorder.runner().semantics().clauses(), &breach, replicas)
        }
        (Sought::Property(at), _) if scenario.properties.get(at).is_some() => {
            let property = &scenario.properties[at];
            let (kind, detail) = if property.kind.is_universal() {
                (FindingKind::Fails, "it does not hold here")
            } else {
                (FindingKind::Seen, "it is seen here")
            };
            crate::trace::Finding {
                kind,
                clause: property.name.clone(),
                what: property.why.clone(),
                detail: detail.into(),
                replicas,
            }
        }
        _ => crate::trace::Finding {
            kind: FindingKind::Seen,
            clause: String::new(),
            what: String::new(),
            detail: "this is what happened".into(),
            replicas,
        },
    };
    // Whoever does nothing and shows nothing is not needed.
    let idle =
        scenario.replicas().chain([READER]).filter(|name| !finding.replicas.iter().any(|by| by == name));
    idle.for_each(|name| recorder.drop_idle(name));
    let title = format!("{}: {}", scenario.name(), finding.clause);
    recorder.finish(title, "scenario", "the fewest mutations that show it".into(), finding)
}

const READER: &str = "a reader";

struct Teller<'s, S: Replicated> {
    space: &'s Space<S>,
    /// In order of their numbers.
    made: Vec<DeltaId>,
    /// Per replica, what it has received or made.
    known: Vec<BTreeSet<DeltaId>>,
    steps: Vec<ScenarioStep>,
    /// The same, recorded, as long as it can be run again.
    record: Result<Recorder<'s, S>, CannotHappen>,
}

impl<S: Replicated> Teller<'_, S> {
    /// The position of a replica, or of the reader.
    fn position(&self, replica: Option<usize>) -> usize {
        replica.unwrap_or(self.known.len())
    }

    fn record(&mut self, event: &Event<Act>) {
        if let Ok(recorder) = &mut self.record
            && let Err(why) = recorder.record(event)
        {
            self.record = Err(why);
        }
    }

    fn name(&self, replica: Option<usize>) -> String {
        let replica = replica.and_then(|at| self.space.memo.scenario.replicas.get(at));
        replica.map_or(READER, |replica| &replica.name).to_owned()
    }

    fn receive(&mut self, replica: Option<usize>, deltas: impl IntoIterator<Item = DeltaId>) {
        let mut known = BTreeSet::new();
        let known = replica.and_then(|at| self.known.get_mut(at)).unwrap_or(&mut known);
        let new: Vec<DeltaId> = deltas.into_iter().filter(|&delta| known.insert(delta)).collect();
        let number = |delta: &DeltaId| self.made.iter().position(|known| known == delta).map(|at| at + 1);
        let deltas: Vec<usize> = new.iter().filter_map(number).collect();
        for &number in &deltas {
            self.record(&Event::Deliver { replica: self.position(replica), message: number - 1 });
        }
        if !deltas.is_empty() {
            self.steps.push(ScenarioStep::Receive { replica: self.name(replica), deltas });
        }
    }

    fn choose(&mut self, choice: &Choice) {
        let Choice { replica, received, at, step } = choice;
        self.receive(Some(*replica), received.iter().copied());
        let (name, script_step) = (self.name(Some(*replica)), usize::from(at.step));
        let how = match step.kind {
            MoveKind::Mutates => return self.mutate(choice),
            MoveKind::Passes => "passes",
            MoveKind::Skips => "skips",
            MoveKind::Stops => "stops",
        };
        if let Ok(recorder) = &mut self.record {
            recorder.happen(*replica, format!("{how} step {} of its script", script_step + 1));
        }
        self.steps.push(ScenarioStep::Go { replica: name, script_step, how });
    }

    fn mutate(&mut self, choice: &Choice) {
        let Choice { replica, at, step, .. } = choice;
        let Some(delta) = step.delta else { return };
        let (script_step, text) = match &self.space.memo.scenario.replicas[*replica].conduct {
            Conduct::Script(steps) => {
                let at = usize::from(at.step);
                (Some(at), steps[at].mutations.iter().map(ToString::to_string).collect())
            }
            Conduct::Free { .. } => (None, step.acts.iter().map(ToString::to_string).collect()),
        };
        self.record(&Event::Mutate { replica: *replica, mutations: step.acts.to_vec() });
        if !self.made.contains(&delta) {
            self.made.push(delta);
        }
        self.known[*replica].insert(delta);
        let number = self.made.iter().position(|known| *known == delta).map_or(0, |at| at + 1);
        self.steps.push(ScenarioStep::Mutate {
            replica: self.name(Some(*replica)),
            script_step,
            text,
            mutations: step.acts.iter().map(|act| json(&act.0)).collect(),
            number,
            delta: json(&*self.space.memo.delta(delta)),
        });
    }

    fn see(&mut self, replica: String, state: StateId) {
        let memo = &self.space.memo;
        let shows = |state| memo.semantics.shows(&memo.state(state));
        let (before, after) = (shows(self.space.initial), shows(state));
        let names = Names::of(before.elements.iter().chain(&after.elements));
        let changes = before.changes(&after).iter().flat_map(|change| change.lines(&names)).collect();
        self.steps.push(ScenarioStep::See { replica, changes });
    }

    /// Somebody sees it: a replica that can have received just that, or else a reader.
    fn view(&mut self, state: StateId, seen: &BTreeSet<DeltaId>) -> Vec<usize> {
        let can = |known: &&BTreeSet<DeltaId>| known.is_subset(seen);
        let best = self
            .known
            .iter()
            .enumerate()
            .filter(|(_, known)| can(known))
            .min_by_key(|(_, known)| Reverse(known.len()));
        let who = best.map(|(at, _)| at);
        self.receive(who, seen.iter().copied());
        self.see(self.name(who), state);
        vec![self.position(who)]
    }

    fn end(&mut self, state: StateId) -> Vec<usize> {
        for replica in 0..self.known.len() {
            self.receive(Some(replica), self.made.clone());
        }
        self.see("everybody".into(), state);
        (0..self.known.len()).collect()
    }

    fn broken(&mut self, broken: Broken) -> Vec<usize> {
        self.receive(broken.replica, broken.received);
        self.steps.push(ScenarioStep::Break { clause: broken.breach.clause, detail: broken.breach.detail });
        vec![self.position(broken.replica)]
    }
}

/// A value of the core as JSON; all of them have a form.
fn json(value: &impl Serialize) -> Json {
    serde_json::to_value(value).unwrap_or(Json::Null)
}

/// One line for each step.
impl fmt::Display for Trace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.steps.iter().enumerate().try_for_each(|(at, step)| writeln!(f, "{:>3}. {step}", at + 1))?;
        match self.left_out {
            0 => Ok(()),
            1 => writeln!(f, "     (1 step left out that this does not need)"),
            count => writeln!(f, "     ({count} steps left out that this does not need)"),
        }
    }
}

/// As in `camera: add_edge person -in-> bed (delta 1)`.
impl fmt::Display for ScenarioStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Receive { replica, deltas } => {
                let list: Vec<String> = deltas.iter().map(ToString::to_string).collect();
                write!(
                    f,
                    "{replica} receives {} {}",
                    if list.len() == 1 { "delta" } else { "deltas" },
                    list.join(", ")
                )
            }
            Self::Mutate { replica, text, number, .. } => {
                write!(f, "{replica}: {} (delta {number})", text.join("; "))
            }
            Self::Go { replica, script_step, how } => write!(f, "{replica} {how} step {script_step}"),
            Self::See { replica, changes } => {
                write!(f, "{replica} sees")?;
                changes.iter().try_for_each(|line| write!(f, "\n       {line}"))
            }
            Self::Break { clause, detail } => write!(f, "{clause} is broken: {detail}"),
        }
    }
}
