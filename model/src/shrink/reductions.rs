//! The kinds of reduction, and every single one of a course. `[spec: CHECK-14]`

use super::plan::{Item, Plan, Recorded};
use crate::course::{Course, Event};
use crate::semantics::Semantics;
use std::sync::Arc;

/// One way to make a course smaller.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Reduction {
    /// A replica goes, with all that it does and receives; or another one does in its place what it did.
    Replica,
    /// An event goes; of one that sends a message, whatever becomes of the message as well.
    Event,
    /// A mutation of a group goes.
    OfGroup,
    /// Mutations say less together: see [`simpler_together`](Semantics::simpler_together).
    Mutations,
    /// A mutation is made in one message with the next one of its author, at the place of either.
    Merge,
    /// A mutation says less: see [`simpler`](Semantics::simpler).
    Mutation,
    /// All start from less: see [`simpler_initial`](Semantics::simpler_initial).
    Initial,
}

/// Everything that one reduction can lead to.
type Plans<S> = Vec<(Arc<S>, Plan<<S as Semantics>::Mutation>)>;

impl Reduction {
    /// All kinds, those that take away most first; the initial state last, so that mutations can still come to be
    /// about what is there from the start.
    pub const ALL: [Self; 7] = [
        Self::Replica,
        Self::Event,
        Self::OfGroup,
        Self::Mutation,
        Self::Mutations,
        Self::Merge,
        Self::Initial,
    ];

    /// Its name in reports, for what is counted of it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Replica => "replicas dropped",
            Self::Event => "events dropped",
            Self::OfGroup => "mutations of groups dropped",
            Self::Merge => "messages merged",
            Self::Mutation => "mutations made simpler",
            Self::Mutations => "names replaced in all mutations",
            Self::Initial => "parts of the initial state dropped",
        }
    }

    /// Every single reduction of this kind.
    pub(super) fn plans<S: Semantics>(
        self,
        semantics: &Arc<S>,
        course: &Course<S::Mutation>,
        recorded: &Recorded<S>,
    ) -> Plans<S> {
        let whole = Plan::of(course, recorded);
        let plans = match self {
            Self::Initial => {
                let smaller = semantics.simpler_initial().into_iter();
                return smaller.map(|smaller| (Arc::new(smaller), whole.clone())).collect();
            }
            Self::Replica => without_a_replica(&whole),
            Self::Event => (0..whole.items.len()).rev().map(|at| without_event(&whole, at)).collect(),
            Self::OfGroup => without_one_of_group(&whole),
            Self::Merge => merged(&whole),
            Self::Mutation => simpler(&**semantics, &whole),
            Self::Mutations => simpler_together(&**semantics, &whole),
        };
        plans.into_iter().map(|plan| (semantics.clone(), plan)).collect()
    }
}

fn without_a_replica<M: Clone>(whole: &Plan<M>) -> Vec<Plan<M>> {
    let without = |gone: usize| {
        let mut plan = whole.clone();
        // What happens to a replica that is not there, and to its messages, cannot be carried out.
        plan.replicas.retain(|&replica| replica != gone);
        plan
    };
    let instead = |gone: usize, another: usize| {
        let mut plan = without(gone);
        for item in &mut plan.items {
            item.event = by_another(&item.event, gone, another);
        }
        plan
    };
    let pairs = || {
        let replicas = || whole.replicas.iter().rev();
        replicas().flat_map(move |&gone| replicas().map(move |&another| (gone, another)))
    };
    let pairs = pairs().filter(|(gone, another)| gone != another);
    let alone = whole.replicas.iter().rev().filter(|_| whole.replicas.len() > 1);
    alone.map(|&gone| without(gone)).chain(pairs.map(|(gone, another)| instead(gone, another))).collect()
}

fn by_another<M: Clone>(event: &Event<M>, gone: usize, another: usize) -> Event<M> {
    let who = |replica: usize| if replica == gone { another } else { replica };
    match event.clone() {
        Event::Mutate { replica, mutations } => Event::Mutate { replica: who(replica), mutations },
        Event::Deliver { replica, message } => Event::Deliver { replica: who(replica), message },
        Event::Lose { replica, message } => Event::Lose { replica: who(replica), message },
        Event::Restart { replica, keeps } => Event::Restart { replica: who(replica), keeps },
        Event::Answer { replica, to } => Event::Answer { replica: who(replica), to: who(to) },
    }
}

fn without_event<M: Clone>(whole: &Plan<M>, at: usize) -> Plan<M> {
    let mut plan = whole.clone();
    plan.items.remove(at);
    plan
}

fn without_one_of_group<M: Clone>(whole: &Plan<M>) -> Vec<Plan<M>> {
    let mut plans = Vec::new();
    for (at, item) in whole.items.iter().enumerate().filter(|(_, item)| item.origins.len() > 1) {
        for place in (0..item.origins.len()).rev() {
            let mut plan = whole.clone();
            let item = &mut plan.items[at];
            item.origins.remove(place);
            if let Event::Mutate { mutations, .. } = &mut item.event {
                mutations.remove(place);
            }
            plans.push(plan);
        }
    }
    plans
}

fn merged<M: Clone>(whole: &Plan<M>) -> Vec<Plan<M>> {
    let mut plans = Vec::new();
    for (first, item) in whole.items.iter().enumerate() {
        let Event::Mutate { replica, .. } = item.event else { continue };
        let is_next =
            |item: &Item<M>| matches!(item.event, Event::Mutate { replica: who, .. } if who == replica);
        let Some(second) = (first + 1..whole.items.len()).find(|&at| is_next(&whole.items[at])) else {
            continue;
        };
        for (stays, goes) in [(second, first), (first, second)] {
            let mut plan = whole.clone();
            plan.items[stays] = both(&whole.items[first], &whole.items[second]);
            plan.items.remove(goes);
            plans.push(plan);
        }
    }
    plans
}

fn both<M: Clone>(first: &Item<M>, second: &Item<M>) -> Item<M> {
    let mut both = first.clone();
    both.origins.extend(&second.origins);
    both.sends.extend(&second.sends);
    if let (Event::Mutate { mutations, .. }, Event::Mutate { mutations: more, .. }) =
        (&mut both.event, &second.event)
    {
        mutations.extend(more.iter().cloned());
    }
    both
}

fn simpler<S: Semantics>(semantics: &S, whole: &Plan<S::Mutation>) -> Vec<Plan<S::Mutation>> {
    let mut plans = Vec::new();
    for (at, item) in whole.items.iter().enumerate() {
        for (place, mutation) in made(&item.event).iter().enumerate() {
            for simpler in semantics.simpler(mutation) {
                let mut plan = whole.clone();
                if let Event::Mutate { mutations, .. } = &mut plan.items[at].event {
                    mutations[place] = simpler;
                }
                plans.push(plan);
            }
        }
    }
    plans
}

fn simpler_together<S: Semantics>(semantics: &S, whole: &Plan<S::Mutation>) -> Vec<Plan<S::Mutation>> {
    let mutations: Vec<S::Mutation> =
        whole.items.iter().flat_map(|item| made(&item.event)).cloned().collect();
    let together = semantics.simpler_together(&mutations).into_iter();
    let plans = together.map(|simpler| {
        let mut plan = whole.clone();
        let mut simpler = simpler.into_iter();
        for item in &mut plan.items {
            if let Event::Mutate { mutations, .. } = &mut item.event {
                let count = mutations.len();
                *mutations = simpler.by_ref().take(count).collect();
            }
        }
        plan
    });
    plans.collect()
}

fn made<M>(event: &Event<M>) -> &[M] {
    match event {
        Event::Mutate { mutations, .. } => mutations,
        _ => &[],
    }
}
