//! The core's view in the form of the protocol. `[spec: CONF-7]`

use super::handles::Handles;
use crate::protocol::{EdgeView, RootView, Tagged, Unique, VertexView, View};
use dsr_core::{Dot, Repair, VertexId, View as CoreView};

pub(crate) fn shown(view: &CoreView<'_>, handles: &Handles) -> View {
    let attributes = |dot: Dot| {
        let winners = view.attributes_of(dot);
        Unique(winners.map(|(_, write)| (write.name.to_string(), Tagged(write.value.clone()))).collect())
    };
    let vertex = |&id: &VertexId| {
        let vertex = view.vertex(id)?;
        let shown = VertexView {
            r#type: vertex.vertex_type.to_string(),
            name: vertex.name.to_string(),
            attributes: attributes(id.0),
        };
        Some((handles.name(id), shown))
    };
    let edges = view.edges().iter().map(|shown| EdgeView {
        from: handles.name(shown.edge.from),
        label: shown.edge.label.to_string(),
        to: handles.name(shown.edge.to),
        attributes: attributes(shown.id.0),
    });
    View {
        vertices: Unique(view.vertices().iter().filter_map(vertex).collect()),
        edges: edges.collect(),
        root: RootView { attributes: attributes(VertexId::ROOT.0) },
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
