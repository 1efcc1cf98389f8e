// Pinned runs: kept, compared with, drawn behind the run that is shown.

/** Pin the run that is shown, or let it go where it is pinned. */
function togglePin() {
  const { shown } = bench;
  if (!shown) return;
  if (bench.pins.some((run) => run.run === shown.run)) return letGo(shown);
  if (bench.pins.length >= bench.hello.limits.pins) {
    return trouble(`At most ${bench.hello.limits.pins} runs can be pinned: let one go first.`);
  }
  bench.pins = [...bench.pins, shown];
  chosen.against = shown.run;
  line.say({ type: "pin", run: shown.run });
  return afterPins();
}

/** Let a pinned run go. */
function letGo(run) {
  bench.pins = bench.pins.filter((one) => one.run !== run.run);
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
  document.getElementById("pin").textContent = bench.pins.some((run) => run.run === bench.shown?.run) ? "Unpin" : "Pin";
  const against = compared();
  const rows = bench.pins.map((run) => {
    const name = valuesInWords(run.values);
    const choose = () => {
      chosen.against = run.run;
      afterPins();
    };
    return element(
      "div",
      { class: "pinned" },
      button(name, choose, { "aria-pressed": String(run === against), title: "Compare with this run" }),
      button("Go there", () => bench.gesture(run.values), { "aria-label": `Go to ${name}` }),
      button("Let go", () => letGo(run), { "aria-label": `Let ${name} go` }),
    );
  });
  document.getElementById("pins").replaceChildren(...rows);
}
