//! Raw bytes into the binary decoders: what is accepted is canonical and does no harm, what is refused is
//! explained. `[spec: ENC-1]` `[spec: ENC-10]`

use crate::laws;
use crate::target::{Broken, Marks, Outcome, equal, holds, variant};
use dsr_core::{
    DecodeError, State, check_digest, decode, decode_digest, delta_for, digest, encode, encode_digest,
};

/// A state or a delta.
pub(crate) fn state(bytes: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    match decode(bytes) {
        Ok(state) => {
            marks.add(if state.is_empty() { "accepted-empty" } else { "accepted" });
            laws::context_marks(&state, &mut marks);
            equal("ENC-1", "bytes, and the bytes of what they spell", &bytes, &&encode(&state)[..])?;
            laws::of_state(&state)?;
        }
        Err(error) => refused(&error, &mut marks)?,
    }
    Ok(marks)
}

/// A digest; what is accepted is answered by a state that has seen some of it.
pub(crate) fn digest_bytes(bytes: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    match decode_digest(bytes) {
        Ok(theirs) => {
            marks.add(if theirs.live.is_empty() { "accepted-nothing-lives" } else { "accepted" });
            let known = State::assemble([], theirs.context.clone());
            laws::context_marks(&known, &mut marks);
            equal("ENC-11", "bytes, and the bytes of what they spell", &bytes, &&encode_digest(&theirs)[..])?;
            equal("ENC-11", "a decoded digest", &check_digest(&theirs), &Ok(()))?;
            // Whoever has seen all of it and holds nothing answers with the death of what lives there.
            let delta = delta_for(&known, &theirs);
            equal(
                "SYNC-3",
                "the dots that died",
                &digest(&delta).context.runs().collect::<Vec<_>>(),
                &theirs.live,
            )?;
            laws::json_round_trip("JSON-13", &theirs)?;
        }
        Err(error) => refused(&error, &mut marks)?,
    }
    Ok(marks)
}

/// An error says what is wrong.
fn refused(error: &DecodeError, marks: &mut Marks) -> Result<(), Broken> {
    holds("ENC-10", error.to_string().len() > 10, || format!("no explanation: {error:?}"))?;
    marks.add(match error {
        DecodeError::Malformed(fault) => format!("refused-Malformed-{}", fault.kind()),
        DecodeError::MalformedDigest(fault) => format!("refused-MalformedDigest-{}", variant(fault)),
        DecodeError::TooGreat { what, .. } => format!("refused-TooGreat-{}", what.replace(' ', "-")),
        _ => format!("refused-{}", variant(error)),
    });
    Ok(())
}
