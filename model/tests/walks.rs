//! L3: random walks, and that what they find is shrunk.

use dsr_core::MutationKind;
use dsr_model::alarms::{A, Alarm, B, Broken, all};
use dsr_model::course::{lines, run};
use dsr_model::walks::{Faults, Walk, WalkFinding, find};
use std::sync::Arc;

const WALK: Walk = Walk { replicas: 3, mutations_max: 8, events_max: 80, seed: 1, faults: Faults::ALL };
/// Walks of each alarm.
const WALKS: u64 = 300;

fn core(alarm: &Alarm) -> Arc<Broken> {
    Arc::new(alarm.core(&MutationKind::ALL, &[A, B]))
}

fn found(alarm: &Alarm) -> Option<WalkFinding<Broken>> {
    find(&core(alarm), WALK, WALKS)
}

#[test]
fn experiment() {
    for alarm in all() {
        let start = std::time::Instant::now();
        let found = found(&alarm);
        let Some(found) = found else {
            println!("{:<24} NOT FOUND {:?}", alarm.name, start.elapsed());
            continue;
        };
        println!(
            "{:<24} walk {:>3} {:?} {} -> {} events in {} tries, {:?} {} {:?}",
            alarm.name,
            found.number,
            found.outcome.clause(),
            found.course.events.len(),
            found.shrunk.course.events.len(),
            found.shrunk.tries,
            found.shrunk.made,
            found.shrunk.is_minimal,
            start.elapsed()
        );
        let layers = dsr_model::alarms::run_alarm(&alarm, true);
        for layer in layers {
            if let Some(f) = layer.finding {
                println!(
                    "        {} {} {} steps {} ({:.1} s)",
                    f.layer, f.clause, f.steps, f.bound, layer.seconds
                );
            }
        }
        let outcome = run(&*found.shrunk.semantics, &found.shrunk.course, true);
        println!("{}", lines(&found.shrunk.course, &outcome).join("\n"));
    }
}
