//! What has changed in the graph that is shown. `[spec: EVENT-1]` to `[spec: EVENT-5]`

mod between;

use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::{EdgeKey, Name};
use crate::view::Repair;
use alloc::vec::Vec;

/// One difference between the view before and the view after. `[spec: EVENT-1]`
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Change {
    /// A vertex is no longer in the graph.
    VertexRemoved {
        /// Which.
        vertex: VertexId,
        /// Its name while it was.
        name: Name,
    },
    /// A vertex is in the graph now; its author is `vertex.0.replica`.
    VertexAdded {
        /// Which.
        vertex: VertexId,
    },
    /// An edge instance is no longer shown: removed, superseded, or unseated.
    EdgeHidden {
        /// Which.
        edge: EdgeId,
        /// Its key.
        key: EdgeKey,
    },
    /// An edge instance is shown now; its author is `edge.0.replica`.
    EdgeShown {
        /// Which.
        edge: EdgeId,
        /// Its key.
        key: EdgeKey,
    },
    /// Other writes of an attribute are shown than before. With equal winners only what loses differs.
    Attribute {
        /// The vertex, the root, or the edge claim.
        target: Dot,
        /// The attribute.
        name: Name,
        /// The winning write before; `None` if none was shown.
        before: Option<Dot>,
        /// The winning write now, by `after.replica`; `None` if none is shown.
        after: Option<Dot>,
    },
    /// Something is no longer repaired.
    RepairGone(Repair),
    /// Something is repaired that was not, or otherwise.
    RepairMade(Repair),
}

/// Every difference between the views before and after, each once, in order. `[spec: EVENT-1]`
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct Changes(Vec<Change>);

impl Changes {
    pub(crate) fn one(change: Change) -> Self {
        Self(Vec::from([change]))
    }

    /// Whether what is shown is as it was.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// All, in order.
    pub fn iter(&self) -> core::slice::Iter<'_, Change> {
        self.0.iter()
    }
}

/// In whatever order they come.
impl FromIterator<Change> for Changes {
    fn from_iter<I: IntoIterator<Item = Change>>(changes: I) -> Self {
        let mut changes: Vec<Change> = changes.into_iter().collect();
        // They come in a few ascending runs, which a stable sort merges.
        changes.sort();
        Self(changes)
    }
}

impl<'c> IntoIterator for &'c Changes {
    type Item = &'c Change;
    type IntoIter = core::slice::Iter<'c, Change>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl IntoIterator for Changes {
    type Item = Change;
    type IntoIter = alloc::vec::IntoIter<Change>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}
