// Curves in panels above each other, with a common abscissa that zooms.

const PANEL = { first: 190, more: 150, frame: 64 };

widgets.lines = (box, data) => {
  for (const curve of data.panels.flatMap((panel) => panel.curves)) curve.x ??= data.x;
  const hidden = new Set();
  const count = data.panels.length;
  const height = count === 1 ? 300 : PANEL.frame + PANEL.first + PANEL.more * (count - 1);
  const span = wholeSpan(data);
  let view = [...span];

  const zoom = (factor, shift = 0) => {
    const width = Math.min((view[1] - view[0]) * factor, span[1] - span[0]);
    let begin = 0.5 * (view[0] + view[1]) - 0.5 * width + shift * width;
    begin = Math.max(span[0], Math.min(span[1] - width, begin));
    Plotly.relayout(area, { "xaxis.range": [begin, begin + width] });
  };
  const whole = () => {
    const change = { "xaxis.range": [...span] };
    for (let k = 0; k < count; k++) change[`${axisName("yaxis", k)}.autorange`] = true;
    Plotly.relayout(area, change);
  };
  const keys = {
    "+": () => zoom(0.5),
    "=": () => zoom(0.5),
    "-": () => zoom(2),
    ArrowLeft: () => zoom(1, -0.25),
    ArrowRight: () => zoom(1, 0.25),
    0: whole,
  };
  const area = plotArea(box, height, keys, "Keys: plus and minus zoom, arrows move, 0 shows the whole.");
  const entries = legendEntries(data);
  tools(
    box,
    ...entries.map((entry) => legendButton(entry, hidden, () => paint())),
    element("span", { class: "gap" }),
    button("Zoom in", () => zoom(0.5)),
    button("Zoom out", () => zoom(2)),
    button("Whole", whole),
  );
  const notes = data.panels.filter((panel) => panel.note).map((panel) => `${panel.label}: ${panel.note}`);
  if (notes.length) box.append(element("p", { class: "readout" }, notes.join(" · ")));

  const paint = () => {
    const first = !area.data;
    const done = react(area, lineTraces(data, hidden), linesLayout(data, area, span, height, first));
    if (!first) return;
    done.then(() => {
      area.on("plotly_relayout", () => {
        view = [...area.layout.xaxis.range];
      });
      area.on("plotly_click", (event) => {
        if (data.time && clock.frames) clock.goTo(event.points[0].x / data.scale);
      });
    });
  };
  const show = data.time
    ? () => {
        const last = data.turns.length;
        const now = clock.now() * data.scale;
        Plotly.relayout(area, { [`shapes[${last}].x0`]: now, [`shapes[${last}].x1`]: now });
      }
    : null;
  return { paint, show };
};

/** Return smallest and largest abscissa of all curves. */
function wholeSpan(data) {
  let [low, high] = [Infinity, -Infinity];
  for (const { x } of data.panels.flatMap((panel) => panel.curves)) {
    for (const value of x) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return [low, high];
}

/** Name the k-th axis as the plotting library does. */
function axisName(kind, k) {
  return k === 0 ? kind : `${kind}${k + 1}`;
}

/** Return each name of a curve once, with its look; a curve alone in its panel is named by the panel. */
function legendEntries(data) {
  const entries = new Map();
  const shared = data.panels.filter((panel) => panel.curves.length > 1);
  for (const curve of shared.flatMap((panel) => panel.curves)) {
    if (!entries.has(curve.name)) entries.set(curve.name, curve);
  }
  return [...entries.values()];
}

const DASHES = { solid: "", dash: "7 3", dashdot: "8 3 2 3", dot: "2 3", longdash: "11 4" };

/** Make the button that shows or hides a curve. */
function legendButton(curve, hidden, changed) {
  const space = "http://www.w3.org/2000/svg";
  const swatch = document.createElementNS(space, "svg");
  const line = document.createElementNS(space, "line");
  for (const [name, value] of Object.entries({ width: 26, height: 10, "aria-hidden": "true" })) {
    swatch.setAttribute(name, value);
  }
  const look = { x1: 0, x2: 26, y1: 5, y2: 5, "stroke-width": Math.max(curve.width, 2) };
  for (const [name, value] of Object.entries(look)) line.setAttribute(name, value);
  line.style.stroke = `var(--${curve.colour})`;
  line.setAttribute("stroke-dasharray", DASHES[curve.dash]);
  swatch.append(line);
  const made = button(
    "",
    () => {
      if (!hidden.delete(curve.name)) hidden.add(curve.name);
      made.setAttribute("aria-pressed", String(!hidden.has(curve.name)));
      changed();
    },
    { class: "legend", "aria-pressed": "true" },
  );
  made.append(swatch, curve.name);
  return made;
}

/** Return the traces of all panels. */
function lineTraces(data, hidden) {
  return data.panels.flatMap((panel, k) =>
    panel.curves.map((curve) => ({
      type: "scatter",
      mode: "lines",
      name: literal(curve.name),
      x: curve.x,
      y: curve.y,
      xaxis: "x",
      yaxis: k === 0 ? "y" : `y${k + 1}`,
      visible: !hidden.has(curve.name),
      line: { color: theme.colour(curve.colour), dash: curve.dash, width: curve.width },
      hovertemplate: data.time ? "%{y:.4~g}" : "%{x:.4~g}, %{y:.4~g}",
      connectgaps: false,
    })),
  );
}

/** Return the layout: panels from top to bottom, their quantity written above each. */
function linesLayout(data, area, span, height, first) {
  const count = data.panels.length;
  const gap = count === 1 ? 0 : 34 / (height - PANEL.frame);
  const share = (1 - gap * (count - 1)) / count;
  const layout = {
    height,
    hovermode: data.time ? "x unified" : "closest",
    xaxis: {
      ...theme.axis(data.x_label),
      anchor: axisName("y", count - 1),
      range: first ? [...span] : [...area.layout.xaxis.range],
      hoverformat: ".4f",
      unifiedhovertitle: { text: `t = %{x} ${data.unit}` },
    },
    annotations: [],
    shapes: [...data.turns.map(turnLine), cursorLine(data)],
    margin: { l: 48, r: 12, t: 26, b: 42 },
  };
  data.panels.forEach((panel, k) => {
    const top = 1 - k * (share + gap);
    const name = axisName("yaxis", k);
    layout[name] = { ...theme.axis(""), domain: [Math.max(0, top - share), top], nticks: 6 };
    const old = first ? null : area.layout[name];
    const limits = old ? (old.autorange ? [] : [...old.range]) : panel.limits;
    if (limits.length) layout[name].range = limits;
    layout.annotations.push(heading(panel.label, top));
  });
  return layout;
}

/** Return the text above a panel. */
function heading(text, y) {
  return {
    text: literal(text),
    x: 0,
    y,
    xref: "paper",
    yref: "paper",
    xanchor: "left",
    yanchor: "bottom",
    yshift: 3,
    showarrow: false,
  };
}

/** Return the fine line at a reversal. */
function turnLine(time) {
  const line = { color: theme.colour("quiet"), width: 1, dash: "dot" };
  return { type: "line", x0: time, x1: time, y0: 0, y1: 1, yref: "paper", line };
}

/** Return the line at the time of the slider. */
function cursorLine(data) {
  const time = data.time && clock.frames ? clock.now() * data.scale : 0;
  const line = { color: theme.colour("accent"), width: 1.5 };
  const visible = data.time && clock.frames > 0;
  return { type: "line", x0: time, x1: time, y0: 0, y1: 1, yref: "paper", line, visible };
}
