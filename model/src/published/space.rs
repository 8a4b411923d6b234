//! Replicas and their network, as a space to search.

use super::Time;
use super::message::Message;
use super::replica::Replica;
use super::setup::{CALL_TIME, Order, Setup, When};
use super::tables::Table;
use super::variant::Workers;
use super::world::{Event, Letter, World};
use crate::search::Space;
use crate::semantics::Breach;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// A moment, by number.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Moment(u32);

/// Every schedule of a [`Setup`].
#[derive(Debug)]
pub struct Network {
    pub(super) setup: Setup,
    order: Order,
    start: Moment,
    /// What a replica starts with, and starts with again.
    pub(super) initial: Vec<u32>,
    worlds: Table<World>,
    pub(super) replicas: Table<Replica>,
    pub(super) messages: Table<Message>,
    /// What a replica is after a message.
    received: FxHashMap<(u32, u32), u32>,
    judged: u64,
}

impl Network {
    /// The space of a setup.
    pub fn new(setup: Setup) -> Self {
        // One worker applies what one writer sends in the order sent.
        let order = match setup.variant.workers {
            Workers::One => setup.powers.order.min(Order::Topic),
            Workers::Several => setup.powers.order,
        };
        let mut replicas = Table::new();
        let initial: Vec<u32> = setup.initial().into_iter().map(|replica| replicas.intern(replica)).collect();
        let mut worlds = Table::new();
        let known = setup.powers.joiner.iter().flat_map(|joiner| &joiner.hears);
        let heard = known.fold(0, |heard, &replica| heard | 1 << replica);
        let start = worlds.intern(World { replicas: initial.clone(), heard, ..World::default() });
        Self {
            setup,
            order,
            start: Moment(start),
            initial,
            worlds,
            replicas,
            messages: Table::new(),
            received: FxHashMap::default(),
            judged: 0,
        }
    }

    /// What is searched.
    pub const fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The replicas at a moment.
    pub fn at(&self, moment: Moment) -> Vec<Arc<Replica>> {
        let world = self.worlds.get(moment.0);
        world.replicas.iter().map(|&replica| self.replicas.get(replica)).collect()
    }

    pub(super) fn letters_at(&self, moment: Moment) -> Vec<Letter> {
        self.worlds.get(moment.0).letters.clone()
    }

    /// How many different moments were met so far.
    pub fn moments(&self) -> u64 {
        self.worlds.len() as u64
    }

    /// The message of a letter.
    pub fn message(&self, letter: Letter) -> Arc<Message> {
        self.messages.get(letter.message)
    }

    pub(super) fn now(&self, world: &World, replica: usize) -> Time {
        let ahead = self.setup.powers.ahead.get(replica).copied().unwrap_or(0);
        CALL_TIME * (Time::from(world.depth()) + 1) + ahead
    }

    pub(super) fn push(&mut self, mut world: World, event: Event, out: &mut Vec<(Event, Moment)>) {
        world.sort(self.order);
        out.push((event, Moment(self.worlds.intern(world))));
    }

    fn calls(&mut self, world: &World, who: usize, out: &mut Vec<(Event, Moment)>) {
        let before = self.replicas.get(world.replicas[who]);
        let made = world.made[who];
        let Some(play) = self.setup.plays.get(who).filter(|play| made < play.calls_max) else { return };
        let from = if play.in_order { usize::from(made) } else { 0 };
        let to = if play.in_order { from + 1 } else { play.calls.len() };
        let calls: Vec<_> = play.calls.get(from..to).unwrap_or_default().to_vec();
        let now = self.now(world, who);
        for (call, (guard, operation)) in (from..).zip(calls) {
            if !guard.allows(world, &before) {
                continue;
            }
            let mut after = Replica::clone(&before);
            let sent = match after.call(&operation, now) {
                Ok(None) => continue,
                Ok(Some(sent)) => sent,
                Err(crash) => {
                    after.crash = Some(crash);
                    Vec::new()
                }
            };
            let mut next = world.clone();
            next.replicas[who] = self.replicas.intern(after);
            next.made[who] += 1;
            self.broadcast(&mut next, who, sent);
            self.push(next, Event::Call { replica: who, call }, out);
        }
    }

    /// Puts messages under way to everybody who is heard. Empty lists change nothing and are left out.
    fn broadcast(&mut self, world: &mut World, from: usize, sent: Vec<Message>) {
        for message in sent.into_iter().filter(|message| !message.is_empty_list()) {
            let topic = message.topic();
            let message = self.messages.intern(message);
            let (number, needs) = (world.seen[from][from], world.seen[from]);
            for to in (0..self.setup.replicas()).filter(|&to| to != from) {
                if self.hears(world, from, to) {
                    world.letters.push(Letter { from, to, topic, number, needs, message });
                }
            }
            if self.order == Order::Causal {
                world.seen[from][from] += 1;
            }
        }
    }

    fn receive(&mut self, replica: u32, message: u32) -> u32 {
        if let Some(&after) = self.received.get(&(replica, message)) {
            return after;
        }
        let mut after = Replica::clone(&self.replicas.get(replica));
        if after.crash.is_none() {
            after.crash = after.receive(&self.messages.get(message)).err();
        }
        let after = self.replicas.intern(after);
        self.received.insert((replica, message), after);
        after
    }

    fn arrivals(&mut self, world: &World, out: &mut Vec<(Event, Moment)>) {
        for at in 0..world.letters.len() {
            let letter = world.letters[at];
            let waits = self.is_slow(world, letter) || self.waits_to_be_told(world, letter);
            if waits || !world.may_arrive(at, self.order) {
                continue;
            }
            let mut gone = world.clone();
            gone.letters.remove(at);
            if world.lost < self.setup.powers.losses_max {
                let mut lost = gone.clone();
                lost.lost += 1;
                self.push(lost, Event::Lose { letter }, out);
            }
            gone.replicas[letter.to] = self.receive(world.replicas[letter.to], letter.message);
            if self.order == Order::Causal {
                gone.seen[letter.to][letter.from] += 1;
            }
            if world.repeated < self.setup.powers.duplicates_max {
                let mut again = World { letters: world.letters.clone(), ..gone.clone() };
                again.repeated += 1;
                self.push(again, Event::Deliver { letter, again: true }, out);
            }
            self.push(gone, Event::Deliver { letter, again: false }, out);
        }
    }

    /// Whether a letter waits for everything else to have happened.
    fn is_slow(&self, world: &World, letter: Letter) -> bool {
        let Some((node, to)) = self.setup.powers.slow else { return false };
        let message = self.messages.get(letter.message);
        let slow = |id, is_removal: bool| id == node && !is_removal && letter.to == to;
        matches!(&*message, Message::Node { id, delta, .. } if slow(*id, delta.is_empty()))
            && (world.letters.len() > 1 || !self.is_finished(world))
    }

    fn is_finished(&self, world: &World) -> bool {
        let mut plays = self.setup.plays.iter().zip(world.made);
        plays.all(|(play, made)| made >= play.calls_max)
    }

    fn is_judged(&self, world: &World) -> bool {
        let quiet = || world.letters.is_empty() && self.has_joined(world);
        match self.setup.when {
            When::Always => true,
            When::Quiet => quiet(),
            When::Finished => quiet() && self.is_finished(world),
        }
    }
}

impl Space for Network {
    type Node = Moment;
    type Event = Event;
    type Fault = Breach;

    fn start(&self) -> Moment {
        self.start
    }

    fn successors(&mut self, at: &Moment, out: &mut Vec<(Event, Moment)>) -> Result<(), Breach> {
        let world = self.worlds.get(at.0);
        for who in 0..self.setup.replicas() {
            if self.replicas.get(world.replicas[who]).crash.is_none() {
                self.calls(&world, who, out);
            }
        }
        self.arrivals(&world, out);
        self.joining(&world, out);
        self.restart(&world, out);
        Ok(())
    }

    fn judge(&mut self, at: &Moment) -> Result<(), Breach> {
        let world = self.worlds.get(at.0);
        if !self.is_judged(&world) {
            return Ok(());
        }
        self.judged += 1;
        let replicas = self.at(*at);
        let joined = self.has_joined(&world);
        let present = replicas.iter().enumerate().filter(|(at, _)| joined || Some(*at) != self.joiner());
        let present: Vec<&Replica> = present.map(|(_, replica)| &**replica).collect();
        self.setup.property.judge(&present)
    }

    fn depth(&self, at: &Moment) -> usize {
        self.worlds.get(at.0).depth().into()
    }

    fn states_judged(&self) -> u64 {
        self.judged
    }

    fn witnessed(&self) -> usize {
        0
    }
}
