//! The dictionaries that ship with the crate, as data files. `[spec: SCENE-17]`

use crate::dictionary::Dictionary;

const PUBLISHED: &str = include_str!("../../data/published.dictionary.json");
const AAL: &str = include_str!("../../data/aal.dictionary.json");

fn shipped(text: &str) -> Dictionary {
    match serde_json::from_str(text) {
        Ok(dictionary) => dictionary,
        Err(error) => {
            unreachable!("[SCENE-17] a dictionary that ships with the crate is unreadable: {error}")
        }
    }
}

impl Dictionary {
    /// The dictionary of the published system, closed: its vertex types, edge labels and attributes, with
    /// `in` as a functional label. `[spec: SCENE-17]`
    pub fn published() -> Self {
        shipped(PUBLISHED)
    }

    /// [`published`](Self::published) and the names that ambient-assisted-living and ROS agents use as well.
    /// `[spec: SCENE-17]`
    pub fn aal() -> Self {
        shipped(AAL)
    }
}
