// Runs that are wished: sent as fast as they can be drawn, shown with the values that they were made with.

/** Least time between two wishes of a drag [ms]; the server reads 60 messages a second. */
const APART = 20;

/** States of the server in which a run, or what it needs, is under way. */
const STOPPABLE = new Set(["running", "compiling", "waiting"]);

/** What the server says of itself where nothing is under way. */
const READY = { state: "ready", message: "", seconds: null, share: null };

const wishes = {
  number: 0,
  /** Number of the wish that is waited for; none while what is shown is what is wished. */
  awaited: 0,
  /** Number and values of the last wish that was no look at a point of a sweep. */
  own: 0,
  /** Number of the wish that the trouble shown is of: a run of an earlier one does not take it away. */
  troubled: 0,
  sent: null,
  last: 0,
  due: null,
  /** Keys that were typed in, by the number of their wish, with what was wished before. */
  typed: new Map(),

  /** Ask for the run of what is wished now. */
  send(rest, agreed = false) {
    clearTimeout(wishes.due);
    const early = wishes.last + APART - performance.now();
    if (!rest && early > 0) {
      wishes.due = setTimeout(() => wishes.send(false), early);
      return;
    }
    wishes.last = performance.now();
    document.getElementById("ask").hidden = true;
    wishes.sent = bench.values;
    wishes.ask(bench.values, rest, agreed);
    wishes.own = wishes.number;
  },

  /** Ask for the run of some values. */
  ask(values, rest, agreed = false) {
    wishes.number += 1;
    wishes.awaited = wishes.number;
    line.say({ type: "run", number: wishes.number, values, rest, agreed });
    tellState();
  },

  /** Draw a run, and say so with the next picture of the screen: faster than that none need be sent. */
  arrived(run) {
    wishes.typed.delete(run.number);
    if (server.state === "running") Object.assign(server, READY);
    if (run.number === wishes.awaited) wishes.awaited = 0;
    // From here on values are written as the case model writes them: "0.03 mm" as "30 um".
    if (run.number === wishes.own && bench.values === wishes.sent) bench.values = wishes.sent = run.values;
    bench.show(run);
    requestAnimationFrame(() => line.say({ type: "drawn", number: run.number }));
  },

  /** Give up the run that is waited for; what is shown is wished again. */
  stop() {
    if (!wishes.awaited) return;
    line.say({ type: "cancel", number: wishes.awaited });
    wishes.awaited = 0;
    Object.assign(server, READY);
    if (bench.shown && !sameValues(bench.values, bench.shown.values)) bench.gesture(bench.shown.values);
    tellState();
  },

  /** Take back what cannot be, and say why beside it; what is shown stays. */
  refused({ number, faults, message }) {
    if (number === wishes.awaited) wishes.awaited = 0;
    const typed = wishes.typed.get(number);
    wishes.typed.delete(number);
    const told = faults.filter(({ key, message: text }) => complain(key ?? typed?.key, text));
    if (told.length < faults.length) trouble(message, number);
    if (typed && bench.values[typed.key] === typed.text) wishes.takeBack(typed);
    tellState();
  },

  /** Forget a value that was typed and refused; its text stays in its box. */
  takeBack({ before, key }) {
    bench.values = before;
    if (bench.past.length && sameValues(bench.past[bench.past.length - 1], before)) bench.past.pop();
    writeAddress();
    bench.tell("wished");
    keepText(key);
  },
};

const server = { ...READY, state: "loading", connected: false };

/** Say what is waited for, and whose the numbers are meanwhile. */
function tellState() {
  const busy = wishes.awaited > 0;
  write(document.getElementById("state"), stateInWords(busy));
  document.getElementById("stop").hidden = !(busy && server.connected && STOPPABLE.has(server.state));
  document.documentElement.classList.toggle("waiting", busy || !bench.shown);
}

function stateInWords(busy) {
  if (!server.connected) return "The server does not answer; trying again. What is shown stays usable.";
  const { state, message, seconds, share } = server;
  if (state === "failed") return message;
  if (!bench.shown && busy && !message) return "The first run is on its way.";
  if (state === "ready" || (state === "running" && !busy)) return "";
  const parts = [message];
  if (share !== null) parts.push(`${Math.round(100 * share)} %`);
  if (seconds !== null) parts.push(`about ${number(seconds, 2)} s`);
  if (bench.shown && busy) parts.push("what is shown is of the run before");
  return parts.filter(Boolean).join(" · ");
}

/** Show a trouble that belongs to no key; an empty text takes it away, as does the run of a later wish. */
function trouble(text, number = wishes.number) {
  wishes.troubled = number;
  const box = document.getElementById("trouble");
  write(box, text);
  box.hidden = !text;
}
