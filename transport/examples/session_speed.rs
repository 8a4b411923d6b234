//! What the protocol itself costs: two sessions in one thread, handing each other their datagrams.
//!
//! `cargo run --release -p dsr-transport --example session_speed`

use dsr_core::{
    AttributeUpdates, Dictionary, ElementId, Mutation, NewVertex, ReplicaId, Value, VertexId, VertexLink,
};
use dsr_transport::{Action, Address, Config, Event, MS, Session};
use std::time::Instant;

/// Two sessions that have met, at a time.
struct Pair {
    sessions: [Session; 2],
    now: u64,
    datagrams: u64,
}

impl Pair {
    fn new() -> Self {
        let session = |agent: u32| {
            let name = if agent == 1 { "one" } else { "two" };
            let mut config =
                Config::new(ReplicaId::agent(agent), agent.into(), name, "speed", Dictionary::open());
            config.bounds.bytes_per_second = u64::MAX;
            config.bounds.burst_bytes = u64::MAX;
            Session::new(config, agent.into(), 0)
        };
        let mut pair = Self { sessions: [session(1), session(2)], now: 0, datagrams: 0 };
        for _ in 0..500 {
            pair.now += MS;
            pair.tick();
        }
        pair
    }

    fn tick(&mut self) {
        for session in &mut self.sessions {
            session.handle(Event::Tick, self.now);
        }
        self.exchange();
    }

    /// Hands over datagrams until nobody sends any.
    fn exchange(&mut self) {
        let mut quiet = false;
        while !quiet {
            quiet = true;
            for from in 0..2 {
                while let Some(action) = self.sessions[from].poll_action() {
                    quiet = false;
                    if let Action::Send { bytes, .. } = action {
                        self.datagrams += 1;
                        let address = Address { host: from as u128, port: 1 };
                        self.sessions[1 - from]
                            .handle(Event::Datagram { from: address, bytes: &bytes }, self.now);
                    }
                }
            }
        }
    }
}

#[allow(clippy::cast_precision_loss, reason = "to be read by people")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut pair = Pair::new();
    let vertex = NewVertex::new("robot", "shadow");
    let add = Mutation::AddVertex { vertex, link: VertexLink::child_of(VertexId::ROOT) };
    pair.sessions[0].mutate(&add, 0, pair.now)?;
    let target = pair.sessions[0].snapshot().vertex_by_name("shadow").ok_or("no robot")?;
    let write = |name: &str, value: Value| Mutation::UpdateAttributes {
        target: ElementId::Vertex(target),
        updates: AttributeUpdates::from([(name.into(), Some(value))]),
    };
    for (what, at_once, count) in [("one at a time", 1, 100_000_u32), ("a hundred at once", 100, 100_000)] {
        let (begun, before) = (Instant::now(), pair.datagrams);
        for at in 0..count {
            pair.sessions[0].mutate(&write("level", Value::UInt(at)), 0, pair.now)?;
            if at % at_once == at_once - 1 {
                pair.now += MS / 100;
                pair.exchange();
            }
        }
        let micros = begun.elapsed().as_secs_f64() * 1e6 / f64::from(count);
        println!(
            "small updates, {what}: {micros:.2} µs each from mutation to the peer's event, {:.3} datagrams each",
            (pair.datagrams - before) as f64 / f64::from(count)
        );
    }
    for bytes in [60_000, 1_000_000, 5_000_000] {
        let value = Value::ByteVec(vec![7; bytes].into());
        let (begun, rounds) = (Instant::now(), 10);
        for _ in 0..rounds {
            pair.sessions[0].mutate(&write("image", value.clone()), 0, pair.now)?;
            pair.now += MS;
            pair.exchange();
        }
        let millis = begun.elapsed().as_secs_f64() * 1e3 / f64::from(rounds);
        println!("an image of {bytes} bytes: {millis:.2} ms in datagrams of 1400 bytes");
    }
    for _ in 0..3000 {
        pair.now += MS;
        pair.tick();
    }
    let [one, two] = &pair.sessions;
    assert_eq!(one.replica().fingerprint(), two.replica().fingerprint());
    Ok(())
}
