//! Pages as texts: what is in them, and what is refused.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that cannot go on has failed"
)]

mod made;

use base64::Engine;
use dsr_explorer::{PageError, page};
use dsr_model::trace::Unsound;
use serde_json::Value;
use sha2::{Digest, Sha256};

/// Between two texts, the first time.
fn between<'p>(page: &'p str, start: &str, end: &str) -> &'p str {
    page.split_once(start).unwrap().1.split_once(end).unwrap().0
}

fn data(page: &str) -> &str {
    between(page, "<script type=\"application/json\" id=\"data\">", "</script>")
}

/// `[spec: TRACE-5]`
#[test]
fn law_a_page_is_small() {
    let content = made::gallery();
    let all = page(&content).unwrap().len();
    assert!(all < 400_000, "all rows: {all}");
    let mut row = content;
    row.traces.truncate(2);
    let one = page(&row).unwrap().len();
    assert!(one < 120_000, "one row: {one}");
}

/// `[spec: TRACE-5]`
#[test]
fn law_only_its_own_style_and_script_run() {
    let page = page(&made::check()).unwrap();
    let hash = |text: &str| base64::engine::general_purpose::STANDARD.encode(Sha256::digest(text));
    let policy = between(&page, "http-equiv=\"Content-Security-Policy\" content=\"", "\"");
    let script = between(&page, "</script>\n<script>", "</script>");
    let style = between(&page, "<style>", "</style>");
    assert!(policy.starts_with("default-src 'none';"), "{policy}");
    assert!(policy.contains(&format!("script-src 'sha256-{}'", hash(script))), "{policy}");
    assert!(policy.contains(&format!("style-src 'sha256-{}'", hash(style))), "{policy}");
    for loads in ["src=", "@import", "url(", "fetch(", "innerHTML", "eval("] {
        assert!(!page.contains(loads), "{loads}");
    }
}

/// `[spec: TRACE-5]`
#[test]
fn law_texts_stay_texts() {
    let page = page(&made::alone(made::hostile())).unwrap();
    assert!(!data(&page).contains('<'));
    let data: Value = serde_json::from_str(data(&page)).unwrap();
    assert_eq!(data["title"], made::HOSTILE, "and are whole");
    assert_eq!(page.matches("<script").count(), 2);
    assert_eq!(page.matches("<img").count(), 0);
    let plain = between(&page, "<noscript>", "</noscript>");
    assert!(plain.contains("&lt;/script&gt;&lt;img"));
    assert!(!plain.contains('\u{202e}'));
    assert!(plain.contains("{{script}}"), "a place in data is no place");
}

/// `[spec: TRACE-5]`
#[test]
fn law_every_step_can_be_read_without_a_script() {
    let content = made::gallery();
    let page = page(&content).unwrap();
    let plain = between(&page, "<noscript>", "</noscript>");
    assert_eq!(plain.matches("<details>").count(), content.traces.len());
    for shown in &content.traces {
        for line in shown.trace.to_string().lines() {
            let line =
                line.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
            assert!(plain.contains(&line), "{line}");
        }
    }
}

/// `[spec: TRACE-3]` `[spec: TRACE-5]`
#[test]
fn law_what_cannot_be_is_refused() {
    let mut trace = made::every_kind();
    trace.steps[2].changes.clear();
    let refused = page(&made::alone(trace)).err().unwrap();
    assert!(matches!(refused, PageError::Unsound { why: Unsound::Change { step: 7, .. }, .. }), "{refused}");
    let mut trace = made::every_kind();
    trace.steps[3].replica = "nobody".into();
    let refused = page(&made::alone(trace)).err().unwrap();
    let PageError::Unsound { title, why } = &refused else { panic!("{refused}") };
    assert_eq!(title, "Every kind of step");
    assert_eq!(*why, Unsound::Replica { step: 4, replica: "nobody".into() });
    assert!(refused.to_string().contains("step 4"), "{refused}");
}

/// Same content, same bytes. `[spec: TRACE-5]`
#[test]
fn law_pages_are_the_same_each_time() {
    assert_eq!(page(&made::check()).unwrap(), page(&made::check()).unwrap());
}
