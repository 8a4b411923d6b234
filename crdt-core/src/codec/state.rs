//! States and deltas. `[spec: ENC-1]`

use super::error::DecodeError;
use super::reader::Reader;
use super::tables::{Names, Replicas};
use super::{KIND_STATE, record, runs, writer};
use crate::context::{CausalContext, Run};
use crate::dot::{Dot, ReplicaId, VertexId};
use crate::limits;
use crate::record::Record;
use crate::state::State;
use crate::wellformed::check_well_formed;
use alloc::vec::Vec;

/// The canonical bytes of a state or delta: equal states give equal bytes. `[spec: ENC-1]`
///
/// Of a state that is not well-formed it gives bytes that [`decode`] refuses.
pub fn encode(state: &State) -> Vec<u8> {
    let context: Vec<Run> = state.context().runs().collect();
    let replicas = Replicas::of(replicas_of(state, &context));
    let names = Names::of(state.records().map(|(_, record)| record));
    let mut out = writer::begin(KIND_STATE);
    replicas.write(&mut out);
    runs::write(&mut out, &replicas.ids, &context);
    names.write(&mut out);
    let mut records = state.records().peekable();
    for &replica in &replicas.ids {
        let ahead = records.clone().take_while(|(dot, _)| dot.replica == replica);
        writer::count(&mut out, ahead.count());
        let mut least = 1_u64;
        while let Some((dot, held)) = records.next_if(|(dot, _)| dot.replica == replica) {
            // Wraps only for sequence 0, which is not well-formed; such bytes are then refused.
            writer::varint(&mut out, dot.sequence.wrapping_sub(least));
            record::write(&mut out, &replicas, &names, held);
            least = dot.sequence.wrapping_add(1);
        }
    }
    out
}

/// Every replica that the state names: seen, holding, or anchored to. `[spec: ENC-4]`
fn replicas_of<'s>(state: &'s State, context: &'s [Run]) -> impl Iterator<Item = ReplicaId> + 's {
    let in_records = state.records().flat_map(|(dot, record)| {
        record.anchors().filter(|&anchor| anchor != VertexId::ROOT.0).chain([dot]).map(|dot| dot.replica)
    });
    context.iter().map(|run| run.replica).chain(in_records)
}

/// The state that canonical bytes spell. Any bytes may be given. `[spec: ENC-1]` `[spec: ENC-10]`
///
/// O(n log n) in the bytes, however many dots their runs name.
pub fn decode(bytes: &[u8]) -> Result<State, DecodeError> {
    let mut reader = Reader::new(bytes, KIND_STATE)?;
    let mut replicas = Replicas::read(&mut reader)?;
    let context = read_context(&mut reader, &mut replicas)?;
    let mut names = Names::read(&mut reader)?;
    let records = read_records(&mut reader, &mut replicas, &mut names)?;
    reader.finish()?;
    replicas.check_used()?;
    names.check_used()?;
    let state = State::assemble(records, context);
    check_well_formed(&state)?;
    Ok(state)
}

/// Reads a context; the runs beyond gaps are counted before they are stored. `[spec: ENC-5]`
pub(super) fn read_context(
    reader: &mut Reader<'_>,
    replicas: &mut Replicas,
) -> Result<CausalContext, DecodeError> {
    let mut context = CausalContext::new();
    let mut left = limits::CLOUD_RUNS_MAX;
    let ids = replicas.ids.clone();
    runs::read(reader, &ids, |offset, run| {
        if run.first > 1 {
            let (what, max) = ("the number of runs beyond gaps", limits::CLOUD_RUNS_MAX as u64);
            left = left.checked_sub(1).ok_or(DecodeError::TooGreat { offset, what, max })?;
        }
        replicas.mark(run);
        context.insert_run(run);
        Ok(())
    })?;
    Ok(context)
}

/// The least record: the distance of its dot, its kind, its stamp, and two names.
const RECORD_BYTES_MIN: usize = 5;

fn read_records(
    reader: &mut Reader<'_>,
    replicas: &mut Replicas,
    names: &mut Names,
) -> Result<Vec<(Dot, Record)>, DecodeError> {
    let mut records = Vec::new();
    for at in 0..replicas.ids.len() {
        let replica = replicas.ids[at];
        let left = limits::RECORDS_MAX.saturating_sub(records.len());
        let count = reader.count(left, RECORD_BYTES_MIN, "the number of records")?;
        records.reserve(count);
        let mut least = 1_u64;
        for _ in 0..count {
            let offset = reader.offset();
            let sequence =
                least.checked_add(reader.varint()?).filter(|&sequence| sequence <= limits::SEQUENCE_MAX);
            let (what, max) = ("a sequence", limits::SEQUENCE_MAX);
            let sequence = sequence.ok_or(DecodeError::TooGreat { offset, what, max })?;
            records.push((Dot::new(replica, sequence), record::read(reader, replicas, names)?));
            least = sequence + 1;
        }
    }
    Ok(records)
}
