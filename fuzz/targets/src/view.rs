//! Views of any states, by every judge; the fast replica that has joined them; the scene file of what is shown.
//! `[spec: VIEW-1]` `[spec: REPLICA-1]`

use crate::laws;
use crate::pair::Pair;
use crate::scene::read_and_written;
use crate::target::{Broken, Marks, Outcome, equal, holds, variant};
use arbitrary::Unstructured;
use dsr_core::scene::{Note, Scene, Strictness};
use dsr_core::{Dictionary, Mutation, State, View, check_well_formed, decode, encode, view};
use dsr_testkit::{Anchors, bytes};

/// How many records a universe has at most.
const RECORDS_MAX: usize = 20;

/// Some states over one universe, joined one after the other; then some mutations.
pub(crate) fn states(input: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    // Bytes that end early are no fault: what is missing is small.
    match Case::of(&mut Unstructured::new(input)) {
        Ok(case) => case.run(&mut marks).map(|()| marks),
        Err(_) => Ok(marks),
    }
}

/// What the bytes spell.
struct Case {
    dictionary: Dictionary,
    anchors: Anchors,
    parts: Vec<State>,
    mutations: Vec<Mutation>,
}

impl Case {
    fn of(u: &mut Unstructured<'_>) -> arbitrary::Result<Self> {
        let dictionary = u.choose(&laws::dictionaries())?.clone();
        let anchors = if u.ratio(1_u8, 4_u8)? { Anchors::Any } else { Anchors::Right };
        // The core's own universe has every type of value; the other one every shape.
        let parts = if u.ratio(1_u8, 8_u8)? {
            (0..2).map(|_| u.arbitrary()).collect::<arbitrary::Result<_>>()?
        } else {
            let universe = bytes::universe(u, RECORDS_MAX, anchors)?;
            let count = u.int_in_range(1..=3_u8)?;
            let fates =
                (0..count).map(|_| bytes::fates(u, &universe)).collect::<arbitrary::Result<Vec<_>>>()?;
            fates.iter().map(|fates| universe.state(fates)).collect()
        };
        let mutations = (0..u.int_in_range(0..=3_u8)?).map(|_| u.arbitrary());
        let mutations = mutations.collect::<arbitrary::Result<_>>()?;
        Ok(Self { dictionary, anchors, parts, mutations })
    }

    fn run(&self, marks: &mut Marks) -> Result<(), Broken> {
        let mut pair = Pair::new(1, self.dictionary.clone());
        for part in &self.parts {
            let depth = laws::closure_depth(&pair.state, part);
            let is_sound = self.anchors == Anchors::Right;
            holds("CLOSE-3", !is_sound || depth.is_none_or(|depth| depth <= 2), || {
                format!("{depth:?} passes")
            })?;
            // More than two where a record waits for what is no element.
            marks.add_if(depth.is_some(), &format!("closure-{}", depth.unwrap_or(0).min(3)));
            pair.apply(part);
        }
        pair.check_thoroughly(&self.parts[0]);
        for mutation in &self.mutations {
            let made = pair.clone().mutate(mutation);
            marks.add(if made.is_ok() { "mutation-made" } else { "mutation-refused" });
        }
        let state = pair.state;
        look(&view(&state, &self.dictionary), marks);
        if self.anchors == Anchors::Right {
            laws::of_state(&state)?;
        } else {
            marks.add_if(check_well_formed(&state).is_err(), "anchor-of-the-wrong-kind");
            laws::of_view(&view(&state, &self.dictionary))?;
            return Ok(());
        }
        let read = decode(&encode(&state)).map_err(|error| Broken::new("ENC-1", error))?;
        let shown = [&state, &read].map(|state| format!("{:?}", view(state, &self.dictionary)));
        equal("VIEW-1", "equal states, equal views", &shown[0], &shown[1])?;
        as_scene(state, marks)
    }
}

/// What is written of a state is a scene, and the same again once it was read; unless something is held by a
/// repair alone. `[spec: SCENE-15]`
fn as_scene(state: State, marks: &mut Marks) -> Result<(), Broken> {
    let open = Dictionary::open();
    let written = Scene::of(state).written(&open);
    written.notes.iter().for_each(|note| marks.add(format!("note-{}", variant(note))));
    let is_whole = !written.notes.iter().any(|note| matches!(note, Note::Stranded { .. }));
    match Scene::read(&written.text, &open, Strictness::Strict) {
        Ok(imported) => {
            holds("SCENE-15", is_whole, || format!("read without its repairs:\n{}", written.text))?;
            read_and_written(&imported.scene, &open, &mut Marks::default())
        }
        Err(error) => holds("SCENE-15", !is_whole, || format!("{error}\n{}", written.text)),
    }
}

/// What of a view is rare.
fn look(shown: &View<'_>, marks: &mut Marks) {
    laws::repair_marks(shown.repairs(), marks);
    for &vertex in shown.vertices() {
        let Some(placement) = shown.placement(vertex) else { continue };
        marks.add(format!("placed-{}", variant(&placement)));
    }
    marks.add_if(!shown.stranded().is_empty(), "stranded");
    laws::state_marks(shown, marks);
}
