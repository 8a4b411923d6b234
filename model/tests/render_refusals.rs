//! Traces with hostile or unresolved names, and texts that are no traces.

#![expect(clippy::expect_used, reason = "helpers of tests: what they expect is what they test")]

mod made;

use dsr_model::graph::{Change, ChangeError, Element};
use dsr_model::render::{RenderError, Target, render};
use dsr_model::trace::{Trace, TraceError, TraceStep, Unsound};
use made::{RESTART, TARGETS, answer, crossing, deliver, made, mutate, read_log, step};

const HOSTILE: &str = "<b>&\"x\";\n# %% 'end'\u{1b}[2J\u{2028}";

fn hostile() -> Trace {
    let name = |number: u8| format!("{number}{HOSTILE}");
    let (one, two) = (name(1), name(2));
    let mut trace = made(
        &[&one, &two],
        vec![
            step(&one, mutate(HOSTILE, HOSTILE)),
            step(&two, deliver(HOSTILE)),
            step(&two, answer(&one, "m2")),
            step(&two, RESTART),
        ],
    );
    for (at, step) in trace.steps.iter_mut().enumerate() {
        step.changes = vec![Change::Remark { remark: format!("{at}{HOSTILE}"), holds: true }];
    }
    trace.title = HOSTILE.into();
    trace.semantics = HOSTILE.into();
    trace.layer = HOSTILE.into();
    trace.finding.clause = HOSTILE.into();
    trace.finding.detail = HOSTILE.into();
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
        let why = trace.check().expect_err("not a sound trace");
        let text = serde_json::to_string(&trace).expect("json");
        assert_eq!(Trace::read(&text), Err(TraceError::Unsound(why.clone())));
        for target in TARGETS {
            assert_eq!(render(&trace, target), Err(RenderError::Unsound(why.clone())));
        }
        why
    };
    let unknown = one(&["r1", "r2"], vec![sound(), step("r2", deliver("m9"))]);
    assert_eq!(unknown, Unsound::Message { step: 2, message: "m9".into() });
    assert!(unknown.to_string().contains("step 2") && unknown.to_string().contains("\"m9\""));
    let early = one(&["r1", "r2"], vec![step("r2", deliver("m1")), sound()]);
    assert_eq!(early, Unsound::Message { step: 1, message: "m1".into() });
    let nobody = one(&["r1"], vec![sound(), step("r3", RESTART)]);
    assert_eq!(nobody, Unsound::Replica { step: 2, replica: "r3".into() });
    let answer = one(&["r1"], vec![step("r1", answer("r3", "m1"))]);
    assert_eq!(answer, Unsound::Replica { step: 1, replica: "r3".into() });
    let twice = one(&["r1"], vec![sound(), sound()]);
    assert_eq!(twice, Unsound::SentTwice { message: "m1".into(), first: 1, second: 2 });
    assert_eq!(one(&["r1", "r1"], Vec::new()), Unsound::TwoReplicas { name: "r1".into() });
    assert_eq!(one(&[], Vec::new()), Unsound::NoReplicas);
}

/// `[spec: TRACE-2]` `[spec: TRACE-3]`
#[test]
fn law_a_change_of_what_was_not_so_is_refused_with_its_step() {
    let vertex = |name: &str| Element::Vertex {
        name: name.into(),
        vertex_type: "thing".into(),
        attributes: [("x".into(), "1".into())].into(),
    };
    let change = |before: Option<&str>, after: Option<&str>| Change::Element {
        element: "v".into(),
        before: before.map(vertex),
        after: after.map(vertex),
    };
    let remark = |holds| Change::Remark { remark: "odd".into(), holds };
    let checked = |changes: [Vec<Change>; 2]| {
        let mut trace = made(&["r1"], vec![step("r1", mutate("m1", "one")), step("r1", mutate("m2", "two"))]);
        for (step, changes) in trace.steps.iter_mut().zip(changes) {
            step.changes = changes;
        }
        trace.check()
    };
    assert_eq!(checked([vec![change(None, Some("a"))], vec![change(Some("a"), None), remark(true)]]), Ok(()));
    let element = || ChangeError::Element { element: "v".into() };
    let why = |step, why| Err(Unsound::Change { step, why });
    assert_eq!(checked([vec![change(Some("a"), None)], Vec::new()]), why(1, element()));
    assert_eq!(checked([vec![change(None, Some("a"))], vec![change(Some("b"), None)]]), why(2, element()));
    assert_eq!(checked([vec![change(None, Some("a"))], vec![change(None, Some("b"))]]), why(2, element()));
    let again = ChangeError::Remark { remark: "odd".into() };
    assert_eq!(checked([vec![remark(true)], vec![remark(true)]]), why(2, again.clone()));
    assert_eq!(checked([vec![remark(false)], Vec::new()]), why(1, again));
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
    let newer = json.replace("\"version\": 2", "\"version\": 3");
    assert_eq!(read(&newer), TraceError::OtherVersion { found: "3".into() });
    let key = json.replace("\"layer\"", "\"lair\"");
    assert!(matches!(read(&key), TraceError::Form { line: 7, .. }), "{}", read(&key));
    assert!(matches!(read("{\n \"format\": ]"), TraceError::Syntax { line: 2, column: 12, .. }));
}
