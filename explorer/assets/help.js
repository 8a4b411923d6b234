// Keys and signs, explained.

function legend() {
  const entry = (sign, kind, words) => [html("dt", null, html("span", { class: "legend", "data-line": kind }, sign)), html("dd", null, words)];
  return html("dl", { class: "keys" }, ["new", "gone", "changed", "differs"].map((mark) => entry(BADGES[mark], mark, {
    new: "new in this step", gone: "removed in this step", changed: "an attribute changed: old → new",
    differs: "differs from the first replica",
  }[mark])),
  entry("●", null, "mutates"), entry("○", null, "receives"), entry("✕", null, "never receives"), entry("◇", null, "sends what another lacks"),
  entry("↻", null, "restarts"));
}

function help() {
  const dialog = document.getElementById("help");
  dialog.append(html("h2", null, "Keys"),
    html("dl", { class: "keys" }, KEYS.map(([, key, words]) => [html("dt", null, html("kbd", null, key)), html("dd", null, words)])),
    html("h2", null, "Signs"), legend(),
    html("p", null, "Lines with a turn on the left are the kinematic tree (RT); brackets on the right are all other edges, with a tip where they end."),
    html("form", { method: "dialog" }, html("button", { autofocus: true }, "Close")));
  document.getElementById("help-button").addEventListener("click", () => dialog.showModal());
}
