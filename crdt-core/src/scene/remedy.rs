//! What to do about each fault, and which leave no scene at all. `[spec: SCENE-4]` `[spec: SCENE-5]`

use super::fault::FaultKind;
use super::syntax::SyntaxError;

impl FaultKind {
    /// Whether no scene can be had of the file even if this is left out. `[spec: SCENE-5]`
    pub const fn is_fatal(&self) -> bool {
        matches!(
            self,
            Self::TooLarge { .. }
                | Self::Empty
                | Self::Syntax(_)
                | Self::ArrayForm
                | Self::NoRoot
                | Self::TwoRoots { .. }
                | Self::Repaired { .. }
                | Self::Malformed(_)
        )
    }

    /// What to do about it.
    pub const fn remedy(&self) -> &'static str {
        match self {
            Self::TooLarge { .. } => "move large values such as images out of the scene",
            Self::Empty => "write the scene again: the file holds nothing",
            Self::Syntax(SyntaxError::Truncated) => "copy or write the file again, whole",
            Self::Syntax(SyntaxError::TooDeep) => {
                "remove the nested lists or objects: a scene needs 9 levels"
            }
            Self::Syntax(_) => "correct the JSON at this place",
            Self::ByteOrderMark => "save the file as UTF-8 without a byte order mark",
            Self::TrailingText => {
                "keep one scene per file: remove what follows, or put it in a file of its own"
            }
            Self::ArrayForm => {
                "load the file with the older version and save it again, or rewrite `symbols` as an object from id to symbol and each attribute as {\"type\", \"value\"}"
            }
            Self::WrongForm { .. } => "write the value in the form that stands there",
            Self::MissingKey { .. } => "add the key",
            Self::UnknownKey { .. } => "remove the key, or correct its spelling",
            Self::RepeatedKey { .. } => "keep one of the two",
            Self::BadId { .. } => "write the id as digits alone, without sign, leading zeros or point",
            Self::KeyMismatch { .. } => "make the key and the `id` the same",
            Self::RepeatedId { .. } => "give one of the two another id, and correct the links to it",
            Self::RepeatedName { .. } => "give one of the two another name",
            Self::NameLength { .. } => "shorten it, or give one",
            Self::UndeclaredType { .. } | Self::UndeclaredLabel { .. } | Self::UndeclaredAttribute => {
                "correct the spelling, or declare it in the dictionary"
            }
            Self::WrongAttributeType { .. } => {
                "write the value with the declared type, or change the dictionary"
            }
            Self::UnknownType { .. } => {
                "use the type number of the published format, 0 (string) to 13 (vec6)"
            }
            Self::OutOfRange { .. } => {
                "use a wider type; the published writer writes unsigned 32-bit numbers from 2147483648 on as negative ones: add 4294967296 to those"
            }
            Self::WrongLength { .. } => "give exactly that many, or use type 3 (float_vec)",
            Self::ValueSize { .. } => "keep large values such as images out of the scene",
            Self::SourceMismatch { .. } => "move the link into its source's list, or correct `src`",
            Self::UnknownTarget { .. } => "add the missing symbol, or remove the link",
            Self::BrokenTarget { .. } => "correct the target's fault",
            Self::SelfLoop | Self::RepeatedLink | Self::IntoRoot => "remove the link",
            Self::NoRoot => "name the symbol from which the kinematic tree hangs `world` or `root`",
            Self::TwoRoots { .. } => "keep one; give the others another name and type",
            Self::TwoParents { .. } => "remove one of the two RT links",
            Self::Cycle { .. } => "remove one RT link of the cycle, and hang its symbols from the root",
            Self::Detached { .. } => {
                "add an RT link that leads to it from the root's tree, or make the links symbolic"
            }
            Self::NoPath => "link the symbol, or one that it is linked to, to the root's graph",
            Self::Functional { .. } => "remove one of the two links",
            Self::Repaired { .. } | Self::Malformed(_) => {
                "report this scene: the reader should have named the fault"
            }
        }
    }
}
