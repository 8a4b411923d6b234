//! How a course comes to rest: what is judged of the moment after it, written down. `[spec: JOIN-5]` `[spec: SYNC-5]`

use super::{CannotHappen, Recorder};
use crate::course::Event;
use crate::semantics::{Delivery, Semantics};

impl<S: Semantics> Recorder<'_, S> {
    /// Delivers everything to everybody; if that makes all equal, it was resynchronisation that did not, and is
    /// recorded instead. Of deliveries that break a clause, only those of the replica where one does. Who shows
    /// what is broken.
    pub fn come_to_rest(&mut self) -> Result<Vec<usize>, CannotHappen> {
        let semantics = self.runner().semantics();
        let everybody: Vec<usize> = (0..self.states().len()).collect();
        if semantics.delivery() == Delivery::Once {
            // Nothing is under way: all that can be delivered was.
            return Ok(everybody);
        }
        let mut ends = self.states().to_vec();
        let mut deliveries = Vec::new();
        for (replica, end) in ends.iter_mut().enumerate() {
            for (message, sent) in self.runner().messages().iter().enumerate() {
                if sent.to.is_some() {
                    continue;
                }
                let after = semantics.join_all(end, &sent.deltas.iter().collect::<Vec<_>>());
                if after == *end {
                    continue;
                }
                deliveries.push(Event::Deliver { replica, message });
                let delivery = semantics.judge_delivery(end, &after);
                let is_broken = delivery.is_err() || semantics.judge(&after).is_err();
                *end = after;
                if is_broken {
                    let mut own = deliveries.iter().filter(|event| event.replica() == replica);
                    own.try_for_each(|event| self.record(event))?;
                    return Ok(vec![replica]);
                }
            }
        }
        if ends.iter().any(|end| *end != ends[0]) {
            deliveries.iter().try_for_each(|event| self.record(event))?;
            return Ok(everybody);
        }
        let others = 1..ends.len();
        let asks = others.clone().map(|replica| (replica, 0));
        for (replica, to) in asks.chain(others.map(|replica| (0, replica))) {
            let message = self.runner().messages().len();
            self.record(&Event::Answer { replica, to })?;
            self.record(&Event::Deliver { replica: to, message })?;
        }
        Ok(everybody)
    }
}
