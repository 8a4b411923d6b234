//! A case, explained.

use super::diagram::diagram;
use super::escape::terminal;
use super::graph::graph;
use crate::case::{Case, Step};
use crate::protocol::{Answer, Feature, Reply, Shown};
use std::fmt::Write;

/// Title, reason, steps, what is expected, what a reply would look like, and the clauses in full.
pub fn explain(case: &Case) -> String {
    let mut text = format!("{}\n{}\n\n{}\n\n", case.id, case.title, case.why);
    let level = match case.level {
        crate::case::Level::Must => "must",
        crate::case::Level::Should => "should",
        crate::case::Level::May => "may",
    };
    let _ = write!(text, "level {level} · profile {}", case.profile.name());
    if !case.requires.is_empty() {
        let names: Vec<&str> = case.requires.iter().copied().map(Feature::name).collect();
        let _ = write!(text, " · needs {}", names.join(", "));
    }
    if let Some(choice) = &case.choice {
        let _ = write!(text, " · choice {choice}");
    }
    let _ = write!(text, "\n\n{}", diagram(case, None));
    for (step, number) in case.steps.iter().zip(1..) {
        let Step::Expect { replica, view } = step else { continue };
        let _ = writeln!(text, "\nstep {number}, {replica} shows:");
        for line in graph(view).lines() {
            let _ = writeln!(text, "  {}", terminal(line));
        }
    }
    let first = case.steps.iter().find_map(|step| match step {
        Step::Expect { view, .. } => Some(view.clone()),
        _ => None,
    });
    if let Some(view) = first {
        let reply = Reply::new(7, Ok(Answer::View(Shown { view })));
        if let Ok(line) = serde_json::to_string(&reply) {
            let _ = writeln!(text, "\na reply to `read` that passes (the id is the request's):\n  {line}");
        }
    }
    for id in &case.spec {
        if let Some((chapter, clause)) = id.parse().ok().and_then(|id| dsr_spec::clause_text(&id)) {
            let _ = writeln!(text, "\n{chapter}\n{clause}");
        }
    }
    text
}
