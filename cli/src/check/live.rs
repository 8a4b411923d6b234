//! Runs on several cores, and what is seen of them meanwhile.

use crate::output::err;
use dsr_model::job::Job;
use dsr_model::progress::{Limits, Progress};
use dsr_model::verdict::RunReport;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

const REDRAW: Duration = Duration::from_millis(200);
/// How often a run that goes on is mentioned where there is no terminal.
const MENTION_SECONDS: u64 = 15;

/// Runs all jobs, `at_once` at a time; reports in the order of the jobs.
pub(super) fn run_all(
    jobs: &[Box<dyn Job>],
    limits: Limits,
    total_seconds_max: f64,
    at_once: usize,
) -> Vec<RunReport> {
    let started = Instant::now();
    let screen = std::io::stderr().is_terminal().then(MultiProgress::new);
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, RunReport)>> = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..at_once.min(jobs.len()) {
            scope.spawn(|| {
                while let Some((at, job)) = take(&next, jobs) {
                    let left = (total_seconds_max - started.elapsed().as_secs_f64()).max(0.0);
                    let limits = Limits { seconds_max: limits.seconds_max.min(left), ..limits };
                    let report = run_one(job, limits, screen.as_ref(), (at + 1, jobs.len()));
                    done.lock().unwrap_or_else(PoisonError::into_inner).push((at, report));
                }
            });
        }
    });
    let mut reports = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    reports.sort_by_key(|(at, _)| *at);
    reports.into_iter().map(|(_, report)| report).collect()
}

fn take<'j>(next: &AtomicUsize, jobs: &'j [Box<dyn Job>]) -> Option<(usize, &'j dyn Job)> {
    let at = next.fetch_add(1, Relaxed);
    jobs.get(at).map(|job| (at, &**job))
}

fn run_one(
    job: &dyn Job,
    limits: Limits,
    screen: Option<&MultiProgress>,
    (at, of): (usize, usize),
) -> RunReport {
    let progress = Arc::new(Progress::new(limits));
    let title = format!("[{at}/{of}] {} {}", job.layer(), job.name());
    let over = AtomicBool::new(false);
    let report = std::thread::scope(|scope| {
        scope.spawn(|| watch(&title, &progress, &over, screen));
        // Even a run that panics is over.
        let _over = Over(&over);
        job.run(&progress)
    });
    let line =
        format!("{title}: {} · {} states · {:.1} s", report.verdict, report.states.unique, report.seconds);
    match screen {
        Some(screen) => drop(screen.println(line)),
        None => err(line),
    }
    report
}

/// Says that a run is over, however it ends.
struct Over<'o>(&'o AtomicBool);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.store(true, Relaxed);
    }
}

/// Says now and then how far a run is, until it is over.
fn watch(title: &str, progress: &Progress, over: &AtomicBool, screen: Option<&MultiProgress>) {
    let bar = screen.map(|screen| {
        let style = ProgressStyle::with_template("{spinner} {wide_msg}")
            .unwrap_or_else(|_| ProgressStyle::default_spinner());
        screen.add(ProgressBar::new_spinner().with_style(style))
    });
    let mut mentioned = 0;
    while !over.load(Relaxed) {
        std::thread::sleep(REDRAW);
        let seconds = progress.seconds();
        match &bar {
            Some(bar) => {
                bar.set_message(format!("{title}: {}", state_of(progress)));
                bar.tick();
            }
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "seconds of a run")]
            None if seconds as u64 / MENTION_SECONDS > mentioned => {
                mentioned = seconds as u64 / MENTION_SECONDS;
                err(format!("{title}: {}", state_of(progress)));
            }
            None => {}
        }
    }
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
}

fn state_of(progress: &Progress) -> String {
    let (unique, generated, judged, depth) = progress.counts();
    let seconds = progress.seconds().max(0.001);
    #[expect(clippy::cast_precision_loss, reason = "a rate to look at")]
    let rate = unique as f64 / seconds;
    let memory = memory_mb().map_or(String::new(), |mb| format!(" · {mb} MB"));
    let witnessed = progress.witnessed();
    let again = match progress.recounted() {
        0 => String::new(),
        recounted => format!(" · counted again {recounted}"),
    };
    format!(
        "{unique} unique of {generated} · {judged} judged · depth {depth} · {witnessed} witnessed · \
         {rate:.0}/s · {seconds:.0} s{memory}{again}"
    )
}

/// Resident memory of the process, where the system tells it.
fn memory_mb() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024)
}
