// What all scripts share: the data of the page and small helpers.

const page = unpack(JSON.parse(document.getElementById("page-data").textContent));

/** Draws one kind of figure: (box, data) => {paint(), show(frame)}. Each script adds its own. */
const widgets = {};

/** Tell whether the screen is that of a phone. */
function isNarrow() {
  return document.documentElement.clientWidth < 600;
}

/** Turn packed arrays back into typed arrays, everywhere in a document. */
function unpack(node) {
  if (node === null || typeof node !== "object") return node;
  if (Array.isArray(node)) return node.map(unpack);
  const kinds = { f32: Float32Array, f64: Float64Array, u8: Uint8Array };
  const keys = Object.keys(node);
  if (keys.length === 1 && keys[0] in kinds) {
    const bytes = Uint8Array.from(atob(node[keys[0]]), (c) => c.charCodeAt(0));
    return new kinds[keys[0]](bytes.buffer);
  }
  return Object.fromEntries(keys.map((key) => [key, unpack(node[key])]));
}

/** Make an element with attributes and children; texts stay texts. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** Make a button that does something. */
function button(label, action, attributes = {}) {
  const made = element("button", { type: "button", ...attributes }, label);
  made.addEventListener("click", action);
  return made;
}

/** Write a text so that the plotting library, which reads some markup, prints it as it is. */
function literal(text) {
  return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

/** Write a number as a person reads it: a true minus, few digits. */
function number(value, digits = 3) {
  return Number(value.toPrecision(digits)).toString().replace("-", "−");
}
