//! Traces with hostile or unresolved names, and texts that are no traces.

#![expect(clippy::expect_used, reason = "helpers of tests: what they expect is what they test")]

mod made;

use dsr_model::render::{RenderError, Target, render};
use dsr_model::trace::{Act, Trace, TraceBreach, TraceError, TraceStep};
use made::{TARGETS, crossing, deliver, made, mutate, read_log, resynchronise, step};

const HOSTILE: &str = "<b>&\"x\";\n# %% 'end'\u{1b}[2J\u{2028}";

fn hostile() -> Trace {
    let name = |number: u8| format!("{number}{HOSTILE}");
    let (one, two) = (name(1), name(2));
    let mut trace = made(
        &[&one, &two],
        vec![
            step(&one, mutate(HOSTILE, HOSTILE)),
            step(&two, deliver(HOSTILE)),
            step(&two, resynchronise(&one)),
            step(&two, Act::Restart),
        ],
    );
    for step in &mut trace.steps {
        step.changes = vec![HOSTILE.into()];
    }
    trace.semantics = HOSTILE.into();
    trace.layer = HOSTILE.into();
    trace.breach = TraceBreach { clause: HOSTILE.into(), detail: HOSTILE.into(), states: Vec::new() };
    trace
}

/// The texts between tags, and the values of attributes.
fn outside_tags(svg: &str) -> (Vec<&str>, Vec<&str>) {
    let mut pieces = svg.split('<').skip(1).map(|piece| piece.split_once('>').expect("a closed tag"));
    pieces.by_ref().fold((Vec::new(), Vec::new()), |(mut texts, mut tags), (tag, text)| {
        texts.push(text);
        tags.push(tag);
        (texts, tags)
    })
}

#[test]
fn law_names_cannot_leave_their_place() {
    let trace = hostile();
    let svg = render(&trace, Target::Svg).expect("a sound trace");
    let (texts, tags) = outside_tags(&svg);
    let known = ["svg", "title", "style", "defs", "marker", "path", "rect", "g", "line", "text", "circle"];
    for tag in tags {
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap_or_default();
        assert!(known.contains(&name) && tag.matches('"').count() % 2 == 0, "{tag}");
    }
    for text in texts {
        for entity in text.split('&').skip(1) {
            let is_known =
                ["amp;", "lt;", "gt;", "quot;", "apos;"].iter().any(|known| entity.starts_with(known));
            assert!(is_known, "{text}");
        }
        let is_fit = |character: char| character == '\n' || !character.is_control();
        assert!(text.chars().all(is_fit), "{text:?}");
    }
    let mermaid = render(&trace, Target::Mermaid).expect("a sound trace");
    for line in mermaid.lines().skip(1) {
        let is_known = ["    participant p", "    Note over p", "    p1->>p2: ", "    p1-->>p2: "]
            .iter()
            .any(|known| line.starts_with(known));
        let mut bare = line.replace("<br/>", "").replace("->>", "");
        for code in 33..127 {
            bare = bare.replace(&format!("#{code};"), "");
        }
        assert!(is_known && !bare.contains(['<', '>', '&', '"', ';', '#', '%']), "{line}");
    }
    let text = render(&trace, Target::Text).expect("a sound trace");
    assert!(text.chars().all(|character| character == '\n' || !character.is_control()), "{text:?}");
    let log = render(&trace, Target::Shiviz).expect("a sound trace");
    let hosts: Vec<String> = read_log(&log).into_iter().map(|(_, host, _)| host).collect();
    assert_eq!(hosts.len(), 4);
    assert!(hosts[0] != hosts[1] && hosts[1] == hosts[3], "{hosts:?}");
}

/// `[spec: TRACE-3]`
#[test]
fn law_names_that_do_not_resolve_are_refused_with_their_step() {
    let sound = || step("r1", mutate("m1", "one"));
    let one = |replicas: &[&str], steps: Vec<TraceStep>| {
        let trace = made(replicas, steps);
        let errors = TARGETS.map(|target| render(&trace, target).expect_err("not a sound trace"));
        assert!(errors.iter().all(|error| *error == errors[0]));
        errors[0].clone()
    };
    let unknown = one(&["r1", "r2"], vec![sound(), step("r2", deliver("m9"))]);
    assert_eq!(unknown, RenderError::UnknownMessage { step: 2, message: "m9".into() });
    assert!(unknown.to_string().contains("step 2") && unknown.to_string().contains("\"m9\""));
    let early = one(&["r1", "r2"], vec![step("r2", deliver("m1")), sound()]);
    assert_eq!(early, RenderError::UnknownMessage { step: 1, message: "m1".into() });
    let nobody = one(&["r1"], vec![sound(), step("r3", Act::Restart)]);
    assert_eq!(nobody, RenderError::UnknownReplica { step: 2, name: "r3".into() });
    let answer = one(&["r1"], vec![step("r1", resynchronise("r3"))]);
    assert_eq!(answer, RenderError::UnknownReplica { step: 1, name: "r3".into() });
    let twice = one(&["r1"], vec![sound(), sound()]);
    assert_eq!(twice, RenderError::SentTwice { step: 2, first: 1, message: "m1".into() });
    assert_eq!(one(&["r1", "r1"], Vec::new()), RenderError::TwoReplicas { name: "r1".into() });
    assert_eq!(one(&[], Vec::new()), RenderError::NoReplicas);
}

#[test]
fn law_many_replicas_long_names_and_no_steps_are_drawn() {
    let names: Vec<String> =
        (0..14).map(|number| format!("an unusually long name of replica {number}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let long = "word ".repeat(60) + &"x".repeat(250);
    let steps = vec![step(names[13], mutate("m1", &long)), step(names[0], deliver("m1"))];
    let text = render(&made(&names, steps), Target::Text).expect("a sound trace");
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert!(text.contains("14 is an unusually long name of replica 13"), "{text}");
    for target in TARGETS {
        assert!(render(&made(&["r1"], Vec::new()), target).expect("a sound trace").contains("JOIN-5"));
    }
    let many: Vec<String> = (0..15).map(|number| number.to_string()).collect();
    let trace = made(&many.iter().map(String::as_str).collect::<Vec<_>>(), Vec::new());
    assert_eq!(render(&trace, Target::Text), Err(RenderError::TooWide { replicas: 15, most: 14 }));
    assert!(render(&trace, Target::Svg).is_ok());
}

/// `[spec: TRACE-3]`
#[test]
fn law_other_formats_and_versions_are_refused_by_what_they_say() {
    let json = serde_json::to_string_pretty(&crossing()).expect("json");
    assert_eq!(Trace::read(&json), Ok(crossing()));
    let read = |text: &str| Trace::read(text).expect_err("no trace");
    assert_eq!(read("{}"), TraceError::NoFormat);
    assert_eq!(read("[]"), TraceError::NoFormat);
    let other = json.replace("dsr-trace", "dsr-tale");
    assert_eq!(read(&other), TraceError::OtherFormat { found: "\"dsr-tale\"".into() });
    let newer = json.replace("\"version\": 1", "\"version\": 2");
    assert_eq!(read(&newer), TraceError::OtherVersion { found: "2".into() });
    let key = json.replace("\"layer\"", "\"lair\"");
    assert!(matches!(read(&key), TraceError::Form { line: 5, .. }), "{}", read(&key));
    assert!(matches!(read("{\n \"format\": ]"), TraceError::Syntax { line: 2, column: 12, .. }));
}
