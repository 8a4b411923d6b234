//! `dsr scene dot`.

use super::Reading;
use super::names::Named;
use crate::input::FILE_HELP;
use crate::output::{add, out};
use crate::status::Status;
use dsr_core::{Repair, VertexId, view};
use std::collections::BTreeMap;

#[derive(clap::Args, Debug)]
pub(crate) struct Arguments {
    #[arg(value_name = "FILE", help = FILE_HELP)]
    file: String,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Result<Status, Status> {
    let dictionary = arguments.reading.dictionary()?;
    let loaded = arguments.reading.load_or_tell(&arguments.file, &dictionary)?;
    let graph = view(&loaded.scene.state, &dictionary);
    let named = Named::new(&loaded.scene, &graph);
    let vertices = named.vertices();
    let numbers: BTreeMap<VertexId, usize> =
        vertices.iter().enumerate().map(|(index, &vertex)| (vertex, index)).collect();
    let number = |vertex: VertexId| numbers.get(&vertex).copied().unwrap_or_default();
    let mut text =
        String::from("digraph scene {\n    rankdir=LR;\n    node [shape=box, fontname=\"sans-serif\"];\n");
    text += "    edge [fontname=\"sans-serif\", fontsize=10];\n";
    for (index, &vertex) in vertices.iter().enumerate() {
        let style = if vertex.is_root() { ", style=bold" } else { "" };
        let (name, vertex_type) = (escape(named.raw_name(vertex)), escape(named.vertex_type(vertex)));
        add(&mut text, format_args!("    v{index} [label=\"{name}\\n{vertex_type}\"{style}];\n"));
    }
    let mut edges: Vec<_> = graph.edges().iter().map(|shown| shown.edge).collect();
    edges.sort_by_key(|edge| (number(edge.from), number(edge.to), edge.label.clone()));
    for edge in edges {
        // Kinematic edges carry the layout; symbolic ones are drawn over it.
        let style = if edge.is_rt() { "style=bold" } else { "style=dashed, constraint=false" };
        let (from, to, label) = (number(edge.from), number(edge.to), escape(&edge.label));
        add(&mut text, format_args!("    v{from} -> v{to} [label=\"{label}\", {style}];\n"));
    }
    for repair in graph.repairs() {
        if let Repair::Detached { vertex } | Repair::Reattached { vertex } = repair {
            let kind = repair.kind();
            add(
                &mut text,
                format_args!(
                    "    v{} -> v{} [label=\"{kind}\", style=dotted, color=red];\n",
                    number(VertexId::ROOT),
                    number(*vertex)
                ),
            );
        }
    }
    text += "}\n";
    out(&text);
    Ok(Status::Claimed)
}

/// Text inside a quoted Graphviz string.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '"' | '\\' => escaped.extend(['\\', character]),
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}
