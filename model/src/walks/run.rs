//! Many walks and their report. `[spec: CHECK-13]` `[spec: CHECK-1]`

use super::{Counts, Walk, Walked};
use crate::course::{self, Course, Outcome};
use crate::progress::Progress;
use crate::semantics::{Clause, GROUPS, Semantics};
use crate::shrink::{Shrinker, Shrunk, TRIES_MAX, breaks_as};
use crate::trace::{CannotHappen, Trace, of_course};
use crate::verdict::{Evidence, PropertyKind, PropertyReport, RunReport, StateCounts, Verdict};
use std::sync::Arc;

/// What is judged besides what the semantics judges.
const BESIDES: [Clause; 3] = [
    GROUPS,
    Clause { id: "JOIN-5", claim: "L3", what: "at the end, delivering what is missing makes all equal" },
    Clause { id: "SYNC-5", claim: "L3", what: "at the end, resynchronisation makes all equal" },
];

/// The longer a walk, the longer each try to shrink it takes at first: about so many events are tried at most.
const TRIED_EVENTS_MAX: usize = 5_000_000;
/// The fewest tries however long a walk is.
const TRIES_MIN: usize = 1_000;

/// A run of L3: the walks from number 0 on, unless a limit stops it.
#[derive(Clone, Debug)]
pub struct WalkRun<S> {
    /// Its name in reports.
    pub name: String,
    /// What is checked.
    pub semantics: Arc<S>,
    /// How many vertices are in focus, for the report.
    pub focus: usize,
    /// How they go.
    pub walk: Walk,
    /// How many.
    pub walks: u64,
}

/// A walk that broke a clause, as it was and shrunk.
#[derive(Debug)]
pub struct WalkFinding<S: Semantics> {
    /// Its number under the seed.
    pub number: u64,
    /// The course as it was walked.
    pub course: Course<S::Mutation>,
    /// How that ended.
    pub outcome: Outcome,
    /// The same, shrunk.
    pub shrunk: Shrunk<S>,
}

impl<S: Semantics> WalkFinding<S> {
    /// The shrunk course as it is shown.
    pub fn trace(&self) -> Result<Trace, CannotHappen> {
        let Shrunk { semantics, course, .. } = &self.shrunk;
        let outcome = course::run(&**semantics, course, true);
        let clauses: Vec<Clause> = semantics.clauses().into_iter().chain(BESIDES).collect();
        let bound = format!("walk {}, shrunk from {} events", self.number, self.shrunk.events_before);
        of_course(&**semantics, course, &outcome, &clauses, ("L3", bound))
    }
}

/// The first of some walks that breaks a clause, shrunk. `[spec: CHECK-14]`
pub fn find<S: Semantics>(semantics: &Arc<S>, walk: Walk, walks: u64) -> Option<WalkFinding<S>> {
    (0..walks).find_map(|number| finding(semantics, number, walk.walk(&**semantics, number)))
}

/// What a walk found, shrunk.
fn finding<S: Semantics>(
    semantics: &Arc<S>,
    number: u64,
    walked: Walked<S::Mutation>,
) -> Option<WalkFinding<S>> {
    let Walked { course, outcome, .. } = walked;
    outcome.clause()?;
    let tries_max = TRIED_EVENTS_MAX / (course.events.len() + 1);
    let shrinker = Shrinker { tries_max: tries_max.clamp(TRIES_MIN, TRIES_MAX), ..Shrinker::default() };
    let shrunk = shrinker.shrink(semantics, &course, breaks_as(&outcome));
    Some(WalkFinding { number, course, outcome, shrunk })
}

impl<S: Semantics> WalkRun<S> {
    /// What is judged: what the semantics has judged, and what this layer adds.
    pub fn clauses(&self) -> Vec<Clause> {
        self.semantics.clauses().into_iter().chain(BESIDES).collect()
    }

    /// Walks and reports. The verdict is *bounded* at best: a walk is no search.
    pub fn run(&self, progress: &Arc<Progress>) -> RunReport {
        let mut counts = Counts::default();
        let mut found = None;
        for number in 0..self.walks {
            let walked = self.walk.walk(&*self.semantics, number);
            counts.add(&walked.counts);
            progress.note(counts.walks, counts.events, walked.course.events.len());
            progress.note_seen(counts.judged, counts.witnesses.count());
            found = finding(&self.semantics, number, walked);
            let is_late = progress.seconds() >= progress.limits().seconds_max;
            if found.is_some() || is_late || progress.must_stop() {
                break;
            }
        }
        let run = RunReport {
            replicas: self.walk.replicas,
            mutations: self.walk.mutations_max,
            focus: self.focus,
            operations: self.semantics.steps(&self.semantics.initial(), 0).len(),
            ..RunReport::new(self.name.clone(), "L3", self.semantics.name(), progress.seconds())
        };
        self.report(run, &counts, found.as_ref())
    }

    fn report(&self, run: RunReport, counts: &Counts, found: Option<&WalkFinding<S>>) -> RunReport {
        let broken = found.and_then(|found| found.outcome.clause());
        let mut properties: Vec<PropertyReport> = self
            .clauses()
            .iter()
            .map(|clause| PropertyReport {
                verdict: if broken == Some(clause.id) { Verdict::Violated } else { Verdict::Bounded },
                ..PropertyReport::always(clause.id, clause.claim, clause.what)
            })
            .collect();
        if let Some(clause) = broken.filter(|id| properties.iter().all(|known| known.clause != *id)) {
            let verdict = Verdict::Violated;
            properties.push(PropertyReport { verdict, ..PropertyReport::always(clause, "", "") });
        }
        let seen = self.seen(counts);
        let unseen = seen.iter().filter(|(_, seen)| !seen).count();
        properties.extend(seen.into_iter().map(|(name, seen)| PropertyReport {
            kind: PropertyKind::Sometimes,
            verdict: if seen { Verdict::Exhaustive } else { Verdict::Vacuous },
            ..PropertyReport::always(&name, "", "")
        }));
        let walked = counts.walks;
        let evidence =
            Evidence { violated: broken.is_some(), cut: true, unique: walked, expanded: walked, unseen };
        RunReport {
            states: StateCounts {
                unique: walked,
                generated: counts.events,
                judged: counts.judged,
                ..StateCounts::default()
            },
            verdict: Verdict::of(evidence),
            properties,
            notes: self.notes(counts, found),
            ..run
        }
        .with_trace(found.map(WalkFinding::trace))
    }

    /// What walks have to do, and what states bore witness of.
    fn seen(&self, counts: &Counts) -> Vec<(String, bool)> {
        let kinds = self.semantics.kinds();
        let done = |kind: usize| counts.mutations.get(kind).is_some_and(|&count| count > 0);
        let in_use = self.semantics.kinds_in_use().into_iter();
        let mut seen: Vec<(String, bool)> =
            in_use.map(|kind| (format!("{} is done", kinds[kind]), done(kind))).collect();
        let faults = self.walk.faults;
        let several = self.walk.replicas > 1;
        let happenings = [
            ("a delivery", several, counts.deliveries),
            ("a delivery out of order", several, counts.reorderings),
            ("a delivery that is repeated", several && faults.duplicates, counts.duplicates),
            ("a loss", several && faults.losses, counts.losses),
            ("a restart", faults.restarts, counts.restarts),
            ("an answer to a digest", several && faults.resynchronisation, counts.answers),
        ];
        let expected = happenings.into_iter().filter(|(_, expected, _)| *expected);
        seen.extend(expected.map(|(name, _, count)| (name.into(), count > 0)));
        let names = self.semantics.witnesses().into_iter().enumerate();
        seen.extend(names.filter(|(bit, _)| counts.witnesses.has(*bit)).map(|(_, name)| (name.into(), true)));
        seen
    }

    fn notes(&self, counts: &Counts, found: Option<&WalkFinding<S>>) -> Vec<String> {
        let Walk { seed, replicas, mutations_max, events_max, .. } = self.walk;
        let last = counts.walks.saturating_sub(1);
        let kinds = self.semantics.kinds();
        let made: Vec<String> = kinds
            .iter()
            .zip(&counts.mutations)
            .filter(|(_, count)| **count > 0)
            .map(|(kind, count)| format!("{count} {kind}"))
            .collect();
        let mut notes = vec![
            format!(
                "seed {seed}, walks 0 to {last} of {}, of {replicas} replicas with up to {mutations_max} mutations \
                 each and {events_max} events: a sample, no search",
                self.walks
            ),
            format!(
                "{} events: {}; {} groups, {} deliveries ({} out of order), {} repeated, {} losses, {} restarts, {} \
                 answers",
                counts.events,
                made.join(", "),
                counts.groups,
                counts.deliveries,
                counts.reorderings,
                counts.duplicates,
                counts.losses,
                counts.restarts,
                counts.answers
            ),
        ];
        if let Some(WalkFinding { number, outcome, shrunk, .. }) = found {
            let made: Vec<String> =
                shrunk.made.iter().map(|(kind, count)| format!("{count} {}", kind.name())).collect();
            let minimal = if shrunk.is_minimal {
                "no single reduction more still breaks the clause"
            } else {
                "the limit of tries was met: it may not be minimal"
            };
            notes.push(format!("walk {number} of seed {seed}: {outcome}"));
            notes.push(format!(
                "shrunk from {} events to {} in {} tries ({}); {minimal}",
                shrunk.events_before,
                shrunk.course.events.len(),
                shrunk.tries,
                made.join(", ")
            ));
        }
        notes
    }
}
