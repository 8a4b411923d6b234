//! What a case expects, compared. `[spec: CONF-7]`

use super::course::Course;
use super::invariants::broken;
use super::{Failure, Stop};
use crate::case::{Encoded, Step};
use crate::protocol::{
    AnswerDigest, BytesShown, Command, Decode, DeltaName, DigestShown, Feature, Found, Hex, Load, Lookup,
    MadeDelta, Mutate, Mutation, Read, Shown, StateShown, View,
};
use crate::report::Verdict;
use crate::run::difference::{Difference, differ, differ_in_state};
use crate::run::peer::Trouble;
use dsr_core::{Digest, State};
use serde::Deserialize;
use serde_json::Value;

impl<'c> Course<'_, 'c> {
    pub(super) fn expectation(&mut self, step: &'c Step) -> Result<(), Stop> {
        match step {
            Step::Expect { replica, view } => self.expect(replica, view),
            Step::ExpectEqual { replicas } => self.expect_equal(replicas),
            Step::ExpectRefused { replica, mutations, kind } => self.expect_refused(replica, mutations, kind),
            Step::ExpectVertex { replica, name, vertex } => {
                let lookup = Lookup { replica: replica.clone(), name: name.clone() };
                let found: Found = self.done(Command::Lookup(lookup))?;
                self.equal(vertex, &found.vertex, &format!("who has the name {name:?} at {replica}"))
            }
            Step::ExpectState { replica, state } => {
                let found: StateShown = self.done(Command::State(Read { replica: replica.clone() }))?;
                self.equal_states(state, &found.state, replica)
            }
            Step::ExpectDelta { delta, state } => {
                let name = DeltaName { delta: self.delta(delta) };
                let found: StateShown = self.done(Command::Delta(name))?;
                self.equal_states(state, &found.state, delta)
            }
            Step::ExpectDigest { replica, digest } => {
                let found: DigestShown = self.done(Command::Digest(Read { replica: replica.clone() }))?;
                let expected = self.read::<Digest>(digest, "the digest expected")?;
                let found = self.read::<Digest>(&found.digest, "the digest found")?;
                self.equal(&expected, &found, &format!("the digest of {replica}"))
            }
            Step::ExpectBytes { of, bytes } => self.expect_bytes(of, bytes),
            Step::ExpectUnloadable { state, kind } => {
                let load = Command::Load(Load { state: state.clone() });
                self.refused::<MadeDelta>(load, kind.as_deref())
            }
            Step::ExpectUndecodable { bytes, kind } => {
                let decode = Command::Decode(Decode { bytes: bytes.clone() });
                self.refused::<MadeDelta>(decode, kind.as_deref())
            }
            Step::ExpectUnanswerable { from, bytes } => {
                let answer = AnswerDigest { from: from.clone(), bytes: bytes.clone() };
                self.refused::<MadeDelta>(Command::AnswerDigest(answer), None)
            }
            _ => Ok(()),
        }
    }

    /// What a replica shows, in canonical form; it must keep the invariants. `[spec: CONF-7.1]`
    fn view(&mut self, replica: &str) -> Result<View, Stop> {
        let Shown { view } = self.done(Command::Read(Read { replica: replica.into() }))?;
        if view.repairs.is_some() != self.session.has(Feature::Repairs) {
            let what = "a view has `repairs` if and only if the feature `repairs` is announced";
            return Err(Trouble::protocol(what).into());
        }
        match broken(&view, self.case.dictionary.as_ref()) {
            None => Ok(view.canonical()),
            Some(found) => {
                let what = format!("{replica} shows a view that breaks {}: {found}", found.clause());
                let failure = Failure { broken: Some(found.clause()), ..self.failure(what) };
                Err(Stop::Verdict(Verdict::Fail, failure))
            }
        }
    }

    fn expect(&mut self, replica: &str, expected: &View) -> Result<(), Stop> {
        let mut found = self.view(replica)?;
        let mut expected = expected.clone().canonical();
        if expected.repairs.is_none() || found.repairs.is_none() {
            (expected.repairs, found.repairs) = (None, None);
        }
        self.no_difference(differ(&expected, &found), &format!("{replica} does not show what it should"))
    }

    fn expect_equal(&mut self, replicas: &[String]) -> Result<(), Stop> {
        let [first, others @ ..] = replicas else { return Ok(()) };
        let expected = self.view(first)?;
        for other in others {
            let found = self.view(other)?;
            self.no_difference(
                differ(&expected, &found),
                &format!("{first} (expected) and {other} (got) do not show the same"),
            )?;
        }
        Ok(())
    }

    fn expect_refused(&mut self, replica: &str, mutations: &[Mutation], kind: &str) -> Result<(), Stop> {
        let before = self.view(replica)?;
        let mutate = Mutate { replica: replica.into(), mutations: mutations.to_vec() };
        self.refused::<MadeDelta>(Command::Mutate(mutate), Some(kind))?;
        let after = self.view(replica)?;
        self.no_difference(differ(&before, &after), &format!("a refused mutation changes {replica}"))
    }

    fn expect_bytes(&mut self, of: &Encoded, bytes: &Hex) -> Result<(), Stop> {
        let (command, what) = match of {
            Encoded::Delta(delta) => {
                let name = DeltaName { delta: self.delta(delta) };
                (Command::Encode(name), format!("the bytes of {delta} are not what they should be"))
            }
            Encoded::Digest(replica) => {
                let read = Read { replica: replica.clone() };
                (
                    Command::EncodeDigest(read),
                    format!("the bytes of the digest of {replica} are not what they should be"),
                )
            }
            Encoded::Fingerprint(replica) => {
                let read = Read { replica: replica.clone() };
                (Command::Fingerprint(read), format!("the fingerprint of {replica} is not what it should be"))
            }
        };
        let found: BytesShown = self.done(command)?;
        if found.bytes == *bytes {
            return Ok(());
        }
        Err(self.differs(
            what,
            Difference { expected: vec![bytes.to_string()], got: vec![found.bytes.to_string()] },
        ))
    }

    fn equal_states(&self, expected: &Value, found: &Value, whose: &str) -> Result<(), Stop> {
        let expected = self.read::<State>(expected, "the state expected")?;
        let found = self.read::<State>(found, "the state found")?;
        self.no_difference(differ_in_state(&expected, &found), &format!("{whose} is not what it should be"))
    }

    fn read<T: for<'de> Deserialize<'de>>(&self, given: &Value, what: &str) -> Result<T, Stop> {
        T::deserialize(given).map_err(|error| self.failed(format!("{what} is none: {error}")))
    }

    fn equal<T: PartialEq + std::fmt::Debug>(&self, expected: &T, found: &T, what: &str) -> Result<(), Stop> {
        if expected == found {
            return Ok(());
        }
        let (expected, got) = (vec![format!("{expected:?}")], vec![format!("{found:?}")]);
        Err(self.differs(format!("{what} is not what it should be"), Difference { expected, got }))
    }

    fn no_difference(&self, difference: Option<Difference>, what: &str) -> Result<(), Stop> {
        difference.map_or(Ok(()), |difference| Err(self.differs(what.into(), difference)))
    }

    fn differs(&self, what: String, difference: Difference) -> Stop {
        let failure = Failure { difference: Some(difference), ..self.failure(what) };
        Stop::Verdict(Verdict::Fail, failure)
    }
}
