//! Any text into the reader of traces; what is read is drawn and run again. `[spec: TRACE-3]` `[spec: TRACE-6]`

use crate::target::{Broken, Marks, Outcome, equal, holds, variant};
use dsr_model::render::{Target, render};
use dsr_model::replay::{ReplayError, replay};
use dsr_model::trace::{Trace, TraceError};

/// More bytes than this are left to the tests: to run a long trace again takes long.
const BYTES_MAX: usize = 1 << 14;

const DRAWINGS: [Target; 6] =
    [Target::Text, Target::Mermaid, Target::MermaidBrief, Target::Svg, Target::Shiviz, Target::Rust];

/// A trace.
pub(crate) fn text(bytes: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    if bytes.len() > BYTES_MAX {
        return Ok(marks);
    }
    let Ok(text) = std::str::from_utf8(bytes) else { return Ok(marks) };
    match Trace::read(text) {
        Ok(trace) => accepted(&trace, &mut marks)?,
        Err(error) => {
            holds("TRACE-3", error.to_string().len() > 10, || format!("no explanation: {error:?}"))?;
            marks.add(match &error {
                TraceError::Unsound(fault) => format!("refused-Unsound-{}", variant(fault)),
                _ => format!("refused-{}", variant(&error)),
            });
        }
    }
    Ok(marks)
}

fn accepted(trace: &Trace, marks: &mut Marks) -> Result<(), Broken> {
    let written = serde_json::to_string(trace).map_err(|error| Broken::new("TRACE-1", error))?;
    let read =
        Trace::read(&written).map_err(|error| Broken::new("TRACE-3", format!("{error}\n{written}")))?;
    equal("TRACE-3", "a trace, and what was written of it", &read, trace)?;
    for target in DRAWINGS {
        match render(trace, target) {
            Ok(drawn) => {
                holds("TRACE-1", !drawn.is_empty(), || format!("nothing is drawn as {target:?}"))?;
                marks.add(format!("drawn-{}", variant(&target)));
            }
            Err(error) => holds("TRACE-1", error.to_string().len() > 10, || format!("{error:?}"))?,
        }
    }
    match replay(trace) {
        Ok(replayed) => {
            equal("TRACE-6", "steps that were run again", &replayed.steps, &trace.steps.len())?;
            marks.add(if replayed.judged.is_ok() { "replayed-and-judged" } else { "replayed" });
        }
        Err(ReplayError::Unsound(fault)) => {
            return Err(Broken::new("TRACE-3", format!("read, and unsound at replay: {fault}")));
        }
        Err(error) => {
            holds("TRACE-6", error.to_string().len() > 10, || format!("no explanation: {error:?}"))?;
            marks.add(format!("not-replayed-{}", variant(&error)));
        }
    }
    Ok(())
}
