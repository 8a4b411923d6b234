//! What is fuzzed: each target a plain function from bytes to the rare things reached, or to the law broken.
//!
//! `fuzz/` wraps these for libFuzzer; the tests of this package run them over all that was found, over generated
//! bytes, and over cores broken on purpose. `docs/fuzzing.md` says how to run it.
//!
//! | room | what |
//! |---|---|
//! | [`Target`], [`Marks`], [`Broken`] | what a target is, and what comes of an input |
//! | `history` | replicas and what they do, under every law, beside the fast replica |
//! | `view`, `answer` | states of any shape: their views; digests and what answers them |
//! | `decode`, `json`, `scene`, `trace`, `protocol` | bytes and texts from outside |
//! | [`seeds`] | inputs kept by what they reach |
//! | `first`, [`noise`] | inputs to begin with; bytes for tests |

#![forbid(unsafe_code)]

mod answer;
mod decode;
mod first;
mod history;
mod json;
mod laws;
mod marks;
pub mod noise;
// Replica and reference side by side, as the core's own tests have them.
#[path = "../../../crdt-core/tests/all/replica_support/mod.rs"]
mod pair;
mod protocol;
mod scene;
pub mod seeds;
mod target;
mod trace;
mod view;
mod watch;

pub use history::on_broken_core;
pub use target::{Broken, Marks, Outcome, Target};
pub use watch::watch;

/// Every target.
pub const TARGETS: [Target; 11] = [
    Target {
        name: "history",
        about: "replicas that mutate, deliver, resynchronise and restart: all laws, reference against replica",
        run: history::sound,
        marks: marks::HISTORY,
        first: first::structured,
    },
    Target {
        name: "view",
        about: "views of any states, by every judge; the replica that joins them",
        run: view::states,
        marks: marks::VIEW,
        first: first::structured,
    },
    Target {
        name: "answer",
        about: "digests and what answers them",
        run: answer::exchange,
        marks: marks::ANSWER,
        first: first::structured,
    },
    Target {
        name: "decode_state",
        about: "any bytes as a state",
        run: decode::state,
        marks: marks::DECODE_STATE,
        first: first::states,
    },
    Target {
        name: "decode_digest",
        about: "any bytes as a digest",
        run: decode::digest_bytes,
        marks: marks::DECODE_DIGEST,
        first: first::digests,
    },
    Target {
        name: "json_state",
        about: "any text as a state, digest, record or repair",
        run: json::state,
        marks: marks::JSON_STATE,
        first: first::state_texts,
    },
    Target {
        name: "json_mutation",
        about: "any text as a mutation, author or value",
        run: json::mutation,
        marks: marks::JSON_MUTATION,
        first: first::mutation_texts,
    },
    Target {
        name: "json_dictionary",
        about: "any text as a dictionary",
        run: json::dictionary,
        marks: marks::JSON_DICTIONARY,
        first: first::dictionary_texts,
    },
    Target {
        name: "scene",
        about: "any text as a scene file",
        run: scene::text,
        marks: marks::SCENE,
        first: first::scene_texts,
    },
    Target {
        name: "trace",
        about: "any text as a trace; what is one is drawn and run again",
        run: trace::text,
        marks: marks::TRACE,
        first: first::trace_texts,
    },
    Target {
        name: "protocol",
        about: "any text as requests, replies, cases, logs and expectations",
        run: protocol::text,
        marks: marks::PROTOCOL,
        first: first::protocol_texts,
    },
];

/// The target of a name.
pub fn target(name: &str) -> Option<&'static Target> {
    const ALL: &[Target] = &TARGETS;
    ALL.iter().find(|target| target.name == name)
}
