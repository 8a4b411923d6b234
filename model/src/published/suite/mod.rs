//! The published semantics behind the checker's trait, so that the ordinary layers run on it.
//! `[spec: CHECK-12]`
//!
//! What is assumed, all of it to the advantage of the published system:
//!
//! - What one call sends travels as one delta, in one piece and in its order. The published network splits and
//!   reorders it; the [gallery](crate::gallery) does so, too.
//! - Clocks are right: a call's time is later than all that its author has seen.
//! - Users are careful: nobody deletes a node that carries others, gives a node a second parent, or places it
//!   below itself.
//! - Nobody joins, restarts, or ignores attributes, and the initial graph was loaded by an agent that has left.
//!
//! | room | what |
//! |---|---|
//! | `alphabet` | the initial graph, and what careful users may call in a graph |
//! | `judge` | the clauses that the published semantics can be held to |
//! | `hidden` | what users do not see of a replica |
//! | `runs` | what `dsr check` runs |

mod alphabet;
mod hidden;
mod judge;
mod runs;

pub use alphabet::{CallKind, initial};
pub use judge::CLAUSES;
pub use runs::{ClauseRun, NOT_APPLICABLE, histories, histories_suite, jobs, schedules_suite};

use super::property::lines;
use super::setup::CALL_TIME;
use super::{AgentId, Message, NOBODY, Operation, Replica, Stamps, Time, Variant, Workers};
use crate::checked::INCARNATION;
use crate::graph::Graph;
use crate::semantics::{Breach, Clause, Delivery, Judged, Semantics, Step};
use crate::why::{Claim, Standing, Target};
use std::collections::BTreeSet;

/// A replica at rest. Until its first call it does not say whose it is; messages of its own come later than that.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Held {
    /// The replica.
    pub replica: Replica,
    /// The latest time of a call that it has made or heard of, in nanoseconds.
    pub clock: Time,
}

/// Which states that ought to be equal count as equal.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Compared {
    /// Those that are equal in everything, held back and hidden things included: what L1 builds on.
    Whole,
    /// Those that show users the same graph.
    Shown,
}

/// The published semantics from a small graph, with an alphabet of calls.
#[derive(Clone, Debug)]
pub struct Published {
    /// Which implementation, and how its users fill it in.
    pub variant: Variant,
    /// What every replica starts from.
    pub initial: Held,
    /// The kinds of calls that replicas may make.
    pub kinds: BTreeSet<CallKind>,
    /// The only node whose attributes, edges and place are touched, if not all are.
    pub focus: Option<super::NodeId>,
    /// Which states count as equal.
    pub compared: Compared,
    /// The only clause that is judged, if not all are.
    pub only: Option<&'static str>,
}

/// The agent that index `replica` of the checker stands for; 0 is nobody's.
pub(super) fn agent(replica: usize) -> AgentId {
    AgentId::try_from(replica % INCARNATION).unwrap_or(AgentId::MAX - 2) + 1
}

impl Held {
    /// The state after the messages of one call, in their order. Who has crashed takes nothing in.
    #[must_use]
    pub fn received(&self, delta: &[Message]) -> Self {
        let mut after = self.clone();
        for message in delta {
            if after.replica.crash.is_none() {
                after.clock = after.clock.max(message.time());
                after.replica.crash = after.replica.receive(message).err();
            }
        }
        after
    }

    /// What an agent broadcasts by a call, and its state after it; `None` when the call is refused or changes
    /// nothing.
    pub fn called(&self, agent: AgentId, operation: &Operation) -> Option<(Vec<Message>, Self)> {
        if self.replica.crash.is_some() {
            return None;
        }
        let mut after = self.clone();
        after.replica.agent = agent;
        let now = (self.clock / CALL_TIME + 1) * CALL_TIME;
        let delta = match after.replica.call(operation, now) {
            Ok(sent) => sent?.into_iter().filter(|message| !message.is_empty_list()).collect(),
            Err(crash) => {
                after.replica.crash = Some(crash);
                Vec::new()
            }
        };
        let changes = !delta.is_empty() || after.replica.crash.is_some();
        after.clock = delta.iter().map(Message::time).fold(now, Time::max);
        changes.then_some((delta, after))
    }

    /// The same, of one who has called nothing.
    #[must_use]
    pub fn of_nobody(&self) -> Self {
        Self { replica: Replica { agent: NOBODY, ..self.replica.clone() }, clock: self.clock }
    }

    /// What users see, a line for each fact: the graph, and what a name finds that several nodes have.
    pub fn facts(&self) -> BTreeSet<String> {
        let mut facts = lines(&self.replica.shown());
        let names = |id| self.replica.node(id).map(|node| node.name);
        let found = self.replica.ids.iter().filter(|&(name, id)| {
            self.replica.nodes.keys().any(|other| other != id && names(*other) == Some(*name))
        });
        facts.extend(found.map(|(name, id)| format!("{name} finds #{id}")));
        facts.extend(self.replica.crash.map(|crash| format!("it no longer runs: {crash}")));
        facts
    }
}

impl Published {
    /// All kinds of calls on the [initial graph](initial), everything judged.
    pub fn new(variant: Variant) -> Self {
        Self {
            variant,
            initial: initial(variant),
            kinds: CallKind::ALL.into(),
            focus: None,
            compared: Compared::Whole,
            only: None,
        }
    }

    /// Whether a clause is judged.
    pub(super) fn is_judged(&self, clause: &str) -> bool {
        self.only.is_none_or(|only| only == clause)
    }
}

impl Semantics for Published {
    type State = Held;
    type Delta = Vec<Message>;
    type Mutation = Operation;

    fn name(&self) -> String {
        let workers = match self.variant.workers {
            Workers::Several => "upstream",
            Workers::One => "fork",
        };
        let stamps = match self.variant.stamps {
            Stamps::Zero => "agent 0 in all that is new",
            Stamps::Author => "authors in what is new",
        };
        format!("published ({workers}, {stamps})")
    }

    fn initial(&self) -> Held {
        self.initial.clone()
    }

    fn mutations(&self, state: &Held, replica: usize) -> Vec<Operation> {
        if state.replica.crash.is_some() { Vec::new() } else { self.calls(&state.replica, agent(replica)) }
    }

    fn mutate(&self, state: &Held, replica: usize, operation: &Operation) -> Option<Step<Self>> {
        let (delta, after) = state.called(agent(replica), operation)?;
        Some(Step { delta, after })
    }

    fn join(&self, state: &Held, delta: &Vec<Message>) -> Held {
        state.received(delta)
    }

    fn delivery(&self) -> Delivery {
        Delivery::Once
    }

    fn differ(&self, left: &Held, right: &Held) -> Option<String> {
        self.difference(left, right).filter(|_| self.is_judged("JOIN-3") || self.is_judged("JOIN-5"))
    }

    fn plain(&self) -> Option<Self> {
        (self.compared == Compared::Whole).then(|| Self { compared: Compared::Shown, ..self.clone() })
    }

    fn judge(&self, state: &Held) -> Result<Judged, Breach> {
        self.judge_state(state)?;
        Ok(Judged::default())
    }

    fn judge_step(
        &self,
        before: &Held,
        _replica: usize,
        operation: &Operation,
        step: &Step<Self>,
    ) -> Result<(), Breach> {
        self.judge_call(before, operation, step)
    }

    fn judge_delivery(&self, before: &Held, after: &Held) -> Result<(), Breach> {
        self.judge_received(before, after)
    }

    fn kind(&self, operation: &Operation) -> usize {
        CallKind::of(operation) as usize
    }

    fn kinds(&self) -> Vec<&'static str> {
        CallKind::ALL.map(CallKind::name).to_vec()
    }

    fn kinds_in_use(&self) -> Vec<usize> {
        self.kinds.iter().map(|&kind| kind as usize).collect()
    }

    fn clauses(&self) -> Vec<Clause> {
        CLAUSES.into_iter().filter(|clause| self.is_judged(clause.id)).collect()
    }

    fn judges(&self, clause: &str) -> bool {
        // There is no resynchronisation.
        clause != "SYNC-5" && self.is_judged(clause)
    }

    fn shows(&self, state: &Held) -> Graph {
        state.replica.picture()
    }

    fn delta_text(&self, delta: &Vec<Message>) -> String {
        delta.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    }

    fn mutation_json(&self, operation: &Operation) -> serde_json::Value {
        operation.json()
    }

    fn state_json(&self, state: &Held) -> serde_json::Value {
        serde_json::json!({ "clock": state.clock, "replica": state.replica.json() })
    }

    fn delta_json(&self, delta: &Vec<Message>) -> serde_json::Value {
        delta.iter().map(Message::json).collect()
    }

    fn setup_json(&self) -> serde_json::Value {
        serde_json::json!({
            "variant": if self.variant.workers == Workers::Several { "upstream" } else { "fork" },
            "agent_id": if self.variant.stamps == Stamps::Zero { "zero" } else { "distinct" },
            "compared": if self.compared == Compared::Whole { "whole" } else { "shown" },
            "only": self.only,
        })
    }

    fn claims(&self, delta: &Vec<Message>, target: &Target) -> Vec<Claim> {
        delta.iter().flat_map(|message| message.claims(target)).collect()
    }

    fn claims_held(&self, state: &Held, target: &Target) -> Vec<Claim> {
        state.replica.claims_held(target)
    }

    fn ends(&self, delta: &Vec<Message>, target: &Target, claim: &Claim) -> bool {
        delta.iter().any(|message| message.ends(target, claim))
    }

    fn standing(&self, state: &Held, target: &Target, claim: &Claim) -> Standing {
        state.replica.standing(target, claim)
    }
}

impl Published {
    /// The semantics of a trace's setup; `None` if it is none.
    pub fn of_setup(setup: &serde_json::Value) -> Option<Self> {
        let text = |key: &str| setup.get(key).and_then(serde_json::Value::as_str);
        let workers = match text("variant")? {
            "upstream" => Workers::Several,
            "fork" => Workers::One,
            _ => return None,
        };
        let stamps = match text("agent_id")? {
            "zero" => Stamps::Zero,
            "distinct" => Stamps::Author,
            _ => return None,
        };
        let compared = match text("compared")? {
            "whole" => Compared::Whole,
            "shown" => Compared::Shown,
            _ => return None,
        };
        let only = match text("only") {
            None => None,
            Some(only) => {
                Some(CLAUSES.iter().map(|clause| clause.id).chain(["JOIN-5"]).find(|id| *id == only)?)
            }
        };
        Some(Self { compared, only, ..Self::new(Variant { workers, stamps }) })
    }
}
