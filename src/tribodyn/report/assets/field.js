// A field on the unrolled bushing: one picture, one for each frame of the playback, or stages with a slider of their own.

widgets.field = (box, data) => {
  const staged = data.stages.length > 1;
  const played = !staged && data.peaks.length > 1;
  const area = plotArea(box, isNarrow() ? 360 : 300, {}, played ? "Follows the time slider." : "A map.");
  const readout = element("p", { class: "readout" });
  box.append(readout);
  let ownScale = false;
  let shown = 0;
  if (staged) tools(box, stager(data.stages, (stage) => show(stage)));
  if (played) {
    const toggle = button(
      "Scale colours to this moment",
      () => {
        ownScale = !ownScale;
        toggle.setAttribute("aria-pressed", String(ownScale));
        show(shown);
      },
      { "aria-pressed": "false" },
    );
    tools(box, toggle);
  }
  const top = (frame) => (ownScale ? data.peaks[frame] : data.usual) || 1;
  const paint = () => react(area, [fieldTrace(data, shown, top(shown))], fieldLayout(data));
  const show = (frame) => {
    shown = frame;
    const { rows, where } = fieldRows(data, shown);
    Plotly.restyle(area, { z: [rows], zmax: top(shown) }, [0]);
    readout.textContent = where;
  };
  if (!played) readout.textContent = fieldRows(data, 0).where;
  return { paint, show: played ? show : null };
};

/** Make the slider through stages; it begins at the first. */
function stager(stages, changed) {
  const output = element("output", {}, stages[0]);
  const slider = element("input", { type: "range", min: 0, max: stages.length - 1, step: 1, value: 0 });
  slider.addEventListener("input", () => {
    output.textContent = stages[slider.value];
    slider.setAttribute("aria-valuetext", stages[slider.value]);
    changed(Number(slider.value));
  });
  return element("label", { class: "magnifier" }, "Stage", slider, output);
}

/** Return the rows of a picture, and in words where its peak is. */
function fieldRows(data, frame) {
  const width = data.angle.length;
  const height = data.height.length;
  const start = frame * width * height;
  const scale = data.peaks[frame] / 255;
  const rows = [];
  let best = 0;
  for (let k = 0; k < height; k++) {
    const row = new Float32Array(width);
    for (let i = 0; i < width; i++) {
      const at = k * width + i;
      row[i] = data.steps[start + at] * scale;
      if (data.steps[start + at] > data.steps[start + best]) best = at;
    }
    rows.push(row);
  }
  const angle = (((data.angle[best % width] % 360) + 360) % 360).toFixed(0);
  const z = data.z[Math.floor(best / width)];
  const where = data.peaks[frame] > 0
    ? `peak ${number(data.peaks[frame])} ${data.unit} at ${angle}°, z = ${number(z)} mm`
    : "no load at this moment";
  return { rows, where };
}

/** Return the map as a trace. */
function fieldTrace(data, frame, top) {
  const texts = Array.from(data.z, (z) =>
    Array.from(data.angle, (angle) => `${(((angle % 360) + 360) % 360).toFixed(0)}°, z = ${number(z)} mm`),
  );
  return {
    type: "heatmap",
    x: data.angle,
    y: data.height,
    z: fieldRows(data, frame).rows,
    zmin: 0,
    zmax: top,
    zauto: false,
    zsmooth: "best",
    colorscale: theme.scale(),
    text: texts,
    hovertemplate: `%{text}<br>%{z:.3~g} ${literal(data.unit)}<extra></extra>`,
    colorbar: {
      orientation: isNarrow() ? "h" : "v",
      title: { text: literal(data.label), side: isNarrow() ? "top" : "right", font: { size: 12 } },
      thickness: 10,
      outlinewidth: 0,
      tickfont: { size: 11, color: theme.colour("quiet") },
      ...(isNarrow() ? { y: -0.32, yanchor: "top", len: 0.9 } : { x: 1.01 }),
    },
  };
}

/** Return axes labelled with angles and heights of the bushing. */
function fieldLayout(data) {
  const half = data.height[data.height.length - 1];
  const room = 0.06 * half;
  return {
    xaxis: {
      ...theme.axis("bushing angle θ [°]"),
      tickvals: data.angle_ticks,
      ticktext: data.angle_texts,
      range: [data.angle[0], data.angle[data.angle.length - 1]],
      showgrid: false,
    },
    yaxis: {
      ...theme.axis(data.empty.length ? "z [mm], middle shortened" : "z [mm]"),
      tickvals: data.height_ticks,
      ticktext: data.height_texts,
      range: [-half - room, half + room],
      showgrid: false,
    },
    shapes: data.empty.length ? [emptyMiddle(data)] : [],
    margin: { l: 52, r: 12, t: 10, b: isNarrow() ? 110 : 42 },
  };
}

/** Return the band in the middle where nothing happens. */
function emptyMiddle(data) {
  const [y0, y1] = data.empty;
  const common = { type: "rect", xref: "paper", x0: 0, x1: 1, y0, y1 };
  return { ...common, fillcolor: theme.colour("fill"), line: { width: 0 } };
}
