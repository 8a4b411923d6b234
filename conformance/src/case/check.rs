//! What the types of a case file cannot say.

use super::{Case, CaseFile, Encoded, FORMAT, Step};
use crate::protocol::{Feature, Mutation, Need, Profile, ROOT};
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
    if let Err(wrong) = wrong_header(file, cases) {
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

fn wrong_header(file: &str, cases: &CaseFile) -> Result<(), Wrong> {
    if cases.format != FORMAT {
        return Err((format!("format {} is not known", cases.format), "this reader knows format 1"));
    }
    let profile = match cases.family.as_str() {
        "universal" | "resolution" => Profile::Observe,
        "causal" => Profile::Causal,
        "wire" => Profile::Wire,
        family => {
            let remedy = "the families are universal, resolution, causal and wire";
            return Err((format!("there is no family {family:?}"), remedy));
        }
    };
    if let Some(case) = cases.cases.iter().find(|case| case.profile != profile) {
        let what = format!("{:?} has the profile {}", case.id, case.profile.name());
        return Err((
            what,
            "cases of universal and resolution observe; those of causal and wire have these profiles",
        ));
    }
    if file != format!("{}/{}.json", cases.family, cases.topic) {
        let what = format!("the file has family {:?} and topic {:?}", cases.family, cases.topic);
        return Err((what, "name it <family>/<topic>.json"));
    }
    if cases.cases.is_empty() {
        return Err(("there is no case".into(), "write one, or delete the file"));
    }
    Ok(())
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
        let dictionary = case.dictionary.iter().map(|_| Need::Feature(Feature::Dictionary));
        for need in dictionary.chain(case.steps.iter().filter_map(need_of)) {
            announces(case, need)?;
        }
        for (step, number) in case.steps.iter().zip(1..) {
            self.step(step, &replicas)
                .map_err(|(what, remedy)| (format!("step {number} of {:?}: {what}", case.id), remedy))?;
        }
        if case.steps.iter().any(Step::expects) {
            Ok(())
        } else {
            Err(("nothing is expected".into(), "add a step whose name begins with `expect`"))
        }
    }

    fn step(&mut self, step: &'c Step, replicas: &BTreeSet<&str>) -> Result<(), Wrong> {
        if let Some(unknown) = step.replicas().into_iter().find(|name| !replicas.contains(name)) {
            return Err((format!("there is no replica {unknown:?}"), "list it in `replicas`"));
        }
        match step {
            Step::Mutate { mutations, r#as, .. } => {
                for mutation in mutations {
                    self.bind(mutation)?;
                }
                r#as.as_deref().map_or(Ok(()), |name| self.name(name))
            }
            Step::Answer { r#as, .. }
            | Step::Load { r#as, .. }
            | Step::Decode { r#as, .. }
            | Step::AnswerDigest { r#as, .. } => self.name(r#as),
            Step::Group { deltas, .. } if deltas.len() < 2 => {
                Err(("fewer than two deltas are grouped".into(), "name two or more"))
            }
            Step::Group { deltas, r#as } => {
                deltas.iter().try_for_each(|delta| self.is_named(delta))?;
                self.name(r#as)
            }
            Step::Deliver { delta, .. }
            | Step::ExpectDelta { delta, .. }
            | Step::ExpectBytes { of: Encoded::Delta(delta), .. } => self.is_named(delta),
            Step::ExpectEqual { replicas } if replicas.len() < 2 => {
                Err(("fewer than two replicas are compared".into(), "name two or more"))
            }
            _ => Ok(()),
        }
    }

    fn is_named(&self, delta: &str) -> Result<(), Wrong> {
        if self.deltas.contains(delta) {
            Ok(())
        } else {
            Err((format!("no step before names the delta {delta:?}"), "give a step before it `as`"))
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

/// Whether a case requires what it needs.
fn announces(case: &Case, need: Need) -> Result<(), Wrong> {
    match need {
        Need::Feature(feature) if !case.requires.contains(&feature) => {
            Err((format!("a step needs the feature {:?}", feature.name()), "add it to `requires`"))
        }
        Need::Profile(profile) if case.profile < profile => {
            Err((format!("a step needs the profile {:?}", profile.name()), "make it the case's `profile`"))
        }
        _ => Ok(()),
    }
}

/// What a step asks of an adapter. `[spec: CONF-4]`
const fn need_of(step: &Step) -> Option<Need> {
    match step {
        Step::Mutate { .. }
        | Step::Deliver { .. }
        | Step::Expect { .. }
        | Step::ExpectEqual { .. }
        | Step::ExpectRefused { .. } => None,
        Step::Restart { .. } => Some(Need::Feature(Feature::Restart)),
        Step::Answer { .. } => Some(Need::Feature(Feature::Resynchronisation)),
        Step::Group { .. } => Some(Need::Feature(Feature::Grouping)),
        Step::ExpectVertex { .. } => Some(Need::Feature(Feature::Lookup)),
        Step::Load { .. }
        | Step::ExpectState { .. }
        | Step::ExpectDelta { .. }
        | Step::ExpectDigest { .. }
        | Step::ExpectUnloadable { .. } => Some(Need::Profile(Profile::Causal)),
        Step::Decode { .. }
        | Step::AnswerDigest { .. }
        | Step::ExpectBytes { .. }
        | Step::ExpectUndecodable { .. }
        | Step::ExpectUnanswerable { .. } => Some(Need::Profile(Profile::Wire)),
    }
}
