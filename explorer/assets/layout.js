// Where everything stands, once for all steps and replicas of a trace, so that nothing jumps.
//
// Vertices are rows of an outline: below their kinematic parent and indented. The parent is the one that most
// graphs of the trace show; kinematic edges to another, and all symbolic edges, are brackets to the right of the
// outline, in lanes of their own. Every attribute that a vertex ever has keeps its line.

const ROW = { head: 24, line: 16, gap: 8, indent: 20, left: 22 };
const LANE = { letter: 6.3, letters: 18, pad: 18, first: 12 };
const MANY_VERTICES = 20;
const MANY_ATTRIBUTES = 5;
// Up to so many vertices, edges have lines for all their attributes.
const FEW_VERTICES = 6;

function layOut(story, showsAll) {
  const union = collect(story);
  const touched = whatChanges(story, union);
  const parents = homes(union);
  const shown = new Set(union.vertices.keys());
  if (!showsAll && shown.size > MANY_VERTICES && touched.vertices.size > 0) {
    shown.clear();
    for (const id of touched.vertices) for (let at = id; at !== undefined && !shown.has(at); at = parents.get(at)) shown.add(at);
  }
  const rows = outline(union, parents, shown);
  const { tree, arcs } = split(union, parents, rows);
  const some = union.vertices.size > FEW_VERTICES ? 0 : MANY_ATTRIBUTES;
  const slots = (element) => attributeSlots(element, touched, showsAll ? Infinity : MANY_ATTRIBUTES);
  const edgeSlots = (edge) => attributeSlots(edge, touched, showsAll ? Infinity : some);
  let y = ROW.gap;
  for (const [id, row] of rows) {
    row.slots = slots(union.vertices.get(id));
    for (const edge of tree.values()) if (edge.to === id) row.edgeSlots.push(...edgeSlots(edge).map((slot) => ({ ...slot, edge: edge.id })));
    row.y = y;
    row.height = ROW.head + (row.slots.length + row.edgeSlots.length) * ROW.line + (row.slots.length + row.edgeSlots.length > 0 ? 4 : 0);
    y += row.height + ROW.gap;
  }
  const width = brackets(arcs, rows, edgeSlots);
  return { rows, tree, arcs, height: y, width, depth: Math.max(0, ...[...rows.values()].map((row) => row.depth)), hidden: union.vertices.size - rows.size, hides: hides(union, rows, { slots, edgeSlots }) };
}

// Whether some vertex or attribute has no place.
function hides({ vertices, edges }, rows, { slots, edgeSlots }) {
  const isCut = (all, of) => [...all.values()].some((element) => element.keys.size > of(element).filter((slot) => !slot.more).length);
  return vertices.size > rows.size || isCut(vertices, slots) || isCut(edges, edgeSlots);
}

const edgeKey = (id, edge) => JSON.stringify([id, edge.from, edge.to, edge.label]);

// Every vertex, edge and end of an edge that any graph of the trace shows, with its attributes and how often.
function collect({ graphs }) {
  const vertices = new Map();
  const edges = new Map();
  const seen = new Set();
  const note = (map, key, make) => map.get(key) ?? map.set(key, make()).get(key);
  for (const moment of graphs) {
    for (const graph of moment) {
      const isKnown = seen.has(graph);
      seen.add(graph);
      for (const [id, element] of graph.elements) {
        const entry = element.is === "vertex"
          ? note(vertices, id, () => ({ id, keys: new Map(), count: 0 }))
          : note(edges, edgeKey(id, element), () => ({ ...element, id, keys: new Map(), count: 0 }));
        entry.count += 1;
        if (isKnown) continue;
        for (const [key, value] of Object.entries(element.attributes ?? {})) {
          entry.keys.set(key, Math.max(entry.keys.get(key) ?? 0, plain(key).length + 3 + plain(value).length));
        }
      }
    }
  }
  for (const { from, to } of edges.values()) {
    for (const id of [from, to]) note(vertices, id, () => ({ id, keys: new Map(), count: 0 }));
  }
  return { vertices, edges };
}

// What a step changes or replicas show differently, and the ends of such edges.
function whatChanges({ graphs, marks }, { vertices }) {
  const attributes = new Set();
  const ids = new Set();
  const compare = (id, one, other) => {
    for (const element of [one, other]) {
      if (element?.is === "edge") [element.from, element.to].forEach((end) => ids.add(end));
      else if (element) ids.add(id);
    }
    const keys = [one, other].flatMap((element) => Object.keys(element?.attributes ?? {}));
    if (one && other) {
      for (const key of keys) if (attribute(one, key) !== attribute(other, key)) attributes.add(JSON.stringify([id, key]));
    }
  };
  for (const step of marks) for (const [id, { before, after }] of step) compare(id, before, after);
  for (const graph of graphs[0].slice(1)) {
    for (const id of differences(graphs[0][0], graph).keys()) compare(id, graphs[0][0].elements.get(id), graph.elements.get(id));
  }
  return { attributes, vertices: new Set([...ids].filter((id) => vertices.has(id))) };
}

// The kinematic parent of each vertex in most graphs; no vertex is its own ancestor.
function homes({ vertices, edges }) {
  const best = new Map();
  for (const edge of edges.values()) {
    if (edge.label !== "RT" || edge.from === edge.to) continue;
    const other = best.get(edge.to);
    if (other === undefined || edge.count > other.count) best.set(edge.to, edge);
  }
  const parents = new Map();
  for (const id of vertices.keys()) {
    const parent = best.get(id)?.from;
    let at = parent;
    while (at !== undefined && at !== id) at = parents.get(at);
    if (parent !== undefined && at !== id) parents.set(id, parent);
  }
  return parents;
}

// The rows in the order of the outline, with their depth.
function outline({ vertices }, parents, shown) {
  const children = new Map();
  for (const id of vertices.keys()) {
    const parent = parents.get(id);
    children.set(parent, [...(children.get(parent) ?? []), id]);
  }
  const rows = new Map();
  const visit = (id, depth) => {
    if (shown.has(id)) rows.set(id, { depth, parent: parents.get(id), edgeSlots: [], ports: [] });
    for (const child of children.get(id) ?? []) visit(child, depth + 1);
  };
  for (const id of children.get(undefined) ?? []) visit(id, 0);
  return rows;
}

// Edges from a vertex to those indented below it, one each, and all others.
function split({ edges }, parents, rows) {
  const tree = new Map();
  const arcs = new Map();
  const taken = new Set();
  for (const [key, edge] of edges) {
    if (!rows.has(edge.from) || !rows.has(edge.to)) continue;
    if (edge.label === "RT" && parents.get(edge.to) === edge.from && !taken.has(edge.to)) {
      taken.add(edge.to);
      tree.set(key, edge);
    } else {
      arcs.set(key, { ...edge });
    }
  }
  return { tree, arcs };
}

// The attributes of an element that have a line of their own; of many, those that ever differ.
function attributeSlots({ id, keys }, touched, most) {
  const all = [...keys.keys()].sort();
  const slot = (key) => ({ key, length: keys.get(key) });
  if (all.length <= most) return all.map(slot);
  const some = all.filter((key) => touched.attributes.has(JSON.stringify([id, key])));
  const more = most > 0 ? [{ more: all.filter((key) => !some.includes(key)), length: 8 }] : [];
  return [...some.map(slot), ...more];
}

// Gives each bracket a lane in which nothing else of its height stands, and each end a port. Returns their width.
function brackets(arcs, rows, slots) {
  const all = [...arcs.values()];
  for (const arc of all) {
    arc.slots = slots(arc);
    rows.get(arc.from).ports.push({ arc, end: "start", other: rows.get(arc.to).y });
    rows.get(arc.to).ports.push({ arc, end: "stop", other: rows.get(arc.from).y });
  }
  for (const row of rows.values()) {
    row.ports.sort((one, other) => one.other - other.other);
    row.ports.forEach(({ arc, end }, at) => { arc[end] = row.y + (row.height * (at + 1)) / (row.ports.length + 1); });
  }
  const lanes = [];
  const reach = (arc) => {
    const [top, bottom] = [Math.min(arc.start, arc.stop), Math.max(arc.start, arc.stop)];
    const half = Math.max((bottom - top) / 2, ((1 + arc.slots.length) * ROW.line) / 2);
    return [(top + bottom) / 2 - half - 2, (top + bottom) / 2 + half + 2];
  };
  all.sort((one, other) => reach(one)[1] - reach(one)[0] - (reach(other)[1] - reach(other)[0]));
  for (const arc of all) {
    const [top, bottom] = reach(arc);
    arc.lane = lanes.findIndex((lane) => lane.every(([from, to]) => bottom < from || to < top));
    if (arc.lane < 0) arc.lane = lanes.push([]) - 1;
    lanes[arc.lane].push([top, bottom]);
  }
  const widths = lanes.map((_, at) => {
    const texts = all.filter((arc) => arc.lane === at).flatMap(labelTexts).map((text) => Math.min(text, LANE.letters));
    return Math.max(...texts) * LANE.letter + LANE.pad;
  });
  const lefts = widths.map((_, at) => LANE.first + widths.slice(0, at).reduce((sum, width) => sum + width, 0));
  for (const arc of all) Object.assign(arc, { x: lefts[arc.lane], room: widths[arc.lane] - 6 });
  return lanes.length === 0 ? 0 : LANE.first + widths.reduce((sum, width) => sum + width, 0);
}

// The lengths of the lines beside a bracket, with room for a badge.
function labelTexts(arc) {
  return [plain(arc.label).length + 2, ...arc.slots.map((slot) => slot.length)];
}
