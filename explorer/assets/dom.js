// Nodes are made from names and texts only; nothing in this page parses markup.

const SVG = "http://www.w3.org/2000/svg";
const TITLE_MAX = 2000;

// Characters that steer the layout of text, or that nobody sees, are written out.
const UNSEEN = /[\u0000-\u0008\u000b-\u001f\u007f-\u009f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;

function plain(text) {
  return String(text).replace(UNSEEN, (c) => `⟨U+${c.codePointAt(0).toString(16).toUpperCase().padStart(4, "0")}⟩`);
}

function cut(text, most) {
  const letters = Array.from(plain(text));
  return letters.length > most ? letters.slice(0, most - 1).join("") + "…" : letters.join("");
}

function html(tag, attributes, ...children) {
  return furnish(document.createElement(tag), attributes, children);
}

function svg(tag, attributes, ...children) {
  return furnish(document.createElementNS(SVG, tag), attributes, children);
}

function furnish(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name === "place") Object.entries(value).forEach(([key, length]) => { node.style[key] = `${length}px`; });
    else if (typeof value === "function") node.addEventListener(name, value);
    else node.setAttribute(name, value === true ? "" : name === "title" ? cut(value, TITLE_MAX) : plain(value));
  }
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined || child === false) continue;
    node.append(child instanceof Node ? child : plain(child));
  }
  return node;
}

// A name from the data: what its letters do to the direction of text ends with it.
function name(text) {
  return html("bdi", null, text);
}

function plural(count, word) {
  return `${count} ${word}${count === 1 ? "" : "s"}`;
}
