//! Memory is counted over all threads, so this is a program of its own, with one test.
#![allow(clippy::unwrap_used, reason = "a test")]

use dsr_benches::sizes;

#[test]
fn law_a_vertex_takes_no_more_memory_than_stated() {
    let size = sizes::our_memory().unwrap();
    assert!((100..=400).contains(&size.bytes), "{}", size.bytes);
}
