//! Replicas that have gone apart: what each lacks, and that it gets it.

use super::{Question, sides};
use crate::contest::Side;
use crate::error::{Result, not_the_job};
use crate::scene::{Content, Link, Plan, Reconciles};
use crate::stopwatch::time;
use std::hint::black_box;
use std::marker::PhantomData;

const VERTICES: usize = 1000;
const MUTATIONS: usize = 1000;
/// Vertices when both have all: each mutation in five has added one.
const TOGETHER: usize = VERTICES + 2 * MUTATIONS / 5;
const TURNS: usize = 20;

pub(super) fn questions() -> [Question; 3] {
    [
        Question {
            id: "reconcile/1000",
            asks: "Two replicas of 1,000 vertices have made 1,000 mutations each (7 of 10 writes, 2 vertices, 1 edge); one \
                tells what it has, the other answers what it lacks, and it joins that.",
            heavy: false,
            turns: 1,
            sides: sides!(reconcile; Dsr, Yrs, Loro, AutomergeScene, Dson),
        },
        Question {
            id: "digest/1000",
            asks: "One of these replicas tells what it has, as bytes.",
            heavy: false,
            turns: TURNS,
            sides: sides!(digest; Dsr, Yrs, Loro, AutomergeScene, Dson),
        },
        Question {
            id: "missing/1000",
            asks: "The other one finds what is lacking by those bytes; the answer is bytes.",
            heavy: false,
            turns: TURNS,
            sides: sides!(missing; Dsr, Yrs, Loro, AutomergeScene, Dson),
        },
    ]
}

fn diverge<S: Reconciles>(replica: &mut S, plan: &Plan, prefix: &str) -> Result<()> {
    for at in 0..MUTATIONS {
        let vertex = at * 377 % VERTICES;
        #[allow(clippy::cast_precision_loss, reason = "at is small")]
        match at % 10 {
            0 | 5 => replica.add_vertex(&format!("{prefix}{at}"), vertex)?,
            3 => replica.add_edge(&Link::new(plan, vertex, (vertex + 500) % VERTICES))?,
            _ => replica.set(vertex, &Content::Double(at as f64 + 0.1))?,
        };
    }
    Ok(())
}

/// Two that have gone apart.
fn pair<S: Reconciles>() -> Result<(S, S)> {
    let plan = Plan::tree("vertex-", VERTICES, 10);
    let mut base = S::empty(1)?;
    base.populate(&plan)?;
    let bytes = base.save()?;
    let (mut here, mut there) = (S::load(2, &bytes)?, S::load(3, &bytes)?);
    for (replica, prefix) in [(&mut here, "here-"), (&mut there, "there-")] {
        replica.find(&plan)?;
        diverge(replica, &plan, prefix)?;
    }
    Ok((here, there))
}

/// The whole exchange.
pub fn reconcile<S: Reconciles + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut here, mut there) = pair::<S>()?;
    let mut is_checked = false;
    Ok(Side::of::<S>(move || {
        let mut joined = here.again()?;
        let ns = time(1, |_| {
            let digest = joined.digest()?;
            joined.apply(&there.missing(&digest)?)
        })?;
        if !is_checked && joined.count()? != TOGETHER {
            return not_the_job(S::NAME, "the vertices of both to be there");
        }
        is_checked = true;
        Ok(ns)
    }))
}

/// The digest.
pub fn digest<S: Reconciles + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut here, _) = pair::<S>()?;
    Ok(Side::of::<S>(move || {
        time(TURNS, |_| {
            black_box(here.digest()?);
            Ok(())
        })
    }))
}

/// The answer.
pub fn missing<S: Reconciles + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut here, mut there) = pair::<S>()?;
    let digest = here.digest()?;
    here.apply(&there.missing(&digest)?)?;
    if here.count()? != TOGETHER {
        return not_the_job(S::NAME, "what is lacking to be found");
    }
    Ok(Side::of::<S>(move || {
        time(TURNS, |_| {
            black_box(there.missing(&digest)?);
            Ok(())
        })
    }))
}
