//! Gathering faults, and finding their lines and columns in one pass at the end.

use super::fault::{Fault, FaultKind};
use super::place::Place;
use alloc::vec::Vec;

/// The faults found so far.
#[derive(Debug, Default)]
pub(super) struct Faults {
    list: Vec<Fault>,
}

impl Faults {
    pub(super) fn push(&mut self, at: usize, place: &Place, kind: FaultKind) {
        self.list.push(Fault { place: place.clone(), kind, at });
    }

    pub(super) fn extend(&mut self, faults: impl IntoIterator<Item = Fault>) {
        self.list.extend(faults);
    }

    pub(super) fn is_fatal(&self) -> bool {
        self.list.iter().any(|fault| fault.kind.is_fatal())
    }

    /// All faults in the order of the file, each with its line and column.
    pub(super) fn located(mut self, text: &str) -> Vec<Fault> {
        // Stable: faults at one place stay in the order in which they were found.
        self.list.sort_by_key(|fault| fault.at);
        let (mut line, mut column) = (1, 1);
        let mut characters = text.char_indices().peekable();
        for fault in &mut self.list {
            while let Some((_, character)) = characters.next_if(|&(at, _)| at < fault.at) {
                match character {
                    '\n' => (line, column) = (line + 1, 1),
                    '\u{feff}' => {}
                    _ => column += 1,
                }
            }
            (fault.place.line, fault.place.column) = (line, column);
        }
        self.list
    }
}
