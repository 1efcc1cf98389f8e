// Colours: those of the style sheet, light or dark; the paper is always light.

/** Steps of the scale of loads. */
const SHADES_OF_LOAD = 256;

const theme = {
  dark: matchMedia("(prefers-color-scheme: dark)"),
  coarse: matchMedia("(pointer: coarse)"),
  known: new Map(),

  /** Forget the colours read so far: the style sheet has others now. */
  forget() {
    theme.known.clear();
  },

  /** Return a colour of the style sheet by name. */
  colour(name) {
    if (!theme.known.has(name)) {
      theme.known.set(name, getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
    }
    return theme.known.get(name);
  },

  /** Return red, green and blue of a colour of the style sheet, 0 to 255. */
  rgb(name) {
    return channels(theme.colour(name));
  },

  /** Return the font of the page at a size [px]. */
  font(size = 12) {
    if (!theme.known.has("font")) theme.known.set("font", getComputedStyle(document.body).fontFamily);
    return `${size}px ${theme.known.get("font")}`;
  },

  /** Return the colours of loads from none to the most: the page's own colour where there is nothing. */
  loads() {
    return theme.dark.matches
      ? ["#1f2226", "#4a2a5e", "#93355f", "#d2603f", "#f3a84f", "#fff0b8"]
      : ["#ffffff", "#fde0a6", "#f7a25c", "#d9513c", "#8f1d4f", "#2a0a3c"];
  },

  /** Return the colours of loads in even steps, red, green and blue after each other. */
  ramp() {
    if (!theme.known.has("ramp")) theme.known.set("ramp", blended(theme.loads().map(channels)));
    return theme.known.get("ramp");
  },
};

/** Return red, green and blue of "#rrggbb". */
function channels(colour) {
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
}

/** Return colours in even steps between stops, three bytes each. */
function blended(stops) {
  const bytes = new Uint8ClampedArray(3 * SHADES_OF_LOAD);
  for (let n = 0; n < SHADES_OF_LOAD; n++) {
    const place = (n / (SHADES_OF_LOAD - 1)) * (stops.length - 1);
    const k = Math.min(Math.floor(place), stops.length - 2);
    for (let c = 0; c < 3; c++) bytes[3 * n + c] = stops[k][c] + (place - k) * (stops[k + 1][c] - stops[k][c]);
  }
  return bytes;
}
