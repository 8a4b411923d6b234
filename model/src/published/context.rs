//! Which dots a register has seen.

use std::collections::{BTreeMap, BTreeSet};

/// The name of one write to a register. Ordered by register id, then counter.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Dot {
    /// The id of the register that wrote.
    pub id: u32,
    /// Its counter, from 1.
    pub n: u32,
}

/// The dots seen: a counter for each id, and a cloud of dots beyond them.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Context {
    counters: BTreeMap<u32, u32>,
    cloud: BTreeSet<Dot>,
}

impl Context {
    /// The compacted context of some dots.
    pub fn of(dots: impl IntoIterator<Item = Dot>) -> Self {
        let mut context = Self { counters: BTreeMap::new(), cloud: dots.into_iter().collect() };
        context.compact();
        context
    }

    /// The context that says that an id has counted so far, and nothing else.
    pub fn counted(id: u32, n: u32) -> Self {
        Self { counters: BTreeMap::from([(id, n)]), cloud: BTreeSet::new() }
    }

    /// The counter of an id.
    pub fn counter(&self, id: u32) -> Option<u32> {
        self.counters.get(&id).copied()
    }

    /// The counters of the compact part, by id.
    pub fn counters(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.counters.iter().map(|(&id, &n)| (id, n))
    }

    /// The counters of the dots beyond the compact part.
    pub fn cloud(&self) -> impl Iterator<Item = Dot> + '_ {
        self.cloud.iter().copied()
    }

    /// Whether a dot counts as seen.
    ///
    /// The middle case is as published: one greater counter in the cloud, of whatever id, makes every smaller
    /// one seen.
    pub fn known(&self, dot: Dot) -> bool {
        if self.counter(dot.id).is_some_and(|counter| counter >= dot.n) {
            return true;
        }
        if self.cloud.last().is_some_and(|last| dot.n < last.n) {
            return true;
        }
        self.cloud.contains(&dot)
    }

    /// Moves dots from the cloud into the counters where they follow on.
    pub fn compact(&mut self) {
        loop {
            let before = self.cloud.len();
            for dot in self.cloud.clone() {
                let counter = self.counter(dot.id);
                let follows = dot.n == counter.unwrap_or(0) + 1;
                if follows {
                    self.counters.insert(dot.id, dot.n);
                }
                if follows || counter.is_some_and(|counter| dot.n <= counter) {
                    self.cloud.remove(&dot);
                }
            }
            if self.cloud.len() == before {
                return;
            }
        }
    }

    /// The next dot of an id. As published it looks at the counter only, not at the cloud, and does not compact.
    pub fn make_dot(&mut self, id: u32) -> Dot {
        let counter = self.counters.entry(id).or_insert(0);
        *counter += 1;
        Dot { id, n: *counter }
    }

    /// All that either has seen.
    pub fn join(&mut self, other: &Self) {
        for (&id, &n) in &other.counters {
            let counter = self.counters.entry(id).or_insert(n);
            *counter = n.max(*counter);
        }
        self.cloud.extend(other.cloud.iter().copied());
        self.compact();
    }
}
