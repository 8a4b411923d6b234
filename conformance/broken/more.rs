//! Joins that are none, and orders that mean nothing.

use dsr_conformance::adapter::{Adapter, Core};
use dsr_conformance::protocol::{
    CaseBegin, Decline, Deliver, Hello, HelloReply, MadeDelta, Mutate, Read, Shown,
};
use std::time::Duration;

/// Observes only, and passes on to the core what is not said otherwise.
macro_rules! observes {
    ($($method:ident($argument:ty) -> $result:ty;)*) => {
        fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline> {
            let reply = self.0.hello(hello)?;
            let features = reply.features.into_iter().filter(|name| name == "repairs" || name == "dictionary");
            Ok(HelloReply { profiles: vec!["observe".into()], features: features.collect(), ..reply })
        }

        $(fn $method(&mut self, argument: &$argument) -> Result<$result, Decline> {
            self.0.$method(argument)
        })*
    };
}

/// Takes what a delta holds and forgets which dots its sender has seen: removals do not travel.
pub(super) struct Contextless(pub(super) Core);

impl Adapter for Contextless {
    observes! {
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        read(Read) -> Shown;
    }

    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline> {
        let name = dsr_conformance::protocol::DeltaName { delta: deliver.delta.clone() };
        let mut state = self.0.delta(&name)?.state;
        let held: Vec<String> =
            state["store"].as_object().map(|store| store.keys().cloned().collect()).unwrap_or_default();
        let mut context = serde_json::Map::new();
        for dot in &held {
            let (replica, number) = dot.rsplit_once('.').unwrap_or((dot, ""));
            let entry = context.entry(replica.to_owned()).or_insert_with(|| "".into());
            let before = entry.as_str().unwrap_or_default().to_owned();
            *entry = if before.is_empty() { number.into() } else { format!("{before},{number}").into() };
        }
        state["context"] = context.into();
        // What is no state any more, because its context is not written canonically, is taken as it was.
        match self.0.load(&dsr_conformance::protocol::Load { state }) {
            Ok(made) => self.0.deliver(&Deliver { replica: deliver.replica.clone(), delta: made.delta }),
            Err(_) => self.0.deliver(deliver),
        }
    }
}

/// Shows its lists in another order each time.
pub(super) struct Unordered(pub(super) Core, pub(super) usize);

impl Adapter for Unordered {
    observes! {
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
    }

    fn read(&mut self, read: &Read) -> Result<Shown, Decline> {
        let mut shown = self.0.read(read)?;
        self.1 += 1;
        let turn = |length: usize| if length == 0 { 0 } else { self.1 % length };
        let (edges, hung) = (turn(shown.view.edges.len()), turn(shown.view.hung.len()));
        shown.view.edges.rotate_left(edges);
        shown.view.hung.rotate_left(hung);
        if let Some(repairs) = &mut shown.view.repairs {
            repairs.reverse();
        }
        Ok(shown)
    }
}

/// Takes its time for each view.
pub(super) struct Slow(pub(super) Core, pub(super) Duration);

impl Adapter for Slow {
    observes! {
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
    }

    fn read(&mut self, read: &Read) -> Result<Shown, Decline> {
        std::thread::sleep(self.1);
        self.0.read(read)
    }
}
