//! The account of the evidence is current and has no gap; and each alarm goes off on a small input that should set it
//! off.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

use dsr_spec::{
    ASSURANCE_PATH, Clauses, Documents, Evidence, Grade, Inputs, README_PATH, Source, TestModules,
    WitnessKind, assurance, claims, collect_clauses, evidence, read_documents, read_file, read_inputs,
    readme, theorems_of, witness_kinds,
};
use std::collections::BTreeMap;
use std::path::PathBuf;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn of_the_workspace() -> Evidence {
    evidence(&read_inputs(&root()).unwrap(), &read_documents(&root()).unwrap())
}

#[test]
fn law_every_clause_has_evidence_and_a_proof_or_a_reason() {
    let evidence = of_the_workspace();
    let count = |grade| evidence.binding().filter(|clause| evidence.grade(&clause.id) == grade).count();
    for grade in Grade::ALL {
        println!("{}: {}", grade.words(), count(grade));
    }
    assert!(count(Grade::Proved) > 20 && count(Grade::Tested) > 20, "the evidence was not found");
    let gaps: Vec<String> = evidence.gaps.iter().map(|gap| format!("  {gap}")).collect();
    assert!(gaps.is_empty(), "{} gaps:\n{}", gaps.len(), gaps.join("\n"));
}

#[test]
fn law_the_account_and_the_readme_are_current() {
    let evidence = of_the_workspace();
    for (path, write) in [(ASSURANCE_PATH, assurance as fn(&_, &_) -> _), (README_PATH, readme)] {
        let file = read_file(&root(), path).unwrap();
        let current: Result<String, _> = write(&evidence, &file);
        let current = current.unwrap();
        let difference = file.text.lines().zip(current.lines()).find(|(old, new)| old != new);
        assert!(
            file.text == current,
            "{path} is stale (first difference: {difference:#?}); write it anew: cargo run -p dsr-spec"
        );
    }
}

/// What is said to be checked exhaustively was so in the recorded run.
#[test]
fn law_the_recorded_run_has_every_clause_that_is_said_to_be_checked() {
    let runs = read_file(&root(), "docs/runs.md").unwrap();
    let recorded: Vec<Vec<&str>> =
        runs.text.lines().map(|line| line.split_whitespace().take(3).collect()).collect();
    let evidence = of_the_workspace();
    let layers = evidence.layers.iter().filter(|layer| ["L0", "L1", "L2", "L1 = L2"].contains(&&*layer.name));
    for (id, says) in layers.flat_map(|layer| &layer.judges) {
        // Asks for an instance; the report lists what must hold everywhere.
        if says == "equal contexts do not mean equal states" {
            continue;
        }
        let is_recorded = |line: &Vec<&str>| line[..].get(1..3) == Some(&[&*id.to_string(), "exhaustive"]);
        assert!(recorded.iter().any(is_recorded), "docs/runs.md has no exhaustive verdict on {id} ({says})");
    }
}

/// Without Coq: the theorems of the tables stand in the files that they name. `spec/coq/check` proves them.
#[test]
fn law_theorems_of_the_tables_are_stated() {
    let evidence = of_the_workspace();
    assert!(evidence.theorems.len() > 100);
    let mut files: BTreeMap<String, String> = BTreeMap::new();
    for theorem in &evidence.theorems {
        let (file, name) = theorem.name.split_once('.').unwrap();
        let text = files
            .entry(file.into())
            .or_insert_with(|| std::fs::read_to_string(root().join(format!("spec/coq/{file}.v"))).unwrap());
        let states = |line: &str| {
            let mut words =
                line.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty());
            matches!(words.next(), Some("Theorem" | "Corollary")) && words.next() == Some(name)
        };
        assert!(text.lines().any(states), "{}", theorem.name);
    }
}

const TEXT: &str = "# Things\n\n**JOIN-1.** Text.\n\n**JOIN-2.** Text.\n\n**JOIN-3.** Text.\n\n**NET-1 (assumption).** Text.\n\n\
                    **CLAIM-L1 (definition).** All is well: JOIN-1 to JOIN-3, under NET-1.\n\n\
                    **CLAIM-L2 (definition).** Some is: JOIN-1.\n\nNot claimed: JOIN-2.\n";
const CODE: &str = "/// `[spec: JOIN-1]` to\n/// `[spec: JOIN-3]`\nfn join() {}\n";
const TESTS: &str = "/// [spec: JOIN-1, JOIN-2, JOIN-3]\n#[test]\nfn law_join() {}\n";
const THEOREMS: &str = "| clause | theorem | says | code |\n|---|---|---|---|\n| tool | `Map.ext` | Maps. |  |\n\
                        | JOIN-1, NET-1, CLAIM-L2 | `Join.assoc` | It is so. | `join` |\n\
                        | JOIN-3 | `Join.part` | Half of it. | `join` |\n\
                        | JOIN-2 | `Join.odd` | Counterexample: not so. |  |\n";
const LEFT_OUT: &str = "| clause | what no theorem says |\n|---|---|\n| JOIN-3 | the other half |\n\n\
                        | clauses | why there is no proof |\n|---|---|\n| JOIN-2 | not yet |\n";
const JUDGED: &str = r#"{"layers": [
  {"layer": "L1", "runs": ["2 × 2, all six", "2 × 2, a + b", "2 × 2, a + c"], "judges": [{"clause": "JOIN-2", "says": "so"}]},
  {"layer": "L3", "runs": ["2 × 9"], "judges": [{"clause": "JOIN-1", "says": "so"}]}]}"#;
const CASES: &str = r#"{"cases": [{"spec": ["JOIN-1", "JOIN-2"]}, {"spec": ["JOIN-1"]}]}"#;

/// A small workspace that lacks nothing.
fn sound() -> (Inputs, Documents) {
    let inputs = Inputs {
        texts: vec![Source::new("spec/a.md", TEXT)],
        rust: vec![Source::new("core/src/lib.rs", CODE), Source::new("core/tests/laws.rs", TESTS)],
    };
    let documents = Documents {
        theorems: Source::new("coq.md", THEOREMS),
        left_out: Source::new("left.md", LEFT_OUT),
        judged: Source::new("judged.json", JUDGED),
        corpus: vec![Source::new("corpus/a.json", CASES)],
        fuzz: vec![Source::new("fuzz/fuzz_targets/join.rs", "//! `[spec: JOIN-2]`\nfn main() {}\n")],
    };
    (inputs, documents)
}

/// The gaps of the small workspace after a change, as text.
#[track_caller]
fn check(change: impl FnOnce(&mut Inputs, &mut Documents), expected: &[&str]) {
    let (mut inputs, mut documents) = sound();
    change(&mut inputs, &mut documents);
    let gaps: Vec<String> = evidence(&inputs, &documents).gaps.iter().map(ToString::to_string).collect();
    assert_eq!(gaps, expected);
}

fn small() -> Evidence {
    let (inputs, documents) = sound();
    evidence(&inputs, &documents)
}

#[test]
fn law_a_complete_input_has_no_gap() {
    check(|_, _| {}, &[]);
}

#[test]
fn oracle_the_evidence_of_a_small_workspace_is_counted() {
    let evidence = small();
    let of = |id: &str| &evidence.grounds[&id.parse().unwrap()];
    let grades: Vec<Grade> = ["JOIN-1", "JOIN-2", "JOIN-3"].map(|id| of(id).grade()).into();
    assert_eq!(grades, [Grade::Proved, Grade::Checked, Grade::InPart]);
    let (first, second) = (of("JOIN-1"), of("JOIN-2"));
    assert_eq!((first.tests, first.cases, first.walked, first.fuzzed), (1, 2, true, 0));
    assert_eq!((second.tests, second.cases, second.walked, second.fuzzed), (1, 1, false, 1));
    assert_eq!((second.theorems.len(), second.examples.len()), (0, 1));
    assert_eq!(second.layers, ["L1"]);
    assert_eq!(evidence.layers[0].bounds(), [("2 × 2, all six".into(), 1), ("2 × 2, two kinds".into(), 2)]);
}

/// The weakest clause decides, assumptions are none, and what follows the claim is none of it.
#[test]
fn oracle_a_claim_is_as_strong_as_its_weakest_clause() {
    let evidence = small();
    let [all, some] = &claims(&evidence)[..] else { panic!("two claims") };
    assert_eq!((all.sentence.as_str(), all.clauses.len(), all.assumed.len()), ("All is well", 3, 1));
    assert_eq!(all.grade(&evidence), Grade::Checked);
    assert_eq!(
        all.status(&evidence),
        "**checked exhaustively to a bound** as a whole (no more is known of JOIN-2); proved in part: JOIN-3; proved: JOIN-1"
    );
    assert_eq!((some.clauses.len(), some.status(&evidence).as_str()), (1, "**proved** of the model"));
    assert_eq!(all.commands(&evidence), "`spec/coq/check`, `dsr check --layer l1`, `cargo test -p dsr-core`");
}

/// The alarm: a clause that binds and has nothing.
#[test]
fn canary_a_clause_without_evidence_is_found() {
    let extend = |inputs: &mut Inputs, documents: &mut Documents| {
        inputs.texts[0].text += "\n**JOIN-4.** Text.\n";
        documents.left_out.text += "| JOIN-4 | not yet |\n";
    };
    let nothing = "spec/a.md:17: nothing speaks for JOIN-4: no theorem, no layer of the checker, no test, no sample, no case";
    check(extend, &[nothing]);
    let tested = |inputs: &mut Inputs, documents: &mut Documents| {
        extend(inputs, documents);
        inputs.rust[1].text += "/// [spec: JOIN-4]\n#[test]\nfn law_more() {}\n";
    };
    check(tested, &[]);
    let told = "spec/a.md:17: no theorem is about JOIN-4, and spec/coq/coverage.md does not say why";
    check(|inputs, _| inputs.texts[0].text += "\n**JOIN-4.** Text.\n", &[told, nothing]);
    // Definitions need nothing.
    check(|inputs, _| inputs.texts[0].text += "\n**JOIN-4 (definition).** Text.\n", &[]);
}

#[test]
fn canary_a_table_of_theorems_that_says_nothing_is_found() {
    for (row, gap) in [
        (
            "|  | `Join.more` | So. | |",
            "coq.md:7: Join.more cites no clause: name those that it is about, or say `tool`",
        ),
        ("| JOIN-9 | `Join.more` | So. | |", "coq.md:7: cites JOIN-9, which is no clause"),
        (
            "| join | `Join.more` | So. | |",
            "coq.md:7: \"join\" is no clause and no range of clauses such as `WF-4 – WF-6`",
        ),
        (
            "| JOIN-3 – JOIN-1 | `Join.more` | So. | |",
            "coq.md:7: \"JOIN-3 – JOIN-1\" is no clause and no range of clauses such as `WF-4 – WF-6`",
        ),
        (
            "| JOIN-1 | Join.more | So. | |",
            "coq.md:7: \"Join.more\" names no theorem: expected `File.name` between backticks",
        ),
        (
            "| JOIN-1 | `more` | So. | |",
            "coq.md:7: \"`more`\" names no theorem: expected `File.name` between backticks",
        ),
        ("| JOIN-1 | `Join.more` | So. |", "coq.md:7: a row with 3 cells where 4 belong"),
    ] {
        check(|_, documents| documents.theorems.text = format!("{THEOREMS}{row}\n"), &[gap]);
    }
}

#[test]
fn oracle_tables_of_theorems_are_read_with_ranges_tools_and_examples() {
    let (clauses, _): (Clauses, _) = collect_clauses(&[Source::new("spec/a.md", TEXT)]);
    let table =
        Source::new("coq.md", &format!("text\n{THEOREMS}\n| other | table |\n|---|---|\n| x | y |\n"));
    let mut gaps = Vec::new();
    let theorems = theorems_of(&table, &clauses, &mut gaps);
    assert!(gaps.is_empty(), "{gaps:?}");
    let read: Vec<(&str, usize, bool)> =
        theorems.iter().map(|theorem| (&*theorem.name, theorem.clauses.len(), theorem.is_example)).collect();
    assert_eq!(
        read,
        [("Map.ext", 0, false), ("Join.assoc", 3, false), ("Join.part", 1, false), ("Join.odd", 1, true)]
    );
    assert!(theorems_of(&Source::new("coq.md", "no table"), &clauses, &mut gaps).is_empty());
    assert_eq!(gaps[0].to_string(), "coq.md: no theorems found");
}

#[test]
fn canary_what_is_said_of_proofs_and_is_not_so_is_found() {
    let part =
        "left.md:4: JOIN-2 is said to be proved in part, but no theorem is about it: give the reason instead";
    check(
        |_, documents| documents.left_out.text = LEFT_OUT.replace("half |\n", "half |\n| JOIN-2 | much |\n"),
        &[part],
    );
    let stale = "left.md:8: theorems are about all of these clauses by now: take the row away";
    check(|_, documents| documents.left_out.text += "| JOIN-1 | not yet |\n", &[stale]);
    // A chapter's word stands for its clauses.
    check(|_, documents| documents.left_out.text = LEFT_OUT.replace("| JOIN-2 |", "| JOIN |"), &[]);
    let unknown = "left.md:8: cites JOIN-9, which is no clause";
    check(|_, documents| documents.left_out.text += "| JOIN-2, JOIN-9 | not yet |\n", &[unknown]);
    check(
        |_, documents| documents.left_out.text += "| JOIN-2 |  |\n",
        &["left.md:8: a row with 1 cells where 2 belong"],
    );
}

#[test]
fn canary_lists_that_cannot_be_read_are_found() {
    check(
        |_, documents| documents.judged.text = JUDGED.replace("JOIN-2", "JOIN-7"),
        &["judged.json:1: cites JOIN-7, which is no clause"],
    );
    check(
        |_, documents| documents.judged.text = r#"{"layers": [{"layer": "L1"}]}"#.into(),
        &["judged.json: no layers, each with its name, its runs and what it judges"],
    );
    check(
        |_, documents| documents.corpus[0].text = CASES.replace("JOIN-2", "JOIN-7"),
        &["corpus/a.json:1: \"JOIN-7\" is no clause and no range of clauses such as `WF-4 – WF-6`"],
    );
    check(|_, documents| documents.corpus.clear(), &["conformance/corpus/v1: no cases found"]);
    check(
        |inputs, _| inputs.texts[0].text = TEXT.replace("Some is: JOIN-1.", "Some is."),
        &["spec/a.md:13: CLAIM-L2 names no clause that says it exactly"],
    );
}

#[test]
fn oracle_tests_samples_and_judges_are_told_apart() {
    let text = "fn judge() {}\n\n#[cfg(test)]\nmod tests {\n    #[test]\n    fn law_all() {\n    }\n\n    proptest! {\n        \
                #[test]\n        fn law_some(x in 0..9) {\n        }\n    }\n\n    fn helper() {\n        let mut runner = \
                TestRunner::deterministic();\n    }\n\n    fn last() {\n    }\n}\n";
    let kinds = witness_kinds(&Source::new("core/src/lib.rs", text), &TestModules::default());
    let expected = [
        ("helper", WitnessKind::Sample),
        ("judge", WitnessKind::Judge),
        ("last", WitnessKind::Test),
        ("law_all", WitnessKind::Test),
        ("law_some", WitnessKind::Sample),
    ];
    assert_eq!(kinds.into_iter().collect::<Vec<_>>(), expected.map(|(name, kind)| (name.to_owned(), kind)));
}

/// An oracle is claimed only where the specification has one.
#[test]
fn law_there_is_an_oracle_only_if_the_specification_has_one() {
    let region =
        |name: &&str| format!("<!-- {name}: written by cargo run -p dsr-spec -->\n<!-- end of {name} -->\n");
    let names = ["claims", "counts", "oracle", "layers", "clauses", "unproved"];
    let page = names.iter().map(region).collect::<Vec<_>>().concat();
    let file = Source::new(ASSURANCE_PATH, &page);
    let without = assurance(&small(), &file).unwrap();
    assert!(without.contains("There is no oracle yet") && !without.contains("by core and oracle"));
    let (mut inputs, documents) = sound();
    inputs.texts.push(Source::new("spec/oracle.md", "# Oracle\n\n**ORACLE-1 (definition).** Text.\n"));
    let with = assurance(&evidence(&inputs, &documents), &file).unwrap();
    assert!(with.contains("`dsr oracle corpus`, 2 cases") && with.contains("cases, by core and oracle"));
    let gap = assurance(&small(), &Source::new(ASSURANCE_PATH, "")).unwrap_err();
    assert!(gap.to_string().starts_with("docs/assurance.md: no lines"), "{gap}");
}
