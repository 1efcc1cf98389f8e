// Curves in panels above each other, with a common abscissa that zooms.

const PANEL = { first: 190, more: 150, alone: 300, frame: 64 };
const ROOM = { left: 52, right: 12, top: 26, below: 42, between: 34 };
/** Least width of a hatched window [px]: a few milliseconds of a long run are to be seen. */
const LEAST_WINDOW = 3;
const DASHES = { solid: [], dash: [7, 3], dashdot: [8, 3, 2, 3], dot: [2, 3], longdash: [11, 4] };

widgets.lines = (box) => {
  const lines = new Lines(box);
  return { take: lines.take.bind(lines), paint: () => lines.paint(), show: () => lines.overlay() };
};

class Lines {
  constructor(box) {
    this.box = box;
    this.hidden = new Set();
    this.view = null;
    this.limits = [];
    this.cut = true;
    this.pointer = null;
    const keys = {
      "+": () => this.zoom(0.5),
      "=": () => this.zoom(0.5),
      "-": () => this.zoom(2),
      ArrowLeft: () => this.zoom(1, -0.25),
      ArrowRight: () => this.zoom(1, 0.25),
      0: () => this.whole(),
    };
    const hint = "Keys: plus and minus zoom, arrows move, 0 shows the whole.";
    this.area = plotArea(box, PANEL.alone, keys, hint);
    this.ground = new Sheet(this.area);
    this.above = new Sheet(this.area);
    this.hover = element("div", { class: "hover", "aria-hidden": "true", hidden: "" });
    this.area.append(this.hover);
    this.legend = element("span", { class: "legends" });
    this.over = element("select", {});
    this.over.addEventListener("change", () => {
      this.view = null;
      this.limits = [];
      this.take(this.given, this.others);
      this.paint();
    });
    this.chooser = element("label", { class: "chooser" }, "Over", this.over);
    tools(
      box,
      this.legend,
      this.chooser,
      element("span", { class: "gap" }),
      element(
        "span",
        { class: "buttons" },
        button("Zoom in", () => this.zoom(0.5)),
        button("Zoom out", () => this.zoom(2)),
        button("Whole", () => this.whole()),
      ),
    );
    this.note = element("p", { class: "readout" });
    box.append(this.note);
    followPointer(this);
  }

  /** Take curves to draw, and those of other runs that show through; zoom and hidden curves stay. */
  take(given, others) {
    const wasWhole = !this.view || same(this.view, this.span);
    Object.assign(this, { given, others });
    this.chooseFrom(given.coordinates);
    const data = overCoordinate(given, this.over.value);
    const ghosts = others.map(({ data: other, strength }) => {
      const drawn = overCoordinate(other, this.over.value);
      return { strength, panels: data.panels.map((panel) => alike(panel, drawn.panels)) };
    });
    Object.assign(this, { data, ghosts, span: wholeSpan(data) });
    if (wasWhole) this.view = [...this.span];
    const count = data.panels.length;
    const height = count === 1 ? PANEL.alone : PANEL.frame + PANEL.first + PANEL.more * (count - 1);
    this.area.style.height = `${height}px`;
    this.nameCurves();
    const notes = data.panels.filter((panel) => panel.note).map((panel) => `${panel.label}: ${panel.note}`);
    this.note.textContent = [...notes, given.note].filter(Boolean).join(" · ");
    this.note.hidden = !this.note.textContent;
  }

  /** Offer time, the angles of joints and the positions of driven slides as the abscissa. */
  chooseFrom(coordinates) {
    const names = coordinates.map(({ name }) => name);
    this.chooser.hidden = !names.length;
    if (names.join("\n") === this.offered) return;
    this.offered = names.join("\n");
    const before = this.over.value;
    const option = (value, text) => element("option", { value }, text);
    this.over.replaceChildren(option("", "time"), ...coordinates.map(({ name, label }) => option(name, label.split(" [")[0])));
    this.over.value = names.includes(before) ? before : "";
  }

  /** Write the legend anew where the names of the curves have changed. */
  nameCurves() {
    const entries = legendEntries(this.data);
    const names = entries.map((entry) => entry.name).join("\n");
    if (names === this.named) return;
    this.named = names;
    this.legend.replaceChildren(...entries.map((entry) => legendButton(entry, this.hidden, () => this.paint())));
  }

  /** Make the abscissa wider by a factor, or move it by a share of its width. */
  zoom(factor, shift = 0) {
    const [low, high] = this.view;
    const width = Math.min((high - low) * factor, this.span[1] - this.span[0]);
    let begin = 0.5 * (low + high) - 0.5 * width + shift * width;
    begin = Math.max(this.span[0], Math.min(this.span[1] - width, begin));
    this.view = [begin, begin + width];
    this.paint();
  }

  /** Show everything; where that is shown already, the ordinate of the smooth motion, and back. */
  whole() {
    const shown = same(this.view, this.span) && !this.limits.some(Boolean);
    this.cut = shown ? !this.cut : this.cut;
    this.view = [...this.span];
    this.limits = [];
    this.paint();
  }

  /** Return the frames of the panels from top to bottom. */
  frames() {
    const count = this.data.panels.length;
    const room = this.area.clientHeight - ROOM.top - ROOM.below - ROOM.between * (count - 1);
    return this.data.panels.map((_, k) => {
      const top = ROOM.top + k * (room / count + ROOM.between);
      return { left: ROOM.left, right: this.area.clientWidth - ROOM.right, top, bottom: top + room / count };
    });
  }

  paint() {
    const pen = this.ground.fresh();
    const frames = this.frames();
    if (this.data.equal && same(this.view, this.span)) this.equalise(frames[0]);
    this.x = scaleOf(...this.view, frames[0].left, frames[0].right);
    const marks = roundMarks(...this.view, Math.max(2, (frames[0].right - frames[0].left) / 90));
    this.panels = this.data.panels.map((panel, k) => {
      const frame = frames[k];
      const y = scaleOf(...this.ordinate(panel, k), frame.bottom, frame.top);
      this.drawPanel(pen, panel, frame, y, marks);
      return { panel, frame, y };
    });
    drawBelow(pen, frames[frames.length - 1], marks, this.x, this.data.x_label);
    this.overlay();
    this.area.plotted = this;
  }

  /** Show the whole with one scale on both axes. */
  equalise(frame) {
    const [panel] = this.data.panels;
    const reach = [this.span, ends(panel.curves.map((curve) => curve.y))];
    const sizes = [frame.right - frame.left, frame.bottom - frame.top];
    const each = Math.max(...reach.map(([low, high], k) => (1.1 * (high - low)) / sizes[k]));
    [this.view, this.limits[0]] = reach.map(([low, high], k) => {
      const middle = 0.5 * (low + high);
      return [middle - 0.5 * each * sizes[k], middle + 0.5 * each * sizes[k]];
    });
    this.span = [...this.view];
  }

  /** Return the ends of a panel's ordinate: zoomed, of the smooth motion, or of all that is not hidden. */
  ordinate(panel, k) {
    if (this.limits[k]) return this.limits[k];
    if (this.cut && panel.limits.length) return panel.limits;
    const others = this.ghosts.map((ghost) => ghost.panels[k]).filter(Boolean);
    const curves = [panel, ...others].flatMap((one) => one.curves).filter(({ name }) => !this.hidden.has(name));
    const [low, high] = ends(curves.map((curve) => curve.y));
    const room = high > low ? 0.06 * (high - low) : Math.abs(low) || 1;
    return [low - room, high + room];
  }

  drawPanel(pen, panel, frame, y, marks) {
    const own = roundMarks(y.low, y.high, Math.max(2, (frame.bottom - frame.top) / 32));
    drawGrid(pen, frame, marks, this.x, true);
    drawGrid(pen, frame, own, y, false);
    inside(pen, frame, () => {
      this.data.windows.forEach((window) => hatch(pen, frame, this.x, window));
      this.drawCurves(pen, panel, frame, y);
      this.data.turns.forEach((turn) => upright(pen, frame, this.x.at(turn), "quiet", [2, 3]));
    });
    drawLeft(pen, frame, own, y, "");
    pen.fillStyle = theme.colour("ink");
    pen.font = theme.font();
    pen.textAlign = "left";
    pen.textBaseline = "bottom";
    pen.fillText(panel.label, frame.left, frame.top - 5);
  }

  /** Draw the curves of a panel over those of other runs. */
  drawCurves(pen, panel, frame, y) {
    const k = this.data.panels.indexOf(panel);
    const draw = (curve, strength) => {
      if (this.hidden.has(curve.name)) return;
      pen.strokeStyle = theme.colour(curve.colour);
      pen.lineWidth = strength < 1 ? 1 : curve.width;
      pen.globalAlpha = strength;
      pen.setLineDash(DASHES[curve.dash]);
      drawCurve(pen, curve.x, curve.y, this.x, y);
    };
    pen.lineJoin = "round";
    for (const { panels, strength } of this.ghosts) panels[k]?.curves.forEach((curve) => draw(curve, strength));
    panel.curves.forEach((curve) => draw(curve, 1));
    pen.globalAlpha = 1;
    pen.setLineDash([]);
  }

  /** Draw what moves without the curves: time now, where the pointer is, what a drag has reached. */
  overlay() {
    const pen = this.above.fresh();
    this.cursor = this.data.time && clock.frames ? clock.now() * this.data.scale : null;
    for (const { frame } of this.panels) {
      if (this.cursor !== null) {
        inside(pen, frame, () => upright(pen, frame, this.x.at(this.cursor), "accent", [], 1.5));
      }
    }
    if (this.drag) shadeDrag(pen, this.drag);
    tellValues(this, pen);
  }
}

/** Return the panel of another run that shows the same quantity, in the unit of this one. */
function alike(panel, others) {
  const found = others.find(({ quantity }) => quantity === panel.quantity);
  const factor = found && panel.factor / found.factor;
  if (!found || factor === 1) return found;
  return { ...found, curves: found.curves.map((curve) => ({ ...curve, y: curve.y.map((value) => factor * value) })) };
}

/** Return charts over time as charts over the coordinate of a joint, an angle within one turn. */
function overCoordinate(data, name) {
  const found = data.coordinates.find((one) => one.name === name);
  if (!found) return data;
  const [low, high] = ends([found.y]);
  const turn = found.label.startsWith("angle") && high - low > 360 ? 360 : 0;
  const panels = data.panels.map((panel) => ({ ...panel, curves: panel.curves.map((curve) => along(curve, found, turn)) }));
  return { ...data, panels, x_label: found.label, time: false, turns: [], windows: [] };
}

/** Return a curve over the values of another one at the same times, with a gap where a turn ends. */
function along(curve, { x: times, y: values }, turn) {
  const [x, y] = [[], []];
  let n = 1;
  for (let k = 0; k < curve.x.length; k++) {
    while (n < times.length - 1 && times[n] < curve.x[k]) n++;
    const share = (curve.x[k] - times[n - 1]) / (times[n] - times[n - 1]);
    const value = values[n - 1] + share * (values[n] - values[n - 1]);
    const place = turn ? ((value % turn) + turn) % turn : value;
    if (turn && k && Math.abs(place - x[x.length - 1]) > turn / 2) {
      x.push(place);
      y.push(NaN);
    }
    x.push(place);
    y.push(curve.y[k]);
  }
  return { ...curve, x, y };
}

/** Tell whether two stretches are the same. */
function same(a, b) {
  return a[0] === b[0] && a[1] === b[1];
}

/** Return smallest and largest of all numbers in some arrays. */
function ends(arrays) {
  let [low, high] = [Infinity, -Infinity];
  for (const values of arrays) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [0, 1];
}

/** Return smallest and largest abscissa of all curves. */
function wholeSpan(data) {
  return ends(data.panels.flatMap((panel) => panel.curves).map((curve) => curve.x));
}

/** Draw a line through a frame at an abscissa [px]. */
function upright(pen, frame, at, colour, dash, width = 1) {
  pen.strokeStyle = theme.colour(colour);
  pen.lineWidth = width;
  pen.setLineDash(dash);
  pen.beginPath();
  pen.moveTo(at, frame.top);
  pen.lineTo(at, frame.bottom);
  pen.stroke();
  pen.setLineDash([]);
}

/** Hatch a window of impacts: what happens there depends on what was before. */
function hatch(pen, frame, x, [begin, end]) {
  const from = x.at(begin);
  const to = Math.max(x.at(end), from + LEAST_WINDOW);
  if (to < frame.left || from > frame.right) return;
  inside(pen, { ...frame, left: Math.max(from, frame.left), right: Math.min(to, frame.right) }, () => {
    pen.strokeStyle = theme.colour("pale");
    pen.lineWidth = 1;
    pen.beginPath();
    const height = frame.bottom - frame.top;
    for (let at = Math.max(from, frame.left) - height; at < Math.min(to, frame.right); at += 5) {
      pen.moveTo(at, frame.bottom);
      pen.lineTo(at + height, frame.top);
    }
    pen.stroke();
  });
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
  line.setAttribute("stroke-dasharray", DASHES[curve.dash].join(" "));
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
