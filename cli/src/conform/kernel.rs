//! `dsr conform` without a command: this program's core, in the same process and over pipes. `[spec: CONF-18]`

use super::chosen::{Choice, Format, Printed};
use super::error::ConformError;
use super::look::{Bar, status_of, text};
use crate::output::{err, out};
use crate::status::Status;
use dsr_conformance::adapter::Core;
use dsr_conformance::case::Case;
use dsr_conformance::report::Summary;
use dsr_conformance::run::{ChildLimits, InProcess, Open, Program, run_watched};
use dsr_conformance::serve::serve;
use std::time::{Duration, Instant};

#[derive(clap::Args, Debug)]
pub(super) struct OnTheCore {
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    printed: Printed,
}

impl OnTheCore {
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let cases = self.choice.cases()?;
        let myself = std::env::current_exe().map_err(ConformError::Myself)?;
        let command = vec![myself.to_string_lossy().into_owned(), "conform".into(), "adapter".into()];
        let (mut here, mut there) =
            (InProcess(Core::default), Program { command: command.clone(), limits: ChildLimits::default() });
        let ways: [(&str, &str, &mut dyn Open); 2] = [
            ("in-process", "the core, in-process", &mut here),
            ("stdio", "the core, over pipes", &mut there),
        ];
        let mut summaries = Vec::new();
        for (transport, whom, open) in ways {
            let begun = Instant::now();
            let report = run_watched(open, &cases, &mut Bar::new(cases.len()));
            if self.printed.format == Format::Text {
                out(&text(&report, (&cases, &command, whom), &|_| None));
                out(&pace(&cases, begun.elapsed()));
            }
            summaries.push((transport, report.summary()));
        }
        let counts: Vec<_> = summaries.iter().map(|(_, summary)| summary.counts.clone()).collect();
        let Some(summary) = Summary::together(summaries) else { return Ok(Status::Incomplete) };
        match self.printed.format {
            Format::Json => out(&(serde_json::to_string(&summary)? + "\n")),
            Format::Text if counts.windows(2).any(|pair| pair[0] != pair[1]) => {
                err("the same cases came out differently in-process and over pipes");
            }
            Format::Text => {}
        }
        Ok(status_of(summary.verdict))
    }
}

/// How fast the steps of cases went.
fn pace(cases: &[Case], time: Duration) -> String {
    let steps: usize = cases.iter().map(|case| case.steps.len()).sum();
    let seconds = time.as_secs_f64();
    #[expect(clippy::cast_precision_loss, reason = "a rate for people")]
    let rate = steps as f64 / seconds.max(f64::MIN_POSITIVE);
    format!("  {steps} steps in {seconds:.1} s, {rate:.0} a second\n")
}

pub(super) fn adapter() -> Result<Status, ConformError> {
    serve(&mut Core::default(), std::io::stdin().lock(), std::io::stdout().lock())?;
    Ok(Status::Claimed)
}
