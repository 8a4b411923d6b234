//! Reading a scene, step by step; strictly or leniently. `[spec: SCENE-4]` `[spec: SCENE-5]`

use super::assemble::{Assembled, assemble};
use super::collect::Faults;
use super::fault::{FaultKind, SceneError};
use super::graph::{Graph, resolve};
use super::place::Place;
use super::soundness::{Unsound, judge};
use super::{Imported, RootNaming, Scene, Strictness, symbols, syntax};
use crate::dictionary::Dictionary;
use crate::limits;
use crate::wellformed::check_well_formed;
use alloc::collections::BTreeSet;

pub(super) fn read(
    text: &str,
    dictionary: &Dictionary,
    strictness: Strictness,
) -> Result<Imported, SceneError> {
    let mut faults = Faults::default();
    let scene = scene_of(text, dictionary, strictness, &mut faults);
    let refused = faults.is_fatal();
    let faults = faults.located(text);
    match scene {
        Some(scene) if !refused && (strictness == Strictness::Lenient || faults.is_empty()) => {
            Ok(Imported { scene, dropped: faults })
        }
        _ => Err(SceneError { faults }),
    }
}

/// The scene without what is unsound; `None` only after a fault.
fn scene_of(
    text: &str,
    dictionary: &Dictionary,
    strictness: Strictness,
    faults: &mut Faults,
) -> Option<Scene> {
    let document = document(text, faults)?;
    let symbols = symbols::read(&document, dictionary, faults)?;
    let mut graph = resolve(symbols, faults)?;
    let assembled = match strictness {
        Strictness::Strict => {
            let assembled = assemble(&graph);
            let unsound = judge(&graph, &assembled, dictionary);
            faults.extend(unsound.hidden.into_iter().map(|(fault, _)| fault));
            faults.extend(unsound.unreached.into_iter().map(|(fault, _)| fault));
            faults.extend(unsound.detached.into_iter().map(|(fault, _)| fault));
            faults.extend(unsound.other);
            assembled
        }
        Strictness::Lenient => reduce(&mut graph, dictionary, faults),
    };
    if let Err(malformed) = check_well_formed(&assembled.state) {
        faults.push(0, &Place::default(), malformed.into());
    }
    let root = graph.symbols.get(graph.root)?;
    let (name, vertex_type) = (root.name.clone(), root.vertex_type.clone());
    let root = RootNaming { name, vertex_type, external_id: Some(root.id) };
    Some(Scene { state: assembled.state, root })
}

/// The file as a tree, without what stands before and after the document.
fn document<'t>(text: &'t str, faults: &mut Faults) -> Option<syntax::Node<'t>> {
    let top = Place::default();
    let bytes = text.len();
    if bytes > limits::SCENE_BYTES_MAX {
        faults.push(0, &top, FaultKind::TooLarge { bytes });
        return None;
    }
    let start = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    if start > 0 {
        faults.push(0, &top, FaultKind::ByteOrderMark);
    }
    if text.get(start..).unwrap_or_default().trim_ascii().is_empty() {
        faults.push(0, &top, FaultKind::Empty);
        return None;
    }
    match syntax::parse(text, start) {
        Ok((node, end)) => {
            if end < bytes {
                faults.push(end, &top, FaultKind::TrailingText);
            }
            Some(node)
        }
        Err((at, error)) => {
            faults.push(at, &top, FaultKind::Syntax(error));
            None
        }
    }
}

/// Leaves out what is unsound, worst first, until the graph is sound. `[spec: SCENE-5]`
fn reduce(graph: &mut Graph, dictionary: &Dictionary, faults: &mut Faults) -> Assembled {
    loop {
        let assembled = assemble(graph);
        let Unsound { hidden, unreached, detached, other } = judge(graph, &assembled, dictionary);
        if !hidden.is_empty() {
            let links = hidden.iter().map(|&(_, link)| link).collect();
            faults.extend(hidden.into_iter().map(|(fault, _)| fault));
            drop_links(graph, &links);
        } else if !unreached.is_empty() {
            let symbols = unreached.iter().map(|&(_, at)| at).collect();
            faults.extend(unreached.into_iter().map(|(fault, _)| fault));
            drop_symbols(graph, &symbols);
        } else if !detached.is_empty() {
            let links = detached.iter().flat_map(|(_, links)| links).copied().collect();
            faults.extend(detached.into_iter().map(|(fault, _)| fault));
            drop_links(graph, &links);
        } else {
            faults.extend(other);
            return assembled;
        }
    }
}

fn drop_links(graph: &mut Graph, links: &BTreeSet<(usize, usize)>) {
    for (at, symbol) in graph.symbols.iter_mut().enumerate() {
        let mut index = 0;
        symbol.links.retain(|_| {
            index += 1;
            !links.contains(&(at, index - 1))
        });
    }
}

/// Whole components: no link joins a dropped symbol to a kept one.
fn drop_symbols(graph: &mut Graph, symbols: &BTreeSet<usize>) {
    let root = graph.symbols.get(graph.root).map(|symbol| symbol.id);
    let mut at = 0;
    graph.symbols.retain(|_| {
        at += 1;
        !symbols.contains(&(at - 1))
    });
    graph.root = graph.symbols.iter().position(|symbol| Some(symbol.id) == root).unwrap_or_default();
}
