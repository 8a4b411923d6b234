//! Identity: replicas, dots, and the elements that dots name.
//!
//! A *dot* is one event of one replica, unique for ever. It is the identity of the record that the event
//! made, so vertices and edges need no other id. `[spec: ID-1]` `[spec: ID-2]`

use core::fmt;
use core::str::FromStr;

/// One incarnation of one agent.
///
/// A replica that restarts without its counter must take a fresh incarnation: a dot that is used twice
/// breaks convergence. `[spec: ID-3]`
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct ReplicaId {
    /// The agent's number, given by the deployment.
    pub agent: u32,
    /// How many times this agent has started without its counter.
    pub incarnation: u32,
}

impl ReplicaId {
    /// The author of imported scenes.
    pub const SCENE: Self = Self::agent(0);

    /// The first incarnation of an agent.
    pub const fn agent(agent: u32) -> Self {
        Self { agent, incarnation: 0 }
    }

    /// The same agent after a restart that lost its counter, or `None` when incarnations are used up.
    /// `[spec: CRASH-2]`
    pub const fn next_incarnation(self) -> Option<Self> {
        match self.incarnation.checked_add(1) {
            Some(incarnation) => Some(Self { agent: self.agent, incarnation }),
            None => None,
        }
    }
}

impl ReplicaId {
    const fn as_number(self) -> u64 {
        (self.agent as u64) << 32 | self.incarnation as u64
    }
}

/// By agent, then incarnation. `[spec: ID-1]`
impl Ord for ReplicaId {
    #[inline]
    fn cmp(&self, other: &Self) -> core::cmp::Ordering {
        self.as_number().cmp(&other.as_number())
    }
}

impl PartialOrd for ReplicaId {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// Prints `r3`, and `r3+1` for a later incarnation.
impl fmt::Display for ReplicaId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "r{}", self.agent)?;
        if self.incarnation > 0 { write!(f, "+{}", self.incarnation) } else { Ok(()) }
    }
}

/// One event of one replica. `[spec: ID-1]`
///
/// Sequences count from 1; sequence 0 occurs only in [`VertexId::ROOT`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Dot {
    /// Who made it.
    pub replica: ReplicaId,
    /// The how-manieth of that replica.
    pub sequence: u64,
}

impl Dot {
    /// The `sequence`-th event of `replica`.
    pub const fn new(replica: ReplicaId, sequence: u64) -> Self {
        Self { replica, sequence }
    }
}

impl Dot {
    /// All of it in one number, so that dots are compared at once: every index is ordered by them.
    const fn as_number(self) -> u128 {
        (self.replica.as_number() as u128) << 64 | self.sequence as u128
    }
}

/// By replica, then sequence. `[spec: ID-1]`
impl Ord for Dot {
    #[inline]
    fn cmp(&self, other: &Self) -> core::cmp::Ordering {
        self.as_number().cmp(&other.as_number())
    }
}

impl PartialOrd for Dot {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// Prints `r3.17`.
impl fmt::Display for Dot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.replica, self.sequence)
    }
}

/// A text that is not a replica id or dot.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("not a dot: expected `r<agent>[+<incarnation>].<sequence>` such as `r3.17`, or `root`")]
pub struct ParseDotError;

fn decimal<T: FromStr>(text: &str) -> Result<T, ParseDotError> {
    // `FromStr` for integers accepts `+7` and `007`; one dot must have one spelling. [spec: ID-4]
    let canonical = text == "0" || (!text.starts_with('0') && text.bytes().all(|b| b.is_ascii_digit()));
    if !canonical {
        return Err(ParseDotError);
    }
    text.parse().or(Err(ParseDotError))
}

impl FromStr for ReplicaId {
    type Err = ParseDotError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let body = text.strip_prefix('r').ok_or(ParseDotError)?;
        let Some((agent, incarnation)) = body.split_once('+') else {
            return Ok(Self::agent(decimal(body)?));
        };
        let incarnation = decimal(incarnation)?;
        if incarnation == 0 {
            return Err(ParseDotError);
        }
        Ok(Self { agent: decimal(agent)?, incarnation })
    }
}

impl FromStr for Dot {
    type Err = ParseDotError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (replica, sequence) = text.rsplit_once('.').ok_or(ParseDotError)?;
        Ok(Self::new(replica.parse()?, decimal(sequence)?))
    }
}

macro_rules! element_id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub struct $name(pub Dot);

        impl From<$name> for Dot {
            fn from(id: $name) -> Dot {
                id.0
            }
        }
    };
}

element_id! {
    /// A vertex: the dot of its `Vertex` record, or [`VertexId::ROOT`]. `[spec: ID-2]`
    VertexId
}
element_id! {
    /// One instance of an edge: the dot of its `Edge` record. `[spec: ID-2]`
    EdgeId
}

impl VertexId {
    /// The constant that always lives: the origin of the kinematic tree, `world` or `root` in scene files.
    /// `[spec: STATE-4]`
    pub const ROOT: Self = Self(Dot::new(ReplicaId::SCENE, 0));

    /// Whether this is the root.
    pub fn is_root(self) -> bool {
        self == Self::ROOT
    }
}

impl fmt::Display for VertexId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_root() { f.write_str("root") } else { self.0.fmt(f) }
    }
}

impl fmt::Display for EdgeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for VertexId {
    type Err = ParseDotError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text == "root" { Ok(Self::ROOT) } else { parse_element(text).map(Self) }
    }
}

impl FromStr for EdgeId {
    type Err = ParseDotError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        parse_element(text).map(Self)
    }
}

fn parse_element(text: &str) -> Result<Dot, ParseDotError> {
    let dot: Dot = text.parse()?;
    if dot.sequence == 0 { Err(ParseDotError) } else { Ok(dot) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    /// [spec: ID-4]
    #[test]
    fn law_dots_print_and_parse_back() {
        for text in ["r0.1", "r3.17", "r3+1.17", "r4294967295.18446744073709551615"] {
            assert_eq!(text.parse::<Dot>().unwrap().to_string(), text);
        }
        assert_eq!("root".parse(), Ok(VertexId::ROOT));
        assert_eq!(VertexId::ROOT.to_string(), "root");
    }

    /// [spec: ID-4]
    #[test]
    fn law_a_dot_has_one_spelling() {
        for text in [
            "",
            "r",
            "r1",
            "r1.",
            "r01.2",
            "r1.+2",
            "r1+0.2",
            "r1.02",
            "1.2",
            "r1.2.3",
            "r1.18446744073709551616",
        ] {
            assert_eq!(text.parse::<Dot>(), Err(ParseDotError), "{text}");
        }
        assert_eq!("r0.0".parse::<VertexId>(), Err(ParseDotError));
    }
}
