//! What is seen of the tree after a move in it.

use super::{Question, sides};
use crate::contest::Side;
use crate::error::{Result, not_the_job};
use crate::scene::{Plan, Tree};
use crate::stopwatch::time;
use std::marker::PhantomData;

const DEEP: usize = 1000;
const WIDE: usize = 10_000;
const TURNS: usize = 10;

pub(super) fn questions() -> [Question; 2] {
    [
        Question {
            id: "kinematic/deep",
            asks: "In a chain of 1,000 vertices the last is moved by another replica; then its way to the top is walked.",
            heavy: true,
            turns: TURNS,
            sides: sides!(deep; Dsr, Loro),
        },
        Question {
            id: "kinematic/wide",
            asks: "One of 10,000 children of one vertex is moved by another replica; then its way to the top is walked.",
            heavy: true,
            turns: TURNS,
            sides: sides!(wide; Dsr, Loro),
        },
    ]
}

/// A chain.
pub fn deep<S: Tree + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    seen::<S>(&Plan::of("vertex-", DEEP, |at| at - 1), [DEEP - 3, DEEP - 2], [DEEP - 2, DEEP - 1])
}

/// One parent of many.
pub fn wide<S: Tree + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    seen::<S>(&Plan::of("vertex-", WIDE, |_| 0), [1, 0], [2, 1])
}

/// The last vertex is moved between two parents, below which it has these depths.
fn seen<S: Tree + 'static>(plan: &Plan, parents: [usize; 2], depths: [usize; 2]) -> Result<Side> {
    let (mut author, last) = (S::empty(1)?, plan.names.len() - 1);
    author.populate(plan)?;
    let mut reader = S::load(2, &author.save()?)?;
    reader.find(plan)?;
    Ok(Side::of::<S>(move || {
        let moved = |turn: usize| author.move_below(last, parents[turn % 2]);
        let messages: Vec<Vec<u8>> = (0..TURNS).map(moved).collect::<Result<_>>()?;
        time(TURNS, |turn| {
            reader.apply(&messages[turn])?;
            if reader.depth(last)? == depths[turn % 2] {
                Ok(())
            } else {
                not_the_job(S::NAME, "a vertex to be where it was moved to")
            }
        })
    }))
}
