//! What each layer of the checker judges, and to what bound.

use super::shown;
use crate::evidence::Evidence;
use std::fmt::Write as _;

pub(super) fn layers(evidence: &Evidence) -> String {
    let mut text = String::from("| layer | bounds of the default suite | what is visited |\n|---|---|---|\n");
    for layer in &evidence.layers {
        let bounds = layer
            .bounds()
            .into_iter()
            .map(|(bound, runs)| if runs == 1 { bound } else { format!("{bound} ({runs} runs)") });
        let visited = if layer.is_exhaustive() {
            "every state within them"
        } else {
            "random courses within them: a sample"
        };
        let _ = writeln!(
            text,
            "| {} | {} | {visited} |",
            shown(std::slice::from_ref(&layer.name)),
            bounds.collect::<Vec<_>>().join("; ")
        );
    }
    text += "\n| clause | layer | what is judged |\n|---|---|---|\n";
    for clause in evidence.trace.clauses.all() {
        let mut said: Vec<(Vec<String>, &str)> = Vec::new();
        for layer in &evidence.layers {
            for (_, says) in layer.judges.iter().filter(|(id, _)| *id == clause.id) {
                match said.iter_mut().find(|(_, known)| known == says) {
                    Some((names, _)) => names.push(layer.name.clone()),
                    None => said.push((vec![layer.name.clone()], says)),
                }
            }
        }
        for (names, says) in said {
            let names = shown(&names);
            let _ = writeln!(text, "| {} | {names} | {says} |", clause.id);
        }
    }
    text
}
