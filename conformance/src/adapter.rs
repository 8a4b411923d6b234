//! What answers requests.

use crate::protocol::{
    Answer, AnswerDigest, AnswerFor, BytesShown, CaseBegin, Command, Decline, Decode, Deliver, DeltaName,
    DigestShown, Done, ErrorCode, Feature, Found, Group, Hello, HelloReply, Implementation, Limits, Load,
    Lookup, MadeDelta, Mutate, PROTOCOL, Profile, Read, Restart, Shown, StateShown,
};

pub use crate::core_adapter::{Core, CoreAdapter, Engine, Plain, Refusal};

/// An implementation that can be asked. `[spec: CONF-4]`
///
/// The first five methods suffice for the profile `observe`; each other is a feature, or part of a profile, and
/// declines unless it is overridden.
pub trait Adapter {
    /// The handshake.
    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline>;
    /// Begins a case with empty replicas; what there was of another one is forgotten.
    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline>;
    /// Makes mutations as one group, all or none; returns the delta's name.
    fn mutate(&mut self, mutate: &Mutate) -> Result<MadeDelta, Decline>;
    /// Joins a delta.
    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline>;
    /// What a replica shows.
    fn read(&mut self, read: &Read) -> Result<Shown, Decline>;
    /// Makes several deltas one.
    fn group(&mut self, _group: &Group) -> Result<MadeDelta, Decline> {
        Err(without("group"))
    }
    /// Which vertex a name finds.
    fn lookup(&mut self, _lookup: &Lookup) -> Result<Found, Decline> {
        Err(without("lookup"))
    }
    /// Stops a replica and starts it anew.
    fn restart(&mut self, _restart: &Restart) -> Result<(), Decline> {
        Err(without("restart"))
    }
    /// Makes the delta that one replica lacks of another.
    fn resynchronise(&mut self, _answer: &AnswerFor) -> Result<MadeDelta, Decline> {
        Err(without("answer"))
    }
    /// A replica's state.
    fn state(&mut self, _read: &Read) -> Result<StateShown, Decline> {
        Err(without("state"))
    }
    /// A delta, as the state that it is.
    fn delta(&mut self, _delta: &DeltaName) -> Result<StateShown, Decline> {
        Err(without("delta"))
    }
    /// A replica's digest.
    fn digest(&mut self, _read: &Read) -> Result<DigestShown, Decline> {
        Err(without("digest"))
    }
    /// Takes a delta from outside.
    fn load(&mut self, _load: &Load) -> Result<MadeDelta, Decline> {
        Err(without("load"))
    }
    /// A delta's bytes.
    fn encode(&mut self, _delta: &DeltaName) -> Result<BytesShown, Decline> {
        Err(without("encode"))
    }
    /// The bytes of a replica's digest.
    fn encode_digest(&mut self, _read: &Read) -> Result<BytesShown, Decline> {
        Err(without("encode_digest"))
    }
    /// A replica's fingerprint.
    fn fingerprint(&mut self, _read: &Read) -> Result<BytesShown, Decline> {
        Err(without("fingerprint"))
    }
    /// Takes the bytes of a delta from outside.
    fn decode(&mut self, _decode: &Decode) -> Result<MadeDelta, Decline> {
        Err(without("decode"))
    }
    /// Makes the delta for a digest from outside.
    fn answer_digest(&mut self, _answer: &AnswerDigest) -> Result<MadeDelta, Decline> {
        Err(without("answer_digest"))
    }
}

fn without(command: &str) -> Decline {
    Decline::error(ErrorCode::Unsupported, format!("no command `{command}`"))
}

/// The answer to any command.
pub fn answer(adapter: &mut dyn Adapter, command: &Command) -> Result<Answer, Decline> {
    let done = Answer::Done(Done {});
    Ok(match command {
        Command::Hello(hello) => Answer::Hello(adapter.hello(hello)?),
        Command::CaseBegin(case) => adapter.begin(case).map(|()| done)?,
        Command::Mutate(mutate) => Answer::Delta(adapter.mutate(mutate)?),
        Command::Deliver(deliver) => adapter.deliver(deliver).map(|()| done)?,
        Command::Read(read) => Answer::View(adapter.read(read)?),
        Command::Group(group) => Answer::Delta(adapter.group(group)?),
        Command::Lookup(lookup) => Answer::Vertex(adapter.lookup(lookup)?),
        Command::Restart(restart) => adapter.restart(restart).map(|()| done)?,
        Command::Answer(answer) => Answer::Delta(adapter.resynchronise(answer)?),
        Command::State(read) => Answer::State(adapter.state(read)?),
        Command::Delta(delta) => Answer::State(adapter.delta(delta)?),
        Command::Digest(read) => Answer::Digest(adapter.digest(read)?),
        Command::Load(load) => Answer::Delta(adapter.load(load)?),
        Command::Encode(delta) => Answer::Bytes(adapter.encode(delta)?),
        Command::EncodeDigest(read) => Answer::Bytes(adapter.encode_digest(read)?),
        Command::Fingerprint(read) => Answer::Bytes(adapter.fingerprint(read)?),
        Command::Decode(decode) => Answer::Delta(adapter.decode(decode)?),
        Command::AnswerDigest(answer) => Answer::Delta(adapter.answer_digest(answer)?),
    })
}

/// The reply to the handshake of who speaks this crate's protocol. `[spec: CONF-3]`
pub fn shake(
    hello: &Hello,
    implementation: Implementation,
    profiles: &[Profile],
    features: &[Feature],
    limits: Limits,
) -> Result<HelloReply, Decline> {
    if !hello.protocols.contains(&PROTOCOL) {
        let message = format!("protocols {:?} are offered; this adapter speaks {PROTOCOL}", hello.protocols);
        return Err(Decline::error(ErrorCode::Unsupported, message));
    }
    Ok(HelloReply {
        protocol: PROTOCOL,
        implementation,
        profiles: profiles.iter().map(|profile| profile.name().into()).collect(),
        features: features.iter().map(|feature| feature.name().into()).collect(),
        limits,
    })
}

/// That nobody has named this replica.
pub fn no_replica(name: &str) -> Decline {
    Decline::error(ErrorCode::Unknown, format!("no replica {name:?} in this case"))
}

/// The deltas of a case, under the names that an adapter gives them. `[spec: CONF-4]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Kept<D>(Vec<D>);

impl<D> Default for Kept<D> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<D> Kept<D> {
    /// Keeps a delta, and names it.
    pub fn keep(&mut self, delta: D) -> MadeDelta {
        self.0.push(delta);
        MadeDelta { delta: format!("d{}", self.0.len()) }
    }

    /// The delta of a name.
    pub fn get(&self, name: &str) -> Result<&D, Decline> {
        let number = name.strip_prefix('d').and_then(|number| number.parse::<usize>().ok());
        let found = number.and_then(|number| self.0.get(number.checked_sub(1)?));
        found.ok_or_else(|| Decline::error(ErrorCode::Unknown, format!("no delta {name:?} in this case")))
    }
}
