//! The adapter: the same for every library.

use crate::check::{CheckError, check, strands};
use crate::edit::Edit;
use crate::replica::{Identity, Message, Replica};
use dsr_conformance::adapter::{Adapter, Kept, no_replica, shake};
use dsr_conformance::protocol::{
    AnswerFor, CaseBegin, Decline, Deliver, ErrorCode, ErrorReply, Group, Hello, HelloReply, LINE_BYTES_MAX,
    Limits, MadeDelta, Mutate, Mutation, Profile, ROOT, Read, Restart, Shown,
};
use dsr_core::Dictionary;
use std::collections::{BTreeMap, BTreeSet};

const REPLICAS_MAX: usize = 64;

/// An adapter for graphs in the documents of a library. Profile `observe`; no `repairs`, since no library here reports
/// any, and no `lookup`, since none keeps names unique: who scans for a name decides alone what a tie means.
/// `[spec: CONF-4]`
#[derive(Debug)]
pub struct Peer<R: Replica> {
    dictionary: Dictionary,
    replicas: BTreeMap<String, Member<R>>,
    /// What the harness has named, in whatever replica. `[spec: CONF-5]`
    handles: BTreeSet<String>,
    messages: Kept<Message<R::Update>>,
}

#[derive(Debug)]
struct Member<R> {
    identity: Identity,
    replica: R,
}

impl<R: Replica> Default for Peer<R> {
    fn default() -> Self {
        Self {
            dictionary: Dictionary::default(),
            replicas: BTreeMap::new(),
            handles: BTreeSet::new(),
            messages: Kept::default(),
        }
    }
}

fn internal(error: impl std::error::Error) -> Decline {
    Decline::error(ErrorCode::Internal, error.to_string())
}

/// An error of an implementation on writing.
fn unwritten<R: Replica>(error: R::Error) -> Decline {
    if R::refuses(&error) { Decline::error(ErrorCode::Refused, error.to_string()) } else { internal(error) }
}

fn declined(error: CheckError) -> Decline {
    match error {
        CheckError::Refused(refusal) => Decline::Error(ErrorReply {
            code: ErrorCode::Refused,
            message: refusal.to_string(),
            kind: Some(refusal.kind()),
        }),
        CheckError::Link | CheckError::Target => Decline::error(ErrorCode::RejectedInput, error.to_string()),
    }
}

/// The handles that a mutation takes for granted.
fn named(mutation: &Mutation) -> Vec<&str> {
    let ends: Vec<Option<&String>> = match mutation {
        Mutation::AddVertex { link, .. } => vec![link.from.as_ref(), link.to.as_ref()],
        Mutation::AddEdge { from, to, .. } | Mutation::RemoveEdge { from, to, .. } => {
            vec![Some(from), Some(to)]
        }
        Mutation::UpdateAttributes { vertex, edge, .. } => {
            let ends = edge.as_ref().map(|edge| (&edge.from, &edge.to));
            vec![vertex.as_ref(), ends.map(|ends| ends.0), ends.map(|ends| ends.1)]
        }
        Mutation::MoveEdge { old, new, .. } => {
            vec![Some(&old.from), Some(&old.to), Some(&new.from), Some(&new.to)]
        }
        Mutation::RemoveVertex { vertex } => vec![Some(vertex)],
    };
    ends.into_iter().flatten().map(String::as_str).collect()
}

impl<R: Replica> Peer<R> {
    fn member(&mut self, name: &str) -> Result<&mut Member<R>, Decline> {
        self.replicas.get_mut(name).ok_or_else(|| no_replica(name))
    }

    fn replica(&self, name: &str) -> Result<&R, Decline> {
        self.replicas.get(name).map(|member| &member.replica).ok_or_else(|| no_replica(name))
    }

    /// Tries a group on a copy, each mutation in what the ones before it have left.
    fn edits(&self, mutate: &Mutate) -> Result<(Vec<Edit>, BTreeSet<String>), Decline> {
        let mut trial = self.replica(&mutate.replica)?.trial().map_err(internal)?;
        let mut handles = self.handles.clone();
        let mut edits = Vec::new();
        let mut shown = trial.graph().map_err(internal)?;
        for mutation in &mutate.mutations {
            if let Some(handle) =
                named(mutation).into_iter().find(|handle| *handle != ROOT && !handles.contains(*handle))
            {
                let message = format!("no vertex has the handle {handle:?}");
                return Err(Decline::error(ErrorCode::Unknown, message));
            }
            if let Mutation::AddVertex { r#as: handle, .. } = mutation
                && (handle == ROOT || !handles.insert(handle.clone()))
            {
                let message = format!("the handle {handle:?} names a vertex already");
                return Err(Decline::error(ErrorCode::RejectedInput, message));
            }
            let edit = check(&shown, &self.dictionary, mutation).map_err(declined)?;
            trial.write(std::slice::from_ref(&edit)).map_err(unwritten::<R>)?;
            let after = trial.graph().map_err(internal)?;
            if matches!(edit, Edit::RemoveEdge { .. } | Edit::MoveEdge { .. } | Edit::RemoveVertex { .. }) {
                strands(&shown, &after).map_err(|refusal| declined(refusal.into()))?;
            }
            shown = after;
            edits.push(edit);
        }
        Ok((edits, handles))
    }
}

impl<R: Replica> Adapter for Peer<R> {
    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline> {
        let limits = Limits { line_bytes: LINE_BYTES_MAX, replicas: REPLICAS_MAX };
        shake(hello, R::implementation(), &[Profile::Observe], R::FEATURES, limits)
    }

    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline> {
        *self = Self { dictionary: case.dictionary.clone().unwrap_or_default(), ..Self::default() };
        if case.replicas.len() > REPLICAS_MAX {
            let message = format!("{} replicas; the limit is {REPLICAS_MAX}", case.replicas.len());
            return Err(Decline::error(ErrorCode::RejectedInput, message));
        }
        for (name, position) in case.replicas.iter().zip(1..) {
            let identity = Identity { position, incarnation: 0 };
            let replica = R::new(identity, &self.dictionary).map_err(internal)?;
            if self.replicas.insert(name.clone(), Member { identity, replica }).is_some() {
                return Err(Decline::error(ErrorCode::RejectedInput, format!("two replicas {name:?}")));
            }
        }
        Ok(())
    }

    fn mutate(&mut self, mutate: &Mutate) -> Result<MadeDelta, Decline> {
        let (edits, handles) = self.edits(mutate)?;
        let message = self.member(&mutate.replica)?.replica.write(&edits).map_err(unwritten::<R>)?;
        self.handles = handles;
        Ok(self.messages.keep(message))
    }

    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline> {
        let message = self.messages.get(&deliver.delta)?.clone();
        self.member(&deliver.replica)?.replica.deliver(&message).map_err(internal)
    }

    fn read(&mut self, read: &Read) -> Result<Shown, Decline> {
        let graph = self.replica(&read.replica)?.graph().map_err(internal)?;
        Ok(Shown { view: graph.view() })
    }

    fn group(&mut self, group: &Group) -> Result<MadeDelta, Decline> {
        let messages = group.deltas.iter().map(|name| self.messages.get(name));
        let whole = R::group(&messages.collect::<Result<Vec<_>, _>>()?).map_err(internal)?;
        Ok(self.messages.keep(whole))
    }

    fn restart(&mut self, restart: &Restart) -> Result<(), Decline> {
        let member = self.member(&restart.replica)?;
        member.identity.incarnation += 1;
        member.replica.restart(member.identity, restart.keeps).map_err(internal)
    }

    fn resynchronise(&mut self, answer: &AnswerFor) -> Result<MadeDelta, Decline> {
        let message = self.replica(&answer.from)?.missing(self.replica(&answer.to)?).map_err(internal)?;
        Ok(self.messages.keep(message))
    }
}
