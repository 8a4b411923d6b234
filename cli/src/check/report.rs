//! The result for people: runs, clauses, witnesses, and what it does and does not mean.

use super::about::About;
use crate::output::add;
use dsr_model::verdict::{PropertyKind, PropertyReport, RunReport, Verdict};
use std::collections::{BTreeMap, BTreeSet};

/// The whole report.
pub(super) fn text(runs: &[RunReport], verdict: Verdict, seconds: f64, about: &About) -> String {
    let mut text = String::new();
    add_runs(&mut text, runs);
    add_clauses(&mut text, runs);
    add_witnesses(&mut text, runs);
    add_traces(&mut text, runs);
    add_box(&mut text, runs, verdict, seconds);
    add_about(&mut text, about);
    text
}

fn add_runs(text: &mut String, runs: &[RunReport]) {
    let width = runs.iter().map(|run| run.name.chars().count()).max().unwrap_or(0).max(4);
    add(
        text,
        format_args!(
            "{:<8} {:<width$} {:>5} {:>4} {:>10} {:>11} {:>9} {:>6} {:>7}  verdict\n",
            "layer", "run", "focus", "ops", "unique", "generated", "judged", "s", "1000/s"
        ),
    );
    for run in runs {
        add(
            text,
            format_args!(
                "{:<8} {:<width$} {:>5} {:>4} {:>10} {:>11} {:>9} {:>6.1} {:>7}  {}{}\n",
                run.layer,
                run.name,
                or_dash(run.focus),
                or_dash(run.operations),
                run.states.unique,
                run.states.generated,
                run.states.judged,
                run.seconds,
                rate(run),
                run.verdict,
                if run.second_engine.is_some() { ", both engines" } else { "" },
            ),
        );
        let remarkable = run.verdict != Verdict::Exhaustive;
        for note in run.notes.iter().filter(|_| remarkable) {
            add(text, format_args!("{:<8} {note}\n", ""));
        }
    }
}

fn or_dash(count: usize) -> String {
    if count == 0 { "-".into() } else { count.to_string() }
}

/// What all runs together say of one clause.
struct ClauseLine<'r> {
    claim: &'r str,
    what: &'r str,
    verdict: Verdict,
    runs: usize,
    judged: u64,
    layers: Vec<&'r str>,
    /// The shortest, with its steps.
    trace: Option<(usize, &'r str)>,
}

fn add_clauses(text: &mut String, runs: &[RunReport]) {
    let mut clauses: BTreeMap<(&str, &str), ClauseLine<'_>> = BTreeMap::new();
    let always = |property: &&PropertyReport| property.kind == PropertyKind::Always;
    let stopped = |run: &RunReport, property: &PropertyReport| {
        run.verdict == Verdict::Violated && property.verdict == Verdict::Bounded
    };
    // What another clause has stopped says something of a clause only if nothing else does.
    let told: BTreeSet<&str> = runs
        .iter()
        .flat_map(|run| run.properties.iter().filter(always).filter(|property| !stopped(run, property)))
        .map(|property| &*property.clause)
        .collect();
    for run in runs {
        let counts = |property: &&PropertyReport| {
            always(property) && !(stopped(run, property) && told.contains(&*property.clause))
        };
        for property in run.properties.iter().filter(counts) {
            let group = if run.layer == "scenario" { run.name.as_str() } else { "" };
            let line = clauses.entry((group, &property.clause)).or_insert(ClauseLine {
                claim: &property.claim,
                what: &property.what,
                verdict: Verdict::Exhaustive,
                runs: 0,
                judged: 0,
                layers: Vec::new(),
                trace: None,
            });
            line.verdict = line.verdict.max(property.verdict);
            line.runs += 1;
            line.judged += run.states.judged;
            if line.claim.is_empty() {
                line.claim = &property.claim;
            }
            if !line.layers.contains(&run.layer.as_str()) {
                line.layers.push(&run.layer);
            }
            let steps =
                run.traces.iter().find(|trace| trace.clause == property.clause).map(|trace| trace.steps);
            let trace = steps.zip(property.trace.as_deref());
            line.trace = [line.trace, trace].into_iter().flatten().min_by_key(|(steps, _)| *steps);
        }
    }
    add(
        text,
        format_args!(
            "\n{:<6} {:<22} {:<11} {:>4} {:>12}  what must always hold\n",
            "claim", "clause", "verdict", "runs", "states"
        ),
    );
    let mut last = "";
    for ((group, clause), line) in clauses {
        if group != last {
            add(text, format_args!("scenario {group}\n"));
            last = group;
        }
        let claim = if line.claim.is_empty() { "-" } else { line.claim };
        add(
            text,
            format_args!(
                "{claim:<6} {clause:<22} {:<11} {:>4} {:>12}  {} ({})\n",
                line.verdict,
                line.runs,
                line.judged,
                line.what,
                line.layers.join(", ")
            ),
        );
        if let Some((steps, trace)) = line.trace {
            add(text, format_args!("{:<6} counterexample, {steps} steps: {trace}\n", ""));
        }
    }
}

/// States that the first engine found in a second, in thousands, where there were enough to tell.
fn rate(run: &RunReport) -> String {
    const ENOUGH: u64 = 10_000;
    if !matches!(&*run.layer, "L1" | "L2") || run.states.unique < ENOUGH {
        return "-".into();
    }
    #[expect(clippy::cast_precision_loss, reason = "a rate to look at")]
    let unique = run.states.unique as f64;
    format!("{:.0}", unique / run.search_seconds / 1000.0)
}

fn add_witnesses(text: &mut String, runs: &[RunReport]) {
    let mut seen: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for run in runs {
        for property in run.properties.iter().filter(|property| property.kind == PropertyKind::Sometimes) {
            let counts = seen.entry(&property.clause).or_default();
            counts.0 += usize::from(property.verdict == Verdict::Exhaustive);
            counts.1 += 1;
        }
    }
    add(text, "\nseen (runs that saw it / runs that had to or did)\n");
    for (witness, (saw, asked)) in seen {
        let mut its =
            runs.iter().flat_map(|run| &run.properties).filter(|property| property.clause == witness);
        let file = its.find_map(|property| property.trace.as_deref()).unwrap_or_default();
        let line = format!("  {witness:<58} {saw}/{asked}  {file}");
        add(text, format_args!("{}\n", line.trim_end()));
    }
}

fn add_traces(text: &mut String, runs: &[RunReport]) {
    let mut told: BTreeMap<&str, &str> = BTreeMap::new();
    for run in runs {
        let way = if run.layer == "L3" { "shrunk" } else { "shortest" };
        for trace in &run.traces {
            if let Some(before) = told.get(&*trace.text) {
                let line =
                    format!("\n{} {}: breaks {} as {before} does\n", run.layer, run.name, trace.clause);
                add(text, line);
                continue;
            }
            told.insert(&trace.text, &run.name);
            add(
                text,
                format_args!(
                    "\n{} {}: a {way} way to break {}\n{}\n",
                    run.layer, run.name, trace.clause, trace.text
                ),
            );
        }
    }
}

fn add_box(text: &mut String, runs: &[RunReport], verdict: Verdict, seconds: f64) {
    let unique: u64 = runs.iter().map(|run| run.states.unique).sum();
    let judged: u64 = runs.iter().map(|run| run.states.judged).sum();
    add(text, format_args!("\n── verdict: {verdict} ──────────────────────────────────────────────\n"));
    add(
        text,
        format_args!(
            "{} runs, {unique} states, {judged} replica states judged, {seconds:.1} s\n",
            runs.len()
        ),
    );
    add_histories(text, runs);
    add_engines(text, runs);
}

fn add_about(text: &mut String, about: &About) {
    let lists = [
        ("assumed", about.assumed),
        ("not checked", about.not_checked),
        ("not applicable", about.not_applicable),
    ];
    for (title, lines) in lists.into_iter().filter(|(_, lines)| !lines.is_empty()) {
        add(text, format_args!("{title}:\n"));
        for line in lines {
            add(text, format_args!("  · {line}\n"));
        }
    }
}

/// What the judged states of L1 stand for.
fn add_histories(text: &mut String, runs: &[RunReport]) {
    let sum = |count: fn(&RunReport) -> u64| -> u64 {
        runs.iter().filter(|run| run.layer == "L1").map(count).sum()
    };
    let subsets = sum(|run| run.states.subsets);
    if subsets > 0 {
        let (judged, sampled) = (sum(|run| run.states.judged), sum(|run| run.states.sampled));
        let line = format!(
            "L1: {subsets} delivered subsets of histories have {judged} shapes; each was judged, and {sampled} more to try that\n"
        );
        add(text, line);
    }
}

/// Whether every count was made twice, and what that leaves open.
fn add_engines(text: &mut String, runs: &[RunReport]) {
    let searched = runs.iter().filter(|run| matches!(&*run.layer, "L1" | "L2"));
    let (twice, once): (Vec<_>, Vec<_>) = searched.partition(|run| run.second_engine.is_some());
    if !twice.is_empty() {
        add(text, format_args!("both engines agree on the counts of {} runs\n", twice.len()));
    }
    if !once.is_empty() {
        let chance: f64 = once.iter().map(|run| run.collision_bound).sum();
        let line = format!(
            "{} runs by one engine: a fingerprint collision may have hidden a state with a chance of at most {chance:.1e}\n",
            once.len()
        );
        add(text, line);
    }
}
