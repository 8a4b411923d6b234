//! Drawings: one self-contained SVG, without scripts and without fonts from elsewhere.
//!
//! Replicas are lines from top to bottom, steps are shapes on them, and arrows lead from the step that sent a
//! message to the step that received it; the titles of arrows have their words in full. An answer is dashed, what is lost ends in a cross. Shapes carry the meaning, colours repeat it; both
//! follow the reader's light or dark scheme. What changes in a view is written beside a step and is its title.

mod shapes;
mod style;

use super::diagram::{Arrow, Diagram, Event, Row};
use super::words::{add, one_line, wrap};
use crate::trace::FindingKind;
use shapes::{cut, escape, shape, text, verdict};
use style::STYLE;

/// The height of a line of text, in pixels, as all that follow.
const LINE: usize = 18;
/// Where the first step stands.
const TOP: usize = 88;
/// Where the lanes begin.
const LEFT: usize = 40;
/// The width of a letter, at most.
const LETTER: usize = 8;
/// Characters on a line beside the lanes.
const TEXT_WIDTH: usize = 76;
/// Characters of a name at the head of a lane.
const NAME_MAX: usize = 24;

/// The drawing of a trace.
pub(super) fn svg(diagram: &Diagram<'_>) -> String {
    let page = Page::of(diagram);
    let (width, height) = (page.text_x() + TEXT_WIDTH * LETTER + 24, page.height());
    let title = escape(&diagram.headline());
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" role=\"img\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n\
         <defs><marker id=\"tip\" viewBox=\"0 0 10 10\" refX=\"18\" refY=\"5\" markerWidth=\"10\" \
         markerHeight=\"10\" markerUnits=\"userSpaceOnUse\" orient=\"auto\">\
         <path class=\"tip\" d=\"M0 0L10 5L0 10z\"/></marker></defs>\n\
         <rect class=\"back\" width=\"{width}\" height=\"{height}\"/>\n"
    );
    let headline = wrap(&diagram.headline(), width / LETTER - 4, 0);
    svg += &text(16, 26, "head", headline.first().map_or("", String::as_str));
    svg += &page.lanes();
    for row in 0..diagram.rows.len() {
        svg += &page.arrow(row);
    }
    for row in 0..diagram.rows.len() {
        svg += &page.step(row);
    }
    svg += &page.finding();
    svg += &page.legend();
    svg + "</svg>\n"
}

/// Where everything stands.
struct Page<'d> {
    diagram: &'d Diagram<'d>,
    pitch: usize,
    /// By row, and last for the breach: its height above the first line, and its lines.
    rows: Vec<(usize, Vec<String>)>,
    bottom: usize,
}

impl<'d> Page<'d> {
    fn of(diagram: &'d Diagram<'d>) -> Self {
        let longest = diagram.lanes.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        let texts = diagram.rows.iter().map(|row| {
            let mut lines = wrap(&diagram.words(row), TEXT_WIDTH, 4);
            let changes = row.changes.iter().flat_map(|change| wrap(change, TEXT_WIDTH - 2, 2));
            lines.extend(changes.map(|line| format!("  {line}")));
            lines
        });
        let mut bottom = TOP;
        let mut rows = Vec::new();
        for lines in texts.chain([wrap(&diagram.finding(), TEXT_WIDTH, 4)]) {
            let top = bottom;
            bottom += lines.len() * LINE + 16;
            rows.push((top, lines));
        }
        Self { diagram, pitch: 96.max((longest.min(NAME_MAX) + 2) * LETTER), rows, bottom }
    }

    fn x(&self, lane: usize) -> usize {
        LEFT + self.pitch / 2 + lane * self.pitch
    }

    fn y(&self, row: usize) -> usize {
        self.rows[row].0
    }

    fn text_x(&self) -> usize {
        LEFT + self.diagram.lanes.len() * self.pitch
    }

    fn height(&self) -> usize {
        self.bottom + 44
    }

    fn lanes(&self) -> String {
        let mut svg = String::new();
        for (lane, name) in self.diagram.lanes.iter().enumerate() {
            let (x, name) = (self.x(lane), one_line(name));
            add(
                &mut svg,
                format_args!(
                    "<g><title>{}</title><line class=\"lane\" x1=\"{x}\" y1=\"{}\" x2=\"{x}\" y2=\"{}\"/>\
                 <text class=\"head\" x=\"{x}\" y=\"{}\" text-anchor=\"middle\">{}</text></g>\n",
                    escape(&name),
                    TOP - 22,
                    self.bottom,
                    TOP - 30,
                    escape(&cut(&name, NAME_MAX))
                ),
            );
        }
        svg
    }

    /// The arrow that ends in a row.
    fn arrow(&self, at: usize) -> String {
        let row = &self.diagram.rows[at];
        let (from, start_y, label, class) = match row.event {
            Event::Delivery(Arrow { message, sent, from, is_answer }) => {
                (from, self.y(sent), message, if is_answer { "arrow dashed" } else { "arrow" })
            }
            Event::Loss(Arrow { message, sent, from, .. }) => (from, self.y(sent), message, "arrow lost"),
            _ => return String::new(),
        };
        let (path, label_x, label_y) = self.path((from, start_y), (row.lane, self.y(at)));
        let tip = if matches!(row.event, Event::Loss(_)) { "" } else { " marker-end=\"url(#tip)\"" };
        let words = format!("step {}: {}", at + 1, self.diagram.words(row));
        let label = escape(&cut(label, self.pitch / LETTER - 4));
        // First wide in the colour of the ground, so that nothing runs through the letters.
        let labels = ["halo", "label"].map(|class| {
            format!("<text class=\"{class}\" x=\"{label_x}\" y=\"{label_y}\" text-anchor=\"middle\">{label}</text>")
        });
        format!(
            "<g><title>{}</title><path class=\"{class}\" d=\"{path}\"{tip}/>{}</g>\n",
            escape(&words),
            if label.is_empty() { String::new() } else { labels.concat() }
        )
    }

    /// A path from a lane's line at one height to another's at another, and where its label stands. Lanes between
    /// them are crossed in the sender's row, where they have no step.
    fn path(&self, (from, y1): (usize, usize), (to, y2): (usize, usize)) -> (String, usize, usize) {
        let (x1, x2) = (self.x(from), self.x(to));
        let past_lane = self.pitch - 20;
        let x = match from.abs_diff(to) {
            0 => {
                let path = format!("M{x1} {y1}h24q12 0 12 12V{}q0 12 -12 12H{x1}", y2.saturating_sub(12));
                return (path, x1 + 36, y1.midpoint(y2) + 4);
            }
            1 => x1,
            _ if from < to => x2 - past_lane,
            _ => x2 + past_lane,
        };
        (format!("M{x1} {y1}H{x}L{x2} {y2}"), (x + 2 * x2) / 3, (y1 + 2 * y2) / 3 + 4)
    }

    /// A step's shape and its texts.
    fn step(&self, at: usize) -> String {
        let row = &self.diagram.rows[at];
        let (x, y) = (self.x(row.lane), self.y(at));
        let mut svg =
            format!("<g><title>{}</title>{}", escape(&self.title(at, row)), shape(&row.event, x, y));
        if at + 1 == self.diagram.rows.len() {
            add(&mut svg, format_args!("<circle class=\"ring\" cx=\"{x}\" cy=\"{y}\" r=\"13\"/>"));
        }
        svg += &text(16, y + 5, "small", &(at + 1).to_string());
        for (line, words) in self.rows[at].1.iter().enumerate() {
            let class = if words.starts_with("  ") { "small" } else { "says" };
            svg += &text(self.text_x(), y + 5 + line * LINE, class, words);
        }
        svg + "</g>\n"
    }

    fn title(&self, at: usize, row: &Row<'_>) -> String {
        let head = format!("step {}, {}: {}", at + 1, self.diagram.lanes[row.lane], self.diagram.words(row));
        let lines = [head].into_iter().chain(row.changes.iter().cloned());
        lines.map(|line| one_line(&line)).collect::<Vec<_>>().join("\n")
    }

    fn finding(&self) -> String {
        let at = self.diagram.rows.len();
        let (x, y) = (self.x(self.diagram.last_lane()), self.y(at));
        let mut svg = format!(
            "<g><title>{}</title>{}",
            escape(&self.diagram.finding()),
            verdict(self.diagram.trace.finding.kind, x, y)
        );
        for (line, words) in self.rows[at].1.iter().enumerate() {
            svg += &text(self.text_x(), y + 5 + line * LINE, "breach", words);
        }
        svg + "</g>\n"
    }

    fn legend(&self) -> String {
        let y = self.bottom + 24;
        let arrow = Arrow { message: "", sent: 0, from: 0, is_answer: false };
        let entries = [
            (Event::Mutation { text: "", sends: &[] }, "mutates"),
            (Event::Delivery(arrow), "receives"),
            (Event::Loss(arrow), "never receives"),
            (Event::Restart { keeps: false }, "restarts"),
            (Event::Answer { to: 0, sends: &[] }, "answers"),
            (Event::Other { text: "" }, "else"),
        ];
        let mut svg = String::new();
        let mut x = 24;
        for (event, words) in entries {
            svg += &shape(&event, x, y);
            svg += &text(x + 14, y + 5, "small", words);
            x += 44 + words.len() * LETTER;
        }
        svg + &verdict(FindingKind::Broken, x, y) + &text(x + 16, y + 5, "small", "a clause breaks") + "\n"
    }
}
