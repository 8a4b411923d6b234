//! The strict reader.

use super::{CaseLine, FORMAT, Footer, Header, Line};
use crate::protocol::read_strictly;
use crate::report::Verdict;
use std::collections::{BTreeMap, BTreeSet};

/// The most bytes that a log may have.
pub const LOG_BYTES_MAX: usize = 1 << 28;

/// A log that was read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Log {
    /// What was run.
    pub header: Header,
    /// What came of each case, in order.
    pub cases: Vec<CaseLine>,
    /// How it ended, if it says so.
    pub footer: Option<Footer>,
    /// Why it does not tell the whole run, if it does not.
    pub incomplete: Option<String>,
}

/// Why bytes are no log.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{file}:{line}: {what}; {remedy}")]
pub struct LogError {
    /// The file.
    pub file: String,
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: &'static str,
}

/// Reads a log. What is cut off at the end of a line or within its last one is a log that is incomplete. `[spec: CONF-13]`
pub fn read(file: &str, bytes: &[u8]) -> Result<Log, LogError> {
    let wrong = |line: usize, what: String, remedy| LogError { file: file.into(), line, what, remedy };
    let again = "write it with `dsr conform run --log`, and do not change it";
    if bytes.len() > LOG_BYTES_MAX {
        return Err(wrong(
            1,
            format!("more than {LOG_BYTES_MAX} bytes"),
            "log fewer cases at a time, with --only",
        ));
    }
    let (whole, cut) =
        bytes.iter().rposition(|&byte| byte == b'\n').map_or((0, true), |end| (end, end + 1 < bytes.len()));
    let text = std::str::from_utf8(&bytes[..whole])
        .map_err(|error| wrong(1, format!("not UTF-8 from byte {} on", error.valid_up_to() + 1), again))?;
    let mut header = None;
    let (mut cases, mut footer, mut ids) = (Vec::new(), None, BTreeSet::new());
    for (text, number) in text.lines().zip(1..) {
        let line: Line = read_strictly(text)
            .map_err(|error| wrong(number, format!("no line of a log: {error}"), again))?;
        match line {
            _ if footer.is_some() => {
                return Err(wrong(number, "something comes after the footer".into(), again));
            }
            Line::Header(first) if number == 1 => {
                if first.format != FORMAT {
                    return Err(wrong(
                        1,
                        format!("format {} is not known", first.format),
                        "this reader knows format 1",
                    ));
                }
                header = Some(first);
            }
            Line::Header(_) => {
                return Err(wrong(number, "a second header".into(), "read each log by itself"));
            }
            _ if number == 1 => return Err(wrong(1, "no header".into(), again)),
            Line::Case(case) => {
                if !ids.insert(case.id.clone()) {
                    return Err(wrong(number, format!("{:?} stands twice", case.id), again));
                }
                cases.push(case);
            }
            Line::Footer(last) => footer = Some(last),
        }
    }
    let header = header.ok_or_else(|| wrong(1, "no header".into(), again))?;
    let incomplete = if cut && footer.is_none() {
        Some("its last line is cut off".into())
    } else if cut {
        return Err(wrong(text.lines().count() + 1, "something comes after the footer".into(), again));
    } else {
        incomplete(&header, &cases, footer.as_ref())
    };
    Ok(Log { header, cases, footer, incomplete })
}

/// What a log lacks.
fn incomplete(header: &Header, cases: &[CaseLine], footer: Option<&Footer>) -> Option<String> {
    let Some(footer) = footer else { return Some("it has no footer".into()) };
    let mut counted: BTreeMap<String, usize> =
        Verdict::ALL.iter().map(|verdict| (verdict.name().into(), 0)).collect();
    for case in cases {
        *counted.entry(case.verdict.name().into()).or_default() += 1;
    }
    let Some(not_run) = header.cases.checked_sub(cases.len()) else {
        return Some(format!("it has {} cases, and its header {}", cases.len(), header.cases));
    };
    counted.insert("not_run".into(), not_run);
    if counted != footer.counts.0 {
        return Some("its footer does not count its lines".into());
    }
    (not_run > 0).then(|| format!("{not_run} cases were not run"))
}
