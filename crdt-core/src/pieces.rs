//! Cutting a state into small states, so that a large one can travel in parts. `[spec: SYNC-6]`

use crate::context::Run;
use crate::record::Record;
use crate::state::State;
use alloc::vec::Vec;

/// What a record costs besides its texts and its payload, at most: its dot, kind, stamp, anchors, timestamp,
/// lengths and places in tables, and the entries of the replicas that it names.
const RECORD_BYTES: usize = 128;
/// What a run costs, at most, with the entry of its replica and the counts that go with it.
const RUN_BYTES: usize = 48;
/// What an encoding costs with nothing in it, at most.
const EMPTY_BYTES: usize = 16;

impl State {
    /// Cuts the state into states whose join it is, in the order of their dots; none for the state that has
    /// seen nothing. `[spec: SYNC-6]`
    ///
    /// Each is well-formed if this one is. Each is encoded in `bytes` at most, unless it is one run with one
    /// record that is larger alone. They may be joined anywhere, in any order, and any of them may be missing: what is
    /// missing is still named by a digest. Records are shared, not copied. O((records + runs) · log n).
    ///
    /// ```
    /// # use dsr_core::*;
    /// # let mut replica = Replica::new(ReplicaId::agent(1), Dictionary::open());
    /// # for name in ["a", "b", "c"] {
    /// #     let vertex = NewVertex::new("room", name);
    /// #     replica.mutate(&Mutation::AddVertex { vertex, link: VertexLink::child_of(VertexId::ROOT) }, 0)?;
    /// # }
    /// let state = replica.state();
    /// let pieces = state.pieces(400);
    /// assert!(pieces.len() > 1 && pieces.iter().all(|piece| encode(piece).len() <= 400));
    /// let joined = pieces.iter().rev().fold(State::new(), |joined, piece| joined.joined(piece));
    /// assert_eq!(joined, state);
    /// # Ok::<(), MutationError>(())
    /// ```
    #[must_use]
    pub fn pieces(&self, bytes: usize) -> Vec<State> {
        let mut cut = Cut { bytes, used: EMPTY_BYTES, piece: State::new(), pieces: Vec::new() };
        for run in self.context().runs() {
            let mut first = run.first;
            cut.make_room(RUN_BYTES);
            for (dot, record) in self.records_within(run) {
                let cost = cost(record);
                if cut.is_too_full_for(cost) && dot.sequence > first {
                    // What died before the record goes with what is there.
                    cut.take(self, Run { first, last: dot.sequence - 1, ..run });
                    first = dot.sequence;
                }
                if cut.make_room(cost) {
                    cut.used += RUN_BYTES;
                }
                cut.used += cost;
                cut.take(self, Run { first, last: dot.sequence, ..run });
                first = dot.sequence + 1;
            }
            if first <= run.last {
                cut.take(self, Run { first, ..run });
            }
            cut.used += RUN_BYTES;
        }
        cut.end();
        cut.pieces
    }
}

/// Upper bound of what a record adds to an encoding.
fn cost(record: &Record) -> usize {
    let texts = match record {
        Record::Vertex(vertex) => vertex.vertex_type.len() + vertex.name.len(),
        Record::Edge(edge) => edge.label.len(),
        Record::Write(write) => write.name.len() + write.value.payload_bytes(),
    };
    texts.saturating_add(RECORD_BYTES)
}

/// A state being cut.
struct Cut {
    bytes: usize,
    used: usize,
    piece: State,
    pieces: Vec<State>,
}

impl Cut {
    fn is_too_full_for(&self, cost: usize) -> bool {
        self.used.saturating_add(cost) > self.bytes
    }

    /// Ends the piece if it has no room for so many bytes; whether it has ended one.
    fn make_room(&mut self, cost: usize) -> bool {
        let full = self.is_too_full_for(cost) && !self.piece.context().is_empty();
        if full {
            self.end();
        }
        full
    }

    fn take(&mut self, state: &State, run: Run) {
        self.piece.take_run(state, run);
    }

    fn end(&mut self) {
        if !self.piece.context().is_empty() {
            self.pieces.push(core::mem::take(&mut self.piece));
        }
        self.used = EMPTY_BYTES;
    }
}
