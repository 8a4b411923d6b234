//! Values and the dictionary.

use crate::clauses_common::*;
use dsr_core::{
    AddVertexError, Dictionary, NewEdgeError, RT, Record, UpdateAttributesError, Value, ValueType,
};
use std::sync::Arc;

fn one_of_each() -> [Value; 14] {
    [
        Value::from("é"),
        Value::Int(-1),
        Value::Float(1.5),
        Value::from(vec![1.5_f32, 2.5]),
        Value::Bool(true),
        Value::from(vec![1_u8, 2, 3]),
        Value::UInt(1),
        Value::UInt64(1),
        Value::Double(1.5),
        Value::from(vec![1_u64]),
        Value::Vec2([1.0; 2]),
        Value::Vec3([1.0; 3]),
        Value::Vec4([1.0; 4]),
        Value::Vec6([1.0; 6]),
    ]
}

/// [spec: VALUE-1]
#[test]
fn law_types_have_published_numbers_names_and_sizes() {
    let names = [
        "string",
        "int",
        "float",
        "float_vec",
        "bool",
        "byte_vec",
        "uint",
        "uint64",
        "double",
        "u64_vec",
        "vec2",
        "vec3",
        "vec4",
        "vec6",
    ];
    let bytes = [2, 4, 4, 8, 1, 3, 4, 8, 8, 8, 8, 12, 16, 24];
    for (number, value) in one_of_each().into_iter().enumerate() {
        assert_eq!(usize::from(value.value_type().number()), number);
        assert_eq!(value.value_type().name(), names[number]);
        assert_eq!(value.payload_bytes(), bytes[number]);
    }
}

/// [spec: VALUE-2]
#[test]
fn law_payloads_are_shared_from_mutation_to_join() {
    let image: Arc<[u8]> = vec![7; 1000].into();
    let mut peer = Peer::new(1);
    let delta = peer.apply(&set(of(ROOT), "image", image.clone()));
    let mut there = delta.clone();
    there.join(&peer.state);
    for state in [&delta, &peer.state, &there, &there.clone()] {
        let (_, Record::Write(write)) = state.records().next().unwrap() else { panic!() };
        let Value::ByteVec(bytes) = &write.value else { panic!() };
        assert!(Arc::ptr_eq(bytes, &image));
    }
}

/// [spec: VALUE-3]
#[test]
fn law_values_are_ordered_by_type_then_bits() {
    let each = one_of_each();
    assert!(each.is_sorted_by(|l, r| l < r), "by type number");
    let ascending = [
        vec![Value::from(""), Value::from("a"), Value::from("ab"), Value::from("b")],
        vec![Value::Int(i32::MIN), Value::Int(-1), Value::Int(0)],
        vec![Value::Bool(false), Value::Bool(true)],
        vec![
            Value::Float(f32::NEG_INFINITY),
            Value::Float(-0.0),
            Value::Float(0.0),
            Value::Float(1.0),
            Value::Float(f32::from_bits(0x7fc0_0000)),
        ],
        vec![Value::from(vec![1.0_f32]), Value::from(vec![1.0_f32, 0.0]), Value::from(vec![2.0_f32])],
    ];
    for values in ascending {
        assert!(values.is_sorted_by(|l, r| l < r), "{values:?}");
    }
    assert_eq!(Value::Double(f64::NAN), Value::Double(f64::NAN));
}

/// [spec: VALUE-4]
#[test]
fn law_mutations_store_the_canonical_nan() {
    let odd = f32::from_bits(0xffc0_0001);
    let mut peer = Peer::new(1);
    peer.apply(&set(of(ROOT), "a", Value::Vec2([odd, 1.0])));
    peer.apply(&set(of(ROOT), "b", -f64::NAN));
    let Some(Value::Vec2([stored, _])) = peer.value(ROOT, "a") else { panic!() };
    assert_eq!(stored.to_bits(), 0x7fc0_0000);
    let Some(Value::Double(stored)) = peer.value(ROOT, "b") else { panic!() };
    assert_eq!(stored.to_bits(), 0x7ff8_0000_0000_0000);
}

/// [spec: DICT-1] [spec: DICT-4]
#[test]
fn law_states_do_not_depend_on_the_dictionary_and_views_do() {
    let flat = flat();
    let rooms = |room| relocate(key(flat.robot, "in", flat.kitchen), key(flat.robot, "in", room));
    let mut strict = concurrent(&flat.base, &rooms(flat.hall), &rooms(flat.pole));
    let mut lax = strict.clone();
    lax.dictionary = Dictionary::open();
    assert_eq!(strict.state, lax.state);
    assert_eq!((strict.repairs(), lax.repairs()), (vec!["functional"], vec![]));
    // Closed, and declaring nothing: vertices, edges and their labels are all shown still.
    let shown = strict.view().edges().len();
    strict.dictionary.closed = true;
    assert_eq!(strict.view().edges().len(), shown);
    assert_eq!(strict.view().vertices(), lax.view().vertices());
}

/// [spec: DICT-2]
#[test]
fn oracle_a_closed_dictionary_accepts_what_it_lists() {
    let mut peer = Peer::new(1);
    peer.dictionary = Dictionary {
        closed: true,
        vertex_types: ["thing".into()].into(),
        edge_labels: ["near".into()].into(),
        attributes: [("light".into(), ValueType::Int)].into(),
        ..Dictionary::default()
    };
    let hall = peer.child(ROOT, "hall");
    peer.edge(hall, "near", ROOT);
    peer.apply(&set(of(hall), "light", 1_i32));
    let refused = peer.attempt(&edge(hall, "sees", ROOT)).unwrap_err();
    let undeclared = NewEdgeError::UndeclaredLabel { label: "sees".into() };
    assert_eq!(refused, dsr_core::AddEdgeError::from(undeclared).into());
    assert!(matches!(
        peer.attempt(&set(of(hall), "heat", 1_i32)).unwrap_err(),
        dsr_core::MutationError::UpdateAttributes(UpdateAttributesError::Attribute(_))
    ));
    peer.dictionary.vertex_types.clear();
    let refused = peer.attempt(&child(hall, "lamp")).unwrap_err();
    assert_eq!(refused, AddVertexError::UndeclaredType { vertex_type: "thing".into() }.into());
}

/// [spec: DICT-3]
#[test]
fn law_rt_is_never_functional() {
    let mut dictionary = Dictionary::open().with_functional(RT).with_functional("in");
    assert!(!dictionary.is_functional(RT) && dictionary.is_functional("in"));
    dictionary.functional_labels.insert(RT.into());
    assert!(!dictionary.is_functional(RT));
    let mut peer = Peer::new(1);
    peer.dictionary = dictionary;
    peer.child(ROOT, "kitchen");
    peer.child(ROOT, "hall");
    assert_eq!(peer.repairs(), [""; 0]);
}
