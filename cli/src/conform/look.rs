//! What is seen of a run meanwhile, and what is printed of it at the end.

use crate::output::add;
use crate::status::Status;
use dsr_conformance::case::{Case, Step};
use dsr_conformance::log::CaseLine;
use dsr_conformance::protocol::HelloReply;
use dsr_conformance::render::{escape, failure};
use dsr_conformance::report::{CaseResult, Outcome, Report, Verdict};
use dsr_conformance::run::Watch;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;

/// A bar on standard error, where that is a terminal.
pub(super) struct Bar(Option<ProgressBar>);

impl Bar {
    pub(super) fn new(cases: usize) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| ProgressBar::new(cases as u64));
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {wide_msg} {eta}");
        Self(bar.map(|bar| bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))))
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

impl Watch for Bar {
    fn begins(&mut self, at: usize, case: &Case) {
        if let Some(bar) = &self.0 {
            bar.set_position(at as u64);
            bar.set_message(case.id.clone());
        }
    }
}

/// Two look on.
pub(super) struct Both<'w>(pub(super) &'w mut dyn Watch, pub(super) &'w mut dyn Watch);

impl Watch for Both<'_> {
    fn begins(&mut self, at: usize, case: &Case) {
        self.0.begins(at, case);
        self.1.begins(at, case);
    }

    fn met(&mut self, hello: &HelloReply) {
        self.0.met(hello);
        self.1.met(hello);
    }

    fn step(&mut self, number: usize, step: &Step) {
        self.0.step(number, step);
        self.1.step(number, step);
    }

    fn sent(&mut self, line: &str) {
        self.0.sent(line);
        self.1.sent(line);
    }

    fn came(&mut self, line: &str) {
        self.0.came(line);
        self.1.came(line);
    }

    fn ends(&mut self, result: &CaseResult) {
        self.0.ends(result);
        self.1.ends(result);
    }
}

pub(super) const fn status_of(outcome: Outcome) -> Status {
    match outcome {
        Outcome::Expected => Status::Claimed,
        Outcome::Unexpected => Status::Violated,
        Outcome::Incomplete => Status::Incomplete,
    }
}

/// What is not a pass, then the counts. `excuse` tells why a result was expected.
pub(super) fn text(
    report: &Report,
    (cases, command, whom): (&[Case], &[String], &str),
    excuse: &dyn Fn(&CaseResult) -> Option<String>,
) -> String {
    let mut text = String::new();
    let mut excused = 0;
    for result in report.results.iter().filter(|result| result.verdict != Verdict::Pass) {
        let line = CaseLine::of(result, excuse(result));
        if line.verdict == Verdict::Unsupported {
            continue;
        }
        excused += usize::from(line.excuse.is_some());
        add(&mut text, failure(&line, cases.iter().find(|case| case.id == line.id), command));
        text.push('\n');
    }
    let named = report.implementation.as_ref().map_or_else(
        || "it never said what it is".to_owned(),
        |implementation| format!("{:?} {:?}", implementation.name, implementation.version),
    );
    add(&mut text, format_args!("{} ({}): ", escape::terminal(whom), escape::terminal(&named)));
    let counts = Verdict::ALL.map(|verdict| (verdict.name(), report.count(verdict)));
    let not_run = [("not run", report.wanted - report.results.len())];
    let counts = counts.iter().chain(&not_run).filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(name, count)| format!("{count} {name}")).collect();
    let as_expected = if excused > 0 { format!(" ({excused} as expected)") } else { String::new() };
    add(&mut text, format_args!("{}{as_expected}\n", counts.join(", ")));
    text
}
