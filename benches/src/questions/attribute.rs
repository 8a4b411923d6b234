//! Attributes: a small one, 60 kB, 5 MB; at the author, and at another replica.

use super::{Question, sides};
use crate::contest::Side;
use crate::error::{Result, not_the_job};
use crate::scene::{Content, Plan, Scene};
use crate::stopwatch::time;
use std::hint::black_box;
use std::marker::PhantomData;

const VERTICES: usize = 1000;
/// Vertices from one write to the next: no two in a row are neighbours.
const STRIDE: usize = 377;
const SMALL: usize = 200;
const LARGE: usize = 60_000;
const HUGE: usize = 5_000_000;

pub(super) fn questions() -> [Question; 8] {
    [
        Question {
            id: "update/f64",
            asks: "One number of one of 1,000 vertices is set; the delta is bytes.",
            heavy: false,
            turns: SMALL,
            sides: sides!(update; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "apply/f64",
            asks: "The bytes of such a delta are joined at another replica.",
            heavy: false,
            turns: SMALL,
            sides: sides!(apply; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "update/f64/unencoded",
            asks: "One number is set; the delta, if there is one, stays in memory.",
            heavy: false,
            turns: SMALL,
            sides: sides!(unencoded; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "update/60kB",
            asks: "60,000 bytes that a sensor has handed over are set; the delta is bytes.",
            heavy: false,
            turns: 20,
            sides: sides!(update; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "apply/60kB",
            asks: "The bytes of such a delta are joined at another replica.",
            heavy: false,
            turns: 20,
            sides: sides!(apply; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "update/5MB/unencoded",
            asks: "5,000,000 bytes are set; the delta, if there is one, stays in memory.",
            heavy: true,
            turns: 2,
            sides: sides!(unencoded; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "update/5MB",
            asks: "5,000,000 bytes are set; the delta is bytes.",
            heavy: true,
            turns: 2,
            sides: sides!(update; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "apply/5MB",
            asks: "The bytes of such a delta are joined at another replica.",
            heavy: true,
            turns: 2,
            sides: sides!(apply; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
    ]
}

/// The values of one question: another one for each write.
struct Values {
    payloads: Vec<Content>,
    written: f64,
}

impl Values {
    fn of(question: &Question) -> Self {
        let payload = |n| (0..2).map(|seed| Content::payload(n, seed)).collect();
        let payloads = match question.id {
            id if id.contains("60kB") => payload(LARGE),
            id if id.contains("5MB") => payload(HUGE),
            _ => Vec::new(),
        };
        Self { payloads, written: 0.1 }
    }

    fn next(&mut self, turn: usize) -> Content {
        self.written += 1.0;
        let payload = self.payloads.get(turn % self.payloads.len().max(1));
        payload.cloned().unwrap_or(Content::Double(self.written))
    }

    /// The vertices that are written in turn. Of payloads few, so that histories do not fill the memory.
    fn vertex(&self, turn: usize) -> usize {
        if self.payloads.is_empty() { turn * STRIDE % VERTICES } else { turn % 2 }
    }
}

/// An author, and a reader who follows.
fn pair<S: Scene>(values: &mut Values) -> Result<(S, S)> {
    let plan = Plan::tree("vertex-", VERTICES, 10);
    let mut author = S::empty(1)?;
    author.populate(&plan)?;
    let mut reader = S::load(2, &author.save()?)?;
    reader.find(&plan)?;
    let value = values.next(1);
    reader.apply(&author.set(1, &value)?)?;
    if reader.read(1)? != Some(value) {
        return not_the_job(S::NAME, "a value to arrive");
    }
    Ok((author, reader))
}

/// An author who sets an attribute.
pub fn update<S: Scene + 'static>(question: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut values, turns) = (Values::of(question), question.turns);
    let (mut author, _) = pair::<S>(&mut values)?;
    Ok(Side::of::<S>(move || {
        let contents: Vec<Content> = (0..turns).map(|turn| values.next(turn)).collect();
        time(turns, |turn| {
            black_box(author.set(values.vertex(turn), &contents[turn])?);
            Ok(())
        })
    }))
}

/// An author who sets an attribute and encodes nothing.
pub fn unencoded<S: Scene + 'static>(question: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut values, turns) = (Values::of(question), question.turns);
    let (mut author, _) = pair::<S>(&mut values)?;
    let value = values.next(0);
    author.set_unencoded(2, &value)?;
    if author.read(2)? != Some(value) {
        return not_the_job(S::NAME, "a value to be set");
    }
    Ok(Side::of::<S>(move || {
        let contents: Vec<Content> = (0..turns).map(|turn| values.next(turn)).collect();
        time(turns, |turn| author.set_unencoded(values.vertex(turn), &contents[turn]))
    }))
}

/// A reader who follows.
pub fn apply<S: Scene + 'static>(question: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut values, turns) = (Values::of(question), question.turns);
    let (mut author, mut reader) = pair::<S>(&mut values)?;
    Ok(Side::of::<S>(move || {
        let set = |turn| {
            let value = values.next(turn);
            author.set(values.vertex(turn), &value)
        };
        let messages: Vec<Vec<u8>> = (0..turns).map(set).collect::<Result<_>>()?;
        time(turns, |turn| reader.apply(&messages[turn]))
    }))
}
