//! The core beside a program that answers from the machine-checked model: the same questions to both, state by state.
//! The protocol is the chapter `spec/oracle.md`.
//!
//! The program is no part of this crate. Nothing here knows the rules of the specification: what is compared is what the
//! core's functions return, byte for byte, with what the program answers.
//!
//! | room | what is in it |
//! |---|---|
//! | [`fact`] | questions, their lines, the core's answers |
//! | [`program`] | a program as a child process, asked ahead of its answers |
//! | [`compare`] | batches of facts on several programs at once |
//! | [`desk`] | facts that come from a search, each asked once |
//! | [`histories`] | every canonical history of L1, beside the program |
//! | [`random`] | random histories of hostile shape; shrunk when they disagree |
//! | [`corpus`] | the conformance corpus, by the program as an adapter, step by step |
//! | [`flawed`] | answers broken on purpose |

#![forbid(unsafe_code)]

pub mod compare;

pub mod corpus;
pub mod desk;
pub mod fact;
pub mod flawed;
pub mod histories;
pub mod program;
pub mod random;

pub mod verdict;
