//! Registers of the published semantics, rule by rule.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that cannot go on has failed"
)]

mod published_common;

use dsr_model::published::{Attribute, Context, Crash, Dot, Register};
use published_common::{counters, dot, number, of, written};

#[test]
fn oracle_one_greater_dot_in_the_cloud_makes_smaller_ones_known() {
    let context = Context::of([Dot { id: 7, n: 5 }]);
    assert!(context.known(dot(4)) && !context.known(dot(5)) && context.known(Dot { id: 7, n: 5 }));
    assert!(!Context::counted(0, 3).known(dot(4)));
}

#[test]
fn oracle_contexts_compact_what_follows_on() {
    let mut context = Context::of([dot(1), dot(2), dot(4)]);
    assert_eq!((context.counter(0), context.cloud().collect()), (Some(2), vec![dot(4)]));
    // The next dot is the counter's, whatever is in the cloud, and closes no gap.
    assert_eq!(context.make_dot(0), dot(3));
    assert_eq!((context.counter(0), context.cloud().count()), (Some(3), 1));
    context.join(&Context::default());
    assert_eq!((context.counter(0), context.cloud().count()), (Some(4), 0));
}

#[test]
fn oracle_delta_shapes() {
    let (mut register, deltas) = written(3);
    let shape = |delta: &Register<Attribute>| {
        (delta.values().keys().map(|dot| dot.n).collect::<Vec<_>>(), counters(delta))
    };
    assert_eq!(shape(&deltas[0]), (vec![1], (Some(1), vec![])));
    assert_eq!(shape(&deltas[1]), (vec![2], (Some(2), vec![])));
    assert_eq!(shape(&deltas[2]), (vec![3], (None, vec![2, 3])));
    assert_eq!(shape(&register.reset()), (vec![], (None, vec![3])));
    assert_eq!(shape(&written(1).0.reset()), (vec![], (Some(1), vec![])));
    assert_eq!(counters(&register), (Some(3), vec![]));
}

#[test]
fn oracle_an_empty_register_takes_in_what_it_has_seen() {
    let (mut register, deltas) = written(1);
    drop(register.reset());
    register.join(&deltas[0]).unwrap();
    assert_eq!(number(&register), Some(1));
    assert_eq!(Register::<Attribute>::default().read(), Err(Crash::EmptyRegister));
}

#[test]
fn oracle_ties_go_to_the_lower_agent_or_stay() {
    let tie = |mine: u32, theirs: u32| {
        let (mut left, mut right) = (Register::default(), Register::default());
        drop(left.write(of(mine, 10)));
        let delta = right.write(of(theirs, 20));
        left.join(&delta).unwrap();
        number(&left)
    };
    assert_eq!([tie(2, 1), tie(1, 2), tie(0, 0)], [Some(20), Some(10), Some(10)]);
}

/// A write on a gap is killed by what made the gap, and kills it: nobody holds anything.
#[test]
fn oracle_a_write_on_a_gap_empties_the_register_elsewhere() {
    let (_, deltas) = written(4);
    let (mut early, mut late) = (written(4).0, Register::default());
    late.join(&deltas[0]).unwrap();
    late.join(&deltas[3]).unwrap();
    assert_eq!(counters(&late), (Some(1), vec![3, 4]));
    let delta = late.write(of(3, 99));
    assert_eq!(counters(&delta), (None, vec![2, 4]));
    early.join(&delta).unwrap();
    assert!(early.is_empty());
}

/// Without deletions, loss, ties or writes on a gap, writes in any order end equal: the greatest dot wins.
#[test]
fn law_deltas_of_one_writer_end_equal_in_any_order() {
    let (whole, deltas) = written(4);
    for order in orders(4) {
        let mut register = Register::default();
        for at in order {
            register.join(&deltas[at]).unwrap();
        }
        assert_eq!(register.values(), whole.values());
    }
}

fn orders(n: usize) -> Vec<Vec<usize>> {
    if n == 0 {
        return vec![vec![]];
    }
    let shorter = orders(n - 1).into_iter();
    shorter
        .flat_map(|order| {
            (0..n).map(move |at| {
                let mut longer = order.clone();
                longer.insert(at, n - 1);
                longer
            })
        })
        .collect()
}
