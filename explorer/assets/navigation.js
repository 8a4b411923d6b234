// From fragments to what is shown, and from keys to fragments.

const options = { showsDifferences: false, showsAll: false };
let open = null;

// Browsers ignore addresses that change too often, as when a key is held down.
const REST_MS = 120;
let remembered = 0;
let remembering = null;

// The address of what is shown, without an entry in the history for each step.
function remember(hash) {
  clearTimeout(remembering);
  const rest = remembered + REST_MS - performance.now();
  const before = location.hash;
  if (rest > 0) {
    // Unless a link was followed meanwhile.
    remembering = setTimeout(() => { if (location.hash === before) remember(hash); }, rest);
    return;
  }
  remembered = performance.now();
  try {
    history.replaceState(null, "", hash);
  } catch {
    location.replace(hash);
  }
}

function navigate() {
  clearTimeout(remembering);
  const { at, step, unknown } = destination(location.hash);
  const main = document.getElementById("main");
  const isSame = open !== null && open.at === at;
  if (!isSame) {
    open?.stop();
    open = at === null ? null : traceView(at, options);
    main.replaceChildren(open ? open.node : overview(unknown && `The page has no trace ${plain(unknown)}.`));
    scrollTo(0, 0);
    if (hasNavigated) main.querySelector("h1").focus({ preventScroll: true });
  }
  hasNavigated = true;
  open?.show(step);
  document.title = plain(open ? `${TRACES[at].title} · ${CONTENT.title}` : CONTENT.title);
  place(at);
}

let hasNavigated = false;

// What stands at the top: where this trace is among all.
function place(at) {
  const all = TRACES.length;
  document.getElementById("home").hidden = at === null || isAlone();
  document.getElementById("place").textContent = at === null || all < 2 ? "" : `${at + 1} of ${all}`;
  for (const [id, to] of [["previous-trace", at - 1], ["next-trace", at + 1]]) {
    const link = document.getElementById(id);
    link.hidden = at === null || all < 2;
    if (TRACES[to]) link.setAttribute("href", fragment(to, 0));
    else link.removeAttribute("href");
  }
}

function toTrace(by) {
  const to = open === null ? (by > 0 ? 0 : TRACES.length - 1) : open.at + by;
  if (TRACES[to]) location.hash = fragment(to, 0);
}

// The other run of the same row, at the same step.
function toOtherSide() {
  if (open === null) return;
  const { row } = TRACES[open.at];
  const to = TRACES.findIndex((trace, at) => row !== undefined && trace.row === row && at !== open.at);
  if (to >= 0) location.hash = fragment(to, Math.min(open.step(), TRACES[to].steps.length));
}

const KEYS = [
  [["ArrowRight"], "→", "next step", () => open?.go(open.step() + 1)],
  [["ArrowLeft"], "←", "previous step", () => open?.go(open.step() - 1)],
  [["Home"], "Home", "first step", () => open?.go(0)],
  [["End"], "End", "last step", () => open?.go(open.last)],
  [["p"], "p", "play and pause", () => open?.play()],
  [["d"], "d", "mark what differs from the first replica", () => open?.flip("showsDifferences")],
  [["u"], "u", "show what no step touches as well", () => open?.flip("showsAll")],
  [["o"], "o", "the other run of the same row", toOtherSide],
  [["j"], "j", "next trace", () => toTrace(1)],
  [["k"], "k", "previous trace", () => toTrace(-1)],
  [["/"], "/", "filter the tables of the overview", toFilter],
  [["t"], "t", "light, dark, or as the system", () => turnTheme()],
  [["?"], "?", "this help", () => document.getElementById("help").showModal()],
  [["Escape"], "Esc", "back to the overview", () => { if (open !== null && !isAlone()) location.hash = "#"; }],
];

function toFilter() {
  if (open !== null) {
    location.hash = "#";
    navigate();
  }
  document.getElementById("filter")?.focus();
}

function press(event) {
  if (event.ctrlKey || event.altKey || event.metaKey || document.getElementById("help").open) return;
  const { target } = event;
  if (target.id === "filter") {
    if (event.key === "Escape") target.blur();
    return;
  }
  const isOwn = target.id === "slider" && /^(Arrow|Home|End)/.test(event.key);
  const isScroll = target.matches(".drawing-scroll, .table-scroll") && /^Arrow/.test(event.key) && target.scrollWidth > target.clientWidth;
  if (isOwn || isScroll || (open === null && /^(Arrow|Home|End)/.test(event.key))) return;
  const known = KEYS.find(([keys]) => keys.includes(event.key));
  if (known === undefined) return;
  event.preventDefault();
  known[3]();
}
