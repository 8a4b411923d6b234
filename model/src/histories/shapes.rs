//! Shapes: what the verdict on a set of deltas can depend on. `[spec: CHECK-11]`
//!
//! A set of deltas is told by less and less, the less there is in it to decide:
//!
//! | grain | tells | suffices where |
//! |---|---|---|
//! | outline | the deltas out of time | nothing competes: no rank decides anything |
//! | coarse | also which of two on one register has the greater stamp | registers decide for themselves |
//! | fine | also which of two on registers that can decide about each other | always |
//!
//! All of it up to renaming replicas, since the names of replicas decide nothing but ties of stamps; where
//! stamps that are told tie, the shape tells the names as well.
//!
//! Sets that are told by the same are judged once. Every delivered subset of millions of histories is thereby
//! judged on a fraction of them.

use super::Permutations;
use crate::semantics::{Competition, Semantics};
use crate::tables::{DeltaId, NONE, Tables};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use std::cmp::Ordering;

/// The shape of a set at some grain; those of few deltas fit in place.
pub(super) type Shape = SmallVec<[u32; 8]>;

/// How much a shape tells besides the deltas out of time.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Grain {
    /// Nothing.
    Outline,
    /// The order of stamps on each register.
    Coarse,
    /// The order of stamps across registers as well.
    Fine,
}

impl Grain {
    /// All, the coarsest first.
    pub(super) const ALL: [Self; 3] = [Self::Outline, Self::Coarse, Self::Fine];

    /// The next finer one.
    pub(super) const fn finer(self) -> Self {
        match self {
            Self::Outline => Self::Coarse,
            Self::Coarse | Self::Fine => Self::Fine,
        }
    }
}

/// Comparisons that one word of a shape holds, at two bits each.
const COMPARISONS_A_WORD: usize = 16;

/// A delta out of time, and its time.
#[derive(Clone, Copy, Debug)]
struct Timed {
    /// The delta out of time, by its number.
    number: u32,
    stamp: u64,
}

/// Deltas out of time, and which of them compete.
#[derive(Debug)]
pub(super) struct Shapes {
    /// Else every delta is its own, and every set.
    in_use: bool,
    permutations: Permutations,
    /// By delta.
    timed: Vec<Option<Timed>>,
    /// The deltas out of time, by number.
    timeless: Vec<DeltaId>,
    numbers: FxHashMap<DeltaId, u32>,
    /// By number, what it becomes by each permutation.
    renamed: Vec<Vec<u32>>,
    /// The stamp of deltas made right after the start.
    first_stamp: Option<u64>,
    /// When number `l` competes with a lesser one `r`, by `[l][r]`; unknown where it was not asked.
    competing: Vec<Vec<Option<Competition>>>,
    set: Vec<Timed>,
    shape: Vec<u32>,
    image: Vec<u32>,
    by: usize,
    firsts: Vec<u32>,
}

impl Shapes {
    /// No shapes yet; outlines are told up to these permutations.
    pub(super) fn new(permutations: Permutations) -> Self {
        Self {
            in_use: true,
            permutations,
            timed: Vec::new(),
            timeless: Vec::new(),
            numbers: FxHashMap::default(),
            renamed: Vec::new(),
            first_stamp: None,
            competing: Vec::new(),
            set: Vec::new(),
            shape: Vec::new(),
            image: Vec::new(),
            by: 0,
            firsts: Vec::new(),
        }
    }

    /// Whether sets are told by their shapes, or by their very deltas.
    pub(super) fn set_in_use(&mut self, in_use: bool) {
        self.in_use = in_use;
    }

    /// The shape of a set of deltas, which may repeat some.
    pub(super) fn of<S: Semantics>(
        &mut self,
        semantics: &S,
        tables: &mut Tables<S>,
        set: &[DeltaId],
        grain: Grain,
    ) -> &[u32] {
        self.set.clear();
        for &delta in set {
            let timed = self.timed(semantics, tables, delta);
            self.set.push(timed);
        }
        self.by = 0;
        self.shape.clear();
        self.shape.push(grain as u32);
        self.tell(semantics, tables, grain);
        let words = self.set.len() + 1;
        // Two bits a comparison, of which 2 is a tie.
        let ties = self.shape[words..].iter().any(|word| word & !(word << 1) & 0xaaaa_aaaa != 0);
        if !ties {
            self.take_least_image(semantics, tables, grain);
        }
        &self.shape
    }

    /// The last shape that was made.
    pub(super) fn last(&self) -> &[u32] {
        &self.shape
    }

    /// The permutation of replicas under which the last shape was told.
    pub(super) fn by(&self) -> usize {
        self.by
    }

    /// Appends to the shape, after its first word, what it tells of the set.
    fn tell<S: Semantics>(&mut self, semantics: &S, tables: &Tables<S>, grain: Grain) {
        self.set.sort_unstable_by_key(|timed| (timed.number, timed.stamp));
        self.set.dedup_by_key(|timed| (timed.number, timed.stamp));
        self.shape.truncate(1);
        self.shape.extend(self.set.iter().map(|timed| timed.number));
        match grain {
            Grain::Outline => {}
            Grain::Coarse => self.compare(semantics, tables, Competition::Always),
            Grain::Fine => self.compare(semantics, tables, Competition::Entangled),
        }
    }

    /// The least that renaming replicas makes of the shape: by the deltas out of time, then by the rest.
    fn take_least_image<S: Semantics>(&mut self, semantics: &S, tables: &Tables<S>, grain: Grain) {
        self.find_least_firsts();
        let words = self.set.len() + 1;
        let original = std::mem::take(&mut self.set);
        for permutation in 1..self.permutations.len() {
            if self.firsts[permutation] != self.firsts[0] {
                continue;
            }
            self.image.clear();
            self.image.push(grain as u32);
            self.image.extend(original.iter().map(|timed| self.renamed[timed.number as usize][permutation]));
            self.image[1..].sort_unstable();
            let order = self.image[..].cmp(&self.shape[..words]);
            if order == Ordering::Greater || order == Ordering::Equal && grain == Grain::Outline {
                continue;
            }
            if grain > Grain::Outline {
                let renamed = &self.renamed;
                let image = original
                    .iter()
                    .map(|timed| Timed { number: renamed[timed.number as usize][permutation], ..*timed });
                self.set.extend(image);
                std::mem::swap(&mut self.image, &mut self.shape);
                self.tell(semantics, tables, grain);
                self.set.clear();
                std::mem::swap(&mut self.image, &mut self.shape);
            }
            if self.image < self.shape {
                std::mem::swap(&mut self.image, &mut self.shape);
                self.by = permutation;
            }
        }
        self.set = original;
    }

    /// The least number of each image, by permutation; that of all in the place of the identity. Only images
    /// that begin with it can be the least, which spares sorting the others.
    fn find_least_firsts(&mut self) {
        self.firsts.clear();
        self.firsts.resize(self.permutations.len(), u32::MAX);
        for timed in &self.set {
            for (first, &image) in self.firsts.iter_mut().zip(&self.renamed[timed.number as usize]) {
                *first = (*first).min(image);
            }
        }
        self.firsts[0] = self.firsts.iter().copied().min().unwrap_or(u32::MAX);
    }

    /// Appends how the stamps of those compare that compete at least so.
    fn compare<S: Semantics>(&mut self, semantics: &S, tables: &Tables<S>, least: Competition) {
        let (mut word, mut compared) = (0, 0);
        for at in 1..self.set.len() {
            for before in 0..at {
                let (left, right) = (self.set[at], self.set[before]);
                word <<= 2;
                if self.compete(semantics, tables, left.number, right.number) >= least {
                    word |= match left.stamp.cmp(&right.stamp) {
                        Ordering::Less => 1,
                        Ordering::Equal => 2,
                        Ordering::Greater => 3,
                    };
                }
                compared += 1;
                if compared % COMPARISONS_A_WORD == 0 {
                    self.shape.push(std::mem::take(&mut word));
                }
            }
        }
        if compared % COMPARISONS_A_WORD != 0 {
            self.shape.push(word);
        }
    }

    /// A set out of time: the deltas as if all had been made right after the start.
    pub(super) fn timeless<S: Semantics>(
        &mut self,
        semantics: &S,
        tables: &mut Tables<S>,
        set: &[DeltaId],
    ) -> Vec<DeltaId> {
        let mut timeless: Vec<DeltaId> = set
            .iter()
            .map(|&delta| {
                let number = self.timed(semantics, tables, delta).number;
                self.timeless[number as usize]
            })
            .collect();
        timeless.sort_unstable();
        timeless.dedup();
        timeless
    }

    fn timed<S: Semantics>(&mut self, semantics: &S, tables: &mut Tables<S>, delta: DeltaId) -> Timed {
        let at = delta as usize;
        if let Some(&Some(timed)) = self.timed.get(at) {
            return timed;
        }
        let first = *self.first_stamp.get_or_insert_with(|| semantics.next_stamp(&semantics.initial()));
        let stamp = if self.in_use { semantics.stamp(&tables.delta(delta)) } else { None };
        // A stamp among those of the start stays as it is: against what was there it can win or lose.
        let timeless = stamp.map_or(delta, |stamp| tables.restamp(semantics, delta, stamp.min(first)));
        let timed = Timed { number: self.number(semantics, tables, timeless), stamp: stamp.unwrap_or(0) };
        if self.timed.len() <= at {
            self.timed.resize(at + 1, None);
        }
        self.timed[at] = Some(timed);
        timed
    }

    /// The number of a delta out of time; its images are numbered with it.
    fn number<S: Semantics>(&mut self, semantics: &S, tables: &mut Tables<S>, timeless: DeltaId) -> u32 {
        if let Some(&number) = self.numbers.get(&timeless) {
            return number;
        }
        let number = u32::try_from(self.timeless.len()).unwrap_or(NONE);
        self.timeless.push(timeless);
        self.numbers.insert(timeless, number);
        self.renamed.push(vec![number]);
        for permutation in 1..self.permutations.len() {
            let to = self.permutations.get(permutation).to_vec();
            let image = tables.rename_delta(semantics, timeless, permutation, &to);
            let image = self.number(semantics, tables, image);
            self.renamed[number as usize].push(image);
        }
        number
    }

    /// When number `left` competes with the lesser `right`; one that occurs with two stamps does with itself.
    fn compete<S: Semantics>(
        &mut self,
        semantics: &S,
        tables: &Tables<S>,
        left: u32,
        right: u32,
    ) -> Competition {
        let (left, right) = (left as usize, right as usize);
        if let Some(&Some(competition)) = self.competing.get(left).and_then(|row| row.get(right)) {
            return competition;
        }
        let delta = |number: usize| tables.delta(self.timeless[number]);
        let competition =
            if left == right { Competition::Always } else { semantics.compete(&delta(left), &delta(right)) };
        if self.competing.len() <= left {
            self.competing.resize_with(left + 1, Vec::new);
        }
        let row = &mut self.competing[left];
        if row.len() <= right {
            row.resize(right + 1, None);
        }
        row[right] = Some(competition);
        competition
    }
}
