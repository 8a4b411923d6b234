//! Which rare things a step has brought about.

use crate::laws;
use crate::pair::Pair;
use crate::target::Marks;
use dsr_core::{Delta, State, View, view};

/// What of a replica's state and view is rare.
pub(super) fn state(shown: &View<'_>, marks: &mut Marks) {
    laws::repair_marks(shown.repairs(), marks);
    laws::state_marks(shown, marks);
    marks.add_if(!shown.stranded().is_empty(), "stranded");
}

/// What of a join is rare.
pub(super) fn join(before: &State, delta: &Delta, after: &State, marks: &mut Marks) {
    let depth = laws::closure_depth(before, delta);
    marks.add_if(depth.is_some(), &format!("closure-{}", depth.unwrap_or(0)));
    let gaps = |state: &State| state.context().cloud_runs().count();
    marks.add_if(gaps(after) < gaps(before), "cloud-compaction");
    marks.add_if(delta.records().any(|(dot, _)| before.is_dead(dot)), "comes-after-its-removal");
    let died =
        |state: &State| delta.context().runs().flat_map(dsr_core::Run::dots).any(|dot| state.is_dead(dot));
    let is_news = |dot| after.is_dead(dot) && !before.context().contains(dot) && delta.holds(dot);
    marks.add_if(delta.records().any(|(dot, _)| is_news(dot)) && died(after), "dies-on-arrival");
    let waits = |state: &State| {
        let waits = |dot: dsr_core::Dot| dot.sequence != 0 && !state.context().contains(dot);
        state.records().filter(|(_, record)| record.anchors().any(waits)).count()
    };
    marks.add_if(waits(after) < waits(before) && after.len() >= before.len(), "pending-no-more");
}

/// What of an answer to a digest is rare.
pub(super) fn answer(theirs: &State, delta: &Delta, marks: &mut Marks) {
    marks.add_if(delta.context().is_empty(), "answer-nothing");
    marks.add_if(!delta.is_empty(), "answer-records");
    marks.add_if(theirs.records().any(|(dot, _)| delta.is_dead(dot)), "answer-deaths");
}

/// Whether a claim that was there and hidden is shown now, or one that was shown is hidden and still there.
pub(super) fn surfaces(before: &State, pair: &Pair, delta: &Delta, marks: &mut Marks) {
    let after = before.joined(delta);
    let [old, new] = [before, &after].map(|state| view(state, &pair.dictionary));
    let was_hidden = |id: dsr_core::EdgeId| before.edge(id.0).is_some() && !old.shows_edge(id);
    marks.add_if(new.edges().iter().any(|shown| was_hidden(shown.id)), "surfaces");
    let is_hidden = |id: dsr_core::EdgeId| after.edge(id.0).is_some() && !new.shows_edge(id);
    marks.add_if(old.edges().iter().any(|shown| is_hidden(shown.id)), "shadowed");
}
