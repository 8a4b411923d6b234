//! What the checker judges, as it says itself.

use crate::{ClauseId, Clauses, Gap, Place, Source};
use serde_json::Value;

/// Where the model keeps it, from the workspace root.
pub const JUDGED_PATH: &str = "model/data/judged.json";

/// The layer of random walks: a sample, whatever it finds (CHECK-13).
pub(crate) const WALKS: &str = "L3";

/// A layer of the default suite.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Layer {
    /// `L0`, `L1`, `L2`, `L3`, `L1 = L2` or `scenario`.
    pub name: String,
    /// Its runs, by their bounds.
    pub runs: Vec<String>,
    /// What it judges: clauses, and what it says of each.
    pub judges: Vec<(ClauseId, String)>,
}

impl Layer {
    /// Its name, without what tells those of its runs that ask both cores.
    pub fn kind(&self) -> &str {
        self.name.trim_end_matches(" (both cores)")
    }

    /// Whether it visits every state within its bounds, or only samples.
    pub fn is_exhaustive(&self) -> bool {
        self.kind() != WALKS
    }

    /// The runs in short: those that differ in two kinds of mutation are one.
    pub fn bounds(&self) -> Vec<(String, usize)> {
        let mut bounds: Vec<(String, usize)> = Vec::new();
        for run in &self.runs {
            let parts = run.split(", ").map(|part| if part.contains(" + ") { "two kinds" } else { part });
            let bound = parts.collect::<Vec<_>>().join(", ");
            match bounds.iter_mut().find(|(known, _)| *known == bound) {
                Some((_, count)) => *count += 1,
                None => bounds.push((bound, 1)),
            }
        }
        bounds
    }
}

/// The layers that the file lists.
pub fn layers_of(source: &Source, clauses: &Clauses, gaps: &mut Vec<Gap>) -> Vec<Layer> {
    let unreadable = |why: String| Gap::Unreadable { path: source.path.clone(), why };
    let json: Value = match serde_json::from_str(&source.text) {
        Ok(json) => json,
        Err(error) => {
            gaps.push(unreadable(error.to_string()));
            return Vec::new();
        }
    };
    let listed = json["layers"].as_array().map_or(&[][..], Vec::as_slice);
    let layers: Option<Vec<Layer>> = listed.iter().map(layer_of).collect();
    let Some(layers) = layers.filter(|layers| !layers.is_empty()) else {
        gaps.push(unreadable("no layers, each with its name, its runs and what it judges".into()));
        return Vec::new();
    };
    for (id, _) in layers.iter().flat_map(|layer| &layer.judges) {
        if clauses.get(id).is_none() {
            let place = Place { path: source.path.clone(), line: 1 };
            gaps.push(Gap::UnknownClause { id: id.clone(), place });
        }
    }
    layers
}

fn layer_of(json: &Value) -> Option<Layer> {
    let text = |json: &Value| json.as_str().map(String::from);
    let judged = |json: &Value| Some((json["clause"].as_str()?.parse().ok()?, text(&json["says"])?));
    Some(Layer {
        name: text(&json["layer"])?,
        runs: json["runs"].as_array()?.iter().map(text).collect::<Option<_>>()?,
        judges: json["judges"].as_array()?.iter().map(judged).collect::<Option<_>>()?,
    })
}
