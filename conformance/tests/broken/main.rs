//! Adapters broken on purpose. The first argument says how.

use dsr_conformance::adapter::{Adapter, Core};
use dsr_conformance::protocol::{
    CaseBegin, Decline, Deliver, Done, ErrorCode, Feature, Hello, HelloReply, MadeDelta, Mutate, Mutation,
    Read, Reply, Restart, Shown,
};
use dsr_conformance::serve::serve;
use std::collections::BTreeSet;
use std::io::{self, BufRead, Read as _, Write};
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
        "liar" => serve(&mut Liar(core), input, output),
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

fn hang() -> ExitCode {
    std::thread::sleep(Duration::from_secs(600));
    ExitCode::SUCCESS
}

/// Floods standard error, and serves all the same.
fn chatter(input: impl BufRead) -> ExitCode {
    for _ in 0..20_000 {
        eprintln!("error: panic: {{\"id\": 1, \"error\": 1}} \u{1b}[31m");
    }
    let _ = io::stderr().write_all(&[0xff, 0xfe]);
    let served = serve(&mut Core::default(), input, io::stdout());
    if served.is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// A line without an end.
fn endless(mut output: impl Write) -> ExitCode {
    while output.write_all(&[b' '; 4096]).is_ok() {}
    ExitCode::FAILURE
}

/// Writes something else than the core's replies, from the middle of the victim on.
struct Mangling<W> {
    how: String,
    output: W,
    doomed: bool,
    request: u64,
}

impl<W: Write> Write for Mangling<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // `serve` writes each reply at once, then its end.
        if bytes == b"\n" {
            return if self.doomed { Ok(1) } else { self.output.write(bytes) };
        }
        self.request += 1;
        // The second argument says in which reply, counted from 1.
        self.doomed = std::env::args().nth(2).and_then(|at| at.parse().ok()) == Some(self.request);
        if !self.doomed {
            self.output.write_all(bytes)?;
            return Ok(bytes.len());
        }
        match self.how.as_str() {
            "garbage" => self.output.write_all(b"Traceback (most recent call last):\n")?,
            "hangs" => drop(hang()),
            "dies" => std::process::exit(101),
            "wrong-id" => {
                let reply = Reply::new(self.request - 1, Ok(Done {}));
                writeln!(self.output, "{}", serde_json::to_string(&reply)?)?;
            }
            "cut-off" => {
                self.output.write_all(b"{\"id\": 3, \"ok\": {\"\xc3\n")?;
            }
            "half-line" => {
                self.output.write_all(b"{\"id\": 3, ")?;
                self.output.flush()?;
                std::process::exit(0);
            }
            "deep" => writeln!(self.output, "{{\"id\": 3, \"ok\": {}", "[".repeat(100_000))?,
            "twice" => {
                self.output.write_all(bytes)?;
                self.output.write_all(b"\n")?;
                self.output.write_all(bytes)?;
                self.output.write_all(b"\n")?;
            }
            "list" => writeln!(self.output, "{{\"id\": 3, \"ok\": [\"d1\"]}}")?,
            "neither" => writeln!(self.output, "{{\"id\": {}}}", self.request)?,
            "too-long" => {
                io::copy(&mut io::repeat(b'x').take(2 << 20), &mut self.output)?;
                self.output.write_all(b"\n")?;
            }
            other => return Err(io::Error::other(format!("{other:?} is no way to be broken"))),
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}

macro_rules! as_the_core {
    ($($method:ident($argument:ty) -> $result:ty;)*) => {
        $(fn $method(&mut self, argument: &$argument) -> Result<$result, Decline> {
            self.core().$method(argument)
        })*
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
    as_the_core! {
        hello(Hello) -> HelloReply;
        mutate(Mutate) -> MadeDelta;
        restart(Restart) -> ();
        resynchronise(dsr_conformance::protocol::AnswerFor) -> MadeDelta;
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
    as_the_core! {
        hello(Hello) -> HelloReply;
        read(Read) -> Shown;
        restart(Restart) -> ();
        resynchronise(dsr_conformance::protocol::AnswerFor) -> MadeDelta;
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

/// Announces `restart` and does not have it.
struct Liar(Core);

impl Liar {
    fn core(&mut self) -> &mut Core {
        &mut self.0
    }
}

impl Adapter for Liar {
    as_the_core! {
        hello(Hello) -> HelloReply;
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
        read(Read) -> Shown;
        resynchronise(dsr_conformance::protocol::AnswerFor) -> MadeDelta;
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
    as_the_core! {
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
    }

    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline> {
        let mut reply = self.0.hello(hello)?;
        reply.features = vec!["a-feature-of-tomorrow".into()];
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
    as_the_core! {
        hello(Hello) -> HelloReply;
        begin(CaseBegin) -> ();
        mutate(Mutate) -> MadeDelta;
        deliver(Deliver) -> ();
        restart(Restart) -> ();
        resynchronise(dsr_conformance::protocol::AnswerFor) -> MadeDelta;
    }

    fn read(&mut self, _: &Read) -> Result<Shown, Decline> {
        let feature = Feature::Repairs.name();
        Err(Decline::error(ErrorCode::Internal, format!("nothing to read, nor {feature}")))
    }
}
