//! `dsr conform validate`.

use super::error::{ConformError, read_text, write};
use crate::output::{err, out};
use crate::status::Status;
use dsr_conformance::case::{CaseFile, read, write as canonical};
use dsr_conformance::corpus::{self, CorpusFault, faults, faults_of_file, known_ids, listed_ids, manifest};
use std::path::{Path, PathBuf};

const AFTER: &str = "\
Examples:
  dsr conform validate
  dsr conform validate conformance/corpus/v1/universal/delivery.json
  dsr conform validate --fix conformance/corpus";

/// Checks the corpus: ids, clauses, form, formatting, manifest
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// Files of cases, each by itself, or the folder of a corpus; without any, the corpus in this program
    files: Vec<PathBuf>,
    /// Write formatting, list of ids and manifest anew
    #[arg(long, requires = "files")]
    fix: bool,
}

impl Arguments {
    /// `[spec: CONF-15]`
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        let mut found = Vec::new();
        let mut files = 0;
        if self.files.is_empty() {
            files = corpus::FILES.len();
            found = faults(corpus::FILES, corpus::IDS, corpus::MANIFEST);
        }
        for path in &self.files {
            let (count, faults) = if path.is_dir() { self.folder(path)? } else { (1, self.file(path)?) };
            files += count;
            found.extend(faults);
        }
        for fault in &found {
            err(fault);
        }
        out(&format!("{files} files, {} faults\n", found.len()));
        Ok(if found.is_empty() { Status::Claimed } else { Status::Violated })
    }

    fn file(&self, path: &Path) -> Result<Vec<CorpusFault>, ConformError> {
        let name = of_family(path);
        let text = read_text(path)?;
        if self.fix {
            let due = canonical(&read(&name, &text)?)?;
            if due != text {
                write(path, &due)?;
            }
            return Ok(faults_of_file(&name, &due).1);
        }
        Ok(faults_of_file(&name, &text).1)
    }

    fn folder(&self, folder: &Path) -> Result<(usize, Vec<CorpusFault>), ConformError> {
        let paths = json_files(&folder.join("v1"))?;
        let mut texts: Vec<(String, String)> = Vec::new();
        for path in &paths {
            if self.fix {
                // What this cannot repair is told below.
                if let Ok(file) = read(&of_family(path), &read_text(path)?) {
                    write(path, &canonical(&file)?)?;
                }
            }
            texts.push((of_family(path), read_text(path)?));
        }
        let (ids, listed) = (folder.join("ids.txt"), folder.join("MANIFEST.json"));
        if self.fix {
            fix_lists(&texts, &ids, &listed)?;
        }
        let files: Vec<(&str, &str)> =
            texts.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
        Ok((files.len(), faults(&files, &read_text(&ids)?, &read_text(&listed)?)))
    }
}

/// Writes the list of ids and the manifest of the files that can be read.
fn fix_lists(texts: &[(String, String)], ids: &Path, listed: &Path) -> Result<(), ConformError> {
    let read: Vec<(&str, &str, CaseFile)> = texts
        .iter()
        .filter_map(|(path, text)| Some((path.as_str(), text.as_str(), read(path, text).ok()?)))
        .collect();
    if let Ok(mut known) = known_ids(&read_text(ids)?) {
        let fresh = read.iter().flat_map(|(_, _, file)| &file.cases).map(|case| &case.id);
        let fresh: Vec<String> = fresh.filter(|id| !known.retired.contains(*id)).cloned().collect();
        known.used.extend(fresh);
        write(ids, &listed_ids(&known))?;
    }
    let read: Vec<_> = read.iter().map(|(path, text, file)| (*path, *text, file)).collect();
    write(listed, &manifest(&read)?)
}

/// `family/topic.json`.
fn of_family(path: &Path) -> String {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    parts[parts.len().saturating_sub(2)..].join("/")
}

/// The files two levels below a folder, in order.
fn json_files(folder: &Path) -> Result<Vec<PathBuf>, ConformError> {
    let entries = |folder: &Path| -> Result<Vec<PathBuf>, ConformError> {
        let fail = |why| ConformError::File { path: folder.into(), why };
        let mut found = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(fail)? {
            found.push(entry.map_err(fail)?.path());
        }
        found.sort_unstable();
        Ok(found)
    };
    let mut files = Vec::new();
    for family in entries(folder)?.iter().filter(|path| path.is_dir()) {
        files.extend(entries(family)?);
    }
    Ok(files)
}
