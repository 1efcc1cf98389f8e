// Begin: connect what arrives with what is shown.

/** Take the first message of the server; after a lost connection the run is requested again. */
function greeted(hello) {
  const first = pageState.hello === null;
  Object.assign(server, { connected: true, edit: "" });
  // An edited model is described again when it is requested.
  if (!pageState.values[EDIT]) adopt(hello);
  if (first) {
    const wanted = readAddress();
    const known = Object.entries(wanted).filter(([key]) => isKnown(key, wanted));
    // The first run is of what is left of it, and does not take this away.
    if (known.length < Object.keys(wanted).length) showError("The address names keys that this case does not have.", 2);
    pageState.values = Object.fromEntries(known);
  }
  pageState.pins.forEach(({ run }) => line.say({ type: "pin", run }));
  pageState.notify("requested");
  requests.send(true);
}

/** Tell whether a key of the address is one of the case; those of an edited model are checked by the server. */
function isKnown(key, wanted) {
  return EDIT in wanted || pageState.controls.has(key);
}

/** Make the page of the case that was described. */
function describe() {
  const { title } = pageState.hello;
  document.title = `${title} – workbench`;
  document.querySelector("h1").textContent = title;
  makeControls();
  makeViews();
}

/** Take the description of a case; what was shown of another model goes. */
function adopt({ type: _, ...hello }) {
  const edit = editText(hello.edit);
  Object.assign(server, { edit });
  if (edit === pageState.built) return;
  pageState.pins.forEach(({ run }) => line.say({ type: "unpin", run: run.run }));
  Object.assign(pageState, { hello, built: edit, shown: null, trail: [], pins: [] });
  Object.assign(chosen, { curve: null, against: null });
  sweeps.clear();
  forgetSlope();
  describe();
  model.arrived();
}

/** Ask before something long is run; what is shown stays. */
function askFirst({ number: mine, message }) {
  if (mine !== requests.awaited) return;
  requests.awaited = 0;
  const box = document.getElementById("ask");
  box.querySelector("span").textContent = message;
  box.hidden = false;
  box.querySelector("[data-yes]").onclick = () => requests.send(true, true);
  box.querySelector("[data-no]").onclick = () => {
    box.hidden = true;
    pageState.gesture(pageState.shown ? pageState.shown.values : {});
  };
  tellState();
}

function stateArrived({ state, message, seconds, share = null }) {
  Object.assign(server, { state, message, seconds, share });
  tellState();
}

let opened = false;

/** Play the first run until the reader acts; not for readers who prefer reduced motion. */
function playAtFirst() {
  if (opened || !clock.frames) return;
  opened = true;
  if (clock.playing || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  clock.toggle();
  const acts = ["pointerdown", "keydown", "input"];
  const act = ({ target, key }) => {
    for (const name of acts) removeEventListener(name, act, true);
    const ofClock = key === " " || (target instanceof Element && target.closest(".clock"));
    if (clock.playing && !ofClock) clock.toggle();
  };
  for (const name of acts) addEventListener(name, act, true);
}

line.hear = {
  hello: greeted,
  model: adopt,
  state: stateArrived,
  run: (run) => requests.arrived(run),
  refused: (message) => requests.refused(message),
  ask: askFirst,
  error: ({ message }) => showError(message),
  sweep: sweepArrived,
  slope: slopeArrived,
  down: () => {
    server.connected = false;
    for (const sweep of sweeps.values()) sweep.finished = true;
    slope.finished = true;
    tellState();
    drawTracks();
  },
};

pageState.on("requested", drawTracks);
pageState.on("requested", forgetSlope);
pageState.on("shown", tellState);
pageState.on("shown", tellNumbers);
pageState.on("shown", tellPins);
pageState.on("shown", giveViews);
pageState.on("shown", () => {
  fillControls();
  drawTracks();
  const key = focusedSlider();
  if (key && slope.key !== key) askSlope(key);
});
pageState.on("shown", playAtFirst);

for (const [id, act] of Object.entries({ undo: pageState.undo, redo: pageState.redo, pin: togglePin, stop: requests.stop, "take-away": openAway, model: model.open })) {
  document.getElementById(id).addEventListener("click", act);
}
document.getElementById("all").addEventListener("click", (event) => {
  chosen.all = !chosen.all;
  event.target.setAttribute("aria-pressed", String(chosen.all));
  tellNumbers();
});
document.getElementById("help").addEventListener("click", () => document.getElementById("keys").showModal());
addEventListener("hashchange", () => {
  const wanted = readAddress();
  const values = Object.fromEntries(Object.entries(wanted).filter(([key]) => isKnown(key, wanted)));
  if (pageState.hello && !sameValues(values, pageState.values)) pageState.gesture(values);
});
theme.dark.addEventListener("change", drawTracks);
startControls();
model.connect();
startKeyboard();
clock.start();
line.open();
