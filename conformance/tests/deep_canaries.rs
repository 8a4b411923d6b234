//! Adapters that are wrong only below what they show, or only in a feature, fail where it is asked for.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::adapter::{Adapter, Core};
use dsr_conformance::corpus;
use dsr_conformance::protocol::{
    AnswerDigest, AnswerFor, BytesShown, CaseBegin, Decline, Decode, Deliver, DeltaName, DigestShown, Found,
    Group, Hello, HelloReply, Hex, Load, Lookup, MadeDelta, Mutate, Read, Restart, Shown, StateShown,
};
use dsr_conformance::report::Verdict;
use dsr_conformance::run::{InProcess, run};
use serde_json::json;

/// What is wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Flaw {
    DeadUntold,
    StampsOfOne,
    LoadsAll,
    DecodesAll,
    AnswersAll,
    OneFingerprint,
    DigestOfTheSeen,
    FirstOfTheGroup,
    NamelessLookup,
    RestartForgets,
}

const ALL: [Flaw; 10] = [
    Flaw::DeadUntold,
    Flaw::StampsOfOne,
    Flaw::LoadsAll,
    Flaw::DecodesAll,
    Flaw::AnswersAll,
    Flaw::OneFingerprint,
    Flaw::DigestOfTheSeen,
    Flaw::FirstOfTheGroup,
    Flaw::NamelessLookup,
    Flaw::RestartForgets,
];

struct Broken {
    core: Core,
    flaw: Flaw,
    first: String,
}

impl Broken {
    /// A delta that says nothing.
    fn nothing(&mut self) -> Result<MadeDelta, Decline> {
        let replica = self.first.clone();
        self.core.mutate(&Mutate { replica, mutations: Vec::new() })
    }

    fn told(&self, mut state: serde_json::Value) -> serde_json::Value {
        if self.flaw == Flaw::DeadUntold {
            let store = state["store"].as_object().cloned().unwrap();
            let mut context = serde_json::Map::new();
            for dot in store.keys() {
                let (replica, sequence) = dot.split_once('.').unwrap();
                let runs = context.entry(replica).or_insert(json!(""));
                let comma = if runs == "" { "" } else { "," };
                *runs = json!(format!("{}{comma}{sequence}", runs.as_str().unwrap()));
            }
            state["context"] = context.into();
        }
        if self.flaw == Flaw::StampsOfOne {
            for record in state["store"].as_object_mut().unwrap().values_mut() {
                record.as_object_mut().unwrap().values_mut().next().unwrap()["stamp"] = json!(1);
            }
        }
        state
    }
}

macro_rules! as_the_core {
    ($($method:ident($argument:ty) -> $result:ty;)*) => {
        $(fn $method(&mut self, argument: &$argument) -> Result<$result, Decline> {
            self.core.$method(argument)
        })*
    };
}

impl Adapter for Broken {
    as_the_core! {
        hello(Hello) -> HelloReply;
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
        read(Read) -> Shown;
        resynchronise(AnswerFor) -> MadeDelta;
        encode(DeltaName) -> BytesShown;
        encode_digest(Read) -> BytesShown;
    }

    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline> {
        self.first.clone_from(&case.replicas[0]);
        self.core.begin(case)
    }

    fn group(&mut self, group: &Group) -> Result<MadeDelta, Decline> {
        match self.flaw {
            Flaw::FirstOfTheGroup => Ok(MadeDelta { delta: group.deltas[0].clone() }),
            _ => self.core.group(group),
        }
    }

    fn lookup(&mut self, lookup: &Lookup) -> Result<Found, Decline> {
        match self.flaw {
            Flaw::NamelessLookup => Ok(Found { vertex: None }),
            _ => self.core.lookup(lookup),
        }
    }

    fn restart(&mut self, restart: &Restart) -> Result<(), Decline> {
        let keeps = restart.keeps && self.flaw != Flaw::RestartForgets;
        self.core.restart(&Restart { keeps, ..restart.clone() })
    }

    fn state(&mut self, read: &Read) -> Result<StateShown, Decline> {
        let StateShown { state } = self.core.state(read)?;
        Ok(StateShown { state: self.told(state) })
    }

    fn delta(&mut self, delta: &DeltaName) -> Result<StateShown, Decline> {
        let StateShown { state } = self.core.delta(delta)?;
        Ok(StateShown { state: self.told(state) })
    }

    fn digest(&mut self, read: &Read) -> Result<DigestShown, Decline> {
        let DigestShown { mut digest } = self.core.digest(read)?;
        if self.flaw == Flaw::DigestOfTheSeen {
            digest["live"] = digest["context"].clone();
        }
        Ok(DigestShown { digest })
    }

    fn load(&mut self, load: &Load) -> Result<MadeDelta, Decline> {
        let loaded = self.core.load(load);
        if self.flaw == Flaw::LoadsAll { loaded.or_else(|_| self.nothing()) } else { loaded }
    }

    fn decode(&mut self, decode: &Decode) -> Result<MadeDelta, Decline> {
        let decoded = self.core.decode(decode);
        if self.flaw == Flaw::DecodesAll { decoded.or_else(|_| self.nothing()) } else { decoded }
    }

    fn answer_digest(&mut self, answer: &AnswerDigest) -> Result<MadeDelta, Decline> {
        let answered = self.core.answer_digest(answer);
        if self.flaw == Flaw::AnswersAll { answered.or_else(|_| self.nothing()) } else { answered }
    }

    fn fingerprint(&mut self, read: &Read) -> Result<BytesShown, Decline> {
        let shown = self.core.fingerprint(read)?;
        Ok(if self.flaw == Flaw::OneFingerprint { BytesShown { bytes: Hex(vec![7; 16]) } } else { shown })
    }
}

/// `[spec: CONF-3]` `[spec: CONF-4]` `[spec: CONF-11]`
#[test]
fn canary_what_is_wrong_below_the_view_or_in_a_feature_fails() {
    let cases = corpus::cases().unwrap();
    for flaw in ALL {
        let mut open = InProcess(move || Broken { core: Core::default(), flaw, first: String::new() });
        let report = run(&mut open, &cases);
        let failed: Vec<_> = report.results.iter().filter(|result| result.verdict == Verdict::Fail).collect();
        let others =
            report.results.iter().filter(|result| !matches!(result.verdict, Verdict::Pass | Verdict::Fail));
        assert_eq!(others.count(), 0, "{flaw:?}");
        assert!(!failed.is_empty(), "{flaw:?} passes");
        println!("{flaw:?}: {} of {} fail, first {}", failed.len(), cases.len(), failed[0].id);
    }
}
