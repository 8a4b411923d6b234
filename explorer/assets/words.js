// Steps and changes in words.

const SIGNS = { broken: "✗", fails: "✗", seen: "◉", holds: "✓", exhaustive: "✓", bounded: "◐", vacuous: "○", violated: "✗" };

const FOUND = { broken: "does not hold", fails: "does not hold", seen: "is seen", holds: "holds" };

// What the elements of a trace are called: a vertex by its name, with its id where another has the same, and an edge
// by its ends.
function namesOf({ graphs, steps }) {
  const elements = new Map();
  const note = ([id, element]) => { if (element !== null) elements.set(id, element); };
  graphs.forEach((graph) => Object.entries(graph.elements).forEach(note));
  steps.forEach((step) => step.changes.forEach(note));
  const owners = new Map();
  for (const { is, name } of elements.values()) if (is === "vertex") owners.set(name, (owners.get(name) ?? 0) + 1);
  const names = new Map();
  for (const [id, { is, name }] of elements) if (is === "vertex") names.set(id, owners.get(name) > 1 ? `${name} (${id})` : name);
  for (const [id, edge] of elements) if (edge.is === "edge") names.set(id, edgeName(edge, names));
  return names;
}

function edgeName({ from, to, label }, names) {
  return `${names.get(from) ?? from} -${label}-> ${names.get(to) ?? to}`;
}

function described(element, names) {
  return element.is === "vertex" ? `vertex ${element.name} (${element.type})` : `edge ${edgeName(element, names)}`;
}

// Whether two elements are the same up to their attributes.
function isAlike(one, other) {
  return ["is", "name", "type", "from", "to", "label"].every((key) => one[key] === other[key]);
}

// The key of an act and its value; a restart and its like are objects as well.
function act(step) {
  return Object.entries(step.does)[0];
}

function sends(step) {
  return act(step)[1].sends ?? [];
}

function doing(step) {
  const [kind, what] = act(step);
  const names = (what.sends ?? []).map((sent) => sent.message).join(", ");
  switch (kind) {
    case "mutate": return names ? `${what.text} → ${names}` : what.text;
    case "deliver": return `receives ${what.message}`;
    case "lose": return `never receives ${what.message}`;
    case "restart": return what.keeps ? "restarts with its state" : "restarts without its state";
    case "answer": return `sends ${what.to} what it lacks${names ? ` → ${names}` : ""}`;
    default: return what.text;
  }
}

// The lines that tell a change, each with its mark.
function changeLines(id, { before, after }, names) {
  const lines = [];
  if (before === null || after === null || !isAlike(before, after)) {
    if (before !== null) lines.push(["gone", `${described(before, names)} [${id}]`]);
    if (after !== null) lines.push(["new", `${described(after, names)} [${id}]`]);
  }
  if (after === null) return lines;
  const of = names.get(id) ?? id;
  const keys = new Set([...Object.keys(before?.attributes ?? {}), ...Object.keys(after.attributes ?? {})]);
  for (const key of [...keys].sort()) {
    const [old, now] = [attribute(before, key), attribute(after, key)];
    if (old === undefined) lines.push(["new", `${of}.${key} = ${now}`]);
    else if (now === undefined) lines.push(["gone", `${of}.${key} = ${old}`]);
    else if (old !== now) lines.push(["changed", `${of}.${key} = ${old} → ${now}`]);
  }
  return lines;
}

const BADGES = { new: "+", gone: "−", changed: "±", differs: "≠" };
const MARK_WORDS = { new: "new", gone: "removed", changed: "changed", differs: "differs" };
