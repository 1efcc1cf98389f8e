// What a person wishes, what is shown, and how one came from one to the other.

/** Runs that show through, the newest last. */
const TRAIL = 4;

const bench = {
  hello: null,
  controls: new Map(),
  /** What differs from the case, as it is wished: text by key. */
  values: {},
  /** The run that is drawn. Everything the page says of a run is read from here. */
  shown: null,
  trail: [],
  pins: [],
  past: [],
  future: [],
  listeners: { shown: [], wished: [] },

  /** Have something done after a run was drawn, or after the wish has changed. */
  on(event, action) {
    bench.listeners[event].push(action);
  },

  tell(event) {
    bench.listeners[event].forEach((action) => action());
  },

  /** Return the wished value of a key as text. */
  text(key) {
    return bench.values[key] ?? bench.controls.get(key).text;
  },

  /** Return wished values with one of them changed; one that is as in the case is left out. */
  changed(key, text) {
    const values = { ...bench.values, [key]: text };
    if (plain(text) === plain(bench.controls.get(key).text)) delete values[key];
    return values;
  },

  /** Take values as the wish, while a gesture goes on or at its end. */
  wish(values, rest) {
    bench.values = values;
    bench.tell("wished");
    wishes.send(rest);
  },

  /** End a gesture: what was wished before it can be had back. */
  remember(before) {
    if (sameValues(before, bench.values)) return;
    bench.past.push(before);
    bench.future = [];
    writeAddress();
    bench.tell("wished");
  },

  /** Wish something at once, as a gesture of its own. */
  gesture(values) {
    const before = bench.values;
    bench.wish(values, true);
    bench.remember(before);
  },

  /** Go back or on by one gesture. */
  travel(from, to) {
    if (!from.length) return;
    to.push(bench.values);
    bench.wish(from.pop(), true);
    writeAddress();
  },

  undo: () => bench.travel(bench.past, bench.future),
  redo: () => bench.travel(bench.future, bench.past),

  /** Draw a run from now on. */
  show(run) {
    if (bench.shown && bench.shown.run !== run.run) {
      bench.trail = [...bench.trail.filter((one) => one.run !== run.run), bench.shown].slice(-TRAIL);
    }
    bench.shown = run;
    bench.tell("shown");
  },
};

/** Return a text without what does not count in a value: the space before a letter, and which micro it is. */
function plain(text) {
  return String(text).trim().replace(/ +(?=[a-zA-Zµμ])/g, "").replace(/[µμ]/g, "u");
}

/** Tell whether two sets of values are the same. */
function sameValues(a, b) {
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((key) => key in b && plain(a[key]) === plain(b[key]));
}

/** Return values in words: what differs from the case. */
function valuesInWords(values) {
  const parts = Object.entries(values).map(([key, text]) => `${key} = ${text}`);
  return parts.length ? parts.join(", ") : "the case as it is";
}

/** Write what differs from the case into the address. */
function writeAddress() {
  // A space goes before a letter only: "0.038 1/um^2" is no "0.0381/um^2".
  const short = (text) => String(text).replace(/^(\S*\d) (?=[a-zA-Zµ])/, "$1");
  const parts = Object.entries(bench.values).map(([key, text]) => `${key}=${encodeURIComponent(short(text))}`);
  history.replaceState(null, "", parts.length ? `#${parts.join("&")}` : location.pathname);
}

/** Return the values that the address asks for. */
function readAddress() {
  const parts = location.hash.slice(1).split("&").filter((part) => part.includes("="));
  return Object.fromEntries(
    parts.map((part) => {
      const at = part.indexOf("=");
      return [decoded(part.slice(0, at)), decoded(part.slice(at + 1))];
    }),
  );
}

/** Return a part of an address as text; one that is damaged stays as it is. */
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
