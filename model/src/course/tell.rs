//! A course in plain lines, and as JSON.

use super::{Broken, Course, Event, Moment, Outcome};
use crate::semantics::Semantics;
use serde_json::{Value, json as object};

/// A line for each event, and one for how it ends. Messages are numbered from 1, as `m1`.
pub fn lines<M: std::fmt::Display>(course: &Course<M>, outcome: &Outcome) -> Vec<String> {
    let name = |replica: usize| course.replicas.get(replica).map_or("?", String::as_str);
    let (mut lines, mut sent) = (Vec::new(), 0);
    for (at, event) in course.events.iter().enumerate() {
        sent += usize::from(event.sends());
        let what = match event {
            Event::Mutate { mutations, .. } => {
                let made: Vec<String> = mutations.iter().map(ToString::to_string).collect();
                format!("{}  → m{sent}", made.join("; "))
            }
            Event::Deliver { message, .. } => format!("receives m{}", message + 1),
            Event::Lose { message, .. } => format!("will not receive m{}", message + 1),
            Event::Restart { keeps: true, .. } => "restarts with its state".into(),
            Event::Restart { keeps: false, .. } => "restarts without its state".into(),
            Event::Answer { to, .. } => format!("answers {}'s digest  → m{sent}", name(*to)),
        };
        lines.push(format!("{:>3}  {:<4} {what}", at + 1, name(event.replica())));
    }
    if let Outcome::Broken(Broken { at, replica, .. }) = outcome {
        let whose = replica.map_or("", name);
        let when = match at {
            Moment::Start => "at the start: ".into(),
            Moment::Event(at) => format!("after {}, {whose}: ", at + 1),
            Moment::End => format!("when all is delivered or resynchronised, {whose}: "),
        };
        lines.push(format!("  ✗  {when}{outcome}"));
    } else {
        lines.push(format!("     {outcome}"));
    }
    lines
}

/// The course with what it starts from and how it ends.
pub fn json<S: Semantics>(semantics: &S, course: &Course<S::Mutation>, outcome: &Outcome) -> Value {
    let event = |event: &Event<S::Mutation>| match event {
        Event::Mutate { replica, mutations } => {
            let made: Vec<Value> = mutations.iter().map(|made| semantics.mutation_json(made)).collect();
            object!({ "event": "mutate", "replica": replica, "mutations": made })
        }
        Event::Deliver { replica, message } => {
            object!({ "event": "deliver", "replica": replica, "message": message })
        }
        Event::Lose { replica, message } => {
            object!({ "event": "lose", "replica": replica, "message": message })
        }
        Event::Restart { replica, keeps } => {
            object!({ "event": "restart", "replica": replica, "keeps": keeps })
        }
        Event::Answer { replica, to } => object!({ "event": "answer", "replica": replica, "to": to }),
    };
    object!({
        "semantics": semantics.name(),
        "replicas": course.replicas,
        "initial": semantics.state_json(&semantics.initial()),
        "events": course.events.iter().map(event).collect::<Vec<_>>(),
        "ends": outcome.to_string(),
    })
}
