//! What a replica does: a script of steps, or anything within an alphabet. `[spec: SCEN-4]` `[spec: SCEN-6]`

use super::cursor::{Cursor, Read};
use super::error::Fault;
use super::mutation::NamedMutation;
use super::predicate::{Atoms, Predicate};
use super::scope::Scope;
use dsr_core::MutationKind;
use std::collections::BTreeSet;

/// The most steps of a script.
const STEPS_MAX: usize = 32;
/// The most repetitions of a step.
pub(super) const REPEAT_MAX: u64 = 8;
/// The most mutations of one step.
const GROUP_MAX: usize = 8;
/// The greatest budget.
const BUDGET_MAX: u64 = 4;

/// One agent on its own copy.
#[derive(Clone, Debug)]
pub(super) struct Replica {
    pub(super) name: String,
    pub(super) conduct: Conduct,
}

/// What a replica does.
#[derive(Clone, Debug)]
pub(super) enum Conduct {
    Script(Vec<ScriptStep>),
    Free { kinds: BTreeSet<MutationKind>, budget: u32 },
}

/// One step of a script. `[spec: SCEN-4]`
#[derive(Clone, Debug)]
pub(super) struct ScriptStep {
    pub(super) when: Option<Predicate>,
    /// Made as one delta; empty for a step that only waits. `[spec: SCEN-5]`
    pub(super) mutations: Vec<NamedMutation>,
    pub(super) otherwise: Otherwise,
    pub(super) refused: Otherwise,
    pub(super) repeat: u32,
}

/// What happens where a step cannot be taken. `[spec: SCEN-4.1]`
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Otherwise {
    Wait,
    Skip,
    Stop,
}

const OTHERWISE: &[(&str, Otherwise)] =
    &[("wait", Otherwise::Wait), ("skip", Otherwise::Skip), ("stop", Otherwise::Stop)];

impl Replica {
    pub(super) fn read(cursor: &Cursor<'_>, scope: &Scope, atoms: &mut Atoms) -> Read<Self> {
        let object = cursor.object(&["name", "about", "script", "alphabet", "budget"])?;
        let name = object.need("name")?.title()?.to_owned();
        if let Some(about) = object.get("about") {
            about.text()?;
        }
        let conduct = match (object.get("script"), object.get("alphabet"), object.get("budget")) {
            (Some(script), None, None) => {
                let steps = script.list("script", 1, STEPS_MAX)?;
                Conduct::Script(
                    steps.iter().map(|step| ScriptStep::read(step, scope, atoms)).collect::<Read<_>>()?,
                )
            }
            (None, Some(alphabet), budget) => {
                let Some(budget) = budget else {
                    return cursor.fault(Fault::Needs { field: "alphabet", needed: "a `budget`" });
                };
                let budget = u32::try_from(budget.whole(1, BUDGET_MAX)?).unwrap_or(u32::MAX);
                Conduct::Free { kinds: read_kinds(&alphabet)?, budget }
            }
            (None, None, Some(_)) => {
                return cursor.fault(Fault::Needs { field: "budget", needed: "an `alphabet`" });
            }
            (Some(_), None, Some(_)) => {
                return cursor
                    .fault(Fault::Needs { field: "budget", needed: "an `alphabet`; a script has none:" });
            }
            (script, ..) => {
                let found = if script.is_some() { 2 } else { 0 };
                return cursor.fault(Fault::NotOneOf { allowed: &["script", "alphabet"], found });
            }
        };
        Ok(Self { name, conduct })
    }

    /// Mutations that a replica makes at most; a group counts as one.
    pub(super) fn mutations_max(&self) -> usize {
        match &self.conduct {
            Conduct::Script(steps) => {
                let repeats =
                    steps.iter().filter(|step| !step.mutations.is_empty()).map(|step| step.repeat as usize);
                repeats.sum()
            }
            Conduct::Free { budget, .. } => *budget as usize,
        }
    }
}

pub(super) fn read_kinds(cursor: &Cursor<'_>) -> Read<BTreeSet<MutationKind>> {
    let mut kinds = BTreeSet::new();
    for item in cursor.list("alphabet", 1, MutationKind::ALL.len())? {
        let name = item.text()?;
        let Some(kind) = MutationKind::from_name(name) else {
            let allowed = MutationKind::ALL.map(MutationKind::name).to_vec();
            return item.fault(Fault::UnknownWord { word: name.into(), allowed });
        };
        if !kinds.insert(kind) {
            return item.fault(Fault::Repeated { what: "mutation in this alphabet", name: name.into() });
        }
    }
    Ok(kinds)
}

impl ScriptStep {
    fn read(cursor: &Cursor<'_>, scope: &Scope, atoms: &mut Atoms) -> Read<Self> {
        let object = cursor.object(&["note", "when", "do", "else", "refused", "repeat"])?;
        if let Some(note) = object.get("note") {
            note.text()?;
        }
        let when = object.get("when").map(|when| Predicate::read(&when, scope, atoms, false)).transpose()?;
        let mutations = object.get("do").map(|list| read_group(&list, scope)).transpose()?;
        let has_group = mutations.is_some();
        if when.is_none() && !has_group {
            return cursor
                .fault(Fault::Empty { what: "step: a mutation to `do`, or a guard to wait for (`when`)" });
        }
        let otherwise = object.get("else").map(|word| word.word(OTHERWISE)).transpose()?;
        let refused = object.get("refused").map(|word| word.word(OTHERWISE)).transpose()?;
        if refused.is_some() && !has_group {
            return cursor.fault(Fault::Needs { field: "refused", needed: "a mutation to `do`" });
        }
        let repeat = object.get("repeat").map(|times| times.whole(1, REPEAT_MAX)).transpose()?;
        let otherwise = otherwise.unwrap_or(Otherwise::Wait);
        Ok(Self {
            when,
            mutations: mutations.unwrap_or_default(),
            otherwise,
            refused: refused.unwrap_or(otherwise),
            repeat: repeat.and_then(|times| u32::try_from(times).ok()).unwrap_or(1),
        })
    }
}

fn read_group(cursor: &Cursor<'_>, scope: &Scope) -> Read<Vec<NamedMutation>> {
    if !cursor.value.is_array() {
        return Ok(vec![NamedMutation::read(cursor, scope)?]);
    }
    let list = cursor.list("list of mutations", 1, GROUP_MAX)?;
    list.iter().map(|mutation| NamedMutation::read(mutation, scope)).collect()
}
