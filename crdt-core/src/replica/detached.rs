//! Trees whose tops are not the root: these hang from it by repair. `[spec: VIEW-4]`

use super::held::NONE;
use super::settle::Settling;
use crate::dot::VertexId;
use crate::view::Repair;

impl Settling<'_> {
    /// A top that has a child and no parent hangs from the root. `[spec: VIEW-4]`
    pub(super) fn settle_detached(&mut self) {
        let mut tops = core::mem::take(&mut self.tops);
        tops.extend(self.gone_vertices().map(|(dot, _)| dot));
        tops.sort_unstable();
        tops.dedup();
        for top in tops {
            let was = self.graph.detached.contains(&top);
            let is = self.graph.vertex_held(top).is_some_and(|top| top.parent() == NONE && top.children > 0);
            if was == is {
                continue;
            }
            self.detached_before.insert(top, was);
            let repair = Repair::Detached { vertex: VertexId(top) };
            if is {
                self.graph.detached.insert(top, ());
                self.repairs_after.push(repair);
            } else {
                self.graph.detached.remove(&top);
                self.repairs_before.push(repair);
            }
        }
    }
}
