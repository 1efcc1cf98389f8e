// Points of a sweep as lines across parallel axes; each axis runs from 0 to 1.

const SHADES = 6;
/** Least distance of axes [px]: on a narrow screen the figure scrolls sideways. */
const AXIS_WIDTH = 84;
/** How near the pointer must come to where a line meets an axis [px]. */
const NEAR = 30;
const LOWEST = -0.12;
const HIGHEST_TEXT = 1.32;
/** Dash of the lines of points whose numbers are not to be used [px]. */
const NOT_TO_USE = [5, 4];

widgets.parallel = (box) => {
  const area = plotArea(scroller(box), 420, {}, "The table of points below holds the same and the links.");
  const sheet = new Sheet(area);
  const readout = element("p", { class: "readout", "aria-live": "polite" }, "Point at a line to see its numbers.");
  box.append(readout);
  const choices = tools(box);
  const state = { data: null, axes: [], pointed: -1 };

  const take = (data) => {
    state.data = data;
    const shown = new Set(data.shown);
    const choose = () => {
      state.axes = data.axes.filter(({ name }) => shown.has(name)).map((axis) => ({ ...axis, span: spanOf(axis) }));
    };
    choose();
    const changed = () => {
      choose();
      paint();
    };
    choices.replaceChildren(...data.axes.map((axis) => axisButton(axis, shown, changed)));
  };
  const paint = () => {
    area.style.minWidth = `${AXIS_WIDTH * state.axes.length}px`;
    const pen = sheet.fresh();
    const { clientWidth: width, clientHeight: height } = area;
    state.x = scaleOf(-0.5, state.axes.length - 0.5, 8, width - 8);
    state.y = scaleOf(LOWEST, HIGHEST_TEXT, height - 8, 8);
    drawUprights(pen, state);
    drawPoints(pen, state);
    area.plotted = state;
  };
  area.addEventListener("pointermove", (event) => {
    const pointed = pointNear(state, pointerAt(area, event));
    if (pointed === state.pointed) return;
    state.pointed = pointed;
    if (pointed >= 0) readout.textContent = inWords(state.data, state.axes, pointed);
    paint();
  });
  area.addEventListener("click", (event) => {
    const pointed = pointNear(state, pointerAt(area, event));
    if (pointed < 0) return;
    const point = state.data.points[pointed];
    if (point.link) location.assign(point.link);
    else readout.textContent = `${point.name}: no report yet; tribodyn report DIR --points makes it`;
  });
  return { take, paint };
};

/** Make the button that shows or hides an axis. */
function axisButton(axis, shown, changed) {
  const made = button(
    axis.label,
    () => {
      if (!shown.delete(axis.name)) shown.add(axis.name);
      made.setAttribute("aria-pressed", String(shown.has(axis.name)));
      changed();
    },
    { "aria-pressed": String(shown.has(axis.name)) },
  );
  return made;
}

/** Return a part of a box that scrolls sideways. */
function scroller(box) {
  const made = element("div", { class: "wide" });
  box.append(made);
  return made;
}

/** Return smallest and largest value of an axis; never the same. */
function spanOf(axis) {
  const finite = axis.values.filter(Number.isFinite);
  const [low, high] = [Math.min(...finite), Math.max(...finite)];
  return high > low ? [low, high] : [low - 0.5, low + 0.5];
}

/** Return where a point lies on each axis, 0 to 1; NaN where it has no number. */
function placesOf({ axes }, point) {
  return axes.map(({ values, span }) => (values[point] - span[0]) / (span[1] - span[0]));
}

/** Return the point whose line meets an axis near a place [px], or −1. */
function pointNear(state, [x, y]) {
  let [best, least] = [-1, NEAR];
  state.data.points.forEach((_, point) => {
    placesOf(state, point).forEach((place, k) => {
      const far = Math.hypot(state.x.at(k) - x, state.y.at(place) - y);
      if (far < least) [best, least] = [point, far];
    });
  });
  return best;
}

/** Return a point in words: its place on every axis shown. */
function inWords(data, axes, point) {
  const parts = axes.map((axis) => `${axis.label} = ${axis.texts[point]}`);
  const { name, caution } = data.points[point];
  return `${name}: ${parts.join(", ")}${caution ? `. ${caution}` : ""}`;
}

/** Draw the lines of all points, those not to be used first, the one pointed at last and wider. */
function drawPoints(pen, state) {
  const { points } = state.data;
  const order = points.map((_, point) => point).sort((a, b) => Boolean(points[b].caution) - Boolean(points[a].caution));
  if (state.pointed >= 0) order.push(state.pointed);
  order.forEach((point, n) => {
    const places = placesOf(state, point);
    const colour = colourOf(state, point);
    const wide = n === points.length;
    Object.assign(pen, { strokeStyle: colour, fillStyle: colour, lineWidth: wide ? 4 : 1.6, globalAlpha: wide ? 1 : 0.85 });
    pen.setLineDash(points[point].caution ? NOT_TO_USE : []);
    drawCurve(pen, places.map((_, k) => k), places, state.x, state.y);
    pen.setLineDash([]);
    places.forEach((place, k) => {
      if (Number.isFinite(place)) drawMark(pen, "circle", state.x.at(k), state.y.at(place), 2.4);
    });
  });
  pen.globalAlpha = 1;
}

/** Return the colour of a point: a shade by its place on the first axis, grey where its numbers are not to be used. */
function colourOf(state, point) {
  if (state.data.points[point].caution) return theme.colour("quiet");
  return shade(Math.min(SHADES - 1, Math.floor(SHADES * (placesOf(state, point)[0] || 0))));
}

/** Return the colour of a shade, light or dark enough to be seen on the page. */
function shade(k) {
  const stops = theme.loads();
  return stops[2 + Math.round((k * (stops.length - 3)) / (SHADES - 1))];
}

/** Draw upright axes with their names and their ends, or what they name, written beside them. */
function drawUprights(pen, { axes, x, y }) {
  const write = (text, k, place, base, colour, down = 0) => {
    Object.assign(pen, { textBaseline: base, fillStyle: theme.colour(colour) });
    pen.fillText(text, x.at(k), y.at(place) + down);
  };
  Object.assign(pen, { font: theme.font(TEXT), textAlign: "center" });
  axes.forEach((axis, k) => {
    upright(pen, { top: y.at(1), bottom: y.at(0) }, x.at(k), "quiet", []);
    const lines = wrapped(axis.label);
    lines.forEach((line, n) => write(line, k, 1.09, "bottom", "ink", -13 * (lines.length - 1 - n)));
    for (const [place, text] of marksOf(axis)) {
      if (place === 0) write(text, k, -0.03, "top", "quiet");
      else if (place === 1) write(text, k, 1.03, "bottom", "quiet");
      else write(text, k, place, "middle", "quiet");
    }
  });
}

/** Return the marks of an axis: names, or the two ends. */
function marksOf(axis) {
  const [low, high] = axis.span;
  if (axis.categories.length) return axis.categories.map((name, k) => [(k - low) / (high - low), name]);
  return [
    [0, number(low)],
    [1, number(high)],
  ];
}

/** Return a label in short lines. */
function wrapped(label) {
  const lines = [""];
  for (const word of label.replaceAll(".", ". ").split(" ")) {
    if ((lines[lines.length - 1] + word).length > 15 && lines[lines.length - 1]) lines.push("");
    lines[lines.length - 1] += lines[lines.length - 1] && !lines[lines.length - 1].endsWith(".") ? ` ${word}` : word;
  }
  return lines;
}
