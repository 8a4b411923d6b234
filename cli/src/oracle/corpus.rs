//! `dsr oracle corpus`.

use super::OracleError;
use super::whom::{Format, Whom, bar};
use crate::output::{add, out};
use dsr_conformance::corpus;
use dsr_conformance::report::Verdict as CaseVerdict;
use dsr_oracle::corpus::{CorpusFound, run};
use dsr_oracle::verdict::Verdict;
use serde_json::json;

const AFTER: &str = "\
First the program is run as an adapter, as `dsr conform run` does. Then each case is made anew: its steps are carried out on \
the core and on the program; after every step all that can be asked of the replicas that it may have changed, and in the \
end of all, is asked of both, and every expectation of the case is filled from the program's replies and compared with \
what the file says.

Exit status: 0 agree, 1 disagree, 3 the program cannot be asked";

/// The conformance corpus: as an adapter, and step by step
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// Cases whose id matches; `*` stands for any characters
    #[arg(long, default_value = "*")]
    only: String,
    #[command(flatten)]
    whom: Whom,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Verdict, OracleError> {
        let all = corpus::cases()?.into_iter();
        let cases: Vec<_> = all.filter(|case| corpus::matches(&self.only, &case.id)).collect();
        let bar = bar(cases.len() as u64, "cases");
        let found = run(&self.whom.adapter(), self.whom.jobs(), &cases, &|| bar.inc(1))?;
        bar.finish_and_clear();
        let verdict = Verdict::of(!found.agrees(), false);
        out(&match self.whom.format {
            Format::Text => text(&found, verdict),
            Format::Json => json(&found, verdict),
        });
        Ok(verdict)
    }
}

fn text(found: &CorpusFound, verdict: Verdict) -> String {
    let mut text = String::new();
    let passed = found.report.count(CaseVerdict::Pass);
    add(&mut text, format_args!("{} cases, {passed} passed as an adapter\n", found.cases));
    for result in
        found.report.results.iter().filter(|result| result.verdict != CaseVerdict::Pass).take(SHOWN_MAX)
    {
        let (verdict, failure) = (result.verdict.name(), &result.failure);
        add(&mut text, format_args!("  {verdict} {} at step {}: {failure}\n", result.id, failure.step));
    }
    add(
        &mut text,
        format_args!(
            "{} steps, {} replies and {} expectations compared, {:.0} steps a second\n",
            found.steps,
            found.replies,
            found.expectations,
            found.steps_per_second()
        ),
    );
    for difference in found.differences.iter().take(SHOWN_MAX) {
        add(&mut text, format_args!("\n{difference}\n"));
    }
    add(&mut text, format_args!("{verdict}, {} differences, {:.1} s\n", found.differing, found.seconds));
    text
}

/// So many of what is wrong are shown.
const SHOWN_MAX: usize = 5;

fn json(found: &CorpusFound, verdict: Verdict) -> String {
    let differences = found.differences.iter().map(|difference| {
        json!({
            "case": difference.case, "step": difference.step, "asked": difference.asked,
            "due": difference.due, "program": difference.came,
        })
    });
    let whole = json!({
        "verdict": verdict,
        "cases": found.cases,
        "passed": found.report.count(CaseVerdict::Pass),
        "counts": found.report.summary().counts,
        "steps": found.steps,
        "replies": found.replies,
        "expectations": found.expectations,
        "differing": found.differing,
        "differences": differences.collect::<Vec<_>>(),
        "steps_per_second": found.steps_per_second(),
        "seconds": found.seconds,
    });
    whole.to_string() + "\n"
}
