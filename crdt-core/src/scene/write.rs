//! From any state to the text of a scene file. `[spec: SCENE-15]`

use super::naming::{Named, Note, named};
use super::values::{put, write_text};
use super::{Scene, Written, values};
use crate::dictionary::Dictionary;
use crate::dot::{Dot, VertexId};
use crate::view::{ShownEdge, View, view};
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

pub(super) fn write(scene: &Scene, dictionary: &Dictionary) -> Written {
    let view = view(&scene.state, dictionary);
    let mut notes = Vec::new();
    let named = named(scene, &view, &mut notes);
    notes.extend(view.stranded().iter().map(|&vertex| Note::Stranded { vertex }));
    let ids: BTreeMap<VertexId, u64> = named.iter().map(|(&id, entry)| (entry.vertex, id)).collect();
    let mut writer = Writer { out: Out::default(), view: &view, ids, records: view.vertices().len() - 1 };
    writer.out.open("{");
    writer.out.key("DSRModel");
    writer.out.open("{");
    writer.out.key("symbols");
    writer.out.open("{");
    for (index, (&id, entry)) in named.iter().enumerate() {
        writer.out.separate(index);
        writer.symbol(id, entry);
    }
    writer.out.close("}");
    writer.out.close("}");
    writer.out.close("}");
    writer.out.text.push('\n');
    let hidden = scene.state.len().saturating_sub(writer.records);
    if hidden > 0 {
        notes.push(Note::Hidden { records: hidden });
    }
    Written { text: writer.out.text, notes }
}

struct Writer<'w> {
    out: Out,
    view: &'w View<'w>,
    ids: BTreeMap<VertexId, u64>,
    /// How many records have been written.
    records: usize,
}

impl Writer<'_> {
    /// Keys in the order in which the published writer has them.
    fn symbol(&mut self, id: u64, entry: &Named) {
        self.out.quoted(id);
        self.out.text.push_str(": ");
        self.out.open("{");
        self.attributes("attribute", entry.vertex.0);
        self.out.separate(1);
        self.out.key("id");
        self.out.quoted(id);
        self.out.separate(1);
        self.out.key("links");
        self.links(id, entry.vertex);
        self.out.separate(1);
        self.out.key("name");
        write_text(&mut self.out.text, &entry.name);
        self.out.separate(1);
        self.out.key("type");
        write_text(&mut self.out.text, &entry.vertex_type);
        self.out.close("}");
    }

    /// By target and label.
    fn links(&mut self, source: u64, vertex: VertexId) {
        let view = self.view;
        let shown = view.edges_from(vertex).iter();
        let mut links: Vec<(u64, &ShownEdge<'_>)> =
            shown.filter_map(|shown| Some((*self.ids.get(&shown.edge.to)?, shown))).collect();
        links.sort_by(|l, r| (l.0, &l.1.edge.label).cmp(&(r.0, &r.1.edge.label)));
        self.out.open("[");
        for (index, (target, shown)) in links.iter().enumerate() {
            self.records += 1;
            self.out.separate(index);
            self.out.open("{");
            self.out.key("dst");
            self.out.quoted(*target);
            self.out.separate(1);
            self.out.key("label");
            write_text(&mut self.out.text, &shown.edge.label);
            self.out.separate(1);
            self.attributes("linkAttribute", shown.id.0);
            self.out.separate(1);
            self.out.key("src");
            self.out.quoted(source);
            self.out.close("}");
        }
        self.out.close("]");
    }

    /// The winning writes, by name; the time only where there is one.
    fn attributes(&mut self, key: &str, target: Dot) {
        self.out.key(key);
        self.out.open("{");
        let view = self.view;
        for (index, (_, written)) in view.attributes_of(target).enumerate() {
            self.records += 1;
            self.out.separate(index);
            self.out.key(&written.name);
            self.out.open("{");
            if written.timestamp_ns != 0 {
                self.out.key("timestamp_ns");
                self.out.quoted(written.timestamp_ns);
                self.out.separate(1);
            }
            self.out.key("type");
            put(&mut self.out.text, written.value.value_type().number());
            self.out.separate(1);
            self.out.key("value");
            values::write(&mut self.out.text, &written.value);
            self.out.close("}");
        }
        self.out.close("}");
    }
}

/// Text with four spaces per level, as the published writer lays it out.
#[derive(Default)]
struct Out {
    text: String,
    depth: usize,
}

impl Out {
    fn open(&mut self, bracket: &str) {
        self.text.push_str(bracket);
        self.depth += 1;
        self.line();
    }

    /// An empty list or object stays on one line.
    fn close(&mut self, bracket: &str) {
        self.depth = self.depth.saturating_sub(1);
        let content = self.text.trim_end().len();
        let empty = self.text.get(..content).is_some_and(|text| text.ends_with(['{', '[']));
        if empty {
            self.text.truncate(content);
        } else {
            self.line();
        }
        self.text.push_str(bracket);
    }

    fn line(&mut self) {
        self.text.push('\n');
        for _ in 0..self.depth {
            self.text.push_str("    ");
        }
    }

    /// A comma and a new line before every item but the first.
    fn separate(&mut self, index: usize) {
        if index > 0 {
            self.text.push(',');
            self.line();
        }
    }

    fn key(&mut self, key: &str) {
        write_text(&mut self.text, key);
        self.text.push_str(": ");
    }

    fn quoted(&mut self, number: u64) {
        put(&mut self.text, format_args!("\"{number}\""));
    }
}
