// Requests for runs: sent as fast as they can be drawn, shown with the values of the run.

/** Least time between two requests of a drag [ms]; the server reads 60 messages a second. */
const APART = 20;

/** States of the server in which a run, or what it needs, is under way. */
const STOPPABLE = new Set(["running", "waiting"]);

/** What the server says of itself where nothing is under way. */
const READY = { state: "ready", message: "", seconds: null, share: null };

const requests = {
  number: 0,
  /** Number of the pending request; 0 while the run shown is the one requested. */
  awaited: 0,
  /** Number of the last request that does not show a point of a sweep. */
  own: 0,
  /** Number of the request that the error shown belongs to: the run of an earlier one leaves it there. */
  erroneous: 0,
  sent: null,
  last: 0,
  due: null,
  /** Keys that were typed in, by the number of their request, with the values before. */
  typed: new Map(),

  /** Request the run of the present values. */
  send(rest, agreed = false) {
    clearTimeout(requests.due);
    const early = requests.last + APART - performance.now();
    if (!rest && early > 0) {
      requests.due = setTimeout(() => requests.send(false), early);
      return;
    }
    requests.last = performance.now();
    document.getElementById("ask").hidden = true;
    requests.sent = pageState.values;
    requests.ask(pageState.values, rest, agreed);
    requests.own = requests.number;
  },

  /** Request the run of some values. */
  ask(values, rest, agreed = false) {
    requests.number += 1;
    requests.awaited = requests.number;
    line.say({ type: "run", number: requests.number, ...parted(values), rest, agreed });
    tellState();
  },

  /** Draw a run, and say so with the next picture of the screen: faster than that none need be sent. */
  arrived(run) {
    requests.typed.delete(run.number);
    if (server.edit) run.values = { ...run.values, [EDIT]: server.edit };
    if (server.state === "running") Object.assign(server, READY);
    if (run.number === requests.awaited) requests.awaited = 0;
    forgive(run.number);
    // From here on values are written as the case model writes them: "0.03 mm" as "30 um".
    if (run.number === requests.own && pageState.values === requests.sent) pageState.values = requests.sent = run.values;
    pageState.show(run);
    requestAnimationFrame(() => line.say({ type: "drawn", number: run.number }));
  },

  /** Cancel the pending run; the values shown are requested again. */
  stop() {
    if (!requests.awaited) return;
    line.say({ type: "cancel", number: requests.awaited });
    requests.awaited = 0;
    Object.assign(server, READY);
    if (pageState.shown && !sameValues(pageState.values, pageState.shown.values)) pageState.gesture(pageState.shown.values);
    tellState();
  },

  /** Take back what cannot be, and say why beside it; what is shown stays. */
  refused({ number, faults, message }) {
    if (number === requests.awaited) requests.awaited = 0;
    if (model.refused(number, faults, message)) return tellState();
    const typed = requests.typed.get(number);
    requests.typed.delete(number);
    const shown = faults.filter(({ key, message: text }) => complain(key ?? typed?.key, text, number));
    if (shown.length < faults.length) showError(message, number);
    if (typed && pageState.values[typed.key] === typed.text) requests.takeBack(typed);
    return tellState();
  },

  /** Forget a value that was typed and refused; its text stays in its box. */
  takeBack({ before, key }) {
    requests.forget(before);
    keepText(key);
  },

  /** Forget the last gesture: the values before it are those requested. */
  forget(before) {
    pageState.values = before;
    if (pageState.past.length && sameValues(pageState.past[pageState.past.length - 1], before)) pageState.past.pop();
    writeAddress();
    pageState.notify("requested");
  },
};

/** State of the server, and the edit of the model that it serves, as JSON. */
const server = { ...READY, state: "loading", connected: false, edit: "" };

/** Say what is waited for, and whose the numbers are meanwhile. */
function tellState() {
  const busy = requests.awaited > 0;
  write(document.getElementById("state"), stateInWords(busy));
  document.getElementById("stop").hidden = !(busy && server.connected && STOPPABLE.has(server.state));
  document.documentElement.classList.toggle("waiting", busy || !pageState.shown);
}

function stateInWords(busy) {
  if (!server.connected) return "The server does not answer; trying again. What is shown stays usable.";
  const { state, message, seconds, share } = server;
  if (state === "failed") return message;
  if (!pageState.shown && busy && !message) return "The first run is on its way.";
  if (state === "ready" || (state === "running" && !busy)) return "";
  const parts = [message];
  if (share !== null) parts.push(`${Math.round(100 * share)} %`);
  if (seconds !== null) parts.push(`about ${number(seconds, 2)} s`);
  if (pageState.shown && busy) parts.push("what is shown is of the run before");
  return parts.filter(Boolean).join(" · ");
}

/** Show an error that belongs to no key; an empty text removes it, as does the run of a later request. */
function showError(text, number = requests.number) {
  requests.erroneous = number;
  const box = document.getElementById("error");
  write(box, text);
  box.hidden = !text;
}
