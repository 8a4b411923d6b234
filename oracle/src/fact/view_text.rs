//! A view as one line. `[spec: ORACLE-3]`

use dsr_core::{Dot, EdgeId, Placement, Repair, Rule, VertexId, View};
use std::fmt::{Display, Write};

/// The view as text: equal for equal views, whoever computes it. `[spec: ORACLE-3]`
pub fn view_text(view: &View<'_>) -> String {
    let mut text = String::with_capacity(256);
    let vertices = view.vertices().iter().map(|&id| vertex(view, id));
    list(&mut text, "{\"vertices\":", vertices);
    let mut edges: Vec<EdgeId> = view.edges().iter().map(|shown| shown.id).collect();
    edges.sort_unstable();
    list(&mut text, ",\"edges\":", edges.iter().map(quoted));
    let registers = view
        .writes()
        .chunk_by(|(_, left), (_, right)| (left.target, &left.name) == (right.target, &right.name));
    list(&mut text, ",\"writes\":", registers.map(|writes| dots(writes.iter().map(|(dot, _)| *dot))));
    let mut repairs: Vec<String> = view.repairs().iter().map(repair).collect();
    repairs.sort_unstable();
    list(&mut text, ",\"repairs\":", repairs.into_iter());
    text.push('}');
    text
}

fn vertex(view: &View<'_>, id: VertexId) -> String {
    let place = match view.placement(id) {
        Some(Placement::Root) => "\"root\"".into(),
        Some(Placement::Child { parent, edge }) => format!("[{},{}]", quoted(parent), quoted(edge)),
        Some(Placement::Detached) => "\"detached\"".into(),
        Some(Placement::Outside) | None => "\"outside\"".into(),
    };
    let found = view.vertex(id).and_then(|vertex| view.vertex_by_name(&vertex.name));
    let found = found.map_or_else(|| "null".into(), quoted);
    let stranded = view.stranded().binary_search(&id).is_ok();
    format!("[{},{place},{stranded},{found}]", quoted(id))
}

fn repair(repair: &Repair) -> String {
    match repair {
        Repair::Superseded { hidden, shown, rule } => {
            let rule = match rule {
                Rule::SameKey => "same-key",
                Rule::Functional => "functional",
                Rule::RtParent => "rt-parent",
            };
            format!("[\"{rule}\",{},{}]", quoted(hidden), quoted(shown))
        }
        Repair::CycleBroken { hidden } => format!("[\"cycle-broken\",{}]", quoted(hidden)),
        Repair::Detached { vertex } => format!("[\"detached\",{}]", quoted(vertex)),
        Repair::Reattached { vertex } => format!("[\"reattached\",{}]", quoted(vertex)),
        Repair::NameClash { shown, hidden, .. } => {
            format!("[\"name-clash\",{},{}]", quoted(shown), quoted(hidden))
        }
        Repair::Undeclared { write } => format!("[\"undeclared\",{}]", quoted(write)),
    }
}

fn dots(dots: impl Iterator<Item = Dot>) -> String {
    let mut text = String::new();
    list(&mut text, "", dots.map(quoted));
    text
}

/// Ids have no character that JSON escapes.
fn quoted(id: impl Display) -> String {
    format!("\"{id}\"")
}

fn list(text: &mut String, before: &str, items: impl Iterator<Item = String>) {
    text.push_str(before);
    text.push('[');
    for (at, item) in items.enumerate() {
        if at > 0 {
            text.push(',');
        }
        // Writing to a string cannot fail.
        let _ = text.write_str(&item);
    }
    text.push(']');
}
