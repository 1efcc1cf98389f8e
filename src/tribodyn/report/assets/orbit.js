// Points of one or several axes seen along the bushing, in the clearance circle.

const ORBIT = { left: 56, right: 10, top: 10, below: 42 };
const MARK = 6;
/** Room between the circle and the angles beside it [px]. */
const BESIDE = 4;

widgets.orbit = (box) => {
  const area = plotArea(box, orbitHeight(box), {}, "Follows the time slider.");
  const ground = new Sheet(area);
  const above = new Sheet(area);
  const key = tools(box);
  const readout = element("p", { class: "readout" });
  box.append(readout);
  const state = { data: null, ghosts: [] };

  const take = (data, ghosts) => {
    Object.assign(state, { data, ghosts });
    key.replaceChildren(
      ...data.places.map((place, k) => element("span", { class: "key" }, swatch(data.looks[k]), place)),
      element("span", { class: "key" }, "Angles from +X towards +Y"),
    );
  };
  const paint = () => {
    Object.assign(state, orbitScales(area, [state.data, ...state.ghosts.map((ghost) => ghost.data)]));
    const pen = ground.fresh();
    drawOrbitAxes(pen, state);
    inside(pen, state.frame, () => drawPaths(pen, state));
    area.plotted = state;
  };
  const show = (frame) => {
    const pen = above.fresh();
    state.now = placesAt(state.data, frame);
    inside(pen, state.frame, () => {
      for (const { data, strength } of state.ghosts) drawPlaces(pen, state, data, placesAt(data, frame), strength);
      drawPlaces(pen, state, state.data, state.now, 1);
    });
    const at = state.data.places.map((place, k) => `${place}: X ${number(state.now[k][0])} µm, Y ${number(state.now[k][1])} µm`);
    readout.textContent = (state.data.joined ? at.slice(1, 2) : at).join(" · ");
  };
  return { take, paint, show };
};

/** Return a height in which the circle fills a box, but no more than a screen has room for [px]. */
function orbitHeight(box) {
  const filled = box.clientWidth - ORBIT.left - ORBIT.right + ORBIT.top + ORBIT.below;
  return Math.max(200, Math.min(isNarrow() ? 310 : 380, filled));
}

/** Make a mark as in the plot, for the key below it. */
function swatch({ colour, symbol }) {
  return element("span", { class: `mark ${symbol}`, style: `background: var(--${colour})` });
}

/** Return where the points of each place are at a frame [µm]; another run may have fewer frames. */
function placesAt(data, frame) {
  return data.at.map(({ x, y }) => [x[Math.min(frame, x.length - 1)], y[Math.min(frame, y.length - 1)]]);
}

/** Return the frame and equal scales along both axes that show all of some runs. */
function orbitScales(area, runs) {
  const reach = Math.max(...runs.map((data) => data.reach));
  const [width, height] = [area.clientWidth, area.clientHeight];
  const side = Math.max(Math.min(width - ORBIT.left - ORBIT.right, height - ORBIT.top - ORBIT.below), 10);
  const left = ORBIT.left + 0.5 * (width - ORBIT.left - ORBIT.right - side);
  const frame = { left, right: left + side, top: ORBIT.top, bottom: ORBIT.top + side };
  return {
    frame,
    x: scaleOf(-reach, reach, frame.left, frame.right),
    y: scaleOf(-reach, reach, frame.bottom, frame.top),
  };
}

/** Draw axes, the clearance circle, and the angles at the wall. */
function drawOrbitAxes(pen, { data, ghosts, frame, x, y }) {
  const marks = roundMarks(x.low, x.high, Math.max(3, (frame.right - frame.left) / 60));
  drawGrid(pen, frame, marks, x, true);
  drawGrid(pen, frame, marks, y, false);
  inside(pen, frame, () => {
    for (const ghost of ghosts) drawClearance(pen, ghost.data, x, y, ghost.strength, [4, 3]);
    drawClearance(pen, data, x, y, 1, []);
  });
  if (data.clearance > 0 && !data.corners?.length) nameAngles(pen, data.clearance, x, y);
  drawBelow(pen, frame, marks, x, "X [µm]");
  pen.save();
  pen.translate(frame.left - ORBIT.left, 0);
  drawLeft(pen, { ...frame, left: ORBIT.left }, marks, y, "Y [µm]");
  pen.restore();
}

/** Draw a clearance circle, or the area that flat walls leave; that of the run itself is filled. */
function drawClearance(pen, { clearance, corners = [] }, x, y, strength, dash) {
  if (!(clearance > 0)) return;
  pen.beginPath();
  if (corners.length) for (const [across, up] of [...corners, corners[0]]) pen.lineTo(x.at(across), y.at(up));
  else pen.arc(x.at(0), y.at(0), x.at(clearance) - x.at(0), 0, 2 * Math.PI);
  pen.fillStyle = theme.colour("fill");
  if (strength === 1) pen.fill();
  Object.assign(pen, { strokeStyle: theme.colour("quiet"), lineWidth: 1.5, globalAlpha: strength });
  pen.setLineDash(dash);
  pen.stroke();
  pen.setLineDash([]);
  pen.globalAlpha = 1;
}

/** Write the angles that name points of the wall, and how they are counted. */
function nameAngles(pen, clearance, x, y) {
  Object.assign(pen, { fillStyle: theme.colour("quiet"), textAlign: "center", textBaseline: "middle" });
  pen.font = theme.font(TEXT);
  for (const theta of [0, 90, 180, 270]) {
    const angle = (theta * Math.PI) / 180;
    const [right, up] = [Math.cos(angle), Math.sin(angle)].map(Math.round);
    const text = `${theta}°`;
    const beyond = right ? 0.5 * pen.measureText(text).width + BESIDE : BESIDE + 6;
    // Those at the sides stand above the axis, where no mark of it is.
    const above = right ? 9 : 0;
    pen.fillText(text, x.at(right * clearance) + right * beyond, y.at(up * clearance) - up * beyond - above);
  }
}

/** Draw the paths, those of other runs fainter. */
function drawPaths(pen, { data, ghosts, x, y }) {
  const draw = (run, strength) =>
    run.paths.forEach((path, k) => {
      const { colour, dash } = run.looks[k];
      Object.assign(pen, { strokeStyle: theme.colour(colour), lineWidth: 1, globalAlpha: 0.6 * strength });
      pen.setLineDash(DASHES[dash]);
      drawCurve(pen, path.x, path.y, x, y);
    });
  ghosts.forEach((ghost) => draw(ghost.data, ghost.strength));
  draw(data, 1);
  pen.globalAlpha = 1;
  pen.setLineDash([]);
}

/** Draw where the points are now: marks, on a line where they belong to one body. */
function drawPlaces(pen, { x, y }, data, places, strength) {
  pen.globalAlpha = strength;
  if (data.joined) {
    Object.assign(pen, { strokeStyle: theme.colour("ink"), lineWidth: 2.5 });
    pen.beginPath();
    for (const [a, b] of places) pen.lineTo(x.at(a), y.at(b));
    pen.stroke();
  }
  places.forEach(([a, b], k) => {
    const { colour, symbol } = data.looks[k];
    Object.assign(pen, { fillStyle: theme.colour(colour), strokeStyle: theme.colour("card"), lineWidth: 1.5 });
    drawMark(pen, symbol, x.at(a), y.at(b), MARK);
  });
  pen.globalAlpha = 1;
}
