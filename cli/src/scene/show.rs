//! `dsr scene show`.

use super::Reading;
use super::names::{Named, tuple};
use crate::input::FILE_HELP;
use crate::output::{add, err, out, plain};
use crate::status::Status;
use dsr_core::{Dot, Placement, RT, Repair, ShownEdge, VertexId, view};

#[derive(clap::Args, Debug)]
pub(crate) struct Arguments {
    #[arg(value_name = "FILE", help = FILE_HELP)]
    file: String,
    /// Only this vertex, with all of its attributes and edges
    #[arg(long, value_name = "NAME")]
    vertex: Option<String>,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Result<Status, Status> {
    let dictionary = arguments.reading.dictionary()?;
    let loaded = arguments.reading.load_or_tell(&arguments.file, &dictionary)?;
    let graph = view(&loaded.scene.state, &dictionary);
    let named = Named::new(&loaded.scene, &graph);
    let Some(name) = &arguments.vertex else {
        out(&whole(&named));
        return Ok(Status::Claimed);
    };
    let Some(vertex) = named.find(name) else {
        let near = nearest(&named, name).map(|near| format!("; the nearest is {near:?}")).unwrap_or_default();
        err(format_args!("{}: no vertex is named {name:?}{near}", arguments.file));
        err(format_args!("  remedy: `dsr scene show {}` lists all names", arguments.file));
        return Err(Status::Usage);
    };
    out(&one(&named, vertex));
    Ok(Status::Claimed)
}

fn whole(named: &Named<'_>) -> String {
    let graph = named.view;
    let mut text = format!(
        "{} vertices, {} edges, {} attributes\n\nKinematic tree\n",
        graph.vertices().len(),
        graph.edges().len(),
        graph.writes().len()
    );
    let detached: Vec<VertexId> =
        named.vertices().into_iter().filter(|&v| graph.placement(v) == Some(Placement::Detached)).collect();
    for top in std::iter::once(VertexId::ROOT).chain(detached) {
        text += &tree(named, top);
    }
    let outside: Vec<VertexId> =
        named.vertices().into_iter().filter(|&v| graph.placement(v) == Some(Placement::Outside)).collect();
    if !outside.is_empty() {
        text += "\nWithout a place in the tree\n";
        for vertex in outside {
            add(&mut text, format_args!("  {}{}\n", head(named, vertex), summary(named, vertex.0)));
        }
    }
    let symbolic: Vec<&ShownEdge<'_>> = graph.edges().iter().filter(|shown| !shown.edge.is_rt()).collect();
    if !symbolic.is_empty() {
        text += "\nOther edges\n";
        for shown in symbolic {
            add(&mut text, format_args!("  {}{}\n", edge_line(named, shown), summary(named, shown.id.0)));
        }
    }
    if !graph.repairs().is_empty() {
        text += "\nRepairs\n";
        for repair in graph.repairs() {
            add(&mut text, format_args!("  {}\n", repair_line(named, repair)));
        }
    }
    text
}

/// A repair names dots; the names of its vertices help more.
fn repair_line(named: &Named<'_>, repair: &Repair) -> String {
    match repair {
        Repair::Detached { vertex } | Repair::Reattached { vertex } => {
            format!("{} ({repair})", named.name(*vertex))
        }
        _ => repair.to_string(),
    }
}

/// The tree below a vertex; not by recursion, since a scene may be one long chain.
fn tree(named: &Named<'_>, top: VertexId) -> String {
    const INDENT_MAX: usize = 60;
    let mut text = String::new();
    let mut pending = vec![(top, 0_usize, None)];
    while let Some((vertex, depth, edge)) = pending.pop() {
        let pose = edge.map(|edge| pose(named, edge)).unwrap_or_default();
        add(
            &mut text,
            format_args!(
                "{}{}{pose}{}\n",
                "  ".repeat(depth.min(INDENT_MAX) + 1),
                head(named, vertex),
                summary(named, vertex.0)
            ),
        );
        let mut children: Vec<(VertexId, Dot)> = named
            .view
            .edges_from(vertex)
            .iter()
            .filter(|shown| shown.edge.is_rt())
            .map(|shown| (shown.edge.to, shown.id.0))
            .collect();
        children.sort_by_key(|&(child, _)| std::cmp::Reverse((named.external_id(child), child)));
        pending.extend(children.into_iter().map(|(child, edge)| (child, depth + 1, Some(edge))));
    }
    text
}

fn head(named: &Named<'_>, vertex: VertexId) -> String {
    format!("{} ({})", named.name(vertex), plain(named.vertex_type(vertex)))
}

/// Where a child stands below its parent, in the units of the file.
fn pose(named: &Named<'_>, edge: Dot) -> String {
    let part = |name: &str| named.view.attribute(edge, name).map(|(_, write)| tuple(&write.value));
    let at = part("rt_translation").map(|at| format!("  at {at}")).unwrap_or_default();
    let turned = part("rt_rotation_euler_xyz").map(|turned| format!("  turned {turned}")).unwrap_or_default();
    if at.is_empty() && turned.is_empty() { "  no pose".to_owned() } else { at + &turned }
}

/// The first attributes of an element that are not told otherwise.
fn summary(named: &Named<'_>, target: Dot) -> String {
    const SHOWN_MAX: usize = 3;
    const TOLD: [&str; 4] = ["level", "parent", "rt_translation", "rt_rotation_euler_xyz"];
    let told = |name: &str| TOLD.contains(&name);
    let attributes: Vec<_> =
        named.view.attributes_of(target).filter(|(_, write)| !told(&write.name)).collect();
    if attributes.is_empty() {
        return String::new();
    }
    let first = attributes.iter().take(SHOWN_MAX);
    let mut parts: Vec<String> =
        first.map(|(_, write)| format!("{}={}", plain(&write.name), write.value)).collect();
    if attributes.len() > SHOWN_MAX {
        parts.push(format!("{} more", attributes.len() - SHOWN_MAX));
    }
    format!("  [{}]", parts.join(", "))
}

fn edge_line(named: &Named<'_>, shown: &ShownEdge<'_>) -> String {
    let edge = shown.edge;
    format!("{} -{}-> {}", named.name(edge.from), plain(&edge.label), named.name(edge.to))
}

fn one(named: &Named<'_>, vertex: VertexId) -> String {
    let graph = named.view;
    let mut text = head(named, vertex) + "\n";
    if let Some(id) = named.external_id(vertex) {
        add(&mut text, format_args!("  id {id}\n"));
    }
    let place = match graph.placement(vertex) {
        Some(Placement::Child { parent, edge }) => {
            format!("  {RT} child of {}{}\n", named.name(parent), pose(named, edge.0))
        }
        Some(Placement::Root) => "  the root\n".to_owned(),
        Some(Placement::Detached) => "  detached: its pose relative to the root is unknown\n".to_owned(),
        Some(Placement::Outside) | None => "  without a place in the kinematic tree\n".to_owned(),
    };
    text.push_str(&place);
    text += &attribute_lines(named, vertex.0, "  ");
    for shown in graph.edges().iter().filter(|shown| shown.edge.from == vertex || shown.edge.to == vertex) {
        add(
            &mut text,
            format_args!("  {}\n{}", edge_line(named, shown), attribute_lines(named, shown.id.0, "    ")),
        );
    }
    text
}

fn attribute_lines(named: &Named<'_>, target: Dot, indent: &str) -> String {
    let lines = named.view.attributes_of(target).map(|(_, write)| {
        format!("{indent}{} = {} ({})\n", plain(&write.name), write.value, write.value.value_type())
    });
    lines.collect()
}

/// The name that differs in the fewest letters, if it is near.
fn nearest<'n>(named: &Named<'n>, name: &str) -> Option<&'n str> {
    let known = named.view.vertices().iter().map(|&vertex| named.raw_name(vertex));
    known
        .map(|known| (distance(known, name), known))
        .min()
        .filter(|&(far, _)| far <= 3)
        .map(|(_, known)| known)
}

fn distance(left: &str, right: &str) -> usize {
    let right: Vec<char> = right.chars().collect();
    let mut row: Vec<usize> = (0..=right.len()).collect();
    for (index, character) in left.chars().enumerate() {
        let mut corner = index;
        let mut last = index + 1;
        for (other, cell) in right.iter().zip(row.iter_mut().skip(1)) {
            let cost = (corner + usize::from(character != *other)).min(last + 1).min(*cell + 1);
            corner = std::mem::replace(cell, cost);
            last = cost;
        }
        if let Some(first) = row.first_mut() {
            *first = index + 1;
        }
    }
    row.last().copied().unwrap_or_default()
}
