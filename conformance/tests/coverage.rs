//! Which cases witness which clause: two for each at least, one of them concurrent.
//!
//! In scope are the chapters that bind an implementation of the graph ([`CHAPTERS`]). Claims, the checker, traces,
//! scenarios and scenes are about other programs, and the chapter on conformance is about the harness itself.
//! `cargo test -p dsr-conformance --test coverage -- --nocapture` prints the table.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::case::{Case, Step};
use dsr_conformance::corpus;
use dsr_spec::{Clause, ClauseId};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const CHAPTERS: [&str; 20] = [
    "ID", "CRASH", "VALUE", "CTX", "STATE", "WF", "JOIN", "CLOSE", "STAMP", "DICT", "MUT", "VIEW", "INV",
    "CONFLICT", "INTENT", "SYNC", "NET", "LIMIT", "ENC", "JSON",
];

/// Clauses that no case can witness, and why.
const EXEMPT: &[(&str, &str)] = &[
    ("VALUE-2", "that nothing is copied is no matter of answers"),
    ("SYNC-6", "how an answer is cut is no matter of the answer"),
    ("LIMIT-7", "a context beyond it does not fit in a line of the protocol"),
    ("LIMIT-8", "a state beyond it does not fit in a line of the protocol"),
    ("LIMIT-9", "a state beyond it does not fit in a line of the protocol"),
    ("JSON-7", "dictionaries are read by the harness, which takes sound ones only"),
    ("JSON-8", "edge keys have another form in the protocol, and authors none"),
    ("JSON-9", "mutations have another form in the protocol"),
    ("JSON-14", "of repairs the protocol has the kinds alone"),
];

/// Clauses that judge one text or one replica, so that it does not matter whether others act, and why.
const ALONE: &[(&str, &str)] = &[("ENC-7", "one value's bytes")];

/// What two cases are too many for, and why.
const ONCE: &[(&str, &str)] =
    &[("LIMIT-3", "a value beyond it does not fit in a line of the protocol; one below it does")];

/// Whether two replicas mutate without having seen each other.
fn is_concurrent(case: &Case) -> bool {
    let mut seen: BTreeMap<&str, BTreeSet<usize>> = BTreeMap::new();
    let mut carried: BTreeMap<&str, BTreeSet<usize>> = BTreeMap::new();
    let mut authors: Vec<(usize, &str)> = Vec::new();
    for (number, step) in case.steps.iter().enumerate() {
        match step {
            Step::Mutate { replica, r#as, .. } => {
                let known = seen.entry(replica).or_default();
                if authors.iter().any(|(event, author)| author != replica && !known.contains(event)) {
                    return true;
                }
                known.insert(number);
                authors.push((number, replica));
                if let Some(name) = r#as {
                    carried.insert(name, BTreeSet::from([number]));
                }
            }
            Step::Deliver { replica, delta } => {
                let events = carried.get(delta.as_str()).cloned().unwrap_or_default();
                seen.entry(replica).or_default().extend(events);
            }
            Step::Group { deltas, r#as } => {
                let events = deltas.iter().filter_map(|delta| carried.get(delta.as_str())).flatten().copied();
                let events = events.collect();
                carried.insert(r#as, events);
            }
            Step::Answer { from, r#as, .. } | Step::AnswerDigest { from, r#as, .. } => {
                carried.insert(r#as, seen.get(from.as_str()).cloned().unwrap_or_default());
            }
            Step::Restart { replica, keeps: false } => drop(seen.remove(replica.as_str())),
            _ => {}
        }
    }
    false
}

fn in_scope(clause: &Clause) -> bool {
    CHAPTERS.contains(&clause.id.chapter()) && clause.needs_witness()
}

fn listed(list: &[(&str, &str)], id: &ClauseId) -> bool {
    list.iter().any(|(listed, _)| *listed == id.to_string())
}

fn clauses() -> dsr_spec::Clauses {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    dsr_spec::trace(&dsr_spec::read_inputs(&workspace).unwrap().texts, &[]).clauses
}

/// `[spec: CONF-11]`
#[test]
fn law_every_clause_has_two_cases_and_one_that_is_concurrent() {
    let cases = corpus::cases().unwrap();
    let mut wanting = Vec::new();
    for clause in clauses().all().iter().filter(|clause| in_scope(clause)) {
        let id = clause.id.to_string();
        let citing: Vec<&Case> = cases.iter().filter(|case| case.spec.contains(&id)).collect();
        let concurrent = citing.iter().filter(|case| is_concurrent(case)).count();
        let shown: Vec<&str> = citing.iter().take(3).map(|case| case.id.as_str()).collect();
        let more = if citing.len() > 3 { " …" } else { "" };
        println!(
            "{id:<12} {:>3} cases, {concurrent:>3} concurrent: {}{more}",
            citing.len(),
            shown.join(", ")
        );
        let fault = if listed(EXEMPT, &clause.id) {
            (!citing.is_empty()).then_some("is exempt and has a case: strike it off EXEMPT")
        } else if listed(ONCE, &clause.id) {
            (citing.len() != 1).then_some("is said to have one case and has not: mend it, or ONCE")
        } else if citing.len() < 2 {
            Some("has fewer than two cases")
        } else if listed(ALONE, &clause.id) {
            (concurrent > 0)
                .then_some("is said to be of one text and has a concurrent case: strike it off ALONE")
        } else {
            (concurrent == 0).then_some("has no concurrent case")
        };
        wanting.extend(fault.map(|fault| format!("{id} {fault}")));
    }
    assert!(wanting.is_empty(), "{wanting:#?}");
}

/// `[spec: CONF-11]`
#[test]
fn law_what_is_exempt_is_a_clause_in_scope() {
    let clauses = clauses();
    for (id, why) in EXEMPT.iter().chain(ALONE).chain(ONCE) {
        let clause = id.parse().ok().and_then(|id| clauses.get(&id));
        assert!(clause.is_some_and(in_scope), "{id} ({why}) is no clause in scope");
    }
}

/// `[spec: CONF-11]`
#[test]
fn canary_a_case_is_concurrent_if_an_author_has_not_seen_another() {
    let cases = corpus::cases().unwrap();
    let found = |id: &str| cases.iter().find(|case| case.id == id).map(is_concurrent);
    assert_eq!(found("universal/delivery/twice"), Some(false));
    assert_eq!(found("universal/values/retyped"), Some(false));
    assert_eq!(found("universal/conflicts/12-same-attribute"), Some(true));
    assert_eq!(found("universal/resync/restart-twice"), Some(true));
}
