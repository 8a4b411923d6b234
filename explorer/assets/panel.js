// One replica at one step: its graph, what changed, what is remarked.

function panel(story, layout, step, replica, showsDifferences) {
  const { trace } = story;
  const graphs = story.graphs[step];
  const graph = graphs[replica];
  const acts = step > 0 && trace.steps[step - 1].who === replica;
  const shows = trace.finding.kind !== "holds" && step === trace.steps.length && trace.finding.replicas.includes(trace.replicas[replica]);
  const reference = graphs[0];
  const marks = acts ? story.marks[step] : new Map();
  const compared = showsDifferences && replica > 0;
  const scene = { layout, graph, marks, differences: compared ? differences(reference, graph) : null, reference, names: story.names };
  const changed = acts ? story.remarks[step] : new Map();
  const lines = [...marks].flatMap(([id, change]) => changeLines(id, change, story.names));
  const remarks = [...new Set([...graph.remarks, ...changed.keys()])].sort();
  const others = compared ? remarksMissing(reference, graph) : [];
  const twin = step > 0 && graphs.findIndex((other, at) => at !== replica && other.state !== null && other.state === graph.state) >= 0;
  return html("section", {
    class: `panel${acts ? " acts" : ""}${shows ? " shows" : ""}`, "data-replica": trace.replicas[replica], "aria-label": trace.replicas[replica],
  },
    html("header", null, html("h2", null, name(trace.replicas[replica])),
      acts && html("span", { class: "tag" }, "this step"),
      shows && html("span", { class: "tag found", "data-kind": trace.finding.kind }, `${SIGNS[trace.finding.kind]} shows it`),
      showsDifferences && html("span", { class: "tag differ" }, replica === 0 ? "reference" : differCount(scene.differences, others)),
      graph.state && html("code", { class: "state", title: `hash of the whole state: ${graph.state}` }, twin && "= ", graph.state.slice(0, 6))),
    html("div", { class: "drawing-scroll", tabindex: 0, role: "region", "aria-label": `graph of ${trace.replicas[replica]}` }, drawGraph(scene)),
    remarks.length > 0 && html("ul", { class: "remarks", "aria-label": "remarks" }, remarks.map((remark) => {
      const mark = compared && !reference.remarks.has(remark) ? "differs" : changed.has(remark) ? (changed.get(remark) ? "new" : "gone") : null;
      return html("li", { "data-line": mark }, mark && html("span", { class: "sign", "aria-label": MARK_WORDS[mark] }, `${BADGES[mark]} `), name(remark));
    })),
    others.length > 0 && html("ul", { class: "remarks" }, others.map((remark) => html("li", { "data-line": "differs" }, "≠ without: ", name(remark)))),
    lines.length > 0 && html("ul", { class: "changes", "aria-label": "changes of this step" }, lines.map(([mark, text]) => html("li", { "data-line": mark },
      html("span", { class: "sign", "aria-label": MARK_WORDS[mark] }, BADGES[mark]), name(text)))),
    acts && lines.length === 0 && changed.size === 0 && html("p", { class: "changes none" }, "Nothing that it shows has changed."));
}

function remarksMissing(reference, graph) {
  return [...reference.remarks].filter((remark) => !graph.remarks.has(remark));
}

function differCount(found, others) {
  const count = found.size + others.length;
  return count === 0 ? "= same" : `≠ ${count}`;
}
