//! Clause ids.

use std::fmt;
use std::str::FromStr;

/// A clause's id, such as `JOIN-3`, `MUT-2.3` or `CLAIM-L1`. Ordered as people count.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct ClauseId {
    chapter: String,
    letter: Option<char>,
    number: u32,
    part: Option<u32>,
}

/// A text that is not a clause id.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct NoClauseId;

impl ClauseId {
    /// The chapter's word, such as `JOIN`.
    pub fn chapter(&self) -> &str {
        &self.chapter
    }

    /// Every id from this one to `last`, both counted, or `None` if these two are no range: another chapter
    /// or letter, parts of different numbers, or a last one before the first.
    pub fn to(&self, last: &Self) -> Option<Vec<Self>> {
        if self.chapter != last.chapter || self.letter != last.letter || last < self {
            return None;
        }
        match (self.part, last.part) {
            (None, None) => {
                Some((self.number..=last.number).map(|number| Self { number, ..self.clone() }).collect())
            }
            (Some(from), Some(to)) if self.number == last.number => {
                Some((from..=to).map(|part| Self { part: Some(part), ..self.clone() }).collect())
            }
            _ => None,
        }
    }
}

fn number(text: &str) -> Result<u32, NoClauseId> {
    let canonical = text == "0" || (!text.starts_with('0') && text.bytes().all(|byte| byte.is_ascii_digit()));
    if !canonical {
        return Err(NoClauseId);
    }
    text.parse().map_err(|_why: std::num::ParseIntError| NoClauseId)
}

impl FromStr for ClauseId {
    type Err = NoClauseId;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (chapter, rest) = text.split_once('-').ok_or(NoClauseId)?;
        if chapter.is_empty() || !chapter.bytes().all(|byte| byte.is_ascii_uppercase()) {
            return Err(NoClauseId);
        }
        let letter = rest.chars().next().filter(char::is_ascii_uppercase);
        let rest = if letter.is_some() { &rest[1..] } else { rest };
        let (whole, part) = match rest.split_once('.') {
            Some((whole, part)) => (whole, Some(number(part)?)),
            None => (rest, None),
        };
        Ok(Self { chapter: chapter.into(), letter, number: number(whole)?, part })
    }
}

impl fmt::Display for ClauseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-", self.chapter)?;
        if let Some(letter) = self.letter {
            write!(f, "{letter}")?;
        }
        write!(f, "{}", self.number)?;
        if let Some(part) = self.part { write!(f, ".{part}") } else { Ok(()) }
    }
}
