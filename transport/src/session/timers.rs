//! What is due, and when the next is. `[spec: LINK-2]`

use super::Session;
use crate::action::Presence;
use crate::inbox::Inbox;
use crate::origin::Origin;

impl Session {
    pub(super) fn run_timers(&mut self) {
        if self.phase.is_over() {
            return;
        }
        self.run_claim();
        self.run_lost();
        self.run_beat();
        self.run_wants();
        self.run_acks();
        self.run_probes();
        self.run_resync();
    }

    /// Peers that have said nothing for too long. `[spec: LINK-16]`
    fn run_lost(&mut self) {
        let (now, lost) = (self.now, self.config.times.lost);
        let silent = self.peers.iter().filter(|(_, peer)| peer.heard_at.saturating_add(lost) <= now);
        let silent: Vec<Origin> = silent.map(|(&origin, _)| origin).collect();
        for origin in silent {
            self.stats.lost += 1;
            self.part_with(origin, Presence::Lost);
        }
    }

    /// When [`Event::Tick`](crate::Event::Tick) is due at the latest, in the caller's time; `None` once the
    /// session is over and has nothing to say. It may lie in the past: then it is due now. O(peers).
    pub fn next_wake(&self) -> Option<u64> {
        let at = if !self.actions.is_empty() || !self.control.is_empty() {
            Some(self.now)
        } else if self.phase.is_over() {
            None
        } else {
            self.earliest()
        };
        at.map(|at| at.saturating_sub(self.skew))
    }

    fn earliest(&self) -> Option<u64> {
        let parts = self.has_parts().then(|| self.pacing.opens_at());
        let beat = self.phase.is_member().then_some(self.beats.at);
        let probes = self.outgoing.values().map(super::Outgoing::probe_at).min();
        let fixed = [parts, beat, probes, self.phase.wake(), self.resync_wake()];
        let peers = self.peers.values().filter_map(|peer| {
            let lost = Some(peer.heard_at.saturating_add(self.config.times.lost));
            let want = peer.inbox.as_ref().and_then(Inbox::want_at);
            let incoming = peer.incoming.values();
            let incoming =
                incoming.filter_map(|one| [one.inbox.want_at(), one.ack_at].into_iter().flatten().min());
            [lost, want, incoming.min()].into_iter().flatten().min()
        });
        fixed.into_iter().flatten().chain(peers).min()
    }
}
