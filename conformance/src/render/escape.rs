//! Texts of adapters, made harmless where they are shown.

use std::fmt::Write;

/// Controls, and characters that steer the layout of text.
fn is_unseen(character: char) -> bool {
    character.is_control()
        || matches!(character,
            '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}'
            | '\u{fffe}' | '\u{ffff}')
}

fn shown(text: &str, seen: impl Fn(&mut String, char)) -> String {
    let mut shown = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\n' => shown.push('\n'),
            unseen if is_unseen(unseen) => {
                // Writing to a string cannot fail.
                let _ = write!(shown, "⟨U+{:04X}⟩", u32::from(unseen));
            }
            character => seen(&mut shown, character),
        }
    }
    shown
}

/// For a terminal: nothing but new lines steers it.
pub fn terminal(text: &str) -> String {
    shown(text, String::push)
}

/// For XML and HTML, between tags and in quoted attributes.
pub fn markup(text: &str) -> String {
    shown(text, |shown, character| match character {
        '<' => shown.push_str("&lt;"),
        '>' => shown.push_str("&gt;"),
        '&' => shown.push_str("&amp;"),
        '"' => shown.push_str("&quot;"),
        '\'' => shown.push_str("&#39;"),
        character => shown.push(character),
    })
}

/// For Markdown, in one line, cells of tables included.
pub fn markdown(text: &str) -> String {
    let line = shown(text, |shown, character| {
        if matches!(character, '<' | '>' | '&')
            || (character.is_ascii_punctuation() && !".,:;-/()'=+".contains(character))
        {
            let _ = write!(shown, "&#{};", u32::from(character));
        } else {
            shown.push(character);
        }
    });
    line.replace('\n', " ")
}

/// A fenced block of Markdown, whose fence does not occur in the text.
pub fn fenced(text: &str) -> String {
    let mut fence = String::from("```");
    while text.contains(&fence) {
        fence.push('`');
    }
    format!("{fence}text\n{}\n{fence}\n", terminal(text).trim_end())
}

#[cfg(test)]
mod tests {
    use super::{fenced, markdown, markup, terminal};

    const HOSTILE: &str = "</script><b a='\"&\u{1b}[31m\u{202e}|`*_[x](y)\0";

    /// `[spec: CONF-16]`
    #[test]
    fn law_nothing_of_an_adapter_is_markup_or_steers() {
        for text in [terminal(HOSTILE), markup(HOSTILE), markdown(HOSTILE), fenced(HOSTILE)] {
            assert!(!text.contains(['\u{1b}', '\u{202e}', '\0']), "{text}");
        }
        assert!(!markup(HOSTILE).contains(['<', '>', '"', '\'']));
        assert!(!markdown(HOSTILE).contains(['<', '>', '|', '`', '*', '_', '[']));
        assert!(fenced("a\n```\nb").starts_with("````text\n"));
    }
}
