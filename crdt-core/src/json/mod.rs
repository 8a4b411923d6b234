//! JSON forms, by serde. `[spec: JSON-1]`
//!
//! For files, tests and people; between replicas travels the binary encoding. Equal values give equal
//! text, and what is read back equals what was written. An object that names a key twice or a field
//! that is not known is refused, and so is a state that is not well-formed. `[spec: JSON-2]`
//!
//! | type | form | room |
//! |---|---|---|
//! | replica, dot, vertex, edge | `"r3"`, `"r3.17"`, `"root"` | `ids` |
//! | value | `{"type": "int", "value": 5}` | `value` |
//! | dictionary | `{"closed": true, "edge_labels": ["in"], …}` | `dictionary` |
//! | edge key, author | `{"from": "r1.1", "label": "in", "to": "r1.3"}`, `{"replica": "r1"}` | `edge_key`, `author` |
//! | mutation | `{"remove_vertex": {"vertex": "r1.1"}}` | `mutation` |
//! | record | `{"vertex": {"type": "room", "name": "kitchen", "stamp": 1}}` | `record` |
//! | set of dots | `{"r1": "1-5,7"}` | `runs` |
//! | state, digest | `{"context": …, "store": …}`, `{"context": …, "live": …}` | `state` |
//! | repair | `{"kind": "detached", "vertex": "r1.1"}` | `repair` |
//!
//! ```
//! # use dsr_core::Value;
//! let value: Value = serde_json::from_str(r#"{"type": "uint64", "value": "18446744073709551615"}"#)?;
//! assert_eq!(value, Value::UInt64(u64::MAX));
//! # Ok::<(), serde_json::Error>(())
//! ```

mod author;
mod dictionary;
mod edge_key;
mod ids;
mod map;
mod mutation;
mod number;
mod record;
mod repair;
mod runs;
mod state;
mod value;
