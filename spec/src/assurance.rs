//! `docs/assurance.md` and the README's table of claims: the regions that are written from the evidence.

mod chapters;
mod claims;
mod counts;
mod layers;
mod oracle;
mod unproved;

use crate::evidence::Evidence;
use crate::generated::with_region;
use crate::{Gap, Source};

/// Where the account of the evidence is kept, from the workspace root.
pub const ASSURANCE_PATH: &str = "docs/assurance.md";
/// Where the short table of claims is kept, from the workspace root.
pub const README_PATH: &str = "README.md";

/// The account with its regions written anew.
pub fn assurance(evidence: &Evidence, file: &Source) -> Result<String, Gap> {
    let regions = [
        ("claims", claims::long(evidence)),
        ("counts", counts::counts(evidence)),
        ("oracle", oracle::oracle(evidence)),
        ("layers", layers::layers(evidence)),
        ("clauses", chapters::chapters(evidence)),
        ("unproved", unproved::unproved(evidence)),
    ];
    written(file, &regions)
}

/// The README with its table of claims written anew.
pub fn readme(evidence: &Evidence, file: &Source) -> Result<String, Gap> {
    written(file, &[("claims", claims::short(evidence))])
}

fn written(file: &Source, regions: &[(&str, String)]) -> Result<String, Gap> {
    let mut written = file.clone();
    for (name, body) in regions {
        written.text = with_region(&written, name, body)?;
    }
    Ok(written.text)
}

/// A cell of a table: a dash where there is nothing.
fn cell(text: String) -> String {
    if text.is_empty() { "–".into() } else { text }
}

/// `1 case`, `2 cases`.
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// Layers as people call them.
fn shown(layers: &[String]) -> String {
    let name = |layer: &String| if layer == "scenario" { "scenarios".into() } else { layer.clone() };
    layers.iter().map(name).collect::<Vec<_>>().join(", ")
}
