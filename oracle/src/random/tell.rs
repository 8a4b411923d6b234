//! A history for people, step by step. `[spec: ORACLE-5]`

use super::world::{Event, History, Outcome, World};
use dsr_core::{Dictionary, State};
use serde::Serialize;
use std::fmt::Write;

/// The history as lines.
pub fn tell(history: &History) -> String {
    let mut world = World::of(history);
    let mut text = String::new();
    let open = Dictionary::open();
    for (id, dictionary) in history.replicas.iter().filter(|(_, dictionary)| *dictionary != open) {
        line(&mut text, format_args!("     {id} knows {}", json(dictionary)));
    }
    for (number, event) in &history.events {
        let (outcome, _) = world.happen(*number, event);
        let what = words(&world, *number, event);
        let outcome = match outcome {
            Outcome::Done => String::new(),
            Outcome::Refused(kind) => format!("  ✗ refused: {kind}"),
            Outcome::Nothing => "  (nothing happens)".into(),
            Outcome::NotTaken => "  (not well-formed: not taken over)".into(),
        };
        line(&mut text, format_args!("{number:>3}  {what}{outcome}"));
    }
    text
}

fn words(world: &World, number: usize, event: &Event) -> String {
    let who = |replica: &usize| {
        world.replicas.get(*replica).map(|replica| replica.id.to_string()).unwrap_or_default()
    };
    match event {
        Event::Mutate { replica, mutations, .. } => {
            let mutations: Vec<String> = mutations.iter().map(json).collect();
            format!("{}  {}  → m{number}", who(replica), mutations.join("\n       then "))
        }
        Event::Deliver { replica, delta } => format!("{}  receives m{delta}", who(replica)),
        Event::Group { deltas } => {
            let deltas: Vec<String> = deltas.iter().map(|delta| format!("m{delta}")).collect();
            format!("{} as one message  → m{number}", deltas.join(", "))
        }
        Event::Join { replica, from } => format!("{}  takes over the state of {}", who(replica), who(from)),
        Event::Tell { replica } => format!("{}  says what it has seen  → s{number}", who(replica)),
        Event::Answer { replica, digest } => format!("{}  answers s{digest}  → m{number}", who(replica)),
        Event::Restart { replica } => format!("{}  has started anew", who(replica)),
        Event::Outside { state } => format!("from outside  → m{number}{}", records(state)),
        Event::Bytes { bytes } => format!("bytes from outside: {}", crate::fact::hex(bytes)),
    }
}

fn records(state: &State) -> String {
    let mut text = String::new();
    for (dot, record) in state.records() {
        let _ = write!(text, "\n       {dot} {}", json(record));
    }
    for run in state.context().runs() {
        for dead in run.dots().take(DEAD_MAX).filter(|dot| !state.holds(*dot)) {
            let _ = write!(text, "\n       {dead} is dead");
        }
    }
    text
}

/// Of each run so many dots are looked at.
const DEAD_MAX: usize = 16;

fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// Writing to a string cannot fail.
fn line(text: &mut String, what: std::fmt::Arguments<'_>) {
    let _ = text.write_fmt(what);
    text.push('\n');
}
