//! Who joins, and who restarts.

use super::message::Topic;
use super::setup::REPLICAS_MAX;
use super::space::{Moment, Network};
use super::world::{Event, Letter, Restarted, World};

impl Network {
    pub(super) fn joiner(&self) -> Option<usize> {
        self.setup.powers.joiner.as_ref().map(|joiner| joiner.replica)
    }

    /// Whether messages go from one to the other.
    pub(super) fn hears(&self, world: &World, from: usize, to: usize) -> bool {
        match self.joiner() {
            Some(joiner) if joiner == from => world.heard >> to & 1 == 1,
            Some(joiner) if joiner == to => world.heard >> from & 1 == 1,
            _ => true,
        }
    }

    /// Whether who joins has got its graph, or is told so, and hears everybody.
    pub(super) fn has_joined(&self, world: &World) -> bool {
        let Some(joiner) = &self.setup.powers.joiner else { return true };
        let mut others = (0..self.setup.replicas()).filter(|&other| other != joiner.replica);
        if joiner.again && world.restart == Restarted::Once {
            return false;
        }
        let arrived = world.letters.iter().all(|letter| letter.topic != Topic::Graph);
        world.encoded && (arrived || world.told) && others.all(|other| world.heard >> other & 1 == 1)
    }

    /// Whether a letter is the graph of an early joiner who has not been told yet.
    pub(super) fn waits_to_be_told(&self, world: &World, letter: Letter) -> bool {
        let early = self.setup.powers.joiner.as_ref().is_some_and(|joiner| joiner.early);
        early && !world.told && letter.topic == Topic::Graph
    }

    pub(super) fn joining(&mut self, world: &World, out: &mut Vec<(Event, Moment)>) {
        let Some(joiner) = self.setup.powers.joiner.clone() else { return };
        for replica in (0..self.setup.replicas()).filter(|&replica| replica != joiner.replica) {
            if world.heard >> replica & 1 == 0 {
                let mut next = world.clone();
                next.heard |= 1 << replica;
                self.push(next, Event::Find { replica }, out);
            }
        }
        if world.letters.iter().any(|&letter| self.waits_to_be_told(world, letter)) {
            self.push(World { told: true, ..world.clone() }, Event::Tell, out);
        }
        if joiner.again && world.encoded && world.restart == Restarted::Once {
            self.push(World { restart: Restarted::Refused, ..world.clone() }, Event::Refuse, out);
        }
        let server = self.replicas.get(world.replicas[joiner.server]);
        let asks = world.heard >> joiner.server & 1 == 1 && joiner.asks.allows(world, &server);
        if !world.encoded && asks {
            let message = server.snapshot(self.now(world, joiner.server));
            let message = self.messages.intern(message);
            let (from, to, topic) = (joiner.server, joiner.replica, Topic::Graph);
            let mut next = world.clone();
            next.encoded = true;
            next.letters.push(Letter { from, to, topic, number: 0, needs: [0; REPLICAS_MAX], message });
            self.push(next, Event::Encode, out);
        }
    }

    pub(super) fn restart(&mut self, world: &World, out: &mut Vec<(Event, Moment)>) {
        let restarts = self.setup.powers.restarts.filter(|_| world.restart == Restarted::Never);
        let Some((replica, guard)) = restarts else { return };
        if !guard.allows(world, &self.replicas.get(world.replicas[replica])) {
            return;
        }
        let mut next = world.clone();
        next.restart = Restarted::Once;
        next.replicas[replica] = self.initial[replica];
        next.letters.retain(|letter| letter.to != replica);
        self.push(next, Event::Restart { replica }, out);
    }
}
