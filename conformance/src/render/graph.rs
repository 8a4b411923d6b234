//! A view as a small drawing.

use super::words::attributes;
use crate::protocol::{EdgeView, ROOT, View};
use dsr_core::RT;
use std::collections::BTreeSet;

/// The kinematic tree with its vertices, then the other edges, then what hangs and what was repaired. A view that is no
/// tree is drawn as far as it is one.
pub fn graph(view: &View) -> String {
    let view = view.clone().canonical();
    let mut lines = vec![format!("{ROOT}{}", attributes(&view.root.attributes))];
    let mut drawn = BTreeSet::from([ROOT.to_owned()]);
    below(&view, ROOT, 1, &mut drawn, &mut lines);
    for handle in &view.hung {
        if drawn.insert(handle.clone()) {
            lines.push(format!("  ┄ {} (hung by repair)", vertex(&view, handle)));
            below(&view, handle, 2, &mut drawn, &mut lines);
        }
    }
    let others = view.edges.iter().filter(|edge| edge.label != RT).collect::<Vec<_>>();
    for handle in view.vertices.0.keys() {
        if drawn.insert(handle.clone()) {
            lines.push(format!("  {}", vertex(&view, handle)));
            below(&view, handle, 2, &mut drawn, &mut lines);
        }
    }
    lines.extend(others.into_iter().map(|edge| format!("{}{}", named(edge), attributes(&edge.attributes))));
    if let Some(repairs) = view.repairs.as_ref().filter(|repairs| !repairs.is_empty()) {
        lines.push(format!("repaired: {}", repairs.join(", ")));
    }
    lines.join("\n") + "\n"
}

fn below(view: &View, parent: &str, depth: usize, drawn: &mut BTreeSet<String>, lines: &mut Vec<String>) {
    // A path is no longer than there are vertices: `drawn` ends cycles.
    for edge in view.edges.iter().filter(|edge| edge.label == RT && edge.from == parent) {
        if drawn.insert(edge.to.clone()) {
            let with = attributes(&edge.attributes);
            let with = if with.is_empty() { with } else { format!(" (edge{with})") };
            lines.push(format!("{}└ {}{with}", "  ".repeat(depth), vertex(view, &edge.to)));
            below(view, &edge.to, depth + 1, drawn, lines);
        } else {
            lines.push(format!("{}└ {} again", "  ".repeat(depth), edge.to));
        }
    }
}

fn vertex(view: &View, handle: &str) -> String {
    match view.vertices.0.get(handle) {
        Some(shown) => {
            format!("{handle}: {} {:?}{}", shown.r#type, shown.name, attributes(&shown.attributes))
        }
        None => format!("{handle}: not there"),
    }
}

fn named(edge: &EdgeView) -> String {
    format!("{} -{}-> {}", edge.from, edge.label, edge.to)
}
