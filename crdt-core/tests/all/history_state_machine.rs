//! Replicas that mutate, lose, reorder, repeat and resynchronise, against a reference that knows only *which*
//! deltas each has got: a replica's state is a function of that set. `[spec: JOIN-5]`
use dsr_core::{
    Delta, Dictionary, State, check_well_formed, decode, delta_for, digest, encode, fingerprint, invariant,
    view,
};
use dsr_testkit::{Step, World, author, cases, dictionary, history};
use proptest::prelude::*;
use proptest_state_machine::{ReferenceStateMachine, StateMachineTest, prop_state_machine};

/// How many replicas there are.
const REPLICAS: usize = 3;

/// The reference: the deltas sent, and who has got which. Its states are rebuilt from these alone, in the
/// order of sending.
struct DeliveredSets;

impl ReferenceStateMachine for DeliveredSets {
    type State = World;
    type Transition = Step;

    fn init_state() -> BoxedStrategy<World> {
        Just(World::new(REPLICAS, dictionary())).boxed()
    }

    fn transitions(_: &World) -> BoxedStrategy<Step> {
        history::any_step(REPLICAS).boxed()
    }

    fn apply(mut world: World, step: &Step) -> World {
        world.step(step);
        // What was delivered counts, not how: forget the way the state came about.
        for replica in 0..REPLICAS {
            world.states[replica] = world.expected(replica);
        }
        world
    }
}

/// The system: states that grow delta by delta, exactly in the order of delivery.
struct Replicas {
    dictionary: Dictionary,
    states: Vec<State>,
    sent: Vec<Delta>,
    /// What each replica was before the last step.
    before: Vec<State>,
}

impl StateMachineTest for Replicas {
    type SystemUnderTest = Self;
    type Reference = DeliveredSets;

    fn init_test(_: &World) -> Self {
        let states = vec![State::new(); REPLICAS];
        Self { dictionary: dictionary(), before: states.clone(), states, sent: Vec::new() }
    }

    fn apply(mut system: Self, reference: &World, step: Step) -> Self {
        system.before.clone_from(&system.states);
        match step {
            Step::Mutate { replica, kind, choice } => {
                let here = view(&system.states[replica], &system.dictionary);
                let author = author(replica, reference.incarnations[replica], &system.states[replica]);
                let sent_now = reference.sent.len() > system.sent.len();
                let picked = dsr_testkit::pick(&here, author, kind, choice);
                assert_eq!(picked.is_some(), sent_now, "both choose from the same view");
                if let Some(mutation) = picked {
                    let delta = mutation.delta(&here, author).unwrap();
                    assert_eq!(Some(&delta), reference.sent.last(), "one state, one delta");
                    system.states[replica].join(&delta);
                    system.sent.push(delta);
                }
            }
            Step::Deliver { delta, to } => {
                if !system.sent.is_empty() {
                    // Over the wire, as always.
                    let bytes = encode(&system.sent[delta % system.sent.len()]);
                    system.states[to].join(&decode(&bytes).unwrap());
                }
            }
            Step::Resynchronise { from, to } => {
                let delta = delta_for(&system.states[from], &digest(&system.states[to]));
                system.states[to].join(&delta);
            }
            Step::Group { deltas, to } => {
                if !system.sent.is_empty() {
                    let deltas = deltas.iter().map(|delta| &system.sent[delta % system.sent.len()]);
                    let all = deltas.fold(State::new(), |all, delta| delta.joined(&all));
                    system.states[to].join(&all);
                }
            }
            Step::Restart { replica, keeps } => {
                if !keeps {
                    system.states[replica] = State::new();
                    system.before[replica] = State::new();
                }
            }
            Step::Attempt { .. } | Step::Try { .. } => panic!("the strategy makes none"),
        }
        system
    }

    fn check_invariants(system: &Self, reference: &World) {
        for (replica, state) in system.states.iter().enumerate() {
            assert_eq!(state, &reference.states[replica], "L3: the same deltas, the same state");
            assert_eq!(fingerprint(state), fingerprint(&reference.states[replica]));
            assert_eq!(check_well_formed(state), Ok(()), "S1: only live and pending records");
            assert!(system.before[replica].is_below(state), "states only grow");
            assert_eq!(invariant::check_removal_is_final(&system.before[replica], state), Ok(()), "R1");
            let shown = view(state, &system.dictionary);
            assert_eq!(invariant::check_view(&shown), Ok(()), "V1");
            assert_eq!(invariant::check_repairs(&shown), Ok(()), "V2");
        }
    }

    fn teardown(mut system: Self, reference: World) {
        // At last everything arrives, at each replica in another order.
        for (replica, state) in system.states.iter_mut().enumerate() {
            let middle = replica * system.sent.len() / REPLICAS;
            let (first, second) = system.sent.split_at(middle);
            second.iter().rev().chain(first).for_each(|delta| state.join(delta));
        }
        let all = &system.states[0];
        assert!(system.states.iter().all(|state| state == all), "L3: all deltas, one state");
        // S1: nothing is left of gaps once everything has arrived.
        assert_eq!(all.context().cloud_runs().count(), 0);
        let identities: u32 = reference.incarnations.iter().map(|restarts| restarts + 1).sum();
        assert!(all.context().vector().len() <= identities as usize);
    }
}

prop_state_machine! {
    #![proptest_config(cases(1500))]

    /// `[spec: JOIN-5]` `[spec: SYNC-5]` `[spec: STATE-3]` `[spec: STATE-6]` `[spec: CTX-2]`
    #[test]
    fn law_state_is_a_function_of_the_deltas_delivered(sequential 1..40 => Replicas);
}
