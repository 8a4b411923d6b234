//! What several semantics make of one history. `[spec: CONF-20]`

use crate::adapter::{Adapter, Core, CoreAdapter};
use crate::case::Step;
use crate::protocol::{CaseBegin, Deliver, Mutate, Read, ReplicaName, View};
use crate::score::{Flawed, broken_cores};
use dsr_core::Dictionary;
use std::collections::{BTreeMap, BTreeSet};

/// The semantics that histories are to tell apart: the core, the core with the authors' identities in the opposite
/// order, which decides ties the other way, and the cores broken on purpose.
#[derive(Debug)]
pub(super) struct Several {
    broken: Vec<CoreAdapter<Flawed>>,
}

/// Which semantics differ in what they make of a history: pairs by their numbers.
pub(super) type Separated = BTreeSet<(usize, usize)>;

/// What is shown at each expectation, until something is refused.
type Outcome = Vec<Option<View>>;

impl Several {
    /// All of them.
    pub(super) fn new() -> Self {
        Self { broken: broken_cores().map(|alarm| CoreAdapter::of(Flawed(alarm))).collect() }
    }

    /// Which of them these steps tell apart. The replicas are a scene's author, `authors` authors, and observers.
    pub(super) fn separated(
        &mut self,
        replicas: &[ReplicaName],
        authors: usize,
        dictionary: &Dictionary,
        steps: &[Step],
    ) -> Separated {
        let mut reversed = replicas.to_vec();
        if let Some(authors) = reversed.get_mut(1..=authors) {
            authors.reverse();
        }
        let mut outcomes = vec![
            outcome(&mut Core::default(), replicas, dictionary, steps),
            outcome(&mut Core::default(), &reversed, dictionary, steps),
        ];
        outcomes.extend(self.broken.iter_mut().map(|broken| outcome(broken, replicas, dictionary, steps)));
        let pairs = (0..outcomes.len()).flat_map(|left| (0..left).map(move |right| (right, left)));
        pairs.filter(|&(left, right)| outcomes[left] != outcomes[right]).collect()
    }
}

fn outcome(
    adapter: &mut dyn Adapter,
    replicas: &[ReplicaName],
    dictionary: &Dictionary,
    steps: &[Step],
) -> Outcome {
    let begin =
        CaseBegin { case: String::new(), replicas: replicas.to_vec(), dictionary: Some(dictionary.clone()) };
    let mut outcome = Outcome::new();
    let mut names: BTreeMap<&str, String> = BTreeMap::new();
    if adapter.begin(&begin).is_err() {
        return outcome;
    }
    for step in steps {
        let went_on = match step {
            Step::Mutate { replica, mutations, r#as } => {
                let mutate = Mutate { replica: replica.clone(), mutations: mutations.clone() };
                adapter.mutate(&mutate).map(|made| {
                    names.extend(r#as.as_deref().map(|name| (name, made.delta)));
                })
            }
            Step::Deliver { replica, delta } => {
                let delta = names.get(delta.as_str()).cloned().unwrap_or_default();
                adapter.deliver(&Deliver { replica: replica.clone(), delta })
            }
            Step::Expect { replica, .. } => adapter
                .read(&Read { replica: replica.clone() })
                .map(|shown| outcome.push(Some(shown.view.canonical()))),
            _ => Ok(()),
        };
        if went_on.is_err() {
            outcome.push(None);
            break;
        }
    }
    outcome
}
