//! What the types of a case file cannot say.

use super::{Case, CaseFile, FORMAT, Step};
use crate::protocol::{Feature, Mutation, ROOT};
use std::collections::BTreeSet;

/// What is wrong with a file.
pub(super) struct Fault {
    /// The case, counted from 0; `None` if it is the file.
    pub(super) case: Option<usize>,
    pub(super) what: String,
    pub(super) remedy: String,
}

type Wrong = (String, &'static str);

/// The first fault.
pub(super) fn fault(file: &str, cases: &CaseFile) -> Option<Fault> {
    let of_file = |(what, remedy): Wrong| Fault { case: None, what, remedy: remedy.into() };
    if let Some(wrong) = wrong_header(file, cases) {
        return Some(of_file(wrong));
    }
    let mut ids = BTreeSet::new();
    for (number, case) in cases.cases.iter().enumerate() {
        let mut judged = Judged::default();
        let fresh = if ids.insert(&case.id) {
            Ok(())
        } else {
            Err((format!("the id {:?} stands twice", case.id), "give each case an id of its own"))
        };
        let found = fresh.and_then(|()| wrong_id(cases, case)).and_then(|()| judged.case(case));
        if let Err((what, remedy)) = found {
            return Some(Fault { case: Some(number), what, remedy: remedy.into() });
        }
    }
    None
}

fn wrong_header(file: &str, cases: &CaseFile) -> Option<Wrong> {
    if cases.format != FORMAT {
        return Some((format!("format {} is not known", cases.format), "this reader knows format 1"));
    }
    if file != format!("{}/{}.json", cases.family, cases.topic) {
        let what = format!("the file has family {:?} and topic {:?}", cases.family, cases.topic);
        return Some((what, "name it <family>/<topic>.json"));
    }
    cases.cases.is_empty().then(|| ("there is no case".into(), "write one, or delete the file"))
}

fn wrong_id(cases: &CaseFile, case: &Case) -> Result<(), Wrong> {
    let slug = case.id.strip_prefix(&format!("{}/{}/", cases.family, cases.topic)).unwrap_or_default();
    let is_plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
    if slug.is_empty() || !slug.bytes().all(is_plain) {
        let remedy = "write <family>/<topic>/<slug>, the slug of lower-case letters, digits and hyphens";
        return Err((format!("the id {:?} is not one of this file", case.id), remedy));
    }
    if case.spec.is_empty() {
        return Err(("no clause is cited".into(), "name in `spec` what the case witnesses"));
    }
    Ok(())
}

/// What a case has named so far.
#[derive(Default)]
struct Judged<'c> {
    deltas: BTreeSet<&'c str>,
    handles: BTreeSet<&'c str>,
}

impl<'c> Judged<'c> {
    fn case(&mut self, case: &'c Case) -> Result<(), Wrong> {
        let replicas: BTreeSet<&str> = case.replicas.iter().map(String::as_str).collect();
        if replicas.is_empty() || replicas.len() != case.replicas.len() {
            return Err(("replicas are missing or stand twice".into(), "name each replica once"));
        }
        let requires: BTreeSet<Feature> = case.requires.iter().copied().collect();
        let needed = case.dictionary.iter().map(|_| Feature::Dictionary);
        for feature in needed.chain(case.steps.iter().filter_map(feature_of)) {
            if !requires.contains(&feature) {
                let what = format!("a step needs the feature {:?}", feature.name());
                return Err((what, "add it to `requires`"));
            }
        }
        for (step, number) in case.steps.iter().zip(1..) {
            self.step(step, &replicas)
                .map_err(|(what, remedy)| (format!("step {number} of {:?}: {what}", case.id), remedy))?;
        }
        let expects = |step: &Step| {
            matches!(step, Step::Expect { .. } | Step::ExpectEqual { .. } | Step::ExpectRefused { .. })
        };
        if case.steps.iter().any(expects) {
            Ok(())
        } else {
            Err(("nothing is expected".into(), "add a step `expect`, `expect_equal` or `expect_refused`"))
        }
    }

    fn step(&mut self, step: &'c Step, replicas: &BTreeSet<&str>) -> Result<(), Wrong> {
        if let Some(unknown) = replicas_of(step).into_iter().find(|name| !replicas.contains(name)) {
            return Err((format!("there is no replica {unknown:?}"), "list it in `replicas`"));
        }
        match step {
            Step::Mutate { mutations, r#as, .. } => {
                for mutation in mutations {
                    self.bind(mutation)?;
                }
                r#as.as_deref().map_or(Ok(()), |name| self.name(name))
            }
            Step::Answer { r#as, .. } => self.name(r#as),
            Step::Deliver { delta, .. } if !self.deltas.contains(delta.as_str()) => {
                Err((format!("no step before names the delta {delta:?}"), "give a step before it `as`"))
            }
            Step::ExpectEqual { replicas } if replicas.len() < 2 => {
                Err(("fewer than two replicas are compared".into(), "name two or more"))
            }
            _ => Ok(()),
        }
    }

    fn name(&mut self, delta: &'c str) -> Result<(), Wrong> {
        if self.deltas.insert(delta) {
            Ok(())
        } else {
            Err((format!("the delta {delta:?} is named twice"), "give each delta a name of its own"))
        }
    }

    fn bind(&mut self, mutation: &'c Mutation) -> Result<(), Wrong> {
        match mutation {
            Mutation::AddVertex { r#as, .. } if r#as == ROOT || !self.handles.insert(r#as) => {
                Err((format!("the handle {as:?} is bound already"), "give each vertex a handle of its own"))
            }
            _ => Ok(()),
        }
    }
}

const fn feature_of(step: &Step) -> Option<Feature> {
    match step {
        Step::Restart { .. } => Some(Feature::Restart),
        Step::Answer { .. } => Some(Feature::Resynchronisation),
        _ => None,
    }
}

fn replicas_of(step: &Step) -> Vec<&str> {
    match step {
        Step::Mutate { replica, .. }
        | Step::Deliver { replica, .. }
        | Step::Restart { replica, .. }
        | Step::Expect { replica, .. }
        | Step::ExpectRefused { replica, .. } => vec![replica],
        Step::Answer { from, to, .. } => vec![from, to],
        Step::ExpectEqual { replicas } => replicas.iter().map(String::as_str).collect(),
    }
}
