// The key results of the run that is shown, beside a pinned one; of peaks the range over the last runs.

/** Numbers that are shown before they are asked for, the robust ones and those that matter most: beside controls, below them. */
const MOST_AT_FIRST = { wide: 7, narrow: 4 };
/** Energy residual above which the the warnings are unfolded [%]. */
const MOST_MISSED = 1;
const chosen = { curve: null, all: false, against: null };

/** Return a key result in words. */
function resultText(value, digits) {
  if (value === undefined || value === null) return "—";
  return Number.isInteger(value) && Math.abs(value) < 1e6 ? String(value).replace("-", "−") : number(value, digits || 3);
}

/** Return by how much a number differs from that of another run, in percent. */
function difference(value, other, digits) {
  if (typeof value !== "number" || typeof other !== "number" || !other) return "";
  const share = (100 * (value - other)) / Math.abs(other);
  if (Math.abs(share) <= 50 * 10 ** (1 - digits)) return "no difference";
  return `${share > 0 ? "+" : ""}${number(share, Math.abs(share) >= 100 ? 3 : 2)} %`;
}

/** Return the smallest and the largest of a number over the run shown and the trail, in words. */
function rangeText({ name, digits }) {
  const values = [...pageState.trail, pageState.shown].map((run) => run.results[name]).filter(Number.isFinite);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  if (values.length < 2 || low === high) return "";
  return `${resultText(low, digits)} … ${resultText(high, digits)}`;
}

/** Return the largest energy residual of a run [%]; 0 where it has none. */
function energyMissed(results) {
  const residuals = Object.keys(results).filter((name) => name.endsWith("energy_residual_percent"));
  return Math.max(0, ...residuals.map((name) => results[name]));
}

/** Say what an energy balance that does not close means, and what to do. */
function energyReason(missed) {
  return `The energy balance misses ${number(missed, 2)} %: forces and heat may be wrong by as much. Lower solver.rtol.`;
}

/** Return the run that numbers are compared with. */
function compared() {
  return pageState.pins.find((run) => run.run === chosen.against) ?? pageState.pins[pageState.pins.length - 1];
}

/** Write the numbers of the run that is shown. */
function tellNumbers() {
  const { shown } = pageState;
  if (!shown) return;
  document.getElementById("whose").textContent = `Numbers and pictures of: ${valuesInWords(shown.values)}`;
  showWarnings();
  const known = pageState.hello.results.filter(({ name }) => name in shown.results);
  chosen.curve ??= known.find(({ robust }) => robust)?.name;
  const focused = document.activeElement?.dataset.number;
  const table = document.querySelector("#numbers table");
  table.classList.toggle("doubtful", Boolean(shown.doubtful));
  for (const [k, robust] of [true, false].entries()) {
    const rows = known.filter((one) => one.robust === robust);
    table.tBodies[k].replaceChildren(...(chosen.all ? rows : atFirst(rows, robust)).map(numberRow));
  }
  document.getElementById("about-peaks").hidden = !table.tBodies[1].rows.length;
  if (focused) document.querySelector(`[data-number="${focused}"]`)?.focus();
  document.getElementById("slopes").textContent = slopeInWords();
}

/** Return the numbers that are shown before all are asked for. */
function atFirst(rows, robust) {
  if (!robust) return rows.filter(({ key }) => key);
  return rows.filter(({ key, name }) => key || !Number.isInteger(pageState.shown.results[name])).slice(0, MOST_AT_FIRST[isNarrow() ? "narrow" : "wide"]);
}

/** Return the row of a number; a press of its name chooses it for the curves of sweeps. */
function numberRow(one) {
  const { name, label, unit, meaning, digits, robust } = one;
  const value = pageState.shown.results[name];
  const choose = () => {
    chosen.curve = name;
    tellNumbers();
    drawTracks();
  };
  const about = { "aria-pressed": String(chosen.curve === name), "data-number": name, title: meaning };
  const ends = pageState.shown.intervals?.[name];
  const words = ends ? `${number(ends[0], 2)} to ${number(ends[1], 2)}` : resultText(value, digits);
  const range = rangeText(one);
  const assumed = pageState.shown.assumed?.includes(name) ? " assumed" : "";
  const main = element("td", { class: `value${assumed}` }, robust ? words : range || words, element("span", { class: "unit" }, ` ${unit}`));
  const change = difference(value, compared()?.results[name], digits);
  const rest = [["from pinned", change], robust ? ["last runs", range] : ["this run", range && words], ["slope", slopeText(name)]];
  const cells = rest.map(([what, text]) => element("td", { "data-what": what }, text));
  return element("tr", { "data-row": name }, element("th", { scope: "row" }, button(label, choose, about)), main, ...cells);
}

/** Show the warnings of the run. */
function showWarnings() {
  const { failure, warnings, number: mine } = pageState.shown;
  if (mine >= requests.erroneous) showError(failure && `This run is not complete: ${failure}`, mine);
  const list = document.getElementById("warnings");
  const missed = energyMissed(pageState.shown.results);
  const reasons = missed > MOST_MISSED ? [energyReason(missed), ...warnings] : warnings;
  list.hidden = !reasons.length;
  if (missed > MOST_MISSED) list.open = true;
  list.querySelector("summary").textContent = `Why these numbers may be wrong (${reasons.length})`;
  list.querySelector("ul").replaceChildren(...reasons.map((text) => element("li", {}, text)));
}
