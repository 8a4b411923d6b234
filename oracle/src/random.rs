//! Random histories of hostile shape, beside the program. `[spec: ORACLE-4]`
//!
//! A history is drawn while the core carries it out, so that what replicas do meets what they see; history `n` of a seed is
//! the same for ever, on any number of threads. Nobody can see from here whether it disagrees: its facts are asked, and what
//! disagrees is shrunk and told.
//!
//! | room | what |
//! |---|---|
//! | `vocabulary` | few names, labels, values, so that everything collides |
//! | `outside` | well-formed states that nobody has made |
//! | `mutations` | what a replica tries |
//! | `world` | a history, and what becomes of it |
//! | `draw` | how a history is drawn |
//! | `counts` | what occurred, and what had to |
//! | `shrink` | the shortest history that still disagrees |
//! | `tell` | a history for people |

mod counts;
mod draw;
mod mutations;
mod outside;
mod shrink;
mod tell;
mod vocabulary;
mod world;

pub use counts::{Counts, EXPECTED};
pub use draw::draw;
pub use shrink::{Shrunk, shrink};
pub use tell::tell;
pub use world::{Event, History, carry_out};

use crate::compare::{Compared, ask_numbered};
use crate::program::{Start, Trouble};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Histories in one batch.
const BATCH: u64 = 16;

/// What many histories have shown.
#[derive(Debug)]
pub struct RandomFound {
    /// What was asked, and what disagreed: each disagreement is about the number of its history.
    pub compared: Compared,
    /// What occurred.
    pub counts: Counts,
    /// The first history that disagrees, shrunk.
    pub shrunk: Option<Shrunk>,
}

/// Draws and asks the histories of these numbers; calls `done` with how many more were handed over, now and then. Stops
/// early once something disagrees, and shrinks the least of what disagreed. `[spec: ORACLE-5]`
pub fn run(
    start: &Start,
    jobs: usize,
    seed: u64,
    numbers: Range<u64>,
    done: &(dyn Fn(u64) + Sync),
) -> Result<RandomFound, Trouble> {
    let compared = Compared::default();
    let counts = Mutex::new(Counts::default());
    let batches = 0..(numbers.end - numbers.start).div_ceil(BATCH);
    ask_numbered(start, jobs, batches, &compared, &|batch| {
        let first = numbers.start + batch * BATCH;
        let own = first..(first + BATCH).min(numbers.end);
        done(own.end - own.start);
        if compared.disagreeing.load(std::sync::atomic::Ordering::Relaxed) > 0 {
            compared.stop();
        }
        let mut facts = Vec::new();
        let mut own_counts = Counts::default();
        for number in own {
            facts.extend(carry_out(&draw(seed, number), &mut own_counts));
        }
        counts.lock().unwrap_or_else(PoisonError::into_inner).add(&own_counts);
        facts
    });
    if let Some(trouble) = compared.trouble() {
        return Err(trouble);
    }
    let least = compared.about().into_iter().next();
    let shrunk = least.map(|number| shrink(start, &draw(seed, number))).transpose()?;
    Ok(RandomFound { compared, counts: counts.into_inner().unwrap_or_else(PoisonError::into_inner), shrunk })
}
