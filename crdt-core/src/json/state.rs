//! States and deltas, and digests. `[spec: JSON-12]` `[spec: JSON-13]`
//!
//! ```json
//! {"context": {"r1": "1-5,7"}, "store": {"r1.1": {"vertex": {…}}}}
//! {"context": {"r1": "1-5,7"}, "live": {"r1": "1"}}
//! ```

use super::map::UniqueMap;
use super::runs::Runs;
use crate::codec::check_digest;
use crate::context::CausalContext;
use crate::digest::Digest;
use crate::dot::Dot;
use crate::limits;
use crate::record::Record;
use crate::state::State;
use crate::wellformed::check_well_formed;
use serde::de::Error;
use serde::ser::{SerializeMap, SerializeStruct};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The records, by dot.
struct Store<'a>(&'a State);

impl Serialize for Store<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (dot, record) in self.0.records() {
            map.serialize_entry(&dot, record)?;
        }
        map.end()
    }
}

impl Serialize for State {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut form = serializer.serialize_struct("State", 2)?;
        form.serialize_field("context", self.context())?;
        form.serialize_field("store", &Store(self))?;
        form.end()
    }
}

#[derive(Deserialize)]
#[serde(rename = "State", deny_unknown_fields)]
struct StateForm {
    context: CausalContext,
    store: UniqueMap<Dot, Record>,
}

impl<'de> Deserialize<'de> for State {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let form = StateForm::deserialize(deserializer)?;
        if form.store.0.len() > limits::RECORDS_MAX {
            return Err(D::Error::custom(format_args!("over {} records [LIMIT-8]", limits::RECORDS_MAX)));
        }
        let state = State::assemble(form.store.0, form.context);
        check_well_formed(&state).map_err(D::Error::custom)?;
        Ok(state)
    }
}

impl Serialize for Digest {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut form = serializer.serialize_struct("Digest", 2)?;
        form.serialize_field("context", &self.context)?;
        form.serialize_field("live", &Runs(self.live.clone()))?;
        form.end()
    }
}

#[derive(Deserialize)]
#[serde(rename = "Digest", deny_unknown_fields)]
struct DigestForm {
    context: CausalContext,
    live: Runs,
}

impl<'de> Deserialize<'de> for Digest {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let form = DigestForm::deserialize(deserializer)?;
        let digest = Self { context: form.context, live: form.live.0 };
        check_digest(&digest).map_err(D::Error::custom)?;
        Ok(digest)
    }
}
