//! Colours, for light and for dark.

/// The style sheet.
pub(super) const STYLE: &str = "\
text { font: 13px ui-monospace, Menlo, Consolas, monospace; fill: #1b1f24; }
.back { fill: #ffffff; }
.head { font-weight: bold; }
.small, .label { fill: #57606a; }
.halo { stroke: #ffffff; stroke-width: 5; stroke-linejoin: round; }
.lane { stroke: #afb8c1; stroke-width: 2; }
.arrow { stroke: #0550ae; stroke-width: 1.5; fill: none; }
.dashed { stroke-dasharray: 6 4; }
.lost { stroke-dasharray: 2 4; }
.lost-mark { stroke: #57606a; stroke-width: 2.5; stroke-linecap: round; }
.sight { fill: none; stroke: #0550ae; stroke-width: 4; stroke-linecap: round; }
.tip { fill: #0550ae; }
.full { fill: #0550ae; stroke: #0550ae; stroke-width: 2; }
.hollow { fill: #ffffff; stroke: #0550ae; stroke-width: 2; }
.ring { fill: none; stroke: #b3261e; stroke-width: 2; }
.cross { stroke: #b3261e; stroke-width: 4; stroke-linecap: round; }
.breach { fill: #b3261e; }
@media (prefers-color-scheme: dark) {
  text { fill: #e6edf3; }
  .back { fill: #0d1117; }
  .small, .label { fill: #9da7b3; }
  .halo { stroke: #0d1117; }
  .lane { stroke: #4b535d; }
  .arrow, .sight { stroke: #79b8ff; }
  .lost-mark { stroke: #9da7b3; }
  .tip { fill: #79b8ff; }
  .full { fill: #79b8ff; stroke: #79b8ff; }
  .hollow { fill: #0d1117; stroke: #79b8ff; }
  .ring, .cross { stroke: #ff8a80; }
  .breach { fill: #ff8a80; }
}
";
