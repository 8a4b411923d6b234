//! Views that break an invariant are told by its clause, and sound ones are not.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::protocol::{View, read_strictly};
use dsr_conformance::run::broken;
use dsr_core::Dictionary;

type Triple = (&'static str, &'static str, &'static str);

fn view(edges: &str, hung: &str) -> View {
    let vertex = r#"{"type": "t", "name": "n", "attributes": {"a": {"type": "int", "value": 1}}}"#;
    let text = format!(
        r#"{{"vertices": {{"x": {vertex}, "y": {vertex}, "z": {vertex}}}, "edges": {edges}, "root": {{}}, "hung": {hung}}}"#
    );
    let mut view: View = serde_json::from_str(&text).unwrap();
    view.root.attributes = view.vertices.0["x"].attributes.clone();
    view
}

/// An edge for each triple.
fn edges(edges: &[Triple]) -> String {
    let text =
        |(from, label, to): &Triple| format!(r#"{{"from": "{from}", "label": "{label}", "to": "{to}"}}"#);
    format!("[{}]", edges.iter().map(text).collect::<Vec<_>>().join(","))
}

const FLAT: [Triple; 3] = [("root", "RT", "x"), ("root", "RT", "y"), ("root", "RT", "z")];

/// `[spec: CONF-7.1]`
#[test]
fn law_sound_views_break_nothing() {
    let sound: [(&[Triple], &str); 4] = [
        (&FLAT, "[]"),
        (
            &[("root", "RT", "x"), ("x", "RT", "y"), ("z", "near", "y"), ("z", "in", "x"), ("y", "in", "x")],
            "[]",
        ),
        (&[("x", "RT", "y"), ("y", "RT", "z")], r#"["x"]"#),
        (&[("x", "near", "y"), ("z", "near", "root")], r#"["y"]"#),
    ];
    let dictionary = Dictionary::open().with_functional("in");
    for (shown, hung) in sound {
        let view = view(&edges(shown), hung);
        assert_eq!(broken(&view, None), None, "{shown:?}");
        assert_eq!(broken(&view, Some(&dictionary)), None, "{shown:?}");
    }
}

/// `[spec: CONF-7.1]`
#[test]
fn canary_each_way_to_break_an_invariant_is_told_by_its_clause() {
    let extra: [(&str, &[Triple], &str); 12] = [
        ("INV-1", &[], "[]"),
        ("INV-2", &[("x", "near", "w")], "[]"),
        ("INV-2", &[("w", "near", "x")], "[]"),
        ("INV-2", &[], r#"["w"]"#),
        ("INV-3", &[("x", "RT", "y")], "[]"),
        ("INV-3", &[("x", "RT", "root")], "[]"),
        ("INV-3", &[], r#"["x"]"#),
        ("INV-4", &[("x", "near", "x")], "[]"),
        ("INV-6", &[("x", "near", "y"), ("x", "near", "y")], "[]"),
        ("INV-6", &[("root", "RT", "x")], "[]"),
        ("INV-6", &[("x", "in", "y"), ("x", "in", "z")], "[]"),
        ("INV-4", &[("root", "near", "root")], "[]"),
    ];
    let dictionary = Dictionary::open().with_functional("in");
    for (clause, shown, hung) in extra {
        let kept = if clause == "INV-1" { 2 } else { 3 };
        let all = [&FLAT[..kept], shown].concat();
        let found = broken(&view(&edges(&all), hung), Some(&dictionary)).unwrap();
        assert_eq!(found.clause(), clause, "{all:?}: {found}");
    }
    let cycle = [("root", "RT", "z"), ("x", "RT", "y"), ("y", "RT", "x"), ("x", "near", "z")];
    assert_eq!(broken(&view(&edges(&cycle), "[]"), None).unwrap().clause(), "INV-3");
}

/// `[spec: CONF-7.1]`
#[test]
fn canary_an_attribute_that_is_not_allowed_is_told() {
    let declared = |attribute: &str| -> Dictionary {
        read_strictly(&format!(
            r#"{{"closed": true, "vertex_types": ["t"], "edge_labels": ["RT"], "attributes": {attribute}}}"#
        ))
        .unwrap()
    };
    let view = view(&edges(&FLAT), "[]");
    assert_eq!(broken(&view, Some(&declared(r#"{"a": "int"}"#))), None);
    for wrong in [r#"{"a": "uint"}"#, "{}"] {
        assert_eq!(broken(&view, Some(&declared(wrong))).unwrap().clause(), "INV-5");
    }
}
