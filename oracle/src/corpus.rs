//! The conformance corpus, by the program. `[spec: ORACLE-4]`
//!
//! Twice: the program passes it as an adapter, as any implementation does; and each case is made anew, on the core and on the
//! program side by side, where after every step everything that can be asked of what it may have changed is asked of both.

mod expected;
mod script;

use crate::program::{Program, Start, Trouble, excerpt};
use dsr_conformance::case::Case;
use dsr_conformance::report::{Outcome, Report};
use dsr_conformance::run::{ChildLimits, Program as Adapter};
use script::{Known, Script, Want, hello};
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};

/// Requests that a program may be behind.
const BEHIND_MAX: usize = 8192;
/// So many bytes of requests are sent at once: fewer than what a program is behind by.
const TOGETHER_BYTES: usize = 1 << 15;

/// What the corpus has shown.
#[derive(Clone, Debug)]
pub struct CorpusFound {
    /// Cases.
    pub cases: usize,
    /// Steps of them.
    pub steps: u64,
    /// Replies compared with those of the core.
    pub replies: u64,
    /// Expectations filled in by the program, and compared with those of the files.
    pub expectations: u64,
    /// What the program answers otherwise, in words; few of them.
    pub differences: Vec<Difference>,
    /// How many there are.
    pub differing: u64,
    /// How the program passed as an adapter.
    pub report: Report,
    /// How long the second part took.
    pub seconds: f64,
}

/// A reply, or an expectation filled in by it, that is not as it should be.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Difference {
    /// The case.
    pub case: String,
    /// Its step, counted from 1; 0 before the first.
    pub step: usize,
    /// What was asked.
    pub asked: String,
    /// What the core says, or the file.
    pub due: String,
    /// What the program says.
    pub came: String,
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { case, step, asked, due, came } = self;
        writeln!(f, "{case}, step {step}")?;
        write!(f, "asked    {}\ndue      {}\nprogram  {}", excerpt(asked), excerpt(due), excerpt(came))
    }
}

impl CorpusFound {
    /// Whether all is as it should be, both times.
    pub fn agrees(&self) -> bool {
        self.differing == 0 && self.report.outcome() == Outcome::Expected
    }

    /// Steps of cases in a second.
    #[expect(clippy::cast_precision_loss, reason = "a rate to look at")]
    pub fn steps_per_second(&self) -> f64 {
        self.steps as f64 / self.seconds.max(0.001)
    }
}

/// Runs the cases both ways; `start` is the program as an adapter. `[spec: ORACLE-4]`
pub fn run(
    start: &Start,
    jobs: usize,
    cases: &[Case],
    done: &(dyn Fn() + Sync),
) -> Result<CorpusFound, Trouble> {
    let limits = ChildLimits { reply: start.patience, ..ChildLimits::default() };
    let mut adapter = Adapter { command: start.command.clone(), limits };
    // What cannot be started cannot be asked, and is no failure of cases.
    start.start()?.finish()?;
    let report = dsr_conformance::run::run(&mut adapter, cases);
    let began = std::time::Instant::now();
    let counts = Counts::default();
    let next = AtomicUsize::new(0);
    let trouble = Mutex::new(None);
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| {
                let mut take = || {
                    if lock(&trouble).is_some() {
                        return None;
                    }
                    let case = cases.get(next.fetch_add(1, Relaxed));
                    done();
                    case
                };
                if let Err(found) = side_by_side(start, &mut take, &counts) {
                    lock(&trouble).get_or_insert(found);
                }
            });
        }
    });
    if let Some(trouble) = lock(&trouble).take() {
        return Err(trouble);
    }
    let Counts { steps, replies, expectations, differing, differences } = counts;
    Ok(CorpusFound {
        cases: cases.len(),
        steps: steps.into_inner(),
        replies: replies.into_inner(),
        expectations: expectations.into_inner(),
        differing: differing.into_inner(),
        differences: differences.into_inner().unwrap_or_else(PoisonError::into_inner),
        report,
        seconds: began.elapsed().as_secs_f64(),
    })
}

#[derive(Debug, Default)]
struct Counts {
    steps: AtomicU64,
    replies: AtomicU64,
    expectations: AtomicU64,
    differing: AtomicU64,
    differences: Mutex<Vec<Difference>>,
}

/// The most differences that are kept.
const KEPT_MAX: usize = 20;

/// Cases on one program, which is asked ahead of its replies: what it is asked does not depend on them, since deltas are
/// named in the order in which they are made, and vertices by the cases.
fn side_by_side<'c>(
    start: &Start,
    next: &mut dyn FnMut() -> Option<&'c Case>,
    counts: &Counts,
) -> Result<(), Trouble> {
    let mut program = start.start()?;
    let mut id = 1;
    program.send((hello() + "\n").into_bytes());
    let greeted = program.answer(&hello)?;
    if !greeted.contains("\"ok\"") {
        return Err(Trouble::Garbage { answer: excerpt(&greeted), question: hello() });
    }
    let mut behind: std::collections::VecDeque<(String, Vec<Want>)> = std::collections::VecDeque::new();
    let mut waiting = 0;
    let mut known = Known::default();
    // Cases go together: each message wakes the program, and costs more than what it asks.
    let mut lines = Vec::new();
    loop {
        let case = next();
        if let Some(case) = case {
            let script = Script::of(case, id);
            id += script.wants.len() as u64;
            counts.steps.fetch_add(case.steps.len() as u64, Relaxed);
            lines.extend_from_slice(&script.lines);
            waiting += script.wants.len();
            behind.push_back((case.id.clone(), script.wants));
        }
        if lines.len() > TOGETHER_BYTES || case.is_none() {
            program.send(std::mem::take(&mut lines));
        }
        while waiting > BEHIND_MAX || case.is_none() {
            let Some((case, wants)) = behind.pop_front() else { break };
            waiting -= wants.len();
            judge(&mut program, &case, wants, &mut known, counts)?;
        }
        if case.is_none() {
            return program.finish();
        }
    }
}

fn judge(
    program: &mut Program,
    case: &str,
    wants: Vec<Want>,
    known: &mut Known,
    counts: &Counts,
) -> Result<(), Trouble> {
    for want in wants {
        let reply = program.answer(&|| want.asked.clone())?;
        counts.replies.fetch_add(1, Relaxed);
        counts.expectations.fetch_add(want.expected.len() as u64, Relaxed);
        for (due, came) in want.judge(&reply, known)? {
            counts.differing.fetch_add(1, Relaxed);
            let mut kept = lock(&counts.differences);
            if kept.len() < KEPT_MAX {
                let (case, asked) = (case.into(), want.asked.clone());
                kept.push(Difference { case, step: want.step, asked, due, came });
            }
        }
    }
    Ok(())
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
