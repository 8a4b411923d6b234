//! Carries out one step of a plan.

use super::hostile;
use super::judge::Failure;
use super::plan::Step;
use super::workload;
use super::world::World;
use crate::action::Event;
use crate::config::{Bounds, Config, MS};
use crate::memory::Faults;
use crate::origin::{Destination, Origin};
use crate::session::Session;
use crate::wire::group_key;
use dsr_core::{Dot, Graph, Mutation, ReplicaId};

/// The name of the group.
const GROUP: &str = "simulation";

impl World<'_> {
    pub(super) fn step(&mut self, step: &Step) {
        self.tell(|| step.to_string());
        match *step {
            Step::Mutate { node, choice } => self.mutate(node, |graph| workload::mutation(graph, choice)),
            Step::Image { node, bytes } => self.mutate(node, |_| workload::image(bytes)),
            Step::Burst { node, choice, count } => {
                for at in 0..count as u64 {
                    let choice = choice.rotate_left(7) ^ at.wrapping_mul(0x9e37_79b9_7f4a_7c15);
                    self.mutate(node, |graph| workload::of_burst(graph, choice));
                }
            }
            Step::Partition { side } => self.network.partition(side),
            Step::Heal => self.network.partition(0),
            Step::Crash { node } => self.kill(node),
            Step::Start { node } => {
                let agent = self.nodes.get(node).map_or(0, |node| node.agent);
                self.start(node, agent, false);
            }
            Step::Impostor { node, of } => {
                let agent = self.nodes.get(of).map_or(0, |node| node.agent);
                // Where nothing is lost a claim must find the holder, whatever incarnation is claimed.
                self.start(node, agent, self.plan.faults == Faults::NONE);
            }
            Step::Leave { node } => self.handle(node, Event::Leave),
            Step::Jump { node, ms } => {
                if let Some(node) = self.nodes.get_mut(node) {
                    let by = ms.unsigned_abs().saturating_mul(MS);
                    let jumped = if ms < 0 { node.offset.saturating_sub(by) } else { node.offset + by };
                    node.offset = jumped;
                }
                self.handle(node, Event::Tick);
            }
            Step::Slow { node, ms } => self.network.slow(node, self.now + ms * MS),
            Step::Hostile { choice } => {
                let members: Vec<Origin> = self.sessions().map(|(_, session)| session.origin()).collect();
                let bytes = hostile::datagram(choice, group_key(GROUP), &members);
                let nobody = self.nodes.len();
                self.network.send(nobody, Destination::Group, bytes, self.now);
            }
        }
    }

    fn start(&mut self, at: usize, agent: u32, same: bool) {
        let idle = self.nodes.get(at).is_some_and(|node| node.session.as_ref().is_none_or(Session::is_over));
        let Some(starts) = usize::try_from(agent).ok().and_then(|agent| self.starts.get_mut(agent)) else {
            return;
        };
        if !idle {
            return;
        }
        let incarnation = if same { starts.saturating_sub(1) } else { *starts };
        *starts += u32::from(!same);
        let replica = ReplicaId { agent, incarnation };
        let nonce = self.plan.seed ^ (at as u64) << 32 ^ u64::from(incarnation) << 48 ^ self.now;
        let mut config = Config::new(replica, nonce, &format!("n{at}"), GROUP, workload::dictionary());
        config.flaw = self.plan.flaw;
        if self.plan.tight {
            config.bounds = tight();
        }
        if !self.plan.fingerprints {
            config.times.settle = u64::MAX;
        }
        self.network.open(at, true);
        let now = self.now.saturating_add(self.nodes[at].offset);
        self.nodes[at].session = Some(Session::new(config, nonce, now));
        self.drain(at, false);
    }

    fn kill(&mut self, at: usize) {
        let Some(node) = self.nodes.get_mut(at) else { return };
        if let Some(session) = node.session.take() {
            self.past.add(&session.stats());
        }
        node.wake = None;
        self.network.open(at, false);
    }

    /// Lets a session mutate, and any other one that has its agent id.
    fn mutate(&mut self, at: usize, mutation: impl Fn(&Graph) -> Mutation) {
        let Some(agent) = self.nodes.get(at).map(|node| node.agent) else { return };
        let has_agent = |session: &Session| session.origin().replica.agent == agent;
        let all: Vec<usize> = self.sessions().filter(|(_, one)| has_agent(one)).map(|(at, _)| at).collect();
        for at in all {
            let node = &mut self.nodes[at];
            let Some(session) = &mut node.session else { continue };
            let now = self.now.saturating_add(node.offset);
            match session.mutate(&mutation(session.replica()), self.now, now) {
                Ok(made) => {
                    self.mutations += 1;
                    let dots: Vec<Dot> = made.delta.records().map(|(dot, _)| dot).collect();
                    let reused = dots.into_iter().find(|&dot| !self.made.insert(dot));
                    if let Some(dot) = reused {
                        self.fail(Failure::DotReused { node: at, dot });
                    }
                }
                Err(error) => {
                    self.refused += 1;
                    self.tell(|| format!("n{at} may not: {error}"));
                }
            }
            self.drain(at, false);
            self.judge(at);
        }
    }
}

/// Buffers so small that they run over.
fn tight() -> Bounds {
    Bounds {
        kept_bytes: 200_000,
        kept_messages: 12,
        queued_bytes: 300_000,
        begun_bytes: 320_000,
        begun_messages: 3,
        runs: 8,
        incoming: 3,
        answers: 3,
        window_bytes: 20_000,
        piece_bytes: 4_000,
        bytes_per_second: 20_000_000,
        burst_bytes: 20_000,
        wants: 6,
        ..Bounds::default()
    }
}
