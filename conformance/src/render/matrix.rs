//! Which implementation keeps what: one page of Markdown, with the shortest failing case behind each cell. `[spec: CONF-16]`

use super::diagram::diagram;
use super::escape::{fenced, markdown as plain};
use super::tally::{Named, Tally, clauses, families};
use crate::case::{Case, Step};
use crate::log::CaseLine;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// What every view keeps, whatever a case is about, in words; then that replicas end equal.
const KEPT: [(&str, &str); 7] = [
    ("INV-1", "every vertex has a path to the root"),
    ("INV-2", "no edge dangles"),
    ("INV-3", "the kinematic edges are one tree"),
    ("INV-4", "no edge joins a vertex to itself"),
    ("INV-5", "attributes are as declared"),
    ("INV-6", "one edge in each register"),
    ("JOIN-5", "who has heard the same shows the same"),
];

/// A table of what every view keeps, one by family, one by clause; then the shortest failing cases that these name.
pub fn matrix(logs: &[Named], cases: &[Case]) -> String {
    let page = Page { logs, cases: cases.iter().map(|case| (case.id.as_str(), case)).collect() };
    let mut text = String::new();
    let mut shown = BTreeSet::new();
    let names: Vec<String> = logs.iter().map(|named| plain(&named.name)).collect();
    let head = |text: &mut String, what: &str| {
        let _ = writeln!(text, "| {what} | {} |\n|---|{}", names.join(" | "), "---|".repeat(logs.len()));
    };
    head(&mut text, "in every view");
    for (clause, what) in KEPT {
        let cells = page.cells(
            &mut shown,
            |line| page.breaks(line, clause),
            |_, bad| match bad {
                0 => "kept".into(),
                1 => "broken in 1 case".into(),
                bad => format!("broken in {bad} cases"),
            },
        );
        let _ = writeln!(text, "| {what} ({clause}) | {cells} |");
    }
    let all = || logs.iter().flat_map(|named| &named.log.cases);
    text.push('\n');
    head(&mut text, "family");
    for family in families(all()) {
        page.row(&mut text, &mut shown, &family, |line| line.family() == family);
    }
    text.push('\n');
    head(&mut text, "clause");
    for clause in clauses(all()) {
        page.row(&mut text, &mut shown, &clause, |line| line.clauses.contains(&clause));
    }
    text.push_str("\n## The shortest failing cases\n");
    for (at, id) in shown {
        page.failure(&mut text, at, &id);
    }
    text
}

struct Page<'p> {
    logs: &'p [Named],
    cases: BTreeMap<&'p str, &'p Case>,
}

impl Page<'_> {
    /// Whether a failure is one of this clause, whatever its case is about.
    fn breaks(&self, line: &CaseLine, clause: &str) -> bool {
        if let Some(broken) = &line.broken {
            return broken == clause;
        }
        let step = || {
            let at = line.step?.checked_sub(1)?;
            self.cases.get(line.id.as_str())?.steps.get(at)
        };
        clause == "JOIN-5" && line.verdict.is_bad() && matches!(step(), Some(Step::ExpectEqual { .. }))
    }

    fn row(
        &self,
        text: &mut String,
        shown: &mut BTreeSet<(usize, String)>,
        name: &str,
        is_in: impl Fn(&CaseLine) -> bool,
    ) {
        let cells = self.cells(shown, is_in, |tally, _| tally.text());
        let _ = writeln!(text, "| {} | {cells} |", plain(name));
    }

    /// A cell for each log, a link to its shortest failing case if there is one.
    fn cells(
        &self,
        shown: &mut BTreeSet<(usize, String)>,
        is_in: impl Fn(&CaseLine) -> bool,
        text: impl Fn(Tally, usize) -> String,
    ) -> String {
        let cells = self.logs.iter().enumerate().map(|(at, named)| {
            let lines: Vec<_> = named.log.cases.iter().filter(|line| is_in(line)).collect();
            let bad: Vec<_> = lines.iter().copied().filter(|line| line.verdict.is_bad()).collect();
            let cell = text(Tally::of(lines), bad.len());
            let Some(shortest) = bad.iter().min_by_key(|line| (self.steps(line), &line.id)) else {
                return cell;
            };
            shown.insert((at, shortest.id.clone()));
            format!("[**{cell}**](#{})", self.anchor(at, &shortest.id))
        });
        cells.collect::<Vec<_>>().join(" | ")
    }

    fn steps(&self, line: &CaseLine) -> usize {
        self.cases.get(line.id.as_str()).map_or(usize::MAX, |case| case.steps.len())
    }

    fn anchor(&self, at: usize, id: &str) -> String {
        let is_plain = |character: char| character.is_ascii_alphanumeric() || character == '-';
        let text = format!("{}-{}-{id}", at + 1, self.logs[at].name).to_lowercase();
        text.chars().map(|character| if is_plain(character) { character } else { '-' }).collect()
    }

    fn failure(&self, text: &mut String, at: usize, id: &str) {
        let named = &self.logs[at];
        let Some(line) = named.log.cases.iter().find(|line| line.id == id) else { return };
        let _ = writeln!(
            text,
            "\n<a id=\"{}\"></a>\n\n### {}: {}\n",
            self.anchor(at, id),
            plain(&named.name),
            plain(id)
        );
        if let Some(excuse) = &line.excuse {
            let _ = writeln!(text, "{}\n", plain(excuse));
        }
        let case = self.cases.get(id);
        let mut body =
            case.map(|case| format!("{}\n{}\n", case.title, diagram(case, line.step))).unwrap_or_default();
        body += &line.detail;
        body.extend(line.expected.iter().map(|row| format!("\n- expected {row}")));
        body.extend(line.got.iter().map(|row| format!("\n+ got      {row}")));
        *text += &fenced(&body);
    }
}
