//! A badge: the JSON that shields.io takes from an address.

use super::tally::{Named, Tally};
use serde_json::json;

/// How much passes, in which profile. What is incomplete never looks green.
pub fn badge(named: &Named) -> String {
    let log = &named.log;
    let tally = Tally::of(&log.cases);
    let asked = tally.passed + tally.bad + tally.excused;
    let deepest = ["wire", "causal", "observe"]
        .into_iter()
        .find(|name| log.header.profiles.iter().any(|known| known == name));
    let (message, color) = if log.incomplete.is_some() {
        ("incomplete".to_owned(), "lightgrey")
    } else if asked == 0 {
        ("nothing passed".to_owned(), "lightgrey")
    } else {
        let color = match (tally.bad, tally.excused) {
            (0, 0) => "brightgreen",
            (0, _) => "yellow",
            _ => "red",
        };
        (format!("{}/{asked}", tally.passed), color)
    };
    let label = format!("DSR {} conformance", deepest.unwrap_or("observe"));
    json!({"schemaVersion": 1, "label": label, "message": message, "color": color}).to_string() + "\n"
}
