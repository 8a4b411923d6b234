//! Strategies for the smallest parts. Pools are small, so that generated parts meet.

use dsr_core::{CausalContext, Dot, Name, ReplicaId, Value};
use proptest::collection::{btree_set, vec};
use proptest::prelude::*;

/// Agents 1 to 3, rarely a later incarnation.
pub fn replica() -> impl Strategy<Value = ReplicaId> {
    (1..=3_u32, prop_oneof![7 => Just(0_u32), 1 => Just(1)])
        .prop_map(|(agent, incarnation)| ReplicaId { agent, incarnation })
}

/// A dot of sequence 1 to 6.
pub fn dot() -> impl Strategy<Value = Dot> {
    (replica(), 1..=6_u64).prop_map(|(replica, sequence)| Dot::new(replica, sequence))
}

/// A context with gaps.
pub fn context() -> impl Strategy<Value = CausalContext> {
    btree_set(dot(), 0..12).prop_map(|dots| dots.into_iter().collect())
}

/// One of few names, so that names clash.
pub fn name() -> impl Strategy<Value = Name> {
    prop::sample::select(vec!["a", "b", "c", "kitchen"]).prop_map(Name::from)
}

/// A label: kinematic half of the time, one functional, one plain.
pub fn label() -> impl Strategy<Value = Name> {
    prop::sample::select(vec!["RT", "RT", "in", "near"]).prop_map(Name::from)
}

/// Any 32-bit float, the odd ones often; NaN only as the canonical one.
pub fn float() -> impl Strategy<Value = f32> {
    let odd =
        vec![0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MIN_POSITIVE, 1e-45, 0.1, f32::MAX];
    let canonical = |item: f32| if item.is_nan() { f32::from_bits(0x7fc0_0000) } else { item };
    prop_oneof![prop::sample::select(odd), any::<u32>().prop_map(f32::from_bits)].prop_map(canonical)
}

/// Any 64-bit float, the odd ones often; NaN only as the canonical one.
pub fn double() -> impl Strategy<Value = f64> {
    let odd = vec![0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5e-324, 0.1, f64::MAX];
    let canonical = |item: f64| if item.is_nan() { f64::from_bits(0x7ff8 << 48) } else { item };
    prop_oneof![prop::sample::select(odd), any::<u64>().prop_map(f64::from_bits)].prop_map(canonical)
}

/// A value of any of the fourteen types.
pub fn value() -> impl Strategy<Value = Value> {
    let big = || prop_oneof![any::<u64>(), Just(0), Just(u64::MAX), Just(1 << 53)];
    prop_oneof![
        any::<String>().prop_map(Value::from),
        any::<i32>().prop_map(Value::from),
        float().prop_map(Value::from),
        vec(float(), 0..5).prop_map(Value::from),
        any::<bool>().prop_map(Value::from),
        vec(any::<u8>(), 0..9).prop_map(Value::from),
        any::<u32>().prop_map(Value::from),
        big().prop_map(Value::from),
        double().prop_map(Value::from),
        vec(big(), 0..4).prop_map(Value::from),
        [float(), float()].prop_map(Value::from),
        [float(), float(), float()].prop_map(Value::from),
        [float(), float(), float(), float()].prop_map(Value::from),
        [float(), float(), float(), float(), float(), float()].prop_map(Value::from),
    ]
}
