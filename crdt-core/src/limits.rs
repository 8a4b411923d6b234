//! Every limit, in one place. Reaching one is an error that names it. `[spec: LIMIT-1]`

/// The longest name, label, type or attribute name, in bytes of UTF-8. `[spec: LIMIT-2]`
pub const NAME_BYTES_MAX: usize = 255;
/// The largest payload of one value, in bytes. `[spec: LIMIT-3]`
pub const VALUE_BYTES_MAX: usize = 64 << 20;
/// The most attributes that one mutation may set or unset on one element. `[spec: LIMIT-4]`
pub const ATTRIBUTES_MAX: usize = 1024;
/// The greatest stamp; beyond it a mutation is refused. Leaves JSON numbers exact. `[spec: LIMIT-5]`
pub const STAMP_MAX: u64 = (1 << 53) - 1;
/// The greatest sequence of a replica; beyond it a mutation is refused. `[spec: LIMIT-6]`
pub const SEQUENCE_MAX: u64 = (1 << 53) - 1;
/// The most runs beyond gaps that a decoded context may name. `[spec: LIMIT-7]`
pub const CLOUD_RUNS_MAX: usize = 1 << 20;
/// The most records that a decoded state may hold. `[spec: LIMIT-8]`
pub const RECORDS_MAX: usize = 1 << 24;
/// The largest encoded state, in bytes. `[spec: LIMIT-9]`
pub const ENCODED_BYTES_MAX: usize = 1 << 30;
/// The largest scene file, in bytes. `[spec: SCENE-2]`
pub const SCENE_BYTES_MAX: usize = 64 << 20;
/// The deepest nesting of lists and objects in a scene file; the format needs 9. `[spec: SCENE-2]`
pub const SCENE_DEPTH_MAX: usize = 32;
