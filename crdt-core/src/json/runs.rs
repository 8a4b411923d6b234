//! Sets of dots: `{"r1": "1-5,7"}`, each replica once, its runs ascending and maximal. `[spec: JSON-11]`

use super::map::UniqueMap;
use super::number::decimal;
use crate::context::{CausalContext, Run};
use crate::dot::ReplicaId;
use crate::limits;
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write as _;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Ascending, maximal runs.
pub(super) struct Runs(pub(super) Vec<Run>);

impl Serialize for Runs {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut texts: BTreeMap<ReplicaId, String> = BTreeMap::new();
        for &Run { replica, first, last } in &self.0 {
            let text = texts.entry(replica).or_default();
            let comma = if text.is_empty() { "" } else { "," };
            let written = if first == last {
                write!(text, "{comma}{first}")
            } else {
                write!(text, "{comma}{first}-{last}")
            };
            written.map_err(serde::ser::Error::custom)?;
        }
        texts.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Runs {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let texts: UniqueMap<ReplicaId, String> = UniqueMap::deserialize(deserializer)?;
        let mut runs = Vec::new();
        for (replica, text) in texts.0 {
            read(replica, &text, &mut runs).ok_or_else(|| {
                D::Error::custom(format_args!(
                    "{replica}: {text:?} is not ascending, maximal runs of sequences such as \"1-5,7\""
                ))
            })?;
        }
        Ok(Self(runs))
    }
}

/// Appends the runs of one replica, or `None` if the text is not their one spelling.
fn read(replica: ReplicaId, text: &str, runs: &mut Vec<Run>) -> Option<()> {
    // The least sequence that the next run may begin with: one that touches its neighbour is not maximal.
    let mut least = 1;
    for part in text.split(',') {
        let (start, end) = match part.split_once('-') {
            None => (decimal(part)?, decimal(part)?),
            Some((start, end)) => (decimal(start)?, decimal(end)?),
        };
        let is_one_spelling = part.contains('-') == (start < end);
        if start < least || !is_one_spelling {
            return None;
        }
        runs.push(Run { replica, first: start, last: end });
        least = end.saturating_add(2);
    }
    Some(())
}

impl Serialize for CausalContext {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Runs(self.runs().collect()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for CausalContext {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut context = Self::new();
        let mut beyond_gaps = 0_usize;
        for run in Runs::deserialize(deserializer)?.0 {
            if run.first > 1 {
                beyond_gaps = beyond_gaps.saturating_add(1);
            }
            if run.last > limits::SEQUENCE_MAX {
                return Err(D::Error::custom(format_args!(
                    "{} up to {}: allowed are {} [LIMIT-6]",
                    run.replica,
                    run.last,
                    limits::SEQUENCE_MAX
                )));
            }
            if beyond_gaps > limits::CLOUD_RUNS_MAX {
                return Err(D::Error::custom(format_args!(
                    "a context names over {} runs beyond gaps [LIMIT-7]",
                    limits::CLOUD_RUNS_MAX
                )));
            }
            context.insert_run(run);
        }
        Ok(context)
    }
}
