//! Moves in the tree; at the author, and at another replica.

use super::{Question, sides};
use crate::contest::Side;
use crate::error::{Result, not_the_job};
use crate::scene::{Plan, Tree};
use crate::stopwatch::time;
use std::hint::black_box;
use std::marker::PhantomData;

const VERTICES: usize = 1000;
const FAN: usize = 10;
const TURNS: usize = 200;
/// The vertices that move are leaves, and the last ones of the plan.
const MOVED: usize = 100;
/// Two parents, at which none of them is at first.
const PLACES: [usize; 2] = [3, 4];

pub(super) fn questions() -> [Question; 3] {
    let question = |id, asks, sides| Question { id, asks, heavy: false, turns: TURNS, sides };
    [
        question(
            "move",
            "A leaf of a tree of 1,000 vertices is moved below another parent; the delta is bytes.",
            sides!(update; Dsr, Loro),
        ),
        question(
            "move/unencoded",
            "A leaf is moved; the delta, if there is one, stays in memory.",
            sides!(unencoded; Dsr, Loro),
        ),
        question(
            "move/apply",
            "The bytes of such a delta are joined at another replica.",
            sides!(apply; Dsr, Loro),
        ),
    ]
}

fn pair<S: Tree>() -> Result<(S, S)> {
    let plan = Plan::tree("vertex-", VERTICES, FAN);
    let mut author = S::empty(1)?;
    author.populate(&plan)?;
    let mut reader = S::load(2, &author.save()?)?;
    reader.find(&plan)?;
    // The first of the moved is three below the top; it goes to one below.
    let before = reader.depth(VERTICES - 1)?;
    reader.apply(&author.move_below(VERTICES - 1, PLACES[0])?)?;
    if (before, reader.depth(VERTICES - 1)?) != (3, 2) {
        return not_the_job(S::NAME, "a vertex to be moved");
    }
    Ok((author, reader))
}

/// Who moves, and where to: at every visit to the other place.
fn step(turn: &mut usize) -> (usize, usize) {
    let step = (VERTICES - 1 - *turn % MOVED, PLACES[1 - *turn / MOVED % 2]);
    *turn += 1;
    step
}

/// An author who moves.
pub fn update<S: Tree + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut author, _) = pair::<S>()?;
    let mut turn = 0;
    Ok(Side::of::<S>(move || {
        time(TURNS, |_| {
            let (vertex, parent) = step(&mut turn);
            black_box(author.move_below(vertex, parent)?);
            Ok(())
        })
    }))
}

/// An author who moves and encodes nothing.
pub fn unencoded<S: Tree + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut author, _) = pair::<S>()?;
    author.move_unencoded(VERTICES - 2, PLACES[0])?;
    if author.depth(VERTICES - 2)? != 2 {
        return not_the_job(S::NAME, "a vertex to be moved");
    }
    let mut turn = 0;
    Ok(Side::of::<S>(move || {
        time(TURNS, |_| {
            let (vertex, parent) = step(&mut turn);
            author.move_unencoded(vertex, parent)
        })
    }))
}

/// A reader who follows.
pub fn apply<S: Tree + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut author, mut reader) = pair::<S>()?;
    let mut turn = 0;
    Ok(Side::of::<S>(move || {
        let mut moved = || {
            let (vertex, parent) = step(&mut turn);
            author.move_below(vertex, parent)
        };
        let messages: Vec<Vec<u8>> = (0..TURNS).map(|_| moved()).collect::<Result<_>>()?;
        time(TURNS, |turn| reader.apply(&messages[turn]))
    }))
}
