//! What a replica shows and holds back, for traces. `[spec: TRACE-2]`

use super::Key;
use super::graph::Attribute;
use super::replica::Replica;
use crate::graph::{Attributes, Element, Graph};
use std::collections::BTreeMap;

impl Replica {
    /// What users of this replica see; what it holds back, has deleted, or died of is remarked.
    pub fn picture(&self) -> Graph {
        let mut graph = Graph::default();
        for (id, node) in self.shown() {
            let Some(node) = node else {
                graph.remarks.insert(format!("#{id} is present and holds nothing"));
                continue;
            };
            let (name, attributes) = (format!("#{id} {}", node.name), attributes(&node.attributes));
            let vertex = Element::Vertex { name, vertex_type: node.kind.into(), attributes };
            graph.elements.insert(format!("#{id}"), vertex);
            for ((to, kind), edge) in &node.edges {
                let key = format!("#{id} -{kind}-> #{to}");
                let Some(edge) = edge else {
                    graph.remarks.insert(format!("{key} is present and holds nothing"));
                    continue;
                };
                let (from, end, says) = edge.says;
                if (from, end, says) != (id, *to, kind) {
                    graph.remarks.insert(format!("{key} says that it is #{from} -{says}-> #{end}"));
                }
                let (from, to, label) = (format!("#{id}"), format!("#{to}"), (*kind).to_owned());
                let edge = Element::Edge { from, to, label, attributes: self::attributes(&edge.attributes) };
                graph.elements.insert(key, edge);
            }
        }
        graph.remarks.extend(self.remarks());
        graph
    }

    fn remarks(&self) -> impl Iterator<Item = String> + '_ {
        let deleted = self.deleted.iter().map(|id| format!("#{id} is deleted here"));
        let attributes = self.buffers.node_attributes.keys();
        let attributes = attributes.map(|(id, key)| format!("#{id}.{key} waits for its node"));
        let starts = self.buffers.edges_from.keys();
        let starts = starts.map(|(from, to, kind)| format!("#{from} -{kind}-> #{to} waits for its start"));
        let ends = self.buffers.edges_to.iter().flat_map(|(to, all)| {
            all.iter().map(move |(from, kind, _)| format!("#{from} -{kind}-> #{to} waits for its end"))
        });
        let of_edges = self.buffers.edge_attributes.keys();
        let of_edges =
            of_edges.map(|(from, to, kind, key)| format!("#{from} -{kind}-> #{to}.{key} waits for its edge"));
        let held = attributes.chain(starts).chain(ends).chain(of_edges);
        let misnamed = self.nodes.values().filter_map(|register| register.value()).filter_map(|node| {
            let led = self.ids.get(&node.name);
            (led != Some(&node.id)).then(|| match led {
                Some(other) => format!("the name {} leads to #{other}, not to #{}", node.name, node.id),
                None => format!("the name {} leads nowhere", node.name),
            })
        });
        let crash = self.crash.iter().map(|crash| format!("it has stopped: {crash}"));
        deleted.chain(held).chain(misnamed).chain(crash)
    }
}

fn attributes(held: &BTreeMap<Key, Option<Attribute>>) -> Attributes {
    let text = |held: &Option<Attribute>| match held {
        Some(held) => held.value.to_string(),
        None => "empty".into(),
    };
    held.iter().map(|(&key, held)| (key.to_owned(), text(held))).collect()
}
