//! What is seen of a delivered set. `[spec: CONF-20]`

use super::script::{Script, Set, members, state};
use dsr_core::{Dictionary, Dot, EdgeId, Record, Repair, ReplicaId, State, VertexId, View, view};
use dsr_model::checked::Checked;
use dsr_model::histories::Histories;
use dsr_model::tables::StateId;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// What became of a record that somebody has made.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Fate {
    /// It is shown.
    Shown,
    /// It is there, and something else is shown, or it waits for what it belongs to.
    Hidden,
    /// It is gone.
    Dead,
}

/// What a state shows, as far as histories are told apart by it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Seen {
    /// The kinds of its repairs, in order.
    pub(super) repairs: Vec<&'static str>,
    /// Whether one attribute has two live writes.
    pub(super) has_two_writes: bool,
    /// What became of each record that is not the scene's.
    fates: BTreeMap<Dot, Fate>,
}

/// Mutations by their kind, each with the fates of its records, by their sort.
type Fates = Vec<(usize, Vec<(u8, Fate)>)>;
/// The kinds of repair of a set, in order.
type Repairs = Vec<&'static str>;

/// Two histories with equal signatures are alike; see [`Sights::signature`].
pub(super) type Signature = (Fates, Vec<Repairs>);
/// See [`Sights::early`].
pub(super) type Early = (Vec<usize>, Fates, Repairs);

/// What states show, remembered.
#[derive(Debug, Default)]
pub(super) struct Sights(BTreeMap<StateId, Arc<Seen>>);

impl Sights {
    /// What is seen of a delivered set.
    pub(super) fn of(
        &mut self,
        semantics: &Checked,
        histories: &mut Histories<Checked>,
        script: &Script,
        set: Set,
    ) -> Arc<Seen> {
        let id = state(histories, &script.made, set);
        let seen = self.0.entry(id).or_insert_with(|| {
            let state = histories.tables().state(id);
            Arc::new(seen(&view(&state, &semantics.dictionary)))
        });
        seen.clone()
    }

    /// What a history is told by: the kinds of its mutations, each with what became of its records in the end, and
    /// the repairs of the delivered sets `sets`, in no order.
    pub(super) fn signature(
        &mut self,
        semantics: &Checked,
        histories: &mut Histories<Checked>,
        script: &Script,
        sets: impl Iterator<Item = Set>,
    ) -> Signature {
        let end = self.of(semantics, histories, script, script.whole()).fates_of(script, script.whole());
        let mut repairs: Vec<_> =
            sets.map(|set| self.of(semantics, histories, script, set).repairs.clone()).collect();
        repairs.sort_unstable();
        (end, repairs)
    }

    /// What is seen where causes are missing: of each such set the fates and the repairs, and the kinds of the causes.
    pub(super) fn early(
        &mut self,
        semantics: &Checked,
        histories: &mut Histories<Checked>,
        script: &Script,
    ) -> Vec<Early> {
        let sets = (1..=script.whole()).filter(|&set| !script.is_closed(set));
        let of = |set| {
            let seen = self.of(semantics, histories, script, set);
            let causes = members(set).fold(0, |causes, at| causes | script.made[at].had) & !set;
            let mut missing: Vec<usize> =
                members(causes).map(|at| script.made[at].mutation.kind() as usize).collect();
            missing.sort_unstable();
            (missing, seen.fates_of(script, set), seen.repairs.clone())
        };
        sets.map(of).collect()
    }
}

/// Whether nothing comes of all mutations together that does not come of two of them: no other repairs, and no other
/// fate of a record.
pub(super) fn is_sum_of_pairs(
    semantics: &Checked,
    histories: &mut Histories<Checked>,
    sights: &mut Sights,
    script: &Script,
) -> bool {
    let pairs = (1..=script.whole()).filter(|set| set.count_ones() == 2);
    let pairs: Vec<(Set, Arc<Seen>)> =
        pairs.map(|set| (set, sights.of(semantics, histories, script, set))).collect();
    let whole = sights.of(semantics, histories, script, script.whole());
    let repairs = |seen: &Seen| -> BTreeSet<&'static str> { seen.repairs.iter().copied().collect() };
    let of_pairs: BTreeSet<&'static str> = pairs.iter().flat_map(|(_, seen)| repairs(seen)).collect();
    let is_of_a_pair = |at: usize, dot: Dot| {
        let mut with = pairs.iter().filter(|(set, _)| set >> at & 1 == 1);
        with.any(|(_, seen)| seen.fate(dot) == whole.fate(dot))
    };
    repairs(&whole) == of_pairs
        && (0..script.made.len())
            .all(|at| script.made[at].delta.records().all(|(dot, _)| is_of_a_pair(at, dot)))
}

impl Seen {
    /// What became of the records of each mutation of a set.
    fn fates_of(&self, script: &Script, set: Set) -> Fates {
        let of = |at: usize| {
            let made = &script.made[at];
            let records = made.delta.records();
            let mut fates: Vec<(u8, Fate)> =
                records.map(|(dot, record)| (sort_of(record), self.fate(dot))).collect();
            fates.sort_unstable();
            (made.mutation.kind() as usize, fates)
        };
        let mut fates: Fates = members(set).map(of).collect();
        fates.sort_unstable();
        fates
    }

    /// What became of a record.
    pub(super) fn fate(&self, dot: Dot) -> Fate {
        self.fates.get(&dot).copied().unwrap_or(Fate::Dead)
    }
}

const fn sort_of(record: &Record) -> u8 {
    match record {
        Record::Vertex(_) => 0,
        Record::Edge(_) => 1,
        Record::Write(_) => 2,
    }
}

fn seen(view: &View<'_>) -> Seen {
    let mut repairs: Vec<&'static str> = view.repairs().iter().map(Repair::kind).collect();
    repairs.sort_unstable();
    let is_shown = |dot: Dot, record: &Record| match record {
        Record::Vertex(_) => view.has_vertex(VertexId(dot)),
        Record::Edge(_) => view.shows_edge(EdgeId(dot)),
        Record::Write(write) => {
            view.attribute(write.target, &write.name).is_some_and(|(first, _)| first == dot)
        }
    };
    let state: &State = view.state();
    let made = state.records().filter(|(dot, _)| dot.replica != ReplicaId::SCENE);
    let fate = |(dot, record)| (dot, if is_shown(dot, record) { Fate::Shown } else { Fate::Hidden });
    let pairs = view.writes().windows(2);
    let same = |pair: &[(Dot, &dsr_core::Write)]| {
        pair[0].1.target == pair[1].1.target && pair[0].1.name == pair[1].1.name
    };
    Seen { repairs, has_two_writes: pairs.into_iter().any(same), fates: made.map(fate).collect() }
}

/// Whether delivered sets, by their number, are such that nothing in them is decided by a rule that could be another.
/// `[spec: CONF-20]`
pub(super) fn undisputed(
    semantics: &Checked,
    histories: &mut Histories<Checked>,
    sights: &mut Sights,
    script: &Script,
) -> Vec<bool> {
    let undone: Vec<Undone> =
        (0..script.made.len()).map(|at| undone(&semantics.initial, script, at)).collect();
    let mut undisputed = Vec::new();
    for set in 0..=script.whole() {
        let seen = sights.of(semantics, histories, script, set);
        let parts_are = members(set).all(|at| {
            let part = set & !(1 << at);
            !script.is_closed(part) || undisputed.get(part as usize).copied().unwrap_or(false)
        });
        let is_undisputed = script.is_closed(set)
            && parts_are
            && is_alone(&semantics.dictionary, script, &undone, set, &seen);
        undisputed.push(is_undisputed);
    }
    undisputed
}

/// Records that a mutation undoes, by their dots.
type Undone = BTreeMap<Dot, Record>;

/// The records that a mutation undoes knowingly: those that it kills, and what its author had that is anchored to them.
fn undone(scene: &State, script: &Script, at: usize) -> Undone {
    let made = &script.made[at];
    let known = || {
        let others = members(made.had).flat_map(|other| script.made[other].delta.records());
        scene.records().chain(others)
    };
    let kills = |dot: Dot| made.delta.context().contains(dot) && !made.delta.holds(dot);
    let killed = known().filter(|(dot, _)| kills(*dot));
    let mut undone: Undone = killed.map(|(dot, record)| (dot, record.clone())).collect();
    loop {
        let hangs = |record: &Record| record.anchors().any(|anchor| undone.contains_key(&anchor));
        let more = known().filter(|(dot, record)| !undone.contains_key(dot) && hangs(record));
        let more: Vec<(Dot, Record)> = more.map(|(dot, record)| (dot, record.clone())).collect();
        if more.is_empty() {
            return undone;
        }
        undone.extend(more);
    }
}

/// Whether two records say something of the same: one attribute, one edge, one vertex's parent, one functional label.
fn are_of_one(left: &Record, right: &Record, dictionary: &Dictionary) -> bool {
    match (left, right) {
        (Record::Write(left), Record::Write(right)) => left.target == right.target && left.name == right.name,
        (Record::Edge(left), Record::Edge(right)) => {
            let from_one = left.from == right.from;
            left.label == right.label
                && if left.is_rt() {
                    left.to == right.to
                } else {
                    from_one && (left.to == right.to || dictionary.is_functional(&left.label))
                }
        }
        _ => false,
    }
}

/// Whether no repair is made, no attribute is written twice, no mutation undoes what its author has not seen, and of no
/// two that are concurrent one says something of what the other undoes.
fn is_alone(dictionary: &Dictionary, script: &Script, undone: &[Undone], set: Set, seen: &Seen) -> bool {
    let dies_unseen = members(set).any(|at| {
        let mut records = script.made[at].delta.records();
        records.any(|(dot, _)| {
            seen.fate(dot) == Fate::Dead && !members(set).any(|other| undone[other].contains_key(&dot))
        })
    });
    let contradicts = |at: usize, other: usize| {
        let mut records = script.made[at].delta.records();
        let is_of_one = |record| undone[other].values().any(|gone| are_of_one(record, gone, dictionary));
        script.is_concurrent(at, other) && records.any(|(_, record)| is_of_one(record))
    };
    // What both replace, each by something else.
    let replace = |at: usize, other: usize| {
        let only_remove = script.made[at].delta.is_empty() && script.made[other].delta.is_empty();
        let same = undone[at].keys().any(|dot| undone[other].contains_key(dot));
        script.is_concurrent(at, other) && !only_remove && same
    };
    let disputes = |at: usize, other: usize| at != other && (contradicts(at, other) || replace(at, other));
    let is_disputed = members(set).any(|at| members(set).any(|other| disputes(at, other)));
    seen.repairs.is_empty() && !seen.has_two_writes && !dies_unseen && !is_disputed
}
