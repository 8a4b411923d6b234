//! Vertices and edges that come and go; at the author, and at another replica.

use super::{Question, sides};
use crate::contest::Side;
use crate::error::{Result, not_the_job};
use crate::scene::{Link, Plan, Scene};
use crate::stopwatch::time;
use std::marker::PhantomData;

const VERTICES: usize = 1000;
const TURNS: usize = 100;

pub(super) fn questions() -> [Question; 8] {
    let question = |id, asks, sides| Question { id, asks, heavy: false, turns: TURNS, sides };
    [
        question(
            "vertex/add",
            "A vertex below one of 1,000 is added; the delta is bytes.",
            sides!(add_vertex; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        ),
        question(
            "vertex/add/apply",
            "The bytes of such a delta are joined at another replica.",
            sides!(apply_vertex; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        ),
        question(
            "vertex/remove",
            "A vertex is removed; the delta is bytes.",
            sides!(remove_vertex; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        ),
        question(
            "vertex/remove/apply",
            "The bytes of such a delta are joined at another replica.",
            sides!(apply_removed_vertex; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        ),
        question(
            "edge/add",
            "A symbolic edge between two of 1,000 vertices is added; the delta is bytes.",
            sides!(add_edge; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        ),
        question(
            "edge/add/apply",
            "The bytes of such a delta are joined at another replica.",
            sides!(apply_edge; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        ),
        question(
            "edge/remove",
            "A symbolic edge is removed; the delta is bytes.",
            sides!(remove_edge; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        ),
        question(
            "edge/remove/apply",
            "The bytes of such a delta are joined at another replica.",
            sides!(apply_removed_edge; Dsr, Yrs, Loro, AutomergeScene, Crdts, Dson),
        ),
    ]
}

/// Which part of a round counts.
#[derive(Clone, Copy, PartialEq)]
enum Counts {
    Add,
    ApplyAdded,
    Remove,
    ApplyRemoved,
}

/// What comes and goes.
trait Element<S: Scene> {
    fn add(&self, author: &mut S, turn: usize) -> Result<Vec<u8>>;
    /// In the reverse order of adding.
    fn remove(&self, author: &mut S, turn: usize) -> Result<Vec<u8>>;
    fn is_there(&self, reader: &S, turn: usize) -> Result<bool>;
}

/// Vertices, by their names.
struct Vertices(Vec<String>);

impl<S: Scene> Element<S> for Vertices {
    fn add(&self, author: &mut S, turn: usize) -> Result<Vec<u8>> {
        author.add_vertex(&self.0[turn], turn * 7 % VERTICES)
    }

    fn remove(&self, author: &mut S, turn: usize) -> Result<Vec<u8>> {
        author.remove_last_vertex(&self.0[turn])
    }

    fn is_there(&self, reader: &S, _turn: usize) -> Result<bool> {
        Ok(reader.count()? == VERTICES + 1)
    }
}

struct Edges(Vec<Link>);

impl<S: Scene> Element<S> for Edges {
    fn add(&self, author: &mut S, turn: usize) -> Result<Vec<u8>> {
        author.add_edge(&self.0[turn])
    }

    fn remove(&self, author: &mut S, turn: usize) -> Result<Vec<u8>> {
        author.remove_edge(&self.0[turn])
    }

    fn is_there(&self, reader: &S, turn: usize) -> Result<bool> {
        reader.has_edge(&self.0[turn])
    }
}

/// `TURNS` come, then they go; at the author, and at a reader.
fn come_and_go<S: Scene + 'static>(counts: Counts, make: fn(&Plan) -> Box<dyn Element<S>>) -> Result<Side> {
    let plan = Plan::tree("vertex-", VERTICES, 10);
    let element = make(&plan);
    let mut author = S::empty(1)?;
    author.populate(&plan)?;
    let mut reader = S::load(2, &author.save()?)?;
    reader.find(&plan)?;
    reader.apply(&element.add(&mut author, 0)?)?;
    let came = element.is_there(&reader, 0)?;
    reader.apply(&element.remove(&mut author, 0)?)?;
    if !came || element.is_there(&reader, 0)? {
        return not_the_job(S::NAME, "an element to come and go");
    }
    Ok(Side::of::<S>(move || {
        let (mut added, mut removed) = (Vec::new(), Vec::new());
        let add = time(TURNS, |turn| {
            added.push(element.add(&mut author, turn)?);
            Ok(())
        })?;
        let apply_added = time(TURNS, |turn| reader.apply(&added[turn]))?;
        let remove = time(TURNS, |turn| {
            removed.push(element.remove(&mut author, TURNS - 1 - turn)?);
            Ok(())
        })?;
        let apply_removed = time(TURNS, |turn| reader.apply(&removed[turn]))?;
        Ok(match counts {
            Counts::Add => add,
            Counts::ApplyAdded => apply_added,
            Counts::Remove => remove,
            Counts::ApplyRemoved => apply_removed,
        })
    }))
}

fn vertices<S: Scene + 'static>(counts: Counts) -> Result<Side> {
    come_and_go::<S>(counts, |_| Box::new(Vertices((0..TURNS).map(|turn| format!("new-{turn}")).collect())))
}

fn edges<S: Scene + 'static>(counts: Counts) -> Result<Side> {
    come_and_go::<S>(counts, |plan| {
        let link = |turn| Link::new(plan, turn * 7 % VERTICES, (turn * 7 + 500) % VERTICES);
        Box::new(Edges((0..TURNS).map(link).collect()))
    })
}

/// Vertices come.
pub fn add_vertex<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    vertices::<S>(Counts::Add)
}

/// Vertices come to a reader.
pub fn apply_vertex<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    vertices::<S>(Counts::ApplyAdded)
}

/// Vertices go.
pub fn remove_vertex<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    vertices::<S>(Counts::Remove)
}

/// Vertices go at a reader.
pub fn apply_removed_vertex<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    vertices::<S>(Counts::ApplyRemoved)
}

/// Edges come.
pub fn add_edge<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    edges::<S>(Counts::Add)
}

/// Edges come to a reader.
pub fn apply_edge<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    edges::<S>(Counts::ApplyAdded)
}

/// Edges go.
pub fn remove_edge<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    edges::<S>(Counts::Remove)
}

/// Edges go at a reader.
pub fn apply_removed_edge<S: Scene + 'static>(_: &Question, _: PhantomData<S>) -> Result<Side> {
    edges::<S>(Counts::ApplyRemoved)
}
