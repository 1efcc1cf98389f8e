// A sweep of one key: its answer stands as a curve in the track of the slider, each point a run to look at.

/** How near the pointer must come to a point, along the track [px]. */
const NEAR_POINT = 20;

/** Sweeps by key: {number, points, of, finished, values}. */
const sweeps = new Map();

/** Return the button that sweeps a control, in a list; none where there is nothing to go over. */
function sweepButton({ key, label, least, choices, kind }) {
  if (least === null && !choices.length && kind !== "switch") return [];
  return [button("Sweep", () => toggleSweep(key), { class: "sweep", "aria-label": `Sweep ${label}` })];
}

/** Begin a sweep of a key over its track, or give up the one that runs. */
function toggleSweep(key) {
  const running = sweeps.get(key);
  if (running && !running.finished) {
    line.say({ type: "cancel", number: running.number });
    sweeps.set(key, { ...running, finished: true });
    return drawTracks();
  }
  for (const [other, sweep] of sweeps) if (!sweep.finished) sweeps.set(other, { ...sweep, finished: true });
  const { least, greatest, unit } = pageState.controls.get(key);
  requests.number += 1;
  const ends = {};
  if (least !== null) {
    const points = Number(document.getElementById("points").value);
    Object.assign(ends, { from: `${least} ${unit}`.trim(), to: `${greatest} ${unit}`.trim(), points });
  }
  const values = { ...pageState.values };
  sweeps.set(key, { number: requests.number, points: [], of: ends.points ?? 0, finished: false, values });
  line.say({ type: "sweep", number: requests.number, key, values: parted(values).values, ...ends });
  return drawTracks();
}

/** Take the points that a sweep has so far. */
function sweepArrived({ number: mine, key, points, of, finished, failure }) {
  const sweep = sweeps.get(key);
  if (!sweep || sweep.number !== mine) return;
  Object.assign(sweep, { points, of, finished });
  if (failure) complain(key, failure);
  drawTracks();
}

/** Return whether a sweep was made with the requested values, apart from its own key. */
function isOfNow(key, { values }) {
  const without = ({ [key]: _, ...rest }) => rest;
  return sameValues(without(values), without(pageState.values));
}

/** Draw all sweeps that there are. */
function drawTracks() {
  for (const [key, sweep] of sweeps) {
    const box = controlAt(key);
    if (!box) continue;
    const readout = box.querySelector(".readout");
    readout.hidden = false;
    box.querySelector(".sweep").textContent = sweep.finished ? "Sweep" : "Stop";
    const old = isOfNow(key, sweep) ? "" : ", of other values";
    readout.textContent = `${numberLabel()}: ${sweep.points.length} of ${sweep.of || "…"} points${old}`;
    const canvas = box.querySelector(".curve");
    if (canvas) drawTrack(canvas, pageState.controls.get(key), sweep);
    else readout.textContent += `: ${choicesInWords(sweep)}`;
  }
}

/** Return the name of the number whose curves are drawn. */
function numberLabel() {
  return pageState.hello.results.find(({ name }) => name === chosen.curve)?.label ?? "";
}

/** Return the chosen number at each choice of a sweep in words. */
function choicesInWords({ points }) {
  const { digits } = pageState.hello.results.find(({ name }) => name === chosen.curve);
  return points.map(({ text, results }) => `${text} ${resultText(results[chosen.curve], digits)}`).join(", ");
}

/** Return the points of a sweep that have the chosen number, with where they are drawn. */
function placedPoints(canvas, { least, greatest }, { points }) {
  const there = points.filter(({ results }) => Number.isFinite(results[chosen.curve]));
  const [low, high] = ends([there.map(({ results }) => results[chosen.curve])]);
  const x = scaleOf(least, greatest, 8, canvas.clientWidth - 8);
  const y = scaleOf(low, high === low ? low + 1 : high, canvas.clientHeight - 5, 5);
  return there
    .map((point) => ({ ...point, x: x.at(point.value), y: y.at(point.results[chosen.curve]) }))
    .sort((a, b) => a.x - b.x);
}

/** Draw the answer of a sweep over the track of its slider. */
function drawTrack(canvas, control, sweep) {
  canvas.classList.toggle("there", sweep.points.length > 0);
  const ratio = devicePixelRatio || 1;
  Object.assign(canvas, { width: canvas.clientWidth * ratio, height: canvas.clientHeight * ratio });
  const pen = canvas.getContext("2d", ON_PROCESSOR);
  pen.scale(ratio, ratio);
  const points = placedPoints(canvas, control, sweep);
  Object.assign(pen, { strokeStyle: theme.colour("accent"), fillStyle: theme.colour("accent"), lineWidth: 1.5 });
  pen.globalAlpha = isOfNow(control.key, sweep) ? 1 : 0.4;
  pen.beginPath();
  for (const { x, y } of points) pen.lineTo(x, y);
  pen.stroke();
  for (const { x, y, run } of points) {
    pen.beginPath();
    pen.arc(x, y, run === pageState.shown?.run ? 4 : 2.2, 0, 2 * Math.PI);
    pen.fill();
  }
}

/** Show the run of a point of a sweep at once; the requested values come back with `lookBack`. */
function lookAt(key, sweep, point) {
  if (sweep.looked === point.text) return;
  sweep.looked = point.text;
  const values = { ...sweep.values, [key]: point.text };
  if (plain(point.text) === plain(pageState.controls.get(key).text)) delete values[key];
  requests.ask(values, false);
}

function lookBack(key) {
  const sweep = sweeps.get(key);
  if (!sweep?.looked) return;
  sweep.looked = "";
  requests.send(true);
}

/** Let a pointer over a curve show the runs of its points; a click takes the value. */
function followSweep(canvas, key) {
  const near = (event) => {
    const sweep = sweeps.get(key);
    if (!sweep) return null;
    const [x] = pointerAt(canvas, event);
    const points = placedPoints(canvas, pageState.controls.get(key), sweep);
    const far = (point) => Math.abs(point.x - x);
    const best = points.reduce((a, b) => (a && far(a) <= far(b) ? a : b), null);
    return best && far(best) <= NEAR_POINT ? { sweep, point: best } : null;
  };
  canvas.addEventListener("pointermove", (event) => {
    const found = near(event);
    if (found) lookAt(key, found.sweep, found.point);
  });
  canvas.addEventListener("pointerleave", () => lookBack(key));
  canvas.addEventListener("click", (event) => {
    const found = near(event);
    if (found) takePoint(key, found.sweep, found.point);
  });
}

/** Request the value of a point. */
function takePoint(key, sweep, { text }) {
  sweep.looked = "";
  pageState.gesture(pageState.changed(key, text));
}

/** Request the value of the next point of the sweep of a key, or of the one before. */
function stepPoint(key, way) {
  const sweep = sweeps.get(key);
  if (!sweep) return;
  const here = parseFloat(pageState.text(key));
  const beyond = sweep.points.filter(({ value }) => way * (value - here) > 1e-9 * Math.abs(here));
  const next = beyond.sort((a, b) => way * (a.value - b.value))[0];
  if (next) takePoint(key, sweep, next);
}
