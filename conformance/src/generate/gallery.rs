//! Cases from the checker's gallery: the shortest schedule of each known anomaly of the published system, with the
//! outcome that this specification requires. `[spec: CONF-11]`

use super::{Builder, CannotWrite};
use crate::case::{Case, CaseFile, FORMAT, Level, Origin, Provenance, Step};
use crate::protocol::{Feature, Profile};
use dsr_core::{Dictionary, Mutation, ReplicaId};
use dsr_model::gallery::{Row, Twin, mutations_before, rows, run_row};
use dsr_model::trace::{Act, Sent};
use serde::Deserialize;
use std::collections::BTreeSet;

/// The files `universal/gallery.json` and `resolution/gallery.json`.
pub fn gallery() -> Result<[CaseFile; 2], CannotWrite> {
    let mut files = ["universal", "resolution"].map(|family| CaseFile {
        format: FORMAT,
        family: family.into(),
        topic: "gallery".into(),
        cases: Vec::new(),
    });
    for row in &rows() {
        let Some(twin) = run_row(row).checked else { continue };
        let Written { builder, all, resynchronises } = written(row, &twin)?;
        // Alone nobody is in conflict: what a single replica shows is everybody's matter.
        let [universal, resolution] = &mut files;
        if let [alone] = all[..] {
            let mut exact = builder;
            exact.expect_view(alone);
            universal.cases.push(case(row, &universal.family, exact, resynchronises));
            continue;
        }
        let (mut equal, mut exact) = (builder.clone(), builder);
        equal.expect_equal(&all);
        exact.expect_view(all[0]);
        exact.expect_equal(&all);
        universal.cases.push(case(row, &universal.family, equal, resynchronises));
        resolution.cases.push(case(row, &resolution.family, exact, resynchronises));
    }
    Ok(files)
}

fn case(row: &Row, family: &str, builder: Builder, resynchronises: bool) -> Case {
    let mut requires = Vec::new();
    if builder.steps.iter().any(|step| matches!(step, Step::Restart { .. })) {
        requires.push(Feature::Restart);
    }
    if resynchronises {
        requires.push(Feature::Resynchronisation);
    }
    let mut spec = vec![row.setup.property.clause().to_owned()];
    if spec[0] != "JOIN-5" {
        spec.push("JOIN-5".into());
    }
    Case {
        id: format!("{family}/gallery/row-{}", row.row),
        title: format!("The schedule in which, in the published system, {}", row.title),
        why: "It happens in robots that are in use; here everybody ends with the same sound graph.".into(),
        spec,
        level: Level::Must,
        profile: Profile::Observe,
        requires,
        replicas: builder.names(),
        dictionary: None,
        steps: builder.steps,
        provenance: Provenance { kind: Origin::Gallery, row: Some(row.row.into()), bound: None, rule: None },
        choice: None,
        since: None,
    }
}

struct Written {
    builder: Builder,
    /// Every replica.
    all: Vec<usize>,
    resynchronises: bool,
}

/// The schedule as the core carries it out.
fn written(row: &Row, twin: &Twin) -> Result<Written, CannotWrite> {
    let mut listed: Vec<_> =
        twin.trace.replicas.iter().map(|replica| (replica.index, &replica.name)).collect();
    let names: Vec<&str> = listed.iter().map(|(_, name)| name.as_str()).collect();
    listed.sort();
    let place = |name: &str| listed.iter().position(|(_, listed)| *listed == name).unwrap_or(0);
    let agent = |index: usize| ReplicaId::agent(u32::try_from(index).unwrap_or(u32::MAX).saturating_add(1));
    let ids: Vec<_> = listed.iter().map(|(index, _)| agent(*index)).collect();
    let mut builder = Builder::new(&ids, Dictionary::open());
    let joiner = row.setup.powers.joiner.as_ref().map(|joiner| joiner.replica);
    let before = mutations_before(row);
    if let ([first, others @ ..], false) = (names.as_slice(), before.is_empty()) {
        builder.mutate(place(first), &before, "s")?;
        for (name, _) in others.iter().zip(1..).filter(|(_, at)| Some(*at) != joiner) {
            builder.deliver(place(name), "s")?;
        }
    }
    let (mut resynchronises, mut heard, mut made) = (false, BTreeSet::new(), Vec::new());
    for step in &twin.trace.steps {
        let at = place(&step.replica);
        match &step.does {
            Act::Mutate { mutations, sends, .. } => {
                let mutations: Result<Vec<Mutation>, _> =
                    mutations.iter().map(Mutation::deserialize).collect();
                builder.mutate(at, &mutations.unwrap_or_default(), name(sends))?;
                made.push(name(sends));
                heard.insert((at, name(sends)));
            }
            Act::Deliver { message, .. } => {
                builder.deliver(at, message)?;
                heard.insert((at, message.as_str()));
            }
            Act::Restart { keeps } => {
                builder.restart(at, *keeps)?;
                let joins = joiner.is_some_and(|joiner| names.get(joiner) == Some(&step.replica.as_str()));
                if !keeps && !joins && !before.is_empty() {
                    builder.deliver(at, "s")?;
                }
            }
            Act::Answer { to, sends } => {
                resynchronises = true;
                builder.answer(at, place(to), name(sends));
            }
            Act::Lose { .. } | Act::Happen { .. } => {}
        }
    }
    // The schedule leaves out what would change nothing at the core. Others may wait for it.
    let all: Vec<_> = (0..ids.len()).collect();
    for &at in all.iter().filter(|_| !resynchronises) {
        for delta in made.iter().filter(|delta| !heard.contains(&(at, *delta))) {
            builder.deliver(at, delta)?;
        }
    }
    Ok(Written { builder, all, resynchronises })
}

fn name(sends: &[Sent]) -> &str {
    sends.first().map_or("", |sent| &sent.message)
}
