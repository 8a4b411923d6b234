//! A corpus of cases that any implementation of the Deep State Representation can run, and the harness that judges
//! it. The protocol is the chapter `spec/conformance.md`.
//!
//! An implementation takes part by an *adapter*: a program that reads one request a line and writes one reply a
//! line. The harness is the network between its replicas and the only judge.
//!
//! | room | what is in it |
//! |---|---|
//! | [`protocol`] | requests and replies; their JSON Schemas are in `conformance/schema` |
//! | [`case`] | the file of cases, and its strict reader |
//! | [`corpus`] | the cases that ship |
//! | [`adapter`], [`serve`] | what answers requests; the core as such; the loop over lines |
//! | [`run`] | a case against an adapter, in-process or as a child process |
//! | [`report`] | verdicts, counted |
//! | [`templates`] | adapters to start from, in other languages |
//! | [`score`] | cores broken on purpose, and which cases find them |
//! | [`generate`] | cases that are computed from what the checker has found |
//! | [`log`] | a run, line by line; its strict reader; two of them compared |
//! | [`expect`] | failures that are expected, with their reasons |
//! | [`render`] | diagrams of cases, failures, reports |

#![forbid(unsafe_code)]

pub mod adapter;
pub mod case;
mod core_adapter;
pub mod corpus;
pub mod expect;
pub mod generate;
pub mod log;
pub mod protocol;
pub mod render;
pub mod report;
pub mod run;
pub mod score;
pub mod serve;
pub mod templates;
