//! L0 on the production core.

use dsr_core::{Dictionary, State};
use dsr_model::algebra::{Quantifier, run};
use dsr_model::checked::Checked;
use dsr_model::checked::alphabet::Alphabet;

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
