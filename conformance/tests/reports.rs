//! Diagrams, explanations and reports.

use dsr_conformance::case::Level;
use dsr_conformance::corpus;
use dsr_conformance::log::{CaseLine, Footer, Header, Log};
use dsr_conformance::protocol::{Implementation, Unique};
use dsr_conformance::render::{
    Named, badge, diagram, explain, failure, graph, html, junit, markdown, matrix, mermaid,
};
use dsr_conformance::report::{Outcome, Verdict};

const HOSTILE: &str = "</script><img src=x onerror=alert(1)>\"'&]]>\u{1b}[31m\u{202e}\0|`*\n# x";

fn line(id: &str, verdict: Verdict) -> CaseLine {
    let bad = verdict != Verdict::Pass;
    CaseLine {
        id: id.into(),
        level: Level::Must,
        clauses: vec!["JOIN-2".into(), "JOIN-10".into()],
        verdict,
        step: bad.then_some(3),
        detail: if bad { HOSTILE.into() } else { String::new() },
        broken: None,
        expected: if bad { vec![format!("vertex {HOSTILE}")] } else { Vec::new() },
        got: if bad { vec![HOSTILE.into()] } else { Vec::new() },
        excuse: None,
        milliseconds: 1500,
    }
}

fn log(name: &str, cases: Vec<CaseLine>) -> Named {
    let implementation = Implementation {
        name: name.into(),
        version: "1".into(),
        language: "C++".into(),
        source: "https://example.org".into(),
    };
    let header = Header {
        format: 1,
        protocol: 1,
        corpus: "1.0.0".into(),
        spec: "0.1".into(),
        implementation: Some(implementation),
        profiles: vec!["observe".into(), HOSTILE.into()],
        features: Vec::new(),
        command: vec!["./it's".into(), "a b".into()],
        profile: None,
        only: "*".into(),
        cases: cases.len(),
    };
    let footer = Footer { verdict: Outcome::Unexpected, counts: Unique::default() };
    Named::of("f", Log { header, cases, footer: Some(footer), incomplete: None })
}

fn two() -> Vec<Named> {
    let ids = ["universal/delivery/twice", "resolution/tree/cycle"];
    let of =
        |verdicts: [Verdict; 2]| ids.iter().zip(verdicts).map(|(id, verdict)| line(id, verdict)).collect();
    vec![log("sound", of([Verdict::Pass, Verdict::Pass])), log(HOSTILE, of([Verdict::Fail, Verdict::Crash]))]
}

/// `[spec: CONF-16]`
#[test]
fn law_nothing_that_an_adapter_wrote_is_markup() {
    let cases = corpus::cases().unwrap();
    let page = html(&two(), &cases);
    // In a fenced block, whose fence is not in it, nothing is markup.
    let marked = markdown(&two(), &cases);
    let outside: String = marked.split("```").step_by(2).collect();
    assert!(!marked.contains(['\u{1b}', '\u{202e}', '\0']));
    for text in [&page, &junit(&two()), &outside] {
        assert!(!text.contains("<img") && !text.contains("</script"), "{text}");
        assert!(!text.contains(['\u{1b}', '\u{202e}', '\0']));
    }
    assert!(page.contains("&lt;img src=x") && page.contains("sound 1"));
    assert_eq!(
        page.matches("<script").count() + page.matches("http://").count() + page.matches("src=\"").count(),
        0
    );
    assert!(page.contains("href=\"#caseuniversal_2fdelivery_2ftwice\""));
    assert!(page.contains("id=\"caseuniversal_2fdelivery_2ftwice\""));
    // Every tag that is opened is closed.
    for tag in ["details", "pre", "table", "tbody", "tr", "td", "p", "del", "ins"] {
        let opened = page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
    }
}

/// `[spec: CONF-16]`
#[test]
fn law_junit_counts_and_names_clauses() {
    let text = junit(&two());
    assert!(text.contains("name=\"sound 1: universal\" tests=\"1\" failures=\"0\" errors=\"0\""), "{text}");
    assert!(text.contains("tests=\"1\" failures=\"1\" errors=\"0\" skipped=\"0\" time=\"1.500\""), "{text}");
    assert!(text.contains("tests=\"1\" failures=\"0\" errors=\"1\""), "{text}");
    assert!(text.contains("<property name=\"clause\" value=\"JOIN-10\"/>"));
    assert!(text.contains("classname=\"universal.delivery\" name=\"twice\""));
    for tag in ["testsuite", "testcase", "properties", "failure", "error"] {
        let opened = text.matches(&format!("<{tag}>")).count() + text.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, text.matches(&format!("</{tag}>")).count(), "{tag}");
    }
}

/// `[spec: CONF-16]`
#[test]
fn law_markdown_has_a_column_for_each_log_and_clauses_in_order() {
    let text = markdown(&two(), &corpus::cases().unwrap());
    let row = |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap().to_owned();
    assert_eq!(row("| universal"), "| universal | 1/1 | **0/1** |");
    assert!(text.find("| JOIN-2 ").unwrap() < text.find("| JOIN-10 ").unwrap());
    assert!(text.contains("✗"), "{text}");
}

/// `[spec: CONF-16]`
#[test]
fn law_a_badge_is_green_only_if_all_passes() {
    let color = |named: &Named| {
        let badge: serde_json::Value = serde_json::from_str(&badge(named)).unwrap();
        assert_eq!(badge["schemaVersion"], 1);
        badge["color"].as_str().unwrap().to_owned()
    };
    let id = "universal/delivery/twice";
    assert_eq!(color(&log("x", vec![line(id, Verdict::Pass)])), "brightgreen");
    assert_eq!(color(&log("x", vec![line(id, Verdict::Fail)])), "red");
    let excused = CaseLine { excuse: Some("later".into()), ..line(id, Verdict::Fail) };
    assert_eq!(color(&log("x", vec![excused])), "yellow");
    assert_eq!(color(&log("x", vec![line(id, Verdict::Unsupported)])), "lightgrey");
    let mut cut = log("x", vec![line(id, Verdict::Pass)]);
    cut.log.incomplete = Some("it has no footer".into());
    assert_eq!(color(&cut), "lightgrey");
    let cut = [cut];
    assert!(
        junit(&cut).contains("it has no footer") && html(&cut, &[]).contains("incomplete: it has no footer")
    );
    assert!(markdown(&cut, &[]).contains("**incomplete**"));
}

/// `[spec: CONF-16]`
#[test]
fn law_a_failure_shows_clause_steps_difference_and_how_to_replay() {
    let case =
        corpus::cases().unwrap().into_iter().find(|case| case.id == "universal/delivery/twice").unwrap();
    let text = failure(&line(&case.id, Verdict::Fail), Some(&case), &["./it's".into(), "a b".into()]);
    assert!(text.starts_with("fail universal/delivery/twice [JOIN-2, JOIN-10]\n"), "{text}");
    assert_eq!(text.lines().filter(|line| line.starts_with("  ✗")).count(), 1, "{text}");
    assert!(text.contains("    - expected vertex ") && text.contains("    + got      "));
    assert!(
        text.ends_with("  replay: dsr conform replay universal/delivery/twice -- './it'\\''s' 'a b'\n"),
        "{text}"
    );
    assert!(!text.contains(['\u{1b}', '\u{202e}', '\0']));
}

/// `[spec: CONF-16]`
#[test]
fn law_every_case_can_be_drawn_and_explained() {
    for case in corpus::cases().unwrap() {
        let drawn = diagram(&case, Some(1));
        assert_eq!(drawn.matches('✗').count(), 1, "{drawn}");
        let numbers =
            drawn.lines().filter(|line| line.chars().take(4).any(|character| character.is_ascii_digit()));
        assert_eq!(numbers.count(), case.steps.len(), "{drawn}");
        let explained = explain(&case);
        assert!(case.spec.iter().all(|clause| explained.contains(&format!("**{clause}"))), "{explained}");
        assert!(mermaid(&case).starts_with("sequenceDiagram\n    participant p1 as "));
    }
}

/// `[spec: CONF-16]`
#[test]
fn law_a_view_that_is_no_tree_is_drawn_to_an_end() {
    let text = r#"{"vertices": {"a": {"type": "t", "name": "a"}, "b": {"type": "t", "name": "b"}}, "edges": [
        {"from": "a", "label": "RT", "to": "b"}, {"from": "b", "label": "RT", "to": "a"},
        {"from": "root", "label": "RT", "to": "z"}], "root": {"attributes": {}}, "hung": ["q"]}"#;
    let drawn = graph(&serde_json::from_str(text).unwrap());
    assert!(
        drawn.contains("a again") && drawn.contains("z: not there") && drawn.contains("q: not there"),
        "{drawn}"
    );
}

/// `[spec: CONF-16]`
#[test]
fn law_each_bold_cell_of_a_matrix_leads_to_a_failing_case_that_is_shown() {
    let cases = corpus::cases().unwrap();
    let mut logs = two();
    logs[1].log.cases[0].broken = Some("INV-3".into());
    let page = matrix(&logs, &cases);
    let outside: String = page.split("```").step_by(2).collect();
    assert!(!page.contains(['\u{1b}', '\u{202e}', '\0']));
    let links: Vec<&str> = outside
        .match_indices("](#")
        .filter_map(|(at, link)| outside[at + link.len()..].split(')').next())
        .collect();
    assert!(links.len() >= 5, "{page}");
    for link in links {
        assert!(outside.contains(&format!("<a id=\"{link}\"></a>")), "{link}");
    }
    let row = |name: &str| outside.lines().find(|line| line.contains(name)).unwrap().to_owned();
    assert!(row("(INV-3)").contains("broken in 1 case"), "{page}");
    assert!(row("(INV-2)").ends_with("| kept | kept |"), "{page}");
}
