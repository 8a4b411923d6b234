//! Whether everybody can read and use a page. Without one, these tests say so and pass; with `DSR_BROWSER=required` they fail then.

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
use serde_json::json;
use std::collections::BTreeSet;

/// `[spec: TRACE-5]`
#[test]
fn law_a_narrow_page_does_not_scroll_sideways() {
    let Some(browser) = Browser::start(400, 800) else { return };
    for (content, fragments) in [
        (made::gallery(), vec!["#", "#row=1&s=3", "#row=29&s=12", "#row=22&as=checked&s=4"]),
        (made::check(), vec!["#", "#t=1&s=2", "#t=2&s=1"]),
    ] {
        browser.open(&page(&content).unwrap(), "");
        for fragment in fragments {
            browser.go(fragment);
            let page = "const page = document.scrollingElement; return [innerWidth, page.scrollWidth - page.clientWidth]";
            assert_eq!(browser.run(page), json!([400, 0]), "{fragment}");
        }
    }
}

/// Every text on the page with less contrast than 4.5 : 1 to what is behind it.
const FAINT: &str = "
  const canvas = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const parse = (text) => { canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = text; canvas.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data; return [r, g, b, a / 255]; };
  const over = (top, under) => top.slice(0, 3).map((part, at) => part * top[3] + under[at] * (1 - top[3]));
  const light = (colour) => { const [r, g, b] = colour.map((part) => { const c = part / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const behind = (node) => { const layers = [];
    for (let at = node; at instanceof Element; at = at.parentElement) {
      const ground = parse(getComputedStyle(at).backgroundColor); layers.push(ground); if (ground[3] === 1) break; }
    return layers.reverse().reduce((under, top) => over(top, under), [255, 255, 255]); };
  const faint = []; let seen = 0;
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || ['SCRIPT', 'STYLE', 'NOSCRIPT'].includes(node.tagName)) continue;
    if (!node.checkVisibility({ visibilityProperty: true }) || node.closest('.unseen, dialog:not([open])')) continue;
    const style = getComputedStyle(node);
    let opacity = 1; for (let at = node; at; at = at.parentElement) opacity *= Number(getComputedStyle(at).opacity);
    const disc = node.classList.contains('discsign') && node.previousElementSibling;
    const ground = disc ? parse(getComputedStyle(disc).fill).slice(0, 3) : behind(node);
    const colour = parse(node instanceof SVGElement ? style.fill : style.color); colour[3] *= opacity;
    const [one, other] = [light(over(colour, ground)), light(ground)];
    const contrast = (Math.max(one, other) + 0.05) / (Math.min(one, other) + 0.05);
    seen += 1;
    if (contrast < 4.5) faint.push([contrast.toFixed(2), node.className.baseVal ?? node.className, walker.currentNode.data.slice(0, 40)]);
  }
  return { seen, faint };";

/// `[spec: TRACE-5]`
#[test]
fn law_texts_have_contrast_in_light_and_dark() {
    let Some(browser) = Browser::start(1400, 900) else { return };
    let content = made::check();
    let mut grounds = BTreeSet::new();
    for scheme in ["light", "dark"] {
        browser.prefer(scheme);
        browser.open(&page(&content).unwrap(), "");
        grounds.insert(
            browser.run("return getComputedStyle(document.documentElement).backgroundColor").to_string(),
        );
        let judge = |what: &str| {
            let found = browser.run(FAINT);
            assert!(found["seen"].as_u64().unwrap() > 40, "{what}: {found}");
            assert_eq!(found["faint"], json!([]), "{scheme}, {what}");
        };
        judge("overview");
        for step in 0..=11 {
            browser.go(&format!("#t=1&s={step}"));
            judge(&format!("step {step}"));
            browser.press("d");
            judge(&format!("step {step}, differences"));
            browser.press("d");
        }
        browser.press("?");
        judge("help");
    }
    assert_eq!(grounds.len(), 2, "the system's preference is followed: {grounds:?}");
}

/// `[spec: TRACE-5]`
#[test]
fn canary_a_faint_text_is_noticed() {
    let Some(browser) = Browser::opened(&page(&made::check()).unwrap(), "") else { return };
    browser.run("document.querySelector('h1').style.color = '#aaa'");
    let faint = browser.run(FAINT)["faint"].clone();
    assert_eq!(faint[0][2], "What the check found");
}

/// `[spec: TRACE-5]`
#[test]
fn law_light_and_dark_can_be_chosen() {
    let Some(browser) = Browser::opened(&page(&made::check()).unwrap(), "") else { return };
    browser.prefer("light");
    let ground = || browser.run("return getComputedStyle(document.body.parentElement).backgroundColor");
    let by_system = ground();
    browser.click("#theme");
    assert_eq!((browser.text("#theme"), ground()), ("light".into(), by_system.clone()));
    browser.press("t");
    assert_eq!(browser.text("#theme"), "dark");
    assert_ne!(ground(), by_system);
}

/// `[spec: TRACE-5]`
#[test]
fn law_focus_is_seen_and_reaches_everything() {
    let Some(browser) = Browser::opened(&page(&made::alone(made::every_kind())).unwrap(), "#t=1&s=5") else {
        return;
    };
    let focused = "const at = document.activeElement; const style = getComputedStyle(at);
        return [at.id || at.className || at.tagName, style.outlineStyle, parseFloat(style.outlineWidth), at.ariaLabel || at.textContent.trim().slice(0, 30)]";
    let mut reached = BTreeSet::new();
    for _ in 0..40 {
        browser.press("Tab");
        let found = browser.run(focused);
        let which = found[0].as_str().unwrap().to_owned();
        if which == "BODY" {
            break;
        }
        assert_ne!(found[1], "none", "{found}");
        assert!(found[2].as_f64().unwrap() >= 2.0, "{found}");
        assert_ne!(found[3], "", "it has a name: {found}");
        reached.insert(which);
    }
    for control in [
        "first",
        "previous",
        "play",
        "next",
        "last",
        "slider",
        "differences",
        "theme",
        "help-button",
        "course-row",
        "drawing-scroll",
    ] {
        assert!(reached.iter().any(|which| which.starts_with(control)), "{control} of {reached:?}");
    }
}
