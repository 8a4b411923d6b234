//! How a history is drawn.

use super::mutations::{kind, mutation};
use super::outside;
use super::vocabulary::{dictionary, once_in, pick, time};
use super::world::{Event, History, World};
use dsr_core::{Author, MutationKind, ReplicaId, encode, view};
use dsr_model::walks::Dice;

/// The fewest events.
const EVENTS_MIN: usize = 5;
/// So many more at most.
const EVENTS_MORE: usize = 14;

/// How often each thing happens, of all that can: mutate, deliver, group, join, tell, answer, restart, outside, bytes.
const WEIGHTS: [usize; 9] = [24, 22, 2, 3, 3, 4, 1, 3, 1];

/// History `number` of a seed, the same for ever. `[spec: ORACLE-4]`
pub fn draw(seed: u64, number: u64) -> History {
    let mut dice = Dice::new(seed, number);
    let dice = &mut dice;
    let mut history = History { number, replicas: Vec::new(), events: Vec::new() };
    let shared = dictionary(dice);
    let differ = once_in(dice, 8);
    for agent in 1..=(2 + u32::try_from(dice.below(4)).unwrap_or(0)) {
        let own = if differ { dictionary(dice) } else { shared.clone() };
        let incarnation = if once_in(dice, 20) { u32::MAX - 1 } else { 0 };
        history.replicas.push((ReplicaId { agent, incarnation }, own));
    }
    let mut world = World::of(&history);
    if !once_in(dice, 3) {
        happen(&mut history, &mut world, Event::Outside { state: outside::scene(dice) });
        for replica in 0..world.replicas.len() {
            happen(&mut history, &mut world, Event::Deliver { replica, delta: 0 });
        }
    }
    let events = history.events.len() + EVENTS_MIN + dice.below(EVENTS_MORE);
    while history.events.len() < events {
        match dice.below(5) {
            0 => clash(dice, &mut history, &mut world),
            1 if once_in(dice, 4) => intrude(dice, &mut history, &mut world),
            _ => {
                if let Some(event) = event(dice, &world) {
                    happen(&mut history, &mut world, event);
                }
            }
        }
    }
    history
}

/// Two replicas do something of one kind without knowing of each other, and hear of it.
fn clash(dice: &mut Dice, history: &mut History, world: &mut World) {
    let count = world.replicas.len();
    let one = dice.below(count);
    let other = (one + 1 + dice.below(count - 1)) % count;
    let first = kind(dice);
    let second = if once_in(dice, 3) { kind(dice) } else { first };
    let at = history.events.len();
    for (replica, kind) in [(one, first), (other, second)] {
        let event = mutate(dice, world, replica, Some(kind));
        happen(history, world, event);
    }
    for (replica, delta) in [(other, at), (one, at + 1)] {
        if world.deltas.contains_key(&delta) && !once_in(dice, 5) {
            happen(history, world, Event::Deliver { replica, delta });
        }
    }
}

/// Something from outside arrives at once.
fn intrude(dice: &mut Dice, history: &mut History, world: &mut World) {
    let delta = history.events.len();
    if let Some(state) = outside::state(dice, &ids(world)) {
        happen(history, world, Event::Outside { state });
        happen(history, world, Event::Deliver { replica: dice.below(world.replicas.len()), delta });
    }
}

fn happen(history: &mut History, world: &mut World, event: Event) {
    let number = history.events.len();
    world.happen(number, &event);
    history.events.push((number, event));
}

fn event(dice: &mut Dice, world: &World) -> Option<Event> {
    let replica = dice.below(world.replicas.len());
    let made: Vec<usize> = world.deltas.keys().copied().collect();
    let told: Vec<usize> = world.digests.keys().copied().collect();
    Some(match dice.weighted(&WEIGHTS)? {
        0 => mutate(dice, world, replica, None),
        1 => Event::Deliver { replica, delta: *pick(dice, &made)? },
        2 => {
            let deltas = (0..2 + dice.below(2)).filter_map(|_| pick(dice, &made).copied()).collect();
            Event::Group { deltas }
        }
        3 => Event::Join { replica, from: dice.below(world.replicas.len()) },
        4 => Event::Tell { replica },
        5 => Event::Answer { replica, digest: *pick(dice, &told)? },
        6 => Event::Restart { replica },
        7 => Event::Outside { state: outside::state(dice, &ids(world))? },
        _ => Event::Bytes { bytes: outside::bytes(dice, encode(&world.replicas.get(replica)?.state)) },
    })
}

/// Mostly one mutation; of a group each is drawn where those before it have been made.
fn mutate(dice: &mut Dice, world: &World, at: usize, of: Option<MutationKind>) -> Event {
    let timestamp_ns = time(dice);
    let mut mutations = Vec::new();
    if let Some(replica) = world.replicas.get(at) {
        let author = Author { replica: replica.id, timestamp_ns };
        let mut state = replica.state.clone();
        let count = 1 + dice.below(6).saturating_sub(4);
        for _ in 0..count {
            let seen = view(&state, &replica.dictionary);
            let of = of.unwrap_or_else(|| kind(dice));
            let next = mutation(dice, &seen, author, of);
            let made = next.delta(&seen, author);
            mutations.push(next);
            let Ok(delta) = made else { break };
            state = state.joined(&delta);
        }
    }
    Event::Mutate { replica: at, timestamp_ns, mutations }
}

fn ids(world: &World) -> Vec<ReplicaId> {
    world.replicas.iter().map(|replica| replica.id).chain([ReplicaId::SCENE]).collect()
}
