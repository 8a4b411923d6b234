//! An adapter over lines.

use crate::adapter::{Adapter, answer};
use crate::protocol::{Answer, Decline, ErrorCode, LINE_BYTES_MAX, Reply, Request, read_strictly};
use serde::{Deserialize, Serialize};
use std::io::{self, BufRead, Read, Write};

/// Why an adapter stops before the end of its input.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The harness has gone, or the input cannot be read.
    #[error("the connection broke: {0}")]
    Io(#[from] io::Error),
    /// A line is too long.
    #[error("request {number} has more than {LINE_BYTES_MAX} bytes: send less in one line")]
    TooLong {
        /// Counted from 1.
        number: usize,
    },
    /// A line is no request and has no id to reply to.
    #[error("line {number} is no request ({why}): send {{\"id\": …, \"do\": {{…}}}}")]
    NoRequest {
        /// Counted from 1.
        number: usize,
        /// What is wrong with it.
        why: serde_json::Error,
    },
    /// The reply cannot be written as JSON.
    #[error("the reply to line {number} cannot be written: {why}")]
    NoReply {
        /// Counted from 1.
        number: usize,
        /// Why.
        why: serde_json::Error,
    },
}

/// Replies to each line of `input` by one line of `output`, flushed, until its end. `[spec: CONF-1]`
/// `[spec: CONF-2]`
pub fn serve(
    adapter: &mut dyn Adapter,
    mut input: impl BufRead,
    mut output: impl Write,
) -> Result<(), ServeError> {
    for number in 1.. {
        let mut line = Vec::new();
        let longest = LINE_BYTES_MAX as u64 + 1;
        if input.by_ref().take(longest).read_until(b'\n', &mut line)? == 0 {
            break;
        }
        if line.last() != Some(&b'\n') && line.len() > LINE_BYTES_MAX {
            return Err(ServeError::TooLong { number });
        }
        let reply = reply_to(adapter, &line).map_err(|why| ServeError::NoRequest { number, why })?;
        let text = serde_json::to_string(&reply).map_err(|why| ServeError::NoReply { number, why })?;
        output.write_all(text.as_bytes())?;
        output.write_all(b"\n")?;
        output.flush()?;
    }
    Ok(())
}

/// The reply to one line; an error if the line has no id to reply to.
fn reply_to(adapter: &mut dyn Adapter, line: &[u8]) -> Result<Reply<Answer>, serde_json::Error> {
    #[derive(Serialize, Deserialize)]
    struct Numbered {
        id: u64,
    }

    let text = std::str::from_utf8(line).map_err(serde::de::Error::custom)?;
    match read_strictly::<Request>(text) {
        Ok(request) => Ok(Reply::new(request.id, answer(adapter, &request.r#do))),
        Err(why) => {
            let Numbered { id } = read_strictly(text)?;
            Ok(Reply::new(id, Err(Decline::error(ErrorCode::RejectedInput, why.to_string()))))
        }
    }
}

/// The line that `serve` would write, for an adapter in the same process.
pub(crate) fn reply_line(adapter: &mut dyn Adapter, line: &str) -> Result<String, serde_json::Error> {
    serde_json::to_string(&reply_to(adapter, line.as_bytes())?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core_adapter::Core;

    /// `[spec: CONF-2]`
    #[test]
    fn regress_a_list_is_no_request_and_has_no_id() {
        for line in ["[7]", "[18446744073709551615]", "[7, {\"hello\": {}}]", "7", "null"] {
            let mut output = Vec::new();
            let ended = serve(&mut Core::default(), line.as_bytes(), &mut output);
            assert!(matches!(ended, Err(ServeError::NoRequest { number: 1, .. })), "{line}");
            assert!(output.is_empty(), "{line}");
        }
        let mut output = Vec::new();
        assert!(serve(&mut Core::default(), &b"{\"id\": 7, \"do\": [5]}"[..], &mut output).is_ok());
        assert!(output.starts_with(b"{\"id\":7,\"error\":"));
    }
}
