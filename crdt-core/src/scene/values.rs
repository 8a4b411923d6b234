//! Attribute values of all fourteen types, from and to JSON. `[spec: SCENE-8]` to `[spec: SCENE-11]`

use super::fault::FaultKind;
use super::syntax::{Form, Node};
use crate::value::{Value, ValueType};
use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt::Write as _;
use core::fmt::{Debug, Display};
use core::str::FromStr;

/// A value that cannot be read: where, in which item of a list, and why.
pub(super) struct Unreadable {
    pub(super) at: usize,
    pub(super) item: Option<usize>,
    pub(super) kind: FaultKind,
}

type Read<T> = Result<T, Box<Unreadable>>;

impl Unreadable {
    fn at<T>(node: &Node<'_>, kind: FaultKind) -> Read<T> {
        Err(Box::new(Self { at: node.at, item: None, kind }))
    }
}

/// The value of this type that stands at `node`. `[spec: SCENE-8]`
pub(super) fn read(value_type: ValueType, node: &Node<'_>) -> Read<Value> {
    let value = match value_type {
        ValueType::String => match &node.form {
            Form::Text(text) => Value::String(Arc::from(&**text)),
            _ => return wrong_form(node, "text"),
        },
        ValueType::Bool => match node.form {
            Form::Bool(item) => Value::Bool(item),
            _ => return wrong_form(node, "true or false"),
        },
        ValueType::Int => Value::Int(integer(node, "a 32-bit integer")?),
        ValueType::UInt => Value::UInt(integer(node, "an unsigned 32-bit integer")?),
        ValueType::UInt64 => Value::UInt64(unsigned_64(node)?),
        ValueType::Float => Value::Float(float(node, "a 32-bit float")?),
        ValueType::Double => Value::Double(float(node, "a 64-bit float")?),
        ValueType::FloatVec => Value::FloatVec(floats(node)?.into()),
        ValueType::ByteVec => {
            Value::ByteVec(items(node, |item| integer::<u8>(item, "a byte (0 to 255)"))?.into())
        }
        ValueType::U64Vec => Value::U64Vec(items(node, unsigned_64)?.into()),
        ValueType::Vec2 => Value::Vec2(fixed(value_type, node)?),
        ValueType::Vec3 => Value::Vec3(fixed(value_type, node)?),
        ValueType::Vec4 => Value::Vec4(fixed(value_type, node)?),
        ValueType::Vec6 => Value::Vec6(fixed(value_type, node)?),
    };
    Ok(value.with_canonical_nans())
}

fn wrong_form<T>(node: &Node<'_>, expected: &'static str) -> Read<T> {
    Unreadable::at(node, FaultKind::WrongForm { what: "the value", expected, found: node.describe() })
}

fn out_of_range<T>(node: &Node<'_>, text: &str, expected: &'static str) -> Read<T> {
    Unreadable::at(node, FaultKind::OutOfRange { text: text.to_string(), expected })
}

fn is_whole(text: &str) -> bool {
    let digits = text.strip_prefix('-').unwrap_or(text);
    !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
}

fn integer<T: FromStr>(node: &Node<'_>, expected: &'static str) -> Read<T> {
    match node.form {
        Form::Number(text) if is_whole(text) => {
            text.parse().or_else(|_: T::Err| out_of_range(node, text, expected))
        }
        _ => wrong_form(node, expected),
    }
}

/// A number, or its digits as text: JSON numbers of many programs lose bits above 2⁵³. `[spec: SCENE-10]`
pub(super) fn unsigned_64(node: &Node<'_>) -> Read<u64> {
    const EXPECTED: &str = "an unsigned 64-bit integer";
    match &node.form {
        Form::Number(text) if is_whole(text) => text.parse().or_else(|_| out_of_range(node, text, EXPECTED)),
        Form::Text(text) if canonical_digits(text) => {
            text.parse().or_else(|_| out_of_range(node, text, EXPECTED))
        }
        Form::Text(_) => wrong_form(node, "an unsigned 64-bit integer, in digits alone"),
        _ => wrong_form(node, EXPECTED),
    }
}

/// Digits alone, without leading zeros: one number, one spelling.
pub(super) fn canonical_digits(text: &str) -> bool {
    text == "0"
        || (!text.starts_with('0') && !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit()))
}

/// A number, a number as text with a point or a comma (as the published reader takes it), or a value that
/// is not finite, as text. `[spec: SCENE-9]`
fn float<T: FromStr + Copy + Into<f64>>(node: &Node<'_>, expected: &'static str) -> Read<T> {
    let (text, finite) = match &node.form {
        Form::Number(text) => ((*text).to_string(), true),
        Form::Text(text) => {
            let finite = !matches!(&**text, "NaN" | "Infinity" | "-Infinity" | "nan" | "inf" | "-inf");
            if finite
                && !text
                    .bytes()
                    .all(|byte| matches!(byte, b'0'..=b'9' | b'-' | b'+' | b'.' | b',' | b'e' | b'E'))
            {
                return wrong_form(node, "a number, or \"NaN\", \"Infinity\", \"-Infinity\"");
            }
            (text.replace(',', "."), finite)
        }
        _ => return wrong_form(node, expected),
    };
    let Ok(item) = text.parse::<T>() else { return wrong_form(node, expected) };
    if finite && item.into().is_infinite() { out_of_range(node, &text, expected) } else { Ok(item) }
}

fn items<T>(node: &Node<'_>, read: impl Fn(&Node<'_>) -> Read<T>) -> Read<Vec<T>> {
    let Form::List(nodes) = &node.form else { return wrong_form(node, "a list") };
    let numbered = nodes.iter().enumerate();
    numbered
        .map(|(index, item)| read(item).map_err(|error| Box::new(Unreadable { item: Some(index), ..*error })))
        .collect()
}

fn floats(node: &Node<'_>) -> Read<Vec<f32>> {
    items(node, |item| float(item, "a 32-bit float"))
}

fn fixed<const N: usize>(value_type: ValueType, node: &Node<'_>) -> Read<[f32; N]> {
    let items = floats(node)?;
    let given = items.len();
    let wrong_length =
        |_: Vec<f32>| Unreadable::at(node, FaultKind::WrongLength { value_type, expected: N, given });
    items.try_into().or_else(wrong_length)
}

/// Appends the value in the published form: 64-bit integers as text, floats so that they re-read to the
/// same bits. `[spec: SCENE-9]` `[spec: SCENE-10]`
pub(super) fn write(out: &mut String, value: &Value) {
    match value {
        Value::String(text) => write_text(out, text),
        Value::Bool(item) => put(out, item),
        Value::Int(item) => put(out, item),
        Value::UInt(item) => put(out, item),
        Value::UInt64(item) => put(out, format_args!("\"{item}\"")),
        Value::Float(item) => write_float(out, *item),
        Value::Double(item) => write_float(out, *item),
        Value::ByteVec(items) => write_list(out, items.iter(), put),
        Value::U64Vec(items) => {
            write_list(out, items.iter(), |out, item| put(out, format_args!("\"{item}\"")));
        }
        Value::FloatVec(_) | Value::Vec2(_) | Value::Vec3(_) | Value::Vec4(_) | Value::Vec6(_) => {
            write_list(out, value.floats().unwrap_or_default().iter(), |out, item| write_float(out, *item));
        }
    }
}

/// Writing to a string cannot fail.
pub(super) fn put(out: &mut String, item: impl Display) {
    let _ = write!(out, "{item}");
}

/// The shortest text that re-reads to the same bits; what is not finite goes in quotes. `[spec: SCENE-9]`
fn write_float<T: Debug + Copy + Into<f64>>(out: &mut String, item: T) {
    let wide: f64 = item.into();
    if wide.is_nan() {
        out.push_str("\"NaN\"");
    } else if wide.is_infinite() {
        out.push_str(if wide < 0.0 { "\"-Infinity\"" } else { "\"Infinity\"" });
    } else {
        put(out, format_args!("{item:?}"));
    }
}

fn write_list<I: Iterator>(out: &mut String, items: I, write_item: impl Fn(&mut String, I::Item)) {
    out.push('[');
    for (index, item) in items.enumerate() {
        if index > 0 {
            out.push_str(", ");
        }
        write_item(out, item);
    }
    out.push(']');
}

/// Appends text in quotes, escaped as JSON asks.
pub(super) fn write_text(out: &mut String, text: &str) {
    out.push('"');
    for character in text.chars() {
        match character {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            control if control < ' ' => put(out, format_args!("\\u{:04x}", u32::from(control))),
            other => out.push(other),
        }
    }
    out.push('"');
}
