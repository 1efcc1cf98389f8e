// State of the page: the requested values, the run that is shown, and the history of both.

/** Runs that show through, the newest last. */
const TRAIL = 4;

/** Key under which the edit of the model, as JSON, stands among the requested values. */
const EDIT = "@edit";
const NO_EDIT = { template: "", removed: [], added: {} };

const pageState = {
  hello: null,
  /** The edit, as text, of the model that the page is made for. */
  built: null,
  controls: new Map(),
  /** Requested values that differ from the case: text by key. */
  values: {},
  /** The run that is drawn. Everything the page says of a run is read from here. */
  shown: null,
  trail: [],
  pins: [],
  past: [],
  future: [],
  listeners: { shown: [], requested: [] },

  /** Call a function after a run was drawn, or after the requested values have changed. */
  on(event, action) {
    pageState.listeners[event].push(action);
  },

  notify(event) {
    pageState.listeners[event].forEach((action) => action());
  },

  /** Return the requested value of a key as text. */
  text(key) {
    return pageState.values[key] ?? pageState.controls.get(key).text;
  },

  /** Return requested values with one of them changed; one that is as in the case is left out. */
  changed(key, text) {
    const values = { ...pageState.values, [key]: text };
    if (plain(text) === plain(pageState.controls.get(key).text)) delete values[key];
    return values;
  },

  /** Request values, during a gesture or at its end. */
  request(values, rest) {
    pageState.values = values;
    pageState.notify("requested");
    requests.send(rest);
  },

  /** End a gesture: the values before it can be restored. */
  remember(before) {
    if (sameValues(before, pageState.values)) return;
    pageState.past.push(before);
    pageState.future = [];
    writeAddress();
    pageState.notify("requested");
  },

  /** Request values as a gesture of its own. */
  gesture(values) {
    const before = pageState.values;
    pageState.request(values, true);
    pageState.remember(before);
  },

  /** Go back or on by one gesture. */
  travel(from, to) {
    if (!from.length) return;
    to.push(pageState.values);
    pageState.request(from.pop(), true);
    writeAddress();
  },

  undo: () => pageState.travel(pageState.past, pageState.future),
  redo: () => pageState.travel(pageState.future, pageState.past),

  /** Draw a run from now on. */
  show(run) {
    if (pageState.shown && pageState.shown.run !== run.run) {
      pageState.trail = [...pageState.trail.filter((one) => one.run !== run.run), pageState.shown].slice(-TRAIL);
    }
    pageState.shown = run;
    pageState.notify("shown");
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

/** Return values without the edit of the model, and the edit. */
function parted({ [EDIT]: edit, ...values }) {
  return { values, edit: editOf(edit) };
}

/** Return the edit that a text holds; one that is damaged edits nothing. */
function editOf(text) {
  try {
    return { ...NO_EDIT, ...JSON.parse(text || "{}") };
  } catch {
    return NO_EDIT;
  }
}

/** Return an edit as a text, empty where it edits nothing. */
function editText({ template, removed, added }) {
  const text = JSON.stringify({ template, removed, added });
  return text === JSON.stringify(NO_EDIT) ? "" : text;
}

/** Return values in words: what differs from the case. */
function valuesInWords(values) {
  const parts = Object.entries(parted(values).values).map(([key, text]) => `${key} = ${text}`);
  if (values[EDIT]) parts.unshift("edited model");
  return parts.length ? parts.join(", ") : "the case as it is";
}

/** Write what differs from the case into the address. */
function writeAddress() {
  // A space goes before a letter only: "0.038 1/um^2" is no "0.0381/um^2".
  const short = (text) => String(text).replace(/^(\S*\d) (?=[a-zA-Zµ])/, "$1");
  const parts = Object.entries(pageState.values).map(([key, text]) => `${key}=${encodeURIComponent(short(text))}`);
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
