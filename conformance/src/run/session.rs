//! A conversation: numbered requests, and replies that are what they should be. `[spec: CONF-2]`

use super::child::excerpt;
use super::peer::{Peer, Trouble};
use super::watch::Watch;
use crate::protocol::{
    Command, Decline, ErrorCode, Feature, Hello, HelloReply, Need, Profile, Reply, Request, read_strictly,
};
use serde::Serialize;
use serde::de::{DeserializeOwned, IgnoredAny};

pub(super) struct Session {
    peer: Box<dyn Peer>,
    next_id: u64,
    last_request: String,
    pub(super) hello: HelloReply,
}

impl Session {
    /// Shakes hands. `[spec: CONF-3]`
    pub(super) fn begin(
        mut peer: Box<dyn Peer>,
        hello: Hello,
        watch: &mut dyn Watch,
    ) -> Result<Self, (Trouble, String)> {
        match Self::shake(&mut *peer, hello, watch) {
            Ok(hello) => Ok(Self { peer, next_id: 2, last_request: String::new(), hello }),
            Err(trouble) => {
                let told = told(&trouble, "", &peer.last_words());
                Err((trouble, told))
            }
        }
    }

    fn shake(peer: &mut dyn Peer, hello: Hello, watch: &mut dyn Watch) -> Result<HelloReply, Trouble> {
        let offered = hello.protocols.clone();
        let reply = ask::<HelloReply>(peer, &line_of(1, Command::Hello(hello))?, 1, watch)?;
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
        Ok(hello)
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
        watch: &mut dyn Watch,
    ) -> Result<Result<T, Decline>, Trouble> {
        let (id, needs) = (self.next_id, command.needs());
        self.next_id += 1;
        self.last_request = line_of(id, command)?;
        let reply = ask(&mut *self.peer, &self.last_request, id, watch)?;
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
        told(trouble, &self.last_request, &self.peer.last_words())
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
    request: &str,
    id: u64,
    watch: &mut dyn Watch,
) -> Result<Result<T, Decline>, Trouble> {
    watch.sent(request);
    let line = peer.exchange(request)?;
    watch.came(&line);
    let no_reply = |error| Trouble::protocol(format!("no reply: {error} in {}", excerpt(&line)));
    let numbered: Reply<IgnoredAny> = serde_json::from_str(&line).map_err(no_reply)?;
    if numbered.id != id {
        return Err(Trouble::protocol(format!("request {id} is answered with id {}", numbered.id)));
    }
    let reply: Reply<T> = read_strictly(&line).map_err(no_reply)?;
    let none = || Trouble::protocol(format!("not exactly one of ok, skip, error in {}", excerpt(&line)));
    reply.result().ok_or_else(none)
}

/// A trouble in words, with the request that it came upon and the end of standard error.
fn told(trouble: &Trouble, request: &str, last_words: &str) -> String {
    let mut text = trouble.to_string();
    if !request.is_empty() {
        text = format!("{text}\nrequest: {}", excerpt(request));
    }
    let words = last_words.trim_end();
    if words.is_empty() { text } else { format!("{text}\nstandard error:\n{words}") }
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
