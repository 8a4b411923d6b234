//! Which lines of a Rust file are test code.

use crate::Source;
use std::collections::BTreeSet;

/// Files that are test modules because their parent declares them under `#[cfg(test)]`.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TestModules(BTreeSet<String>);

impl TestModules {
    /// Finds the declarations in these files.
    pub fn of(sources: &[Source]) -> Self {
        let mut stems = BTreeSet::new();
        for source in sources {
            let lines: Vec<&str> = source.text.lines().collect();
            for (at, _) in lines.iter().enumerate().filter(|(_, line)| line.trim() == "#[cfg(test)]") {
                let item = lines[at + 1..].iter().find(|line| !is_prelude(line));
                let name = item
                    .and_then(|line| line.trim().strip_suffix(';'))
                    .and_then(|line| line.rsplit_once("mod "));
                if let Some((_, name)) = name {
                    stems.insert(format!("{}/{name}", directory_of_children(&source.path)));
                }
            }
        }
        Self(stems)
    }

    fn contains(&self, path: &str) -> bool {
        self.0.iter().any(|stem| {
            path.strip_prefix(stem.as_str()).is_some_and(|rest| rest == ".rs" || rest.starts_with('/'))
        })
    }
}

/// Where the modules that a file declares live: beside `lib.rs`, `main.rs` and `mod.rs`, else in the
/// directory named like the file.
fn directory_of_children(path: &str) -> String {
    let (directory, file) = path.rsplit_once('/').unwrap_or(("", path));
    match file {
        "lib.rs" | "main.rs" | "mod.rs" => directory.into(),
        _ => path.trim_end_matches(".rs").into(),
    }
}

/// Attributes and comments between `#[cfg(test)]` and its item.
fn is_prelude(line: &str) -> bool {
    let line = line.trim_start();
    line.starts_with("#[") || line.starts_with("//")
}

/// For each line whether it is test code: all of a file under `tests/` or of a test module, and every item
/// under `#[cfg(test)]`. Relies on the layout that `cargo fmt` makes: an item ends where its closing brace
/// stands as deep as its attribute.
pub fn test_lines(source: &Source, modules: &TestModules) -> Vec<bool> {
    let lines: Vec<&str> = source.text.lines().collect();
    let whole = source.path.split('/').any(|part| part == "tests") || modules.contains(&source.path);
    let mut test = vec![whole; lines.len()];
    for (at, line) in lines.iter().enumerate() {
        if line.trim() == "#[cfg(test)]" {
            let end = item_end(&lines, at);
            test[at..=end].fill(true);
        }
    }
    test
}

/// The last line of the item whose attribute stands at `attribute`.
fn item_end(lines: &[&str], attribute: usize) -> usize {
    let depth = lines[attribute].len() - lines[attribute].trim_start().len();
    let last = lines.len() - 1;
    let start = (attribute + 1..lines.len()).find(|&at| !is_prelude(lines[at])).unwrap_or(last);
    let first = lines[start].trim_end();
    if first.ends_with(';') || first.ends_with('}') {
        return start;
    }
    let closes = |at: &usize| {
        let line = lines[*at];
        let body = line.trim_start();
        line.len() - body.len() == depth && (body.starts_with('}') || body.ends_with(';'))
    };
    (start + 1..lines.len()).find(closes).unwrap_or(last)
}
