//! Symbols judged together: unique ids and names, one root, links that lead somewhere. `[spec: SCENE-12]`

use super::collect::Faults;
use super::fault::FaultKind;
use super::place::{Place, SymbolRef};
use super::symbols::{Symbol, Symbols};
use crate::RT;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

/// The symbols of a graph in ascending order of ids, their links in ascending order of target and label.
#[derive(Debug)]
pub(super) struct Graph {
    pub(super) symbols: Vec<Symbol>,
    /// Which of them is the root.
    pub(super) root: usize,
}

/// Judges symbols together; what is unsound is left out and becomes a fault. `None` without one root.
pub(super) fn resolve(read: Symbols, faults: &mut Faults) -> Option<Graph> {
    let mut broken: BTreeSet<u64> = read.broken.iter().copied().collect();
    let mut symbols = unique(read.sound, &mut broken, faults);
    symbols.sort_by_key(|symbol| symbol.id);
    let roots: Vec<usize> =
        symbols.iter().enumerate().filter(|(_, symbol)| is_root(symbol)).map(|(at, _)| at).collect();
    let root = match *roots.as_slice() {
        [root] => Some(root),
        [] => {
            faults.push(0, &Place::default(), FaultKind::NoRoot);
            None
        }
        [_, second, ..] => {
            let roots = roots.iter().filter_map(|&at| symbols.get(at)).map(Symbol::reference).collect();
            let at = symbols.get(second).map_or(0, |symbol| symbol.at);
            faults.push(at, &Place::default(), FaultKind::TwoRoots { roots });
            None
        }
    };
    let root_id = root.and_then(|at| symbols.get(at)).map(|symbol| symbol.id);
    let known: BTreeSet<u64> = symbols.iter().map(|symbol| symbol.id).collect();
    for symbol in &mut symbols {
        check_links(symbol, root_id, &known, &broken, faults);
    }
    Some(Graph { symbols, root: root? })
}

/// Whether a symbol could be the root. `[spec: SCENE-12]`
pub(super) fn is_root(symbol: &Symbol) -> bool {
    crate::is_root_name(&symbol.name) || crate::is_root_name(&symbol.vertex_type)
}

fn unique(symbols: Vec<Symbol>, broken: &mut BTreeSet<u64>, faults: &mut Faults) -> Vec<Symbol> {
    let mut ids: BTreeMap<u64, SymbolRef> = BTreeMap::new();
    let mut names: BTreeMap<crate::Name, SymbolRef> = BTreeMap::new();
    let mut kept = Vec::with_capacity(symbols.len());
    for symbol in symbols {
        let kind = if let Some(first) = ids.get(&symbol.id) {
            FaultKind::RepeatedId { id: symbol.id, first: first.clone() }
        } else if let Some(first) = names.get(&symbol.name) {
            broken.insert(symbol.id);
            FaultKind::RepeatedName { name: symbol.name.clone(), first: first.clone() }
        } else {
            ids.insert(symbol.id, symbol.reference());
            names.insert(symbol.name.clone(), symbol.reference());
            kept.push(symbol);
            continue;
        };
        faults.push(symbol.at, &symbol.place(), kind);
    }
    kept
}

/// Leaves out the links that lead nowhere or nowhere allowed, and sorts the others.
fn check_links(
    symbol: &mut Symbol,
    root: Option<u64>,
    known: &BTreeSet<u64>,
    broken: &BTreeSet<u64>,
    faults: &mut Faults,
) {
    let mut links = core::mem::take(&mut symbol.links);
    let mut keys = BTreeSet::new();
    links.retain(|link| {
        let target = link.target;
        let kind = if target == symbol.id {
            FaultKind::SelfLoop
        } else if !known.contains(&target) {
            if broken.contains(&target) {
                FaultKind::BrokenTarget { target }
            } else {
                FaultKind::UnknownTarget { target }
            }
        } else if &*link.label == RT && Some(target) == root {
            FaultKind::IntoRoot
        } else if !keys.insert((target, link.label.clone())) {
            FaultKind::RepeatedLink
        } else {
            return true;
        };
        faults.push(link.at, &symbol.link_place(link), kind);
        false
    });
    links.sort_by(|l, r| (l.target, &l.label).cmp(&(r.target, &r.label)));
    symbol.links = links;
}
