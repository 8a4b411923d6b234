//! `dsr oracle random`.

use super::OracleError;
use super::whom::{Format, Whom, bar};
use crate::output::{add, out};
use dsr_oracle::fact::Kind;
use dsr_oracle::random::{RandomFound, run, tell};
use dsr_oracle::verdict::Verdict;
use serde_json::json;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Instant;

const AFTER: &str = "\
Few names, labels and values, so that everything collides; deliveries that are partial, late, repeated; whole states, old \
digests, restarts; states that nobody has made; stamps and sequences near their limits; dictionaries that differ. Every \
refusal, repair and value type has to occur, or the verdict is `vacuous`: ten thousand histories are enough for that.

Exit status: 0 agree, 1 disagree, 2 something that had to occur never did, 3 the program cannot be asked";

/// Random histories of hostile shape
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// How many histories
    #[arg(long, default_value_t = 100_000)]
    histories: u64,
    /// What decides them: history N of a seed is the same for ever
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Only the history of this number
    #[arg(long, value_name = "N")]
    only: Option<u64>,
    /// Print how often each thing occurred
    #[arg(long)]
    counts: bool,
    #[command(flatten)]
    whom: Whom,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Verdict, OracleError> {
        let started = Instant::now();
        let numbers = self.only.map_or(0..self.histories, |only| only..only.saturating_add(1));
        let bar = bar(numbers.end - numbers.start, "histories");
        let found = run(&self.whom.facts(), self.whom.jobs(), self.seed, numbers, &|more| bar.inc(more))?;
        bar.finish_and_clear();
        // One history alone need not show everything.
        let vacuous = self.only.is_none() && !found.counts.never().is_empty();
        let verdict = Verdict::of(found.compared.disagreeing.load(Relaxed) > 0, vacuous);
        let seconds = started.elapsed().as_secs_f64();
        out(&match self.whom.format {
            Format::Text => self.text(&found, verdict, seconds),
            Format::Json => self.json(&found, verdict, seconds),
        });
        Ok(verdict)
    }

    #[expect(clippy::cast_precision_loss, reason = "a rate to look at")]
    fn text(&self, found: &RandomFound, verdict: Verdict, seconds: f64) -> String {
        let mut text = String::new();
        let (counts, tally) = (&found.counts, &found.compared.tally);
        add(&mut text, format_args!("{} histories, {} events\n", counts.histories, counts.events));
        let rate = tally.total() as f64 / seconds.max(0.001);
        add(&mut text, format_args!("{} facts, {rate:.0} a second:", tally.total()));
        for kind in Kind::ALL {
            add(&mut text, format_args!(" {} {}", tally.of(kind), kind.name()));
        }
        add(&mut text, "\n");
        if self.counts || self.only.is_none() && verdict == Verdict::Vacuous {
            for (name, count) in &counts.seen {
                add(&mut text, format_args!("{count:>12}  {name}\n"));
            }
        }
        if self.only.is_none() {
            let never = counts.never();
            add(&mut text, format_args!("{} kinds of thing occurred", counts.seen.len()));
            add(&mut text, if never.is_empty() { ", all that had to\n" } else { "; never occurred:\n" });
            for name in never {
                add(&mut text, format_args!("              {name}\n"));
            }
        }
        if let Some(shrunk) = &found.shrunk {
            let (history, events) = (&shrunk.history, shrunk.history.events.len());
            let before = shrunk.events_before;
            add(
                &mut text,
                format_args!(
                    "\nhistory {}, {events} of its {before} events:\n{}\n",
                    history.number,
                    tell(history)
                ),
            );
            match &shrunk.disagreement {
                Some(disagreement) => add(&mut text, format_args!("{disagreement}\n")),
                None => add(&mut text, "asked again, the program agrees\n"),
            }
            add(&mut text, format_args!("again    {}\n", self.again(history.number)));
        }
        add(&mut text, format_args!("{verdict}, {seconds:.1} s\n"));
        text
    }

    fn again(&self, number: u64) -> String {
        format!("dsr oracle random --seed {} --only {number}{}", self.seed, self.whom.options())
    }

    fn json(&self, found: &RandomFound, verdict: Verdict, seconds: f64) -> String {
        let shrunk = found.shrunk.as_ref().map(|shrunk| {
            let disagreement = shrunk.disagreement.as_ref();
            json!({
                "number": shrunk.history.number,
                "events": shrunk.history.events.len(),
                "text": tell(&shrunk.history),
                "dictionary": disagreement.map(|found| &found.dictionary),
                "asked": disagreement.map(|found| &found.fact.line),
                "core": disagreement.map(|found| &found.fact.ours),
                "program": disagreement.map(|found| &found.theirs),
                "again": self.again(shrunk.history.number),
            })
        });
        let tally = &found.compared.tally;
        let kinds: serde_json::Map<_, _> =
            Kind::ALL.into_iter().map(|kind| (kind.name().into(), tally.of(kind).into())).collect();
        let whole = json!({
            "verdict": verdict,
            "seed": self.seed,
            "histories": found.counts.histories,
            "events": found.counts.events,
            "facts": tally.total(),
            "kinds": kinds,
            "disagreeing": found.compared.disagreeing.load(Relaxed),
            "seen": found.counts.seen,
            "never": if self.only.is_none() { found.counts.never() } else { Vec::new() },
            "shrunk": shrunk,
            "seconds": seconds,
        });
        whole.to_string() + "\n"
    }
}
