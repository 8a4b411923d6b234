// Draws one replica's graph at one step.

// `scene`: the layout, the graph now, what this step marks here, how it differs from the first replica (or null)
// and that replica's graph.
function drawGraph(scene) {
  const { layout } = scene;
  const elements = new Map(scene.graph.elements);
  for (const [id, { mark, before }] of scene.marks) if (mark === "gone") elements.set(id, before);
  for (const [id, how] of scene.differences ?? []) {
    if (how === "missing" && !elements.has(id)) elements.set(id, scene.reference.elements.get(id));
  }
  const ends = new Set();
  const edges = [];
  for (const [id, element] of elements) {
    if (element.is !== "edge") continue;
    if (scene.graph.elements.has(id)) [element.from, element.to].forEach((end) => ends.add(end));
    edges.push(...versions(scene, id, element));
  }
  const boxes = [];
  for (const [id, row] of layout.rows) {
    const element = elements.get(id);
    if (element?.is === "vertex") boxes.push(box(scene, id, element, row));
    else if (ends.has(id)) boxes.push(ghost(id, row));
  }
  if (boxes.length === 0) boxes.push(html("p", { class: "nothing" }, "shows nothing"));
  const trunks = svg("svg", { class: "trunks", "aria-hidden": "true", width: 600, height: layout.height });
  const arcs = svg("svg", { class: "arcs", "aria-hidden": "true", width: layout.width, height: layout.height });
  const labels = [];
  for (const { id, edge, mark } of edges) {
    const key = edgeKey(id, edge);
    if (layout.tree.has(key)) trunks.append(trunk(scene, id, edge, mark));
    const arc = layout.arcs.get(key);
    if (arc === undefined) continue;
    arcs.append(bracket(arc, id, mark));
    labels.push(label(scene, arc, id, edge, mark));
  }
  const drawing = html("div", { class: "drawing", role: "group", "aria-label": "graph", place: { height: layout.height } },
    trunks, boxes, html("div", { class: "lanes", place: { width: layout.width } }, arcs, labels));
  drawing.style.setProperty("--lanes", `${Math.max(layout.width + 2, 14)}px`);
  return drawing;
}

// An edge whose ends have changed in this step is drawn twice, as it was and as it is.
function versions(scene, id, edge) {
  const mark = markOf(scene, id);
  const before = scene.marks.get(id)?.before;
  if (mark === "changed" && !isAlike(before, edge)) {
    return [{ id, edge: before, mark: "gone" }, { id, edge, mark: "new" }];
  }
  return [{ id, edge, mark }];
}

// What marks an element: this step, or else a difference.
function markOf(scene, id) {
  const marked = scene.marks.get(id)?.mark;
  if (scene.differences) {
    const how = scene.differences.get(id);
    if (how === "missing") return "missing";
    if (how !== undefined) return "differs";
    return marked === "gone" ? "gone" : null;
  }
  return marked ?? null;
}

function badge(mark) {
  const sign = BADGES[mark === "missing" ? "differs" : mark];
  return sign && html("span", { class: "badge", "aria-label": mark === "missing" ? "missing" : MARK_WORDS[mark] }, sign);
}

function frame(id, row, mark, extra, ...children) {
  const left = ROW.left + row.depth * ROW.indent;
  const attributes = { class: `box ${extra}`, "data-element": id, "data-mark": mark, place: { left, top: row.y, height: row.height } };
  return html("div", attributes, ...children);
}

function box(scene, id, vertex, row) {
  const mark = markOf(scene, id);
  const lines = row.slots.map((slot) => line(scene, id, slot));
  lines.push(...row.edgeSlots.map((slot) => line(scene, slot.edge, slot, "RT ")));
  const title = `${described(vertex, scene.names)} [${id}]`;
  return frame(id, row, mark, "", badge(mark),
    html("div", { class: "head", title }, html("b", null, name(vertex.name)), " ",
      html("span", { class: "type" }, name(vertex.type)), html("span", { class: "id" }, name(id))),
    lines);
}

// The end of an edge where there is no vertex.
function ghost(id, row) {
  return frame(id, row, null, "ghost", html("div", { class: "head", title: `there is no vertex ${id}` },
    html("span", { class: "id" }, name(id)), " ", html("i", null, "does not exist")));
}

// One attribute of an element: as it is, as it changes, or as it differs.
function line(scene, id, slot, prefix = "") {
  const now = scene.graph.elements.get(id);
  const marked = scene.marks.get(id);
  const current = now ?? marked?.before ?? scene.reference?.elements.get(id);
  if (slot.more) {
    const count = slot.more.filter((key) => attribute(current, key) !== undefined).length;
    return count > 0 ? html("div", { class: "line more" }, `${prefix}… ${count} more`) : null;
  }
  const value = attribute(current, slot.key);
  let [text, mark] = [value === undefined ? null : `${slot.key} = ${value}`, null];
  if (scene.differences) {
    const theirs = attribute(scene.reference.elements.get(id), slot.key);
    if (scene.differences.get(id) === "other" && theirs !== value) {
      mark = "differs";
      text = `${slot.key} = ${value ?? "nothing"} ≠ ${theirs ?? "nothing"}`;
    }
  } else if (marked?.mark === "changed") {
    const old = attribute(marked.before, slot.key);
    if (old !== value) mark = old === undefined ? "new" : value === undefined ? "gone" : "changed";
    if (mark === "gone") text = `${slot.key} = ${old}`;
    if (mark === "changed") text = `${slot.key} = ${old} → ${value}`;
  }
  if (text === null) return html("div", { class: "line" });
  return html("div", { class: "line", "data-line": mark, title: prefix + text },
    mark && html("span", { class: "sign" }, `${BADGES[mark]} `), prefix, html("bdi", { class: "value" }, text));
}

// From a parent down and right to its child.
function trunk(scene, id, edge, mark) {
  const { layout } = scene;
  const [parent, child] = [layout.rows.get(edge.from), layout.rows.get(edge.to)];
  const x = ROW.left + parent.depth * ROW.indent + 9;
  const [stop, y] = [ROW.left + child.depth * ROW.indent, child.y + ROW.head / 2];
  const path = `M${x} ${parent.y + parent.height}V${y - 5}q0 5 5 5H${stop - 1}`;
  const tip = `M${stop - 7} ${y - 3.5}l6 3.5l-6 3.5z`;
  const group = svg("g", { class: "edge kinematic", "data-element": id, "data-mark": mark },
    svg("path", { class: "way", d: path }), svg("path", { class: "tip", d: tip }));
  const sign = BADGES[mark === "missing" ? "differs" : mark];
  if (sign && markOf(scene, edge.to) !== mark) group.append(svg("circle", { class: "disc", cx: x, cy: y - 4, r: 6.5 }), svg("text", { class: "discsign", x, y }, sign));
  return group;
}

// From one row around to another, arriving with a tip.
function bracket(arc, id, mark) {
  const { x, start, stop } = arc;
  const turn = Math.sign(stop - start) || 1;
  const round = Math.min(7, Math.abs(stop - start) / 2, x);
  const path = `M0 ${start}H${x - round}q${round} 0 ${round} ${turn * round}V${stop - turn * round}q0 ${turn * round} ${-round} ${turn * round}H4`;
  const kind = arc.label === "RT" ? "edge kinematic" : "edge";
  return svg("g", { class: kind, "data-element": id, "data-mark": mark },
    svg("path", { class: "way", d: path }), svg("path", { class: "tip", d: `M7 ${stop - 3.5}l-6 3.5l6 3.5z` }));
}

function label(scene, arc, id, edge, mark) {
  const lines = arc.slots.map((slot) => line(scene, id, slot)).filter((line) => line?.hasChildNodes());
  const top = (arc.start + arc.stop) / 2 - ((1 + lines.length) * ROW.line) / 2;
  const sign = BADGES[mark === "missing" ? "differs" : mark];
  return html("div", { class: "label", "data-element": id, "data-mark": mark, place: { left: arc.x + 4, top, maxWidth: arc.room } },
    html("div", { class: "line", title: `${described(edge, scene.names)} [${id}]` },
      sign && html("span", { class: "sign" }, `${sign} `), name(edge.label),
      html("span", { class: "unseen" }, ` (${edgeName(edge, scene.names)})`)),
    lines);
}
