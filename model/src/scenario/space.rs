//! Histories of a scenario and their successors. `[spec: SCEN-9]`
//!
//! As in the layer of histories, deliveries are fused into the step that first observes them: a step is a
//! replica, a set of deltas that it receives, and the next thing that it can do then. A history is kept as
//! what can still matter: the deltas broadcast so far, and for each replica that goes on, its state and place.
//!
//! Of all sets of deltas that let a replica make the same move, with the same delta, only the least are
//! followed. Let A ⊂ B be two such sets. After the step with A the same deltas are about, all replicas are
//! at the same places, and the replica has not received B ∖ A; it can receive that before its next
//! step. So whatever follows the step with B follows the step with A as well: the same deltas and ends are met,
//! and every view, since all subsets of the deltas are judged. `[spec: SCEN-10]`

use super::explore::{Options, Replicated};
use super::memo::{DeltaId, Memo, Move, Next, Position, StateId};
use super::script::Conduct;
use crate::semantics::Breach;
use rustc_hash::FxHashSet;

/// The most deltas of others that a replica may lack, and the most whose subsets are all judged.
pub(super) const SUBSET_DELTAS_MAX: usize = 14;

/// A history, by what can still matter.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) struct Node {
    /// The different deltas broadcast, in order of their numbers.
    pub(super) pool: Box<[DeltaId]>,
    pub(super) seats: Box<[Seat]>,
}

/// Where a replica is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum Seat {
    /// Its state after its last step, and what it does next.
    Doing(StateId, Position),
    Done,
    Stopped,
}

/// One step: a replica receives some deltas and moves.
#[derive(Clone, Debug)]
pub(super) struct Choice {
    pub(super) replica: usize,
    pub(super) received: Vec<DeltaId>,
    pub(super) at: Position,
    pub(super) step: Move,
}

/// A clause that is broken somewhere after a history.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Broken {
    pub(super) breach: Breach,
    /// By whose step; `None` for a set of deltas that a reader receives.
    pub(super) replica: Option<usize>,
    /// What was received, the last delivery last.
    pub(super) received: Vec<DeltaId>,
}

/// The search space of one scenario.
#[derive(Debug)]
pub(super) struct Space<S> {
    pub(super) memo: Memo<S>,
    pub(super) options: Options,
    pub(super) initial: StateId,
    /// Per property of ends: whether an end decides it.
    pub(super) decided: Vec<bool>,
    /// Whether a limit was met.
    pub(super) is_bounded: bool,
    /// Sets of deltas of maximal histories: all of whose subsets were judged, and which are too large for it.
    pub(super) judged: FxHashSet<Box<[DeltaId]>>,
    pub(super) large: FxHashSet<Box<[DeltaId]>>,
}

impl<S: Replicated> Space<S> {
    pub(super) fn new(mut memo: Memo<S>, options: Options) -> Self {
        let initial = memo.intern(memo.scenario.initial.clone());
        Self {
            initial,
            options,
            decided: vec![false; memo.scenario.properties.len()],
            memo,
            is_bounded: false,
            judged: FxHashSet::default(),
            large: FxHashSet::default(),
        }
    }

    pub(super) fn start(&self) -> Node {
        let seat = Seat::Doing(self.initial, Position { step: 0, made: 0 });
        Node { pool: Box::new([]), seats: vec![seat; self.memo.scenario.replicas.len()].into() }
    }

    /// Every history one step longer; with [`Options::every_delivery`], by every set of deltas received.
    pub(super) fn successors(&mut self, node: &Node, out: &mut Vec<(Choice, Node)>) -> Result<(), Broken> {
        for replica in 0..node.seats.len() {
            if let Seat::Doing(state, at) = node.seats[replica] {
                self.successors_of(node, replica, state, at, out)?;
            }
        }
        Ok(())
    }

    fn successors_of(
        &mut self,
        node: &Node,
        replica: usize,
        state: StateId,
        at: Position,
        out: &mut Vec<(Choice, Node)>,
    ) -> Result<(), Broken> {
        let mut unseen: Vec<DeltaId> = node.pool.to_vec();
        unseen.retain(|&delta| self.memo.join(state, delta) != state);
        if unseen.len() > SUBSET_DELTAS_MAX {
            self.is_bounded = true;
            return Ok(());
        }
        let mut reached = Vec::with_capacity(1 << unseen.len());
        let mut least: Vec<(Option<DeltaId>, Next, usize)> = Vec::new();
        for mask in 0..1_usize << unseen.len() {
            let received = || subset(&unseen, mask);
            let before = match mask {
                0 => state,
                _ => self.memo.join(reached[mask & (mask - 1)], unseen[mask.trailing_zeros() as usize]),
            };
            reached.push(before);
            let broken = |breach| Broken { breach, replica: Some(replica), received: received() };
            if let Some((breach, _)) = &self.memo.fault {
                return Err(broken(breach.clone()));
            }
            for step in self.memo.moves(before, replica, at).map_err(broken)?.iter() {
                let same = |known: &(_, _, usize)| {
                    (known.0, known.1) == (step.delta, step.next) && known.2 & mask == known.2
                };
                if !self.options.every_delivery && least.iter().any(same) {
                    continue;
                }
                least.push((step.delta, step.next, mask));
                let choice = Choice { replica, received: received(), at, step: step.clone() };
                out.push((choice, node.after(replica, step)));
            }
        }
        Ok(())
    }

    /// Everything that has been broadcast, delivered.
    pub(super) fn everything(&mut self, node: &Node) -> StateId {
        node.pool.iter().fold(self.initial, |state, &delta| self.memo.join(state, delta))
    }

    /// If a history has ended once everything is delivered to everybody: the state that all have then, and
    /// which replicas are done, by bit. A free replica always is. `[spec: SCEN-9]`
    pub(super) fn end(&mut self, node: &Node) -> Result<Option<(StateId, u32)>, Broken> {
        let last = self.everything(node);
        let mut done = 0_u32;
        for (replica, seat) in node.seats.iter().enumerate() {
            let is_free = matches!(self.memo.scenario.replicas[replica].conduct, Conduct::Free { .. });
            match *seat {
                Seat::Doing(_, at) if !is_free => {
                    let moves = self.memo.moves(last, replica, at);
                    let received = node.pool.to_vec();
                    let moves =
                        moves.map_err(|breach| Broken { breach, replica: Some(replica), received })?;
                    if !moves.is_empty() {
                        return Ok(None);
                    }
                }
                Seat::Stopped => {}
                Seat::Doing(..) | Seat::Done => done |= 1 << replica,
            }
        }
        Ok(Some((last, done)))
    }
}

/// The items of a set, by bits.
pub(super) fn subset(items: &[DeltaId], mask: usize) -> Vec<DeltaId> {
    items.iter().enumerate().filter(|(at, _)| mask >> at & 1 == 1).map(|(_, &item)| item).collect()
}

impl Node {
    /// The history one step longer.
    fn after(&self, replica: usize, step: &Move) -> Self {
        let mut next = self.clone();
        next.seats[replica] = match step.next {
            Next::At(position) => Seat::Doing(step.after, position),
            Next::Done => Seat::Done,
            Next::Stopped => Seat::Stopped,
        };
        if let Some(delta) = step.delta
            && let Err(at) = self.pool.binary_search(&delta)
        {
            let mut pool = self.pool.to_vec();
            pool.insert(at, delta);
            next.pool = pool.into();
        }
        next
    }
}
