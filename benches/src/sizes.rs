//! Bytes: of every delta on the wire, and of a vertex in memory.

use crate::error::{Result, not_the_job};
use crate::libraries::{AutomergeScene, Crdts, Dson, Dsr, Loro, Yrs};
use crate::memory::bytes_of;
use crate::scene::{Content, Link, Plan, Scene, Tree};
use dsr_core::{AttributeMap, AttributeUpdates, EdgeKey, ElementId, Mutation, RT, Value, VertexId};

/// A number of bytes.
#[derive(Clone, Debug)]
pub struct Size {
    /// Of what, and whose: `delta/f64/yrs`.
    pub id: String,
    /// The bytes.
    pub bytes: usize,
}

const VERTICES: usize = 1000;
/// Vertices of the replica whose memory is measured.
const MANY: usize = 100_000;

/// The sizes of all libraries. Exact, and the same on every run, but for what is compressed.
pub fn wire() -> Result<Vec<Size>> {
    let mut sizes = Vec::new();
    deltas::<Dsr>(&mut sizes)?;
    deltas::<Yrs>(&mut sizes)?;
    deltas::<Loro>(&mut sizes)?;
    deltas::<AutomergeScene>(&mut sizes)?;
    deltas::<Crdts>(&mut sizes)?;
    deltas::<Dson>(&mut sizes)?;
    moved::<Dsr>(&mut sizes)?;
    moved::<Loro>(&mut sizes)?;
    own(&mut sizes)?;
    Ok(sizes)
}

/// Bytes per vertex with name, type and one edge, and no attributes, of 100,000.
pub fn memory() -> Result<Vec<Size>> {
    Ok(vec![held::<Dsr>()?, held::<Yrs>()?, held::<Loro>()?, held::<AutomergeScene>()?, held::<Crdts>()?])
}

/// Memory of ours alone: it is exact.
pub fn our_memory() -> Result<Size> {
    held::<Dsr>()
}

fn held<S: Scene>() -> Result<Size> {
    let plan = Plan::tree("vertex-", MANY, 10);
    let mut author = S::empty(1)?;
    author.populate(&plan)?;
    let bytes = author.save()?;
    drop(author);
    // As a replica holds it that keeps no table of vertices beside it. Some decode when they are first read.
    let (held, read) = bytes_of(|| -> Result<(S, usize)> {
        let late = S::load(2, &bytes)?;
        let count = late.count()?;
        Ok((late, count))
    });
    let (replica, count) = read?;
    drop(replica);
    if count != MANY {
        return not_the_job(S::NAME, "all vertices to be there");
    }
    let bytes = usize::try_from(held).unwrap_or(0) / MANY;
    Ok(Size { id: format!("memory/vertex/{}", S::NAME), bytes })
}

fn author<S: Scene>(plan: &Plan) -> Result<S> {
    let mut author = S::empty(1)?;
    author.populate(plan)?;
    Ok(author)
}

fn deltas<S: Scene>(sizes: &mut Vec<Size>) -> Result<()> {
    let plan = Plan::tree("vertex-", VERTICES, 10);
    let mut author = author::<S>(&plan)?;
    let mut note = |what: &str, bytes: &[u8]| {
        sizes.push(Size { id: format!("delta/{what}/{}", S::NAME), bytes: bytes.len() });
    };
    note("all of 1000 vertices", &author.save()?);
    // Each value replaces another one, as a sensor's does.
    let numbers = [Content::Double(0.1), Content::Double(0.7)];
    let payloads = |n| [Content::payload(n, 1), Content::payload(n, 2)];
    for (what, contents) in [("f64", numbers), ("60kB", payloads(60_000)), ("5MB", payloads(5_000_000))] {
        author.set(500, &contents[0])?;
        note(what, &author.set(500, &contents[1])?);
    }
    note("add vertex", &author.add_vertex("cup", 500)?);
    note("remove vertex", &author.remove_last_vertex("cup")?);
    let link = Link::new(&plan, 500, 700);
    note("add edge", &author.add_edge(&link)?);
    note("remove edge", &author.remove_edge(&link)?);
    Ok(())
}

fn moved<S: Tree>(sizes: &mut Vec<Size>) -> Result<()> {
    let mut author = author::<S>(&Plan::tree("vertex-", VERTICES, 10))?;
    let bytes = author.move_below(900, 5)?.len();
    sizes.push(Size { id: format!("delta/move/{}", S::NAME), bytes });
    Ok(())
}

/// What only ours has: a pose as the published system writes it, two vectors of three 32-bit floats on an edge; a number
/// without a clock's reading; an edge with an attribute.
fn own(sizes: &mut Vec<Size>) -> Result<()> {
    let mut author = author::<Dsr>(&Plan::tree("vertex-", VERTICES, 10))?;
    let (parent, child) = (author.vertex(50), author.vertex(501));
    let Some(edge) = author.replica().edge_by_key(&EdgeKey::new(parent, RT, child)) else {
        return not_the_job(Dsr::NAME, "an edge to be there");
    };
    let pose = |names: [&str; 2], shift: f32| Mutation::UpdateAttributes {
        target: ElementId::Edge(edge),
        updates: AttributeUpdates::from([
            (names[0].into(), Some(Value::Vec3([shift, 1.25, 0.875]))),
            (names[1].into(), Some(Value::Vec3([0.0, 0.0, shift]))),
        ]),
    };
    let published = ["rt_translation", "rt_rotation_euler_xyz"];
    for (what, names) in [("pose, published names", published), ("pose, names of one letter", ["t", "r"])] {
        author.encoded(&pose(names, 0.1))?;
        let bytes = author.encoded(&pose(names, 0.2))?.len();
        sizes.push(Size { id: format!("delta/{what}/dsr"), bytes });
    }
    author.set_without_clock(500, &Content::Double(0.1))?;
    let bytes = author.set_without_clock(500, &Content::Double(0.7))?.len();
    sizes.push(Size { id: "delta/f64 without a clock/dsr".into(), bytes });
    let bytes = author.encoded(&Mutation::AddEdge {
        key: EdgeKey::new(VertexId::ROOT, "sees", child),
        attributes: AttributeMap::from([("level".into(), Value::Double(0.7))]),
    })?;
    sizes.push(Size { id: "delta/add edge with a number/dsr".into(), bytes: bytes.len() });
    Ok(())
}
