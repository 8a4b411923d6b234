//! The canonical text of a file of cases: one member of a case a line, one step a line. `[spec: CONF-11]`

use super::CaseFile;
use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};
use std::io::{self, Write};

/// The text that [`read`](super::read) reads back as the same file, and that equal files have.
pub fn write(file: &CaseFile) -> Result<String, serde_json::Error> {
    let mut text = Vec::new();
    file.serialize(&mut Serializer::with_formatter(&mut text, Lines::default()))?;
    text.push(b'\n');
    String::from_utf8(text).map_err(serde::ser::Error::custom)
}

/// Breaks lines between the members of the file, its cases, the members of a case, and its steps; elsewhere a space
/// follows each comma and each colon.
#[derive(Default)]
struct Lines {
    /// How many lists and objects are open, and for each whether its items stand on lines of their own.
    open: Vec<bool>,
    in_key: bool,
    key: String,
}

impl Lines {
    /// Whether the items of what opens now stand on lines of their own.
    fn begin(&mut self, out: &mut (impl Write + ?Sized), sign: &[u8]) -> io::Result<()> {
        let breaks = match self.open.len() {
            0 | 2 => true,
            1 => self.key == "cases",
            3 => self.key == "steps",
            _ => false,
        };
        let parent_breaks = self.open.iter().all(|breaks| *breaks);
        self.open.push(breaks && parent_breaks);
        out.write_all(sign)
    }

    fn item(&self, out: &mut (impl Write + ?Sized), first: bool) -> io::Result<()> {
        match (self.open.last(), first) {
            (Some(true), _) => {
                out.write_all(if first { b"\n" } else { b",\n" })?;
                indent(out, self.open.len())
            }
            (_, true) => Ok(()),
            (_, false) => out.write_all(b", "),
        }
    }

    fn end(&mut self, out: &mut (impl Write + ?Sized), sign: &[u8]) -> io::Result<()> {
        if self.open.pop() == Some(true) {
            out.write_all(b"\n")?;
            indent(out, self.open.len())?;
        }
        out.write_all(sign)
    }
}

fn indent(out: &mut (impl Write + ?Sized), depth: usize) -> io::Result<()> {
    (0..depth).try_for_each(|_| out.write_all(b"  "))
}

impl Formatter for Lines {
    fn begin_array<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        self.begin(out, b"[")
    }

    fn end_array<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        self.end(out, b"]")
    }

    fn begin_array_value<W: Write + ?Sized>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.item(out, first)
    }

    fn begin_object<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        self.begin(out, b"{")
    }

    fn end_object<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        self.end(out, b"}")
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.in_key = true;
        self.key.clear();
        self.item(out, first)
    }

    fn end_object_key<W: Write + ?Sized>(&mut self, _: &mut W) -> io::Result<()> {
        self.in_key = false;
        Ok(())
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, out: &mut W) -> io::Result<()> {
        out.write_all(b": ")
    }

    fn write_string_fragment<W: Write + ?Sized>(&mut self, out: &mut W, fragment: &str) -> io::Result<()> {
        if self.in_key {
            self.key.push_str(fragment);
        }
        out.write_all(fragment.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::write;
    use crate::case::read;
    use crate::corpus::FILES;

    /// `[spec: CONF-11]`
    #[test]
    fn law_the_corpus_is_in_canonical_form() {
        for (path, text) in FILES {
            let file = read(path, text).unwrap();
            let written = write(&file).unwrap();
            assert_eq!(read(path, &written).unwrap(), file, "{path}");
            if std::env::var_os("DSR_WRITE").is_some() {
                let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus/v1");
                std::fs::write(std::path::Path::new(folder).join(path), &written).unwrap();
            } else {
                assert!(written == *text, "{path} is not in canonical form: run this test with DSR_WRITE=1");
            }
        }
    }
}
