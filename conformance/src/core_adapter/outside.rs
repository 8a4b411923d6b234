//! States that come as JSON from whomever. `[spec: JSON-2]` `[spec: JSON-12]`

use crate::protocol::Unique;
use dsr_core::{CausalContext, Dot, Record, State, check_well_formed};
use serde::Deserialize;
use serde_json::Value;

/// Reads a state; or says why it is none, with the fault's kind if it is a matter of well-formedness.
pub(super) fn state(given: &Value) -> Result<State, (String, Option<String>)> {
    State::deserialize(given).map_err(|error| (error.to_string(), fault(given)))
}

/// What is wrong with a text that has the form of a state.
fn fault(given: &Value) -> Option<String> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Form {
        context: CausalContext,
        store: Unique<Record>,
    }

    let form = Form::deserialize(given).ok()?;
    let records = form.store.0.into_iter().map(|(dot, record)| Some((dot.parse::<Dot>().ok()?, record)));
    let state = State::assemble(records.collect::<Option<Vec<_>>>()?, form.context);
    check_well_formed(&state).err().map(|malformed| malformed.kind().into())
}
