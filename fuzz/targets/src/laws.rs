//! Laws that several targets ask for.

use crate::target::{Broken, Marks, equal, holds};
use dsr_core::{
    Dictionary, Dot, Placement, Record, Repair, State, ValueType, View, check_well_formed, decode, digest,
    encode, invariant, view,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// Open; open with functional and typed names; closed to almost everything.
pub(crate) fn dictionaries() -> [Dictionary; 3] {
    let mut typed = Dictionary::open().with_functional("in");
    typed.attributes.insert("level".into(), ValueType::Int);
    typed.attributes.insert("a".into(), ValueType::Int);
    let closed = Dictionary { closed: true, ..typed.clone() };
    [Dictionary::open(), typed, closed]
}

/// Text and back.
pub(crate) fn json_round_trip<T: Serialize + DeserializeOwned + PartialEq + Debug>(
    clause: &'static str,
    value: &T,
) -> Result<(), Broken> {
    let text =
        serde_json::to_string(value).map_err(|error| Broken::new(clause, format!("{error}: {value:?}")))?;
    let read = serde_json::from_str::<T>(&text);
    holds(clause, read.as_ref().is_ok_and(|read| read == value), || {
        format!("{text}\nis read as {read:#?}\nand not as {value:#?}")
    })
}

/// All that holds of any well-formed state: both encodings, and what is shown of it.
pub(crate) fn of_state(state: &State) -> Result<(), Broken> {
    equal("WF-1", "a state", &check_well_formed(state), &Ok(()))?;
    equal("ENC-1", "bytes and back", &decode(&encode(state)).as_ref(), &Ok(state))?;
    json_round_trip("JSON-12", state)?;
    json_round_trip("JSON-13", &digest(state))?;
    for dictionary in dictionaries() {
        of_view(&view(state, &dictionary))?;
    }
    Ok(())
}

/// All that holds of any view.
pub(crate) fn of_view(shown: &View<'_>) -> Result<(), Broken> {
    dsr_model::checked::judge_view(shown).map_err(|breach| {
        let what = format!("{}\n{:#?}", breach.detail, shown.state());
        Broken { clause: breach.clause, what }
    })?;
    equal("VIEW-9", "the judges of the core", &invariant::check_repairs(shown), &Ok(()))
}

/// Which repairs a view reports.
pub(crate) fn repair_marks<'r>(repairs: impl IntoIterator<Item = &'r Repair>, marks: &mut Marks) {
    for repair in repairs {
        marks.add(format!("repair-{}", repair.kind()));
    }
}

/// Gaps, few and many.
pub(crate) fn context_marks(state: &State, marks: &mut Marks) {
    let beyond = state.context().cloud_runs().count();
    marks.add_if(beyond > 0, "gap");
    // The set of runs changes its form where there are more than 16.
    marks.add_if(beyond > 16, "many-gaps");
}

/// What of a state and its view is rare.
pub(crate) fn state_marks(shown: &View<'_>, marks: &mut Marks) {
    let state = shown.state();
    context_marks(state, marks);
    let waits = |dot: Dot| dot.sequence != 0 && !state.context().contains(dot);
    marks.add_if(state.records().any(|(_, record)| record.anchors().any(waits)), "pending");
    let register = |at: usize| (shown.writes()[at].1.target, &shown.writes()[at].1.name);
    marks.add_if((1..shown.writes().len()).any(|at| register(at - 1) == register(at)), "competing-writes");
    let stamp = |dot| state.rank(dot).map(|rank| rank.0);
    let is_tie = |repair: &Repair| match repair {
        Repair::Superseded { hidden, shown, .. } => stamp(hidden.0) == stamp(shown.0),
        _ => false,
    };
    marks.add_if(shown.repairs().iter().any(is_tie), "tie");
    // A claim that is shown although a greater one of its child is not: that one would have closed a cycle.
    let steps_in = |repair: &Repair| match repair {
        Repair::CycleBroken { hidden } => {
            let parent = state.edge(hidden.0).and_then(|edge| shown.placement(edge.to));
            matches!(parent, Some(Placement::Child { edge, .. }) if state.rank(edge.0) < state.rank(hidden.0))
        }
        _ => false,
    };
    marks.add_if(shown.repairs().iter().any(steps_in), "lesser-claim-steps-in");
}

/// How many passes of closure a join makes, if it makes anything die that the joining state held: 0 if only
/// what the other names is dead.
pub(crate) fn closure_depth(here: &State, other: &State) -> Option<usize> {
    let mut merged = here.clone();
    merged.merge(other);
    let died = here.records().any(|(dot, _)| !merged.holds(dot));
    let mut depth = 0;
    loop {
        let lives = |record: &Record| !record.anchors().any(|anchor| merged.is_dead(anchor));
        let kept: Vec<_> = merged.records().filter(|(_, record)| lives(record)).collect();
        if kept.len() == merged.len() {
            return (died || depth > 0).then_some(depth);
        }
        depth += 1;
        let kept: Vec<_> = kept.into_iter().map(|(dot, record)| (dot, record.clone())).collect();
        merged = State::assemble(kept, merged.context().clone());
    }
}
