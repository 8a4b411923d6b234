//! Events in words.

use super::message::Message;
use super::operation::Operation;
use super::setup::Setup;
use super::space::{Moment, Network};
use super::world::{Event, Letter};
use crate::search::Space;
use std::fmt;
use std::sync::Arc;

impl fmt::Display for Operation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InsertNode { id, name, .. } => write!(f, "inserts node #{id} named {name}"),
            Self::Set { node, key, value } => write!(f, "sets #{node}.{key} = {value}"),
            Self::Remove { node, key } => write!(f, "removes #{node}.{key}"),
            Self::Get { node } => write!(f, "gets a copy of #{node}"),
            Self::PutBack { key, value } => {
                write!(f, "sets {key} = {value} in its copy and updates the node")
            }
            Self::DeleteNode { node } => write!(f, "deletes node #{node}"),
            Self::AssignEdge { from, to, kind, attributes: [] } => {
                write!(f, "inserts edge #{from} -{kind}-> #{to}")
            }
            Self::AssignEdge { from, to, kind, attributes } => {
                write!(f, "inserts or updates edge #{from} -{kind}-> #{to} with")?;
                attributes.iter().try_for_each(|(key, value)| write!(f, " {key} = {value}"))
            }
            Self::DeleteEdge { from, to, kind } => write!(f, "deletes edge #{from} -{kind}-> #{to}"),
            Self::Place { from, to, .. } => write!(f, "places #{to} below #{from}"),
        }
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node { id, delta, .. } if delta.is_empty() => write!(f, "removal of node #{id}"),
            Self::Node { id, .. } => write!(f, "node #{id}"),
            Self::NodeAttributes { parts, .. } => parts.iter().enumerate().try_for_each(|(at, part)| {
                let before = if at == 0 { "" } else { ", " };
                write!(f, "{before}#{}.{}", part.node, part.key)?;
                match part.delta.value() {
                    Some(held) => write!(f, " = {}", held.value),
                    None => f.write_str(" removed"),
                }
            }),
            Self::Edge { from, to, kind, delta, .. } => {
                let removal = if delta.is_empty() { "removal of " } else { "" };
                write!(f, "{removal}edge #{from} -{kind}-> #{to}")
            }
            Self::EdgeAttributes { parts, .. } => parts.iter().enumerate().try_for_each(|(at, part)| {
                let before = if at == 0 { "" } else { ", " };
                write!(f, "{before}#{} -{}-> #{}.{}", part.from, part.kind, part.to, part.key)?;
                match part.delta.value() {
                    Some(held) => write!(f, " = {}", held.value),
                    None => f.write_str(" removed"),
                }
            }),
            Self::Graph { nodes, .. } => {
                f.write_str("the whole graph:")?;
                nodes.keys().try_for_each(|id| write!(f, " #{id}"))
            }
        }
    }
}

/// An event with the message itself: the same in every space of one setup.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Happening {
    /// A replica, by position, makes the how-manieth of its calls.
    Call(usize, usize),
    /// A message arrives, once or not for the last time.
    Deliver(Envelope, bool),
    /// A message is lost.
    Lose(Envelope),
    /// The joiner finds a replica, by position.
    Find(usize),
    /// The server encodes its whole graph for the joiner.
    Encode,
    /// The joiner has the answer, and its user is told that it has joined.
    Tell,
    /// The joiner asks again, and is refused as a duplicate of itself.
    Refuse,
    /// A replica, by position, restarts.
    Restart(usize),
}

/// A copy of a message, with its sender and its receiver.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Envelope {
    /// Who sent it, by position.
    pub from: usize,
    /// Who gets it, by position.
    pub to: usize,
    /// The message.
    pub message: Arc<Message>,
}

impl Network {
    /// An event with its message.
    pub fn happening(&self, event: &Event) -> Happening {
        let copy =
            |letter: Letter| Envelope { from: letter.from, to: letter.to, message: self.message(letter) };
        match *event {
            Event::Call { replica, call } => Happening::Call(replica, call),
            Event::Deliver { letter, again } => Happening::Deliver(copy(letter), again),
            Event::Lose { letter } => Happening::Lose(copy(letter)),
            Event::Find { replica } => Happening::Find(replica),
            Event::Encode => Happening::Encode,
            Event::Tell => Happening::Tell,
            Event::Refuse => Happening::Refuse,
            Event::Restart { replica } => Happening::Restart(replica),
        }
    }

    /// What is under way.
    pub fn letters(&self, moment: Moment) -> Vec<Envelope> {
        let letters = self.letters_at(moment).into_iter();
        letters
            .map(|letter| Envelope { from: letter.from, to: letter.to, message: self.message(letter) })
            .collect()
    }

    /// Where a happening leads; `None` if it cannot happen.
    pub fn step(&mut self, at: Moment, happening: &Happening) -> Option<Moment> {
        let mut successors = Vec::new();
        self.successors(&at, &mut successors).ok()?;
        successors.into_iter().find(|(event, _)| self.happening(event) == *happening).map(|(_, next)| next)
    }

    /// Where these happenings lead, one after the other; `None` if one of them cannot happen.
    pub fn replay(&mut self, happenings: &[Happening]) -> Option<Moment> {
        happenings.iter().try_fold(self.start(), |at, happening| self.step(at, happening))
    }
}

impl Setup {
    /// What happens, in a line.
    pub fn line(&self, happening: &Happening) -> String {
        let who = |replica: usize| self.agents.get(replica).map(|agent| format!("agent {agent}"));
        let agent = |replica: usize| who(replica).unwrap_or_default();
        let copy = |copy: &Envelope| format!("{} from {}", copy.message, agent(copy.from));
        match happening {
            Happening::Call(replica, call) => {
                let calls = self.plays.get(*replica).map(|play| &play.calls);
                let operation = calls.and_then(|calls| calls.get(*call)).map(|(_, operation)| operation);
                format!("{} {}", agent(*replica), operation.map(ToString::to_string).unwrap_or_default())
            }
            Happening::Deliver(letter, again) => {
                let more = if *again { ", not for the last time" } else { "" };
                format!("{} receives {}{more}", agent(letter.to), copy(letter))
            }
            Happening::Lose(letter) => format!("{} never receives {}", agent(letter.to), copy(letter)),
            Happening::Find(replica) => format!("the joiner finds {}", agent(*replica)),
            Happening::Encode => "the server encodes its whole graph for the joiner".into(),
            Happening::Tell => "the joiner has the answer, and is told that it has joined".into(),
            Happening::Refuse => "the joiner asks again, and is refused as a duplicate of itself".into(),
            Happening::Restart(replica) => format!("{} restarts", agent(*replica)),
        }
    }
}
