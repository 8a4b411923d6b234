//! Registers as tests write and read them.

#![allow(clippy::panic, dead_code, unreachable_pub, reason = "shared by tests that each use a part")]

use dsr_model::published::{Attribute, Dot, Register, Value};

/// The dot of a counter.
pub fn dot(n: u32) -> Dot {
    Dot { id: 0, n }
}

/// A number that says that it is from an agent.
pub fn of(agent: u32, value: i64) -> Attribute {
    Attribute { value: Value::Number(value), agent }
}

/// The counter of a register, and what lies beyond it.
pub fn counters(register: &Register<Attribute>) -> (Option<u32>, Vec<u32>) {
    let context = register.context();
    (context.counter(0), context.cloud().map(|dot| dot.n).collect())
}

/// The number that a register shows.
pub fn number(register: &Register<Attribute>) -> Option<i64> {
    register.value().map(|held| match held.value {
        Value::Number(number) => number,
        Value::Node(_) => panic!("a number was written"),
    })
}

/// A register written `times` times, and the deltas.
pub fn written(times: u32) -> (Register<Attribute>, Vec<Register<Attribute>>) {
    let mut register = Register::default();
    let deltas = (1..=times).map(|n| register.write(of(1, n.into()))).collect();
    (register, deltas)
}
