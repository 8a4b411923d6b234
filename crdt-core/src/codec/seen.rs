//! The dots of records, counted among the dots that the context has seen. `[spec: ENC-8]`
//!
//! A record's dot has been seen, so it is enough to say how many seen dots stand between it and the record
//! before: the dead ones. Runs are passed over as wholes, however many dots they have.

use crate::context::Run;
use crate::dot::{Dot, ReplicaId};

/// The dots of a context in order; those passed over or met are gone.
#[derive(Debug)]
pub(super) struct Seen<I> {
    /// What is left of the run in hand; never empty.
    rest: Option<Run>,
    /// The runs after it.
    runs: I,
}

impl<I: Iterator<Item = Run>> Seen<I> {
    /// Of runs that ascend.
    pub(super) fn new(mut runs: I) -> Self {
        Self { rest: runs.next(), runs }
    }

    /// Goes on to the dots of `replica`; whether there are any. Replicas must be asked for in order.
    pub(super) fn start(&mut self, replica: ReplicaId) -> bool {
        while let Some(run) = self.rest
            && run.replica < replica
        {
            self.rest = self.runs.next();
        }
        self.rest.is_some_and(|run| run.replica == replica)
    }

    /// How many dots stand before `dot`, all of its replica; `None` if `dot` is not among those left.
    pub(super) fn skip_to(&mut self, dot: Dot) -> Option<u64> {
        let mut skip = 0_u64;
        loop {
            let run = self.rest.filter(|run| run.replica == dot.replica && run.first <= dot.sequence)?;
            if dot.sequence <= run.last {
                self.leave_after(run, dot.sequence);
                // Saturates only for sequences that no decoder allows.
                return Some(skip.saturating_add(dot.sequence - run.first));
            }
            skip = skip.saturating_add(run.last - run.first).saturating_add(1);
            self.rest = self.runs.next();
        }
    }

    /// The dot of `replica` that so many of its dots stand before; `None` if there are no more than those.
    pub(super) fn pass(&mut self, replica: ReplicaId, mut skip: u64) -> Option<Dot> {
        loop {
            let run = self.rest.filter(|run| run.replica == replica)?;
            let dots_less_one = run.last - run.first;
            if skip <= dots_less_one {
                let sequence = run.first + skip;
                self.leave_after(run, sequence);
                return Some(Dot::new(replica, sequence));
            }
            skip -= dots_less_one + 1;
            self.rest = self.runs.next();
        }
    }

    fn leave_after(&mut self, run: Run, sequence: u64) {
        self.rest =
            if sequence < run.last { Some(Run { first: sequence + 1, ..run }) } else { self.runs.next() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::context::runs_of;
    use alloc::vec::Vec;

    /// All sets of seen dots, three of each of two replicas, and all sets of held ones among them: both
    /// directions against a count dot by dot. `[spec: ENC-8]`
    #[test]
    fn oracle_skips_are_counted_dot_by_dot() {
        let replicas = [ReplicaId::agent(1), ReplicaId::agent(2)];
        let all: Vec<Dot> = replicas.iter().flat_map(|&r| (1..=3).map(move |n| Dot::new(r, n))).collect();
        let of = |mask: u32| {
            all.iter().enumerate().filter(move |(at, _)| mask >> at & 1 == 1).map(|(_, &dot)| dot)
        };
        for seen in 0..64 {
            for held in 0..64 {
                let mut writer = Seen::new(runs_of(of(seen)));
                let mut reader = Seen::new(runs_of(of(seen)));
                for replica in replicas {
                    let has_any = of(seen).any(|dot| dot.replica == replica);
                    assert_eq!(writer.start(replica), has_any);
                    assert_eq!(reader.start(replica), has_any);
                    let mut before = Dot::new(replica, 0);
                    for dot in of(held).filter(|dot| dot.replica == replica) {
                        let between = of(seen).filter(|&other| before < other && other < dot).count() as u64;
                        let expected = of(seen).any(|other| other == dot).then_some(between);
                        assert_eq!(writer.skip_to(dot), expected, "{seen:b} {held:b} {dot}");
                        let Some(skip) = expected else { break };
                        assert_eq!(reader.pass(replica, skip), Some(dot));
                        before = dot;
                    }
                }
            }
        }
    }

    /// `[spec: ENC-8]` `[spec: ENC-5]`
    #[test]
    fn regress_runs_of_all_sequences_are_not_walked() {
        let replica = ReplicaId::agent(1);
        let runs = [Run { replica, first: 1, last: u64::MAX }];
        let last = Dot::new(replica, u64::MAX);
        assert_eq!(Seen::new(runs.into_iter()).skip_to(last), Some(u64::MAX - 1));
        assert_eq!(Seen::new(runs.into_iter()).pass(replica, u64::MAX - 1), Some(last));
        assert_eq!(Seen::new(runs.into_iter()).pass(replica, u64::MAX), None);
    }
}
