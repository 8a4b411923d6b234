//! From queues to datagrams. `[spec: LINK-1]` `[spec: LINK-10]`

use super::Session;
use crate::action::Action;
use crate::origin::Destination;
use crate::wire::{GROUP_STREAM, HEADER_BYTES, Item, PART_BYTES, begin, finish};

impl Session {
    /// Queues what controls. What there is no room for is said again when it is asked for again, or due again.
    pub(super) fn say(&mut self, to: Destination, item: Item) {
        if self.control.len() < self.config.bounds.control {
            self.control.push_back((to, item));
        } else {
            self.stats.overflows += 1;
        }
    }

    /// The next datagram: what controls, then small messages, then parts of large ones and of answers in turn.
    pub(super) fn next_datagram(&mut self) -> Option<Action> {
        self.run_leave();
        self.pacing.fill(self.now);
        let mut out = begin(self.me, self.config.group);
        let destination = self.write_control(&mut out);
        let open = self.pacing.is_open() && !self.phase.is_over();
        let to = match destination {
            Some(to) => {
                if to == Destination::Group && open {
                    self.write_small(&mut out);
                }
                to
            }
            None if open => {
                self.write_small(&mut out);
                if out.len() > HEADER_BYTES { Destination::Group } else { self.write_parts(&mut out)? }
            }
            None => return None,
        };
        let bytes = finish(out, self.config.group);
        self.pacing.spend(bytes.len());
        self.stats.sent += 1;
        self.stats.sent_bytes += bytes.len() as u64;
        Some(Action::Send { to, bytes })
    }

    /// As much of what controls as fits, all for one destination.
    fn write_control(&mut self, out: &mut Vec<u8>) -> Option<Destination> {
        let max = self.config.bounds.datagram_bytes;
        let mut destination = None;
        while let Some((to, item)) = self.control.front_mut() {
            if destination.is_some_and(|destination| destination != *to) {
                break;
            }
            let before = out.len();
            item.write(out);
            if out.len() > max {
                out.truncate(before);
                if before > HEADER_BYTES {
                    break;
                }
                // Alone too long: half of what is asked for is asked for later.
                if let Item::Want { missing, .. } = item
                    && missing.len() > 1
                {
                    missing.truncate(missing.len() / 2);
                } else if let Item::Want { missing, .. } = item
                    && let Some(only) = missing.first_mut()
                    && only.parts.len() > 1
                {
                    only.parts.truncate(only.parts.len() / 2);
                } else {
                    self.control.pop_front();
                }
                continue;
            }
            destination = Some(*to);
            self.control.pop_front();
        }
        destination
    }

    /// As many messages of one part as fit.
    fn write_small(&mut self, out: &mut Vec<u8>) {
        if !self.phase.is_member() {
            return;
        }
        while let Some(bytes) = self.outbox.small_bytes() {
            if out.len() + bytes + PART_BYTES
                > self.config.bounds.datagram_bytes.max(HEADER_BYTES + PART_BYTES + 64)
            {
                break;
            }
            let Some(part) = self.outbox.take_small() else { break };
            Item::Part(part).write(out);
        }
        self.trim();
    }

    fn trim(&mut self) {
        self.outbox.trim(self.config.bounds.kept_bytes, self.config.bounds.kept_messages);
    }

    /// A part of the stream whose turn it is: of an answer, or of a large message to the group.
    fn write_parts(&mut self, out: &mut Vec<u8>) -> Option<Destination> {
        let window = self.config.bounds.window_bytes;
        let turn = self.turn;
        let after = self.outgoing.range(turn.saturating_add(1)..).map(|(&stream, _)| stream);
        let before = self.outgoing.range(..=turn).map(|(&stream, _)| stream);
        let order: Vec<u32> = after.chain([GROUP_STREAM]).chain(before).collect();
        for stream in order {
            let (part, to) = if stream == GROUP_STREAM {
                (self.outbox.take_large(true), Destination::Group)
            } else {
                let Some(outgoing) = self.outgoing.get_mut(&stream) else { continue };
                let Some(peer) = self.peers.get(&outgoing.to) else { continue };
                let fresh = outgoing.is_open(window);
                if fresh {
                    outgoing.refill();
                }
                (outgoing.outbox.take_next(fresh), Destination::Peer(peer.address))
            };
            if let Some(part) = part {
                self.turn = stream;
                Item::Part(part).write(out);
                self.trim();
                return Some(to);
            }
        }
        None
    }

    /// Whether a datagram waits that pacing may hold back.
    pub(super) fn has_parts(&self) -> bool {
        let window = self.config.bounds.window_bytes;
        let own = self.phase.is_member() && (self.outbox.has_fresh() || self.outbox.has_again());
        own || self.outgoing.values().any(|outgoing| outgoing.has_something(window))
    }
}
