//! The specification, the code and the witnesses agree; and each alarm goes off on a small input that
//! should set it off.

use dsr_spec::{Fault, MATRIX_PATH, Source, TestModules, matrix, read_inputs, test_lines, trace};
use std::path::PathBuf;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn list(faults: &[Fault]) -> String {
    faults.iter().map(|fault| format!("  {fault}")).collect::<Vec<_>>().join("\n")
}

#[test]
fn law_every_clause_has_code_and_witness() {
    let inputs = read_inputs(&root()).unwrap();
    let trace = trace(&inputs.texts, &inputs.rust);
    assert!(trace.clauses.all().len() > 100, "the specification was not found");
    let exempt: Vec<String> =
        trace.exemptions().map(|clause| format!("{} ({})", clause.id, clause.marker.unwrap())).collect();
    println!(
        "{} clauses, of which {} need no witness: {}",
        trace.clauses.all().len(),
        exempt.len(),
        exempt.join(", ")
    );
    assert!(trace.faults.is_empty(), "{} faults:\n{}", trace.faults.len(), list(&trace.faults));
}

#[test]
fn law_the_matrix_is_current() {
    let inputs = read_inputs(&root()).unwrap();
    let written = std::fs::read_to_string(root().join(MATRIX_PATH)).unwrap_or_default();
    let current = matrix(&trace(&inputs.texts, &inputs.rust));
    let difference = written.lines().zip(current.lines()).find(|(old, new)| old != new);
    assert!(
        written == current,
        "{MATRIX_PATH} is stale (first difference: {difference:#?}); write it anew: cargo run -p dsr-spec"
    );
}

const TEXT: &str =
    "**JOIN-1.** Text.\n\n**JOIN-2 (derived).** Follows from JOIN-1.\n\n**NET-1 (assumption).** Text.\n";
const CODE: &str = "/// Joins. `[spec: JOIN-1]`\nfn join() {}\n";
const TESTS: &str = "/// [spec: JOIN-1] [spec: JOIN-2]\n#[test]\nfn law_join() {}\n";

/// The faults of a specification, some code and some tests, as text.
#[track_caller]
fn check(text: &str, code: &str, tests: &str, expected: &[&str]) {
    let rust = [Source::new("core/src/lib.rs", code), Source::new("core/tests/laws.rs", tests)];
    let found = trace(&[Source::new("spec/a.md", text)], &rust).faults;
    assert_eq!(found.iter().map(ToString::to_string).collect::<Vec<_>>(), expected);
}

#[test]
fn law_a_complete_input_has_no_fault() {
    check(TEXT, CODE, TESTS, &[]);
}

#[test]
fn law_a_stale_tag_is_found() {
    let code = format!("{CODE}/// `[spec: JOIN-9]`\nfn old() {{}}\n");
    check(TEXT, &code, TESTS, &["core/src/lib.rs:3: the tag names JOIN-9, which is no clause"]);
    let tests = format!("{TESTS}/// [spec: GONE-1]\n#[test]\nfn law_old() {{}}\n");
    check(TEXT, CODE, &tests, &["core/tests/laws.rs:4: the tag names GONE-1, which is no clause"]);
}

#[test]
fn law_a_hole_is_found() {
    check(TEXT, "fn join() {}\n", TESTS, &["spec/a.md:1: no code cites JOIN-1"]);
    let no_witness = [
        "spec/a.md:1: no test or property witnesses JOIN-1",
        "spec/a.md:3: no test or property witnesses JOIN-2",
    ];
    check(TEXT, CODE, "fn helper() {}\n", &no_witness);
}

#[test]
fn law_a_duplicate_is_found() {
    let text = format!("{TEXT}\n**JOIN-1.** Again.\n");
    check(&text, CODE, TESTS, &["spec/a.md:7: JOIN-1 is defined already at spec/a.md:1"]);
}

#[test]
fn law_malformed_clauses_and_tags_are_found() {
    let text = format!(
        "{TEXT}\n**JOIN-3** without a stop.\n\n**JOIN-4 (perhaps).** Unknown marker.\n\n**MUST** is no clause.\n"
    );
    let stops = "is not `**ID.**` or `**ID (marker).**`";
    check(
        &text,
        CODE,
        TESTS,
        &[
            &format!("spec/a.md:7: \"JOIN-3\" starts like a clause, but {stops}"),
            &format!("spec/a.md:9: \"JOIN-4 (perhaps).\" starts like a clause, but {stops}"),
        ],
    );
    let code = format!("{CODE}// [spec: join-1]\n");
    check(
        TEXT,
        &code,
        TESTS,
        &["core/src/lib.rs:3: \"[spec: join-1]\" is no tag: expected `[spec: JOIN-3]`"],
    );
}

#[test]
fn law_cross_references_are_checked() {
    let text = TEXT.replace("Follows from JOIN-1", "Follows from JOIN-7, in UTF-8");
    check(
        &text,
        CODE,
        TESTS,
        &[
            "spec/a.md:3: cites JOIN-7, which is no clause",
            "spec/a.md:3: JOIN-2 is derived, but cites no clause that it follows from",
        ],
    );
}

#[test]
fn law_what_is_no_comment_is_no_tag() {
    check(TEXT, "const TEXT: &str = \"[spec: JOIN-1]\";\n", TESTS, &["spec/a.md:1: no code cites JOIN-1"]);
    // A header belongs to no test.
    let header = "//! [spec: JOIN-1]\n/// [spec: JOIN-2]\n#[test]\nfn law_join() {}\n";
    check(TEXT, CODE, header, &["spec/a.md:1: no test or property witnesses JOIN-1"]);
}

#[test]
fn law_properties_in_src_are_witnesses() {
    let code = format!("{CODE}\n/// `[property: JOIN-1]`, `[property: JOIN-2]`\npub fn check_join() {{}}\n");
    check(TEXT, &code, "", &[]);
}

#[test]
fn law_ranges_name_what_lies_between() {
    let text = "**WF-1.** A.\n\n**WF-2.** B.\n\n**WF-3.** C.\n";
    let code = "/// `[spec: WF-1]` to\n/// `[spec: WF-3]`\nfn judge() {}\n";
    check(text, code, "/// [spec: WF-1, WF-2, WF-3]\n#[test]\nfn law_judge() {}\n", &[]);
    let backwards = "/// [spec: WF-3] to [spec: WF-1]\n#[test]\nfn law_judge() {}\n";
    let found = ["spec/a.md:3: no test or property witnesses WF-2"];
    let tag = "core/tests/laws.rs:1: \"[spec: WF-1]\" is no tag: expected `[spec: JOIN-3]`";
    check(text, code, backwards, &[tag, found[0]]);
}

#[test]
fn oracle_test_code_is_told_from_code() {
    let text = "fn code() {}\n\n#[cfg(test)]\nmod tests {\n    // [spec: A-1]\n    fn helper() {\n    }\n}\n\nfn more() {}\n#[cfg(test)]\nuse a::b;\nfn last() {}\n";
    let source = Source::new("core/src/lib.rs", text);
    let marked = test_lines(&source, &TestModules::default());
    let numbers: Vec<usize> =
        marked.iter().enumerate().filter(|(_, is_test)| **is_test).map(|(at, _)| at + 1).collect();
    assert_eq!(numbers, [3, 4, 5, 6, 7, 8, 11, 12]);

    let parent = Source::new("core/src/view.rs", "#[cfg(test)]\nmod tests;\n");
    let modules = TestModules::of(&[parent]);
    for (path, expected) in
        [("core/src/view/tests.rs", true), ("core/src/view/tests_of.rs", false), ("core/src/tree.rs", false)]
    {
        let lines = test_lines(&Source::new(path, "fn code() {}\n"), &modules);
        assert_eq!(lines, [expected], "{path}");
    }
}
