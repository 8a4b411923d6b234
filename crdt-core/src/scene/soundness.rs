//! Whether a graph keeps the invariants: what the view would have to repair is a fault. `[spec: SCENE-13]`

use super::assemble::Assembled;
use super::fault::{Fault, FaultKind};
use super::graph::Graph;
use super::place::{Place, SymbolRef};
use super::symbols::{Link, Symbol};
use crate::dictionary::Dictionary;
use crate::dot::{Dot, EdgeId, VertexId};
use crate::record::Edge;
use crate::view::{Placement, Repair, Rule, View, view};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::string::ToString;
use alloc::vec;
use alloc::vec::Vec;

/// What is unsound, each with what would have to be left out.
#[derive(Default)]
pub(super) struct Unsound {
    /// Links that the view hides, by symbol and link.
    pub(super) hidden: Vec<(Fault, (usize, usize))>,
    /// Symbols without a path to the root.
    pub(super) unreached: Vec<(Fault, usize)>,
    /// Tops of trees that are not the root's, with the links of their trees.
    pub(super) detached: Vec<(Fault, Vec<(usize, usize)>)>,
    /// Repairs that none of these explains.
    pub(super) other: Vec<Fault>,
}

/// Judges an assembled graph. `[spec: SCENE-13]`
pub(super) fn judge(graph: &Graph, assembled: &Assembled, dictionary: &Dictionary) -> Unsound {
    let view = view(&assembled.state, dictionary);
    let judge = Judge { graph, assembled, view: &view };
    let mut unsound = Unsound { unreached: judge.unreached(), ..Unsound::default() };
    let unreached: BTreeSet<usize> = unsound.unreached.iter().map(|&(_, at)| at).collect();
    let mut cut = BTreeSet::new();
    for repair in view.repairs() {
        if let Some((fault, link, child)) = judge.hidden(repair) {
            unsound.hidden.push((fault, link));
            cut.insert(child);
        }
    }
    for repair in view.repairs() {
        match repair {
            Repair::Superseded { .. } | Repair::CycleBroken { .. } => {}
            Repair::Detached { vertex } | Repair::Reattached { vertex } => {
                // Not a fault of its own below a cycle that is one, or where nothing leads to the root.
                let at = judge.symbol_of(*vertex);
                if cut.contains(vertex) || at.is_some_and(|(at, _)| unreached.contains(&at)) {
                    continue;
                }
                if let (Repair::Detached { .. }, Some((_, symbol))) = (repair, at) {
                    unsound.detached.push(judge.detached(*vertex, symbol));
                }
            }
            Repair::NameClash { .. } | Repair::Undeclared { .. } => {
                unsound.other.push(fault_at(
                    0,
                    Place::default(),
                    FaultKind::Repaired { repair: repair.to_string() },
                ));
            }
        }
    }
    unsound
}

fn fault_at(at: usize, place: Place, kind: FaultKind) -> Fault {
    Fault { place, kind, at }
}

struct Judge<'j> {
    graph: &'j Graph,
    assembled: &'j Assembled,
    view: &'j View<'j>,
}

impl<'j> Judge<'j> {
    fn symbol_of(&self, vertex: VertexId) -> Option<(usize, &'j Symbol)> {
        let &at = self.assembled.symbols.get(&vertex)?;
        self.graph.symbols.get(at).map(|symbol| (at, symbol))
    }

    fn reference(&self, vertex: VertexId) -> SymbolRef {
        let unknown = || SymbolRef { id: vertex.to_string(), name: None };
        self.symbol_of(vertex).map_or_else(unknown, |(_, symbol)| symbol.reference())
    }

    fn link_of(&self, edge: Dot) -> Option<((usize, usize), &'j Symbol, &'j Link)> {
        let &(at, index) = self.assembled.links.get(&edge)?;
        let symbol = self.graph.symbols.get(at)?;
        symbol.links.get(index).map(|link| ((at, index), symbol, link))
    }

    fn edge(&self, id: EdgeId) -> Option<&'j Edge> {
        self.assembled.state.edge(id.0)
    }

    /// The fault of a hidden link, which link it is, and its target.
    fn hidden(&self, repair: &Repair) -> Option<(Fault, (usize, usize), VertexId)> {
        let (hidden, kind) = match repair {
            Repair::Superseded { hidden, shown, rule } => {
                let (lost, won) = (self.edge(*hidden)?, self.edge(*shown)?);
                let kind = match rule {
                    Rule::RtParent => FaultKind::TwoParents {
                        child: self.reference(lost.to),
                        parent: self.reference(lost.from),
                        other: self.reference(won.from),
                    },
                    Rule::Functional => {
                        FaultKind::Functional { label: lost.label.clone(), other: self.reference(won.to) }
                    }
                    Rule::SameKey => FaultKind::RepeatedLink,
                };
                (*hidden, kind)
            }
            Repair::CycleBroken { hidden } => (*hidden, self.cycle(self.edge(*hidden)?)),
            _ => return None,
        };
        let (link_at, symbol, link) = self.link_of(hidden.0)?;
        Some((fault_at(link.at, symbol.link_place(link), kind), link_at, self.edge(hidden)?.to))
    }

    /// The cycle that this edge would close, from its child down to its parent; of a long one the last part.
    fn cycle(&self, edge: &Edge) -> FaultKind {
        const SHOWN_MAX: usize = 32;
        let mut up = self.view.ancestors(edge.from).take_while(|&at| at != edge.to);
        let mut cycle: Vec<SymbolRef> =
            up.by_ref().take(SHOWN_MAX).map(|vertex| self.reference(vertex)).collect();
        let is_whole = up.next().is_none();
        cycle.push(self.reference(edge.to));
        cycle.reverse();
        FaultKind::Cycle { cycle, is_whole }
    }

    /// Symbols without a path to the root over any links of the file, hidden ones included.
    fn unreached(&self) -> Vec<(Fault, usize)> {
        let mut neighbours: BTreeMap<VertexId, Vec<VertexId>> = BTreeMap::new();
        for &dot in self.assembled.links.keys() {
            let Some(edge) = self.edge(EdgeId(dot)) else { continue };
            neighbours.entry(edge.from).or_default().push(edge.to);
            neighbours.entry(edge.to).or_default().push(edge.from);
        }
        let mut reached = BTreeSet::from([VertexId::ROOT]);
        let mut frontier = vec![VertexId::ROOT];
        while let Some(vertex) = frontier.pop() {
            let next = neighbours.get(&vertex).into_iter().flatten();
            frontier.extend(next.filter(|&&vertex| reached.insert(vertex)));
        }
        let symbols = self.graph.symbols.iter().zip(&self.assembled.vertices).enumerate();
        symbols
            .filter(|(_, (_, vertex))| !reached.contains(vertex))
            .map(|(at, (symbol, _))| (fault_at(symbol.at, symbol.place(), FaultKind::NoPath), at))
            .collect()
    }

    /// The fault of a detached top, and the links of its tree.
    fn detached(&self, top: VertexId, symbol: &Symbol) -> (Fault, Vec<(usize, usize)>) {
        let (mut links, mut named) = (Vec::new(), Vec::new());
        let mut frontier = vec![top];
        while let Some(parent) = frontier.pop() {
            for shown in self.view.edges_from(parent) {
                let is_child =
                    self.view.placement(shown.edge.to) == Some(Placement::Child { parent, edge: shown.id });
                if let (true, Some((link, ..))) = (is_child, self.link_of(shown.id.0)) {
                    links.push(link);
                    named.push((self.reference(parent), self.reference(shown.edge.to)));
                    frontier.push(shown.edge.to);
                }
            }
        }
        (fault_at(symbol.at, symbol.place(), FaultKind::Detached { links: named }), links)
    }
}
