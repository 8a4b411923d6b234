//! The parts of a page, put together.

use crate::data::Data;
use crate::plain::{escaped, steps};
use crate::{Content, PageError};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

/// The frame, with a place in double braces for each part.
const FRAME: &str = include_str!("../assets/page.html");
const STYLE: &str = include_str!("../assets/style.css");

/// The script: its files in the order in which they build on each other, in a scope of their own.
const SCRIPT: &str = concat!(
    "(() => {\n\"use strict\";\n",
    include_str!("../assets/dom.js"),
    include_str!("../assets/data.js"),
    include_str!("../assets/graph.js"),
    include_str!("../assets/words.js"),
    include_str!("../assets/layout.js"),
    include_str!("../assets/draw.js"),
    include_str!("../assets/spacetime.js"),
    include_str!("../assets/panel.js"),
    include_str!("../assets/trace.js"),
    include_str!("../assets/tables.js"),
    include_str!("../assets/overview.js"),
    include_str!("../assets/navigation.js"),
    include_str!("../assets/theme.js"),
    include_str!("../assets/help.js"),
    include_str!("../assets/main.js"),
    "})();\n"
);

/// The page of some content: a whole HTML document that needs nothing else. `[spec: TRACE-5]`
pub fn page(content: &Content) -> Result<String, PageError> {
    let data = serde_json::to_string(&Data::of(content)?)?.replace('<', "\\u003c");
    let part = |name: &str| match name {
        "title" => escaped(&content.title),
        "style" => STYLE.into(),
        "style_hash" => policy_hash(STYLE),
        "script" => SCRIPT.into(),
        "script_hash" => policy_hash(SCRIPT),
        "data" => data.clone(),
        "plain" => content.traces.iter().map(|shown| steps(&shown.trace)).collect(),
        _ => String::new(),
    };
    // In one pass over the frame, so that nothing in a part is taken for a place.
    let mut pieces = FRAME.split("{{");
    let mut page: String = pieces.next().unwrap_or_default().into();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").unwrap_or(("", piece));
        page += &part(name);
        page += rest;
    }
    Ok(page)
}

/// By what the page's policy knows its own script and style: nothing else runs.
fn policy_hash(text: &str) -> String {
    format!("sha256-{}", STANDARD.encode(Sha256::digest(text)))
}
