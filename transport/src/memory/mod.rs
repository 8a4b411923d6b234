//! A network in memory: seeded, in virtual time, with every fault that the contract allows. `[spec: LINK-1]`
//!
//! It knows nothing of what it carries. Ports are numbered from 0; a partition is a set of ports, and only within
//! it, or within the rest, does anything arrive.

mod faults;

pub use faults::Faults;

use crate::origin::{Address, Destination};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// What the network has done, counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Traffic {
    /// Datagrams given to it.
    pub sent: u64,
    /// Their bytes, once each, however many get them.
    pub bytes: u64,
    /// Deliveries.
    pub delivered: u64,
    /// Deliveries that were left out at random.
    pub lost: u64,
    /// Deliveries that were left out by a partition.
    pub cut: u64,
    /// Deliveries that were made twice.
    pub duplicated: u64,
    /// Deliveries that were damaged.
    pub damaged: u64,
    /// Deliveries that overtook an earlier one to the same port.
    pub reordered: u64,
    /// Deliveries for which a slow reader had no room.
    pub overflowed: u64,
}

/// A datagram on its way.
#[derive(Clone, Debug)]
struct Flight {
    to: usize,
    from: Address,
    bytes: Arc<[u8]>,
    order: u64,
}

/// One that reads.
#[derive(Clone, Debug, Default)]
struct Port {
    open: bool,
    side: bool,
    slow_until: u64,
    waiting: VecDeque<(Address, Arc<[u8]>)>,
    last_order: u64,
}

/// The network.
#[derive(Clone, Debug)]
pub struct Network {
    random: ChaCha8Rng,
    /// What happens to what is sent from now on.
    pub faults: Faults,
    flights: BTreeMap<(u64, u64), Flight>,
    order: u64,
    ports: Vec<Port>,
    traffic: Traffic,
}

impl Network {
    /// A network of so many ports, all open, all connected.
    pub fn new(ports: usize, seed: u64, faults: Faults) -> Self {
        let open = Port { open: true, ..Port::default() };
        Self {
            random: ChaCha8Rng::seed_from_u64(seed),
            faults,
            flights: BTreeMap::new(),
            order: 0,
            ports: vec![open; ports],
            traffic: Traffic::default(),
        }
    }

    /// The address of a port.
    pub fn address(port: usize) -> Address {
        Address { host: 1, port: u16::try_from(port).unwrap_or(u16::MAX) }
    }

    /// What it has done.
    pub fn traffic(&self) -> Traffic {
        self.traffic
    }

    /// Opens a port, or closes it: what arrives at a closed one is gone.
    pub fn open(&mut self, port: usize, open: bool) {
        if let Some(port) = self.ports.get_mut(port) {
            port.open = open;
            port.waiting.clear();
        }
    }

    /// Cuts the network in two: the ports whose bit is set, and the others; 0 heals it.
    pub fn partition(&mut self, side: u64) {
        for (at, port) in self.ports.iter_mut().enumerate() {
            port.side = side >> (at % 64) & 1 == 1;
        }
    }

    /// Lets a port read nothing until then; what arrives waits, as far as there is room.
    pub fn slow(&mut self, port: usize, until: u64) {
        if let Some(port) = self.ports.get_mut(port) {
            port.slow_until = until;
        }
    }

    /// Takes a datagram from a port.
    pub fn send(&mut self, from: usize, to: Destination, bytes: Vec<u8>, now: u64) {
        self.traffic.sent += 1;
        self.traffic.bytes += bytes.len() as u64;
        let bytes: Arc<[u8]> = bytes.into();
        for port in 0..self.ports.len() {
            let meant = match to {
                Destination::Group => true,
                Destination::Peer(address) => address == Self::address(port),
            };
            if meant {
                self.launch(from, port, &bytes, now);
            }
        }
    }

    fn launch(&mut self, from: usize, to: usize, bytes: &Arc<[u8]>, now: u64) {
        let side = |port: usize| self.ports.get(port).is_some_and(|port| port.side);
        if side(from) != side(to) {
            self.traffic.cut += 1;
            return;
        }
        // Nobody is cut off from itself.
        if from != to && self.happens(self.faults.loss) {
            self.traffic.lost += 1;
            return;
        }
        let twice = self.happens(self.faults.duplicates);
        self.traffic.duplicated += u64::from(twice);
        for _ in 0..=u8::from(twice) {
            let mut bytes = Arc::clone(bytes);
            if self.happens(self.faults.damage) {
                self.traffic.damaged += 1;
                bytes = self.damaged(&bytes);
            }
            let spread = self.faults.delay_max.saturating_sub(self.faults.delay_min);
            let delay = self.faults.delay_min + if spread == 0 { 0 } else { self.random.next_u64() % spread };
            self.order += 1;
            let flight = Flight { to, from: Self::address(from), bytes, order: self.order };
            self.flights.insert((now.saturating_add(delay), self.order), flight);
        }
    }

    fn happens(&mut self, permille: u16) -> bool {
        permille > 0 && self.random.next_u64() % 1000 < u64::from(permille)
    }

    /// A byte is changed, or the end is cut off.
    fn damaged(&mut self, bytes: &[u8]) -> Arc<[u8]> {
        let mut bytes = bytes.to_vec();
        let at = usize::try_from(self.random.next_u64()).unwrap_or(0) % bytes.len().max(1);
        if self.random.next_u64().is_multiple_of(4) {
            bytes.truncate(at);
        } else if let Some(byte) = bytes.get_mut(at) {
            *byte ^= 1 << (self.random.next_u64() % 8);
        }
        bytes.into()
    }

    /// When the next datagram arrives, or a slow reader goes on.
    pub fn next(&self) -> Option<u64> {
        let flight = self.flights.first_key_value().map(|(key, _)| key.0);
        let waiting = self.ports.iter().filter(|port| !port.waiting.is_empty()).map(|port| port.slow_until);
        flight.into_iter().chain(waiting).min()
    }

    /// What has arrived by then, one at a time: at which port, where from, what.
    pub fn arrive(&mut self, now: u64) -> Option<(usize, Address, Arc<[u8]>)> {
        for (at, port) in self.ports.iter_mut().enumerate() {
            if port.slow_until <= now
                && let Some((from, bytes)) = port.waiting.pop_front()
            {
                self.traffic.delivered += 1;
                return Some((at, from, bytes));
            }
        }
        while let Some(first) = self.flights.first_entry().filter(|first| first.key().0 <= now) {
            let Flight { to, from, bytes, order } = first.remove();
            let Some(port) = self.ports.get_mut(to).filter(|port| port.open) else { continue };
            self.traffic.reordered += u64::from(order < port.last_order);
            port.last_order = port.last_order.max(order);
            if port.slow_until <= now {
                self.traffic.delivered += 1;
                return Some((to, from, bytes));
            }
            if port.waiting.len() < self.faults.slow_room {
                port.waiting.push_back((from, bytes));
            } else {
                self.traffic.overflowed += 1;
            }
        }
        None
    }
}
