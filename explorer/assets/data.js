// What the page shows, as it was written into it.

const CONTENT = JSON.parse(document.getElementById("data").textContent);
const TRACES = CONTENT.traces;

// Runs tell their properties by position, and steps leave out what they have none of.
for (const run of CONTENT.report?.runs ?? []) run.properties = run.properties.map((at) => CONTENT.report.properties[at]);
for (const step of TRACES.flatMap((trace) => trace.steps)) {
  step.changes ??= [];
  step.remarks ??= [];
}

// The fragment of a step. A row of the gallery is named by its number, any other trace by its place.
function fragment(at, step) {
  const { row, side } = TRACES[at];
  const words = new URLSearchParams(row === undefined ? { t: at + 1 } : { row, as: side });
  words.set("s", step);
  return `#${words}`;
}

// Where a fragment leads: to a trace and a step, to the overview, or nowhere.
function destination(hash) {
  const words = new URLSearchParams(hash.slice(1));
  const row = words.get("row");
  let at;
  if (row !== null) {
    const side = words.get("as");
    at = TRACES.findIndex((trace) => trace.row === row && (side === null || trace.side === side));
  } else if (words.has("t")) {
    at = TRACES[Number(words.get("t")) - 1] ? Number(words.get("t")) - 1 : -1;
  } else {
    return isAlone() ? { at: 0, step: 0 } : { at: null };
  }
  if (at < 0) return { at: null, unknown: hash };
  const step = Math.trunc(Number(words.get("s") ?? 0)) || 0;
  return { at, step: Math.min(Math.max(step, 0), TRACES[at].steps.length) };
}

// A page of one trace has no overview.
function isAlone() {
  return TRACES.length === 1 && !CONTENT.report && !CONTENT.gallery;
}
