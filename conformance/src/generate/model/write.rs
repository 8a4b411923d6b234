//! A history as cases. `[spec: CONF-20]`

use super::chains::chains;
use super::scene::Scene;
use super::script::{Script, Set, members};
use crate::generate::{Builder, CannotWrite};
use dsr_core::{Dictionary, Mutation, NewVertex, ReplicaId};

/// A builder in which the authors have done what a script says, and who has received what.
#[derive(Debug)]
struct Stage {
    builder: Builder,
    /// By replica: the scene's author, the authors, the observers.
    received: Vec<Set>,
    authors: usize,
}

impl Stage {
    fn new(script: &Script, observers: usize, dictionary: Dictionary) -> Result<Self, CannotWrite> {
        let authors = 1 + script.made.iter().map(|made| made.author).max().unwrap_or(0);
        let replicas = 1 + authors + observers;
        let agent = |at: usize| ReplicaId::agent(u32::try_from(at).unwrap_or(u32::MAX));
        let ids: Vec<ReplicaId> = [ReplicaId::SCENE].into_iter().chain((1..replicas).map(agent)).collect();
        let mut stage =
            Self { builder: Builder::new(&ids, dictionary), received: vec![0; replicas], authors };
        stage.builder.mutate(0, &Scene::new()?.mutations, "s")?;
        (1..replicas).try_for_each(|replica| stage.builder.deliver(replica, "s"))?;
        for (at, made) in script.made.iter().enumerate() {
            let replica = 1 + made.author;
            members(made.had & !stage.received[replica])
                .try_for_each(|other| stage.deliver(replica, other))?;
            stage.builder.mutate(replica, &[renamed(&made.mutation, at)], &name(at))?;
            stage.received[replica] |= 1 << at;
        }
        Ok(stage)
    }

    fn deliver(&mut self, replica: usize, at: usize) -> Result<(), CannotWrite> {
        self.received[replica] |= 1 << at;
        self.builder.deliver(replica, &name(at))
    }

    /// Brings a replica to a set, the latest deltas first, each as often as is said.
    fn deliver_latest_first(&mut self, replica: usize, to: Set, times: usize) -> Result<(), CannotWrite> {
        let lacks: Vec<usize> = members(to & !self.received[replica]).collect();
        let again = |at: usize| std::iter::repeat_n(at, times);
        lacks.into_iter().rev().flat_map(again).try_for_each(|at| self.deliver(replica, at))
    }

    /// Brings an observer to each set of a chain that is wanted, and reads there.
    fn follow(
        &mut self,
        observer: usize,
        chain: &[Set],
        is_wanted: &impl Fn(Set) -> bool,
    ) -> Result<(), CannotWrite> {
        for &set in chain.iter().filter(|&&set| set != 0 && is_wanted(set)) {
            self.deliver_latest_first(observer, set, 1)?;
            self.builder.expect_view(observer);
        }
        Ok(())
    }
}

/// What a delta is called.
fn name(at: usize) -> String {
    format!("m{}", at + 1)
}

/// The mutation with a name for a new vertex that tells nothing of identities; shared names stay.
fn renamed(mutation: &Mutation, at: usize) -> Mutation {
    match mutation {
        Mutation::AddVertex { vertex, link } if vertex.name.starts_with('@') => {
            let vertex = NewVertex { name: format!("n{}", at + 1).into(), ..vertex.clone() };
            Mutation::AddVertex { vertex, link: link.clone() }
        }
        _ => mutation.clone(),
    }
}

/// The case of every delivered set that is wanted: each is read where a replica that makes nothing has received it.
pub(super) fn exact(
    script: &Script,
    dictionary: Dictionary,
    is_wanted: impl Fn(Set) -> bool,
) -> Result<Builder, CannotWrite> {
    let mut chains = chains(script.made.len());
    chains.retain(|chain| chain.iter().any(|&set| set != 0 && is_wanted(set)));
    let mut stage = Stage::new(script, chains.len().saturating_sub(1), dictionary)?;
    for (observer, chain) in observers(stage.authors, &chains) {
        stage.follow(observer, chain, &is_wanted)?;
    }
    Ok(stage.builder)
}

/// The case of what every sound implementation does: everybody ends equal, who has received everything, in whatever
/// order and however often; `shows` what the core does then, if nothing in it is disputed.
pub(super) fn equal(script: &Script, dictionary: Dictionary, shows: bool) -> Result<Builder, CannotWrite> {
    let mut stage = Stage::new(script, 1, dictionary)?;
    let (authors, whole) = (stage.authors, script.whole());
    members(whole).try_for_each(|at| stage.deliver(authors + 1, at))?;
    // The scene's author gets everything twice, and the first of it once more.
    stage.deliver_latest_first(0, whole, 2)?;
    stage.deliver(0, script.made.len() - 1)?;
    for author in 1..=authors {
        stage.deliver_latest_first(author, whole, 1)?;
    }
    if shows {
        stage.builder.expect_view(0);
    }
    let everybody: Vec<usize> = (0..stage.received.len()).collect();
    stage.builder.expect_equal(&everybody);
    Ok(stage.builder)
}

/// Who follows which chain: the last one the scene's author, who makes nothing any more; others those who never made
/// anything.
fn observers(authors: usize, chains: &[Vec<Set>]) -> impl Iterator<Item = (usize, &Vec<Set>)> {
    let replicas = (1 + authors..authors + chains.len()).chain([0]);
    replicas.zip(chains)
}
