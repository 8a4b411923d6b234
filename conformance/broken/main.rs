//! Adapters broken on purpose. The first argument says how.

mod lines;
mod more;

use dsr_conformance::adapter::{Adapter, Core};
use dsr_conformance::protocol::{
    AnswerDigest, AnswerFor, BytesShown, CaseBegin, Decline, Decode, Deliver, DeltaName, DigestShown,
    ErrorCode, Feature, Found, Group, Hello, HelloReply, Limits, Load, Lookup, MadeDelta, Mutate, Mutation,
    Read, Restart, Shown, StateShown,
};
use dsr_conformance::serve::serve;
use lines::{Mangling, chatter, deaf, endless, hang};
use more::{Contextless, Slow, Unordered};
use std::collections::BTreeSet;
use std::io;
use std::process::ExitCode;
use std::time::Duration;

fn main() -> ExitCode {
    let how = std::env::args().nth(1).unwrap_or_default();
    let core = Core::default();
    let (input, output) = (io::stdin().lock(), io::stdout());
    let served = match how.as_str() {
        "sound" => serve(&mut { core }, input, output),
        "dead" => return ExitCode::from(7),
        "silent" => return hang(),
        "chatty" => return chatter(input),
        "endless-line" => return endless(output),
        "twice-delivered" => {
            serve(&mut Counting { core, seen: BTreeSet::new(), twice: BTreeSet::new() }, input, output)
        }
        "forgets-removals" => serve(&mut Forgetful { core, removals: BTreeSet::new() }, input, output),
        "empty-answers" => serve(&mut Mean(core), input, output),
        "few-replicas" => serve(&mut Small(core, Limits { line_bytes: 1 << 20, replicas: 2 }), input, output),
        "short-lines" => serve(&mut Small(core, Limits { line_bytes: 300, replicas: 9 }), input, output),
        "liar" => serve(&mut Liar(core), input, output),
        "contextless" => serve(&mut Contextless(core), input, output),
        "unordered" => serve(&mut Unordered(core, 0), input, output),
        "slow" => serve(&mut Slow(core, Duration::from_millis(300)), input, output),
        "too-slow" => serve(&mut Slow(core, Duration::from_secs(600)), input, output),
        "deaf" => return deaf(input),
        "errs" => serve(&mut Errs(core), input, output),
        "modest" => serve(&mut Modest(core), input, output),
        _ => serve(&mut { core }, input, Mangling { how, output, doomed: false, request: 0 }),
    };
    match served {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

macro_rules! as_the_core {
    ($($method:ident($argument:ty) -> $result:ty;)*) => {
        $(fn $method(&mut self, argument: &$argument) -> Result<$result, Decline> {
            self.core().$method(argument)
        })*
    };
}

macro_rules! and_the_rest_too {
    () => {
        as_the_core! {
            group(Group) -> MadeDelta;
            lookup(Lookup) -> Found;
            state(Read) -> StateShown;
            delta(DeltaName) -> StateShown;
            digest(Read) -> DigestShown;
            load(Load) -> MadeDelta;
            encode(DeltaName) -> BytesShown;
            encode_digest(Read) -> BytesShown;
            fingerprint(Read) -> BytesShown;
            decode(Decode) -> MadeDelta;
            answer_digest(AnswerDigest) -> MadeDelta;
        }
    };
}

/// Shows an edge twice that arrived twice: a join that is not idempotent.
struct Counting {
    core: Core,
    seen: BTreeSet<(String, String)>,
    twice: BTreeSet<String>,
}

impl Counting {
    fn core(&mut self) -> &mut Core {
        &mut self.core
    }
}

impl Adapter for Counting {
    and_the_rest_too!();
    as_the_core! {
        hello(Hello) -> HelloReply;
        mutate(Mutate) -> MadeDelta;
        restart(Restart) -> ();
        resynchronise(AnswerFor) -> MadeDelta;
    }

    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline> {
        self.seen.clear();
        self.twice.clear();
        self.core.begin(case)
    }

    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline> {
        if !self.seen.insert((deliver.replica.clone(), deliver.delta.clone())) {
            self.twice.insert(deliver.replica.clone());
        }
        self.core.deliver(deliver)
    }

    fn read(&mut self, read: &Read) -> Result<Shown, Decline> {
        let mut shown = self.core.read(read)?;
        if self.twice.contains(&read.replica) {
            shown.view.edges.extend(shown.view.edges.clone());
        }
        Ok(shown)
    }
}

/// Drops what removes a vertex when it arrives.
struct Forgetful {
    core: Core,
    removals: BTreeSet<String>,
}

impl Forgetful {
    fn core(&mut self) -> &mut Core {
        &mut self.core
    }
}

impl Adapter for Forgetful {
    and_the_rest_too!();
    as_the_core! {
        hello(Hello) -> HelloReply;
        read(Read) -> Shown;
        restart(Restart) -> ();
        resynchronise(AnswerFor) -> MadeDelta;
    }

    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline> {
        self.removals.clear();
        self.core.begin(case)
    }

    fn mutate(&mut self, mutate: &Mutate) -> Result<MadeDelta, Decline> {
        let made = self.core.mutate(mutate)?;
        if mutate.mutations.iter().any(|mutation| matches!(mutation, Mutation::RemoveVertex { .. })) {
            self.removals.insert(made.delta.clone());
        }
        Ok(made)
    }

    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline> {
        if self.removals.contains(&deliver.delta) { Ok(()) } else { self.core.deliver(deliver) }
    }
}

/// Answers everybody with nothing.
struct Mean(Core);

impl Mean {
    fn core(&mut self) -> &mut Core {
        &mut self.0
    }
}

impl Adapter for Mean {
    and_the_rest_too!();
    as_the_core! {
        hello(Hello) -> HelloReply;
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
        read(Read) -> Shown;
        restart(Restart) -> ();
    }

    fn resynchronise(&mut self, answer: &AnswerFor) -> Result<MadeDelta, Decline> {
        self.0.mutate(&Mutate { replica: answer.from.clone(), mutations: Vec::new() })
    }
}

/// Takes little, and says so.
struct Small(Core, Limits);

impl Small {
    fn core(&mut self) -> &mut Core {
        &mut self.0
    }
}

impl Adapter for Small {
    and_the_rest_too!();
    as_the_core! {
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
        read(Read) -> Shown;
        restart(Restart) -> ();
        resynchronise(AnswerFor) -> MadeDelta;
    }

    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline> {
        let reply = self.0.hello(hello)?;
        Ok(HelloReply { limits: self.1, ..reply })
    }
}

/// Announces `restart` and does not have it.
struct Liar(Core);

impl Liar {
    fn core(&mut self) -> &mut Core {
        &mut self.0
    }
}

impl Adapter for Liar {
    and_the_rest_too!();
    as_the_core! {
        hello(Hello) -> HelloReply;
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
        read(Read) -> Shown;
        resynchronise(AnswerFor) -> MadeDelta;
    }
}

/// Has no feature and says so; skips every delivery.
struct Modest(Core);

impl Modest {
    fn core(&mut self) -> &mut Core {
        &mut self.0
    }
}

impl Adapter for Modest {
    and_the_rest_too!();
    as_the_core! {
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
    }

    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline> {
        let mut reply = self.0.hello(hello)?;
        reply.features = vec!["a-feature-of-tomorrow".into()];
        reply.profiles = vec!["observe".into(), "a-profile-of-tomorrow".into()];
        Ok(reply)
    }

    fn deliver(&mut self, _: &Deliver) -> Result<(), Decline> {
        let skip = dsr_conformance::protocol::Skip { reason: "no network".into(), feature: None };
        Err(Decline::Skip(skip))
    }

    fn read(&mut self, read: &Read) -> Result<Shown, Decline> {
        let mut shown = self.0.read(read)?;
        shown.view.repairs = None;
        Ok(shown)
    }
}

/// Cannot read.
struct Errs(Core);

impl Errs {
    fn core(&mut self) -> &mut Core {
        &mut self.0
    }
}

impl Adapter for Errs {
    and_the_rest_too!();
    as_the_core! {
        hello(Hello) -> HelloReply;
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
        restart(Restart) -> ();
        resynchronise(AnswerFor) -> MadeDelta;
    }

    fn read(&mut self, _: &Read) -> Result<Shown, Decline> {
        let feature = Feature::Repairs.name();
        Err(Decline::error(ErrorCode::Internal, format!("nothing to read, nor {feature}")))
    }
}
