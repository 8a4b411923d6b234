//! Runs scenarios and prints what was found: all shipped ones, or the files given.
use dsr_model::scenario::{Options, Scenario, Verdict, shipped};
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let verbose = args.iter().any(|a| a == "-v");
    let files: Vec<&String> = args.iter().filter(|a| *a != "-v").collect();
    let list: Vec<Scenario> = if files.is_empty() {
        shipped().iter().map(|(f, t)| Scenario::read(t, f).unwrap_or_else(|e| panic!("{e}"))).collect()
    } else {
        files.iter().map(|f| Scenario::open(std::path::Path::new(f)).unwrap_or_else(|e| panic!("{e}"))).collect()
    };
    for scenario in list {
        let report = scenario.check(Options::default());
        println!("{:<26} replicas {} mutations {} histories {} generated {} ends {} states {} deliveries {} {:.2}s complete {} {:?} repairs {:?} idle {:?} expected {}",
            report.name, report.replicas.len(), report.mutations, report.histories, report.generated, report.ends, report.states, report.deliveries, report.seconds, report.complete, report.coverage, report.repairs, report.idle, report.is_as_expected());
        if let Some(b) = &report.breach { println!("BREACH {} {}", b.clause, b.detail); if let Some(t) = &b.trace { println!("{t}"); } }
        for p in &report.properties {
            println!("    {:<16} {:<14} {} [{}]", p.kind.name(), p.verdict.to_string(), p.name, p.trace.as_ref().map_or(-1, |t| t.mutations as i64));
            if let Some(t) = &p.trace && (verbose || p.verdict == Verdict::Violated) { println!("{t}"); }
        }
    }
}
