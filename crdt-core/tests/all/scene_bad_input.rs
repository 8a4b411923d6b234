//! Files that are no scene at all: each a clear error with its place, and never a panic.

use crate::scene_support::{check_lossless, fault_lines, faults, link, scene, symbol, with_attributes};
use dsr_core::scene::{FLAT, FaultKind, Scene, Strictness, TINY};
use dsr_core::{Dictionary, limits};
use proptest::prelude::*;

/// [spec: SCENE-3]
#[test]
fn regress_empty_file() {
    for text in ["", " \n\t\r\n ", "\u{feff}"] {
        assert!(fault_lines(text).last().unwrap().ends_with("the file is empty"));
    }
}

/// [spec: SCENE-3]
#[test]
fn regress_truncated_anywhere() {
    let scene = TINY.trim_end();
    for end in 1..scene.len() {
        let Some(text) = scene.get(..end) else { continue };
        let found = faults(text);
        assert_eq!(found.len(), 1, "cut at {end}");
        let truncated =
            matches!(found[0].kind, FaultKind::Syntax(error) if error.to_string().contains("cut off"));
        assert!(truncated, "cut at {end}: {}", found[0]);
    }
}

/// [spec: SCENE-3]
#[test]
fn regress_corrupt_json_tells_line_and_column() {
    let cases = [
        ("{\n  \"DSRModel\" 5}", "line 2, column 14: not JSON: expected `:` after the key"),
        ("{\n  \"é\": nul}", "line 2, column 8: not JSON: expected a value"),
        ("{\"a\": 01}", "line 1, column 8: not JSON: not a JSON number"),
        ("{\"a\": 1.}", "line 1, column 9: not JSON: not a JSON number"),
        ("{\"a\": +1}", "line 1, column 7: not JSON: expected a value"),
        ("{\"a\": NaN}", "line 1, column 7: not JSON: expected a value"),
        ("{\"a\": 'x'}", "line 1, column 7: not JSON: expected a value"),
        ("{a: 1}", "line 1, column 2: not JSON: expected a key in double quotes"),
        ("{\"a\": 1,}", "line 1, column 9: not JSON: expected a key in double quotes"),
        ("{\"a\": 1 \"b\": 2}", "line 1, column 9: not JSON: expected `,` or `}`"),
        ("[1 2]", "line 1, column 4: not JSON: expected `,` or `]`"),
        ("{\"a\": \"x\ny\"}", "line 1, column 9: not JSON: a control character inside text must be escaped"),
        ("{\"a\": \"\\x\"}", "line 1, column 9: not JSON: not a JSON escape"),
        ("{\"a\": \"\\ud800\"}", "line 1, column 14: not JSON: not a JSON escape"),
        ("{\"a\": \"\\udc00\"}", "line 1, column 14: not JSON: not a JSON escape"),
        ("{\"a\": \"\\ud800\\u0041\"}", "line 1, column 20: not JSON: not a JSON escape"),
    ];
    for (text, told) in cases {
        let lines = fault_lines(text);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].starts_with(told), "{text}: {lines:?}");
        assert!(Scene::read(text, &Dictionary::open(), Strictness::Lenient).is_err());
    }
}

/// [spec: SCENE-2]
#[test]
fn regress_deep_nesting() {
    for deep in ["[".repeat(1_000_000), "{\"a\":".repeat(1_000_000)] {
        let lines = fault_lines(&deep);
        assert!(lines[0].ends_with("nested deeper than 32 levels"), "{lines:?}");
    }
    let nested = format!("{}{}", "[".repeat(24), "]".repeat(24));
    let lines = fault_lines(&with_attributes(&format!("\"a\": {{\"type\": 3, \"value\": {nested}}}")));
    assert!(lines[0].ends_with("the value must be a 32-bit float, but it is a list"), "{lines:?}");
}

/// [spec: SCENE-2]
#[test]
fn regress_file_over_the_limit() {
    let text = " ".repeat(limits::SCENE_BYTES_MAX + 1);
    let told = "line 1, column 1: the scene has 67108865 bytes; allowed are 67108864";
    assert_eq!(fault_lines(&text), [told]);
}

/// [spec: SCENE-3] [spec: SCENE-5]
#[test]
fn regress_byte_order_mark_and_text_after_the_document() {
    let marked = format!("\u{feff}{TINY}");
    assert_eq!(fault_lines(&marked), ["line 1, column 1: the file starts with a byte order mark"]);
    let two = format!("{}{TINY}", TINY.trim_end());
    let lines = TINY.lines().count();
    assert_eq!(
        fault_lines(&two),
        [format!("line {lines}, column 2: the scene ends here, but the file goes on")]
    );
    let tiny = check_lossless(TINY, &Dictionary::open());
    for text in [marked, two] {
        let imported = Scene::read(&text, &Dictionary::open(), Strictness::Lenient).unwrap();
        assert_eq!((imported.scene == tiny, imported.dropped.len()), (true, 1));
    }
}

/// [spec: SCENE-3]
#[test]
fn regress_older_array_form() {
    for text in ["[]", "{\"DSRModel\": {\"symbols\": [{\"id\": 1}]}}"] {
        let found = faults(text);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].kind, FaultKind::ArrayForm);
        assert!(found[0].kind.remedy().contains("older version"));
        assert!(Scene::read(text, &Dictionary::open(), Strictness::Lenient).is_err());
    }
}

/// [spec: SCENE-1] [spec: SCENE-6]
#[test]
fn regress_json_that_is_no_scene() {
    let cases = [
        ("5", "line 1, column 1: a scene must be an object with the key `DSRModel`, but it is a number"),
        ("{}", "line 1, column 1: the key `DSRModel` is missing"),
        ("{\"DSRModel\": 5}", "line 1, column 14: `DSRModel` must be an object, but it is a number"),
        ("{\"DSRModel\": {}}", "line 1, column 14: the key `symbols` is missing"),
        (
            "{\"DSRModel\": {\"symbols\": null}}",
            "line 1, column 26: `symbols` must be an object, but it is null",
        ),
    ];
    for (text, told) in cases {
        assert_eq!(fault_lines(text), [told]);
        assert!(Scene::read(text, &Dictionary::open(), Strictness::Lenient).is_err());
    }
    let lines = fault_lines("{\"store\": {}, \"context\": {}}");
    assert_eq!(lines.len(), 3, "{lines:?}");
}

/// [spec: SCENE-8]
#[test]
fn regress_huge_numbers() {
    let digits = "9".repeat(100_000);
    for number in 0..14 {
        for value in [digits.as_str(), "1e999999999", "-1e400"] {
            let lines =
                fault_lines(&with_attributes(&format!("\"a\": {{\"type\": {number}, \"value\": {value}}}")));
            assert_eq!(lines.len(), 1);
            assert!(lines[0].len() < 400, "a fault quotes little of a long input");
        }
    }
    assert!(
        !fault_lines(&scene(
            "",
            &symbol(2, "hub", "", "").replacen("\"id\": \"2\"", &format!("\"id\": {digits}"), 1)
        ))
        .is_empty()
    );
}

/// A chain as long as a file may be is read without recursion. [spec: SCENE-2]
#[test]
fn regress_long_chain() {
    const LENGTH: u64 = 20_000;
    let symbols: Vec<String> = (2..=LENGTH)
        .map(|id| {
            let next = if id == LENGTH { String::new() } else { link(id, "RT", id + 1) };
            symbol(id, &format!("n{id}"), "", &next)
        })
        .collect();
    let text = scene(&link(1, "RT", 2), &symbols.join(",\n"));
    let chain = Scene::read(&text, &Dictionary::open(), Strictness::Strict).unwrap().scene;
    assert_eq!(
        Scene::read(&chain.write(&Dictionary::open()), &Dictionary::open(), Strictness::Strict)
            .unwrap()
            .scene,
        chain
    );
    // Every symbol but the last also claims to be the parent of the first: a cycle each, told in short.
    let cycles: Vec<String> = symbols
        .iter()
        .enumerate()
        .map(|(at, symbol)| {
            let id = at as u64 + 2;
            let back = link(id, "RT", 2);
            if id <= 3 || id == LENGTH {
                symbol.clone()
            } else {
                symbol.replacen("\"links\": [", &format!("\"links\": [{back}, "), 1)
            }
        })
        .collect();
    let found = faults(&scene("", &cycles.join(",\n")));
    assert!(found.iter().all(|fault| fault.to_string().len() < 2000));
}

/// JSON to this reader is JSON to others: the same texts pass, apart from numbers and surrogates out of range.
/// [spec: SCENE-3]
fn is_json_here(text: &str) -> bool {
    match Scene::read(text, &Dictionary::open(), Strictness::Strict) {
        Ok(_) => true,
        Err(error) => !error.faults.iter().any(|fault| {
            matches!(
                fault.kind,
                FaultKind::Syntax(_) | FaultKind::Empty | FaultKind::TrailingText | FaultKind::ByteOrderMark
            )
        }),
    }
}

const SMALL: &str = "{\"DSRModel\": {\"symbols\": {\"1\": {\"id\": 1, \"name\": \"w\\u00e9\\n\", \"type\": \"world\", \
    \"links\": [], \"attribute\": {\"a\": {\"type\": 3, \"value\": [1, -2.5e1, 0.0]}, \"b\": {\"type\": 4, \"value\": true}}}}}}";

proptest! {
    /// [spec: SCENE-3]
    #[test]
    fn differential_syntax_agrees_with_another_parser(
        at in 0..SMALL.len(), cut in 0_usize..3, insert in "[-+0-9eE.,:{}\\[\\]\"\\\\tfn u]{0,3}"
    ) {
        let mut text = SMALL.to_owned();
        text.replace_range(at..(at + cut).min(SMALL.len()), &insert);
        let other = serde_json::from_str::<serde_json::Value>(&text);
        let excused = other.as_ref().is_err_and(|error| error.to_string().contains("out of range"));
        prop_assert!(excused || is_json_here(&text) == other.is_ok(), "{text}: {other:?}");
    }

    /// [spec: SCENE-4] [spec: SCENE-5]
    #[test]
    fn regress_no_panic_on_damaged_scenes(
        at in 0..TINY.len(), cut in 0_usize..40, insert in any::<String>(), lenient in any::<bool>()
    ) {
        let mut text = TINY.to_owned();
        text.replace_range(at..(at + cut).min(TINY.len()), &insert);
        let strictness = if lenient { Strictness::Lenient } else { Strictness::Strict };
        match Scene::read(&text, &Dictionary::aal(), strictness) {
            Ok(imported) => {
                prop_assert!(lenient || imported.dropped.is_empty());
                check_lossless(&imported.scene.write(&Dictionary::aal()), &Dictionary::aal());
            }
            Err(error) => prop_assert!(!error.faults.is_empty()),
        }
    }
}

#[test]
fn law_shipped_scenes_are_ascii_and_end_in_a_line_break() {
    for text in [FLAT, TINY] {
        assert!(text.is_ascii() && text.ends_with("}\n"));
    }
}
