//! Standard output and standard error.

use std::io::Write;

/// Writes to standard output. A reader that closes the pipe early, such as `head`, is no error.
pub(crate) fn out(text: &str) {
    let mut stdout = std::io::stdout().lock();
    let _ = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush());
}

/// Writes bytes to standard output.
pub(crate) fn out_bytes(bytes: &[u8]) -> std::io::Result<()> {
    let mut stdout = std::io::stdout().lock();
    stdout.write_all(bytes)?;
    stdout.flush()
}

/// Writes one line to standard error.
pub(crate) fn err(line: impl std::fmt::Display) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// A name as it is, or quoted and escaped where it could be misread or upset a terminal.
pub(crate) fn plain(name: &str) -> String {
    let is_plain = !name.is_empty()
        && !name.chars().any(|character| character.is_whitespace() || character.is_control());
    if is_plain { name.to_owned() } else { format!("{name:?}") }
}

/// Appends to a text. Writing to a string cannot fail.
pub(crate) fn add(text: &mut String, piece: impl std::fmt::Display) {
    let _ = std::fmt::Write::write_fmt(text, format_args!("{piece}"));
}
