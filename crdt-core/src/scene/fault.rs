//! What can be wrong with a scene: each fault with its place, what it is, and what to do. `[spec: SCENE-4]`

use super::place::{Place, SymbolRef, clip};
use super::syntax::SyntaxError;
use crate::limits;
use crate::record::Name;
use crate::value::ValueType;
use crate::wellformed::Malformed;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

/// One thing that is wrong with a scene. `[spec: SCENE-4]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fault {
    /// Where.
    pub place: Place,
    /// What.
    pub kind: FaultKind,
    /// The byte from which `place` gets its line and column.
    pub(super) at: usize,
}

/// What is wrong. `[spec: SCENE-4]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FaultKind {
    /// Over [`limits::SCENE_BYTES_MAX`].
    #[error("the scene has {bytes} bytes; allowed are {}", limits::SCENE_BYTES_MAX)]
    TooLarge {
        /// Its size.
        bytes: usize,
    },
    /// Nothing but white space.
    #[error("the file is empty")]
    Empty,
    /// Not JSON.
    #[error("not JSON: {0}")]
    Syntax(SyntaxError),
    /// A byte order mark before the text.
    #[error("the file starts with a byte order mark")]
    ByteOrderMark,
    /// Text after the document.
    #[error("the scene ends here, but the file goes on")]
    TrailingText,
    /// `symbols` is a list: the form that older versions wrote.
    #[error("`symbols` is a list: this is the older array form of scene files")]
    ArrayForm,
    /// A value is not of the JSON form that stands there.
    #[error("{what} must be {expected}, but it is {found}")]
    WrongForm {
        /// The key or thing.
        what: &'static str,
        /// The form that stands there.
        expected: &'static str,
        /// The form found.
        found: &'static str,
    },
    /// A key is missing.
    #[error("the key `{key}` is missing")]
    MissingKey {
        /// The key.
        key: &'static str,
    },
    /// A key that the format does not have.
    #[error("the format has no key {:?} here", clip(key))]
    UnknownKey {
        /// The key.
        key: String,
    },
    /// A key stands twice in one object.
    #[error("the key {:?} stands twice in one object", clip(key))]
    RepeatedKey {
        /// The key.
        key: String,
    },
    /// An id is no decimal number from 0 to 2⁶⁴ − 1.
    #[error("{:?} is no id: ids are whole numbers from 0 to 18446744073709551615", clip(text))]
    BadId {
        /// What stands there.
        text: String,
    },
    /// The key of a symbol and its `id` disagree.
    #[error("the symbol is filed under the key {:?}, but its id is {id}", clip(key))]
    KeyMismatch {
        /// The key.
        key: String,
        /// The id.
        id: u64,
    },
    /// Two symbols have one id.
    #[error("the id {id} is taken by an earlier symbol, {first}")]
    RepeatedId {
        /// The id.
        id: u64,
        /// The earlier symbol.
        first: SymbolRef,
    },
    /// Two symbols have one name.
    #[error("the name {name:?} is taken by an earlier symbol, {first}")]
    RepeatedName {
        /// The name.
        name: Name,
        /// The earlier symbol.
        first: SymbolRef,
    },
    /// A name, type, label or attribute name is empty or too long.
    #[error("{what} has {bytes} bytes; allowed are 1 to {}", limits::NAME_BYTES_MAX)]
    NameLength {
        /// Which.
        what: &'static str,
        /// Its length.
        bytes: usize,
    },
    /// The dictionary is closed and does not list a symbol's type.
    #[error("the dictionary declares no vertex type {vertex_type:?}")]
    UndeclaredType {
        /// The type.
        vertex_type: Name,
    },
    /// The dictionary is closed and does not list a link's label.
    #[error("the dictionary declares no edge label {label:?}")]
    UndeclaredLabel {
        /// The label.
        label: Name,
    },
    /// The dictionary is closed and does not list an attribute.
    #[error("the dictionary declares no attribute of this name")]
    UndeclaredAttribute,
    /// The dictionary declares an attribute with another type.
    #[error("the dictionary declares this attribute as {declared} (type {}), not {given} (type {})", declared.number(), given.number())]
    WrongAttributeType {
        /// The declared type.
        declared: ValueType,
        /// The type in the file.
        given: ValueType,
    },
    /// A type number that is none of the fourteen.
    #[error("{:?} is no attribute type: types are the numbers 0 to 13", clip(text))]
    UnknownType {
        /// What stands there.
        text: String,
    },
    /// A number that its type cannot hold.
    #[error("{} is outside what {expected} can hold", clip(text))]
    OutOfRange {
        /// The number.
        text: String,
        /// The type, for people.
        expected: &'static str,
    },
    /// A vector of fixed length has another number of items.
    #[error("a {value_type} has {expected} items, but here are {given}")]
    WrongLength {
        /// The type.
        value_type: ValueType,
        /// How many it has.
        expected: usize,
        /// How many there are.
        given: usize,
    },
    /// A value is over [`limits::VALUE_BYTES_MAX`].
    #[error("the value has {bytes} bytes; allowed are {}", limits::VALUE_BYTES_MAX)]
    ValueSize {
        /// Its size.
        bytes: usize,
    },
    /// A link's `src` is not the symbol that holds it.
    #[error("the link's `src` is {source_id}, but it stands in another symbol")]
    SourceMismatch {
        /// Its `src`.
        source_id: u64,
    },
    /// A link's target is not in the file.
    #[error("the link is dangling: the file has no symbol {target}")]
    UnknownTarget {
        /// The target's id.
        target: u64,
    },
    /// A link's target is in the file but was left out for a fault of its own.
    #[error("the link's target {target} is left out for a fault of its own")]
    BrokenTarget {
        /// The target's id.
        target: u64,
    },
    /// A link from a symbol to itself.
    #[error("the link joins the symbol to itself")]
    SelfLoop,
    /// Two links of one symbol have the same label and target.
    #[error("an earlier link of this symbol has the same label and target")]
    RepeatedLink,
    /// An `RT` link enters the root.
    #[error("an RT link enters the root, which has no kinematic parent")]
    IntoRoot,
    /// No symbol is the root.
    #[error("no symbol is the root: none is named or typed `root` or `world`")]
    NoRoot,
    /// More than one symbol could be the root.
    #[error("more than one symbol is named or typed `root` or `world`: {}", join(roots))]
    TwoRoots {
        /// All of them.
        roots: Vec<SymbolRef>,
    },
    /// A symbol has two kinematic parents.
    #[error("{child} has two RT parents: {parent} and {other}")]
    TwoParents {
        /// The child.
        child: SymbolRef,
        /// The parent by the link at fault.
        parent: SymbolRef,
        /// The parent by the other link.
        other: SymbolRef,
    },
    /// `RT` links form a cycle.
    #[error("RT links form a cycle: {}", cycle_text(cycle, *is_whole))]
    Cycle {
        /// Its symbols, from parent to child; of a long one the first and the last 32.
        cycle: Vec<SymbolRef>,
        /// Whether these are all.
        is_whole: bool,
    },
    /// A symbol has `RT` children and no `RT` parent.
    #[error("the symbol has RT children but no RT parent, so its tree of {} RT links does not hang from the root: {}",
        links.len(), links_text(links))]
    Detached {
        /// The links of its tree, parent and child.
        links: Vec<(SymbolRef, SymbolRef)>,
    },
    /// A symbol has no path to the root.
    #[error("the symbol has no path to the root, over links of any label in any direction")]
    NoPath,
    /// A source has two links of a functional label.
    #[error("{label:?} is functional, so one symbol has one such link; another goes to {other}")]
    Functional {
        /// The label.
        label: Name,
        /// The target of the other link.
        other: SymbolRef,
    },
    /// The graph would need a repair that none of the kinds above names.
    #[error("the graph is not sound: {repair}")]
    Repaired {
        /// The repair.
        repair: String,
    },
    /// The graph would be no well-formed state.
    #[error("the graph is no well-formed state: {0}")]
    Malformed(#[from] Malformed),
}

/// Every fault of a refused scene, in the order of the file. `[spec: SCENE-4]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SceneError {
    /// At least one.
    pub faults: Vec<Fault>,
}

impl core::error::Error for SceneError {}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the scene is refused for {} fault(s)", self.faults.len())?;
        self.faults.iter().try_for_each(|fault| write!(f, "\n{fault}"))
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.kind)
    }
}

fn join(symbols: &[SymbolRef]) -> String {
    let texts: Vec<String> = symbols.iter().map(ToString::to_string).collect();
    texts.join(", ")
}

fn cycle_text(cycle: &[SymbolRef], is_whole: bool) -> String {
    let mut texts: Vec<String> = cycle.iter().chain(cycle.first()).map(ToString::to_string).collect();
    if !is_whole {
        texts.insert(1, "…".to_string());
    }
    texts.join(" → ")
}

fn links_text(links: &[(SymbolRef, SymbolRef)]) -> String {
    let texts: Vec<String> =
        links.iter().map(|(parent, child)| alloc::format!("{parent} → {child}")).collect();
    texts.join(", ")
}
