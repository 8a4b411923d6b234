//! What the corpus consists of, and every id that it ever had. `[spec: CONF-15]`

use super::{SPEC_VERSION, VERSION};
use crate::case::CaseFile;
use crate::protocol::Hex;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};

#[derive(Serialize)]
struct Manifest {
    format: u32,
    corpus: &'static str,
    spec: &'static str,
    families: BTreeMap<String, usize>,
    files: Vec<Entry>,
}

#[derive(Serialize)]
struct Entry {
    path: String,
    cases: usize,
    sha256: String,
}

/// The text of `MANIFEST.json` for some files: path, text, and what was read of it.
pub fn manifest(files: &[(&str, &str, &CaseFile)]) -> Result<String, serde_json::Error> {
    let mut families: BTreeMap<String, usize> = BTreeMap::new();
    let mut entries = Vec::new();
    for (path, text, file) in files {
        *families.entry(file.family.clone()).or_default() += file.cases.len();
        let sha256 = Hex(Sha256::digest(text).to_vec()).to_string();
        entries.push(Entry { path: (*path).into(), cases: file.cases.len(), sha256 });
    }
    let manifest = Manifest { format: 1, corpus: VERSION, spec: SPEC_VERSION, families, files: entries };
    serde_json::to_string_pretty(&manifest).map(|text| text + "\n")
}

/// The ids that the corpus ever had.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Known {
    /// Of cases that are there.
    pub used: BTreeSet<String>,
    /// Of cases that are gone; no other case may have them.
    pub retired: BTreeSet<String>,
}

/// Reads `ids.txt`: an id a line, followed by ` retired` if its case is gone. `Err` has the number of a line that is
/// something else, or repeats an id.
pub fn known_ids(text: &str) -> Result<Known, usize> {
    let mut known = Known::default();
    for (line, number) in text.lines().zip(1..) {
        let (id, is_retired) = line.strip_suffix(" retired").map_or((line, false), |id| (id, true));
        let is_plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"-/".contains(&byte);
        let is_old = known.used.contains(id) || known.retired.contains(id);
        if id.split('/').count() != 3 || !id.bytes().all(is_plain) || is_old {
            return Err(number);
        }
        let list = if is_retired { &mut known.retired } else { &mut known.used };
        list.insert(id.to_owned());
    }
    Ok(known)
}

/// The text of `ids.txt`.
pub fn listed_ids(known: &Known) -> String {
    let mut lines: Vec<String> = known.used.iter().cloned().collect();
    lines.extend(known.retired.iter().map(|id| format!("{id} retired")));
    lines.sort_unstable();
    lines.into_iter().map(|line| line + "\n").collect()
}
