//! The example of `docs/your-own-semantics.md` does what the text says.

#[expect(dead_code, unreachable_pub, reason = "a program of its own")]
#[path = "../examples/last_writer_wins.rs"]
mod last_writer_wins;

use dsr_model::verdict::{RunReport, Verdict};
use last_writer_wins::{LastWriterWins, check};

fn mutations(report: &RunReport) -> usize {
    report.traces[0].text.lines().filter(|line| line.contains("  → m")).count()
}

/// First arrival decides ties: two orders, two outcomes. Once that is mended, an edge dangles.
/// `[spec: CHECK-3]` `[spec: CHECK-4]`
#[test]
fn canary_last_writer_wins_is_broken_twice() {
    let by_arrival = check(LastWriterWins { ties_by_replica: false });
    assert_eq!((by_arrival.verdict, &*by_arrival.traces[0].clause), (Verdict::Violated, "JOIN-3"));
    let by_replica = check(LastWriterWins { ties_by_replica: true });
    assert_eq!((by_replica.verdict, &*by_replica.traces[0].clause), (Verdict::Violated, "INV-2"));
    assert_eq!((mutations(&by_arrival), mutations(&by_replica)), (2, 2));
}
