//! The other end of the line.

use crate::adapter::Adapter;
use crate::serve::reply_line;

/// Why the conversation with an adapter cannot go on. `[spec: CONF-9]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Trouble {
    /// It ended, or could not be started.
    #[error("the adapter ended: {how}")]
    Crash {
        /// Its exit status, or why it did not start.
        how: String,
    },
    /// It did not reply in time.
    #[error("no reply within {seconds} s")]
    Timeout {
        /// The time allowed.
        seconds: u64,
    },
    /// What it wrote is no reply to the request.
    #[error("{what}")]
    Protocol {
        /// What is wrong.
        what: String,
    },
}

impl Trouble {
    pub(super) fn protocol(what: impl Into<String>) -> Self {
        Self::Protocol { what: what.into() }
    }
}

/// An adapter that has been started.
pub trait Peer {
    /// Sends a line and waits for one.
    fn exchange(&mut self, line: &str) -> Result<String, Trouble>;

    /// What it has written, or whether it has ended, without being asked; checked between cases.
    fn unasked(&mut self) -> Option<Trouble> {
        None
    }

    /// Ends its input, and lets it end.
    fn finish(&mut self) {}

    /// The last that it wrote to standard error, for people.
    fn last_words(&mut self) -> String {
        String::new()
    }
}

/// What can start an adapter, again and again.
pub trait Open {
    /// Starts one.
    fn open(&mut self) -> Result<Box<dyn Peer>, Trouble>;
}

/// Adapters in the same process, made by a function. Each line goes through the same reader and writer as over a pipe;
/// panics and endless loops are not caught here.
#[derive(Debug)]
pub struct InProcess<F>(pub F);

impl<A: Adapter + 'static, F: FnMut() -> A> Open for InProcess<F> {
    fn open(&mut self) -> Result<Box<dyn Peer>, Trouble> {
        Ok(Box::new(Here((self.0)())))
    }
}

struct Here<A>(A);

impl<A: Adapter> Peer for Here<A> {
    fn exchange(&mut self, line: &str) -> Result<String, Trouble> {
        reply_line(&mut self.0, line).map_err(|error| Trouble::protocol(error.to_string()))
    }
}
