//! Scenes: the graph files of the published system, read and written without loss. `[spec: SCENE-1]`
//!
//! A scene file is the JSON text in which the published system keeps a graph: symbols by id, each with its
//! attributes and the links that leave it. [`Scene::read`] makes a [`State`] of one or names every fault in
//! it; [`Scene::write`] makes a file of any state. Text in, text out: no file is opened here.
//!
//! Units are whatever a file holds: those of the published system are in **millimetres** and radians, those
//! shipped here ([`FLAT`], [`TINY`]) in **metres** and radians. Nothing is converted. `[spec: SCENE-16]`
//!
//! ```
//! use dsr_core::scene::{FLAT, Scene, Strictness};
//! use dsr_core::{Dictionary, view};
//!
//! let dictionary = Dictionary::aal();
//! let imported = Scene::read(FLAT, &dictionary, Strictness::Strict)?;
//! let graph = view(&imported.scene.state, &dictionary);
//! assert!(graph.repairs().is_empty());
//! assert!(graph.vertex_by_name("dining-kitchen").is_some());
//! assert_eq!(imported.scene.write(&dictionary), FLAT);
//! # Ok::<(), dsr_core::scene::SceneError>(())
//! ```
//!
//! | room | step |
//! |---|---|
//! | `syntax` | text to a tree that keeps places, number texts and repeated keys |
//! | `symbols`, `values` | the tree to symbols, links and typed attributes |
//! | `graph` | ids, names, the root, targets |
//! | `assemble` | symbols to records under dots |
//! | `soundness` | what the view would have to repair |
//! | `write`, `naming` | any state back to text |

mod assemble;
mod collect;
mod dictionaries;
mod fault;
mod fields;
mod graph;
mod naming;
mod place;
mod read;
mod remedy;
mod soundness;
mod symbols;
mod syntax;
mod values;
mod write;

pub use fault::{Fault, FaultKind, SceneError};
pub use naming::Note;
pub use place::{LinkRef, Place, SymbolRef};
pub use syntax::SyntaxError;

use crate::dictionary::Dictionary;
use crate::record::Name;
use crate::state::State;
use alloc::string::String;
use alloc::vec::Vec;

/// The three-room flat of the papers, in metres and radians; sound under [`Dictionary::aal`].
/// `[spec: SCENE-16]`
pub const FLAT: &str = include_str!("../../data/scenes/flat.json");

/// A room, a robot in it and a cup, in metres and radians; sound under [`Dictionary::aal`].
/// `[spec: SCENE-16]`
pub const TINY: &str = include_str!("../../data/scenes/tiny.json");

/// A graph as a scene file has it: a state, and what the file calls the root.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Scene {
    /// Everything but the root's own name, type and id, for which a state has no record.
    pub state: State,
    /// The root's.
    pub root: RootNaming,
}

/// What a file calls the root. `[spec: SCENE-12]`
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct RootNaming {
    /// Its name, such as `world`.
    pub name: Name,
    /// Its type, such as `world`.
    pub vertex_type: Name,
    /// Its id.
    pub external_id: Option<u64>,
}

/// Name and type `world`, no id.
impl Default for RootNaming {
    fn default() -> Self {
        Self { name: "world".into(), vertex_type: "world".into(), external_id: None }
    }
}

/// What happens to a scene with faults.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Strictness {
    /// It is refused with every fault. `[spec: SCENE-4]`
    #[default]
    Strict,
    /// What is broken is dropped and listed. `[spec: SCENE-5]`
    Lenient,
}

/// A scene that was read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// Every fault for which something was dropped, in the order of the file; empty if read strictly.
    pub dropped: Vec<Fault>,
}

/// A scene's text, and what in it differs from the graph.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Written {
    /// The file.
    pub text: String,
    /// What the format could not hold as it is. Empty for a scene that was read strictly.
    pub notes: Vec<Note>,
}

impl Scene {
    /// A scene of any state, its root called `world`.
    pub fn of(state: State) -> Self {
        Self { state, root: RootNaming::default() }
    }

    /// Reads a scene file. `[spec: SCENE-1]` to `[spec: SCENE-14]`
    ///
    /// Names, types and labels are judged by `dictionary`; an open one accepts any.
    ///
    /// ```
    /// use dsr_core::Dictionary;
    /// use dsr_core::scene::{Scene, Strictness};
    ///
    /// let text = r#"{"DSRModel": {"symbols": {
    ///     "1": {"id": "1", "name": "world", "type": "world", "links": [
    ///         {"src": "1", "dst": "2", "label": "has"}]}}}}"#;
    /// let refused = Scene::read(text, &Dictionary::open(), Strictness::Strict).unwrap_err();
    /// assert_eq!(refused.faults[0].to_string(),
    ///     "line 3, column 9, symbol 1 \"world\", link 0 (has to 2): the link is dangling: the file has no symbol 2");
    /// let lenient = Scene::read(text, &Dictionary::open(), Strictness::Lenient)?;
    /// assert_eq!(lenient.dropped, refused.faults);
    /// # Ok::<(), dsr_core::scene::SceneError>(())
    /// ```
    pub fn read(text: &str, dictionary: &Dictionary, strictness: Strictness) -> Result<Imported, SceneError> {
        read::read(text, dictionary, strictness)
    }

    /// Writes a scene file: what the view shows, in one order and layout. `[spec: SCENE-15]`
    pub fn write(&self, dictionary: &Dictionary) -> String {
        self.written(dictionary).text
    }

    /// [`write`](Self::write), and what in the file differs from the graph. `[spec: SCENE-15]`
    pub fn written(&self, dictionary: &Dictionary) -> Written {
        write::write(self, dictionary)
    }
}
