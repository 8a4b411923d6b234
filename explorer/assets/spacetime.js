// The course of a trace: time downwards, a lane for each replica, an arrow for each message that arrives.

const COURSE = { row: 40, top: 0, number: 30 };

// The rows, each a link to its step, and what moves the highlight.
function spaceTime(at, trace) {
  const longest = Math.max(...trace.replicas.map((text) => plain(text).length));
  const pitch = Math.min(Math.max(longest * 6.9 + 12, 48), 84);
  const x = (lane) => pitch * (lane + 0.5);
  const y = (row) => COURSE.row * (row + 0.5);
  const width = pitch * trace.replicas.length;
  const height = COURSE.row * (trace.steps.length + 1);
  const drawing = svg("svg", { class: "course-drawing", width, height, "aria-hidden": "true" });
  trace.replicas.forEach((_, lane) => drawing.append(svg("path", { class: "lane", d: `M${x(lane)} 10V${height}` })));
  const parts = [];
  const add = (row, node) => { drawing.append(node); (parts[row] ??= []).push(node); };
  const senders = new Map();
  const taken = [];
  const titles = [];
  trace.steps.forEach((step, index) => sends(step).forEach((sent) => senders.set(sent.message, { row: index + 1, step })));
  trace.steps.forEach((step, index) => {
    const message = act(step)[1].message;
    const sender = senders.get(message);
    if (sender === undefined) return;
    add(index + 1, arrow(step, sender, { x, y }, index + 1));
    titles.push([index + 1, messageName(step, message, sender, { x, y, taken }, index + 1)]);
  });
  // Above all arrows, so that none runs through a name.
  titles.forEach(([row, node]) => add(row, node));
  trace.steps.forEach((step, index) => add(index + 1, event(step, x(step.who), y(index + 1))));
  const heads = html("div", { class: "course-heads", place: { paddingLeft: COURSE.number } },
    trace.replicas.map((text) => html("div", { class: "lane-head", title: text, place: { width: pitch } }, name(text))));
  const rows = ["start", ...trace.steps.map(doing)].map((words, row) => html("a", { class: "course-row", href: fragment(at, row) },
    html("span", { class: "number" }, String(row)),
    html("span", { class: "gap", place: { width } }),
    html("span", { class: "words", title: words }, row > 0 && html("b", null, name(trace.replicas[trace.steps[row - 1].who])), row > 0 && " ", name(words))));
  const list = html("ol", { class: "course-rows" }, rows.map((row) => html("li", null, row)));
  const holder = html("div", { class: "course-body" }, drawing, list);
  drawing.style.left = `${COURSE.number}px`;
  const scroller = html("div", { class: "course-scroll" }, heads, holder);
  const show = (step) => {
    rows.forEach((row, at) => {
      row.classList.toggle("future", at > step);
      if (at === step) row.setAttribute("aria-current", "step");
      else row.removeAttribute("aria-current");
    });
    parts.forEach((nodes, at) => nodes.forEach((node) => {
      node.classList.toggle("future", at > step);
      node.classList.toggle("current", at === step);
    }));
    const top = rows[step].offsetTop + holder.offsetTop;
    if (top < scroller.scrollTop + COURSE.row || top + 2 * COURSE.row > scroller.scrollTop + scroller.clientHeight) {
      scroller.scrollTop = top - scroller.clientHeight / 2;
    }
  };
  return { node: scroller, show };
}

function arrow(step, sender, { x, y }, row) {
  const [kind] = act(step);
  const from = { x: x(sender.step.who), y: y(sender.row) };
  const to = { x: x(step.who), y: y(row) };
  const isAnswer = act(sender.step)[0] === "answer";
  const group = svg("g", { class: `message ${kind === "lose" ? "lost" : ""} ${isAnswer ? "answered" : ""}` });
  if (from.x === to.x) {
    const path = `M${from.x} ${from.y}h14q8 0 8 8V${to.y - 8}q0 8 -8 8h-6`;
    group.append(svg("path", { class: "way", d: path }));
    return group;
  }
  const length = Math.hypot(to.x - from.x, to.y - from.y);
  const [dx, dy] = [(to.x - from.x) / length, (to.y - from.y) / length];
  const tip = { x: to.x - dx * 8, y: to.y - dy * 8 };
  const wing = (side) => `${tip.x - dx * 8 - side * dy * 4} ${tip.y - dy * 8 + side * dx * 4}`;
  group.append(svg("path", { class: "way", d: `M${from.x} ${from.y}L${tip.x - dx * 5} ${tip.y - dy * 5}` }));
  if (kind !== "lose") group.append(svg("path", { class: "tip", d: `M${tip.x} ${tip.y}L${wing(1)}L${wing(-1)}z` }));
  return group;
}

// Stands on its arrow, where no other name does.
function messageName(step, message, sender, { x, y, taken }, row) {
  const [from, to] = [{ x: x(sender.step.who), y: y(sender.row) }, { x: x(step.who), y: y(row) }];
  const at = (share) => ({ x: from.x + (to.x - from.x) * share, y: from.y + (to.y - from.y) * share + 1 });
  const isFree = (place) => taken.every((other) => Math.abs(other.x - place.x) > 24 || Math.abs(other.y - place.y) > 12);
  const place = [0.6, 0.5, 0.7, 0.4, 0.8, 0.3].map(at).find(isFree) ?? at(0.6);
  taken.push(place);
  return svg("g", null, svg("text", { class: "message-name", ...place }, cut(message, 10)));
}

// Each kind of step has a shape of its own.
function event(step, x, y) {
  const [kind] = act(step);
  const shape = {
    mutate: () => svg("circle", { class: "full", cx: x, cy: y, r: 6 }),
    deliver: () => svg("circle", { class: "hollow", cx: x, cy: y, r: 5 }),
    lose: () => svg("path", { class: "cross", d: `M${x - 5} ${y - 5}l10 10m0 -10l-10 10` }),
    restart: () => svg("g", null, svg("circle", { class: "ground", cx: x, cy: y, r: 9 }),
      svg("path", { class: "turn", d: `M${x + 5.6} ${y + 2}A6 6 0 1 1 ${x + 3} ${y - 5.2}` }),
      svg("path", { class: "turn-tip", d: `M${x + 7.6} ${y - 2.6}L${x + 5} ${y - 8.6}L${x + 1} ${y - 1.8}z` })),
    answer: () => svg("path", { class: "hollow", d: `M${x} ${y - 7}l7 7l-7 7l-7 -7z` }),
    happen: () => svg("rect", { class: "hollow", x: x - 5, y: y - 5, width: 10, height: 10 }),
  };
  return svg("g", { class: "event" }, (shape[kind] ?? shape.happen)());
}
