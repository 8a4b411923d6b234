//! `dsr oracle`: exit statuses, the JSON that scripts read, programs that cannot be asked.

#![expect(clippy::expect_used, reason = "helpers of tests: what they expect is what they test")]

use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

fn dsr(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dsr")).arg("oracle").args(arguments).output().expect("the program runs")
}

/// The program extracted from the proofs, or none, with the reason said; with `DSR_ORACLE=required` it must be there.
fn program() -> Option<String> {
    let place = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../target/coq/oracle/dsr-oracle");
    if place.exists() {
        return Some(place.display().to_string());
    }
    let required = std::env::var_os("DSR_ORACLE").is_some_and(|value| value == "required");
    assert!(!required, "{} is missing: run spec/coq/check", place.display());
    eprintln!("skipped: there is no {}; spec/coq/check makes it", place.display());
    None
}

/// `[spec: ORACLE-5]`
#[test]
fn the_extracted_program_agrees_and_says_so_in_json() {
    let Some(program) = program() else { return };
    for arguments in [
        vec!["corpus", "--only", "universal/*"],
        vec!["corpus", "--only", "wire/*"],
        vec!["random", "--histories", "10000", "--seed", "3"],
    ] {
        let output = dsr(&[&arguments[..], &["--format", "json", "--program", &program]].concat());
        assert_eq!(
            output.status.code(),
            Some(0),
            "{arguments:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(report["verdict"], "agree", "{arguments:?}");
        assert!(report["seconds"].as_f64().is_some_and(|seconds| seconds > 0.0));
    }
}

/// `[spec: ORACLE-6]`
#[test]
fn who_cannot_be_asked_does_not_agree() {
    for arguments in [["corpus", "--format"], ["random", "--format"], ["histories", "--format"]] {
        let missing = dsr(&[&arguments[..], &["json", "--program", "no/such/program"]].concat());
        assert_eq!(missing.status.code(), Some(3));
        let words = String::from_utf8_lossy(&missing.stderr).into_owned();
        assert!(words.contains("no/such/program") && words.contains("spec/coq/check"), "{words}");
        // It repeats what it is asked.
        let parrot = dsr(&[&arguments[..], &["json", "--program", "cat", "--patience", "5"]].concat());
        assert!(matches!(parrot.status.code(), Some(1 | 3)), "{parrot:?}");
    }
}
