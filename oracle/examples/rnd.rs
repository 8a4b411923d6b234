//! Scratch.
use dsr_oracle::program::Start;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let mut start = Start::new(&args[1]);
    for a in &args[4..] { start = start.with(a.clone()); }
    let (seed, n): (u64, u64) = (args[2].parse().unwrap(), args[3].parse().unwrap());
    let t = std::time::Instant::now();
    match dsr_oracle::random::run(&start, 2, seed, 0..n, &|_| {}) {
        Ok(f) => {
            println!("{} histories {} events {} facts {:.0}/s dis {}", f.counts.histories, f.counts.events, f.compared.tally.total(), f.compared.tally.total() as f64 / t.elapsed().as_secs_f64(), f.compared.disagreeing.load(std::sync::atomic::Ordering::Relaxed));
            for (k, v) in &f.counts.seen { println!("  {v:>8} {k}"); }
            println!("never: {:#?}", f.counts.never());
            if let Some(s) = f.shrunk { println!("history {} ({} events before)\n{}\n{}", s.history.number, s.events_before, dsr_oracle::random::tell(&s.history), s.disagreement.map(|d| d.to_string()).unwrap_or_default()); }
        }
        Err(e) => println!("{e}"),
    }
}
