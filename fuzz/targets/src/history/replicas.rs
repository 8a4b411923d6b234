//! Replicas, and what each step does to them.

use super::{Core, laws, look};
use crate::pair::Pair;
use crate::target::{Broken, Marks, equal};
use dsr_core::{Delta, Dictionary, Graph, Mutation, State, decode, encode, view};
use dsr_model::checked::{Act, INCARNATION, replica_id};
use dsr_model::semantics::Step as Made;
use dsr_testkit::Step;
use std::collections::BTreeSet;

/// One replica.
pub(super) struct One {
    pub(super) state: State,
    /// Which deltas it has got, its own included.
    pub(super) known: BTreeSet<usize>,
    /// How often it has restarted.
    incarnation: usize,
    /// The fast replica beside the reference; none if the core is a broken one.
    pub(super) pair: Option<Pair>,
    /// What a reader took long ago, and the state of that moment. `[spec: REPLICA-2]`
    snapshot: Option<(Graph, State)>,
}

/// All, and what they have sent.
pub(super) struct Replicas<'c, S> {
    pub(super) core: &'c S,
    pub(super) dictionary: Dictionary,
    pub(super) all: Vec<One>,
    pub(super) sent: Vec<Delta>,
}

impl One {
    /// The index under which the checker knows it.
    fn index(&self, at: usize) -> usize {
        at + self.incarnation * INCARNATION
    }
}

impl<'c, S: Core> Replicas<'c, S> {
    pub(super) fn new(core: &'c S, dictionary: Dictionary, count: usize, beside_fast: bool) -> Self {
        let one = |at: usize| {
            let agent = replica_id(at).agent;
            let pair = beside_fast.then(|| Pair::of(agent, &core.initial(), dictionary.clone()));
            One { state: core.initial(), known: BTreeSet::new(), incarnation: 0, pair, snapshot: None }
        };
        let all = (0..count).map(one).collect();
        Self { core, dictionary, all, sent: Vec::new() }
    }

    /// Takes a step, and asks every law of what has changed.
    pub(super) fn step(&mut self, step: &Step, marks: &mut Marks) -> Result<(), Broken> {
        let count = self.all.len();
        match step {
            Step::Mutate { replica, kind, choice } => {
                let at = replica % count;
                let here = view(&self.all[at].state, &self.dictionary);
                let author = dsr_core::Author::new(replica_id(self.all[at].index(at)));
                match dsr_testkit::pick(&here, author, *kind, *choice) {
                    Some(mutation) => self.mutate(at, &mutation, marks),
                    None => Ok(()),
                }
            }
            Step::Attempt { replica, kind, choice } => {
                let at = replica % count;
                let here = view(&self.all[at].state, &self.dictionary);
                match dsr_testkit::attempt(&here, *kind, *choice) {
                    Some(mutation) => self.mutate(at, &mutation, marks),
                    None => Ok(()),
                }
            }
            Step::Try { replica, mutation } => self.mutate(replica % count, mutation, marks),
            Step::Deliver { delta, to } => self.deliver(&[*delta], to % count, marks),
            Step::Group { deltas, to } => {
                marks.add_if(deltas.len() > 1 && !self.sent.is_empty(), "group");
                self.deliver(deltas, to % count, marks)
            }
            Step::Resynchronise { from, to } => self.resynchronise(from % count, to % count, marks),
            Step::Restart { replica, keeps } => {
                self.restart(replica % count, *keeps);
                marks.add(if *keeps { "restart-keeps" } else { "restart-loses" });
                self.judge(replica % count, marks)
            }
        }
    }

    fn mutate(&mut self, at: usize, mutation: &Mutation, marks: &mut Marks) -> Result<(), Broken> {
        let one = &mut self.all[at];
        let (index, before) = (one.index(at), one.state.clone());
        let (act, kind) = (Act(mutation.clone()), mutation.kind().name());
        let made = match &mut one.pair {
            // The pair compares deltas, errors, changes and views of replica and reference.
            Some(pair) => match pair.mutate(mutation) {
                Ok(delta) => Some(Made { after: before.joined(&delta), delta }),
                Err(error) => {
                    marks.add(format!("refused-{kind}-{}", error.kind()));
                    None
                }
            },
            None => self.core.mutate(&before, index, &act),
        };
        let Some(made) = made else { return Ok(()) };
        marks.add(format!("made-{kind}"));
        let judged = self.core.judge_step(&before, index, &act, &made);
        judged.map_err(|breach| laws::broken(&breach, &before))?;
        self.all[at].state = made.after;
        self.all[at].known.insert(self.sent.len());
        self.sent.push(made.delta);
        self.judge(at, marks)
    }

    /// Delivers some of the deltas sent, as one, over the wire.
    fn deliver(&mut self, deltas: &[usize], to: usize, marks: &mut Marks) -> Result<(), Broken> {
        if self.sent.is_empty() {
            return Ok(());
        }
        let deltas: Vec<usize> = deltas.iter().map(|delta| delta % self.sent.len()).collect();
        marks.add_if(deltas.iter().all(|delta| self.all[to].known.contains(delta)), "again");
        let whole = deltas.iter().fold(None, |whole: Option<Delta>, &delta| match whole {
            None => Some(self.sent[delta].clone()),
            Some(whole) => self.core.join_deltas(&whole, &self.sent[delta]),
        });
        let Some(whole) = whole else { return Ok(()) };
        let read = decode(&encode(&whole)).map_err(|error| Broken::new("ENC-1", error))?;
        equal("ENC-1", "a delta, and what arrives of it", &read, &whole)?;
        self.join(to, &read, marks)?;
        self.all[to].known.extend(deltas);
        self.judge(to, marks)
    }

    fn resynchronise(&mut self, from: usize, to: usize, marks: &mut Marks) -> Result<(), Broken> {
        let Some(delta) = self.core.repair(&self.all[from].state, &self.all[to].state) else { return Ok(()) };
        look::answer(&self.all[to].state, &delta, marks);
        self.join(to, &delta, marks)?;
        let known = self.all[from].known.clone();
        self.all[to].known.extend(known);
        self.judge(to, marks)
    }

    fn join(&mut self, to: usize, delta: &Delta, marks: &mut Marks) -> Result<(), Broken> {
        let one = &mut self.all[to];
        let before = one.state.clone();
        one.state = self.core.join(&before, delta);
        look::join(&before, delta, &one.state, marks);
        if let Some(pair) = &mut one.pair {
            look::surfaces(&before, pair, delta, marks);
            let changes = pair.apply(delta);
            marks.add_if(changes == 0 && before != one.state, "nothing-seen-of-it");
        }
        let judged = self.core.judge_delivery(&before, &one.state);
        judged.map_err(|breach| laws::broken(&breach, &before))
    }

    /// The next incarnation goes on, with the state or with nothing. `[spec: CRASH-2]`
    fn restart(&mut self, at: usize, keeps: bool) {
        let one = &mut self.all[at];
        one.incarnation += 1;
        if let Some(pair) = &mut one.pair {
            one.snapshot = Some((pair.replica.snapshot(), one.state.clone()));
            pair.restart(keeps);
            // What all have started from is there for whoever begins anew.
            pair.apply(&self.core.initial());
        }
        if !keeps {
            one.state = self.core.initial();
            one.known.clear();
        }
    }

    fn judge(&self, at: usize, marks: &mut Marks) -> Result<(), Broken> {
        let one = &self.all[at];
        look::state(&view(&one.state, &self.dictionary), marks);
        if let Some((graph, state)) = &one.snapshot {
            equal("REPLICA-2", "a snapshot, and what it was taken of", &graph.state(), state)?;
        }
        laws::of_replica(self, at)
    }

    /// Everything arrives everywhere, each time in another order; then all are equal.
    pub(super) fn come_to_rest(&mut self, marks: &mut Marks) -> Result<(), Broken> {
        laws::of_joins(self)?;
        let count = self.all.len();
        for to in 0..count {
            let mut order: Vec<usize> = (0..self.sent.len()).collect();
            order.rotate_left(to * self.sent.len() / count);
            if to % 2 == 1 {
                order.reverse();
            }
            for delta in order {
                let delta = self.sent[delta].clone();
                self.join(to, &delta, marks)?;
            }
            self.all[to].known.extend(0..self.sent.len());
            self.judge(to, marks)?;
        }
        laws::at_rest(self)
    }
}
