//! What a page shows in a browser, against what its traces say. Without one, these tests say so and pass; with `DSR_BROWSER=required` they fail then.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that cannot go on has failed"
)]

mod driver;
mod made;

use driver::Browser;
use dsr_explorer::page;
use dsr_model::graph::{Change, Element, Graph};
use dsr_model::trace::Trace;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// What the page shows of a trace: by step and replica, which elements, with which marks, and which lines of change.
fn shown(browser: &Browser, trace: usize, fragment: &str) -> Value {
    browser.go(fragment);
    browser.run(&format!(
        "const more = document.querySelector('#all'); if (!more.hidden && more.ariaPressed === 'false') more.click();
        const steps = [];
        for (;;) {{
          steps.push([...document.querySelectorAll('.panel')].map((panel) => ({{
            elements: [...panel.querySelectorAll('.box:not(.ghost), g.edge')].map((node) => [node.dataset.element, node.dataset.mark ?? null]),
            ghosts: [...panel.querySelectorAll('.ghost')].map((node) => node.dataset.element),
            signs: [...panel.querySelectorAll('[data-mark]')].map((node) => [node.dataset.element, node.textContent]),
            changes: [...panel.querySelectorAll('ul.changes li')].map((node) => node.textContent),
            remarks: [...panel.querySelectorAll('ul.remarks li')].map((node) => node.textContent),
          }})));
          const next = document.querySelector('#next');
          if (next.disabled) return {{ trace: {trace}, steps }};
          next.click();
        }}"
    ))
}

/// The ids of elements with each mark that they ought to have.
fn expected_marks(before: &Graph, after: &Graph) -> BTreeMap<String, BTreeSet<Option<&'static str>>> {
    let mut marks: BTreeMap<String, BTreeSet<_>> =
        after.elements.keys().map(|id| (id.clone(), [None].into())).collect();
    for change in before.changes(after) {
        let Change::Element { element, before, after } = change else { continue };
        let ends = |element: &Option<Element>| match element {
            Some(Element::Edge { from, to, label, .. }) => Some((from.clone(), to.clone(), label.clone())),
            _ => None,
        };
        let mark = match (&before, &after) {
            (None, _) => [Some("new")].into(),
            (_, None) => [Some("gone")].into(),
            _ if ends(&before) != ends(&after) => [Some("gone"), Some("new")].into(),
            _ => [Some("changed")].into(),
        };
        marks.insert(element, mark);
    }
    marks
}

/// The first disagreement between what a page shows of a trace and what the trace says.
fn disagreement(trace: &Trace, shown: &Value) -> Option<String> {
    let graphs = trace.graphs().unwrap();
    let names = trace.names();
    let steps = shown["steps"].as_array().unwrap();
    if steps.len() != graphs.len() {
        return Some(format!("{} moments, {} shown", graphs.len(), steps.len()));
    }
    for (at, panels) in steps.iter().enumerate() {
        for (replica, after) in graphs[at].iter().enumerate() {
            let panel = &panels[replica];
            let before = &graphs[at.saturating_sub(1)][replica];
            let mut marks: BTreeMap<String, BTreeSet<Option<&str>>> = BTreeMap::new();
            for element in panel["elements"].as_array().unwrap() {
                let id = element[0].as_str().unwrap().to_owned();
                marks.entry(id).or_default().insert(element[1].as_str());
            }
            let expected = expected_marks(before, after);
            if marks != expected {
                return Some(format!("step {at}, replica {replica}: {marks:?} instead of {expected:?}"));
            }
            let acts = at > 0 && trace.steps[at - 1].replica == trace.replicas[replica].name;
            let mut lines: Vec<String> = Vec::new();
            for change in
                trace.steps.get(at.wrapping_sub(1)).filter(|_| acts).map_or(&[][..], |step| &step.changes)
            {
                if matches!(change, Change::Element { .. }) {
                    lines.extend(change.lines(&names).iter().map(|line| line.replacen("- ", "+ ", 1)));
                }
            }
            let told = panel["changes"].as_array().unwrap().iter().filter_map(Value::as_str);
            let told: Vec<String> = told
                .map(|line| {
                    let sign = line.chars().next().map_or(' ', |sign| if sign == '−' { '+' } else { sign });
                    format!("{sign} {}", line.chars().skip(1).collect::<String>())
                })
                .collect();
            if told != lines {
                return Some(format!("step {at}, replica {replica}: {told:?} instead of {lines:?}"));
            }
            let unsigned = panel["signs"].as_array().unwrap().iter().find(|node| {
                let id = &node[0];
                let signed = panel["signs"].as_array().unwrap().iter().filter(|other| &other[0] == id);
                !signed.filter_map(|node| node[1].as_str()).any(|text| text.starts_with(['+', '−', '±', '≠']))
                    // An edge of the tree whose child has the sign.
                    && !node[1].as_str().unwrap().is_empty()
            });
            if let Some(unsigned) = unsigned {
                return Some(format!("step {at}, replica {replica}: {unsigned} is told by colour alone"));
            }
            let remarks = panel["remarks"].as_array().unwrap();
            if let Some(missing) = after.remarks.iter().find(|remark| {
                !remarks.iter().filter_map(Value::as_str).any(|shown| shown.ends_with(remark.as_str()))
            }) {
                return Some(format!("step {at}, replica {replica}: the remark {missing:?} is not shown"));
            }
            let ends = after.elements.values().filter_map(|element| match element {
                Element::Edge { from, to, .. } => Some([from, to]),
                Element::Vertex { .. } => None,
            });
            let gone = |id: &&String| !expected.contains_key(*id);
            let missing: BTreeSet<&str> = ends.flatten().filter(gone).map(|id| &**id).collect();
            let ghosts: BTreeSet<&str> =
                panel["ghosts"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
            if ghosts != missing {
                return Some(format!(
                    "step {at}, replica {replica}: ghosts {ghosts:?} instead of {missing:?}"
                ));
            }
        }
    }
    None
}

/// `[spec: TRACE-2]` `[spec: TRACE-5]`
#[test]
fn differential_the_page_shows_what_the_trace_says() {
    let Some(browser) = Browser::start(1400, 900) else { return };
    for content in [made::check(), made::gallery()] {
        browser.open(&page(&content).unwrap(), "");
        for (at, of) in content.traces.iter().enumerate() {
            let fragment = match &of.origin {
                dsr_explorer::Origin::Row { row, side } => format!("#row={row}&as={}&s=0", side.word()),
                _ => format!("#t={}&s=0", at + 1),
            };
            let shown = shown(&browser, at, &fragment);
            assert_eq!(disagreement(&of.trace, &shown), None, "{}", of.trace.title);
        }
        assert_eq!(browser.console(), Vec::<String>::new());
    }
}

/// `[spec: TRACE-5]`
#[test]
fn canary_a_page_of_another_trace_is_noticed() {
    let trace = made::every_kind();
    let mut other = trace.clone();
    other.steps.truncate(1);
    let of_on = |change: &Change| matches!(change, Change::Element { element, .. } if element == "on");
    other.steps[0].changes.retain(|change| !of_on(change));
    let Some(browser) = Browser::start(1400, 900) else { return };
    browser.open(&page(&made::alone(other)).unwrap(), "");
    let shown = shown(&browser, 0, "#t=1&s=0");
    let mut first = trace;
    first.steps.truncate(1);
    assert!(disagreement(&first, &shown).unwrap().contains("\"on\""));
}

/// `[spec: TRACE-5]`
#[test]
fn law_differences_are_marked_on_demand() {
    let Some(browser) = Browser::opened(&page(&made::alone(made::every_kind())).unwrap(), "#t=1&s=2") else {
        return;
    };
    let marks = "return [...document.querySelectorAll('.panel')].map((panel) => Object.fromEntries(\
        [...panel.querySelectorAll('.box, g.edge')].map((node) => [node.dataset.element, node.dataset.mark]).filter(([, mark]) => mark)))";
    browser.press("d");
    let found = browser.run(marks);
    assert_eq!(found[0], json!({}), "the first is what others are compared with");
    let observer = json!({ "3": "differs", "e3": "differs", "on": "differs", "e4": "differs" });
    assert_eq!(found[2], observer, "it still shows the table");
    assert_eq!(found[1]["6"], "differs");
    browser.press("d");
    assert_eq!(browser.run(marks)[2], json!({}));
    browser.press("End");
    browser.press("d");
    assert_eq!(browser.run(marks)[2]["1"], "missing", "what is only at the first");
}

/// `[spec: TRACE-5]`
#[test]
fn law_what_no_step_touches_is_folded_away() {
    let Some(browser) = Browser::opened(&page(&made::alone(made::large())).unwrap(), "") else { return };
    let boxes = "return document.querySelector('.panel').querySelectorAll('.box').length";
    assert_eq!(browser.run(boxes), 6);
    assert_eq!(browser.text("#all"), "… 64 untouched");
    browser.press("u");
    assert_eq!(browser.run(boxes), 70);
}

/// `[spec: TRACE-5]`
#[test]
fn law_nothing_jumps_from_step_to_step() {
    let Some(browser) = Browser::opened(&page(&made::alone(made::every_kind())).unwrap(), "") else { return };
    let places = browser.run(
        "const places = {}; const moved = [];
        for (let at = 0; at <= 11; at += 1) {
          for (const panel of document.querySelectorAll('.panel')) for (const box of panel.querySelectorAll('.box')) {
            const place = [box.style.left, box.style.top, box.style.height].join();
            if ((places[box.dataset.element] ??= place) !== place) moved.push([at, box.dataset.element]);
          }
          document.querySelector('#next').click();
        }
        return [Object.keys(places).length, moved];",
    );
    assert_eq!(places, json!([8, []]));
}

/// `[spec: TRACE-5]`
#[test]
fn law_hostile_texts_stay_texts_in_the_browser() {
    let Some(browser) = Browser::start(1400, 900) else { return };
    let mut content = made::check();
    content.title = made::HOSTILE.into();
    content.traces.push(dsr_explorer::Shown {
        trace: made::hostile(),
        origin: dsr_explorer::Origin::Run(made::HOSTILE.into()),
    });
    browser.open(&page(&content).unwrap(), "");
    let state = "return { images: document.images.length, scripts: document.scripts.length, title: document.title, \
        comments: document.documentElement.outerHTML.includes('<!--'), wide: document.scrollingElement.scrollWidth > innerWidth }";
    for fragment in ["#", "#t=3&s=0", "#t=3&s=1", "#t=3&s=2"] {
        browser.go(fragment);
        let found = browser.run(state);
        assert_eq!(found["images"], 0);
        assert_eq!(found["scripts"], 2);
        assert_eq!(found["comments"], false);
        assert_eq!(found["wide"], false, "{fragment}");
        assert!(found["title"].as_str().unwrap().starts_with("</script><img"));
    }
    let name = "</script><img src=x onerror=\"document.title='owned'\">{{script}}⟨U+202E⟩<!--";
    assert_eq!(browser.text("h1"), name);
    let drawn = shown(&browser, 2, "#t=3&s=0");
    assert_eq!(disagreement_of_elements(&content.traces[2].trace, &drawn), None);
    assert_eq!(browser.console(), Vec::<String>::new());
}

/// As a disagreement, but of elements and their marks only: texts are written out in the page.
fn disagreement_of_elements(trace: &Trace, shown: &Value) -> Option<String> {
    let graphs = trace.graphs().unwrap();
    for (at, moment) in graphs.iter().enumerate() {
        for (replica, after) in moment.iter().enumerate() {
            let drawn = shown["steps"][at][replica]["elements"].as_array().unwrap().len();
            let expected = expected_marks(&graphs[at.saturating_sub(1)][replica], after).len();
            if drawn != expected {
                return Some(format!("step {at}, replica {replica}: {drawn} drawn instead of {expected}"));
            }
        }
    }
    None
}
