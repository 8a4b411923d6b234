//! The same questions for looking closely: `cargo bench -p dsr-benches -- 'apply/f64/dsr'`.
#![allow(clippy::unwrap_used, missing_docs, reason = "a bench")]

use criterion::{Criterion, criterion_group, criterion_main};
use dsr_benches::questions;
use std::time::Duration;

fn ask(criterion: &mut Criterion) {
    for question in questions::all() {
        let mut group = criterion.benchmark_group(question.id);
        group.sample_size(10);
        for mut side in (question.sides)(&question, &|_| true).unwrap() {
            group.bench_function(side.library, |bencher| {
                bencher.iter_custom(|operations| {
                    // A round has many operations; what is told is as long as those that were asked for.
                    let rounds = operations.div_ceil(question.turns as u64);
                    let ns: f64 = (0..rounds).map(|_| (side.round)().unwrap()).sum();
                    #[allow(clippy::cast_precision_loss, reason = "rounds and operations are few")]
                    Duration::from_secs_f64(ns / rounds as f64 * operations as f64 / 1e9)
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, ask);
criterion_main!(benches);
