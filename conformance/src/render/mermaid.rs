//! The steps of a case in the language of Mermaid.

use super::words::words;
use crate::case::{Case, Step};
use crate::render::diagram::signs;
use std::collections::BTreeMap;
use std::fmt::Write;

/// A `sequenceDiagram`. Messages are drawn when they are received.
pub fn mermaid(case: &Case) -> String {
    let mut text = String::from("sequenceDiagram\n");
    let number_of =
        |name: &str| case.replicas.iter().position(|replica| replica == name).map_or(1, |at| at + 1);
    for (replica, number) in case.replicas.iter().zip(1..) {
        let _ = writeln!(text, "    participant p{number} as {}", escape(replica));
    }
    let mut senders: BTreeMap<&str, usize> = BTreeMap::new();
    for (step, number) in case.steps.iter().zip(1..) {
        let label = escape(&format!("{number}. {}", words(step)));
        let lanes: Vec<usize> = signs(step).1.into_iter().map(number_of).collect();
        let line = match step {
            Step::Deliver { replica, delta } => senders.get(delta.as_str()).map(|from| {
                format!("p{from}->>p{}: {}", number_of(replica), escape(&format!("{number}. {delta}")))
            }),
            _ => None,
        };
        let first = lanes.iter().min().copied().unwrap_or(1);
        let last = lanes.iter().max().copied().unwrap_or(case.replicas.len());
        let over = if first == last { format!("p{first}") } else { format!("p{first},p{last}") };
        let _ = writeln!(text, "    {}", line.unwrap_or_else(|| format!("Note over {over}: {label}")));
        match step {
            Step::Mutate { r#as: Some(name), .. }
            | Step::Answer { r#as: name, .. }
            | Step::AnswerDigest { r#as: name, .. } => {
                senders.insert(name, first);
            }
            Step::Group { deltas, r#as } => {
                if let Some(&from) = deltas.first().and_then(|delta| senders.get(delta.as_str())) {
                    senders.insert(r#as, from);
                }
            }
            _ => {}
        }
    }
    text
}

/// What means something to Mermaid or to HTML becomes an entity of Mermaid's.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        let is_plain = !character.is_control()
            && (!character.is_ascii_punctuation() || ".,_-()[]=+*/!?".contains(character));
        if is_plain {
            escaped.push(character);
        } else {
            let _ = write!(escaped, "#{};", u32::from(character));
        }
    }
    escaped
}
