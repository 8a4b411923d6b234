//! Programs that tests ask.

#![allow(dead_code, reason = "no test asks all of them")]

use dsr_oracle::program::{FACTS, Start};
use std::path::Path;
use std::time::Duration;

/// The core as a program that answers facts, broken in a way.
pub(crate) fn core(flaw: &str) -> Start {
    adapter(flaw).with(FACTS)
}

/// The core as an adapter.
pub(crate) fn adapter(flaw: &str) -> Start {
    let start = Start::new(env!("CARGO_BIN_EXE_facts-of-core")).with(flaw);
    Start { patience: Duration::from_secs(20), ..start }
}

/// The program extracted from the model, or none, with the reason said; with `DSR_ORACLE=required` it must be there. Another
/// place than the default may be named in `DSR_ORACLE_PROGRAM`.
pub(crate) fn extracted() -> Option<Start> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let place = std::env::var_os("DSR_ORACLE_PROGRAM")
        .map_or_else(|| root.join(dsr_oracle::program::DEFAULT), |place| root.join(place));
    if place.exists() {
        return Some(Start::new(place.to_string_lossy()));
    }
    let required = std::env::var_os("DSR_ORACLE").is_some_and(|value| value == "required");
    assert!(!required, "{} is not there: build it with spec/coq/check", place.display());
    eprintln!("skipped: {} is not there; spec/coq/check builds it", place.display());
    None
}
