//! Where in a scene file a fault is. `[spec: SCENE-4]`

use crate::record::Name;
use alloc::string::{String, ToString};
use core::fmt;

/// A symbol as people find it in the file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SymbolRef {
    /// Its id, or its key where the id is unusable.
    pub id: String,
    /// Its name, if it has a usable one.
    pub name: Option<Name>,
}

/// A link as people find it in the file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LinkRef {
    /// Where it stands in its symbol's list, from 0.
    pub index: usize,
    /// Its label, if it has a usable one.
    pub label: Option<Name>,
    /// Its target's id, if it has a usable one.
    pub target: Option<u64>,
}

/// Where a fault is: as precisely as is known.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Place {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// The symbol.
    pub symbol: Option<SymbolRef>,
    /// The link of that symbol.
    pub link: Option<LinkRef>,
    /// The attribute of that symbol or link.
    pub attribute: Option<Name>,
    /// The item of that attribute's list, from 0.
    pub item: Option<usize>,
}

/// Prints `line 3, column 9, symbol 7 "hub", link 0 (RT to 8), attribute "pose", item 2`.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)?;
        if let Some(symbol) = &self.symbol {
            write!(f, ", symbol {symbol}")?;
        }
        if let Some(link) = &self.link {
            write!(f, ", {link}")?;
        }
        if let Some(attribute) = &self.attribute {
            write!(f, ", attribute {:?}", clip(attribute))?;
        }
        self.item.map_or(Ok(()), |item| write!(f, ", item {item}"))
    }
}

impl fmt::Display for SymbolRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&clip(&self.id))?;
        self.name.as_ref().map_or(Ok(()), |name| write!(f, " {name:?}"))
    }
}

impl fmt::Display for LinkRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "link {}", self.index)?;
        match (&self.label, self.target) {
            (Some(label), Some(target)) => write!(f, " ({label} to {target})"),
            (Some(label), None) => write!(f, " ({label})"),
            (None, Some(target)) => write!(f, " (to {target})"),
            (None, None) => Ok(()),
        }
    }
}

/// At most 60 characters of a text from outside.
pub(super) fn clip(text: &str) -> String {
    const SHOWN_MAX: usize = 60;
    match text.char_indices().nth(SHOWN_MAX) {
        Some((end, _)) => text.get(..end).unwrap_or_default().to_string() + "…",
        None => text.to_string(),
    }
}
