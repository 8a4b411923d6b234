//! A conversation: numbered requests, and replies that are what they should be. `[spec: CONF-2]`

use super::child::excerpt;
use super::peer::{Peer, Trouble};
use crate::protocol::{
    Command, Decline, ErrorCode, Feature, Hello, HelloReply, Need, Profile, Reply, Request, read_strictly,
};
use serde::Serialize;
use serde::de::{DeserializeOwned, IgnoredAny};

pub(super) struct Session {
    peer: Box<dyn Peer>,
    next_id: u64,
    pub(super) hello: HelloReply,
}

impl Session {
    /// Shakes hands. `[spec: CONF-3]`
    pub(super) fn begin(mut peer: Box<dyn Peer>, hello: Hello) -> Result<Self, Trouble> {
        let offered = hello.protocols.clone();
        let reply = ask::<HelloReply>(&mut *peer, 1, Command::Hello(hello))?;
        let hello = match reply {
            Ok(hello) => hello,
            Err(decline) => {
                return Err(Trouble::protocol(format!("the handshake is declined: {}", words(&decline))));
            }
        };
        if !offered.contains(&hello.protocol) {
            let what = format!("protocol {} is none of those offered: {offered:?}", hello.protocol);
            return Err(Trouble::protocol(what));
        }
        let observe = Profile::Observe.name();
        if !hello.profiles.iter().any(|profile| profile == observe) {
            return Err(Trouble::protocol(format!("profiles {:?} lack {observe:?}", hello.profiles)));
        }
        Ok(Self { peer, next_id: 2, hello })
    }

    pub(super) fn has_profile(&self, profile: Profile) -> bool {
        self.hello.profiles.iter().any(|name| name == profile.name())
    }

    /// Whether refusals name their kind.
    pub(super) fn tells_kinds(&self) -> bool {
        self.has(Feature::ErrorKinds)
    }

    pub(super) fn has(&self, feature: Feature) -> bool {
        self.hello.features.iter().any(|name| name == feature.name())
    }

    /// One request and its reply. An adapter that declines what it has announced breaks the protocol.
    pub(super) fn ask<T: DeserializeOwned + Serialize>(
        &mut self,
        command: Command,
    ) -> Result<Result<T, Decline>, Trouble> {
        let (id, needs) = (self.next_id, command.needs());
        self.next_id += 1;
        let reply = ask(&mut *self.peer, id, command)?;
        if let Err(decline) = &reply {
            self.keeps_its_word(decline, needs)?;
        }
        Ok(reply)
    }

    fn keeps_its_word(&self, decline: &Decline, needs: Option<Need>) -> Result<(), Trouble> {
        match decline {
            Decline::Skip(skip) => match &skip.feature {
                Some(feature) if self.hello.features.contains(feature) => Err(Trouble::protocol(format!(
                    "skips for want of {feature:?}, which it has announced: {}",
                    skip.reason
                ))),
                _ => Ok(()),
            },
            Decline::Error(error) if error.code == ErrorCode::Unsupported => {
                let what = needs.unwrap_or(Need::Profile(Profile::Observe));
                Err(Trouble::protocol(format!(
                    "does not support what it has announced, {what}: {}",
                    error.message
                )))
            }
            Decline::Error(error) if error.kind.is_some() && error.code != ErrorCode::Refused => {
                Err(Trouble::protocol("an error that is no refusal has a `kind`"))
            }
            Decline::Error(_) => Ok(()),
        }
    }

    /// Whether a request fits into what the adapter takes, at any id.
    pub(super) fn takes(&self, command: &Command) -> bool {
        let line = line_of(u64::MAX, command.clone());
        line.is_ok_and(|line| line.len() <= self.hello.limits.line_bytes)
    }

    /// What the adapter has done since its last reply.
    pub(super) fn unasked(&mut self) -> Option<Trouble> {
        self.peer.unasked()
    }

    /// A trouble in words, with what the adapter said on standard error.
    pub(super) fn told(&mut self, trouble: &Trouble) -> String {
        let words = self.peer.last_words();
        let words = words.trim_end();
        if words.is_empty() { trouble.to_string() } else { format!("{trouble}\nstandard error:\n{words}") }
    }

    /// Ends the conversation.
    pub(super) fn finish(mut self) {
        self.peer.finish();
    }
}

fn line_of(id: u64, command: Command) -> Result<String, Trouble> {
    serde_json::to_string(&Request { id, r#do: command })
        .map_err(|error| Trouble::protocol(format!("the request cannot be written: {error}")))
}

fn ask<T: DeserializeOwned + Serialize>(
    peer: &mut dyn Peer,
    id: u64,
    command: Command,
) -> Result<Result<T, Decline>, Trouble> {
    let line = peer.exchange(&line_of(id, command)?)?;
    let no_reply = |error| Trouble::protocol(format!("no reply: {error} in {}", excerpt(&line)));
    let numbered: Reply<IgnoredAny> = serde_json::from_str(&line).map_err(no_reply)?;
    if numbered.id != id {
        return Err(Trouble::protocol(format!("request {id} is answered with id {}", numbered.id)));
    }
    let reply: Reply<T> = read_strictly(&line).map_err(no_reply)?;
    let none = || Trouble::protocol(format!("not exactly one of ok, skip, error in {}", excerpt(&line)));
    reply.result().ok_or_else(none)
}

/// A decline in words.
pub(super) fn words(decline: &Decline) -> String {
    match decline {
        Decline::Skip(skip) => skip.reason.clone(),
        Decline::Error(error) => {
            let kind = error.kind.as_deref().map(|kind| format!(", {kind}")).unwrap_or_default();
            format!("{:?}{kind}: {}", error.code, error.message)
        }
    }
}
