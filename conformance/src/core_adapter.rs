//! The core as an adapter, and whatever differs from it in an [`Engine`].

mod engine;
mod handles;
mod outside;
mod shown;

use crate::adapter::{Adapter, Kept, no_replica, shake};
use crate::protocol::{
    AnswerDigest, AnswerFor, BytesShown, CaseBegin, Decline, Decode, Deliver, DeltaName, DigestShown,
    ErrorCode, ErrorReply, Feature, Found, Group, Hello, HelloReply, Hex, Implementation, LINE_BYTES_MAX,
    Limits, Load, Lookup, MadeDelta, Mutate, Profile, Read, ReplicaName, Restart, Shown, StateShown,
};
use dsr_core::{
    Author, DecodeError, Delta, Dictionary, Shows, State, decode, decode_digest, delta_for, digest, encode,
    encode_digest, fingerprint, view,
};
pub use engine::{Engine, Plain, Refusal};
pub(crate) use handles::Handles;
pub(crate) use shown::shown;
use std::collections::BTreeMap;

/// The reference core, `dsr-core`, as an adapter with every feature and profile. `[spec: CONF-4]`
pub type Core = CoreAdapter<Plain>;

/// An engine as an adapter: the states are those of the core, what becomes of them is the engine's matter.
#[derive(Debug, Default)]
pub struct CoreAdapter<E> {
    engine: E,
    dictionary: Dictionary,
    replicas: BTreeMap<ReplicaName, Replica>,
    handles: Handles,
    deltas: Kept<Delta>,
}

#[derive(Debug)]
struct Replica {
    /// Its place in the case, counted from 0.
    place: u32,
    incarnation: u32,
    state: State,
}

fn refused(message: String, kind: Option<String>) -> Decline {
    Decline::Error(ErrorReply { code: ErrorCode::Refused, message, kind })
}

fn no_json(error: &serde_json::Error) -> Decline {
    Decline::error(ErrorCode::Internal, error.to_string())
}

fn undecodable(error: &DecodeError) -> Decline {
    let kind = match error {
        DecodeError::Malformed(malformed) => Some(malformed.kind().into()),
        _ => None,
    };
    refused(error.to_string(), kind)
}

impl<E: Engine> CoreAdapter<E> {
    /// An adapter of this engine.
    pub fn of(engine: E) -> Self {
        Self {
            engine,
            dictionary: Dictionary::default(),
            replicas: BTreeMap::new(),
            handles: Handles::default(),
            deltas: Kept::default(),
        }
    }

    fn replica(&mut self, name: &str) -> Result<&mut Replica, Decline> {
        self.replicas.get_mut(name).ok_or_else(|| no_replica(name))
    }

    fn state_of(&self, name: &str) -> Result<&State, Decline> {
        self.replicas.get(name).map(|replica| &replica.state).ok_or_else(|| no_replica(name))
    }
}

impl<E: Engine> Adapter for CoreAdapter<E> {
    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline> {
        let implementation = Implementation {
            name: self.engine.name(),
            version: env!("CARGO_PKG_VERSION").into(),
            language: "Rust".into(),
            source: "crdt-core".into(),
        };
        let limits = Limits { line_bytes: LINE_BYTES_MAX, replicas: E::REPLICAS_MAX };
        shake(hello, implementation, &Profile::ALL, &Feature::ALL, limits)
    }

    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline> {
        self.dictionary = case.dictionary.clone().unwrap_or_default();
        self.replicas.clear();
        self.handles = Handles::default();
        self.deltas = Kept::default();
        if case.replicas.len() > E::REPLICAS_MAX {
            let message = format!("{} replicas; the limit is {}", case.replicas.len(), E::REPLICAS_MAX);
            return Err(Decline::error(ErrorCode::RejectedInput, message));
        }
        for (name, place) in case.replicas.iter().zip(0..) {
            let replica = Replica { place, incarnation: 0, state: State::new() };
            if self.replicas.insert(name.clone(), replica).is_some() {
                return Err(Decline::error(ErrorCode::RejectedInput, format!("two replicas {name:?}")));
            }
        }
        Ok(())
    }

    fn mutate(&mut self, mutate: &Mutate) -> Result<MadeDelta, Decline> {
        let replica = self.replicas.get(&mutate.replica).ok_or_else(|| no_replica(&mutate.replica))?;
        let id = self.engine.identity(replica.place, replica.incarnation);
        let (author, mut state) = (Author::new(id), replica.state.clone());
        let mut handles = self.handles.clone();
        let mut whole = Delta::new();
        for mutation in &mutate.mutations {
            let seen = view(&state, &self.dictionary);
            let resolved = handles.resolve(mutation, &seen, author.replica)?;
            let made = self.engine.mutate(&seen, author, &resolved);
            let (delta, after) = made.map_err(|refusal| refused(refusal.message, refusal.kind))?;
            state = after;
            self.engine.join(&mut whole, &delta);
        }
        self.handles = handles;
        self.replica(&mutate.replica)?.state = state;
        Ok(self.deltas.keep(whole))
    }

    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline> {
        let delta = self.deltas.get(&deliver.delta)?;
        let replica = self.replicas.get_mut(&deliver.replica);
        let replica = replica.ok_or_else(|| no_replica(&deliver.replica))?;
        self.engine.join(&mut replica.state, delta);
        Ok(())
    }

    fn read(&mut self, read: &Read) -> Result<Shown, Decline> {
        let replica = self.replicas.get(&read.replica).ok_or_else(|| no_replica(&read.replica))?;
        let view = view(&replica.state, &self.dictionary);
        let view = self.engine.show(&view, replica.place, &mut |shows| shown(shows, &self.handles));
        Ok(Shown { view })
    }

    fn group(&mut self, group: &Group) -> Result<MadeDelta, Decline> {
        let mut whole = Delta::new();
        for delta in &group.deltas {
            self.engine.join(&mut whole, self.deltas.get(delta)?);
        }
        Ok(self.deltas.keep(whole))
    }

    fn lookup(&mut self, lookup: &Lookup) -> Result<Found, Decline> {
        let replica = self.replicas.get(&lookup.replica).ok_or_else(|| no_replica(&lookup.replica))?;
        let view = view(&replica.state, &self.dictionary);
        let find = &mut |shows: &dyn Shows| shows.vertex_by_name(&lookup.name);
        let vertex = self.engine.show(&view, replica.place, find);
        Ok(Found { vertex: vertex.map(|id| self.handles.name(id)) })
    }

    fn restart(&mut self, restart: &Restart) -> Result<(), Decline> {
        let replica = self.replica(&restart.replica)?;
        let none = || refused(format!("{:?} has used up its incarnations", restart.replica), None);
        replica.incarnation = replica.incarnation.checked_add(1).ok_or_else(none)?;
        if !restart.keeps {
            replica.state = State::new();
        }
        Ok(())
    }

    fn resynchronise(&mut self, answer: &AnswerFor) -> Result<MadeDelta, Decline> {
        let (ours, theirs) = (self.state_of(&answer.from)?, self.state_of(&answer.to)?);
        let delta = self.engine.answer(ours, theirs);
        Ok(self.deltas.keep(delta))
    }

    fn state(&mut self, read: &Read) -> Result<StateShown, Decline> {
        let state = serde_json::to_value(self.state_of(&read.replica)?);
        Ok(StateShown { state: state.map_err(|error| no_json(&error))? })
    }

    fn delta(&mut self, delta: &DeltaName) -> Result<StateShown, Decline> {
        let state = serde_json::to_value(self.deltas.get(&delta.delta)?);
        Ok(StateShown { state: state.map_err(|error| no_json(&error))? })
    }

    fn digest(&mut self, read: &Read) -> Result<DigestShown, Decline> {
        let digest = serde_json::to_value(digest(self.state_of(&read.replica)?));
        Ok(DigestShown { digest: digest.map_err(|error| no_json(&error))? })
    }

    fn load(&mut self, load: &Load) -> Result<MadeDelta, Decline> {
        let delta = outside::state(&load.state).map_err(|(why, kind)| refused(why, kind))?;
        Ok(self.deltas.keep(delta))
    }

    fn encode(&mut self, delta: &DeltaName) -> Result<BytesShown, Decline> {
        Ok(BytesShown { bytes: Hex(encode(self.deltas.get(&delta.delta)?)) })
    }

    fn encode_digest(&mut self, read: &Read) -> Result<BytesShown, Decline> {
        Ok(BytesShown { bytes: Hex(encode_digest(&digest(self.state_of(&read.replica)?))) })
    }

    fn fingerprint(&mut self, read: &Read) -> Result<BytesShown, Decline> {
        let fingerprint = fingerprint(self.state_of(&read.replica)?);
        Ok(BytesShown { bytes: Hex(fingerprint.0.to_be_bytes().to_vec()) })
    }

    fn decode(&mut self, given: &Decode) -> Result<MadeDelta, Decline> {
        let delta = decode(&given.bytes.0).map_err(|error| undecodable(&error))?;
        Ok(self.deltas.keep(delta))
    }

    fn answer_digest(&mut self, answer: &AnswerDigest) -> Result<MadeDelta, Decline> {
        let theirs = decode_digest(&answer.bytes.0).map_err(|error| undecodable(&error))?;
        let delta = delta_for(self.state_of(&answer.from)?, &theirs);
        Ok(self.deltas.keep(delta))
    }
}
