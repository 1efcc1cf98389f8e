// Sensitivities: by how many percent each number changes when the key in focus changes by one percent.

/** Time that a slider has the focus, and nothing moves, before its slopes are asked for [ms]. */
const PATIENCE = 700;

const slope = { key: "", number: -1, done: 0, of: 0, finished: true, results: {}, due: null };

/** Ask for the slopes of a key when its slider rests in focus. */
function askSlope(key) {
  clearTimeout(slope.due);
  slope.due = setTimeout(() => {
    if (focusedSlider() !== key || slope.key === key || !pageState.shown) return;
    if (requests.awaited) return askSlope(key);
    requests.number += 1;
    Object.assign(slope, { key, number: requests.number, done: 0, of: 0, finished: false, results: {} });
    line.say({ type: "slope", number: slope.number, key, values: parted(pageState.values).values });
    return tellNumbers();
  }, PATIENCE);
}

/** Return the key of the slider that has the focus. */
function focusedSlider() {
  const place = document.activeElement;
  return place?.type === "range" ? place.closest(".control")?.dataset.key : undefined;
}

/** Forget slopes that are of other values. */
function forgetSlope() {
  if (!slope.key) return;
  Object.assign(slope, { key: "", number: -1, results: {} });
}

function slopeArrived({ number: mine, done, of, finished, results }) {
  if (mine !== slope.number) return;
  Object.assign(slope, { done, of, finished, results });
  tellNumbers();
}

/** Say of which key the slopes are, and how far they are. */
function slopeInWords() {
  if (!slope.key) return "";
  const progress = slope.finished ? "" : `: ${slope.done} of ${slope.of || "…"} runs`;
  return `Slopes in % per % of ${slope.key}, fitted over runs within ±10 %, with their standard errors; none seen where scatter hides them${progress}`;
}

/** Return the slope of a number and its scatter in words. */
function slopeText(name) {
  const found = slope.key && slope.results[name];
  if (!found) return "";
  const hidden = Math.abs(found.scatter) > Math.abs(found.slope);
  return hidden ? "none seen" : `${number(found.slope, 2)} ± ${number(found.scatter, 1)}`;
}
