//! Scratch.
use dsr_oracle::histories::*;
use dsr_oracle::program::Start;
use std::sync::Arc;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let mut start = Start::new(&args[1]);
    for a in &args[3..] { start = start.with(a.clone()); }
    let extent = match args[2].as_str() { "small" => Extent::Small, "deep" => Extent::Deep, _ => Extent::Default };
    let (mut total, t) = (0, std::time::Instant::now());
    for r in runs(extent).unwrap() {
        let p = Arc::new(dsr_model::progress::Progress::new(Default::default()));
        match run(&r, &start, 2, &p) {
            Ok(f) => {
                total += f.asked();
                println!("{} h={} st={} {:?} {:.1}s {} dis={} {}", f.name, f.histories, f.states, f.facts, f.seconds, f.complete, f.disagreeing, f.verdict());
                if let Some(c) = f.counterexample { println!("{}\n{}", c.disagreement, c.trace.unwrap_or_default()); break }
            }
            Err(e) => { println!("{}: {e}", r.name); break }
        }
    }
    println!("{total} facts, {:.0}/s", total as f64 / t.elapsed().as_secs_f64());
}
