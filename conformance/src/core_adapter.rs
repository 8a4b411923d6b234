//! The core as an adapter.

mod handles;
mod shown;

use crate::adapter::Adapter;
use crate::protocol::{
    AnswerFor, CaseBegin, Decline, Deliver, ErrorCode, ErrorReply, Feature, Hello, HelloReply,
    Implementation, LINE_BYTES_MAX, Limits, MadeDelta, Mutate, OBSERVE, PROTOCOL, Read, ReplicaName, Restart,
    Shown,
};
use dsr_core::{Author, Delta, Dictionary, ReplicaId, State, delta_for, digest, view};
use handles::Handles;
use std::collections::BTreeMap;

const REPLICAS_MAX: usize = 64;

/// The reference core, `dsr-core`, as an adapter with every feature. `[spec: CONF-4]`
#[derive(Debug, Default)]
pub struct Core {
    dictionary: Dictionary,
    replicas: BTreeMap<ReplicaName, Replica>,
    handles: Handles,
    deltas: Vec<Delta>,
}

#[derive(Debug)]
struct Replica {
    id: ReplicaId,
    state: State,
}

fn refused(message: String, kind: Option<String>) -> Decline {
    Decline::Error(ErrorReply { code: ErrorCode::Refused, message, kind })
}

impl Core {
    fn replica(&mut self, name: &str) -> Result<&mut Replica, Decline> {
        let unknown = || Decline::error(ErrorCode::Unknown, format!("no replica {name:?} in this case"));
        self.replicas.get_mut(name).ok_or_else(unknown)
    }

    fn keep(&mut self, delta: Delta) -> MadeDelta {
        self.deltas.push(delta);
        MadeDelta { delta: format!("d{}", self.deltas.len()) }
    }

    fn delta(&self, handle: &str) -> Result<&Delta, Decline> {
        let number = handle.strip_prefix('d').and_then(|number| number.parse::<usize>().ok());
        let found = number.and_then(|number| self.deltas.get(number.checked_sub(1)?));
        found.ok_or_else(|| Decline::error(ErrorCode::Unknown, format!("no delta {handle:?} in this case")))
    }
}

impl Adapter for Core {
    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline> {
        if !hello.protocols.contains(&PROTOCOL) {
            let message =
                format!("protocols {:?} are offered; this adapter speaks {PROTOCOL}", hello.protocols);
            return Err(Decline::error(ErrorCode::Unsupported, message));
        }
        Ok(HelloReply {
            protocol: PROTOCOL,
            implementation: Implementation {
                name: "dsr-core".into(),
                version: env!("CARGO_PKG_VERSION").into(),
                language: "Rust".into(),
                source: "crdt-core".into(),
            },
            profiles: vec![OBSERVE.into()],
            features: Feature::ALL.iter().map(|feature| feature.name().into()).collect(),
            limits: Limits { line_bytes: LINE_BYTES_MAX, replicas: REPLICAS_MAX },
        })
    }

    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline> {
        *self = Self { dictionary: case.dictionary.clone().unwrap_or_default(), ..Self::default() };
        if case.replicas.len() > REPLICAS_MAX {
            let message = format!("{} replicas; the limit is {REPLICAS_MAX}", case.replicas.len());
            return Err(Decline::error(ErrorCode::RejectedInput, message));
        }
        for (name, agent) in case.replicas.iter().zip(1..) {
            let replica = Replica { id: ReplicaId::agent(agent), state: State::new() };
            if self.replicas.insert(name.clone(), replica).is_some() {
                return Err(Decline::error(ErrorCode::RejectedInput, format!("two replicas {name:?}")));
            }
        }
        Ok(())
    }

    fn mutate(&mut self, mutate: &Mutate) -> Result<MadeDelta, Decline> {
        let replica = self.replica(&mutate.replica)?;
        let (author, mut state) = (Author::new(replica.id), replica.state.clone());
        let mut handles = self.handles.clone();
        let mut whole = Delta::new();
        for mutation in &mutate.mutations {
            let shown = view(&state, &self.dictionary);
            let resolved = handles.resolve(mutation, &shown, author.replica)?;
            let made = resolved.delta(&shown, author);
            let delta = made.map_err(|error| refused(error.to_string(), Some(error.kind())))?;
            state.join(&delta);
            whole.join(&delta);
        }
        self.handles = handles;
        self.replica(&mutate.replica)?.state = state;
        Ok(self.keep(whole))
    }

    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline> {
        let delta = self.delta(&deliver.delta)?.clone();
        self.replica(&deliver.replica)?.state.join(&delta);
        Ok(())
    }

    fn read(&mut self, read: &Read) -> Result<Shown, Decline> {
        let state = self.replica(&read.replica)?.state.clone();
        Ok(Shown { view: shown::shown(&view(&state, &self.dictionary), &self.handles) })
    }

    fn restart(&mut self, restart: &Restart) -> Result<(), Decline> {
        let replica = self.replica(&restart.replica)?;
        let none = || refused(format!("{} has used up its incarnations", replica.id), None);
        replica.id = replica.id.next_incarnation().ok_or_else(none)?;
        if !restart.keeps {
            replica.state = State::new();
        }
        Ok(())
    }

    fn resynchronise(&mut self, answer: &AnswerFor) -> Result<MadeDelta, Decline> {
        let theirs = digest(&self.replica(&answer.to)?.state);
        let delta = delta_for(&self.replica(&answer.from)?.state, &theirs);
        Ok(self.keep(delta))
    }

    fn end(&mut self) {
        *self = Self::default();
    }
}
