//! The tests that traces are turned into compile and pass.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::pedantic,
    reason = "tests, and code that users would keep as tests"
)]

use dsr_model::gallery::{rows, run_row};
use dsr_model::render::{Target, render};
use std::path::PathBuf;

/// Each file is what `dsr trace --to rust` writes, and is compiled and run here as a user would.
mod row_15_checked {
    include!("golden/row_15_checked.rs");
}
mod row_22_checked {
    include!("golden/row_22_checked.rs");
}
mod row_24_checked {
    include!("golden/row_24_checked.rs");
}
mod row_15 {
    include!("golden/row_15.rs");
}

/// Set `DSR_WRITE=1` to write the files anew. `[spec: TRACE-8]`
#[test]
fn law_the_tests_that_are_compiled_here_are_those_that_are_written() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for (number, is_checked) in [("15", false), ("15", true), ("22", true), ("24", true)] {
        let row = rows().into_iter().find(|row| row.row == number).expect("a row");
        let report = run_row(&row);
        let (name, trace) = if is_checked {
            (format!("row_{number}_checked.rs"), report.checked.expect("a twin").trace)
        } else {
            (format!("row_{number}.rs"), report.trace.expect("a trace"))
        };
        let text = render(&trace, Target::Rust).expect("a sound trace");
        if std::env::var_os("DSR_WRITE").is_some() {
            std::fs::write(folder.join(&name), &text).expect("a file that can be written");
        }
        let written = std::fs::read_to_string(folder.join(&name)).unwrap_or_default();
        assert!(written == text, "golden/{name} is out of date: run this with DSR_WRITE=1");
    }
}
