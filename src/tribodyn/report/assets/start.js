// What all scripts share: the data of the page and small helpers.

const page = { clock: null, figures: {} };

/**
 * Draws one kind of figure: (box) => {take(data, ghosts), paint(), show(frame)}. Each script adds its own.
 *
 * `take` gives what is drawn and, fainter, the same of other runs: [{data, strength}]. `paint` draws it, `show` follows time.
 */
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

/** Make an element with attributes and children; texts stay texts, and styles need no leave of the page's policy. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "style") made.style.cssText = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/** Make a button that does something. */
function button(label, action, attributes = {}) {
  const made = element("button", { type: "button", ...attributes }, label);
  made.addEventListener("click", action);
  return made;
}

/** Write a number as a person reads it: a true minus, few digits. */
function number(value, digits = 3) {
  return Number(value.toPrecision(digits)).toString().replace("-", "−");
}
