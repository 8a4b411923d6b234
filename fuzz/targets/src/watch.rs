//! What the fuzzer runs: a target that panics at a broken law, and keeps what reaches something rare.

use crate::target::Target;
use crate::{Marks, on_broken_core};
use dsr_model::alarms;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Mutex, OnceLock};
use std::{env, fs};

/// The folder into which the smallest input for each mark goes, as a file of the mark's name.
const KEEP: &str = "DSR_FUZZ_KEEP";
/// The name of an alarm of `dsr alarms`: `history` then runs on that core, and must find it.
const ALARM: &str = "DSR_FUZZ_ALARM";

/// Tries one input.
///
/// # Panics
///
/// If a law is broken: so the fuzzer learns of it.
#[allow(clippy::panic, reason = "a panic is how libFuzzer is told")]
pub fn watch(target: &Target, input: &[u8]) {
    static BROKEN: OnceLock<Option<alarms::Alarm>> = OnceLock::new();
    let broken = BROKEN.get_or_init(|| {
        let name = env::var(ALARM).ok()?;
        let found = alarms::all().into_iter().find(|alarm| alarm.name == name);
        Some(found.unwrap_or_else(|| panic!("{ALARM}: no alarm is named {name:?}; see `dsr alarms`")))
    });
    let outcome = match broken {
        Some(alarm) if target.name == "history" => on_broken_core(alarm, input),
        _ => (target.run)(input),
    };
    match outcome {
        Ok(marks) => keep(&marks, input),
        Err(broken) => panic!("{broken}"),
    }
}

/// Keeps an input under each mark for which none so small is kept. What cannot be written is not kept.
fn keep(marks: &Marks, input: &[u8]) {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    static SIZES: Mutex<BTreeMap<String, usize>> = Mutex::new(BTreeMap::new());
    let Some(folder) = FOLDER.get_or_init(|| env::var_os(KEEP).map(PathBuf::from)) else { return };
    let Ok(mut sizes) = SIZES.lock() else { return };
    for mark in marks.iter() {
        if sizes.get(mark).is_some_and(|&size| size <= input.len()) {
            continue;
        }
        let path = folder.join(mark);
        let known = fs::metadata(&path).map_or(u64::MAX, |about| about.len());
        if known > input.len() as u64 {
            let _ = fs::create_dir_all(folder).and_then(|()| fs::write(&path, input));
        }
        sizes.insert(mark.to_owned(), input.len().min(usize::try_from(known).unwrap_or(usize::MAX)));
    }
}
