// Points of one or several axes seen along the bushing, in the clearance circle.

const AT_ONCE = { mode: "immediate", transition: { duration: 0 }, frame: { duration: 0, redraw: false } };

widgets.orbit = (box, data) => {
  const area = plotArea(box, isNarrow() ? 310 : 380, {}, "Follows the time slider.");
  const moving = data.at.length;
  tools(box, ...data.places.map((place, k) => element("span", { class: "key" }, swatch(data.looks[k]), place)));
  const readout = element("p", { class: "readout" });
  box.append(readout);
  const paint = () => react(area, orbitTraces(data), orbitLayout(data));
  const show = (frame) => {
    const x = data.at.map((path) => path.x[frame]);
    const y = data.at.map((path) => path.y[frame]);
    // Not restyle, which draws all paths again.
    Plotly.animate(area, { data: [{ x, y }], traces: [moving] }, AT_ONCE);
    const at = data.places.map((place, k) => `${place}: X ${number(x[k])} µm, Y ${number(y[k])} µm`);
    readout.textContent = (data.joined ? at.slice(1, 2) : at).join(" · ");
  };
  return { paint, show };
};

/** Return a mark as in the plot, for the key below it. */
function swatch({ colour, symbol }) {
  return element("span", { class: `mark ${symbol}`, style: `background: var(--${colour})` });
}

/** Return the paths, and where the points are now: marks, on a line where they belong to one body. */
function orbitTraces(data) {
  const paths = data.paths.map((path, k) => ({
    type: "scatter",
    mode: "lines",
    x: path.x,
    y: path.y,
    line: { color: theme.colour(data.looks[k].colour), dash: data.looks[k].dash, width: 1 },
    opacity: 0.55,
    hoverinfo: "skip",
  }));
  const now = {
    type: "scatter",
    mode: data.joined ? "lines+markers" : "markers",
    x: data.at.map((path) => path.x[clock.frame]),
    y: data.at.map((path) => path.y[clock.frame]),
    line: { color: theme.colour("ink"), width: 2.5 },
    marker: {
      size: 12,
      color: data.at.map((_, k) => theme.colour(data.looks[k].colour)),
      symbol: data.at.map((_, k) => data.looks[k].symbol),
      line: { color: theme.colour("card"), width: 1.5 },
    },
    text: data.places.map(literal),
    hovertemplate: "%{text}<br>X %{x:.2f} µm, Y %{y:.2f} µm<extra></extra>",
  };
  return [...paths, now];
}

/** Return equal axes, the circle, and the angles at the wall. */
function orbitLayout(data) {
  const range = [-data.reach, data.reach];
  const c = data.clearance;
  const circle = {
    type: "circle",
    x0: -c,
    x1: c,
    y0: -c,
    y1: c,
    line: { color: theme.colour("quiet"), width: 1.5 },
    fillcolor: theme.colour("fill"),
    layer: "below",
  };
  const angles = [0, 90, 180, 270].map((theta) => ({
    x: data.wall * 1.12 * c * Math.cos((theta * Math.PI) / 180),
    y: data.wall * 1.12 * c * Math.sin((theta * Math.PI) / 180),
    text: `${theta}°`,
    showarrow: false,
    font: { size: 11, color: theme.colour("quiet") },
  }));
  return {
    xaxis: { ...theme.axis("X [µm]"), range, constrain: "domain" },
    yaxis: { ...theme.axis("Y [µm]"), range, scaleanchor: "x", constrain: "domain" },
    shapes: c > 0 ? [circle] : [],
    annotations: c > 0 ? angles : [],
    dragmode: false,
    margin: { l: 52, r: 8, t: 8, b: 40 },
  };
}
