//! Writes a log while the cases are run, so that one that breaks off shows it.

use super::{CaseLine, FORMAT, Footer, Header, Line};
use crate::corpus;
use crate::expect::Expectations;
use crate::protocol::{HelloReply, PROTOCOL, Profile, Unique};
use crate::report::{CaseResult, Outcome, Report};
use crate::run::Watch;
use std::io::{self, Write};

/// Writes each line as soon as it is final. The header waits for the implementation's name, or for the end.
#[derive(Debug)]
pub struct LogWriter<'e, W> {
    output: W,
    header: Option<Header>,
    held: Vec<CaseLine>,
    expectations: Option<&'e Expectations>,
    failed: Option<io::Error>,
}

impl<'e, W: Write> LogWriter<'e, W> {
    /// A log of `cases` cases, chosen by a pattern and a profile, against a command.
    pub fn new(
        output: W,
        command: &[String],
        (only, profile): (&str, Option<Profile>),
        cases: usize,
        expectations: Option<&'e Expectations>,
    ) -> Self {
        let header = Header {
            format: FORMAT,
            protocol: PROTOCOL,
            corpus: corpus::VERSION.into(),
            spec: corpus::SPEC_VERSION.into(),
            implementation: None,
            profiles: Vec::new(),
            features: Vec::new(),
            command: command.to_vec(),
            profile,
            only: only.into(),
            cases,
        };
        Self { output, header: Some(header), held: Vec::new(), expectations, failed: None }
    }

    /// Ends the log; the first error of all writing is told here.
    pub fn finish(mut self, report: &Report, verdict: Outcome) -> io::Result<()> {
        self.begin();
        let counts = report.summary().counts;
        let counts = Unique(counts.into_iter().map(|(name, count)| (name.into(), count)).collect());
        self.line(&Line::Footer(Footer { verdict, counts }));
        self.failed.map_or_else(|| self.output.flush(), Err)
    }

    fn begin(&mut self) {
        if let Some(header) = self.header.take() {
            self.line(&Line::Header(header));
            for case in std::mem::take(&mut self.held) {
                self.line(&Line::Case(case));
            }
        }
    }

    fn line(&mut self, line: &Line) {
        if self.failed.is_none() {
            let text = serde_json::to_string(line).map_err(io::Error::other);
            let written =
                text.and_then(|text| writeln!(self.output, "{text}")).and_then(|()| self.output.flush());
            self.failed = written.err();
        }
    }
}

impl<W: Write> Watch for LogWriter<'_, W> {
    fn met(&mut self, hello: &HelloReply) {
        if let Some(header) = &mut self.header {
            header.implementation = Some(hello.implementation.clone());
            header.profiles.clone_from(&hello.profiles);
            header.features.clone_from(&hello.features);
        }
        self.begin();
    }

    fn ends(&mut self, result: &CaseResult) {
        let excuse = self.expectations.and_then(|known| known.excuse(&result.id, result.verdict));
        let case = CaseLine::of(result, excuse.map(|known| known.reason.clone()));
        if self.header.is_some() {
            self.held.push(case);
        } else {
            self.line(&Line::Case(case));
        }
    }
}
