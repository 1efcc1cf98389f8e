// Points of a sweep as lines across parallel axes; each axis runs from 0 to 1.

const SHADES = 6;
/** Least distance of axes [px]: on a narrow screen the figure scrolls sideways. */
const AXIS_WIDTH = 84;

widgets.parallel = (box, data) => {
  const shown = new Set(data.shown);
  const area = plotArea(scroller(box), 420, {}, "The table of points below holds the same and the links.");
  const readout = element("p", { class: "readout", "aria-live": "polite" }, "Point at a line to see its numbers.");
  const choices = data.axes.map((axis) => {
    const choice = button(
      axis.label,
      () => {
        if (!shown.delete(axis.name)) shown.add(axis.name);
        choice.setAttribute("aria-pressed", String(shown.has(axis.name)));
        paint();
      },
      { "aria-pressed": String(shown.has(axis.name)) },
    );
    return choice;
  });
  box.append(readout);
  tools(box, ...choices);

  const axes = () => data.axes.filter((axis) => shown.has(axis.name)).map((axis) => ({ ...axis, span: spanOf(axis) }));
  const pointOf = (event) => event.points[0].customdata;
  const paint = () => {
    const first = !area.data;
    area.style.minWidth = `${AXIS_WIDTH * axes().length}px`;
    const done = react(area, parallelTraces(data, axes()), parallelLayout(axes()));
    if (!first) return;
    done.then(() => {
      area.on("plotly_hover", (event) => {
        readout.textContent = inWords(data, axes(), pointOf(event));
      });
      area.on("plotly_click", (event) => {
        const point = data.points[pointOf(event)];
        if (point.link) location.assign(point.link);
        else readout.textContent = `${point.name}: no report yet; tribodyn report DIR --points makes it`;
      });
    });
  };
  return { paint, show: null };
};

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

/** Return a point in words: its place on every axis shown. */
function inWords(data, axes, point) {
  const parts = axes.map((axis) => `${axis.label} = ${axis.texts[point]}`);
  return `${data.points[point].name}: ${parts.join(", ")}`;
}

/** Return the points in shades of the first axis, each shade one trace with a gap after every point. */
function parallelTraces(data, axes) {
  const groups = Array.from({ length: SHADES }, () => ({ x: [], y: [], customdata: [] }));
  data.points.forEach((_, point) => {
    const places = axes.map(({ values, span }) => (values[point] - span[0]) / (span[1] - span[0]));
    if (!places.some(Number.isFinite)) return;
    const group = groups[Math.min(SHADES - 1, Math.floor(SHADES * (places[0] || 0)))];
    places.forEach((place, k) => {
      group.x.push(k);
      group.y.push(Number.isFinite(place) ? place : null);
      group.customdata.push(point);
    });
    group.x.push(null);
    group.y.push(null);
    group.customdata.push(null);
  });
  return groups.map((group, k) => ({
    ...group,
    type: "scatter",
    mode: "lines+markers",
    line: { color: shade(k), width: 1.6 },
    marker: { size: 6, color: shade(k) },
    opacity: 0.85,
    hoverinfo: "none",
    connectgaps: false,
  }));
}

/** Return the colour of a shade, light or dark enough to be seen on the page. */
function shade(k) {
  const stops = theme.scale();
  return stops[2 + Math.round((k * (stops.length - 3)) / (SHADES - 1))][1];
}

/** Return upright axes with their ends, or their names, written beside them. */
function parallelLayout(axes) {
  const upright = axes.map((_, k) => ({
    type: "line",
    x0: k,
    x1: k,
    y0: 0,
    y1: 1,
    layer: "below",
    line: { color: theme.colour("quiet"), width: 1 },
  }));
  const texts = axes.flatMap((axis, k) => [
    { x: k, y: 1.09, text: wrapped(axis.label), yanchor: "bottom", size: 11, colour: "ink" },
    ...marksOf(axis).map(([place, text]) => ({
      x: k,
      y: place === 0 ? -0.03 : place === 1 ? 1.03 : place,
      text: literal(text),
      yanchor: place === 0 ? "top" : place === 1 ? "bottom" : "middle",
      size: 11,
      colour: "quiet",
    })),
  ]);
  return {
    xaxis: { visible: false, range: [-0.5, axes.length - 0.5], fixedrange: true },
    yaxis: { visible: false, range: [-0.12, 1.32], fixedrange: true },
    hovermode: "closest",
    hoverdistance: 30,
    dragmode: false,
    shapes: upright,
    annotations: texts.map(({ x, y, text, yanchor, size, colour }) => ({
      x,
      y,
      text,
      yanchor,
      showarrow: false,
      font: { size, color: theme.colour(colour) },
    })),
    margin: { l: 8, r: 8, t: 8, b: 8 },
  };
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
  return lines.map(literal).join("<br>");
}
