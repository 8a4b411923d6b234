//! What an engine shows, in the form of the protocol. `[spec: CONF-7]`

use super::handles::Handles;
use crate::protocol::{EdgeView, RootView, Tagged, Unique, VertexView, View};
use dsr_core::{Dot, Repair, Shows, VertexId};
use std::collections::BTreeMap;

pub(crate) fn shown(view: &dyn Shows, handles: &Handles) -> View {
    let mut winners: BTreeMap<Dot, Unique<Tagged>> = BTreeMap::new();
    for (_, write) in view.writes() {
        // The winner of each attribute stands before its rivals.
        let attributes = &mut winners.entry(write.target).or_default().0;
        attributes.entry(write.name.to_string()).or_insert_with(|| Tagged(write.value.clone()));
    }
    let mut attributes = |dot: Dot| winners.remove(&dot).unwrap_or_default();
    let root = RootView { attributes: attributes(VertexId::ROOT.0) };
    let mut vertices = BTreeMap::new();
    for &id in view.vertices().iter().filter(|id| !id.is_root()) {
        let Some(vertex) = view.state().vertex(id.0) else { continue };
        let (r#type, name) = (vertex.vertex_type.to_string(), vertex.name.to_string());
        vertices.insert(handles.name(id), VertexView { r#type, name, attributes: attributes(id.0) });
    }
    let edges = view.edges().iter().map(|shown| EdgeView {
        from: handles.name(shown.edge.from),
        label: shown.edge.label.to_string(),
        to: handles.name(shown.edge.to),
        attributes: attributes(shown.id.0),
    });
    View {
        edges: edges.collect(),
        vertices: Unique(vertices),
        root,
        hung: view.repairs().iter().filter_map(hung).map(|id| handles.name(id)).collect(),
        repairs: Some(view.repairs().iter().map(Repair::kind).map(String::from).collect()),
    }
}

/// Whom a repair links to ROOT. `[spec: VIEW-4]` `[spec: VIEW-5]`
const fn hung(repair: &Repair) -> Option<VertexId> {
    match repair {
        Repair::Detached { vertex } | Repair::Reattached { vertex } => Some(*vertex),
        _ => None,
    }
}
