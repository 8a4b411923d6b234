//! Whole replicas: joined, and late.

use super::{Question, sides};
use crate::contest::Side;
use crate::error::{Result, not_the_job};
use crate::libraries::Dsr;
use crate::scene::{Plan, Scene};
use crate::stopwatch::time;
use std::marker::PhantomData;

const SMALL: usize = 1000;
const LARGE: usize = 100_000;

pub(super) fn questions() -> [Question; 5] {
    [
        Question {
            id: "join/1000",
            asks: "Two replicas that have each added 1,000 vertices are joined: one takes the whole of the other.",
            heavy: false,
            turns: 1,
            sides: sides!(small; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "join/100000",
            asks: "The same of 100,000 vertices each.",
            heavy: true,
            turns: 1,
            sides: sides!(large; Dsr, Yrs, Loro, AutomergeScene, Crdts),
        },
        Question {
            id: "join/100000/states",
            asks: "Their states alone are joined: the records and the dots, which is what converges. Ours keeps no \
                   index, no view and no word about what has changed; the peers do what they did.",
            heavy: true,
            turns: 1,
            sides: states,
        },
        Question {
            id: "late-join/1000",
            asks: "An empty replica is given the bytes of 1,000 vertices, and can be read.",
            heavy: false,
            turns: 1,
            sides: sides!(late_small; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "late-join/100000",
            asks: "The same of 100,000 vertices.",
            heavy: true,
            turns: 1,
            sides: sides!(late_large; Dsr, Yrs, Loro, AutomergeScene, Crdts),
        },
    ]
}

fn join<S: Scene + 'static>(n: usize) -> Result<Side> {
    let (mut left, mut right) = (S::empty(1)?, S::empty(2)?);
    left.populate(&Plan::tree("left-", n, 10))?;
    right.populate(&Plan::tree("right-", n, 10))?;
    let mut is_checked = false;
    Ok(Side::of::<S>(move || {
        let (mut joined, other) = (left.again()?, right.whole()?);
        let mut other = Some(other);
        let ns = time(1, |_| other.take().map_or(Ok(()), |other| joined.merge(other)))?;
        if !is_checked && joined.count()? != 2 * n {
            return not_the_job(S::NAME, "the vertices of both to be there");
        }
        is_checked = true;
        Ok(ns)
    }))
}

/// The reference joins states; the peers have nothing beside theirs.
fn states(question: &Question, is_wanted: &dyn Fn(&str) -> bool) -> Result<Vec<Side>> {
    let mut sides = Vec::new();
    if is_wanted(Dsr::NAME) {
        let (mut left, mut right) = (Dsr::empty(1)?, Dsr::empty(2)?);
        left.populate(&Plan::tree("left-", LARGE, 10))?;
        right.populate(&Plan::tree("right-", LARGE, 10))?;
        sides.push(Side::of::<Dsr>(move || {
            let (mut joined, other) = (left.whole()?, right.whole()?);
            let records = joined.len() + other.len();
            let ns = time(1, |_| {
                joined.join(&other);
                Ok(())
            })?;
            if joined.len() == records {
                Ok(ns)
            } else {
                not_the_job(Dsr::NAME, "the records of both to be there")
            }
        }));
    }
    sides.extend(sides!(large; Yrs, Loro, AutomergeScene, Crdts)(question, is_wanted)?);
    Ok(sides)
}

fn late<S: Scene + 'static>(n: usize) -> Result<Side> {
    let plan = Plan::tree("vertex-", n, 10);
    let mut author = S::empty(1)?;
    author.populate(&plan)?;
    let bytes = author.save()?;
    drop(author);
    Ok(Side::of::<S>(move || {
        let mut joined = None;
        let ns = time(1, |_| {
            let late = S::load(2, &bytes)?;
            // Some decode when they are first read.
            let count = late.count()?;
            joined = Some(late);
            if count == n { Ok(()) } else { not_the_job(S::NAME, "all vertices to be there") }
        });
        drop(joined);
        ns
    }))
}

/// A thousand each.
pub fn small<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    join::<S>(SMALL)
}

/// A hundred thousand each.
pub fn large<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    join::<S>(LARGE)
}

/// A thousand, late.
pub fn late_small<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    late::<S>(SMALL)
}

/// A hundred thousand, late.
pub fn late_large<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    late::<S>(LARGE)
}
