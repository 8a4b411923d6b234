//! L0 on the production core.

use dsr_core::{Dictionary, Dot, Edge, Record, Repair, ReplicaId, State, Vertex, VertexId, Write, view};
use dsr_model::algebra::{Quantifier, run};
use dsr_model::checked::Checked;
use dsr_model::checked::alphabet::Alphabet;
use dsr_model::semantics::Semantics;
use std::collections::BTreeMap;

fn core() -> Checked {
    let dictionary = Dictionary::open().with_functional("in");
    Checked { dictionary, initial: State::new(), alphabet: Alphabet::all(vec![]) }
}

/// [spec: CHECK-2] [spec: JOIN-1] [spec: JOIN-3] [spec: JOIN-4] [spec: CLOSE-1] [spec: CLOSE-2]
/// [spec: CLOSE-3] [spec: CLOSE-4] [spec: STATE-3] [spec: SYNC-2] [spec: SYNC-3] [spec: SYNC-5]
#[test]
fn law_the_core_keeps_every_law_over_three_and_four_records() {
    for (records, states) in [(3, 27), (4, 81)] {
        let report = run(&core(), records);
        for law in &report.laws {
            println!("{:9} {:8} {}", law.instances, law.clause, law.law);
        }
        println!("{} instances", report.instances());
        assert_eq!(report.states, states * report.families);
        let faults: Vec<_> = report.laws.iter().filter(|law| law.is_violated()).collect();
        assert!(faults.is_empty(), "{faults:#?}");
        let vacuous: Vec<_> = report.laws.iter().filter(|law| law.is_vacuous()).map(|law| law.law).collect();
        assert!(vacuous.is_empty(), "{vacuous:?}");
        assert!(report.laws.iter().any(|law| law.quantifier == Quantifier::Some && law.example.is_some()));
    }
}

/// All triples of all states, closed or not, would be 3^12; of the closed ones fewer. [spec: CHECK-2]
#[test]
fn law_all_triples_are_looked_at() {
    let report = run(&core(), 4);
    let associativity = report.laws.iter().find(|law| law.law.starts_with("associativity")).unwrap();
    let universe = dsr_model::algebra::core_universe(4);
    let triples: usize = universe.iter().map(|family| family.closed.len().pow(3)).sum();
    assert_eq!(associativity.instances, triples as u64);
}

/// The state with its agents and stamps renamed in their order.
fn stretched(state: &State) -> State {
    let dot = |dot: Dot| match dot.replica.agent {
        0 => dot,
        agent => Dot::new(ReplicaId::agent(agent * 5), dot.sequence),
    };
    let vertex = |id: VertexId| VertexId(dot(id.0));
    let records = state.records().map(|(at, record)| {
        let stamp = record.stamp() * 10 + 3;
        let record = match record.clone() {
            Record::Vertex(record) => Record::Vertex(Vertex { stamp, ..record }),
            Record::Edge(edge) => {
                Record::Edge(Edge { from: vertex(edge.from), to: vertex(edge.to), stamp, ..edge })
            }
            Record::Write(write) => Record::Write(Write { target: dot(write.target), stamp, ..write }),
        };
        (dot(at), record)
    });
    let seen = state.context().runs().flat_map(dsr_core::Run::dots).map(dot);
    State::assemble(records, seen.collect())
}

/// States of one shape have one verdict and one set of repairs; renaming in order keeps the shape.
/// [spec: CHECK-11]
#[test]
fn law_states_of_one_shape_have_one_verdict() {
    let core = core();
    let mut known = BTreeMap::new();
    let mut shared = 0;
    for family in dsr_model::algebra::core_universe(4) {
        for &at in &family.closed {
            let state = &family.all[at];
            let renamed = core.rename_state(state, &[1, 0]);
            assert_eq!(core.shape(state), core.shape(&stretched(state)), "{state:?}");
            for state in [state, &renamed, &stretched(state)] {
                let shown = view(state, &core.dictionary);
                let kinds: Vec<_> = shown.repairs().iter().map(Repair::kind).collect();
                let verdict = (core.judge(state), shown.vertices().len(), shown.edges().len(), kinds);
                let shape = format!("{:?}", core.shape(state).unwrap());
                if let Some(expected) = known.insert(shape, verdict.clone()) {
                    assert_eq!(verdict, expected, "{state:?}");
                    shared += 1;
                }
            }
        }
    }
    assert!(shared > known.len(), "{shared} verdicts shared by {} shapes", known.len());
}
