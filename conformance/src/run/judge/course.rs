//! The steps of a case, carried out. `[spec: CONF-4]`

use super::{Failure, Stop, begin};
use crate::case::{Case, Step};
use crate::protocol::{
    AnswerDigest, AnswerFor, Command, Decline, Decode, Deliver, Done, ErrorCode, Group, Load, MadeDelta,
    Mutate, Restart,
};
use crate::report::Verdict;
use crate::run::session::{Session, words};
use crate::run::watch::Watch;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;

pub(super) struct Course<'s, 'c> {
    pub(super) session: &'s mut Session,
    pub(super) case: &'c Case,
    watch: &'s mut dyn Watch,
    /// The adapter's name for each delta that the case names.
    deltas: BTreeMap<&'c str, String>,
    step: usize,
}

impl<'s, 'c> Course<'s, 'c> {
    pub(super) const fn new(session: &'s mut Session, case: &'c Case, watch: &'s mut dyn Watch) -> Self {
        Self { session, case, watch, deltas: BTreeMap::new(), step: 0 }
    }

    pub(super) fn carry_out(&mut self) -> Result<(), Stop> {
        self.done::<Done>(begin(self.case))?;
        for step in &self.case.steps {
            self.step += 1;
            self.watch.step(self.step, step);
            if step.expects() { self.expectation(step) } else { self.event(step) }?;
        }
        Ok(())
    }

    /// The step at hand, counted from 1.
    pub(super) const fn number(&self) -> usize {
        self.step
    }

    fn event(&mut self, step: &'c Step) -> Result<(), Stop> {
        let (command, name) = match step {
            Step::Mutate { replica, mutations, r#as } => {
                let mutate = Mutate { replica: replica.clone(), mutations: mutations.clone() };
                (Command::Mutate(mutate), r#as.as_deref())
            }
            Step::Group { deltas, r#as } => {
                let deltas = deltas.iter().map(|delta| self.delta(delta)).collect();
                (Command::Group(Group { deltas }), Some(r#as.as_str()))
            }
            Step::Answer { from, to, r#as } => {
                let answer = AnswerFor { from: from.clone(), to: to.clone() };
                (Command::Answer(answer), Some(r#as.as_str()))
            }
            Step::Load { state, r#as } => (Command::Load(Load { state: state.clone() }), Some(r#as.as_str())),
            Step::Decode { bytes, r#as } => {
                (Command::Decode(Decode { bytes: bytes.clone() }), Some(r#as.as_str()))
            }
            Step::AnswerDigest { from, bytes, r#as } => {
                let answer = AnswerDigest { from: from.clone(), bytes: bytes.clone() };
                (Command::AnswerDigest(answer), Some(r#as.as_str()))
            }
            Step::Deliver { replica, delta } => {
                let deliver = Deliver { replica: replica.clone(), delta: self.delta(delta) };
                return self.done::<Done>(Command::Deliver(deliver)).map(drop);
            }
            Step::Restart { replica, keeps } => {
                let restart = Restart { replica: replica.clone(), keeps: *keeps };
                return self.done::<Done>(Command::Restart(restart)).map(drop);
            }
            _ => return Ok(()),
        };
        let made: MadeDelta = self.done(command)?;
        if let Some(name) = name {
            self.deltas.insert(name, made.delta);
        }
        Ok(())
    }

    /// The adapter's name for a delta; the reader of the case has seen to it that there is one.
    pub(super) fn delta(&self, name: &str) -> String {
        self.deltas.get(name).cloned().unwrap_or_default()
    }

    /// A request that must succeed.
    pub(super) fn done<T: DeserializeOwned + Serialize>(&mut self, command: Command) -> Result<T, Stop> {
        self.session.ask(command, self.watch)?.map_err(|decline| self.declined(&decline))
    }

    /// A request that must be refused, with this kind if kinds are told and one is given; `Err` otherwise.
    pub(super) fn refused<T: DeserializeOwned + Serialize>(
        &mut self,
        command: Command,
        kind: Option<&str>,
    ) -> Result<(), Stop> {
        let error = match self.session.ask::<T>(command, self.watch)? {
            Ok(_) => {
                let with = kind.map(|kind| format!(" with {kind}")).unwrap_or_default();
                return Err(self.failed(format!("accepts what it must refuse{with}")));
            }
            Err(Decline::Error(error)) if error.code == ErrorCode::Refused => error,
            Err(decline) => return Err(self.declined(&decline)),
        };
        match (kind, error.kind.as_deref()) {
            (Some(kind), found) if self.session.tells_kinds() && found != Some(kind) => {
                let found = found.unwrap_or("no kind");
                Err(self.failed(format!("refused with {found}, not with {kind}: {}", error.message)))
            }
            _ => Ok(()),
        }
    }

    fn declined(&self, decline: &Decline) -> Stop {
        let verdict = match decline {
            Decline::Skip(_) => Verdict::Skip,
            Decline::Error(error) if error.code == ErrorCode::Refused => Verdict::Fail,
            Decline::Error(_) => Verdict::Error,
        };
        Stop::Verdict(verdict, self.failure(words(decline)))
    }

    pub(super) fn failed(&self, what: String) -> Stop {
        Stop::Verdict(Verdict::Fail, self.failure(what))
    }

    pub(super) const fn failure(&self, what: String) -> Failure {
        Failure { step: self.step, broken: None, what, difference: None }
    }
}
