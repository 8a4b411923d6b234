//! A few sessions over a network in memory, under the hand of a test.
#![allow(dead_code, unreachable_pub, missing_debug_implementations, reason = "each test uses its own part")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use dsr_core::{Dictionary, Mutation, NewVertex, ReplicaId, VertexId, VertexLink};
use dsr_transport::memory::{Faults, Network};
use dsr_transport::wire::{Datagram, Item, group_key};
use dsr_transport::{Action, Config, Destination, Event, MS, Session};

/// Which datagrams are let through: from which port, whereto, what.
pub type Filter = Box<dyn FnMut(usize, Destination, &Datagram) -> bool>;

pub struct Lab {
    pub now: u64,
    pub network: Network,
    pub sessions: Vec<Option<Session>>,
    /// Everything but datagrams, with the port and the time.
    pub told: Vec<(u64, usize, Action)>,
    /// Every datagram that was sent.
    pub sent: Vec<(u64, usize, Destination, Datagram, usize)>,
    pub filter: Filter,
    /// What happens to the next datagrams, one after the other; then all is well.
    pub fates: std::collections::VecDeque<Fate>,
}

/// What happens to a datagram.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    Arrives,
    IsLost,
    ComesTwice,
    /// After so many milliseconds.
    IsLate(u64),
}

pub fn config(agent: u32) -> Config {
    Config::new(
        ReplicaId::agent(agent),
        1000 + u64::from(agent),
        &format!("a{agent}"),
        "lab",
        Dictionary::open(),
    )
}

pub fn room(name: &str) -> Mutation {
    Mutation::AddVertex { vertex: NewVertex::new("room", name), link: VertexLink::child_of(VertexId::ROOT) }
}

pub fn image(name: &str, bytes: usize) -> Mutation {
    let mut vertex = NewVertex::new("image", name);
    let pixels: Vec<u8> = (0..bytes).map(|at| at.to_le_bytes()[0]).collect();
    vertex.attributes.insert("pixels".into(), dsr_core::Value::ByteVec(pixels.into()));
    Mutation::AddVertex { vertex, link: VertexLink::child_of(VertexId::ROOT) }
}

impl Lab {
    /// Ports without sessions.
    pub fn new(ports: usize, faults: Faults) -> Self {
        Self {
            now: 0,
            network: Network::new(ports, 1, faults),
            sessions: vec![None; ports],
            told: Vec::new(),
            sent: Vec::new(),
            filter: Box::new(|_, _, _| true),
            fates: [].into(),
        }
    }

    /// Agents 1, 2, … that have claimed their ids and met.
    pub fn of(agents: u32) -> Self {
        let mut lab = Self::new(agents as usize + 1, Faults::NONE);
        for agent in 1..=agents {
            lab.start(agent as usize - 1, config(agent));
        }
        lab.pass(400);
        lab
    }

    pub fn start(&mut self, port: usize, config: Config) {
        let seed = 7 * port as u64 + config.nonce;
        self.sessions[port] = Some(Session::new(config, seed, self.now));
        self.drain(port);
    }

    pub fn session(&mut self, port: usize) -> &mut Session {
        self.sessions[port].as_mut().unwrap()
    }

    pub fn mutate(&mut self, port: usize, mutation: &Mutation) {
        let now = self.now;
        self.session(port).mutate(mutation, 0, now).unwrap();
        self.drain(port);
    }

    pub fn drain(&mut self, port: usize) {
        let now = self.now;
        let Some(session) = &mut self.sessions[port] else { return };
        while let Some(action) = session.poll_action() {
            if let Action::Send { to, bytes } = action {
                let read = Datagram::decode(&bytes, group_key("lab")).unwrap();
                let passes = (self.filter)(port, to, &read);
                self.sent.push((now, port, to, read, bytes.len()));
                if !passes {
                    continue;
                }
                match self.fates.pop_front().unwrap_or(Fate::Arrives) {
                    Fate::Arrives => self.network.send(port, to, bytes, now),
                    Fate::IsLost => {}
                    Fate::ComesTwice => {
                        self.network.send(port, to, bytes.clone(), now);
                        self.network.send(port, to, bytes, now + 2 * MS);
                    }
                    Fate::IsLate(ms) => self.network.send(port, to, bytes, now + ms * MS),
                }
            } else {
                self.told.push((now, port, action));
            }
        }
    }

    /// Lets so many milliseconds pass.
    pub fn pass(&mut self, ms: u64) {
        let until = self.now + ms * MS;
        loop {
            let wakes = self.sessions.iter().flatten().filter_map(Session::next_wake);
            let next = self.network.next().into_iter().chain(wakes).min().unwrap_or(until).max(self.now);
            if next > until {
                break;
            }
            self.now = next;
            while let Some((port, from, bytes)) = self.network.arrive(self.now) {
                if let Some(session) = &mut self.sessions[port] {
                    session.handle(Event::Datagram { from, bytes: &bytes }, self.now);
                    self.drain(port);
                }
            }
            for port in 0..self.sessions.len() {
                if let Some(session) = &mut self.sessions[port]
                    && session.next_wake().is_some_and(|wake| wake <= self.now)
                {
                    session.handle(Event::Tick, self.now);
                    self.drain(port);
                }
            }
            self.now += 1000;
        }
        self.now = until;
    }

    pub fn are_equal(&self) -> bool {
        let mut prints = self.sessions.iter().flatten().map(|session| session.replica().encode());
        let first = prints.next();
        prints.all(|print| Some(print) == first)
    }

    /// The items sent that fit.
    pub fn items(&self, fits: impl Fn(&Item) -> bool) -> usize {
        self.sent.iter().flat_map(|sent| &sent.3.items).filter(|item| fits(item)).count()
    }
}
