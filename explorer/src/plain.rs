//! What a page says where no script runs.

use dsr_model::trace::Trace;
use std::fmt::Write;

/// A trace's steps as they are printed in a terminal, to be unfolded.
pub(crate) fn steps(trace: &Trace) -> String {
    let (title, steps) = (escaped(&trace.title), escaped(&trace.to_string()));
    format!(
        "<details><summary>{title} ({})</summary><pre>{steps}</pre></details>\n",
        escaped(&trace.semantics)
    )
}

/// A text in which nothing is markup, and nothing turns the direction of what follows.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push('\n'),
            unseen if is_unseen(unseen) => {
                // Writing to a string cannot fail.
                let _ = write!(escaped, "⟨U+{:04X}⟩", u32::from(unseen));
            }
            seen => escaped.push(seen),
        }
    }
    escaped
}

/// Controls, and characters that steer the layout of text. The script has the same list.
fn is_unseen(character: char) -> bool {
    character.is_control()
        || matches!(character,
            '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}')
}
