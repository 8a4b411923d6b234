//! Where nothing is concurrent, every library shows what the core shows, and refuses what it refuses.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

mod common;

use common::Dice;
use dsr_conformance::adapter::{Adapter, Core};
use dsr_conformance::protocol::{
    AnswerFor, CaseBegin, Decline, Deliver, Hello, HelloReply, MadeDelta, Mutate, Mutation, ROOT, Read,
    Restart, Shown, View,
};
use dsr_core::{Dictionary, Value};
use dsr_peers::published_graph::Upstream;
use dsr_peers::replica::Replica;
use dsr_peers::{AutomergeGraph, LoroGraph, Peer, PublishedGraph, YrsGraph};

const REPLICAS: [&str; 2] = ["a", "b"];
const SEEDS: u64 = 40;
const STEPS: usize = 60;

fn kind(decline: Decline) -> (String, Option<String>) {
    match decline {
        Decline::Error(error) => (format!("{:?}", error.code), error.kind),
        Decline::Skip(skip) => (skip.reason, None),
    }
}

fn shown(adapter: &mut dyn Adapter, replica: &str) -> View {
    let view = adapter.read(&Read { replica: replica.into() }).unwrap().view;
    View { repairs: None, ..view.canonical() }
}

/// What a walk may use.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Powers {
    /// Everything.
    All,
    /// No restart, no dictionary, and one author: in the published system, whose attribute another one removes does not
    /// hear of it, even in turns.
    One,
}

/// One walk: each mutation reaches the other replica before the next one is made. Returns how many were made, and how
/// many refused; or how the adapter differs from the core.
fn walk(peer: &mut dyn Adapter, seed: u64, powers: Powers) -> Result<(usize, usize), String> {
    let mut core = Core::default();
    let mut dice = Dice::new(seed);
    let dictionary =
        (powers == Powers::All && seed.is_multiple_of(2)).then(|| Dictionary::open().with_functional("in"));
    let replicas = REPLICAS.iter().map(|&name| name.into()).collect();
    let case = CaseBegin { case: format!("walk/{seed}"), replicas, dictionary };
    core.begin(&case).unwrap();
    peer.begin(&case).unwrap();
    let mut handles = vec![ROOT.to_owned()];
    let (mut made, mut refused) = (0, 0);
    for step in 0..STEPS {
        let at = if powers == Powers::All { dice.below(2) } else { 0 };
        let (author, other) = (REPLICAS[at], REPLICAS[1 - at]);
        if dice.below(12) == 0 && powers == Powers::All {
            let restart = Restart { replica: author.into(), keeps: dice.below(2) == 0 };
            let answer = AnswerFor { from: other.into(), to: author.into() };
            for adapter in [&mut core as &mut dyn Adapter, &mut *peer] {
                adapter.restart(&restart).unwrap();
                let delta = adapter.resynchronise(&answer).unwrap().delta;
                adapter.deliver(&Deliver { replica: author.into(), delta }).unwrap();
            }
        }
        let view = shown(&mut core, author);
        let names: Vec<&str> = handles.iter().map(String::as_str).collect();
        let mutations: Vec<Mutation> = (0..=dice.below(2))
            .map(|part| dice.mutation(&names, &view, &format!("v{step}-{part}")))
            .collect();
        let mutate = Mutate { replica: author.into(), mutations };
        let place = format!("seed {seed}, step {step}: {mutate:?}");
        match (core.mutate(&mutate), peer.mutate(&mutate)) {
            (Ok(by_core), Ok(by_peer)) => {
                made += 1;
                core.deliver(&Deliver { replica: other.into(), delta: by_core.delta }).unwrap();
                peer.deliver(&Deliver { replica: other.into(), delta: by_peer.delta }).unwrap();
                handles.extend(mutate.mutations.into_iter().filter_map(|mutation| match mutation {
                    Mutation::AddVertex { r#as, .. } => Some(r#as),
                    _ => None,
                }));
            }
            (Err(by_core), Err(by_peer)) => {
                refused += 1;
                let (by_peer, by_core) = (kind(by_peer), kind(by_core));
                if by_peer != by_core {
                    return Err(format!("{place}: {by_peer:?}, where the core says {by_core:?}"));
                }
            }
            (by_core, by_peer) => {
                return Err(format!("{place}: {by_peer:?}, where the core says {by_core:?}"));
            }
        }
        for replica in REPLICAS {
            let (found, expected) = (shown(peer, replica), shown(&mut core, replica));
            if found != expected {
                return Err(format!("{place}: {replica} shows {found:?}, and with the core {expected:?}"));
            }
        }
    }
    Ok((made, refused))
}

fn walks<R: Replica>(powers: Powers) {
    let (mut made, mut refused) = (0, 0);
    for seed in 0..SEEDS {
        println!("seed {seed}");
        let counts = walk(&mut Peer::<R>::default(), seed, powers).unwrap();
        (made, refused) = (made + counts.0, refused + counts.1);
    }
    println!("{made} made, {refused} refused");
    assert!(made > 200 && refused > 200);
}

#[test]
fn differential_automerge_shows_what_the_core_shows_in_sequence() {
    walks::<AutomergeGraph>(Powers::All);
}

#[test]
fn differential_loro_shows_what_the_core_shows_in_sequence() {
    walks::<LoroGraph>(Powers::All);
}

#[test]
fn differential_yrs_shows_what_the_core_shows_in_sequence() {
    walks::<YrsGraph>(Powers::All);
}

#[test]
fn differential_the_published_system_shows_what_the_core_shows_in_sequence() {
    walks::<PublishedGraph<Upstream>>(Powers::One);
}

/// The core, but every integer of a vertex is shown one too great.
struct OffByOne(Core);

impl Adapter for OffByOne {
    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline> {
        self.0.hello(hello)
    }

    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline> {
        self.0.begin(case)
    }

    fn mutate(&mut self, mutate: &Mutate) -> Result<MadeDelta, Decline> {
        self.0.mutate(mutate)
    }

    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline> {
        self.0.deliver(deliver)
    }

    fn restart(&mut self, restart: &Restart) -> Result<(), Decline> {
        self.0.restart(restart)
    }

    fn resynchronise(&mut self, answer: &AnswerFor) -> Result<MadeDelta, Decline> {
        self.0.resynchronise(answer)
    }

    fn read(&mut self, read: &Read) -> Result<Shown, Decline> {
        let mut shown = self.0.read(read)?;
        for vertex in shown.view.vertices.0.values_mut() {
            for value in vertex.attributes.0.values_mut() {
                if let Value::Int(number) = &mut value.0 {
                    *number += 1;
                }
            }
        }
        Ok(shown)
    }
}

#[test]
fn canary_a_difference_is_found() {
    assert!((0..SEEDS).any(|seed| walk(&mut OffByOne(Core::default()), seed, Powers::All).is_err()));
    assert!((0..SEEDS).all(|seed| walk(&mut Core::default(), seed, Powers::All).is_ok()));
}
