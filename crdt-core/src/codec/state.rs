//! States and deltas. `[spec: ENC-1]`

use super::error::DecodeError;
use super::names::{NamesRead, NamesWritten};
use super::reader::Reader;
use super::record::{self, Before};
use super::replicas::{ReplicasRead, ReplicasWritten};
use super::seen::Seen;
use super::{KIND_STATE, runs, writer};
use crate::context::CausalContext;
use crate::dot::{Dot, ReplicaId, VertexId};
use crate::limits;
use crate::record::Record;
use crate::state::State;
use crate::wellformed::check_well_formed;
use alloc::sync::Arc;
use alloc::vec::Vec;

/// The canonical bytes of a state or delta: equal states give equal bytes. `[spec: ENC-1]`
///
/// Of a state that is not well-formed it gives bytes that [`decode`] refuses: none at all of one that holds
/// what it has not seen, which has no spelling.
pub fn encode(state: &State) -> Vec<u8> {
    let context = state.context().runs();
    let replicas = ReplicasWritten::of(replicas_of(state));
    let names = NamesWritten::of(state.records().map(|(_, record)| record));
    let mut out = writer::begin(KIND_STATE);
    replicas.write(&mut out);
    runs::write(&mut out, &replicas.ids, context.clone());
    names.write(&mut out);
    let mut seen = Seen::new(context);
    let mut before = Before::default();
    let mut records = state.records();
    for &replica in &replicas.ids {
        if !seen.start(replica) {
            continue;
        }
        let own = records.clone().take_while(|(dot, _)| dot.replica == replica).count();
        writer::count(&mut out, own);
        for (dot, record) in records.by_ref().take(own) {
            let Some(skip) = seen.skip_to(dot) else { return Vec::new() };
            writer::varint(&mut out, skip);
            record::write(&mut out, &replicas, &names, &mut before, record);
        }
    }
    // Of a replica of which nothing was seen.
    if records.next().is_some() { Vec::new() } else { out }
}

/// Every replica that the state names: seen, or anchored to. `[spec: ENC-4]`
fn replicas_of(state: &State) -> impl Iterator<Item = ReplicaId> + '_ {
    let anchors = state.records().flat_map(|(_, record)| record.anchors());
    let anchors = anchors.filter(|&anchor| anchor != VertexId::ROOT.0);
    state.context().runs().map(|run| run.replica).chain(anchors.map(|dot| dot.replica))
}

/// The state that canonical bytes spell. Any bytes may be given. `[spec: ENC-1]` `[spec: ENC-10]`
///
/// O(n log n) in the bytes, however many dots their runs name.
pub fn decode(bytes: &[u8]) -> Result<State, DecodeError> {
    let mut reader = Reader::new(bytes, KIND_STATE)?;
    let mut replicas = ReplicasRead::read(&mut reader)?;
    let context = read_context(&mut reader, &mut replicas)?;
    let mut names = NamesRead::read(&mut reader)?;
    let records = read_records(&mut reader, &context, &mut replicas, &mut names)?;
    reader.finish()?;
    replicas.check_used()?;
    names.check_used()?;
    let state = State::of_parts(records, context);
    check_well_formed(&state)?;
    Ok(state)
}

/// Reads a context; the runs beyond gaps are counted before they are stored. `[spec: ENC-5]`
pub(super) fn read_context(
    reader: &mut Reader<'_>,
    replicas: &mut ReplicasRead,
) -> Result<CausalContext, DecodeError> {
    let mut context = CausalContext::new();
    let mut left = limits::CLOUD_RUNS_MAX;
    for at in 0..replicas.len() {
        let mut is_used = false;
        runs::read(reader, replicas.id(at), |offset, run| {
            if run.first > 1 {
                let (what, max) = ("the number of runs beyond gaps", limits::CLOUD_RUNS_MAX as u64);
                left = left.checked_sub(1).ok_or(DecodeError::TooGreat { offset, what, max })?;
            }
            is_used = true;
            context.insert_run(run);
            Ok(())
        })?;
        if is_used {
            replicas.mark(at);
        }
    }
    Ok(context)
}

/// The least record: the skip to its dot, its kind, its stamp, and two names.
const RECORD_BYTES_MIN: usize = 5;

fn read_records(
    reader: &mut Reader<'_>,
    context: &CausalContext,
    replicas: &mut ReplicasRead,
    names: &mut NamesRead,
) -> Result<Vec<(Dot, Arc<Record>)>, DecodeError> {
    let mut records = Vec::new();
    let mut seen = Seen::new(context.runs());
    let mut before = Before::default();
    for at in 0..replicas.len() {
        let replica = replicas.id(at);
        if !seen.start(replica) {
            continue;
        }
        let left = limits::RECORDS_MAX.saturating_sub(records.len());
        let count = reader.count(left, RECORD_BYTES_MIN, "the number of records")?;
        records.reserve(count);
        for _ in 0..count {
            let offset = reader.offset();
            let skip = reader.varint()?;
            let dot = seen.pass(replica, skip).ok_or(DecodeError::Unseen { offset, replica, skip })?;
            records.push((dot, Arc::new(record::read(reader, replicas, names, &mut before)?)));
        }
    }
    Ok(records)
}
