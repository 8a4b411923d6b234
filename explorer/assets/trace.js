// One trace: its finding, its course, and the replicas side by side at one step.

const PACE_MS = 1100;

function traceView(at, options) {
  const trace = TRACES[at];
  const story = unfold(trace);
  const last = trace.steps.length;
  const layouts = new Map();
  const layout = () => layouts.get(options.showsAll) ?? layouts.set(options.showsAll, layOut(story, options.showsAll)).get(options.showsAll);
  let step = 0;
  let playing = null;

  const course = spaceTime(at, trace);
  const slider = html("input", {
    type: "range", id: "slider", min: 0, max: last, value: 0, "aria-label": "step", input: () => go(Number(slider.value)),
  });
  const control = (id, sign, label, keys, action) => html("button", {
    type: "button", id, "aria-label": label, title: `${label} (${keys})`, click: action,
  }, sign);
  const buttons = {
    first: control("first", "⇤", "first step", "Home", () => go(0)),
    previous: control("previous", "←", "previous step", "←", () => go(step - 1)),
    next: control("next", "→", "next step", "→", () => go(step + 1)),
    last: control("last", "⇥", "last step", "End", () => go(last)),
    play: control("play", "play", "play", "p", () => play()),
  };
  const toggle = (id, words, key, option) => html("button", {
    type: "button", id, class: "toggle", "aria-pressed": String(options[option]), title: `(${key})`,
    click: () => flip(option),
  }, words);
  const toggles = {
    differences: toggle("differences", "Differences", "d", "showsDifferences"),
    showsAll: toggle("all", "", "u", "showsAll"),
  };
  const counter = html("output", { class: "counter", for: "slider" });
  const said = html("p", { class: "said" });
  const told = html("p", { class: "told" });
  const summary = html("p", { class: "summary" });
  const live = html("p", { class: "unseen", "aria-live": "polite", id: "live" });
  const panels = html("div", { class: "panels" });
  const finding = findingBlock(trace);

  const stepper = html("div", { class: "stepper" },
    html("div", { class: "controls", role: "group", "aria-label": "steps" },
      buttons.first, buttons.previous, buttons.play, buttons.next, buttons.last, slider, counter,
      html("span", { class: "toggles" }, toggles.differences, toggles.showsAll)),
    html("div", { class: "saying" }, said, told));
  const node = html("article", { class: "trace" },
    traceHead(at, trace), finding, stepper, live,
    html("div", { class: "stage" },
      html("section", { class: "course", "aria-label": "course of events" }, course.node),
      html("section", { class: "replicas", "aria-label": "replicas" }, summary, panels)));

  function go(to) {
    const wanted = Math.min(Math.max(to, 0), last);
    if (wanted === last) stop();
    if (wanted === step) return;
    show(wanted);
    remember(fragment(at, step));
  }

  function show(to) {
    step = to;
    slider.value = step;
    slider.style.setProperty("--done", `${last === 0 ? 100 : (100 * step) / last}%`);
    buttons.first.disabled = buttons.previous.disabled = step === 0;
    buttons.next.disabled = buttons.last.disabled = step === last;
    counter.textContent = `${step} / ${last}`;
    const spoken = stepWords(trace, step);
    said.replaceChildren(...spoken.said);
    told.replaceChildren(...spoken.told);
    const count = differing(story.graphs[step]);
    const many = trace.replicas.length > 1;
    summary.replaceChildren(many ? (count === 0 ? "All replicas show the same graph." : `Replicas differ in ${plural(count, "place")}.`) : "");
    const { hidden, hides } = layout();
    toggles.showsAll.hidden = !hides && !options.showsAll;
    toggles.showsAll.textContent = hidden > 0 ? `… ${hidden} untouched` : "All details";
    toggles.showsAll.setAttribute("aria-pressed", String(options.showsAll));
    toggles.differences.hidden = !many;
    toggles.differences.setAttribute("aria-pressed", String(options.showsDifferences));
    finding.classList.toggle("reached", step === last);
    course.show(step);
    panels.style.setProperty("--panel", `${Math.min(Math.max(layout().width + layout().depth * ROW.indent + 190, 250), 440)}px`);
    panels.replaceChildren(...trace.replicas.map((_, replica) => panel(story, layout(), step, replica, options.showsDifferences)));
    live.textContent = plain(spoken.live(count));
  }

  function play() {
    if (playing !== null) return stop();
    if (step === last) show(0);
    buttons.play.textContent = "pause";
    buttons.play.setAttribute("aria-label", "pause");
    playing = setInterval(() => go(step + 1), PACE_MS);
  }

  function stop() {
    clearInterval(playing);
    playing = null;
    buttons.play.textContent = "play";
    buttons.play.setAttribute("aria-label", "play");
  }

  function flip(option) {
    options[option] = !options[option];
    show(step);
  }

  return { node, at, show, go, play, stop, flip, step: () => step, last };
}

// Title, origin, and the way to the other run of the same row and to other traces.
function traceHead(at, trace) {
  const others = TRACES.map((other, index) => ({ other, index })).filter(({ other }) => trace.row !== undefined && other.row === trace.row);
  const sides = others.length > 1 && html("nav", { class: "sides", "aria-label": "semantics" }, others.map(({ other, index }) => html("a", {
    href: fragment(index, 0), "data-side": index, "aria-current": index === at ? "true" : null,
  }, other.side)));
  const places = [trace.run, trace.semantics, trace.layer, trace.bound];
  return html("header", { class: "trace-head" },
    html("div", null, html("h1", { tabindex: -1 }, name(trace.title)),
      html("p", { class: "origin" }, [...new Set(places.filter(Boolean))].map((place) => html("span", null, name(place))))),
    sides);
}

function findingBlock(trace) {
  const { kind, clause, what, detail, replicas } = trace.finding;
  return html("section", { class: "finding", "data-kind": kind, "aria-label": "finding" },
    html("span", { class: "verdict-sign", "aria-hidden": "true" }, SIGNS[kind] ?? "·"),
    html("div", null,
      html("p", null, html("b", null, clause && [name(clause), " "], FOUND[kind] ?? kind), clause && what && ": ", what && name(what), " ",
        html("span", { class: "when" }, `after step ${trace.steps.length}`)),
      detail && html("p", { class: "detail" }, name(bare(detail, clause, what))),
      kind !== "holds" && replicas.length > 0 && html("p", { class: "detail" }, "Shown by ", replicas.map((one, at) => [at > 0 && ", ", name(one)]))));
}

// Some details begin with their clause or with what is said above them.
function bare(detail, clause, what) {
  const heads = [`[${clause}]`, `${what}:`];
  return heads.reduce((rest, head) => (rest.startsWith(head) ? rest.slice(head.length).trimStart() : rest), detail);
}

// What a step says, in sight and for a screen reader.
function stepWords(trace, at) {
  if (at === 0) {
    return { said: ["The start, before anything happens."], told: [], live: (count) => `Start. ${differWords(trace, count)}` };
  }
  const step = trace.steps[at - 1];
  const who = trace.replicas[step.who];
  const [, what] = act(step);
  const told = sends(step).map((sent) => html("span", null, html("b", null, name(sent.message)), " ", name(sent.text), " "));
  if (what.message !== undefined) {
    const sender = trace.steps.findIndex((other) => sends(other).some((sent) => sent.message === what.message));
    const sent = sender >= 0 && sends(trace.steps[sender]).find((one) => one.message === what.message);
    if (sent) told.push(html("span", null, html("b", null, name(what.message)), " from ", name(trace.replicas[trace.steps[sender].who]), `, step ${sender + 1}: `, name(sent.text)));
    if (what.again) told.push(html("span", null, " Another copy stays under way."));
  }
  const changes = step.changes.length + step.remarks.length;
  return {
    said: [html("b", null, name(who)), " ", name(doing(step))],
    told,
    live: (count) => `Step ${at} of ${trace.steps.length}. ${who} ${doing(step)}. ${plural(changes, "change")}. ${differWords(trace, count)}`,
  };
}

function differWords(trace, count) {
  if (trace.replicas.length < 2) return "";
  return count === 0 ? "All replicas show the same graph." : `Replicas differ in ${plural(count, "place")}.`;
}
