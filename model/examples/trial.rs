//! Trial.
use dsr_core::*;
use dsr_model::checked::{Checked, alphabet::Alphabet};
use dsr_model::histories::*;
use stateright::{Checker, Model};
use std::time::Instant;
#[global_allocator]
static A: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn apply(state: &mut State, dictionary: &Dictionary, m: Mutation) -> VertexId {
    let dot = state.next_dot(ReplicaId::SCENE).unwrap();
    let d = m.delta(&view(state, dictionary), Author::new(ReplicaId::SCENE)).unwrap();
    state.join(&d);
    VertexId(dot)
}
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let focus_n: usize = args[1].parse().unwrap();
    let r: usize = args[2].parse().unwrap();
    let k: usize = args[3].parse().unwrap();
    let sym = args[4] == "sym";
    let kinds: Vec<MutationKind> = args[5..].iter().map(|n| MutationKind::from_name(n).unwrap()).collect();
    let dictionary = Dictionary::open().with_functional("in");
    let mut s = State::new();
    let av = |name: &str, link| Mutation::AddVertex { vertex: NewVertex::new("object", name), link };
    let a = apply(&mut s, &dictionary, av("a", VertexLink::child_of(VertexId::ROOT)));
    let b = apply(&mut s, &dictionary, av("b", VertexLink::child_of(VertexId::ROOT)));
    apply(&mut s, &dictionary, Mutation::AddEdge { key: EdgeKey::new(b, "in", a), attributes: AttributeMap::new() });
    apply(&mut s, &dictionary, Mutation::UpdateAttributes { target: ElementId::Vertex(b), updates: [("level".into(), Some(Value::Int(1)))].into() });
    let mut focus = vec![a, b];
    if focus_n > 2 { focus.push(apply(&mut s, &dictionary, av("c", VertexLink::child_of(a)))); }
    if focus_n > 3 { focus.push(apply(&mut s, &dictionary, av("d", VertexLink::to("in", a)))); }
    let alphabet = if kinds.is_empty() { Alphabet::all(focus) } else { Alphabet::of(&kinds, focus) };
    let sem = Checked { dictionary, initial: s, alphabet };
    let t = Instant::now();
    let model = HistoryModel::new(&sem, Bound { replicas: r, mutations: k }, sym);
    // SAFETY-free trick: leak for 'static
    let sem: &'static Checked = Box::leak(Box::new(sem.clone()));
    drop(model);
    let model = HistoryModel::new(sem, Bound { replicas: r, mutations: k }, sym);
    let checker = model.checker().threads(1).spawn_dfs().join();
    let secs = t.elapsed().as_secs_f64();
    let m = checker.model();
    m.inspect(|h, fault| {
        let (st, de) = h.tables().sizes();
        let (d, dia) = h.judged();
        let ops = {
            use dsr_model::semantics::Semantics;
            sem.mutations(&sem.initial, 0).iter().filter(|m| sem.mutate(&sem.initial, 0, m).is_some()).count()
        };
        println!("ops {ops} unique {} expanded/gen {:?} states {st} deltas {de} delivered sets {d} diamonds {dia} judged {} witnesses {:b} secs {secs:.2} rate {:.0}/s", checker.unique_state_count(), (), h.tables().judged, h.tables().witnesses.0, checker.unique_state_count() as f64 / secs);
        if let Some(f) = fault { println!("FAULT {f:?}"); }
    });
    println!("{:?}", m.counts());
}
