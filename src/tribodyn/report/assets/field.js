// A field on the unrolled bushing: one picture, one for each frame of the playback, or stages with a slider of their own.

widgets.field = (box) => {
  const field = new Field(box);
  const take = field.take.bind(field);
  const follows = () => field.played && clock.frames > 0;
  return { take, paint: () => follows() || field.paint(), show: (frame) => follows() && field.show(frame) };
};

class Field {
  constructor(box) {
    const step = (across, up) => () => this.moveProbe(across, up);
    const keys = { ArrowLeft: step(-1, 0), ArrowRight: step(1, 0), ArrowUp: step(0, 1), ArrowDown: step(0, -1) };
    keys.Escape = () => this.setProbe(null);
    this.area = plotArea(box, isNarrow() ? 360 : 300, keys, "A map. Keys: arrows read it point by point.");
    this.sheet = new Sheet(this.area);
    this.readout = element("p", { class: "readout" });
    box.append(this.readout);
    this.tools = tools(box);
    this.picture = element("canvas");
    this.shown = 0;
    this.ownScale = false;
    this.probe = null;
    this.area.addEventListener("pointermove", (event) => this.setProbe(this.nodeAt(pointerAt(this.area, event))));
    this.area.addEventListener("pointerleave", () => this.setProbe(null));
  }

  take(data) {
    this.data = data;
    this.played = data.stages.length < 2 && data.peaks.length > 1;
    this.shown = Math.min(this.shown, data.peaks.length - 1);
    this.width = data.angle.length;
    this.height = data.height.length;
    this.places = null;
    const stages = data.stages.join("\n");
    if (stages === this.named) return;
    this.named = stages;
    this.tools.replaceChildren(...this.controls());
  }

  /** Return the slider through stages, or the button that scales the colours. */
  controls() {
    if (this.data.stages.length > 1) return [stager(this.data.stages, (stage) => this.show(stage))];
    if (!this.played) return [];
    const toggle = button(
      "Scale colours to this moment",
      () => {
        this.ownScale = !this.ownScale;
        toggle.setAttribute("aria-pressed", String(this.ownScale));
        this.paint();
      },
      { "aria-pressed": String(this.ownScale) },
    );
    return [toggle];
  }

  show(frame) {
    this.shown = Math.min(frame, this.data.peaks.length - 1);
    this.paint();
  }

  /** Return the value at a node of the picture shown. */
  value(i, k) {
    const { steps, peaks } = this.data;
    return (steps[(this.shown * this.height + k) * this.width + i] * peaks[this.shown]) / 255;
  }

  /** Return the load at which the colours end. */
  top() {
    return (this.ownScale ? this.data.peaks[this.shown] : this.data.usual) || 1;
  }

  paint() {
    const pen = this.sheet.fresh();
    this.frame = fieldFrame(this.area);
    const { frame, data } = this;
    const half = data.height[this.height - 1];
    this.x = scaleOf(data.angle[0], data.angle[this.width - 1], frame.left, frame.right);
    this.y = scaleOf(-1.06 * half, 1.06 * half, frame.bottom, frame.top);
    drawField(pen, this);
    fieldAxes(pen, this);
    colourBar(pen, this);
    this.write(pen);
    this.area.plotted = this;
  }

  /** Say where the peak is, or what is at the node that is read. */
  write(pen) {
    const { probe } = this;
    this.readout.textContent = probe ? this.atNode(...probe) : this.atPeak();
    if (!probe) return;
    const [x, y] = [this.x.at(this.data.angle[probe[0]]), this.y.at(this.data.height[probe[1]])];
    Object.assign(pen, { strokeStyle: theme.colour("ink"), lineWidth: 1.5 });
    pen.strokeRect(x - 4, y - 4, 8, 8);
  }

  atNode(i, k) {
    return `${number(this.value(i, k))} ${this.data.unit} at ${this.place(i, k)}`;
  }

  atPeak() {
    if (!(this.data.peaks[this.shown] > 0)) return "no load at this moment";
    return `peak ${this.atNode(...this.highest())}`;
  }

  /** Return angle and height of a node in words. */
  place(i, k) {
    return `${(((this.data.angle[i] % 360) + 360) % 360).toFixed(0)}°, z = ${number(this.data.z[k])} mm`;
  }

  /** Return the node of the largest value. */
  highest() {
    const size = this.width * this.height;
    const start = this.shown * size;
    let best = 0;
    for (let n = 1; n < size; n++) if (this.data.steps[start + n] > this.data.steps[start + best]) best = n;
    return [best % this.width, Math.floor(best / this.width)];
  }

  /** Return the node nearest to a place [px], none outside the map. */
  nodeAt(at) {
    if (!this.frame || !isInside(this.frame, at)) return null;
    const near = (values, value) => {
      let best = 0;
      values.forEach((one, n) => {
        if (Math.abs(one - value) < Math.abs(values[best] - value)) best = n;
      });
      return best;
    };
    return [near(this.data.angle, this.x.back(at[0])), near(this.data.height, this.y.back(at[1]))];
  }

  setProbe(node) {
    this.probe = node;
    if (this.frame) this.paint();
  }

  /** Read the next node; the first one read is that of the peak. */
  moveProbe(across, up) {
    if (!this.probe) return this.setProbe(this.highest());
    const [i, k] = this.probe;
    const to = (value, count) => Math.max(0, Math.min(count - 1, value));
    return this.setProbe([to(i + across, this.width), to(k + up, this.height)]);
  }
}

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

/** Return the frame of the map; the bar of colours lies right of it, on a narrow screen below. */
function fieldFrame(area) {
  const narrow = isNarrow();
  const [right, below] = narrow ? [14, 104] : [78, 42];
  return { left: 52, right: Math.max(area.clientWidth - right, 60), top: 10, bottom: area.clientHeight - below };
}

/** Return, for even places along an axis, the node before each and the share of the way to the next. */
function between(nodes, scale, first, count, direction) {
  const index = new Uint16Array(count);
  const share = new Float32Array(count);
  let k = direction > 0 ? 0 : nodes.length - 2;
  for (let n = 0; n < count; n++) {
    const value = scale.back(first + n + 0.5);
    while (direction > 0 && k < nodes.length - 2 && nodes[k + 1] < value) k++;
    while (direction < 0 && k > 0 && nodes[k] > value) k--;
    index[n] = k;
    share[n] = Math.max(0, Math.min(1, (value - nodes[k]) / (nodes[k + 1] - nodes[k])));
  }
  return { index, share };
}

/** Draw the map: each pixel between the four nodes around it. */
function drawField(pen, field) {
  const { data, x, y, picture } = field;
  const [left, top] = [Math.round(x.begin), Math.round(y.at(data.height[field.height - 1]))];
  const [width, height] = [Math.round(x.end) - left, Math.round(y.at(data.height[0])) - top];
  if (width < 2 || height < 2) return;
  if (!field.places || picture.width !== width || picture.height !== height) {
    Object.assign(picture, { width, height });
    field.places = { i: between(data.angle, x, left, width, 1), k: between(data.height, y, top, height, -1) };
  }
  const ink = picture.getContext("2d", ON_PROCESSOR);
  const image = ink.createImageData(width, height);
  fillField(new Uint32Array(image.data.buffer), field, width, height);
  ink.putImageData(image, 0, 0);
  pen.drawImage(picture, left, top, width, height);
}

/** Colour the pixels of a map. */
function fillField(pixels, field, width, height) {
  const { data, width: columns, height: rows, shown, places } = field;
  const factor = ((SHADES_OF_LOAD - 1) * data.peaks[shown]) / 255 / field.top();
  const colours = packedRamp();
  const start = shown * columns * rows;
  const { i, k } = places;
  for (let row = 0; row < height; row++) {
    const low = start + k.index[row] * columns;
    const [b, a] = [k.share[row], 1 - k.share[row]];
    for (let column = 0; column < width; column++) {
      const at = low + i.index[column];
      const s = i.share[column];
      const first = a * data.steps[at] + b * data.steps[at + columns];
      const second = a * data.steps[at + 1] + b * data.steps[at + columns + 1];
      const shade = Math.min(factor * (first + s * (second - first)), SHADES_OF_LOAD - 1);
      pixels[row * width + column] = colours[Math.round(shade)];
    }
  }
}

/** Return the colours of loads as pixels of a canvas. */
function packedRamp() {
  const ramp = theme.ramp();
  const bytes = new Uint8ClampedArray(4 * SHADES_OF_LOAD);
  for (let n = 0; n < SHADES_OF_LOAD; n++) {
    for (let c = 0; c < 3; c++) bytes[4 * n + c] = ramp[3 * n + c];
    bytes[4 * n + 3] = 255;
  }
  return new Uint32Array(bytes.buffer);
}

/** Draw axes labelled with angles and heights of the bushing, and the band in the middle where nothing happens. */
function fieldAxes(pen, { data, frame, x, y }) {
  const marks = (values, texts) => Array.from(values, (value, n) => ({ value, text: texts[n] }));
  if (data.empty.length) {
    const [low, high] = data.empty.map(y.at);
    pen.fillStyle = theme.colour("fill");
    pen.fillRect(frame.left, high, frame.right - frame.left, low - high);
  }
  drawBelow(pen, frame, marks(data.angle_ticks, data.angle_texts), x, "angle from +X towards +Y [°]");
  drawLeft(pen, frame, marks(data.height_ticks, data.height_texts), y, data.empty.length ? "z [mm], middle shortened" : "z [mm]");
}

/** Draw the bar that says which colour is how much. */
function colourBar(pen, field) {
  const { frame, data } = field;
  const narrow = isNarrow();
  const low = narrow ? field.area.clientHeight - 22 : frame.bottom;
  const bar = narrow
    ? { left: frame.left, right: frame.right, top: low - 10, bottom: low }
    : { left: frame.right + 12, right: frame.right + 22, top: frame.top, bottom: frame.bottom };
  const colours = pen.createLinearGradient(bar.left, bar.bottom, narrow ? bar.right : bar.left, narrow ? bar.bottom : bar.top);
  theme.loads().forEach((colour, n, all) => colours.addColorStop(n / (all.length - 1), colour));
  pen.fillStyle = colours;
  pen.fillRect(bar.left, bar.top, bar.right - bar.left, bar.bottom - bar.top);
  const scale = narrow ? scaleOf(0, field.top(), bar.left, bar.right) : scaleOf(0, field.top(), bar.bottom, bar.top);
  Object.assign(pen, { fillStyle: theme.colour("quiet"), font: theme.font(TEXT) });
  pen.textAlign = narrow ? "center" : "left";
  pen.textBaseline = narrow ? "top" : "middle";
  for (const { value, text } of roundMarks(0, field.top(), 5)) {
    pen.fillText(text, narrow ? scale.at(value) : bar.right + 5, narrow ? bar.bottom + 4 : scale.at(value));
  }
  nameBar(pen, data.label, bar, field.area.clientWidth);
}

/** Write what a bar of colours means: above it, or upright at its right. */
function nameBar(pen, label, bar, width) {
  pen.save();
  Object.assign(pen, { fillStyle: theme.colour("ink"), font: theme.font(), textAlign: "center", textBaseline: "bottom" });
  if (isNarrow()) pen.fillText(label, 0.5 * (bar.left + bar.right), bar.top - 4);
  else {
    pen.translate(width - 2, 0.5 * (bar.top + bar.bottom));
    pen.rotate(-0.5 * Math.PI);
    pen.fillText(label, 0, 0);
  }
  pen.restore();
}
