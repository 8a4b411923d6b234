//! Facts in batches, on several programs at once. `[spec: ORACLE-5]`

use crate::fact::{Kind, Question, TAKEN, dictionary_line};
use crate::program::{Program, Start, Trouble, excerpt};
use dsr_core::Dictionary;
use std::collections::{BTreeSet, VecDeque};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// How many batches a program may be behind.
const BATCHES_AHEAD: usize = 4;

/// A question and what the core answers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fact {
    /// What whoever made it knows it by.
    pub about: u64,
    /// The line that asks.
    pub line: String,
    /// The core's answer.
    pub ours: String,
}

/// Facts that are asked in sequence. A batch sets the dictionary before anything that depends on it.
pub type Batch = Vec<Fact>;

impl Fact {
    /// A question, answered by the core.
    pub fn of(about: u64, question: &Question, dictionary: &Dictionary) -> Self {
        Self { about, line: question.line(), ours: question.answer(dictionary) }
    }

    /// What comes before all that depends on a dictionary.
    pub fn of_dictionary(dictionary: &Dictionary) -> Self {
        Self { about: 0, line: dictionary_line(dictionary), ours: TAKEN.into() }
    }
}

/// A fact on which the program says something else. `[spec: ORACLE-5]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Disagreement {
    /// The dictionary's line before it.
    pub dictionary: String,
    /// What both were asked.
    pub fact: Fact,
    /// The program's answer.
    pub theirs: String,
}

/// How many facts were asked, by kind.
#[derive(Debug, Default)]
pub struct Tally([AtomicU64; 6]);

impl Tally {
    fn count(&self, fact: &Fact) {
        if let Some(kind) = Kind::of_line(&fact.line) {
            self.0[kind as usize].fetch_add(1, Relaxed);
        }
    }

    /// How many of a kind.
    pub fn of(&self, kind: Kind) -> u64 {
        self.0[kind as usize].load(Relaxed)
    }

    /// How many in all.
    pub fn total(&self) -> u64 {
        Kind::ALL.into_iter().map(|kind| self.of(kind)).sum()
    }
}

/// What comes of many batches.
#[derive(Debug, Default)]
pub struct Compared {
    /// How many facts were asked.
    pub tally: Tally,
    disagreements: Mutex<Vec<Disagreement>>,
    about: Mutex<BTreeSet<u64>>,
    /// How many disagreements there were.
    pub disagreeing: AtomicU64,
    trouble: Mutex<Option<Trouble>>,
    stop: AtomicBool,
}

/// The most disagreements that are kept.
const KEPT_MAX: usize = 64;

impl Compared {
    /// Whether nothing more should be asked: the program cannot be asked, or somebody said so.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Relaxed)
    }

    /// Nothing more is to be asked.
    pub fn stop(&self) {
        self.stop.store(true, Relaxed);
    }

    /// Why the program cannot be asked, if so.
    pub fn trouble(&self) -> Option<Trouble> {
        self.trouble.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The program cannot be asked.
    pub fn fail(&self, trouble: Trouble) {
        self.trouble.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(trouble);
        self.stop();
    }

    /// The first disagreements, few of them.
    pub fn first(&self) -> Vec<Disagreement> {
        self.disagreements.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// What all disagreements are about.
    pub fn about(&self) -> BTreeSet<u64> {
        self.about.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn disagree(&self, disagreement: Disagreement) {
        self.about.lock().unwrap_or_else(PoisonError::into_inner).insert(disagreement.fact.about);
        self.disagreeing.fetch_add(1, Relaxed);
        let mut kept = self.disagreements.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() < KEPT_MAX {
            kept.push(disagreement);
        }
    }
}

/// Asks one program batch after batch, until `next` has none, and compares. The program is a few batches behind, so that
/// both sides work at once.
pub fn ask_each(start: &Start, compared: &Compared, next: &mut dyn FnMut() -> Option<Batch>) {
    if let Err(trouble) = try_each(start, compared, next) {
        compared.fail(trouble);
        // Whoever makes batches may be waiting for somebody to take them.
        while next().is_some() {}
    }
}

fn try_each(
    start: &Start,
    compared: &Compared,
    next: &mut dyn FnMut() -> Option<Batch>,
) -> Result<(), Trouble> {
    let mut program = start.start()?;
    let mut behind: VecDeque<Batch> = VecDeque::new();
    loop {
        let batch = if compared.is_stopped() { None } else { next() };
        let is_last = batch.is_none();
        if let Some(batch) = batch {
            let mut lines = Vec::new();
            for fact in &batch {
                lines.extend_from_slice(fact.line.as_bytes());
                lines.push(b'\n');
            }
            program.send(lines);
            behind.push_back(batch);
        }
        while behind.len() >= BATCHES_AHEAD || is_last {
            let Some(batch) = behind.pop_front() else { break };
            judge(&mut program, batch, compared)?;
        }
        if is_last {
            return program.finish();
        }
    }
}

fn judge(program: &mut Program, batch: Batch, compared: &Compared) -> Result<(), Trouble> {
    let mut dictionary = String::new();
    for fact in batch {
        let theirs = program.answer(&|| fact.line.clone())?;
        compared.tally.count(&fact);
        if fact.ours == TAKEN {
            dictionary.clone_from(&fact.line);
        }
        if theirs != fact.ours {
            is_answer(&fact, &theirs)?;
            compared.disagree(Disagreement { dictionary: dictionary.clone(), fact, theirs });
        }
    }
    Ok(())
}

/// Asks facts and waits; the first on which the program says something else.
pub fn ask_now(program: &mut Program, facts: &[Fact]) -> Result<Option<Disagreement>, Trouble> {
    let lines: Vec<String> = facts.iter().map(|fact| fact.line.clone()).collect();
    let answers = program.ask(&lines)?;
    let mut dictionary = "";
    for (fact, theirs) in facts.iter().zip(answers) {
        if fact.ours == TAKEN {
            dictionary = &fact.line;
        }
        if theirs != fact.ours {
            is_answer(fact, &theirs)?;
            return Ok(Some(Disagreement { dictionary: dictionary.into(), fact: fact.clone(), theirs }));
        }
    }
    Ok(None)
}

/// Whether a line has the form of an answer: what has not is no disagreement, but a program that cannot be asked.
/// `[spec: ORACLE-6]`
fn is_answer(fact: &Fact, theirs: &str) -> Result<(), Trouble> {
    let is_hex = |text: &str| {
        !text.is_empty()
            && text.len().is_multiple_of(2)
            && text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'))
    };
    let is_pair =
        |text: &str| text.split_once(' ').is_some_and(|(left, right)| is_hex(left) && is_hex(right));
    let is_word = |text: &str| {
        !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'.')
    };
    let is_one = match Kind::of_line(&fact.line) {
        None => theirs == TAKEN,
        Some(Kind::Join | Kind::Answer) => is_hex(theirs),
        Some(Kind::Digest) => is_pair(theirs),
        Some(Kind::View) => {
            serde_json::from_str::<serde_json::Value>(theirs).is_ok_and(|view| view.is_object())
        }
        Some(Kind::Accepts) => theirs == "yes" || theirs == "no",
        Some(Kind::Delta) => match theirs.split_once(' ') {
            Some(("made", states)) => is_pair(states),
            Some(("refused", kind)) => is_word(kind),
            _ => false,
        },
    };
    if is_one || theirs.starts_with("error ") {
        return Ok(());
    }
    Err(Trouble::Garbage { answer: excerpt(theirs), question: excerpt(&fact.line) })
}

/// Batches from several threads at once: `make` makes the batch of a number, and is asked for each number below `count`
/// once. `[spec: ORACLE-5]`
pub fn ask_numbered(
    start: &Start,
    jobs: usize,
    numbers: std::ops::Range<u64>,
    compared: &Compared,
    make: &(dyn Fn(u64) -> Batch + Sync),
) {
    let next = AtomicU64::new(numbers.start);
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| {
                ask_each(start, compared, &mut || {
                    let number = next.fetch_add(1, Relaxed);
                    (number < numbers.end && !compared.is_stopped()).then(|| make(number))
                });
            });
        }
    });
}

/// Facts a second since an instant.
#[expect(clippy::cast_precision_loss, reason = "a rate to look at")]
pub fn per_second(count: u64, since: Instant) -> f64 {
    count as f64 / since.elapsed().as_secs_f64().max(0.001)
}

/// Both answers, one above the other, from a little before they part.
impl std::fmt::Display for Disagreement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        const BEFORE: usize = 60;
        const AFTER: usize = 200;
        let (ours, theirs) = (&self.fact.ours, &self.theirs);
        let equal = ours.bytes().zip(theirs.bytes()).take_while(|(ours, theirs)| ours == theirs).count();
        let from = equal.saturating_sub(BEFORE);
        let part = |text: &str| -> String {
            let dots = if from > 0 { "…" } else { "" };
            let part = String::from_utf8_lossy(&text.as_bytes()[from..text.len().min(equal + AFTER)]);
            let end = if text.len() > equal + AFTER { "…" } else { "" };
            format!("{dots}{}{end}", part.escape_debug().to_string().replace("\\\"", "\""))
        };
        writeln!(f, "asked    {}", excerpt(&self.fact.line))?;
        writeln!(f, "core     {}", part(ours))?;
        write!(f, "program  {}", part(theirs))
    }
}
