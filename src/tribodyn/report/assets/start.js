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

const KINDS = { f32: Float32Array, f64: Float64Array, u8: Uint8Array };
/** Codes of numbers in equal steps. */
const CODES = { q16: Uint16Array, q32: Uint32Array };

/** Turn codes into numbers; the highest code is a gap. */
function numbersOf(codes, low, step) {
  const gap = 2 ** (8 * codes.BYTES_PER_ELEMENT) - 1;
  return Float64Array.from(codes, (code) => (code === gap ? NaN : low + step * code));
}

/** Turn places in a buffer after `base` into typed arrays, everywhere in a document. */
function unpack(node, buffer, base) {
  if (node === null || typeof node !== "object") return node;
  if (Array.isArray(node)) return node.map((one) => unpack(one, buffer, base));
  const keys = Object.keys(node);
  const Kind = keys.length === 1 && (KINDS[keys[0]] ?? CODES[keys[0]]);
  if (Kind) {
    const [offset, length, ...scale] = node[keys[0]];
    const array = new Kind(buffer, base + offset, length);
    return scale.length ? numbersOf(array, ...scale) : array;
  }
  return Object.fromEntries(keys.map((key) => [key, unpack(node[key], buffer, base)]));
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

/** Write a text where another stands: written once more, the same would have the page laid out anew. */
function write(place, text) {
  if (place.textContent !== text) place.textContent = text;
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
