//! What a page does in a browser. Without one, these tests say so and pass; with `DSR_BROWSER=required` they fail then.

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
use serde_json::Value;
use std::collections::BTreeSet;

/// `[spec: TRACE-5]`
#[test]
fn law_a_page_opens_silently_and_asks_for_nothing() {
    let Some(browser) = Browser::start(1400, 900) else { return };
    for (content, fragment) in [
        (made::gallery(), ""),
        (made::gallery(), "#row=22&s=5"),
        (made::check(), ""),
        (made::check(), "#t=1&s=4"),
    ] {
        let url = browser.open(&page(&content).unwrap(), fragment);
        browser.press("?");
        browser.press("Escape");
        assert_eq!(browser.console(), Vec::<String>::new(), "{fragment}");
        let requests: BTreeSet<String> = browser.requests().into_iter().collect();
        let own = |asked: &String| asked.split('#').next() == Some(&*url) || asked == "about:blank";
        assert!(requests.iter().all(own), "{requests:?}");
        assert!(!requests.is_empty(), "requests are seen at all");
    }
}

/// `[spec: TRACE-5]`
#[test]
fn canary_errors_and_requests_are_seen_and_stopped() {
    let Some(browser) = Browser::opened(&page(&made::check()).unwrap(), "") else { return };
    browser.run("console.error('so it is heard')");
    assert!(browser.console().iter().any(|line| line.contains("so it is heard")));
    browser.run("fetch('http://127.0.0.1:9/').catch(() => {})");
    assert!(browser.console().iter().any(|line| line.contains("Content Security Policy")), "it may not load");
    let foreign = "const node = document.createElement('script'); node.textContent = 'document.title = \"owned\"'; \
        document.body.append(node); return document.title";
    assert_eq!(browser.run(foreign), "What the check found", "a script from elsewhere does not run");
    let spoiled =
        page(&made::check()).unwrap().replace("navigate();\n})();", "navigate(); navigate();\n})();");
    browser.open(&spoiled, "");
    assert_eq!(browser.run("return document.querySelectorAll('main *').length"), 0, "nor does a spoiled one");
}

/// `[spec: TRACE-5]`
#[test]
fn law_slider_buttons_keys_and_links_step() {
    let Some(browser) = Browser::opened(&page(&made::alone(made::every_kind())).unwrap(), "") else { return };
    assert_eq!(browser.step(), 0, "a page of one trace opens it");
    for (key, expected) in [
        ("ArrowRight", 1),
        ("ArrowRight", 2),
        ("ArrowLeft", 1),
        ("End", 11),
        ("ArrowRight", 11),
        ("Home", 0),
        ("ArrowLeft", 0),
    ] {
        browser.press(key);
        assert_eq!(browser.step(), expected, "{key}");
    }
    for (button, expected) in [("#next", 1), ("#last", 11), ("#previous", 10), ("#first", 0)] {
        browser.click(button);
        assert_eq!(browser.step(), expected, "{button}");
        assert_eq!(browser.hash(), format!("#t=1&s={expected}"));
    }
    browser.click("#slider");
    let clicked = browser.step();
    assert!((4..=7).contains(&clicked), "the middle of the slider is step {clicked}");
    browser.press("ArrowRight");
    assert_eq!(browser.step(), clicked + 1, "one key, one step, also on the slider");
    browser.click(".course-rows li:nth-child(4) a");
    assert_eq!(browser.step(), 3);
    assert!(browser.text("#live").starts_with("Step 3 of 11. agent 2 changes the robot"));
    assert_eq!(browser.text("[aria-current=step] .number"), "3");
    browser.press("Home");
    browser.press("p");
    std::thread::sleep(std::time::Duration::from_millis(1600));
    assert_eq!(browser.step(), 1, "play");
    browser.press("p");
    std::thread::sleep(std::time::Duration::from_millis(1600));
    assert_eq!(browser.step(), 1, "pause");
    assert_eq!(browser.console(), Vec::<String>::new());
}

/// `[spec: TRACE-5]`
#[test]
fn law_a_fragment_opens_what_it_names() {
    let Some(browser) = Browser::opened(&page(&made::gallery()).unwrap(), "#row=22&as=checked&s=3") else {
        return;
    };
    assert!(browser.text("h1").starts_with("22. "));
    assert_eq!(browser.step(), 3);
    assert_eq!(browser.text(".sides [aria-current]"), "checked");
    browser.press("o");
    browser.settle();
    assert_eq!(browser.text(".sides [aria-current]"), "published");
    assert_eq!(browser.hash(), "#row=22&as=published&s=3");
    browser.go("#row=1b&s=2");
    assert!(browser.text("h1").starts_with("1b. "));
    browser.run("history.back(); return new Promise((done) => setTimeout(done, 300))");
    assert!(browser.text("h1").starts_with("22. "), "back goes to the trace before");
    browser.go("#row=none&s=2");
    assert!(browser.text(".notice").contains("#row=none"));
    browser.go("#row=22&s=999");
    assert_eq!(browser.step(), 6, "no step beyond the last");
    browser.press("Escape");
    browser.settle();
    assert_eq!(browser.text("h1"), "Gallery");
    browser.click("tbody tr:nth-child(3) a");
    assert!(browser.text("h1").starts_with("2. "), "a row of the table opens");
    browser.press("j");
    browser.settle();
    assert_eq!(browser.hash(), "#row=2&as=checked&s=0");
    assert_eq!(browser.console(), Vec::<String>::new());
}

/// `[spec: TRACE-5]`
#[test]
fn law_the_filter_leaves_rows_with_the_words() {
    let Some(browser) = Browser::opened(&page(&made::gallery()).unwrap(), "") else { return };
    browser.press("/");
    for letter in "joiner".chars() {
        browser.press(&letter.to_string());
    }
    let shown =
        "return [...document.querySelectorAll('tbody tr:not([hidden])')].map((row) => row.textContent)";
    let rows = browser.run(shown);
    let rows: Vec<&str> = rows.as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert!(!rows.is_empty() && rows.len() < 38 && rows.iter().all(|row| row.contains("joiner")), "{rows:?}");
}
