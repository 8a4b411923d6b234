//! Names as numbers: labels, types and attribute names are kept once, for as long as a record uses them.

use super::map::Map;
use crate::record::{Name, RT};

/// A name's number. Numbers are given anew after the last use: they say nothing to anybody else.
pub(super) type NameId = u32;

/// The label of kinematic edges, whose number never changes.
pub(super) const RT_ID: NameId = 0;

/// A name and how many records use it.
#[derive(Clone, Debug)]
struct Entry {
    name: Name,
    uses: usize,
    functional: bool,
}

/// The names in use.
#[derive(Clone, Debug)]
pub(super) struct Names {
    ids: Map<Name, NameId>,
    entries: Map<NameId, Entry>,
    free: Map<NameId, ()>,
}

impl Names {
    pub(super) fn new() -> Self {
        let mut names = Self { ids: Map::default(), entries: Map::default(), free: Map::default() };
        names.hold(&RT.into(), false);
        names
    }

    /// The number of a name in use.
    pub(super) fn find(&self, name: &str) -> Option<NameId> {
        self.ids.get(name).copied()
    }

    /// Uses a name once more.
    pub(super) fn hold(&mut self, name: &Name, functional: bool) -> NameId {
        if let Some(id) = self.find(name) {
            if let Some(entry) = self.entries.get_mut(&id) {
                entry.uses += 1;
            }
            return id;
        }
        let freed = self.free.last().map(|(&id, ())| id);
        // Fewer names than records, and these are fewer than numbers: their dots alone would fill the memory.
        let id = freed.unwrap_or_else(|| self.entries.last().map_or(RT_ID, |(&id, _)| id + 1));
        self.free.remove(&id);
        self.ids.insert(name.clone(), id);
        self.entries.insert(id, Entry { name: name.clone(), uses: 1, functional });
        id
    }

    /// Uses a name once less.
    pub(super) fn release(&mut self, id: NameId) {
        let Some(entry) = self.entries.get_mut(&id) else { return };
        entry.uses -= 1;
        if entry.uses == 0
            && let Some(entry) = self.entries.remove(&id)
        {
            self.ids.remove(&entry.name);
            self.free.insert(id, ());
        }
    }

    /// The name of a number in use; that of `RT` for any other.
    pub(super) fn name(&self, id: NameId) -> Name {
        self.text(id).cloned().unwrap_or_else(|| RT.into())
    }

    /// The name of a number in use.
    pub(super) fn text(&self, id: NameId) -> Option<&Name> {
        self.entries.get(&id).map(|entry| &entry.name)
    }

    /// Whether a source shows at most one edge of this label.
    pub(super) fn is_functional(&self, id: NameId) -> bool {
        self.entries.get(&id).is_some_and(|entry| entry.functional)
    }

    /// How often each is used.
    #[cfg(test)]
    pub(super) fn uses(&self) -> alloc::collections::BTreeMap<NameId, usize> {
        self.entries.iter().map(|(&id, entry)| (id, entry.uses)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn law_a_name_has_one_number_while_it_is_used_and_leaves_nothing() {
        let mut names = Names::new();
        let [a, b]: [Name; 2] = ["a".into(), "b".into()];
        let first = names.hold(&a, true);
        assert_eq!((names.hold(&a, true), names.find(&a)), (first, Some(first)));
        let second = names.hold(&b, false);
        assert!(first != second && names.is_functional(first) && !names.is_functional(second));
        names.release(first);
        assert_eq!(names.name(first), a);
        names.release(first);
        assert_eq!((names.find(&a), names.uses().len()), (None, 2));
        assert_eq!((names.hold(&RT.into(), false), names.hold(&a, false)), (RT_ID, first));
    }
}
