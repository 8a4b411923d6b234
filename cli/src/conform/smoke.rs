//! `dsr conform smoke`: a first look that tells a broken adapter from a wrong implementation.

use super::chosen::{Command, case};
use super::error::ConformError;
use super::look::status_of;
use crate::output::out;
use crate::status::Status;
use dsr_conformance::case::{Case, Step};
use dsr_conformance::corpus;
use dsr_conformance::log::CaseLine;
use dsr_conformance::protocol::HelloReply;
use dsr_conformance::render::{escape::terminal, failure};
use dsr_conformance::report::{CaseResult, Verdict};
use dsr_conformance::run::{Watch, run_watched};

const AFTER: &str = "\
Examples:
  dsr conform smoke -- python3 adapter.py

Exit status: 0 all pass, 1 something is wrong, 2 cases were skipped, 3 wrong usage.";

/// Runs a handful of cases and explains each stage
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    #[command(flatten)]
    adapter: Command,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let ids = corpus::smoke()?;
        let cases = ids.iter().map(|id| case(id)).collect::<Result<Vec<_>, _>>()?;
        let command = &self.adapter.command;
        let mut stages =
            Stages { cases: &cases, command, met: false, first: [false; 3], sent: String::new(), came: None };
        let report = run_watched(&mut self.adapter.program(), &cases, &mut stages);
        let is_adapter = |result: &CaseResult| {
            matches!(
                result.verdict,
                Verdict::Crash | Verdict::Timeout | Verdict::ProtocolError | Verdict::Error
            )
        };
        let met = report.implementation.is_some();
        let fails = report.count(Verdict::Fail);
        let end = if !met {
            "the adapter does not come through the handshake: nothing is known of the implementation"
        } else if report.results.iter().any(is_adapter) {
            "the adapter is broken: repair it before you judge the implementation"
        } else if fails > 0 {
            "the adapter speaks the protocol; the implementation does not do what the specification says"
        } else if report.count(Verdict::Pass) == cases.len() {
            "the adapter speaks the protocol, and these cases pass: go on with `dsr conform run`"
        } else {
            "the adapter speaks the protocol; cases were left out"
        };
        out(&format!("\n{end}\n"));
        Ok(status_of(report.outcome()))
    }
}

struct Stages<'c> {
    cases: &'c [Case],
    command: &'c [String],
    met: bool,
    /// Whether there was a mutation, a delivery, an expectation.
    first: [bool; 3],
    sent: String,
    came: Option<String>,
}

impl Watch for Stages<'_> {
    fn begins(&mut self, at: usize, case: &Case) {
        if !self.met {
            out(&format!("start: {}\n", terminal(&self.command.join(" "))));
        }
        out(&format!("case {}/{}: {} ({})\n", at + 1, self.cases.len(), case.id, case.title));
    }

    fn met(&mut self, hello: &HelloReply) {
        self.met = true;
        let known = &hello.implementation;
        out(&terminal(&format!(
            "handshake: {} {} ({}), protocol {}\nannounced: profiles {}; features {}; {} bytes a line, {} replicas\n",
            known.name,
            known.version,
            known.language,
            hello.protocol,
            hello.profiles.join(", "),
            if hello.features.is_empty() { "none".to_owned() } else { hello.features.join(", ") },
            hello.limits.line_bytes,
            hello.limits.replicas
        )));
    }

    fn step(&mut self, number: usize, step: &Step) {
        let (at, what) = match step {
            Step::Mutate { .. } => (0, "first mutation: the adapter makes it and names its delta"),
            Step::Deliver { .. } => (1, "first delivery: the adapter takes a delta that it named before"),
            step if step.expects() => (2, "first expectation: what the replica shows is read and compared"),
            _ => return,
        };
        if !std::mem::replace(&mut self.first[at], true) {
            out(&format!("  {what} (step {number})\n"));
        }
    }

    fn sent(&mut self, line: &str) {
        self.sent = line.into();
        self.came = None;
    }

    fn came(&mut self, line: &str) {
        self.came = Some(line.into());
    }

    fn ends(&mut self, result: &CaseResult) {
        if result.verdict == Verdict::Pass {
            out("  pass\n");
            return;
        }
        if result.verdict == Verdict::ProtocolError && !self.sent.is_empty() {
            let came = self.came.as_deref().unwrap_or("no line that could be taken");
            out(&format!("  request: {}\n  reply:   {}\n", terminal(&self.sent), terminal(came)));
        }
        let line = CaseLine::of(result, None);
        let case = self.cases.iter().find(|case| case.id == result.id);
        for line in failure(&line, case, self.command).lines() {
            out(&format!("  {line}\n"));
        }
    }
}
