//! The agent id: claimed, held, refused. `[spec: LINK-15]` `[spec: LINK-16]`

use super::Session;
use crate::action::{Action, MutateError, Refusal};
use crate::config::Config;
use crate::flaw::Flaw;
use crate::origin::{Address, Destination, Origin};
use crate::wire::Item;

/// How often a claim is said while it waits.
const HELLOS: u64 = 4;

/// Where a session stands.
#[derive(Clone, Debug)]
pub(super) enum Phase {
    /// It claims its agent id, and may not write.
    Claiming { until: u64, hello_at: u64 },
    /// It holds its agent id.
    Member,
    /// Somebody else holds it, and was found too late: what was written stays, nothing is written any more.
    Reader(Refusal),
    /// Somebody else holds it.
    Refused(Refusal),
    /// It sends what is queued, and leaves.
    Leaving,
    /// It has left.
    Left,
}

impl Phase {
    pub(super) fn claiming(config: &Config, now: u64) -> Self {
        if config.is_flawed(Flaw::ClaimsWithoutWaiting) {
            return Self::Member;
        }
        Self::Claiming { until: now.saturating_add(config.times.claim), hello_at: now }
    }

    /// Whether nothing is done any more.
    pub(super) fn is_over(&self) -> bool {
        matches!(self, Self::Refused(_) | Self::Left)
    }

    /// Whether its own stream has begun.
    pub(super) fn is_member(&self) -> bool {
        matches!(self, Self::Member | Self::Reader(_) | Self::Leaving)
    }

    pub(super) fn wake(&self) -> Option<u64> {
        match self {
            Self::Claiming { until, hello_at } => Some(*until.min(hello_at)),
            _ => None,
        }
    }
}

impl Session {
    /// Whether the agent id is being claimed still.
    pub fn is_claiming(&self) -> bool {
        matches!(self.phase, Phase::Claiming { .. })
    }

    /// Whether the agent id is held, and mutations are allowed.
    pub fn is_writer(&self) -> bool {
        matches!(self.phase, Phase::Member)
    }

    /// Whether it has left, or was refused before it began.
    pub fn is_over(&self) -> bool {
        self.phase.is_over()
    }

    pub(super) fn may_write(&self) -> Result<(), MutateError> {
        match &self.phase {
            Phase::Member => Ok(()),
            Phase::Claiming { until, .. } => {
                Err(MutateError::Claiming { nanoseconds: until.saturating_sub(self.now) })
            }
            Phase::Reader(refusal) | Phase::Refused(refusal) => Err(refusal.clone().into()),
            Phase::Leaving | Phase::Left => Err(MutateError::Left),
        }
    }

    pub(super) fn run_claim(&mut self) {
        let Phase::Claiming { until, hello_at } = &mut self.phase else { return };
        if *until <= self.now {
            self.phase = Phase::Member;
            self.beats.at = self.now;
        } else if *hello_at <= self.now {
            *hello_at = self.now.saturating_add((self.config.times.claim / HELLOS).max(1));
            self.say(Destination::Group, Item::Hello { name: self.config.name.clone() });
        }
    }

    /// Somebody claims an agent id: the holder objects; of two that claim, the lesser.
    pub(super) fn hear_hello(&mut self, sender: Origin, from: Address) {
        let mine = sender.replica.agent == self.me.replica.agent;
        let holds = matches!(self.phase, Phase::Member | Phase::Reader(_));
        if mine && (holds || self.is_claiming() && self.me < sender) {
            self.object(sender, from);
        }
    }

    /// Somebody uses an agent id. If it is this session's, one of the two was cut off when it claimed it: the
    /// greater one gives it up, since an incarnation that is greater is later.
    pub(super) fn hear_of_agent(&mut self, sender: Origin, from: Address) {
        let mine = sender.replica.agent == self.me.replica.agent;
        if mine && self.me < sender && matches!(self.phase, Phase::Member) {
            self.object(sender, from);
        }
    }

    fn object(&mut self, to: Origin, from: Address) {
        let object = Item::Object { to, name: self.config.name.clone() };
        if self.control.back().is_none_or(|last| last.1 != object) {
            self.stats.objections += 1;
            self.say(Destination::Peer(from), object);
        }
    }

    /// The claim of this session is refused: nothing was written, or nothing more is.
    pub(super) fn hear_objection(&mut self, sender: Origin, to: Origin, owner: String) {
        let mine = to == self.me && sender.replica.agent == self.me.replica.agent;
        if !mine || self.config.is_flawed(Flaw::ClaimsWithoutWaiting) {
            return;
        }
        let refusal = Refusal {
            agent: self.me.replica.agent,
            owner_origin: sender,
            owner,
            claimant_origin: self.me,
            claimant: self.config.name.clone(),
        };
        match self.phase {
            Phase::Claiming { .. } => {
                self.control.clear();
                self.say(Destination::Group, Item::Bye);
                self.phase = Phase::Refused(refusal.clone());
            }
            Phase::Member if sender < self.me => self.phase = Phase::Reader(refusal.clone()),
            _ => return,
        }
        self.actions.push_back(Action::Refused(refusal));
    }

    pub(super) fn leave(&mut self) {
        match self.phase {
            Phase::Left | Phase::Refused(_) => {}
            Phase::Claiming { .. } => self.say_bye(),
            Phase::Member | Phase::Reader(_) | Phase::Leaving => self.phase = Phase::Leaving,
        }
    }

    /// Leaves once nothing waits to be sent for the first time.
    pub(super) fn run_leave(&mut self) {
        if matches!(self.phase, Phase::Leaving) && !self.outbox.has_fresh() {
            self.say_bye();
        }
    }

    fn say_bye(&mut self) {
        self.say(Destination::Group, Item::Bye);
        self.phase = Phase::Left;
    }
}
