//! `dsr scene diff`.

use super::Reading;
use super::names::Named;
use crate::input::FILE_HELP;
use crate::output::{out, plain};
use crate::status::Status;
use dsr_core::{Dot, Value, VertexId, view};
use std::collections::{BTreeMap, BTreeSet};

pub(super) const AFTER: &str = "\
Vertices are the same if they have the same name, or else the same id in the file. Edges are the same if their \
ends and label are. Lines start with - (only in A), + (only in B) or ~ (in both, changed).

Exit status: 0 equal, 1 different, 3 wrong usage or input. Scenes are limited to 64 MiB, states to 1 GiB.";

#[derive(clap::Args, Debug)]
pub(crate) struct Arguments {
    #[arg(value_name = "A", help = FILE_HELP)]
    left: String,
    #[arg(value_name = "B", help = FILE_HELP)]
    right: String,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Result<Status, Status> {
    let dictionary = arguments.reading.dictionary()?;
    let left = arguments.reading.load_or_tell(&arguments.left, &dictionary)?;
    let right = arguments.reading.load_or_tell(&arguments.right, &dictionary)?;
    let (left_view, right_view) =
        (view(&left.scene.state, &dictionary), view(&right.scene.state, &dictionary));
    let lines = differences(&Named::new(&left.scene, &left_view), &Named::new(&right.scene, &right_view));
    if lines.is_empty() {
        out("equal\n");
        return Ok(Status::Claimed);
    }
    out(&(lines.join("\n") + "\n"));
    out(&format!("different: {} line(s)\n", lines.len()));
    Ok(Status::Violated)
}

/// Pairs of the same vertex, and what is in one graph alone.
struct Matching {
    /// From a vertex of B to the same one of A.
    to_left: BTreeMap<VertexId, VertexId>,
    pairs: Vec<(VertexId, VertexId)>,
    only_left: Vec<VertexId>,
    only_right: Vec<VertexId>,
}

fn matching(left: &Named<'_>, right: &Named<'_>) -> Matching {
    let mut pairs = vec![(VertexId::ROOT, VertexId::ROOT)];
    let mut matched = BTreeSet::from([VertexId::ROOT]);
    // A name that finds another vertex counts for that one alone.
    let finds = |named: &Named<'_>, vertex: VertexId| {
        named.view.vertex_by_name(named.raw_name(vertex)) == Some(vertex)
    };
    let mut rest = Vec::new();
    for vertex in left.vertices().into_iter().filter(|vertex| !vertex.is_root()) {
        let found = right.view.vertex_by_name(left.raw_name(vertex)).filter(|found| !found.is_root());
        match found.filter(|_| finds(left, vertex)) {
            Some(found) if matched.insert(found) => pairs.push((vertex, found)),
            _ => rest.push(vertex),
        }
    }
    let by_id: BTreeMap<u64, VertexId> = right
        .vertices()
        .into_iter()
        .filter(|vertex| !matched.contains(vertex))
        .filter_map(|vertex| right.external_id(vertex).map(|id| (id, vertex)))
        .collect();
    let mut only_left = Vec::new();
    for vertex in rest {
        match left.external_id(vertex).and_then(|id| by_id.get(&id)) {
            Some(&found) if matched.insert(found) => pairs.push((vertex, found)),
            _ => only_left.push(vertex),
        }
    }
    let only_right = right.vertices().into_iter().filter(|vertex| !matched.contains(vertex)).collect();
    let to_left = pairs.iter().map(|&(left, right)| (right, left)).collect();
    Matching { to_left, pairs, only_left, only_right }
}

/// An element as it is listed where it is in one graph alone.
fn vertex_line(sign: char, named: &Named<'_>, vertex: VertexId) -> String {
    let attributes = named.view.attributes_of(vertex.0).count();
    format!(
        "{sign} vertex {} ({}), {attributes} attribute(s)",
        named.name(vertex),
        plain(named.vertex_type(vertex))
    )
}

fn differences(left: &Named<'_>, right: &Named<'_>) -> Vec<String> {
    let matching = matching(left, right);
    let mut lines: Vec<String> =
        matching.only_left.iter().map(|&vertex| vertex_line('-', left, vertex)).collect();
    lines.extend(matching.only_right.iter().map(|&vertex| vertex_line('+', right, vertex)));
    for &(before, after) in &matching.pairs {
        let element = format!("vertex {}", left.name(before));
        let texts = [
            ("name", left.raw_name(before), right.raw_name(after)),
            ("type", left.vertex_type(before), right.vertex_type(after)),
        ];
        for (what, old, new) in texts {
            if old != new {
                lines.push(format!("~ {element}: {what} {} -> {}", plain(old), plain(new)));
            }
        }
        let (old, new) = (left.external_id(before), right.external_id(after));
        if old != new {
            lines.push(format!("~ {element}: id {} -> {}", id_text(old), id_text(new)));
        }
        lines.extend(attribute_lines(&element, &attributes(left, before.0), &attributes(right, after.0)));
    }
    lines.extend(edge_lines(left, right, &matching));
    lines
}

fn id_text(id: Option<u64>) -> String {
    id.map_or_else(|| "none".to_owned(), |id| id.to_string())
}

/// An end of an edge of B: the vertex of A that it is, or the vertex of B.
type End = Result<VertexId, VertexId>;

fn edge_lines(left: &Named<'_>, right: &Named<'_>, matching: &Matching) -> Vec<String> {
    let end = |vertex: VertexId| matching.to_left.get(&vertex).copied().ok_or(vertex);
    let before: BTreeMap<(End, End, &str), Dot> = left
        .view
        .edges()
        .iter()
        .map(|shown| ((Ok(shown.edge.from), Ok(shown.edge.to), &*shown.edge.label), shown.id.0))
        .collect();
    let after: BTreeMap<(End, End, &str), Dot> = right
        .view
        .edges()
        .iter()
        .map(|shown| ((end(shown.edge.from), end(shown.edge.to), &*shown.edge.label), shown.id.0))
        .collect();
    let name = |end: End| match end {
        Ok(vertex) => left.name(vertex),
        Err(vertex) => right.name(vertex),
    };
    let text = |&(from, to, label): &(End, End, &str)| {
        format!("edge {} -{}-> {}", name(from), plain(label), name(to))
    };
    let mut lines = Vec::new();
    for key in before.keys().filter(|key| !after.contains_key(*key)) {
        lines.push(format!("- {}", text(key)));
    }
    for key in after.keys().filter(|key| !before.contains_key(*key)) {
        lines.push(format!("+ {}", text(key)));
    }
    for (key, &old) in &before {
        if let Some(&new) = after.get(key) {
            lines.extend(attribute_lines(&text(key), &attributes(left, old), &attributes(right, new)));
        }
    }
    lines
}

type Attributes<'a> = BTreeMap<&'a str, (&'a Value, u64)>;

fn attributes<'n>(named: &Named<'n>, target: Dot) -> Attributes<'n> {
    named
        .view
        .attributes_of(target)
        .map(|(_, write)| (&*write.name, (&write.value, write.timestamp_ns)))
        .collect()
}

fn attribute_lines(element: &str, before: &Attributes<'_>, after: &Attributes<'_>) -> Vec<String> {
    let names: BTreeSet<&str> = before.keys().chain(after.keys()).copied().collect();
    let line = |name: &str| {
        let typed = |value: &Value| format!("{value} ({})", value.value_type());
        match (before.get(name), after.get(name)) {
            (Some((old, _)), None) => Some(format!("- {element}: {} = {}", plain(name), typed(old))),
            (None, Some((new, _))) => Some(format!("+ {element}: {} = {}", plain(name), typed(new))),
            (Some((old, _)), Some((new, _))) if old != new => {
                Some(format!("~ {element}: {} {} -> {}", plain(name), typed(old), typed(new)))
            }
            (Some((_, old)), Some((_, new))) if old != new => {
                Some(format!("~ {element}: {} timestamp_ns {old} -> {new}", plain(name)))
            }
            _ => None,
        }
    };
    names.into_iter().filter_map(line).collect()
}
