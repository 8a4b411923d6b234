//! Open searches of the published semantics: alphabets in place of scripts.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use dsr_model::gallery::rows;
use dsr_model::published::{
    Guard, Network, Operation, Order, Play, Powers, Property, Setup, Stamps, Variant, When, Workers,
};
use dsr_model::search::{Space, find_fault};

const BARE: Operation = Operation::InsertNode { id: 1, kind: "thing", name: "k", attributes: &[] };
const END: Operation = Operation::InsertNode { id: 2, kind: "thing", name: "t", attributes: &[("level", 1)] };

const fn set(value: i64) -> Operation {
    Operation::Set { node: 1, key: "x", value }
}

fn open(agents: &[u32], before: &[Operation], plays: Vec<Play>, order: Order, property: Property) -> Setup {
    Setup {
        variant: Variant::STAMPED,
        agents: agents.to_vec(),
        before: before.to_vec(),
        ignored: Vec::new(),
        plays,
        powers: Powers::ordered(order),
        property,
        when: When::Quiet,
    }
}

/// How many events lead to the property, and how many moments were met; the search must end otherwise.
fn shortest(setup: Setup) -> (Option<usize>, u64) {
    let mut network = Network::new(setup);
    let found = find_fault(&mut network, 3_000_000);
    assert!(network.moments() < 3_000_000, "the search did not end");
    (found.map(|found| found.events.len()), network.moments())
}

/// The part that does converge: two agents that write with numbers of their own, whatever the topics do, and
/// though messages arrive twice.
#[test]
fn law_two_writers_with_distinct_agents_converge() {
    let plays = vec![Play::any(&[set(10), set(20)], 3), Play::any(&[set(30), set(20)], 3)];
    let mut setup = open(&[1, 2], &[BARE], plays, Order::Topic, Property::Divergence);
    setup.powers.duplicates_max = 1;
    let (found, moments) = shortest(setup.clone());
    println!("{moments} moments");
    assert_eq!(found, None);
    setup.variant.stamps = Stamps::Zero;
    assert_eq!(shortest(setup).0, Some(4), "a tie of agent 0");
}

/// Three agents with numbers of their own that only write converge, unless one writes on a gap: then registers
/// end empty or differ, though each pair keeps its order and nothing is lost.
#[test]
fn law_writers_converge_unless_one_writes_on_a_gap() {
    let written = |guard: Guard| {
        let play = |values: &[i64]| {
            Play::script(&values.iter().map(|&value| (guard, set(value))).collect::<Vec<_>>())
        };
        let plays = vec![play(&[40]), play(&[20, 30]), play(&[99])];
        open(&[1, 2, 3], &[BARE], plays, Order::Pair, Property::Divergence)
    };
    let (found, moments) = shortest(written(Guard::Gapless(1, "x")));
    println!("{moments} moments");
    assert_eq!(found, None);
    assert_eq!(shortest(written(Guard::Always)).0, Some(12));
}

/// Three writes never empty a register that the third replica has not seen, however they are shared out; four
/// do.
#[test]
fn oracle_an_empty_register_takes_four_writes() {
    let values = [[set(1), set(2), set(3)], [set(4), set(5), set(6)], [set(7), set(8), set(9)]];
    let play = |shares: [u8; 3]| {
        let plays = values.iter().zip(shares);
        let plays =
            plays.map(|(values, share)| Play { in_order: true, ..Play::any(values, share) }).collect();
        let setup = open(&[1, 2, 3], &[BARE], plays, Order::Pair, Property::Unreadable);
        shortest(Setup { when: When::Always, ..setup }).0
    };
    for shares in [[3, 0, 0], [2, 1, 0], [1, 2, 0], [1, 1, 1]] {
        assert_eq!(play(shares), None, "{shares:?}");
    }
    assert_eq!(play([1, 2, 1]), Some(8));
}

/// One worker keeps the order of one writer, so the fork does not show row 8 to a single writer.
#[test]
fn oracle_the_fork_keeps_the_order_of_a_writer() {
    let row = rows().into_iter().find(|row| row.row == "8").unwrap();
    let fork = Variant { workers: Workers::One, ..row.setup.variant };
    assert!(shortest(row.setup.clone()).0.is_some());
    assert_eq!(shortest(Setup { variant: fork, ..row.setup }).0, None);
}

/// Two agents that may do anything twice break these, with these many events, whatever they are asked to do.
#[test]
fn oracle_two_free_agents_break_these() {
    let (from, to, kind) = (1, 2, "in");
    let anything = [
        set(10),
        Operation::Remove { node: 1, key: "x" },
        Operation::AssignEdge { from, to, kind, attributes: &[("p", 1)] },
        Operation::DeleteEdge { from, to, kind },
        Operation::DeleteNode { node: 2 },
        Operation::Place { from: 2, to: 1, pose: 0 },
    ];
    let cases = [
        (Property::Divergence, Some(4)),
        (Property::Dangling(None), Some(4)),
        (Property::Orphan(1), Some(5)),
        (Property::ParentMismatch(1), None),
        (Property::NameIndex, None),
        (Property::Unreadable, None),
    ];
    let mut wrong = Vec::new();
    for (property, steps) in cases {
        let plays = vec![Play::any(&anything, 2), Play::any(&anything, 2)];
        let setup = open(&[1, 2], &[BARE, END], plays, Order::Pair, property);
        let (found, moments) = shortest(setup);
        println!("{property:?}: {found:?} among {moments}");
        wrong.extend((found != steps).then(|| format!("{property:?} {found:?}")));
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Losing, repeating, joining and restarting are really explored.
#[test]
fn canary_every_power_is_used() {
    let all = rows().into_iter().flat_map(|row| {
        let mut network = Network::new(row.setup.clone());
        let end = find_fault(&mut network, usize::MAX).unwrap();
        end.events.into_iter().map(move |(_, event)| row.setup.line(&network.happening(&event)))
    });
    let all: Vec<String> = all.collect();
    for word in ["never receives", "finds", "encodes", "told", "restarts", "whole graph"] {
        assert!(all.iter().any(|line| line.contains(word)), "{word}");
    }
    let mut again = open(&[1, 2], &[BARE], vec![Play::any(&[set(1)], 1)], Order::Pair, Property::Divergence);
    again.powers.duplicates_max = 1;
    let mut network = Network::new(again);
    let mut successors = Vec::new();
    let start = network.start();
    network.successors(&start, &mut successors).unwrap();
    let after = successors[0].1;
    successors.clear();
    network.successors(&after, &mut successors).unwrap();
    assert_eq!(successors.len(), 2, "once, or not for the last time");
}
