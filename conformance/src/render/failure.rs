//! What is wrong, as a person wants to read it.

use super::diagram::diagram;
use super::escape::terminal;
use crate::case::Case;
use crate::log::CaseLine;
use std::fmt::Write;

/// The verdict with title and clauses, the steps, what was expected and what came, and a line that replays it. `replay` is
/// the command of the adapter; nothing is offered where there is none.
pub fn failure(line: &CaseLine, case: Option<&Case>, replay: &[String]) -> String {
    let mut text = format!("{} {} [{}]\n", line.verdict.name(), line.id, line.clauses.join(", "));
    if let Some(case) = case {
        let _ = writeln!(text, "  {}", case.title);
    }
    if let Some(excuse) = &line.excuse {
        let _ = writeln!(text, "  expected: {}", terminal(excuse));
    }
    if let (Some(case), Some(step)) = (case, line.step) {
        for row in diagram(case, Some(step)).lines() {
            let _ = writeln!(text, "  {row}");
        }
    }
    let at = line.step.map(|step| format!("step {step}: ")).unwrap_or_default();
    let detail = terminal(&line.detail);
    let mut detail = detail.lines();
    let _ = writeln!(text, "  {at}{}", detail.next().unwrap_or_default());
    for row in detail {
        let _ = writeln!(text, "    {row}");
    }
    for row in &line.expected {
        let _ = writeln!(text, "    - expected {}", terminal(row));
    }
    for row in &line.got {
        let _ = writeln!(text, "    + got      {}", terminal(row));
    }
    if !replay.is_empty() {
        let _ = writeln!(text, "  replay: dsr conform replay {} -- {}", line.id, quoted(replay));
    }
    text
}

/// A command as a shell takes it.
fn quoted(command: &[String]) -> String {
    let is_plain = |word: &String| {
        !word.is_empty()
            && word
                .chars()
                .all(|character| character.is_ascii_alphanumeric() || "-_./=:,@+".contains(character))
    };
    let word = |word: &String| {
        if is_plain(word) { word.clone() } else { format!("'{}'", terminal(word).replace('\'', "'\\''")) }
    };
    command.iter().map(word).collect::<Vec<_>>().join(" ")
}
