//! What a run has measured, for people and for programs.

mod json;
mod markdown;
mod plot;
mod text;

pub use json::json;
pub use markdown::markdown;
pub use plot::plots;
pub use text::text;

/// A time in the unit that suits it.
fn duration(ns: f64) -> String {
    match ns {
        ns if ns < 1e3 => format!("{ns:.0} ns"),
        ns if ns < 1e6 => format!("{:.2} µs", ns / 1e3),
        ns if ns < 1e9 => format!("{:.2} ms", ns / 1e6),
        ns => format!("{:.2} s", ns / 1e9),
    }
}
