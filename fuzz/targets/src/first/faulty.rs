//! Texts with faults: what each reader must refuse, or drop. A fuzzer would find few of them from nothing.

use dsr_model::trace::Trace;
use serde_json::{Value, json};

/// A scene of a root 1 `world` with these links, and further symbols.
fn scene(links: &[&str], symbols: &[String]) -> String {
    let root = symbol(1, "world", "world", "", links);
    let all: Vec<String> = std::iter::once(root).chain(symbols.iter().cloned()).collect();
    format!(r#"{{"DSRModel":{{"symbols":{{{}}}}}}}"#, all.join(","))
}

fn symbol(id: u64, name: &str, vertex_type: &str, attributes: &str, links: &[&str]) -> String {
    let link = |link: &&str| {
        let (label, to) = link.split_once(' ').unwrap_or((link, "1"));
        format!(r#"{{"src":"{id}","dst":"{to}","label":"{label}"}}"#)
    };
    let links: Vec<String> = links.iter().map(link).collect();
    format!(
        r#""{id}":{{"id":"{id}","name":"{name}","type":"{vertex_type}","attribute":{{{attributes}}},"links":[{}]}}"#,
        links.join(",")
    )
}

fn thing(id: u64, links: &[&str]) -> String {
    symbol(id, &format!("v{id}"), "room", "", links)
}

/// Scenes, each with a fault of another kind.
pub(super) fn scenes() -> Vec<String> {
    let with = |attributes: &str| scene(&["RT 2"], &[symbol(2, "v", "room", attributes, &[])]);
    let long = "x".repeat(256);
    let whole = scene(&["RT 2"], &[thing(2, &[])]);
    vec![
        scene(&["has 7"], &[]),
        scene(&["RT 2"], &[thing(2, &["near 2"])]),
        scene(&["RT 2"], &[thing(2, &["RT 1"])]),
        scene(&["RT 2", "RT 2"], &[thing(2, &[])]),
        scene(&["RT 2", "RT 3"], &[thing(2, &["RT 3"]), thing(3, &[])]),
        scene(&[], &[thing(2, &["RT 3", "in 1"]), thing(3, &["RT 2"])]),
        scene(&[], &[thing(2, &["RT 3", "in 1"]), thing(3, &["in 1"])]),
        scene(&["RT 2"], &[thing(2, &[]), thing(3, &[])]),
        scene(&["RT 2"], &[thing(2, &["in 1", "in 3"]), thing(3, &["RT 2"])]),
        scene(&["RT 2", "RT 3"], &[thing(2, &["in 1", "in 3"]), thing(3, &[])]),
        scene(&["RT 2"], &[symbol(2, "root", "room", "", &[])]),
        scene(&["RT 2"], &[thing(2, &[]), symbol(2, "w", "room", "", &[])]),
        scene(&["RT 2", "RT 3"], &[symbol(2, "v", "room", "", &[]), symbol(3, "v", "room", "", &[])]),
        scene(&["RT 2"], &[symbol(2, &long, "room", "", &[])]),
        scene(&["flies 2"], &[thing(2, &[])]),
        with(r#""level":{"type":0,"value":"x"}"#),
        with(r#""level":{"type":1,"value":99999999999}"#),
        with(r#""color":{"type":14,"value":1}"#),
        with(r#""color":{"type":11,"value":[1]}"#),
        with(r#""color":{"type":0,"value":"x"},"color":{"type":0,"value":"x"}"#),
        with(r#""unheard_of":{"type":0,"value":"x"}"#),
        whole.replace(r#""2":"#, r#""02":"#),
        whole.replace(r#""src":"1""#, r#""src":"9""#),
        whole.replace(r#""id":"2""#, r#""id":"x""#),
        whole.replace(r#""name":"v2","#, ""),
        whole.replace(r#"{"DSRModel""#, r#"{"more":1,"DSRModel""#),
        whole.replace(r#""v2""#, "5"),
        format!("\u{feff}{whole}"),
        format!("{whole} x"),
        r#"{"DSRModel":{"symbols":[]}}"#.into(),
        r#"{"DSRModel":{"symbols":{}}}"#.into(),
        " ".into(),
        "[".repeat(40),
    ]
}

/// States, digests, records and repairs that are refused.
pub(super) fn states() -> Vec<String> {
    let vertex = r#"{"vertex":{"type":"t","name":"a","stamp":1}}"#;
    let with_context = |context: &str| format!(r#"{{"context":{context},"store":{{}}}}"#);
    vec![
        format!(r#"{{"context":{{"r1":"1"}},"store":{{"r1.1":{vertex},"r1.1":{vertex}}}}}"#),
        vertex.replace(r#""a""#, r#""""#),
        format!(r#"{{"context":{{"r1":"1"}},"store":{{"r1.1":{}}}}}"#, vertex.replace(r#""a""#, r#""""#)),
        with_context(r#"{"r1":"1,2"}"#),
        with_context(r#"{"r1":"1","r1":"2"}"#),
        with_context(r#"{"r1":"1-9007199254740992"}"#),
        r#"{"context":{"r1":"1-2"},"live":{"r1":"2-3"}}"#.into(),
        r#"{"context":{"r1":"1-90000000"},"live":{"r1":"1-90000000"}}"#.into(),
        r#"{"context":{"r1":"1,2"},"live":{}}"#.into(),
    ]
}

/// Mutations and values that are refused.
pub(super) fn mutations() -> Vec<String> {
    [
        r#"{"remove_vertex":{"vertex":"r1.1"},"remove_vertex":{"vertex":"r1.1"}}"#,
        r#"{"add_edge":{"from":"root","label":"in","to":"r1.1","attributes":{"a":{"type":"int","value":1},"a":{"type":"int","value":1}}}}"#,
        r#"{"type":"vec2","value":[1]}"#,
        r#"{"type":"int","value":2147483648}"#,
        r#"{"type":"float","value":"nan"}"#,
        r#"{"type":"byte_vec","value":"!"}"#,
        r#"{"replica":"r0+0"}"#,
    ]
    .map(String::from)
    .into()
}

/// Dictionaries that cannot be meant.
pub(super) fn dictionaries() -> Vec<String> {
    [
        r#"{"attributes":{"level":"int","level":"int"}}"#,
        r#"{"vertex_types":["a","a"]}"#,
        r#"{"attribute":{}}"#,
        r#"{"attributes":{"level":"integer"}}"#,
        r#"{"functional_labels":["RT"]}"#,
        r#"{"closed":true,"functional_labels":["in"]}"#,
        r#"{"edge_labels":[""]}"#,
    ]
    .map(String::from)
    .into()
}

/// A trace, spoiled in each way.
pub(super) fn traces(sound: &Trace) -> Vec<String> {
    let Ok(sound) = serde_json::to_value(sound) else { return Vec::new() };
    let spoil = |change: &dyn Fn(&mut Value)| {
        let mut spoiled = sound.clone();
        change(&mut spoiled);
        spoiled.to_string()
    };
    let twice = |list: &mut Value| {
        if let Some(list) = list.as_array_mut() {
            list.extend(list.first().cloned());
        }
    };
    let without_first = |list: &mut Value| {
        if let Some(list) = list.as_array_mut() {
            list.drain(..1.min(list.len()));
        }
    };
    vec![
        spoil(&|trace| trace["version"] = json!(3)),
        spoil(&|trace| trace["format"] = json!("x")),
        spoil(&|trace| trace["replicas"] = json!([])),
        spoil(&|trace| twice(&mut trace["replicas"])),
        spoil(&|trace| twice(&mut trace["steps"])),
        spoil(&|trace| without_first(&mut trace["steps"])),
        spoil(&|trace| trace["finding"]["replicas"] = json!(["x"])),
        spoil(&|trace| trace["finding"]["kind"] = json!("broken")),
        spoil(&|trace| trace["semantics"] = json!("x")),
        spoil(&|trace| trace["semantics"] = json!("published")),
        spoil(&|trace| trace["setup"] = json!({ "row": "3" })),
        spoil(&|trace| trace["steps"][0]["state"] = json!("0")),
        spoil(&|trace| trace["steps"][0]["replica"] = json!("x")),
        spoil(&|trace| trace["steps"][2]["does"] = json!({ "deliver": { "message": "m9" } })),
        spoil(&|trace| trace["steps"][0]["does"]["mutate"]["mutations"] = json!([1])),
        spoil(&|trace| trace["replicas"][0]["index"] = json!(7)),
    ]
}

/// Lines that are no requests, or ask for what is not there.
pub(super) fn protocol() -> Vec<String> {
    let begin = r#"{"id":1,"do":{"case_begin":{"case":"c","replicas":["a","b"]}}}"#;
    let after = |line: &str| format!("{begin}\n{line}\n");
    vec![
        after(r#"{"id":2,"do":{"read":{"replica":"z"}}}"#),
        after(r#"{"id":2,"do":{"deliver":{"replica":"a","delta":"d9"}}}"#),
        after(r#"{"id":2,"do":{"fly":{}}}"#),
        after(r#"{"id":2,"do":{"read":["a"]}}"#),
        after(r#"{"id":2,"do":{"decode":{"bytes":"0200"}}}"#),
        after(r#"{"id":2,"do":{"load":{"state":{}}}}"#),
        r#"{"id":1,"do":{"hello":{"protocols":[7],"spec":"","corpus":""}}}"#.into(),
        r#"{"id":1,"do":{"case_begin":{"case":"c","replicas":["a","a"]}}}"#.into(),
        r#"{"id":1,"skip":{"reason":"not now"}}"#.into(),
        "x".into(),
    ]
}
