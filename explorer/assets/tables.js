// Tables of texts, and a filter of their rows.

function verdictWord(verdict) {
  return html("span", { class: "verdict", "data-verdict": verdict }, html("span", { "aria-hidden": "true" }, `${SIGNS[verdict] ?? "·"} `), name(verdict));
}

function number(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, "\u00a0");
}

// A table; columns that start with "#" hold numbers. A row may be a line across all columns.
function table(caption, columns, rows) {
  const isNumber = columns.map((column) => column.startsWith("#"));
  return html("section", { class: "table" }, html("h2", null, caption),
    html("div", { class: "table-scroll", tabindex: 0, role: "region", "aria-label": caption },
      html("table", null,
        html("thead", null, html("tr", null, columns.map((column, at) => html("th", { scope: "col", class: isNumber[at] && "number" }, column.replace(/^#/, ""))))),
        html("tbody", null, rows.map((row) => html("tr", null, row.map((cell, at) => html("td", { class: isNumber[at] ? "number" : null }, cell))))))));
}

// Hides the rows that have not all the words.
function filterBox(scope) {
  const count = html("span", { class: "filter-count", role: "status" });
  const input = html("input", {
    type: "search", id: "filter", placeholder: "Filter", "aria-label": "filter the tables", autocomplete: "off", spellcheck: "false",
    input: () => {
      const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
      const rows = [...scope.querySelectorAll("tbody tr")];
      for (const row of rows) {
        const text = row.textContent.toLowerCase();
        row.hidden = !words.every((word) => text.includes(word));
      }
      const left = rows.filter((row) => !row.hidden).length;
      count.textContent = words.length === 0 ? "" : `${left} of ${plural(rows.length, "row")}`;
    },
  });
  return html("p", { class: "filter" }, input, html("kbd", null, "/"), count);
}
