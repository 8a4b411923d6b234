//! One case. `[spec: CONF-9]`

use super::difference::differ;
use super::peer::Trouble;
use super::session::{Session, words};
use crate::case::{Case, Step};
use crate::protocol::{
    AnswerFor, CaseBegin, Command, Decline, Deliver, Done, ErrorCode, Feature, MadeDelta, Mutate, Mutation,
    Nothing, Read, Restart, Shown, View,
};
use crate::report::Verdict;
use std::collections::BTreeMap;

/// Why a case stops before its end.
enum Stop {
    Verdict(Verdict, String),
    Trouble(Trouble),
}

impl From<Trouble> for Stop {
    fn from(trouble: Trouble) -> Self {
        Self::Trouble(trouble)
    }
}

/// Runs a case; `Err` if the conversation cannot go on.
pub(super) fn judge(session: &mut Session, case: &Case) -> Result<(Verdict, String), Trouble> {
    if let Some(why) = unsupported(session, case) {
        return Ok((Verdict::Unsupported, why));
    }
    let mut course = Course { session, deltas: BTreeMap::new() };
    let verdict = match course.carry_out(case) {
        Ok(()) => (Verdict::Pass, String::new()),
        Err(Stop::Verdict(verdict, detail)) => (verdict, detail),
        Err(Stop::Trouble(trouble)) => return Err(trouble),
    };
    let ended = session.ask::<Done>(Command::CaseEnd(Nothing {}), None)?;
    match ended {
        Err(decline) if verdict.0 == Verdict::Pass => {
            Ok((Verdict::Error, format!("case_end: {}", words(&decline))))
        }
        _ => Ok(verdict),
    }
}

/// What the adapter lacks for a case. `[spec: CONF-3]`
fn unsupported(session: &Session, case: &Case) -> Option<String> {
    if let Some(feature) = case.requires.iter().find(|feature| !session.has(**feature)) {
        return Some(format!("needs the feature {}", feature.name()));
    }
    let (needed, allowed) = (case.replicas.len(), session.hello.limits.replicas);
    if needed > allowed {
        return Some(format!("needs {needed} replicas; the adapter takes {allowed}"));
    }
    let mutations = case.steps.iter().filter_map(|step| match step {
        Step::Mutate { replica, mutations, .. } | Step::ExpectRefused { replica, mutations, .. } => {
            Some(Command::Mutate(Mutate { replica: replica.clone(), mutations: mutations.clone() }))
        }
        _ => None,
    });
    let fits = std::iter::once(begin(case)).chain(mutations).all(|command| session.takes(&command));
    (!fits).then(|| format!("has a line of more than {} bytes", session.hello.limits.line_bytes))
}

fn begin(case: &Case) -> Command {
    Command::CaseBegin(CaseBegin {
        case: case.id.clone(),
        replicas: case.replicas.clone(),
        dictionary: case.dictionary.clone(),
    })
}

struct Course<'s, 'c> {
    session: &'s mut Session,
    /// The adapter's name for each delta that the case names.
    deltas: BTreeMap<&'c str, String>,
}

impl<'c> Course<'_, 'c> {
    fn carry_out(&mut self, case: &'c Case) -> Result<(), Stop> {
        let needs = case.dictionary.as_ref().map(|_| Feature::Dictionary);
        self.done::<Done>(begin(case), needs, "case_begin")?;
        for (step, number) in case.steps.iter().zip(1..) {
            self.step(step, &format!("step {number}"))?;
        }
        Ok(())
    }

    fn step(&mut self, step: &'c Step, at: &str) -> Result<(), Stop> {
        match step {
            Step::Mutate { replica, mutations, r#as } => {
                let mutate = Mutate { replica: replica.clone(), mutations: mutations.clone() };
                let made: MadeDelta = self.done(Command::Mutate(mutate), None, at)?;
                if let Some(name) = r#as {
                    self.deltas.insert(name, made.delta);
                }
                Ok(())
            }
            Step::Deliver { replica, delta } => {
                let delta = self.deltas.get(delta.as_str()).cloned().unwrap_or_default();
                let deliver = Deliver { replica: replica.clone(), delta };
                self.done::<Done>(Command::Deliver(deliver), None, at).map(drop)
            }
            Step::Restart { replica, keeps } => {
                let restart = Restart { replica: replica.clone(), keeps: *keeps };
                self.done::<Done>(Command::Restart(restart), Some(Feature::Restart), at).map(drop)
            }
            Step::Answer { from, to, r#as } => {
                let answer = AnswerFor { from: from.clone(), to: to.clone() };
                let made: MadeDelta =
                    self.done(Command::Answer(answer), Some(Feature::Resynchronisation), at)?;
                self.deltas.insert(r#as, made.delta);
                Ok(())
            }
            Step::Expect { replica, view } => self.expect(replica, view, at),
            Step::ExpectEqual { replicas } => self.expect_equal(replicas, at),
            Step::ExpectRefused { replica, mutations, kind } => {
                self.expect_refused(replica, mutations, kind, at)
            }
        }
    }

    /// A request that must succeed.
    fn done<T: serde::de::DeserializeOwned + serde::Serialize>(
        &mut self,
        command: Command,
        needs: Option<Feature>,
        at: &str,
    ) -> Result<T, Stop> {
        self.session.ask(command, needs)?.map_err(|decline| {
            let verdict = match &decline {
                Decline::Skip(_) => Verdict::Skip,
                Decline::Error(error) if error.code == ErrorCode::Refused => Verdict::Fail,
                Decline::Error(_) => Verdict::Error,
            };
            Stop::Verdict(verdict, format!("{at}: {}", words(&decline)))
        })
    }

    /// What a replica shows, in canonical form.
    fn view(&mut self, replica: &str, at: &str) -> Result<View, Stop> {
        let Shown { view } = self.done(Command::Read(Read { replica: replica.into() }), None, at)?;
        if view.repairs.is_some() != self.session.has(Feature::Repairs) {
            let what =
                format!("{at}: a view has `repairs` if and only if the feature `repairs` is announced");
            return Err(Trouble::protocol(what).into());
        }
        Ok(view.canonical())
    }

    fn expect(&mut self, replica: &str, expected: &View, at: &str) -> Result<(), Stop> {
        let mut found = self.view(replica, at)?;
        let mut expected = expected.clone().canonical();
        if expected.repairs.is_none() || found.repairs.is_none() {
            (expected.repairs, found.repairs) = (None, None);
        }
        differ(&expected, &found).map_or(Ok(()), |what| {
            Err(failed(format!("{at}: {replica} does not show what it should: {what}")))
        })
    }

    fn expect_equal(&mut self, replicas: &[String], at: &str) -> Result<(), Stop> {
        let [first, others @ ..] = replicas else { return Ok(()) };
        let expected = self.view(first, at)?;
        for other in others {
            let found = self.view(other, at)?;
            if let Some(what) = differ(&expected, &found) {
                return Err(failed(format!("{at}: {first} (expected) and {other} (found) differ: {what}")));
            }
        }
        Ok(())
    }

    fn expect_refused(
        &mut self,
        replica: &str,
        mutations: &[Mutation],
        kind: &str,
        at: &str,
    ) -> Result<(), Stop> {
        let before = self.view(replica, at)?;
        let mutate = Mutate { replica: replica.into(), mutations: mutations.to_vec() };
        match self.session.ask::<MadeDelta>(Command::Mutate(mutate), None)? {
            Ok(_) => return Err(failed(format!("{at}: {replica} accepts what it must refuse with {kind}"))),
            Err(Decline::Error(error)) if error.code == ErrorCode::Refused => {
                if self.session.has(Feature::ErrorKinds) && error.kind.as_deref() != Some(kind) {
                    let found = error.kind.as_deref().unwrap_or("no kind");
                    return Err(failed(format!("{at}: refused with {found}, not with {kind}")));
                }
            }
            Err(decline @ Decline::Skip(_)) => {
                return Err(Stop::Verdict(Verdict::Skip, format!("{at}: {}", words(&decline))));
            }
            Err(decline) => return Err(Stop::Verdict(Verdict::Error, format!("{at}: {}", words(&decline)))),
        }
        let after = self.view(replica, at)?;
        differ(&before, &after)
            .map_or(Ok(()), |what| Err(failed(format!("{at}: a refused mutation changes {replica}: {what}"))))
    }
}

const fn failed(detail: String) -> Stop {
    Stop::Verdict(Verdict::Fail, detail)
}
