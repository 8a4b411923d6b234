//! A plan carried out.

use super::judge::{self, Failure, HEAL_MAX};
use super::plan::Plan;
use super::world::World;
use crate::config::{MS, SECOND};
use crate::memory::Traffic;
use crate::stats::Stats;

/// How a run has ended.
#[derive(Clone, PartialEq, Debug)]
pub struct Outcome {
    /// What was broken, if anything.
    pub failure: Option<Failure>,
    /// From healing until all were equal, in nanoseconds.
    pub healed_after: u64,
    /// All sessions' counters, added up.
    pub stats: Stats,
    /// What the network did.
    pub traffic: Traffic,
    /// Mutations made.
    pub mutations: u64,
    /// Sessions at the end.
    pub sessions: usize,
    /// Records of the graph at the end.
    pub records: usize,
}

/// For so long all must stay quiet and equal at the end.
const QUIET: u64 = 6 * SECOND;
/// How often equality is looked at.
const LOOK: u64 = 20 * MS;

/// Carries out a plan.
pub fn run(plan: &Plan) -> Outcome {
    carry_out(plan, false).0
}

/// The same, with what happened in words, line by line.
pub fn run_telling(plan: &Plan) -> (Outcome, Vec<String>) {
    carry_out(plan, true)
}

fn carry_out(plan: &Plan, tell: bool) -> (Outcome, Vec<String>) {
    let mut world = World::new(plan, tell);
    for (at, step) in &plan.steps {
        world.pass(*at);
        if world.failure.is_some() {
            break;
        }
        world.step(step);
    }
    world.pass(plan.heal_at);
    let mut healed_after = 0;
    if world.failure.is_none() {
        world.heal();
        healed_after = heal(&mut world);
    }
    if world.failure.is_some() {
        world.tell_counts();
    }
    let stats =
        world.nodes.iter().filter_map(|node| node.session.as_ref()).fold(world.past, |mut sum, session| {
            sum.add(&session.stats());
            sum
        });
    let records = world.sessions().map(|(_, session)| session.replica().len()).max().unwrap_or(0);
    let outcome = Outcome {
        healed_after,
        stats,
        traffic: world.network.traffic(),
        mutations: world.mutations,
        sessions: world.sessions().count(),
        records,
        failure: world.failure,
    };
    (outcome, world.told.unwrap_or_default())
}

/// Waits until all are equal, and on; how long it took.
fn heal(world: &mut World<'_>) -> u64 {
    let healed_at = world.now;
    while world.failure.is_none() && !judge::are_equal(world) {
        let after = world.now - healed_at;
        if after >= HEAL_MAX {
            world.failure = Some(judge::differ(world, after));
            return after;
        }
        world.pass(world.now + LOOK);
    }
    let after = world.now - healed_at;
    world.pass(world.now + QUIET);
    if world.failure.is_none() {
        world.failure = judge::at_end(world).err();
    }
    after
}
