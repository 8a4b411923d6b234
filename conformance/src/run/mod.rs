//! Cases against an adapter.

mod child;
mod difference;
mod judge;
mod peer;
mod session;
mod watch;

pub use child::{ChildLimits, Program};
pub use difference::Difference;
pub use judge::{Broken, Failure, Tree, broken};
pub use peer::{InProcess, Open, Peer, Trouble};
pub use watch::{Nobody, Watch};

use crate::case::Case;
use crate::corpus;
use crate::protocol::{Hello, HelloReply, PROTOCOL};
use crate::report::{CaseResult, Report, Verdict};
use session::Session;
use std::time::Instant;

/// How often in sequence an adapter may fail to begin before the run ends.
const FAILED_STARTS_MAX: usize = 3;

/// Runs cases one after the other. An adapter that crashed, hung or broke the protocol is started anew for the next case;
/// one that does not even begin ends the run, which is then incomplete. `[spec: CONF-9]`
pub fn run(open: &mut dyn Open, cases: &[Case]) -> Report {
    run_watched(open, cases, &mut Nobody)
}

/// The same, while somebody looks on.
pub fn run_watched(open: &mut dyn Open, cases: &[Case], watch: &mut dyn Watch) -> Report {
    let mut report = Report::new(cases.len());
    let mut session: Option<Session> = None;
    let mut failed_starts = 0;
    for (at, case) in cases.iter().enumerate() {
        let sound = still_sound(session.take(), &mut report);
        if let Some(last) = report.results.last() {
            watch.ends(last);
        }
        watch.begins(at, case);
        let started = Instant::now();
        let mut at_hand = match sound.map_or_else(|| begin(open, watch), Ok) {
            Ok(session) => session,
            Err((trouble, what)) => {
                failed_starts += 1;
                let failure = Failure { what, ..Failure::default() };
                report.add(CaseResult::of(case, verdict_of(&trouble), failure, started.elapsed()));
                if failed_starts == FAILED_STARTS_MAX {
                    break;
                }
                continue;
            }
        };
        failed_starts = 0;
        report.implementation.get_or_insert_with(|| at_hand.hello.implementation.clone());
        let (verdict, failure) = match judge::judge(&mut at_hand, case, watch) {
            Ok(judged) => {
                session = Some(at_hand);
                judged
            }
            Err((trouble, step)) => {
                let what = at_hand.told(&trouble);
                (verdict_of(&trouble), Failure { step, what, ..Failure::default() })
            }
        };
        report.add(CaseResult::of(case, verdict, failure, started.elapsed()));
    }
    if let Some(session) = still_sound(session, &mut report) {
        session.finish();
    }
    if let Some(last) = report.results.last() {
        watch.ends(last);
    }
    report
}

/// The session, unless the adapter has said something or ended since its last reply: then that counts against the case
/// that it was for. `[spec: CONF-12]`
fn still_sound(session: Option<Session>, report: &mut Report) -> Option<Session> {
    let mut session = session?;
    let Some(trouble) = session.unasked() else { return Some(session) };
    if let Some(last) = report.results.last_mut() {
        let failure = Failure { what: session.told(&trouble), ..Failure::default() };
        (last.verdict, last.failure) = (verdict_of(&trouble), failure);
    }
    None
}

/// Opens an adapter and shakes hands. `[spec: CONF-3]`
fn begin(open: &mut dyn Open, watch: &mut dyn Watch) -> Result<Session, (Trouble, String)> {
    let hello = Hello {
        protocols: vec![PROTOCOL],
        spec: corpus::SPEC_VERSION.into(),
        corpus: corpus::VERSION.into(),
    };
    let peer = open.open().map_err(|trouble| {
        let what = trouble.to_string();
        (trouble, what)
    })?;
    let session = Session::begin(peer, hello, watch)?;
    watch.met(&session.hello);
    Ok(session)
}

const fn verdict_of(trouble: &Trouble) -> Verdict {
    match trouble {
        Trouble::Crash { .. } => Verdict::Crash,
        Trouble::Timeout { .. } => Verdict::Timeout,
        Trouble::Protocol { .. } => Verdict::ProtocolError,
    }
}

/// What an adapter said of itself, without running a case.
pub fn hello(open: &mut dyn Open) -> Result<HelloReply, Trouble> {
    let session = begin(open, &mut Nobody).map_err(|(trouble, _)| trouble)?;
    let hello = session.hello.clone();
    session.finish();
    Ok(hello)
}
