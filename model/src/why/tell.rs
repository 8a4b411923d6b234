//! The answer, whatever the semantics.

use super::{Target, WhyError};
use crate::trace::{Act, Trace};
use serde::Serialize;
use std::fmt;

/// Something that was said about the target under one dot.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
pub struct Claim {
    /// The dot.
    pub dot: String,
    /// What is said, such as `x = 3`.
    pub text: String,
}

/// How a claim stands at a replica.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Standing {
    /// In a word.
    pub fate: Fate,
    /// Why, in words.
    pub why: String,
    /// By which clause; empty if the semantics has none.
    pub clause: &'static str,
}

/// What became of a claim at a replica.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// It is what is shown.
    Shown,
    /// It is held, and another is shown.
    Beaten,
    /// It is held, and waits for something.
    Waits,
    /// It is gone.
    Gone,
    /// It came here, and is neither held nor known to be gone.
    Dropped,
    /// It has not come here.
    Unseen,
}

/// One claim with its story.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Told {
    /// The claim.
    pub claim: Claim,
    /// How it stands here now.
    pub standing: Standing,
    /// The step that made it, from 1; `None` if it was there from the start.
    pub made_at: Option<usize>,
    /// By whom.
    pub made_by: Option<String>,
    /// By which mutation.
    pub mutation: Option<String>,
    /// The steps in which it came here, from 1, each with its message.
    pub came: Vec<(usize, String)>,
    /// What ended it here, if somebody did.
    pub ended: Option<Ended>,
}

/// What ended a claim.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Ended {
    /// The step that sent the message, from 1.
    pub step: usize,
    /// The message.
    pub message: String,
    /// By whom.
    pub by: String,
    /// By which mutation.
    pub mutation: String,
}

/// Why a replica shows something as it does. `[spec: TRACE-7]`
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Why {
    /// What is asked about, by name.
    pub target: String,
    /// The replica.
    pub replica: String,
    /// After which step; 0 is the start.
    pub step: usize,
    /// Every claim on it that was made up to then, what is shown first.
    pub claims: Vec<Told>,
}

/// What a semantics knows.
pub(super) struct Evidence<'e> {
    /// What the replica held at the start and after each step.
    pub(super) held: Vec<Vec<Claim>>,
    /// What each message says.
    pub(super) messages: Vec<Vec<Claim>>,
    /// Whether a message ends a claim.
    pub(super) ends: &'e dyn Fn(usize, &Claim) -> bool,
    /// How a claim stands at the replica.
    pub(super) standing: &'e dyn Fn(&Claim) -> Standing,
}

pub(super) fn tell(
    trace: &Trace,
    step: usize,
    replica: usize,
    target: &Target,
    evidence: Evidence<'_>,
) -> Result<Why, WhyError> {
    let Evidence { held, messages, ends, standing } = evidence;
    let name = &trace.replicas[replica].name;
    let steps = &trace.steps[..step];
    let sent: Vec<(usize, &str)> = (steps.iter().enumerate())
        .flat_map(|(at, step)| step.does.sends().iter().map(move |sent| (at, &*sent.message)))
        .collect();
    let mut claims: Vec<Claim> = Vec::new();
    for claim in held.iter().chain(&messages).flatten() {
        if !claims.contains(claim) {
            claims.push(claim.clone());
        }
    }
    // What came here: what it sent itself, and what was delivered to it.
    let mut mine: Vec<(usize, usize)> = Vec::new();
    for (at, step) in steps.iter().enumerate().filter(|(_, step)| step.replica == *name) {
        let came = |message: &str| sent.iter().position(|(_, known)| *known == message).map(|n| (at, n));
        match &step.does {
            Act::Mutate { sends, .. } => mine.extend(sends.iter().filter_map(|sent| came(&sent.message))),
            Act::Deliver { message, .. } => mine.extend(came(message)),
            _ => {}
        }
    }
    let mut told: Vec<Told> = claims
        .into_iter()
        .map(|claim| {
            let says = |message: &usize| messages.get(*message).is_some_and(|said| said.contains(&claim));
            let first = (0..sent.len()).find(says).map(|message| sent[message].0);
            // What nobody was to be told of was made where it is first held.
            let maker = match (held.iter().position(|held| held.contains(&claim)), first) {
                (Some(0), _) => None,
                (_, Some(first)) => Some(first),
                (at, None) => at.map(|at| at - 1),
            };
            let came = mine.iter().filter(|(_, message)| says(message));
            let came: Vec<_> = came.map(|(at, message)| (at + 1, sent[*message].1.to_owned())).collect();
            let mut standing = standing(&claim);
            if standing.fate == Fate::Unseen && !came.is_empty() {
                standing.fate = Fate::Dropped;
            }
            let is_gone = standing.fate == Fate::Gone;
            let ended = mine.iter().find(|(_, message)| is_gone && ends(*message, &claim));
            let ended = ended.map(|(_, message)| {
                let (at, message) = sent[*message];
                let step = &steps[at];
                Ended {
                    step: at + 1,
                    message: message.to_owned(),
                    by: step.replica.clone(),
                    mutation: mutation(&step.does),
                }
            });
            Told {
                standing,
                made_at: maker.map(|at| at + 1),
                made_by: maker.map(|at| steps[at].replica.clone()),
                mutation: maker.map(|at| mutation(&steps[at].does)),
                came,
                ended,
                claim,
            }
        })
        .collect();
    let what = target.name(trace);
    if told.is_empty() {
        return Err(WhyError::Nothing { what, step });
    }
    told.sort_by_key(|told| told.standing.fate as u8);
    let names = trace.names();
    for told in &mut told {
        // An edge that was ever shown is better told by the names of its ends.
        let name = names.get(&told.claim.dot);
        if matches!(target, Target::Edge { .. }) && name != told.claim.dot {
            told.claim.text = format!("edge {name}");
        }
    }
    Ok(Why { target: what, replica: name.clone(), step, claims: told })
}

fn mutation(does: &Act) -> String {
    match does {
        Act::Mutate { text, .. } => text.clone(),
        other => other.to_string(),
    }
}

/// For people: what is shown and why, then what it beat.
impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { target, replica, step, claims } = self;
        let when = if *step == 0 { "at the start".into() } else { format!("after step {step}") };
        match claims.iter().find(|told| told.standing.fate == Fate::Shown) {
            Some(told) => writeln!(f, "{replica} shows {}, {when}", told.claim.text)?,
            None => writeln!(f, "{replica} does not show {target}, {when}")?,
        }
        claims.iter().try_for_each(|told| write!(f, "{told}"))
    }
}

impl fmt::Display for Told {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { claim, standing, made_at, made_by, mutation, came, ended } = self;
        let sign = match standing.fate {
            Fate::Shown => "shown ",
            Fate::Beaten => "beaten",
            Fate::Waits => "waits ",
            Fate::Gone => "gone  ",
            Fate::Dropped => "lost  ",
            Fate::Unseen => "unseen",
        };
        writeln!(f, "\n  {sign}  {}  [{}]", claim.text, claim.dot)?;
        let clause =
            if standing.clause.is_empty() { String::new() } else { format!(" [{}]", standing.clause) };
        writeln!(f, "          why      {}{clause}", standing.why)?;
        match (made_at, made_by, mutation) {
            (Some(at), Some(by), Some(mutation)) => {
                writeln!(f, "          written  step {at}, {by}: {mutation}")?;
            }
            _ => writeln!(f, "          written  before the first step")?,
        }
        if !came.is_empty() {
            let came: Vec<String> =
                came.iter().map(|(at, message)| format!("{message} in step {at}")).collect();
            writeln!(f, "          came     {}", came.join(", "))?;
        }
        match ended {
            Some(Ended { step, message, by, mutation }) => {
                writeln!(f, "          ended    {message}, step {step}, {by}: {mutation}")
            }
            None if standing.fate == Fate::Gone => writeln!(f, "          ended    by no message of its own"),
            None => Ok(()),
        }
    }
}
