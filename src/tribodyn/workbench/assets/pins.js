// Pinned runs: kept, compared with, drawn behind the run that is shown.

/** Pin the run that is shown, or let it go where it is pinned. */
function togglePin() {
  const { shown } = pageState;
  if (!shown) return;
  if (pageState.pins.some((run) => run.run === shown.run)) return letGo(shown);
  if (pageState.pins.length >= pageState.hello.limits.pins) {
    return showError(`At most ${pageState.hello.limits.pins} runs can be pinned: let one go first.`);
  }
  pageState.pins = [...pageState.pins, shown];
  chosen.against = shown.run;
  line.say({ type: "pin", run: shown.run });
  return afterPins();
}

/** Let a pinned run go. */
function letGo(run) {
  pageState.pins = pageState.pins.filter((one) => one.run !== run.run);
  line.say({ type: "unpin", run: run.run });
  afterPins();
}

function afterPins() {
  tellPins();
  tellNumbers();
  giveViews();
}

/** Write the pinned runs with what can be done with each. */
function tellPins() {
  document.getElementById("pin").textContent = pageState.pins.some((run) => run.run === pageState.shown?.run) ? "Unpin" : "Pin";
  const against = compared();
  const rows = pageState.pins.map((run) => {
    const name = valuesInWords(run.values);
    const choose = () => {
      chosen.against = run.run;
      afterPins();
    };
    return element(
      "div",
      { class: "pinned" },
      button(name, choose, { "aria-pressed": String(run === against), title: "Compare with this run" }),
      button("Go there", () => pageState.gesture(run.values), { "aria-label": `Go to ${name}` }),
      button("Let go", () => letGo(run), { "aria-label": `Let ${name} go` }),
    );
  });
  document.getElementById("pins").replaceChildren(...rows);
}
