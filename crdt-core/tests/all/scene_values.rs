//! Every type of value, on vertices and on edges, there and back.

use crate::scene_support::{check_lossless, fault_lines, with_attributes};
use dsr_core::scene::{Scene, Strictness};
use dsr_core::{
    Author, Dictionary, NewVertex, ReplicaId, State, Value, ValueType, VertexId, VertexLink, add_vertex, view,
};
use proptest::prelude::*;
use std::collections::BTreeMap;

fn any_f32() -> impl Strategy<Value = f32> {
    prop_oneof![
        3 => any::<u32>().prop_map(f32::from_bits),
        1 => prop_oneof![Just(0.0), Just(-0.0), Just(f32::MAX), Just(f32::MIN_POSITIVE), Just(1e-45), Just(16_777_216.0)],
    ]
}

fn any_value() -> impl Strategy<Value = Value> {
    prop_oneof![
        any::<String>().prop_map(Value::from),
        any::<i32>().prop_map(Value::from),
        any_f32().prop_map(Value::from),
        prop::collection::vec(any_f32(), 0..5).prop_map(Value::from),
        any::<bool>().prop_map(Value::from),
        prop::collection::vec(any::<u8>(), 0..9).prop_map(Value::from),
        any::<u32>().prop_map(Value::from),
        any::<u64>().prop_map(Value::from),
        any::<u64>().prop_map(|bits| Value::from(f64::from_bits(bits))),
        prop::collection::vec(any::<u64>(), 0..5).prop_map(Value::from),
        prop::array::uniform2(any_f32()).prop_map(Value::from),
        prop::array::uniform3(any_f32()).prop_map(Value::from),
        prop::array::uniform4(any_f32()).prop_map(Value::from),
        prop::array::uniform6(any_f32()).prop_map(Value::from),
    ]
}

/// A state of one vertex with these attributes on it and, again, on its edge.
fn state_of(values: &BTreeMap<String, Value>) -> State {
    let attributes: dsr_core::AttributeMap =
        values.iter().map(|(name, value)| (name.as_str().into(), value.clone())).collect();
    let mut state = State::new();
    let vertex = NewVertex { attributes: attributes.clone(), ..NewVertex::new("thing", "hub") };
    let link = VertexLink { attributes, ..VertexLink::child_of(VertexId::ROOT) };
    let author = Author { replica: ReplicaId::agent(1), timestamp_ns: u64::MAX };
    let delta = add_vertex(&view(&state, &Dictionary::open()), author, &vertex, &link).unwrap();
    state.join(&delta);
    state
}

/// The attributes of `hub` and of the edge to it: values and times.
fn attributes_of(state: &State) -> [BTreeMap<String, (Value, u64)>; 2] {
    let dictionary = Dictionary::open();
    let graph = view(state, &dictionary);
    let hub = graph.vertex_by_name("hub").unwrap();
    let edge = graph.edge(VertexId::ROOT, "RT", hub).unwrap().id;
    [hub.0, edge.0].map(|target| {
        let winners = graph.attributes_of(target);
        winners
            .map(|(_, write)| (write.name.to_string(), (write.value.clone(), write.timestamp_ns)))
            .collect()
    })
}

proptest! {
    /// [spec: SCENE-8] [spec: SCENE-9] [spec: SCENE-10] [spec: SCENE-11]
    #[test]
    fn law_any_value_on_vertex_and_edge_re_reads_to_the_same_bits(
        values in prop::collection::btree_map("[^\u{0}]{1,20}", any_value(), 0..8)
    ) {
        let state = state_of(&values);
        let before = attributes_of(&state);
        let written = Scene::of(state).written(&Dictionary::open());
        prop_assert_eq!(&written.notes, &[]);
        let scene = check_lossless(&written.text, &Dictionary::open());
        prop_assert_eq!(attributes_of(&scene.state), before);
        // Whatever is written is JSON to others as well.
        let other: serde_json::Value = serde_json::from_str(&written.text).unwrap();
        prop_assert_eq!(other["DSRModel"]["symbols"]["2"]["attribute"].as_object().unwrap().len(), values.len());
    }
}

/// [spec: SCENE-8]
#[test]
fn law_all_fourteen_types_have_one_written_form() {
    let samples: [(Value, &str); 14] = [
        ("a \"b\" \\ \n \u{1} é".into(), r#""a \"b\" \\ \n \u0001 é""#),
        (i32::MIN.into(), "-2147483648"),
        (0.1_f32.into(), "0.1"),
        (vec![1.0_f32, -0.0, f32::NAN, f32::NEG_INFINITY].into(), r#"[1.0, -0.0, "NaN", "-Infinity"]"#),
        (true.into(), "true"),
        (vec![0_u8, 255].into(), "[0, 255]"),
        (u32::MAX.into(), "4294967295"),
        (u64::MAX.into(), r#""18446744073709551615""#),
        (1e300_f64.into(), "1e300"),
        (vec![0_u64, u64::MAX].into(), r#"["0", "18446744073709551615"]"#),
        ([1.0_f32, 2.5].into(), "[1.0, 2.5]"),
        ([1.0_f32, 2.0, 3.0].into(), "[1.0, 2.0, 3.0]"),
        ([1.0_f32, 2.0, 3.0, 1e-45].into(), "[1.0, 2.0, 3.0, 1e-45]"),
        ([0.0_f32; 6].into(), "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]"),
    ];
    for (number, (value, form)) in samples.into_iter().enumerate() {
        assert_eq!(usize::from(value.value_type().number()), number);
        let text = Scene::of(state_of(&BTreeMap::from([("a".to_owned(), value)]))).write(&Dictionary::open());
        let attribute = format!("\"type\": {number},\n");
        assert_eq!(text.matches(&attribute).count(), 2, "on the vertex and on the edge:\n{text}");
        assert_eq!(text.matches(&format!("\"value\": {form}\n")).count(), 2, "{form}:\n{text}");
    }
}

#[track_caller]
fn read_value(number: u8, value: &str) -> Value {
    let text = with_attributes(&format!("\"a\": {{\"type\": {number}, \"value\": {value}}}"));
    let state = Scene::read(&text, &Dictionary::open(), Strictness::Strict).unwrap().scene.state;
    attributes_of(&state)[0]["a"].0.clone()
}

/// [spec: SCENE-9] [spec: SCENE-10]
#[test]
fn law_other_spellings_of_numbers_are_read() {
    let vec3: Value = [1.0_f32, -2.0, f32::INFINITY].into();
    assert_eq!(read_value(2, "5"), Value::Float(5.0));
    assert_eq!(read_value(8, "-5"), Value::Double(-5.0));
    assert_eq!(read_value(2, "\"1,5\""), Value::Float(1.5));
    assert_eq!(read_value(2, "\"1.5e1\""), Value::Float(15.0));
    assert_eq!(read_value(8, "\"nan\"").to_string(), "NaN");
    assert_eq!(read_value(8, "1e-400"), Value::Double(0.0));
    assert_eq!(read_value(11, "[1, \"-2,0\", \"inf\"]"), vec3);
    assert_eq!(read_value(7, "18446744073709551615"), Value::UInt64(u64::MAX));
    assert_eq!(read_value(7, "\"9007199254740993\""), Value::UInt64(9_007_199_254_740_993));
    assert_eq!(read_value(9, "[18446744073709551615, \"1\"]"), vec![u64::MAX, 1].into());
    // Nearest, not by way of a 64-bit float: this decimal lies just above a midpoint of two 32-bit floats.
    assert_eq!(read_value(2, "1.00000017881393432617187500001"), Value::Float(1.000_000_2));
}

/// [spec: SCENE-8] [spec: SCENE-9] [spec: SCENE-10]
#[test]
fn regress_numbers_out_of_range_are_refused_not_wrapped() {
    let cases: [(u8, &str, &str); 24] = [
        (0, "5", "the value must be text, but it is a number"),
        (1, "2147483648", "2147483648 is outside what a 32-bit integer can hold"),
        (1, "1.0", "the value must be a 32-bit integer, but it is a number"),
        (1, "1e400", "the value must be a 32-bit integer, but it is a number"),
        (2, "1e39", "1e39 is outside what a 32-bit float can hold"),
        (2, "true", "the value must be a 32-bit float, but it is true or false"),
        (
            2,
            "\"five\"",
            "the value must be a number, or \"NaN\", \"Infinity\", \"-Infinity\", but it is text",
        ),
        (2, "\"\"", "the value must be a 32-bit float, but it is text"),
        (3, "[1, 2e99]", "item 1: 2e99 is outside what a 32-bit float can hold"),
        (3, "{}", "the value must be a list, but it is an object"),
        (4, "1", "the value must be true or false, but it is a number"),
        (5, "[0, 256]", "item 1: 256 is outside what a byte (0 to 255) can hold"),
        (5, "[-1]", "item 0: -1 is outside what a byte (0 to 255) can hold"),
        (6, "-1", "-1 is outside what an unsigned 32-bit integer can hold"),
        (6, "4294967296", "4294967296 is outside what an unsigned 32-bit integer can hold"),
        (
            7,
            "18446744073709551616",
            "18446744073709551616 is outside what an unsigned 64-bit integer can hold",
        ),
        (7, "\"+1\"", "the value must be an unsigned 64-bit integer, in digits alone, but it is text"),
        (7, "null", "the value must be an unsigned 64-bit integer, but it is null"),
        (8, "1e400", "1e400 is outside what a 64-bit float can hold"),
        (
            9,
            "[\"01\"]",
            "item 0: the value must be an unsigned 64-bit integer, in digits alone, but it is text",
        ),
        (10, "[1]", "a vec2 has 2 items, but here are 1"),
        (13, "[]", "a vec6 has 6 items, but here are 0"),
        (14, "0", "\"14\" is no attribute type: types are the numbers 0 to 13"),
        (255, "0", "\"255\" is no attribute type: types are the numbers 0 to 13"),
    ];
    for (number, value, expected) in cases {
        let text = with_attributes(&format!("\"a\": {{\"type\": {number}, \"value\": {value}}}"));
        let lines = fault_lines(&text);
        assert_eq!(lines.len(), 1, "{lines:?}");
        let tail = lines[0].split_once("attribute \"a\"").unwrap().1;
        let told = tail.trim_start_matches([',', ':', ' ']);
        assert_eq!(told, expected);
    }
    assert_eq!(ValueType::ALL.len(), 14);
}
