//! Templates of adapters, written, built and run as users do.

mod common;

use common::{Run, dsr};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Writes a template to a folder of its own.
fn written(language: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("adapter-{language}"));
    let _ = std::fs::remove_dir_all(&folder);
    let run = dsr(&["conform", "new-adapter", "--lang", language, "--to", &folder.to_string_lossy()]);
    assert_eq!((run.status, run.err.as_str()), (0, ""), "{run:?}");
    assert!(run.out.contains("Next:\n  cd "), "{run:?}");
    folder
}

/// Runs a tool; `None`, with the reason printed, if it is not there and not required.
fn tool(name: &str, arguments: &[&str], folder: &Path) -> Option<Output> {
    let output =
        Command::new(name).args(arguments).current_dir(folder).env_remove("CARGO_TARGET_DIR").output();
    match output {
        Ok(output) => Some(output),
        Err(why) => {
            let required = std::env::var("DSR_TOOLCHAINS").is_ok_and(|value| value == "required");
            assert!(!required, "{name} is required and cannot be started: {why}");
            println!("skipped: {name} cannot be started: {why}");
            None
        }
    }
}

fn built(output: &Output) {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Runs all cases: the simple ones pass, some of the others fail, and the protocol is kept.
#[track_caller]
fn finds_wanting(command: &[&str]) {
    let mut arguments = vec!["conform", "run", "--format", "json", "--"];
    arguments.extend(command);
    let run: Run = dsr(&arguments);
    assert_eq!((run.status, run.err.as_str()), (1, ""), "{run:?}");
    let summary: serde_json::Value = serde_json::from_str(&run.out).unwrap_or_default();
    assert!(summary.is_object(), "{run:?}");
    let count = |verdict: &str| summary["counts"][verdict].as_u64().unwrap_or(0);
    for verdict in ["error", "crash", "timeout", "protocol_error", "skip"] {
        assert_eq!(count(verdict), 0, "{verdict}: {run:?}");
    }
    assert!(count("pass") >= 80, "{run:?}");
    assert!(
        count("fail") >= 10,
        "a corpus that finds nothing in the last writer's winning is broken: {run:?}"
    );
}

/// `[spec: CONF-1]` `[spec: CONF-4]`
#[test]
fn conform_the_template_in_python_works() {
    let folder = written("python");
    if tool("python3", &["--version"], &folder).is_some() {
        finds_wanting(&["python3", folder.join("adapter.py").to_str().unwrap()]);
    }
}

/// `[spec: CONF-1]` `[spec: CONF-4]`
#[test]
fn conform_the_template_in_cpp_works() {
    let folder = written("cpp");
    let tools = [tool("make", &["--version"], &folder), tool("c++", &["--version"], &folder)];
    if tools.iter().any(Option::is_none) {
        return;
    }
    let probe = "__has_include(<nlohmann/json.hpp>)";
    let source = format!("#if !{probe}\n#error missing\n#endif\n");
    std::fs::write(folder.join("probe.cpp"), source).unwrap();
    let has_json =
        tool("c++", &["-std=c++17", "-fsyntax-only", "probe.cpp"], &folder).unwrap().status.success();
    if !has_json {
        let required = std::env::var("DSR_TOOLCHAINS").is_ok_and(|value| value == "required");
        assert!(!required, "nlohmann/json is required: install nlohmann-json3-dev");
        println!("skipped: nlohmann/json is not installed");
        return;
    }
    built(&tool("make", &[], &folder).unwrap());
    finds_wanting(&[folder.join("adapter").to_str().unwrap()]);
}

/// `[spec: CONF-1]` `[spec: CONF-4]`
#[test]
fn conform_the_template_in_rust_works() {
    let folder = written("rust");
    // The versions that this workspace is built with are there without a network.
    std::fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    built(&tool(env!("CARGO"), &["build", "--offline", "--quiet"], &folder).unwrap());
    finds_wanting(&[folder.join("target/debug/my-adapter").to_str().unwrap()]);
}

#[test]
fn law_the_template_in_python_is_short() {
    let text = include_str!("../../conformance/templates/python/adapter.py");
    assert!(text.lines().count() <= 150, "{} lines", text.lines().count());
}

#[test]
fn law_nothing_is_written_over_unasked() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("adapter-taken");
    let _ = std::fs::remove_dir_all(&folder);
    let arguments = ["conform", "new-adapter", "--lang", "python", "--to", folder.to_str().unwrap()];
    assert_eq!(dsr(&arguments).status, 0);
    std::fs::write(folder.join("adapter.py"), "mine").unwrap();
    let refused = dsr(&arguments);
    assert_eq!(refused.status, 3, "{refused:?}");
    assert!(refused.err.contains("not empty") && refused.err.contains("--force"), "{refused:?}");
    assert_eq!(std::fs::read_to_string(folder.join("adapter.py")).unwrap(), "mine");
    let mut forced = arguments.to_vec();
    forced.push("--force");
    assert_eq!(dsr(&forced).status, 0);
    assert_ne!(std::fs::read_to_string(folder.join("adapter.py")).unwrap(), "mine");
    let file = folder.join("adapter.py").join("below");
    let inside = dsr(&["conform", "new-adapter", "--lang", "cpp", "--to", file.to_str().unwrap()]);
    assert_eq!(inside.status, 3, "{inside:?}");
}
