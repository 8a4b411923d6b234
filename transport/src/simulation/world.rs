//! Sessions, clocks and network, from one moment to the next.

use super::judge::{self, Failure};
use super::plan::Plan;
use crate::action::{Action, Event, Presence};
use crate::config::{MS, SECOND};
use crate::memory::{Faults, Network};
use crate::session::Session;
use crate::stats::Stats;
use dsr_core::Dot;
use std::collections::BTreeSet;

/// One place where a session may run.
#[derive(Debug)]
pub(super) struct Node {
    pub(super) session: Option<Session>,
    pub(super) agent: u32,
    /// What its clock shows beyond the time of the world.
    pub(super) offset: u64,
    pub(super) wake: Option<u64>,
}

/// Everything.
#[derive(Debug)]
pub(super) struct World<'t> {
    pub(super) now: u64,
    pub(super) nodes: Vec<Node>,
    pub(super) network: Network,
    pub(super) plan: &'t Plan,
    /// How often each agent id has been started.
    pub(super) starts: Vec<u32>,
    /// Every dot that a mutation has made.
    pub(super) made: BTreeSet<Dot>,
    /// What sessions counted that are gone.
    pub(super) past: Stats,
    pub(super) mutations: u64,
    pub(super) refused: u64,
    pub(super) failure: Option<Failure>,
    /// What happens, in words, if somebody wants to know.
    pub(super) told: Option<Vec<String>>,
}

impl<'t> World<'t> {
    pub(super) fn new(plan: &'t Plan, tell: bool) -> Self {
        let count = plan.nodes + 1;
        let node = |at: usize| Node {
            session: None,
            agent: u32::try_from(at + 1).unwrap_or(u32::MAX),
            offset: 10 * SECOND + (plan.seed ^ at as u64) % SECOND,
            wake: None,
        };
        let mut network = Network::new(count, plan.seed, plan.faults.clone());
        for port in 0..count {
            network.open(port, false);
        }
        Self {
            now: 0,
            nodes: (0..count).map(node).collect(),
            network,
            plan,
            starts: vec![0; count + 2],
            made: BTreeSet::new(),
            past: Stats::default(),
            mutations: 0,
            refused: 0,
            failure: None,
            told: tell.then(Vec::new),
        }
    }

    pub(super) fn tell(&mut self, text: impl FnOnce() -> String) {
        if let Some(told) = &mut self.told {
            told.push(format!("{:>6} ms  {}", self.now / MS, text()));
        }
    }

    /// What every session has counted.
    pub(super) fn tell_counts(&mut self) {
        let mut lines = Vec::new();
        for (at, session) in self.sessions() {
            let named = session.stats().named();
            let counts =
                named.iter().filter(|(_, count)| *count > 0).map(|(name, count)| format!("{name} {count}"));
            let print = session.replica().fingerprint();
            lines.push(format!(
                "n{at} has {print}, {} records: {}",
                session.replica().len(),
                counts.collect::<Vec<_>>().join(", ")
            ));
        }
        for line in lines {
            self.tell(|| line);
        }
    }

    pub(super) fn fail(&mut self, failure: Failure) {
        self.tell(|| format!("FAILS: {failure}"));
        self.failure.get_or_insert(failure);
    }

    /// Lets time pass, and all that happens in it.
    pub(super) fn pass(&mut self, until: u64) {
        while self.failure.is_none() {
            let wakes = self.nodes.iter().filter_map(|node| node.wake);
            let Some(next) = self.network.next().into_iter().chain(wakes).min().filter(|&next| next <= until)
            else {
                break;
            };
            self.now = self.now.max(next);
            while let Some((port, from, bytes)) = self.network.arrive(self.now) {
                self.handle(port, Event::Datagram { from, bytes: &bytes });
            }
            for at in 0..self.nodes.len() {
                if self.nodes[at].wake.is_some_and(|wake| wake <= self.now) {
                    self.handle(at, Event::Tick);
                }
            }
        }
        self.now = self.now.max(until);
    }

    pub(super) fn handle(&mut self, at: usize, event: Event<'_>) {
        let now = self.now;
        let is_tick = event == Event::Tick;
        let Some(node) = self.nodes.get_mut(at) else { return };
        let Some(session) = &mut node.session else { return };
        session.handle(event, now.saturating_add(node.offset));
        self.drain(at, is_tick);
    }

    /// Carries out what a session wants done.
    pub(super) fn drain(&mut self, at: usize, ticked: bool) {
        let now = self.now;
        while let Some(action) = self.nodes[at].session.as_mut().and_then(Session::poll_action) {
            match action {
                Action::Send { to, bytes } => self.network.send(at, to, bytes, now),
                Action::Peer { origin, presence: Presence::Joined, .. } => {
                    self.tell(|| format!("n{at} meets {}", origin.replica));
                }
                Action::Peer { origin, presence, .. } => {
                    self.tell(|| format!("n{at} has lost {} ({presence:?})", origin.replica));
                }
                Action::Refused(refusal) => self.tell(|| format!("n{at} is refused: {refusal}")),
                Action::Synced => self.tell(|| format!("n{at} is synchronised")),
                Action::Changed { .. } => {}
            }
        }
        let node = &mut self.nodes[at];
        let wake = node.session.as_ref().and_then(Session::next_wake);
        let wake = wake.map(|wake| wake.saturating_sub(node.offset));
        // What is due after a tick still is due again: at the next microsecond, so that time passes.
        node.wake = if ticked { wake.map(|wake| wake.max(now + 1000)) } else { wake };
    }

    /// Every session that runs, with its node.
    pub(super) fn sessions(&self) -> impl Iterator<Item = (usize, &Session)> {
        let sessions = self.nodes.iter().enumerate();
        sessions.filter_map(|(at, node)| Some((at, node.session.as_ref()?))).filter(|(_, one)| !one.is_over())
    }

    /// What must hold of one session at any moment.
    pub(super) fn judge(&mut self, at: usize) {
        let session = self.nodes.get(at).and_then(|node| node.session.as_ref());
        if let Some(failure) = session.and_then(|session| judge::session(at, session).err()) {
            self.fail(failure);
        }
    }

    /// No more faults, for good.
    pub(super) fn heal(&mut self) {
        self.tell(|| "the network heals, for good".into());
        self.network.faults = Faults::NONE;
        self.network.partition(0);
        for port in 0..self.nodes.len() {
            self.network.slow(port, self.now);
        }
    }
}
