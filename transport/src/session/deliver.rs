//! From messages to the replica. `[spec: LINK-6]`

use super::Session;
use crate::action::{Action, Cause};
use crate::message::Message;
use crate::origin::Origin;
use dsr_core::Delta;

impl Session {
    /// A message of a stream to the group: a delta, or nothing.
    pub(super) fn deliver_delta(&mut self, origin: Origin, bytes: &[u8]) {
        if let Ok(Message::Delta(delta)) = Message::decode(bytes) {
            self.stats.deltas += 1;
            self.join(&delta, Cause::Remote { origin });
        } else {
            self.cannot_decode(origin);
        }
    }

    /// A message of a stream to this session.
    pub(super) fn deliver(&mut self, from: Origin, stream: u32, number: u64, bytes: &[u8]) {
        let message = Message::decode(bytes);
        let peer = self.peers.get_mut(&from);
        let Some(incoming) = peer.and_then(|peer| peer.incoming.get_mut(&stream)) else { return };
        match message {
            Ok(Message::Delta(delta)) => {
                self.stats.pieces += 1;
                self.resync.has_learned(from);
                self.join(&delta, Cause::Repair { from });
            }
            Ok(Message::Digest(digest)) => {
                incoming.last = Some(number);
                self.answer(from, stream, &digest);
            }
            Ok(Message::End(request)) => {
                (incoming.last, incoming.answers) = (Some(number), Some(request));
            }
            Err(_) => self.cannot_decode(from),
        }
    }

    /// What cannot be read is lacking, and only a digest brings it.
    fn cannot_decode(&mut self, from: Origin) {
        self.stats.undecodable += 1;
        self.need(from);
    }

    fn join(&mut self, delta: &Delta, cause: Cause) {
        let changes = self.replica.apply(delta);
        self.print.has_changed();
        if !changes.is_empty() {
            self.actions.push_back(Action::Changed { changes, cause });
        }
    }
}
