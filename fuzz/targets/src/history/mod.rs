//! Histories: replicas that mutate, are refused, deliver late, early, twice and together, resynchronise and
//! restart. Every law is asked after every step, and the fast replica goes through the same.
//!
//! The laws are those of the checker (`dsr-model`), on its trait; so a core broken on purpose can stand in the
//! place of the sound one, and must be found.
//!
//! | room | what |
//! |---|---|
//! | `replicas` | the replicas, and what each step does |
//! | `laws` | what must hold after a step, and at the end |
//! | `look` | which rare things a step has brought about |

mod laws;
mod look;
mod replicas;

use crate::laws::dictionaries;
use crate::target::{Broken, Marks, Outcome};
use arbitrary::Unstructured;
use dsr_core::{Delta, Dictionary, State};
use dsr_model::alarms::Alarm;
use dsr_model::checked::alphabet::Alphabet;
use dsr_model::checked::{Act, Checked};
use dsr_model::semantics::Semantics;
use dsr_testkit::{Step, bytes};
use replicas::Replicas;

/// How many steps a history has at most.
const STEPS_MAX: usize = 48;

/// What a history is carried out on: the core, or a broken one.
pub(crate) trait Core: Semantics<State = State, Delta = Delta, Mutation = Act> {}

impl<S: Semantics<State = State, Delta = Delta, Mutation = Act>> Core for S {}

/// A history on the sound core, beside the fast replica.
pub(crate) fn sound(input: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    let Ok(plan) = Plan::of(&mut Unstructured::new(input)) else { return Ok(marks) };
    carry_out(&plan, &plan.core(), true, &mut marks)?;
    Ok(marks)
}

/// The same history on a core broken on purpose, under the same laws.
///
/// # Errors
///
/// If the history shows what is broken: the aim.
pub fn on_broken_core(alarm: &Alarm, input: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    let Ok(plan) = Plan::of(&mut Unstructured::new(input)) else { return Ok(marks) };
    carry_out(&plan, &alarm.on(plan.core()), false, &mut marks)?;
    Ok(marks)
}

/// A graph to start from: two branches below the root, one of two vertices, and what can be moved and written.
fn graph() -> State {
    let text = "r9.1 vertex thing x @1
        r9.2 edge root -RT-> r9.1 @1
        r9.3 vertex thing y @2
        r9.4 edge root -RT-> r9.3 @2
        r9.5 vertex thing z @3
        r9.6 edge r9.3 -RT-> r9.5 @3
        r9.7 edge r9.5 -in-> r9.1 @4
        r9.8 write r9.5 level=1 @5";
    dsr_testkit::parse_state(text).unwrap_or_default()
}

/// What the bytes spell.
struct Plan {
    dictionary: Dictionary,
    /// What all replicas start from.
    initial: State,
    replicas: usize,
    steps: Vec<Step>,
}

impl Plan {
    fn of(u: &mut Unstructured<'_>) -> arbitrary::Result<Self> {
        let [open, typed, closed] = dictionaries();
        // Closed to almost everything, it refuses almost everything.
        let dictionary = match u.int_in_range(0..=7_u8)? {
            0 => closed,
            1 => open,
            _ => typed,
        };
        let initial = if u.arbitrary()? { graph() } else { State::new() };
        let replicas = u.int_in_range(1..=4_u8)?.into();
        let mut steps = Vec::new();
        while !u.is_empty() && steps.len() < STEPS_MAX {
            steps.push(bytes::step(u, replicas)?);
        }
        Ok(Self { dictionary, initial, replicas, steps })
    }

    /// The core. Its alphabet is never asked: mutations come from the bytes.
    fn core(&self) -> Checked {
        let (dictionary, initial) = (self.dictionary.clone(), self.initial.clone());
        Checked { dictionary, initial, alphabet: Alphabet::all(Vec::new()) }
    }
}

fn carry_out<S: Core>(plan: &Plan, core: &S, beside_fast: bool, marks: &mut Marks) -> Result<(), Broken> {
    let mut replicas = Replicas::new(core, plan.dictionary.clone(), plan.replicas, beside_fast);
    for step in &plan.steps {
        replicas.step(step, marks)?;
    }
    replicas.come_to_rest(marks)
}
