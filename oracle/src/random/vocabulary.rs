//! Few names, labels and values, so that everything collides; and now and then what is out of bounds.

use dsr_core::{Dictionary, Name, RT, Value, ValueType, limits};
use dsr_model::walks::Dice;

/// One in so many names is a hostile one.
const HOSTILE: usize = 24;

/// Whether something of this chance occurs.
pub(super) fn once_in(dice: &mut Dice, count: usize) -> bool {
    dice.below(count) == 0
}

pub(super) fn pick<'t, T>(dice: &mut Dice, of: &'t [T]) -> Option<&'t T> {
    of.get(dice.below(of.len()))
}

fn word(dice: &mut Dice, of: &[&str]) -> Name {
    pick(dice, of).copied().unwrap_or("a").into()
}

fn too_long(dice: &mut Dice) -> Name {
    let bytes = limits::NAME_BYTES_MAX + dice.below(3) - 1;
    "é".repeat(bytes / 2).chars().chain("x".repeat(bytes % 2).chars()).collect::<String>().into()
}

/// The name of a vertex.
pub(super) fn name(dice: &mut Dice) -> Name {
    match dice.below(HOSTILE) {
        0 => word(dice, &["root", "world", "", "Root", "w\"\\\u{7}"]),
        1 if once_in(dice, 4) => too_long(dice),
        _ => word(dice, &["a", "b", "c", "d", "e"]),
    }
}

/// The name of a vertex in a record from outside: never of a wrong length.
pub(super) fn name_outside(dice: &mut Dice) -> Name {
    match dice.below(6) {
        0 => word(dice, &["root", "world"]),
        _ => word(dice, &["a", "b", "c"]),
    }
}

/// The type of a vertex.
pub(super) fn vertex_type(dice: &mut Dice) -> Name {
    match dice.below(HOSTILE) {
        0 => word(dice, &["odd", "odd", ""]),
        1 if once_in(dice, 4) => too_long(dice),
        _ => word(dice, &["t", "u"]),
    }
}

/// The label of an edge.
pub(super) fn label(dice: &mut Dice) -> Name {
    match dice.below(HOSTILE) {
        0 => word(dice, &["odd", "odd", ""]),
        1 if once_in(dice, 4) => too_long(dice),
        _ => word(dice, &[RT, RT, RT, "in", "in", "near"]),
    }
}

/// The label of an edge in a record from outside.
pub(super) fn label_outside(dice: &mut Dice) -> Name {
    word(dice, &[RT, RT, RT, "in", "in", "near", "odd"])
}

/// The name of an attribute.
pub(super) fn attribute(dice: &mut Dice) -> Name {
    match dice.below(HOSTILE) {
        0 if once_in(dice, 3) => "".into(),
        1 if once_in(dice, 3) => too_long(dice),
        2 | 3 => "odd".into(),
        _ => word(dice, &["x", "x", "y"]),
    }
}

/// An attribute's name and a value, more often than not one that the closed dictionary allows.
pub(super) fn attribute_and_value(dice: &mut Dice) -> (Name, Value) {
    let name = attribute(dice);
    let value = match &*name {
        "x" if !once_in(dice, 4) => Value::Int(i32::try_from(dice.below(3)).unwrap_or(0)),
        "y" if !once_in(dice, 4) => value_of(dice, ValueType::Double),
        _ => value(dice),
    };
    (name, value)
}

/// Any value, of all fourteen types.
pub(super) fn value(dice: &mut Dice) -> Value {
    let value_type = pick(dice, &ValueType::ALL).copied().unwrap_or(ValueType::Bool);
    value_of(dice, value_type)
}

fn value_of(dice: &mut Dice, value_type: ValueType) -> Value {
    let value: Value = match value_type {
        ValueType::String => word(dice, &["", "a", "\u{1f916}", "\u{0}\"\\ \n"]).to_string().into(),
        ValueType::Int => Value::Int(pick(dice, &[0, 1, -1, i32::MIN, i32::MAX]).copied().unwrap_or(0)),
        ValueType::Float => Value::Float(float(dice)),
        ValueType::FloatVec => (0..dice.below(4)).map(|_| float(dice)).collect::<Vec<f32>>().into(),
        ValueType::Bool => Value::Bool(once_in(dice, 2)),
        ValueType::ByteVec => (0..dice.below(4))
            .map(|_| u8::try_from(255 * dice.below(2)).unwrap_or(0))
            .collect::<Vec<u8>>()
            .into(),
        ValueType::UInt => Value::UInt(pick(dice, &[0, 1, u32::MAX]).copied().unwrap_or(0)),
        ValueType::UInt64 => Value::UInt64(wide(dice)),
        ValueType::Double => Value::Double(double(dice)),
        ValueType::U64Vec => (0..dice.below(4)).map(|_| wide(dice)).collect::<Vec<u64>>().into(),
        ValueType::Vec2 => Value::Vec2([(); 2].map(|()| float(dice))),
        ValueType::Vec3 => Value::Vec3([(); 3].map(|()| float(dice))),
        ValueType::Vec4 => Value::Vec4([(); 4].map(|()| float(dice))),
        ValueType::Vec6 => Value::Vec6([(); 6].map(|()| float(dice))),
    };
    value.with_canonical_nans()
}

fn wide(dice: &mut Dice) -> u64 {
    pick(dice, &[0, 1, u64::MAX, 1 << 53]).copied().unwrap_or(0)
}

fn float(dice: &mut Dice) -> f32 {
    let all =
        [0.0, -0.0, 1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MIN_POSITIVE, 1e-45, f32::MAX, 0.1];
    pick(dice, &all).copied().unwrap_or(0.0)
}

fn double(dice: &mut Dice) -> f64 {
    let all = [0.0, -0.0, 1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5e-324, f64::MAX, 0.1, 1e23];
    pick(dice, &all).copied().unwrap_or(0.0)
}

/// A number of nanoseconds.
pub(super) fn time(dice: &mut Dice) -> u64 {
    pick(dice, &[0, 0, 17, u64::MAX]).copied().unwrap_or(0)
}

/// Dictionaries that say different things of the same names.
pub(super) fn dictionary(dice: &mut Dice) -> Dictionary {
    let mut dictionary = match dice.below(4) {
        0 => return Dictionary::open(),
        1 => Dictionary::open().with_functional("in"),
        2 => {
            let mut open = Dictionary::open().with_functional("near");
            open.attributes.insert("x".into(), ValueType::Float);
            return open;
        }
        _ => Dictionary { closed: true, ..Dictionary::open().with_functional("in") },
    };
    if dictionary.closed {
        dictionary.vertex_types.extend(["t".into(), "u".into()]);
        dictionary.edge_labels.insert("near".into());
    }
    dictionary.attributes.insert("x".into(), ValueType::Int);
    dictionary.attributes.insert("y".into(), ValueType::Double);
    dictionary
}
