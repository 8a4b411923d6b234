// Graphs of replicas, step by step.

// What each replica shows after each step; `graphs[0]` is the start.
function unfold(trace) {
  let now = trace.starts.map((at) => {
    const start = trace.graphs[at];
    return { elements: new Map(Object.entries(start.elements)), remarks: new Set(start.remarks ?? []), state: null };
  });
  const graphs = [now];
  const marks = [new Map()];
  const remarks = [new Map()];
  for (const step of trace.steps) {
    const graph = now[step.who];
    const next = { elements: new Map(graph.elements), remarks: new Set(graph.remarks), state: step.state };
    const marked = new Map();
    for (const [id, after] of step.changes) {
      const before = graph.elements.get(id) ?? null;
      marked.set(id, { mark: before === null ? "new" : after === null ? "gone" : "changed", before, after });
      if (after === null) next.elements.delete(id);
      else next.elements.set(id, after);
    }
    for (const [remark, holds] of step.remarks) {
      if (holds) next.remarks.add(remark);
      else next.remarks.delete(remark);
    }
    now = now.map((graph, at) => (at === step.who ? next : graph));
    graphs.push(now);
    marks.push(marked);
    remarks.push(new Map(step.remarks));
  }
  return { trace, graphs, marks, remarks, names: namesOf(trace) };
}

// How a graph differs from another: `missing`, `extra` or `other` by id.
function differences(reference, graph) {
  const found = new Map();
  for (const [id, element] of reference.elements) {
    const mine = graph.elements.get(id);
    if (mine === undefined) found.set(id, "missing");
    else if (!same(element, mine)) found.set(id, "other");
  }
  for (const id of graph.elements.keys()) if (!reference.elements.has(id)) found.set(id, "extra");
  return found;
}

function same(one, other) {
  if (one === other) return true;
  if (!isAlike(one, other)) return false;
  const [mine, theirs] = [Object.entries(one.attributes ?? {}), other.attributes ?? {}];
  return mine.length === Object.keys(theirs).length
    && mine.every(([key, value]) => Object.hasOwn(theirs, key) && theirs[key] === value);
}

// The number of elements and remarks in which a replica differs from the first.
function differing(graphs) {
  const ids = new Set();
  for (const graph of graphs.slice(1)) {
    for (const id of differences(graphs[0], graph).keys()) ids.add(`element ${id}`);
    for (const remark of graph.remarks) if (!graphs[0].remarks.has(remark)) ids.add(`remark ${remark}`);
    for (const remark of graphs[0].remarks) if (!graph.remarks.has(remark)) ids.add(`remark ${remark}`);
  }
  return ids.size;
}

function attribute(element, key) {
  return element?.attributes && Object.hasOwn(element.attributes, key) ? element.attributes[key] : undefined;
}
