//! Who looks on while cases are run.

use crate::case::{Case, Step};
use crate::protocol::HelloReply;
use crate::report::CaseResult;

/// Is told what happens in a run; each method does nothing unless it is overridden.
pub trait Watch {
    /// A case begins; `at` counts from 0.
    fn begins(&mut self, _at: usize, _case: &Case) {}
    /// An adapter has come through the handshake.
    fn met(&mut self, _hello: &HelloReply) {}
    /// A step begins, counted from 1.
    fn step(&mut self, _number: usize, _step: &Step) {}
    /// A request is sent.
    fn sent(&mut self, _line: &str) {}
    /// A line came in reply; it is not judged yet.
    fn came(&mut self, _line: &str) {}
    /// A case is judged, finally.
    fn ends(&mut self, _result: &CaseResult) {}
}

/// Nobody looks on.
#[derive(Clone, Copy, Debug)]
pub struct Nobody;

impl Watch for Nobody {}
