// Begin: connect what arrives with what is shown.

/** Take what the server says first; after a broken line what is wished is asked for again. */
function greeted(hello) {
  const again = bench.hello !== null;
  Object.assign(server, { connected: true });
  bench.hello = hello;
  if (!again) {
    document.title = `${hello.title} – workbench`;
    document.querySelector("h1").textContent = hello.title;
    makeControls();
    makeViews();
    const wanted = readAddress();
    const known = Object.entries(wanted).filter(([key]) => bench.controls.has(key));
    // The first run is of what is left of it, and does not take this away.
    if (known.length < Object.keys(wanted).length) trouble("The address names keys that this case does not have.", 2);
    bench.values = Object.fromEntries(known);
  }
  bench.pins.forEach(({ run }) => line.say({ type: "pin", run }));
  bench.tell("wished");
  wishes.send(true);
}

/** Ask before something long is run; what is shown stays. */
function askFirst({ number: mine, message }) {
  if (mine !== wishes.awaited) return;
  wishes.awaited = 0;
  const box = document.getElementById("ask");
  box.querySelector("span").textContent = message;
  box.hidden = false;
  box.querySelector("[data-yes]").onclick = () => wishes.send(true, true);
  box.querySelector("[data-no]").onclick = () => {
    box.hidden = true;
    bench.gesture(bench.shown ? bench.shown.values : {});
  };
  tellState();
}

function stateArrived({ state, message, seconds, share = null }) {
  Object.assign(server, { state, message, seconds, share });
  tellState();
}

line.hear = {
  hello: greeted,
  state: stateArrived,
  run: (run) => wishes.arrived(run),
  refused: (message) => wishes.refused(message),
  ask: askFirst,
  error: ({ message }) => trouble(message),
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

bench.on("wished", drawTracks);
bench.on("wished", forgetSlope);
bench.on("shown", tellState);
bench.on("shown", tellNumbers);
bench.on("shown", tellPins);
bench.on("shown", giveViews);
bench.on("shown", () => {
  fillControls();
  drawTracks();
  const key = focusedSlider();
  if (key && slope.key !== key) askSlope(key);
});

for (const [id, act] of Object.entries({ undo: bench.undo, redo: bench.redo, pin: togglePin, stop: wishes.stop, "take-away": openAway })) {
  document.getElementById(id).addEventListener("click", act);
}
document.getElementById("all").addEventListener("click", (event) => {
  chosen.all = !chosen.all;
  event.target.setAttribute("aria-pressed", String(chosen.all));
  tellNumbers();
});
document.getElementById("help").addEventListener("click", () => document.getElementById("keys").showModal());
addEventListener("hashchange", () => {
  const values = Object.fromEntries(Object.entries(readAddress()).filter(([key]) => bench.controls.has(key)));
  if (bench.hello && !sameValues(values, bench.values)) bench.gesture(values);
});
theme.dark.addEventListener("change", drawTracks);
startKeyboard();
clock.start();
line.open();
