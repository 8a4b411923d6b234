//! `dsr scene` as users run it: exit statuses and texts.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that cannot go on says where"
)]

mod common;

use common::{dsr, dsr_with};
use std::path::PathBuf;

#[track_caller]
fn check(arguments: &[&str], input: &str, status: i32, out: &str, err: &str) {
    let run = dsr_with(arguments, input.as_bytes());
    assert_eq!((run.status, run.out.as_str(), run.err.as_str()), (status, out, err));
}

/// An empty folder of this test's own.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

const DANGLING: &str = r#"{"DSRModel": {"symbols": {
"1": {"id": "1", "name": "world", "type": "world", "links": [
  {"src": "1", "dst": "2", "label": "RT"}]},
"2": {"id": "2", "name": "hub", "type": "thing", "links": [
  {"src": "2", "dst": "7", "label": "has"},
  {"src": "2", "dst": "2", "label": "near"}]}}}}"#;

#[test]
fn law_check_says_sound() {
    let told = "sound: @flat: 29 vertices, 52 edges, 156 attributes\nsound: @tiny: 5 vertices, 7 edges, 20 attributes\n";
    check(&["scene", "check", "@flat", "@tiny", "--dictionary", "aal"], "", 0, told, "");
}

#[test]
fn law_check_names_every_fault_with_place_and_remedy() {
    let told = "\
-:5:3: symbol 2 \"hub\", link 0 (has to 7): the link is dangling: the file has no symbol 7
  remedy: add the missing symbol, or remove the link
-:6:3: symbol 2 \"hub\", link 1 (near to 2): the link joins the symbol to itself
  remedy: remove the link
";
    check(&["scene", "check", "-"], DANGLING, 1, "refused: -: 2 fault(s)\n", told);
}

#[test]
fn law_check_lenient_drops_and_lists() {
    let told = "\
-:5:3: symbol 2 \"hub\", link 0 (has to 7): the link is dangling: the file has no symbol 7
  dropped
-:6:3: symbol 2 \"hub\", link 1 (near to 2): the link joins the symbol to itself
  dropped
";
    let out = "sound after drops: -: 2 vertices, 1 edges, 0 attributes, 2 fault(s) dropped\n";
    check(&["scene", "check", "-", "--lenient"], DANGLING, 0, out, told);
}

#[test]
fn law_check_reports_as_json() {
    let run = dsr_with(&["scene", "check", "@tiny", "-", "--format", "json"], DANGLING.as_bytes());
    assert_eq!((run.status, run.err.as_str()), (1, ""));
    let report: serde_json::Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!(report["status"], 1);
    assert_eq!(report["files"][0]["sound"], true);
    let fault = &report["files"][1]["faults"][0];
    assert_eq!((&fault["line"], &fault["column"]), (&5.into(), &3.into()));
    assert_eq!(fault["symbol"]["name"], "hub");
    assert_eq!(fault["link"]["target"], "7");
}

#[test]
fn law_wrong_usage_and_unreadable_input_end_in_status_3() {
    let cases: [(&[&str], &[u8], &str); 16] = [
        (&[], b"", "Usage: dsr <COMMAND>"),
        (&["scene"], b"", "Usage: dsr scene <COMMAND>"),
        (&["scene", "bogus"], b"", "unrecognized subcommand 'bogus'"),
        (&["scene", "check"], b"", "<FILE>..."),
        (&["scene", "check", "no such file"], b"", "no such file: cannot read"),
        (&["scene", "check", "@house"], b"", "\"@house\" is no embedded scene"),
        (&["scene", "check", "-"], b"", "-:1:1: the file is empty"),
        (&["scene", "check", "-"], b"{\"DSR", "-:1:6: not JSON: the file ends in the middle"),
        (&["scene", "check", "-"], b"{\n \xff}", "-: line 2, column 2: not UTF-8 text"),
        (&["scene", "check", "-"], b"[]", "older array form"),
        (&["scene", "check", "-"], b"\x02\x00\xff", "-: not a binary state"),
        (&["scene", "check", "-"], b"\x01\x00\xff", "-: not a binary state: version 1; "),
        (&["scene", "check", "-"], b"{\"context\": 5}", "-: not a state"),
        (&["scene", "check", "@tiny", "--dictionary", "-"], b"{\"closed\": 1}", "-: not a dictionary"),
        (
            &["scene", "show", "@tiny", "--vertex", "robt"],
            b"",
            "no vertex is named \"robt\"; the nearest is \"robot\"",
        ),
        (
            &["scene", "convert", "@tiny", "out.txt"],
            b"",
            "out.txt: the name does not say which form to write",
        ),
    ];
    for (arguments, input, told) in cases {
        let run = dsr_with(arguments, input);
        assert_eq!(run.status, 3, "{arguments:?}: {run:?}");
        assert!(run.err.contains(told), "{arguments:?}: {run:?}");
        assert!(run.err.contains("remedy: ") || run.err.contains("Usage"), "{arguments:?}: {run:?}");
    }
}

#[test]
fn law_a_refused_scene_is_wrong_input_to_whatever_needs_a_graph() {
    let folder = folder("refused");
    let target = folder.join("out.json");
    let target = target.to_str().unwrap();
    for arguments in [
        &["scene", "show", "-"][..],
        &["scene", "dot", "-"],
        &["scene", "diff", "@tiny", "-"],
        &["scene", "convert", "-", target],
    ] {
        let run = dsr_with(arguments, DANGLING.as_bytes());
        assert_eq!((run.status, run.out.as_str()), (3, ""), "{arguments:?}");
        assert!(run.err.contains("-:5:3: ") && run.err.contains("--lenient"), "{run:?}");
    }
    assert!(!std::fs::exists(target).unwrap());
}

#[test]
fn law_help_reads_well_and_is_no_error() {
    for arguments in
        [&["--help"][..], &["scene", "--help"], &["scene", "check", "--help"], &["scene", "diff", "--help"]]
    {
        let run = dsr(arguments);
        assert_eq!((run.status, run.err.as_str()), (0, ""));
        assert!(run.out.contains("Usage: dsr"));
    }
    assert!(dsr(&["--help"]).out.contains("1  violated"));
    assert!(dsr(&["scene", "check", "--help"]).out.contains("64 MiB"));
}

#[test]
fn law_show_prints_tree_edges_and_one_vertex() {
    let whole = "\
5 vertices, 7 edges, 20 attributes

Kinematic tree
  world (world)
    kitchen (room)  at (2, 1.5, 0)  turned (0, 0, 0)
      table (table)  at (0.5, 0.5, 0.75)  turned (0, 0, 0)
        cup (cup)  at (0.1, 0.2, 0.05)  turned (0, 0, 0)  [color=\"blue\"]
    robot (robot)  at (1, 1, 0)  turned (0, 0, 1.570796)  [battery_percentage=90]

Other edges
  kitchen -in-> world
  table -in-> kitchen
  robot -in-> kitchen
";
    check(&["scene", "show", "@tiny"], "", 0, whole, "");
    let one = "\
cup (cup)
  id 5
  RT child of table  at (0.1, 0.2, 0.05)  turned (0, 0, 0)
  color = \"blue\" (string)
  level = 3 (int)
  parent = 3 (uint64)
  table -RT-> cup
    rt_rotation_euler_xyz = [0.0, 0.0, 0.0] (float_vec)
    rt_translation = [0.1, 0.2, 0.05] (float_vec)
";
    check(&["scene", "show", "@tiny", "--vertex", "cup"], "", 0, one, "");
}

#[test]
fn law_conversions_there_and_back_lose_nothing() {
    let folder = folder("conversions");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (binary, state, scene) = (path("a.dsr"), path("b.state.json"), path("c.json"));
    for (from, to) in [("@flat", &binary), (&binary, &state), (&state, &scene)] {
        let run = dsr(&["scene", "convert", from, to]);
        assert_eq!((run.status, run.out.as_str()), (0, ""), "{run:?}");
    }
    check(&["scene", "diff", "@flat", &scene], "", 0, "equal\n", "");
    assert_eq!(std::fs::read_to_string(&scene).unwrap(), dsr_core::scene::FLAT);
    check(
        &["scene", "check", &binary, "--dictionary", "aal"],
        "",
        0,
        &format!("sound: {binary}: 29 vertices, 52 edges, 156 attributes\n"),
        "",
    );
    let told = dsr(&["scene", "convert", "@tiny", "-", "--to", "state"]);
    assert!(
        told.err.contains("-: note: a state does not hold the root's own name: \"world\" (world, id 1)"),
        "{told:?}"
    );
    let unwritable = dsr(&["scene", "convert", "@tiny", &path("none/x.json")]);
    assert_eq!(unwritable.status, 3);
    assert!(unwritable.err.contains("cannot write") && unwritable.err.contains("remedy"), "{unwritable:?}");
}

#[test]
fn law_diff_lists_what_was_added_removed_and_changed() {
    let other = dsr_core::scene::TINY
        .replace("\"blue\"", "\"red\"")
        .replace("\"name\": \"cup\"", "\"name\": \"mug\"")
        .replace("\"label\": \"in\"", "\"label\": \"near\"")
        .replace("battery_percentage", "battery_load");
    let told = "\
- vertex robot: battery_percentage = 90 (float)
+ vertex robot: battery_load = 90 (float)
~ vertex cup: name cup -> mug
~ vertex cup: color \"blue\" (string) -> \"red\" (string)
";
    let run = dsr_with(&["scene", "diff", "@tiny", "-"], other.as_bytes());
    assert_eq!((run.status, run.err.as_str()), (1, ""));
    for line in told.lines().chain([
        "- edge robot -in-> kitchen",
        "+ edge robot -near-> kitchen",
        "different: 10 line(s)",
    ]) {
        assert!(run.out.lines().any(|told| told == line), "{line}\n{}", run.out);
    }
    let without = DANGLING.replace("\"hub\"", "\"only\"");
    let run = dsr_with(&["scene", "diff", "-", "@tiny", "--lenient"], without.as_bytes());
    assert_eq!(run.status, 1);
    assert!(run.out.contains("+ vertex robot (robot), 3 attribute(s)"), "{}", run.out);
}

#[test]
fn law_dot_is_a_graph_with_every_vertex_and_edge() {
    let run = dsr(&["scene", "dot", "@tiny"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    assert!(run.out.starts_with("digraph scene {\n") && run.out.ends_with("}\n"));
    assert_eq!(run.out.matches(" -> ").count(), 7);
    assert!(run.out.contains("v0 -> v1 [label=\"RT\", style=bold];"));
    let hostile = DANGLING.replace("\"hub\"", r#""a\"];b""#);
    let run = dsr_with(&["scene", "dot", "-", "--lenient"], hostile.as_bytes());
    assert!(run.out.contains(r#"label="a\"];b\nthing""#), "{}", run.out);
}
