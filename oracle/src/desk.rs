//! The desk: where a search puts what it computes, to have it asked. `[spec: ORACLE-4]`
//!
//! A search goes on while its facts are asked, each once. When the program has said something else, the desk becomes
//! *strict*: from then on each fact is asked before the search goes on, so that the search ends at the first that
//! disagrees, and its own way of finding the shortest counterexample applies.

use crate::compare::{Batch, Compared, Disagreement, Fact, ask_each, ask_now};
use crate::fact::{Question, hex, made, of_answer, of_state, refused};
use crate::program::{Program, Start, Trouble};
use dsr_core::{Author, Delta, Dictionary, Mutation, State, encode, view};
use rustc_hash::FxHashSet;
use siphasher::sip::SipHasher13;
use std::hash::{Hash, Hasher};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// Things in one batch.
const BATCH: usize = 64;
/// Batches that wait for a program.
const WAITING_MAX: usize = 64;

/// Things and their keys.
type Things = Vec<(u64, Thing)>;

/// A thing that a search has computed.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Thing {
    /// A state: its view and digest.
    State(State),
    /// What somebody may try in a state.
    Mutations(State, Author, Vec<Mutation>),
    /// Deliveries, in order.
    Join(State, Vec<Delta>),
    /// An answer to the digest of the second state.
    Answer(State, State),
}

impl Thing {
    /// Equal for equal things. Different ones are taken for the same with a chance of about 2⁻⁶⁴ a pair; then one of the two
    /// is not asked.
    fn key(&self) -> u64 {
        let mut hasher = SipHasher13::new();
        self.hash(&mut hasher);
        hasher.finish()
    }

    /// Its facts, as the core has them.
    fn facts(&self, dictionary: &Dictionary, about: u64, into: &mut Batch) {
        match self {
            Self::State(state) => {
                into.extend(of_state(state).iter().map(|question| Fact::of(about, question, dictionary)));
            }
            Self::Mutations(state, author, mutations) => {
                let (seen, before) = (view(state, dictionary), hex(&encode(state)));
                into.extend(mutations.iter().map(|mutation| {
                    let ours = match mutation.delta(&seen, *author) {
                        Ok(delta) => made(&delta, &state.joined(&delta)),
                        Err(error) => refused(&error.kind()),
                    };
                    // A mutation is strings and numbers: writing it cannot fail.
                    let text = serde_json::to_string(mutation).unwrap_or_default();
                    let line = format!("delta {}@{} {before} {text}", author.replica, author.timestamp_ns);
                    Fact { about, line, ours }
                }));
            }
            Self::Join(state, deltas) => {
                let states = std::iter::once(state).chain(deltas).cloned().collect();
                into.push(Fact::of(about, &Question::Join(states), dictionary));
            }
            Self::Answer(ours, theirs) => into.push(Fact::of(about, &of_answer(ours, theirs), dictionary)),
        }
    }
}

/// See the module.
#[derive(Debug)]
pub struct Desk {
    dictionary: Dictionary,
    start: Start,
    /// What was put down, by key.
    known: Mutex<FxHashSet<u64>>,
    batch: Mutex<Things>,
    to_ask: Mutex<Option<SyncSender<Things>>>,
    workers: Mutex<Vec<JoinHandle<()>>>,
    compared: Arc<Compared>,
    strict: AtomicBool,
    /// Asks at once, in the strict time; and what has been found then.
    at_once: Mutex<AtOnce>,
}

#[derive(Debug, Default)]
struct AtOnce {
    program: Option<Program>,
    found: Vec<(u64, Disagreement)>,
}

/// Why a search need not go on.
#[derive(Clone, Debug)]
pub enum Stop {
    /// The program says something else.
    Disagreement(Box<Disagreement>),
    /// The program cannot be asked.
    Trouble(Trouble),
}

impl Desk {
    /// A desk of so many programs at once.
    pub fn new(start: Start, jobs: usize, dictionary: Dictionary) -> Self {
        let (to_ask, asked) = sync_channel(WAITING_MAX);
        let asked = Arc::new(Mutex::new(asked));
        let compared = Arc::new(Compared::default());
        let workers = (0..jobs.max(1)).map(|_| {
            let (start, dictionary) = (start.clone(), dictionary.clone());
            let (asked, compared) = (Arc::clone(&asked), Arc::clone(&compared));
            std::thread::spawn(move || {
                ask_each(&start, &compared, &mut || take(&asked, &dictionary));
            })
        });
        Self {
            workers: Mutex::new(workers.collect()),
            dictionary,
            start,
            known: Mutex::default(),
            batch: Mutex::default(),
            to_ask: Mutex::new(Some(to_ask)),
            compared,
            strict: AtomicBool::new(false),
            at_once: Mutex::default(),
        }
    }

    /// What was asked, and what was answered otherwise.
    pub fn compared(&self) -> &Compared {
        &self.compared
    }

    /// Whether each fact is asked before the search goes on.
    pub fn is_strict(&self) -> bool {
        self.strict.load(Relaxed)
    }

    /// How many different things were put down.
    pub fn things(&self) -> usize {
        lock(&self.known).len()
    }

    /// Puts a thing down, to be asked some time; `Err` if there is no need to go on.
    pub fn put(&self, thing: Thing) -> Result<(), Stop> {
        if self.is_strict() {
            return self.ask(&thing);
        }
        let key = thing.key();
        if lock(&self.known).insert(key) {
            let mut batch = lock(&self.batch);
            batch.push((key, thing));
            if batch.len() >= BATCH {
                self.hand_over(std::mem::take(&mut *batch));
            }
        }
        if self.compared.is_stopped() || self.compared.disagreeing.load(Relaxed) > 0 {
            return self.settle();
        }
        Ok(())
    }

    /// Waits until all that was put down is answered; `Err` if not all is well. Then the desk is strict.
    pub fn settle(&self) -> Result<(), Stop> {
        let batch = std::mem::take(&mut *lock(&self.batch));
        if !batch.is_empty() {
            self.hand_over(batch);
        }
        *lock(&self.to_ask) = None;
        for worker in std::mem::take(&mut *lock(&self.workers)) {
            // A worker that has panicked has asked nothing: its program is at fault for nothing.
            let _ = worker.join();
        }
        self.strict.store(true, Relaxed);
        match (self.compared.trouble(), self.compared.first().into_iter().next()) {
            (Some(trouble), _) => Err(Stop::Trouble(trouble)),
            (None, Some(first)) => Err(Stop::Disagreement(Box::new(first))),
            (None, None) => Ok(()),
        }
    }

    fn hand_over(&self, batch: Things) {
        // Without anybody to take it, its trouble has been told.
        let _ = lock(&self.to_ask).as_ref().map(|to_ask| to_ask.send(batch));
    }

    /// Asks at once, unless it is known to agree.
    fn ask(&self, thing: &Thing) -> Result<(), Stop> {
        if let Some(trouble) = self.compared.trouble() {
            return Err(Stop::Trouble(trouble));
        }
        let key = thing.key();
        let mut at_once = lock(&self.at_once);
        if let Some((_, found)) = at_once.found.iter().find(|(known, _)| *known == key) {
            return Err(Stop::Disagreement(Box::new(found.clone())));
        }
        let is_new = lock(&self.known).insert(key);
        if !is_new && !self.compared.about().contains(&key) {
            return Ok(());
        }
        let mut facts = vec![Fact::of_dictionary(&self.dictionary)];
        thing.facts(&self.dictionary, key, &mut facts);
        match self.ask_facts(&mut at_once, &facts) {
            Ok(None) => Ok(()),
            Ok(Some(found)) => {
                at_once.found.push((key, found.clone()));
                Err(Stop::Disagreement(Box::new(found)))
            }
            Err(trouble) => {
                self.compared.fail(trouble.clone());
                Err(Stop::Trouble(trouble))
            }
        }
    }

    fn ask_facts(&self, at_once: &mut AtOnce, facts: &[Fact]) -> Result<Option<Disagreement>, Trouble> {
        let mut program = match at_once.program.take() {
            Some(program) => program,
            None => self.start.start()?,
        };
        let found = ask_now(&mut program, facts)?;
        at_once.program = Some(program);
        Ok(found)
    }
}

fn take(asked: &Mutex<Receiver<Things>>, dictionary: &Dictionary) -> Option<Batch> {
    let things = lock(asked).recv().ok()?;
    let mut facts = vec![Fact::of_dictionary(dictionary)];
    for (key, thing) in &things {
        thing.facts(dictionary, *key, &mut facts);
    }
    Some(facts)
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
