//! Digests. `[spec: ENC-11]`

use super::error::DecodeError;
use super::reader::Reader;
use super::replicas::{ReplicasRead, ReplicasWritten};
use super::state::read_context;
use super::{KIND_DIGEST, runs, writer};
use crate::context::Run;
use crate::digest::Digest;
use crate::limits;
use alloc::vec::Vec;

/// How a digest is that of no state. `[spec: ENC-11]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MalformedDigest {
    /// The live dots are not ascending, maximal runs of sequences from 1.
    #[error("[ENC-11] the run {}.{} to {} is empty, or not beyond the run before it", run.replica, run.first, run.last)]
    NotRuns {
        /// The run.
        run: Run,
    },
    /// A live dot has not been seen.
    #[error("[ENC-11] not every dot of {}.{} to {} has been seen", run.replica, run.first, run.last)]
    LiveUnseen {
        /// Its run.
        run: Run,
    },
    /// More live dots than a state may hold records. `[spec: LIMIT-8]`
    #[error("[ENC-11] over {} live dots", limits::RECORDS_MAX)]
    TooManyLive,
}

/// Whether a digest can be that of a well-formed state. `[spec: ENC-11]`
///
/// A digest from outside that was not checked can list its live dots many times over, and
/// [`delta_for`](crate::delta_for) looks at each list entry.
pub fn check_digest(digest: &Digest) -> Result<(), MalformedDigest> {
    let mut live = 0_u64;
    let mut before: Option<Run> = None;
    for &run in &digest.live {
        let apart = before.is_none_or(|before| {
            before.replica < run.replica
                || before.replica == run.replica && before.last.saturating_add(1) < run.first
        });
        if !apart || run.first == 0 || run.first > run.last {
            return Err(MalformedDigest::NotRuns { run });
        }
        if !digest.context.contains_run(run) {
            return Err(MalformedDigest::LiveUnseen { run });
        }
        live = live.saturating_add((run.last - run.first).saturating_add(1));
        if live > limits::RECORDS_MAX as u64 {
            return Err(MalformedDigest::TooManyLive);
        }
        before = Some(run);
    }
    Ok(())
}

/// The canonical bytes of a digest: equal digests give equal bytes. `[spec: ENC-11]`
///
/// Of what [`check_digest`] refuses it gives bytes that [`decode_digest`] refuses, or reads as another digest.
pub fn encode_digest(digest: &Digest) -> Vec<u8> {
    let context = digest.context.runs();
    let live = digest.live.iter().copied();
    let replicas = ReplicasWritten::of(context.clone().chain(live.clone()).map(|run| run.replica));
    let mut out = writer::begin(KIND_DIGEST);
    replicas.write(&mut out);
    runs::write(&mut out, &replicas.ids, context);
    runs::write(&mut out, &replicas.ids, live);
    out
}

/// The digest that canonical bytes spell. Any bytes may be given. `[spec: ENC-11]` `[spec: ENC-10]`
pub fn decode_digest(bytes: &[u8]) -> Result<Digest, DecodeError> {
    let mut reader = Reader::new(bytes, KIND_DIGEST)?;
    let mut replicas = ReplicasRead::read(&mut reader)?;
    let context = read_context(&mut reader, &mut replicas)?;
    let mut live = Vec::new();
    for at in 0..replicas.len() {
        runs::read(&mut reader, replicas.id(at), |_, run| {
            live.push(run);
            Ok(())
        })?;
    }
    reader.finish()?;
    replicas.check_used()?;
    let digest = Digest { context, live };
    check_digest(&digest)?;
    Ok(digest)
}
