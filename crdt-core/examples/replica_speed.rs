//! Nanoseconds per operation of a `Replica`, by the size of its graph, and bytes per vertex.
//!
//! `cargo run --release -p dsr-core --example replica_speed [LARGEST]`; LARGEST is a power of ten, 1000000
//! unless given. Prints a table; asserts nothing about time.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss, reason = "a measurement for people")]

use dsr_core::{
    AttributeMap, AttributeUpdates, Delta, Dictionary, EdgeKey, Mutation, NewVertex, RT, Replica, ReplicaId,
    Value, VertexId, VertexLink, delta_for, encode, view,
};
use std::hint::black_box;
use std::time::Instant;

/// Children of a vertex.
const FAN: usize = 10;

/// Noise of Knuth's constants: the same on every run.
struct Noise(u64);

impl Noise {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % n
    }
}

fn set(vertex: VertexId, name: &str, value: i32) -> Mutation {
    let updates = AttributeUpdates::from([(name.into(), Some(Value::Int(value)))]);
    Mutation::UpdateAttributes { target: dsr_core::ElementId::Vertex(vertex), updates }
}

fn resident_bytes() -> f64 {
    let statm = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    statm.split(' ').nth(1).and_then(|pages| pages.parse::<f64>().ok()).unwrap_or(0.0) * 4096.0
}

/// A tree of `n` vertices, each the `FAN`-th part down, and the vertices.
fn tree(n: usize, agent: u32) -> (Replica, Vec<VertexId>) {
    let mut replica = Replica::new(ReplicaId::agent(agent), Dictionary::open().with_functional("in"));
    let mut vertices: Vec<VertexId> = Vec::with_capacity(n);
    for at in 0..n {
        let parent = if at < FAN { VertexId::ROOT } else { vertices[at / FAN] };
        let vertex = NewVertex::new("thing", &format!("thing-{agent}-{at}"));
        let made = replica.mutate(&Mutation::AddVertex { vertex, link: VertexLink::child_of(parent) }, 0);
        vertices.push(VertexId(made.unwrap().delta.records().next().unwrap().0));
    }
    (replica, vertices)
}

/// The processor time of this program in nanoseconds: others on the machine do not count. Elsewhere than on
/// Linux the time that has passed.
fn now(start: Instant) -> f64 {
    let schedstat = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let used = schedstat.split(' ').next().and_then(|ns| ns.parse().ok());
    used.unwrap_or(start.elapsed().as_nanos() as f64)
}

/// Nanoseconds per turn.
fn time(turns: usize, mut turn: impl FnMut(usize)) -> f64 {
    let begin = Instant::now();
    let start = now(begin);
    for at in 0..turns {
        turn(at);
    }
    (now(begin) - start) / turns as f64
}

fn deltas(from: &mut Replica, mutations: impl Iterator<Item = Mutation>) -> Vec<Delta> {
    mutations.map(|mutation| from.mutate(&mutation, 0).unwrap().delta).collect()
}

fn row(n: usize) -> Vec<(&'static str, f64)> {
    let mut row = Vec::new();
    let mut made = None;
    row.push(("add vertex", time(1, |_| made = Some(tree(n, 1))) / n as f64));
    let (mut replica, vertices) = made.unwrap();
    let mut noise = Noise(1);
    let turns = 20_000;

    let mut other = Replica::new(ReplicaId::agent(2), Dictionary::open().with_functional("in"));
    let state = replica.state();
    row.push(("join into empty /vertex", time(1, |_| drop(other.apply(&state))) / n as f64));
    drop(state);

    let targets: Vec<VertexId> = (0..turns).map(|_| vertices[noise.below(n)]).collect();
    let writes = deltas(&mut other, targets.iter().map(|&target| set(target, "level", 1)));
    row.push(("apply write", time(turns, |at| drop(black_box(replica.apply(&writes[at]))))));
    row.push(("apply write again", time(turns, |at| drop(black_box(replica.apply(&writes[at]))))));
    let hot: Vec<Mutation> = (0..turns).map(|at| set(targets[at % 8], "level", 2)).collect();
    let writes = deltas(&mut other, hot.iter().cloned());
    row.push(("apply write, 8 hot", time(turns, |at| drop(black_box(replica.apply(&writes[at]))))));
    let updates: Vec<Mutation> = targets.iter().map(|&target| set(target, "level", 3)).collect();
    row.push((
        "update + encode",
        time(turns, |at| {
            black_box(encode(&replica.mutate(&updates[at], 0).unwrap().delta));
        }),
    ));
    row.push((
        "update + encode, 8 hot",
        time(turns, |at| {
            black_box(encode(&replica.mutate(&hot[at], 0).unwrap().delta));
        }),
    ));
    let moves: Vec<Mutation> = {
        // Leaves, there and back between two parents.
        let leaf = |at: usize| vertices[n - 1 - (at / 2) % (n / 4)];
        let key = |parent, child| EdgeKey::new(parent, RT, child);
        let home = |at: usize| vertices[(n - 1 - (at / 2) % (n / 4)) / FAN];
        let away = vertices[FAN - 1];
        (0..turns / 2 * 2)
            .map(|at| {
                let (from, to) = (key(home(at), leaf(at)), key(away, leaf(at)));
                let (from, to) = if at % 2 == 0 { (from, to) } else { (to, from) };
                Mutation::MoveEdge { from, to, attributes: AttributeMap::new() }
            })
            .filter(|mutation| !matches!(mutation, Mutation::MoveEdge { from, to, .. } if from == to))
            .collect()
    };
    row.push((
        "move in the tree",
        time(moves.len(), |at| drop(black_box(replica.mutate(&moves[at], 0).unwrap()))),
    ));
    let edges: Vec<Mutation> = (0..turns)
        .map(|at| {
            let (from, to) = (targets[at], targets[(at + 1) % turns]);
            Mutation::AddEdge { key: EdgeKey::new(from, "near", to), attributes: AttributeMap::new() }
        })
        .collect();
    row.push((
        "add edge, remove it",
        time(turns, |at| {
            if let (Ok(_), Mutation::AddEdge { key, .. }) = (replica.mutate(&edges[at], 0), &edges[at]) {
                black_box(replica.mutate(&Mutation::RemoveEdge { key: key.clone() }, 0).unwrap());
            }
        }),
    ));
    row.push(("look up a name", {
        let names: Vec<_> = targets.iter().map(|&target| replica.vertex(target).unwrap().name).collect();
        time(turns, |at| {
            black_box(replica.vertex_by_name(&names[at]));
        })
    }));
    row.push(("snapshot", time(turns, |_| drop(black_box(replica.snapshot())))));
    let mut kept = replica.snapshot();
    row.push((
        "update + encode + snapshot",
        time(turns, |at| {
            black_box(encode(&replica.mutate(&updates[at], 0).unwrap().delta));
            kept = replica.snapshot();
        }),
    ));
    drop(kept);
    row.push(("move at the end of a chain", chain(n)));
    row
}

/// A chain of `n` vertices, the worst case for whatever walks up: moves its last vertex there and back.
fn chain(n: usize) -> f64 {
    let mut replica = Replica::new(ReplicaId::agent(1), Dictionary::open());
    let mut vertices = vec![VertexId::ROOT];
    for at in 0..n {
        let vertex = NewVertex::new("thing", &format!("thing-{at}"));
        let link = VertexLink::child_of(vertices[at]);
        let made = replica.mutate(&Mutation::AddVertex { vertex, link }, 0).unwrap();
        vertices.push(VertexId(made.delta.records().next().unwrap().0));
    }
    let key = |parent: usize| EdgeKey::new(vertices[parent], RT, vertices[n]);
    time(20, |at| {
        let (from, to) = if at % 2 == 0 { (n - 1, n - 2) } else { (n - 2, n - 1) };
        let mutation = Mutation::MoveEdge { from: key(from), to: key(to), attributes: AttributeMap::new() };
        black_box(replica.mutate(&mutation, 0).unwrap());
    })
}

fn main() {
    let before = resident_bytes();
    let (kept, vertices) = tree(100_000, 1);
    drop(vertices);
    println!("{:.0} bytes per vertex with its edge, of 100000", (resident_bytes() - before) / 1e5);
    drop(kept);
    let largest = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1_000_000);
    let sizes: Vec<usize> =
        std::iter::successors(Some(100), |n| Some(n * 10)).take_while(|n| *n <= largest).collect();
    let rows: Vec<_> = sizes.iter().map(|&n| row(n)).collect();
    print!("{:28}", "ns");
    for n in &sizes {
        print!("{n:>10}");
    }
    println!("  exponent");
    for line in 0..rows[0].len() {
        print!("{:28}", rows[0][line].0);
        for row in &rows {
            print!("{:>10.0}", row[line].1);
        }
        let (first, last) = (rows[0][line].1, rows[rows.len() - 1][line].1);
        let span = sizes[sizes.len() - 1] as f64 / sizes[0] as f64;
        println!("{:>10.3}", (last / first).ln() / span.ln());
    }

    let ms = |what: &str, turn: &mut dyn FnMut()| println!("{what}: {:.1} ms", time(1, |_| turn()) / 1e6);
    let ((mut left, _), (right, _)) = (tree(100_000, 1), tree(100_000, 2));
    let (mine, theirs) = (left.state(), right.state());
    println!("two graphs of 100000 vertices:");
    ms("join", &mut || drop(black_box(left.clone().apply(&theirs))));
    ms("join by the reference", &mut || drop(black_box(mine.joined(&theirs))));
    ms("view by the reference", &mut || drop(black_box(view(&mine, left.dictionary()))));
    ms("join with itself", &mut || drop(black_box(left.apply(&mine))));
    let digest = left.digest();
    ms("delta for the other", &mut || drop(black_box(right.delta_for(&digest))));
    ms("delta for the other by the reference", &mut || drop(black_box(delta_for(&theirs, &digest))));
}
