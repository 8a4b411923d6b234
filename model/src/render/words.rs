//! Texts from outside, made fit for a line.

/// A text on one line: what ends a line, upsets a terminal, turns the direction of writing or has no place in
/// XML becomes a space.
pub(super) fn one_line(text: &str) -> String {
    let is_unfit = |character: char| {
        character.is_control()
            || matches!(
                character,
                '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{fffe}' | '\u{ffff}'
            )
    };
    text.chars().map(|character| if is_unfit(character) { ' ' } else { character }).collect()
}

/// A text in lines of at most `width` characters, broken at spaces where there are some; what hangs below the
/// first line starts with `hang` spaces. There is at least one line.
pub(super) fn wrap(text: &str, width: usize, hang: usize) -> Vec<String> {
    let text = one_line(text);
    let mut lines: Vec<String> = Vec::new();
    let mut rest: Vec<char> = text.trim_end().chars().collect();
    loop {
        let indent = if lines.is_empty() { 0 } else { hang.min(width / 2) };
        let room = width.saturating_sub(indent).max(1);
        let end = if rest.len() <= room { rest.len() } else { break_of(&rest, room) };
        let line: String = rest[..end].iter().collect();
        lines.push(format!("{}{}", " ".repeat(indent), line.trim_end()));
        let next = rest[end..].iter().position(|&character| character != ' ');
        let Some(skipped) = next else { return lines };
        rest.drain(..end + skipped);
    }
}

/// Where a line that is too long ends: at its last space, unless that would leave it nearly empty.
fn break_of(rest: &[char], room: usize) -> usize {
    let space = rest[..=room].iter().rposition(|&character| character == ' ');
    space.filter(|&space| space > room / 3).unwrap_or(room)
}

/// Appends to a text. Writing to a string cannot fail.
pub(super) fn add(text: &mut String, piece: impl std::fmt::Display) {
    let _ = std::fmt::Write::write_fmt(text, format_args!("{piece}"));
}

#[cfg(test)]
mod tests {
    use super::{one_line, wrap};

    #[test]
    fn law_no_line_is_wider_than_asked_and_nothing_but_spaces_is_lost() {
        let text = "alpha beta  gamma averyveryverylongword d\ne\u{2028}f";
        for width in 1..50 {
            let lines = wrap(text, width, 2);
            assert!(lines.iter().all(|line| line.chars().count() <= width), "{width}: {lines:?}");
            let without = |text: &str| text.split_whitespace().collect::<String>();
            assert_eq!(without(&lines.concat()), without(text), "{width}");
        }
        assert_eq!(wrap("", 10, 2), [""]);
        assert_eq!(wrap("one two", 5, 2), ["one", "  two"]);
    }

    #[test]
    fn law_one_line_has_nothing_that_ends_a_line_or_turns_it_round() {
        assert_eq!(one_line("a\nb\u{1b}[0m\u{202e}c\u{ffff}é"), "a b [0m c é");
    }
}
