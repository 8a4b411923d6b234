//! Claims of the core, for those who ask why. `[spec: TRACE-7]`

use crate::why::{Claim, Fate, Standing, Target};
use dsr_core::{Delta, Dictionary, Dot, Edge, Record, Repair, Rule, State, VertexId, view};

/// What a state or a delta says about a target.
pub(super) fn claims(delta: &Delta, target: &Target, dictionary: &Dictionary) -> Vec<Claim> {
    let about = |(dot, record): (Dot, &Record)| {
        let text = match (record, target) {
            (Record::Vertex(vertex), Target::Vertex { id }) if *id == dot.to_string() => {
                format!("vertex {} ({})", vertex.name, vertex.vertex_type)
            }
            (Record::Edge(edge), Target::Edge { id, .. })
                if *id == dot.to_string() || competes(edge, target, dictionary) =>
            {
                format!("edge {}", edge.key())
            }
            (Record::Write(write), Target::Attribute { of, name })
                if *of == VertexId(write.target).to_string() && *name == *write.name =>
            {
                format!("{name} = {}", write.value)
            }
            _ => return None,
        };
        Some(Claim { dot: dot.to_string(), text })
    };
    delta.records().filter_map(about).collect()
}

/// Whether an edge is a claim on a register of the target's. `[spec: STAMP-4]`
fn competes(edge: &Edge, target: &Target, dictionary: &Dictionary) -> bool {
    let Target::Edge { from, label, to, .. } = target else { return false };
    let (same_from, same_to) = (edge.from.to_string() == *from, edge.to.to_string() == *to);
    if *edge.label != **label {
        return false;
    }
    same_from && (same_to || dictionary.is_functional(label)) || same_to && edge.is_rt()
}

/// Whether a delta says that a claim is gone.
pub(super) fn ends(delta: &Delta, claim: &Claim) -> bool {
    claim.dot.parse::<Dot>().is_ok_and(|dot| delta.is_dead(dot))
}

/// How a claim stands in a state.
pub(super) fn standing(state: &State, claim: &Claim, dictionary: &Dictionary) -> Standing {
    let stands = |fate, clause, why: String| Standing { fate, why, clause };
    let Ok(dot) = claim.dot.parse::<Dot>() else {
        return stands(Fate::Unseen, "", "it has no dot of this semantics".into());
    };
    if state.is_dead(dot) {
        return stands(Fate::Gone, "STATE-3", "its dot is dead here, and stays so".into());
    }
    let Some(record) = state.get(dot) else {
        return stands(Fate::Unseen, "JOIN-5", "no message that brings it has come here".into());
    };
    let waits_for = record.anchors().find(|&anchor| anchor.sequence != 0 && !state.holds(anchor));
    if let Some(anchor) = waits_for {
        return stands(Fate::Waits, "CLOSE-4", format!("{anchor}, on which it hangs, has not come here"));
    }
    let seen = view(state, dictionary);
    match record {
        Record::Vertex(_) => stands(Fate::Shown, "VIEW-1.1", "its record is held".into()),
        Record::Edge(edge) => {
            let hidden = seen.repairs().iter().find_map(|repair| match repair {
                Repair::Superseded { hidden, shown, rule } if hidden.0 == dot => {
                    let (clause, on) = match rule {
                        Rule::SameKey => ("VIEW-2", "the same key"),
                        Rule::Functional => ("VIEW-6", "a functional label"),
                        Rule::RtParent => ("VIEW-3", "the kinematic parent"),
                    };
                    Some((
                        clause,
                        format!("{shown} is the greater claim on {on}: {}", ranks(state, dot, shown.0)),
                    ))
                }
                Repair::CycleBroken { hidden } if hidden.0 == dot => {
                    Some(("VIEW-3", "greater claims already lead from its child to its parent".into()))
                }
                _ => None,
            });
            match hidden {
                Some((clause, why)) => stands(Fate::Beaten, clause, why),
                None if seen.shows_edge(dsr_core::EdgeId(dot)) => {
                    let clause = if edge.is_rt() { "VIEW-3" } else { "VIEW-2" };
                    stands(Fate::Shown, clause, "no greater claim on its register is held".into())
                }
                None => stands(Fate::Waits, "VIEW-1.1", "an end of it is not shown".into()),
            }
        }
        Record::Write(write) => match seen.attribute(write.target, &write.name) {
            Some((winner, _)) if winner == dot => {
                stands(Fate::Shown, "VIEW-8", "it is the greatest write that is held".into())
            }
            Some((winner, _)) => {
                let why = format!("{winner} is the greater write: {}", ranks(state, dot, winner));
                stands(Fate::Beaten, "VIEW-8", why)
            }
            None => stands(Fate::Beaten, "VIEW-8", "the dictionary does not declare it so".into()),
        },
    }
}

/// Two ranks side by side. `[spec: STAMP-2]`
fn ranks(state: &State, lesser: Dot, greater: Dot) -> String {
    let stamp = |dot: Dot| state.get(dot).map_or(0, Record::stamp);
    let (low, high) = (stamp(lesser), stamp(greater));
    if low == high {
        format!("both have stamp {low}, and {greater} is the greater dot")
    } else {
        format!("stamp {high} over {low}")
    }
}
