// What was checked and what came of it: tables of a report, of a gallery, of traces.

const VERDICT_WORDS = {
  exhaustive: "Every state within the bound was judged, and all is well.",
  bounded: "All is well as far as the runs went; they stopped before their bound.",
  vacuous: "Complete, but something that had to be seen never occurred: the check proves nothing.",
  violated: "A clause does not hold.",
};

function overview(notice) {
  const node = html("article", { class: "overview" }, html("h1", { tabindex: -1 }, name(CONTENT.title)),
    notice && html("p", { class: "notice", role: "status" }, notice));
  const { report, gallery } = CONTENT;
  if (report) node.append(verdictBlock(report));
  if (tables() > 0) node.append(filterBox(node));
  if (gallery) node.append(galleryTable(gallery));
  else node.append(traceTable("Traces", (trace) => !report || trace.finding.kind !== "seen"));
  if (report) node.append(...examples(report));
  if (report) {
    const seen = traceTable("What was seen, step by step", (trace) => trace.finding.kind === "seen");
    node.append(clauseTable(report.runs), runTable(report.runs), witnessTable(report.runs), seen, notes(report));
  }
  return node;
}

function tables() {
  return TRACES.length + (CONTENT.report?.runs.length ?? 0) + (CONTENT.gallery?.rows.length ?? 0);
}

function verdictBlock({ verdict, runs, seconds }) {
  const sum = (count) => runs.reduce((sum, run) => sum + count(run), 0);
  const twice = runs.filter((run) => run.second_engine).length;
  const facts = [
    plural(runs.length, "run"), `${number(sum((run) => run.states.unique))} states`,
    `${number(sum((run) => run.states.judged))} replica states judged`,
    seconds !== undefined && `${seconds.toFixed(1)} s`,
    twice > 0 && `two engines agree on the counts of ${plural(twice, "run")}`,
  ];
  return html("section", { class: "verdict-block", "data-verdict": verdict },
    html("p", { class: "verdict-big" }, verdictWord(verdict)),
    html("p", null, VERDICT_WORDS[verdict] ?? ""),
    html("p", { class: "origin" }, facts.filter(Boolean).map((fact) => html("span", null, fact))));
}

function traceTable(title, isListed) {
  const listed = TRACES.map((trace, at) => ({ trace, at })).filter(({ trace }) => isListed(trace));
  const rows = listed.map(({ trace, at }) => [
    html("a", { href: fragment(at, 0) }, name(trace.title)), findingWord(trace.finding), name(trace.finding.clause),
    name(trace.layer), number(trace.steps.length), number(trace.replicas.length),
  ]);
  return rows.length === 0 ? "" : table(title, ["Trace", "Finding", "Clause", "Layer", "#Steps", "#Replicas"], rows);
}

// Counterexamples that are no runs, as the checker prints them.
function examples({ examples }) {
  return (examples ?? []).map(({ layer, run, clause, text }) => html("section", { class: "example" },
    html("h2", null, name(layer), ", ", name(run), ": a way to break ", name(clause)), html("pre", { tabindex: 0 }, text)));
}

function findingWord(finding) {
  return html("span", { class: "verdict", "data-kind": finding.kind }, html("span", { "aria-hidden": "true" }, `${SIGNS[finding.kind]} `), finding.kind);
}

function galleryTable({ rows }) {
  const lines = rows.map((row) => {
    const sides = TRACES.map((trace, at) => ({ trace, at })).filter(({ trace }) => trace.row === row.row);
    const title = name(row.title);
    const links = sides.map(({ trace, at }, place) => [place > 0 && " ", html("a", { href: fragment(at, 0), class: "nowrap", "aria-label": `row ${row.row}, ${trace.side}` }, trace.side)]);
    const control = row.control;
    const holds = row.checked === "holds";
    return [
      name(row.row), sides.length > 0 ? html("a", { href: fragment(sides[0].at, 0) }, title) : title,
      row.clause && html("span", { class: "nowrap" }, name(cut(row.clause, 24))), number(row.steps), number(row.states),
      control && [control.found ? "✗ found as well where " : "✓ not where ", name(control.what)],
      row.checked && html("span", { class: "verdict", "data-kind": holds ? "holds" : "broken" }, `${holds ? "✓" : "✗"} `, name(row.checked)),
      html("span", { class: "nowrap" }, links),
    ];
  });
  return table(plural(rows.length, "row"), ["#Row", "What goes wrong", "Clause", "#Steps", "#States", "Control", "Checked semantics", "Runs"], lines);
}

// All runs together, clause by clause, the worst first; what holds in a scenario is that scenario's own.
function clauseTable(runs) {
  const order = Object.keys(VERDICT_WORDS);
  const clauses = new Map();
  for (const run of runs) {
    for (const property of run.properties.filter((property) => property.kind === "always")) {
      const group = run.layer === "scenario" ? run.name : "";
      const key = JSON.stringify([group, property.clause]);
      const line = clauses.get(key) ?? { group, clause: property.clause, claim: "", what: property.what, verdict: 0, runs: 0, judged: 0, layers: new Set() };
      clauses.set(key, line);
      line.verdict = Math.max(line.verdict, order.indexOf(property.verdict));
      line.runs += 1;
      line.judged += run.states.judged;
      line.claim ||= property.claim;
      line.layers.add(run.layer);
    }
  }
  const sorted = [...clauses.values()].sort((one, other) => other.verdict - one.verdict || compare(one.group, other.group) || compare(one.clause, other.clause));
  const rows = sorted.map((line) => {
    const traces = TRACES.map((trace, at) => ({ trace, at })).filter(({ trace }) => ["broken", "fails"].includes(trace.finding.kind)
      && trace.finding.clause === line.clause && (line.group === "" ? trace.layer !== "scenario" : trace.run === line.group));
    return [
      name(line.claim), [line.group && html("span", { class: "group" }, name(line.group), " "), name(line.clause)],
      [name(line.what), traces.map(({ at }, place) => [" ", html("a", { href: fragment(at, 0) }, place === 0 ? "counterexample" : "another")])],
      verdictWord(order[line.verdict]), number(line.runs), number(line.judged), html("span", { class: "nowrap" }, [...line.layers].join(", ")),
    ];
  });
  return table("What must always hold", ["Claim", "Clause", "What", "Verdict", "#Runs", "#States", "Layers"], rows);
}

const { compare } = new Intl.Collator("en", { numeric: true });

function runTable(runs) {
  const rows = runs.map((run) => {
    const remarks = run.verdict === "exhaustive" ? [] : run.notes;
    return [
      name(run.layer), [name(run.name), remarks.map((note) => html("div", { class: "note" }, name(note)))],
      run.replicas > 0 ? `${run.replicas} × ${run.mutations}` : "–", run.focus > 0 ? number(run.focus) : "–", run.operations > 0 ? number(run.operations) : "–",
      number(run.states.unique), number(run.states.generated), number(run.states.judged), run.seconds.toFixed(1),
      run.second_engine ? "2, agree" : "1", verdictWord(run.verdict),
    ];
  });
  return table("Runs", ["Layer", "Run", "#Replicas × mutations", "#Focus", "#Operations", "#States", "#Generated", "#Judged", "#s", "Engines", "Verdict"], rows);
}

function witnessTable(runs) {
  const seen = new Map();
  for (const run of runs) {
    for (const property of run.properties.filter((property) => property.kind === "sometimes")) {
      const counts = seen.get(property.clause) ?? { what: property.what, seen: 0, asked: 0 };
      seen.set(property.clause, counts);
      counts.seen += property.verdict === "exhaustive" ? 1 : 0;
      counts.asked += 1;
    }
  }
  const shown = TRACES.map((trace, at) => ({ trace, at })).filter(({ trace }) => trace.finding.kind === "seen");
  const links = (clause) => shown.filter(({ trace }) => trace.finding.clause === clause)
    .map(({ at }, place) => [" ", html("a", { href: fragment(at, 0) }, place === 0 ? "how" : "another")]);
  const rows = [...seen].sort(([one], [other]) => compare(one, other)).map(([clause, { what, seen, asked }]) => [
    name(clause), [name(what), links(clause)], html("span", { class: "verdict", "data-verdict": seen > 0 ? "exhaustive" : "vacuous" }, seen > 0 ? "◉ seen" : "○ never seen"), `${seen} of ${asked}`,
  ]);
  return rows.length > 0 ? table("What had to be seen somewhere", ["Witness", "What", "Seen", "#In runs"], rows) : "";
}

function notes({ assumed, not_checked: unchecked }) {
  const list = (title, lines) => lines?.length > 0 && html("section", null, html("h2", null, title), html("ul", null, lines.map((line) => html("li", null, name(line)))));
  return html("div", { class: "notes" }, list("Assumed", assumed), list("Not checked", unchecked));
}
