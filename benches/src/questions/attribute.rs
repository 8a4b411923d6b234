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
/// Writes of a round, enough that caches which the peers have emptied do not matter.
const SMALL: usize = 1000;
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
            turns: 20,
            sides: sides!(unencoded; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "update/5MB",
            asks: "5,000,000 bytes are set; the delta is bytes.",
            heavy: true,
            turns: 4,
            sides: sides!(update; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
        Question {
            id: "apply/5MB",
            asks: "The bytes of such a delta are joined at another replica.",
            heavy: true,
            turns: 4,
            sides: sides!(apply; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        },
    ]
}

/// The writes of one question. No value is written where it is already: some libraries would do nothing.
struct Writes {
    payloads: Vec<Content>,
    made: usize,
}

impl Writes {
    fn of(question: &Question) -> Self {
        // One more than the vertices that they are written to.
        let payloads = |n| (0..3).map(|seed| Content::payload(n, seed)).collect();
        let payloads = match question.id {
            id if id.contains("60kB") => payloads(LARGE),
            id if id.contains("5MB") => payloads(HUGE),
            _ => Vec::new(),
        };
        Self { payloads, made: 0 }
    }

    /// The next write: payloads go to few vertices, so that histories do not fill the memory.
    #[allow(clippy::cast_precision_loss, reason = "writes are few")]
    fn next(&mut self) -> (usize, Content) {
        self.made += 1;
        match self.payloads.get(self.made % 3) {
            Some(payload) => (self.made % 2, payload.clone()),
            None => (self.made * STRIDE % VERTICES, Content::Double(self.made as f64 + 0.1)),
        }
    }

    fn take(&mut self, turns: usize) -> Vec<(usize, Content)> {
        (0..turns).map(|_| self.next()).collect()
    }
}

/// An author, and a reader who follows.
fn pair<S: Scene>(writes: &mut Writes) -> Result<(S, S)> {
    let plan = Plan::tree("vertex-", VERTICES, 10);
    let mut author = S::empty(1)?;
    author.populate(&plan)?;
    let mut reader = S::load(2, &author.save()?)?;
    reader.find(&plan)?;
    // As often as every payload comes to every vertex.
    for (vertex, value) in writes.take(6) {
        reader.apply(&author.set(vertex, &value)?)?;
        check(&reader, vertex, &value)?;
    }
    Ok((author, reader))
}

fn check<S: Scene>(replica: &S, vertex: usize, value: &Content) -> Result<()> {
    if replica.read(vertex)?.as_ref() == Some(value) {
        Ok(())
    } else {
        not_the_job(S::NAME, "a value to be set, and to arrive")
    }
}

/// An author who sets an attribute.
pub fn update<S: Scene + 'static>(question: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut writes, turns) = (Writes::of(question), question.turns);
    let (mut author, _) = pair::<S>(&mut writes)?;
    Ok(Side::of::<S>(move || {
        let writes = writes.take(turns);
        time(turns, |turn| {
            let (vertex, value) = &writes[turn];
            black_box(author.set(*vertex, value)?);
            Ok(())
        })
    }))
}

/// An author who sets an attribute and encodes nothing.
pub fn unencoded<S: Scene + 'static>(question: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut writes, turns) = (Writes::of(question), question.turns);
    let (mut author, _) = pair::<S>(&mut writes)?;
    let (vertex, value) = writes.next();
    author.set_unencoded(vertex, &value)?;
    check(&author, vertex, &value)?;
    Ok(Side::of::<S>(move || {
        // Copies of the peers have emptied the caches: the first write fills them.
        let (vertex, value) = writes.next();
        author.set_unencoded(vertex, &value)?;
        let writes = writes.take(turns);
        time(turns, |turn| {
            let (vertex, value) = &writes[turn];
            author.set_unencoded(*vertex, value)
        })
    }))
}

/// A reader who follows.
pub fn apply<S: Scene + 'static>(question: &Question, _: PhantomData<S>) -> Result<Side> {
    let (mut writes, turns) = (Writes::of(question), question.turns);
    let (mut author, mut reader) = pair::<S>(&mut writes)?;
    Ok(Side::of::<S>(move || {
        let set = |(vertex, value): (usize, Content)| author.set(vertex, &value);
        let messages: Vec<Vec<u8>> = writes.take(turns).into_iter().map(set).collect::<Result<_>>()?;
        time(turns, |turn| reader.apply(&messages[turn]))
    }))
}
