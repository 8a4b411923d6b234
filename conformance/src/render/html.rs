//! A page: implementations × families × clauses, and each case below. It is one file, runs no script and asks for nothing.

use super::diagram::diagram;
use super::escape::markup;
use super::tally::{Named, Tally, clauses, families};
use crate::case::Case;
use crate::log::CaseLine;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fmt::Write;

const STYLE: &str = include_str!("page.css");

/// The page.
pub fn html(logs: &[Named], cases: &[Case]) -> String {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
         content=\"width=device-width\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src '{}'\">\n<title>Conformance</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n\
         <h1>Conformance</h1>\n",
        policy_hash()
    );
    for Named { name, log } in logs {
        let header = &log.header;
        let incomplete = log.incomplete.as_ref();
        let why =
            incomplete.map(|why| format!(" <strong class=\"bad\">incomplete: {}</strong>", markup(why)));
        let _ = writeln!(
            page,
            "<p><b><bdi>{}</bdi></b>: {}; protocol {}, corpus {}, specification {}; profiles {}.{}</p>",
            markup(name),
            Tally::of(&log.cases).text(),
            header.protocol,
            markup(&header.corpus),
            markup(&header.spec),
            markup(&header.profiles.join(", ")),
            why.unwrap_or_default()
        );
    }
    page +=
        "<p><label><input type=\"checkbox\" id=\"only\"> only what does not pass everywhere</label></p>\n";
    matrix(&mut page, logs);
    let mut ids = BTreeSet::new();
    page += "<h2>Cases</h2>\n";
    for line in logs.iter().flat_map(|named| &named.log.cases) {
        if ids.insert(&line.id) {
            one(&mut page, &line.id, logs, cases.iter().find(|case| case.id == line.id));
        }
    }
    page + "</main>\n</body>\n</html>\n"
}

/// By what the page's policy knows its own style: nothing else is taken.
fn policy_hash() -> String {
    format!("sha256-{}", STANDARD.encode(Sha256::digest(format!("\n{STYLE}"))))
}

fn matrix(page: &mut String, logs: &[Named]) {
    page.push_str("<table>\n<thead><tr><th scope=\"col\">family, clause</th>");
    for named in logs {
        let _ = write!(page, "<th scope=\"col\"><bdi>{}</bdi></th>", markup(&named.name));
    }
    page.push_str("</tr></thead>\n");
    let all = || logs.iter().flat_map(|named| &named.log.cases);
    for family in families(all()) {
        page.push_str("<tbody>\n");
        row(page, "family", &markup(&family), logs, &|case| case.family() == family);
        for clause in clauses(all().filter(|case| case.family() == family)) {
            let is_in = |case: &CaseLine| case.family() == family && case.clauses.contains(&clause);
            let first = all()
                .find(|case| is_in(case) && case.verdict.is_bad())
                .or_else(|| all().find(|case| is_in(case)));
            let anchor = first.map(|case| anchor(&case.id)).unwrap_or_default();
            let label = format!("<a href=\"#{anchor}\">{}</a>", markup(&clause));
            row(page, "clause", &label, logs, &is_in);
        }
        page.push_str("</tbody>\n");
    }
    page.push_str("</table>\n");
}

fn row(page: &mut String, kind: &str, label: &str, logs: &[Named], is_in: &dyn Fn(&CaseLine) -> bool) {
    let tallies: Vec<Tally> =
        logs.iter().map(|named| Tally::of(named.log.cases.iter().filter(|case| is_in(case)))).collect();
    let fine = if tallies.iter().all(|tally| (tally.bad, tally.excused, tally.left_out) == (0, 0, 0)) {
        " fine"
    } else {
        ""
    };
    let _ = write!(page, "<tr class=\"{kind}{fine}\"><th scope=\"row\">{label}</th>");
    for tally in tallies {
        let class = match tally {
            Tally { bad: 1.., .. } => "bad",
            Tally { excused: 1.., .. } => "excused",
            Tally { passed: 1.., .. } => "pass",
            Tally { .. } => "out",
        };
        let _ = write!(page, "<td class=\"{class}\">{}</td>", tally.text());
    }
    page.push_str("</tr>\n");
}

fn one(page: &mut String, id: &str, logs: &[Named], case: Option<&Case>) {
    let lines: Vec<(&str, &CaseLine)> = logs
        .iter()
        .filter_map(|named| Some((named.name.as_str(), named.log.cases.iter().find(|case| case.id == id)?)))
        .collect();
    let is_fine = lines.iter().all(|(_, line)| line.verdict == crate::report::Verdict::Pass);
    let verdicts: BTreeSet<&str> = lines.iter().map(|(_, line)| line.verdict.name()).collect();
    let class = if is_fine { "fine" } else { "notable" };
    let _ = writeln!(
        page,
        "<details class=\"{class}\" id=\"{}\"><summary><code>{}</code> {}</summary>",
        anchor(id),
        markup(id),
        markup(&verdicts.into_iter().collect::<Vec<_>>().join(", "))
    );
    let step = lines.iter().find_map(|(_, line)| line.step);
    if let Some(case) = case {
        let (title, why) = (markup(&case.title), markup(&case.why));
        let clauses = markup(&case.spec.join(", "));
        let _ = writeln!(
            page,
            "<p><b>{title}</b> [{clauses}]. {why}</p>\n<pre>{}</pre>",
            markup(&diagram(case, step))
        );
    }
    for (name, line) in lines.into_iter().filter(|(_, line)| line.verdict != crate::report::Verdict::Pass) {
        let at = line.step.map(|step| format!(", step {step}")).unwrap_or_default();
        let verdict = line.verdict.name();
        let _ =
            writeln!(page, "<p><b><bdi>{}</bdi></b>: <b class=\"bad\">{verdict}</b>{at}</p>", markup(name));
        let mut body = markup(&line.detail);
        body.extend(line.expected.iter().map(|row| format!("\n<del>- expected {}</del>", markup(row))));
        body.extend(line.got.iter().map(|row| format!("\n<ins>+ got      {}</ins>", markup(row))));
        let _ = writeln!(page, "<pre>{body}</pre>");
        if let Some(excuse) = &line.excuse {
            let _ = writeln!(page, "<p>Expected: {}</p>", markup(excuse));
        }
    }
    page.push_str("</details>\n");
}

/// An id as the name of a place in the page: only what needs no escaping.
fn anchor(id: &str) -> String {
    let mut name = String::from("case");
    for byte in id.bytes() {
        if byte.is_ascii_alphanumeric() || byte == b'-' {
            name.push(char::from(byte));
        } else {
            let _ = write!(name, "_{byte:02x}");
        }
    }
    name
}
