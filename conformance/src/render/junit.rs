//! `JUnit` XML: a suite for each log and family, the clauses as properties.

use super::escape::markup;
use super::tally::{Named, families};
use crate::log::CaseLine;
use crate::report::Verdict;
use std::fmt::Write;

/// The document.
pub fn junit(logs: &[Named]) -> String {
    let mut text =
        String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"dsr conform\">\n");
    for Named { name, log } in logs {
        for family in families(&log.cases) {
            let cases: Vec<&CaseLine> = log.cases.iter().filter(|case| case.family() == family).collect();
            suite(&mut text, &format!("{name}: {family}"), &cases);
        }
        if let Some(why) = &log.incomplete {
            let _ = writeln!(
                text,
                "  <testsuite name=\"{0}\" tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\"><testcase \
                 classname=\"{0}\" name=\"the log is complete\"><error message=\"{1}\"/></testcase></testsuite>",
                markup(name),
                markup(why)
            );
        }
    }
    text + "</testsuites>\n"
}

fn suite(text: &mut String, name: &str, cases: &[&CaseLine]) {
    let count = |is: &dyn Fn(&CaseLine) -> bool| cases.iter().filter(|case| is(case)).count();
    let failures = count(&|case| case.is_bad() && case.verdict == Verdict::Fail);
    let errors = count(&|case| case.is_bad() && case.verdict != Verdict::Fail);
    let skipped = count(&|case| !case.is_bad() && case.verdict != Verdict::Pass);
    let milliseconds: u64 = cases.iter().map(|case| case.milliseconds).sum();
    let _ = writeln!(
        text,
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{failures}\" errors=\"{errors}\" skipped=\"{skipped}\" \
         time=\"{}\">",
        markup(name),
        cases.len(),
        seconds(milliseconds)
    );
    for case in cases {
        let (class, slug) = case.id.rsplit_once('/').unwrap_or(("", &case.id));
        let _ = writeln!(
            text,
            "    <testcase classname=\"{}\" name=\"{}\" time=\"{}\">",
            markup(&class.replace('/', ".")),
            markup(slug),
            seconds(case.milliseconds)
        );
        text.push_str("      <properties>");
        for clause in &case.clauses {
            let _ = write!(text, "<property name=\"clause\" value=\"{}\"/>", markup(clause));
        }
        let _ = writeln!(text, "<property name=\"verdict\" value=\"{}\"/></properties>", case.verdict.name());
        outcome(text, case);
        text.push_str("    </testcase>\n");
    }
    text.push_str("  </testsuite>\n");
}

fn outcome(text: &mut String, case: &CaseLine) {
    let message = markup(case.detail.lines().next().unwrap_or_default());
    if case.is_bad() {
        let tag = if case.verdict == Verdict::Fail { "failure" } else { "error" };
        let mut body = markup(&case.detail);
        for line in &case.expected {
            let _ = write!(body, "\n- expected {}", markup(line));
        }
        for line in &case.got {
            let _ = write!(body, "\n+ got      {}", markup(line));
        }
        let _ = writeln!(
            text,
            "      <{tag} type=\"{}\" message=\"{message}\">{body}</{tag}>",
            case.verdict.name()
        );
    } else if case.verdict != Verdict::Pass {
        let why = case
            .excuse
            .as_deref()
            .map_or(message, |excuse| format!("expected {}: {}", case.verdict.name(), markup(excuse)));
        let _ = writeln!(text, "      <skipped message=\"{why}\"/>");
    }
}

fn seconds(milliseconds: u64) -> String {
    format!("{}.{:03}", milliseconds / 1000, milliseconds % 1000)
}
