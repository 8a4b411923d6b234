//! What a session has done, counted.

/// Counters of a session, from its start. Nothing is lost that is not counted here. `[spec: LINK-17]`
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Stats {
    /// Datagrams sent.
    pub sent: u64,
    /// Their bytes.
    pub sent_bytes: u64,
    /// Datagrams received and understood.
    pub received: u64,
    /// Datagrams that were refused: damaged, of others, cut off.
    pub refused: u64,
    /// Messages that were no delta, digest or end of an answer.
    pub undecodable: u64,
    /// Deltas that came by the group, joined.
    pub deltas: u64,
    /// Pieces of answers, joined.
    pub pieces: u64,
    /// Parts that came again.
    pub repeated: u64,
    /// Parts that contradict others of their message.
    pub contradicting: u64,
    /// Requests sent for what was missing.
    pub wants: u64,
    /// Requests not sent, since somebody else had asked for the same.
    pub suppressed: u64,
    /// Parts sent again.
    pub resent: u64,
    /// Times that this session said that something is gone.
    pub gone_said: u64,
    /// Times that something was lacking that was gone.
    pub gone_heard: u64,
    /// Times that something was asked for in vain, too often.
    pub given_up: u64,
    /// Parts that a buffer had no room for, peers and streams included.
    pub overflows: u64,
    /// Mutations refused since too much was waiting to be sent.
    pub busy: u64,
    /// Digests sent.
    pub digests: u64,
    /// Answers begun.
    pub answers: u64,
    /// Answers refused, since too many were under way.
    pub answers_refused: u64,
    /// Answers that came in whole.
    pub exchanges: u64,
    /// Exchanges that made no progress and were given up.
    pub stalled: u64,
    /// Exchanges with another peer after one that had brought a part of what was lacking.
    pub resumed: u64,
    /// Streams to one peer that were given up, since nothing came back.
    pub unanswered: u64,
    /// Objections to a claim of this session's agent id.
    pub objections: u64,
    /// Peers lost.
    pub lost: u64,
}

impl Stats {
    /// Every counter with its name, in the order of their declaration.
    pub fn named(&self) -> [(&'static str, u64); 26] {
        [
            ("sent", self.sent),
            ("sent bytes", self.sent_bytes),
            ("received", self.received),
            ("refused", self.refused),
            ("undecodable", self.undecodable),
            ("deltas", self.deltas),
            ("pieces", self.pieces),
            ("repeated", self.repeated),
            ("contradicting", self.contradicting),
            ("wants", self.wants),
            ("suppressed", self.suppressed),
            ("resent", self.resent),
            ("gone said", self.gone_said),
            ("gone heard", self.gone_heard),
            ("given up", self.given_up),
            ("overflows", self.overflows),
            ("busy", self.busy),
            ("digests", self.digests),
            ("answers", self.answers),
            ("answers refused", self.answers_refused),
            ("exchanges", self.exchanges),
            ("stalled", self.stalled),
            ("resumed", self.resumed),
            ("unanswered", self.unanswered),
            ("objections", self.objections),
            ("lost", self.lost),
        ]
    }

    /// Adds up the counters of two sessions.
    pub fn add(&mut self, other: &Self) {
        for (sum, (_, count)) in self.counters().into_iter().zip(other.named()) {
            *sum += count;
        }
    }

    fn counters(&mut self) -> [&mut u64; 26] {
        [
            &mut self.sent,
            &mut self.sent_bytes,
            &mut self.received,
            &mut self.refused,
            &mut self.undecodable,
            &mut self.deltas,
            &mut self.pieces,
            &mut self.repeated,
            &mut self.contradicting,
            &mut self.wants,
            &mut self.suppressed,
            &mut self.resent,
            &mut self.gone_said,
            &mut self.gone_heard,
            &mut self.given_up,
            &mut self.overflows,
            &mut self.busy,
            &mut self.digests,
            &mut self.answers,
            &mut self.answers_refused,
            &mut self.exchanges,
            &mut self.stalled,
            &mut self.resumed,
            &mut self.unanswered,
            &mut self.objections,
            &mut self.lost,
        ]
    }
}
