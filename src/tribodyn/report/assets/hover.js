// The pointer over curves: their values under it, zoom by a drag, and the clock by a click.

/** Least stretch of a drag that zooms [px]; a shorter one is a click. */
const DRAG = 6;
/** Least height of a drag that zooms the ordinate too [px]. */
const UPRIGHT_DRAG = 24;
/** Farthest that a point may be from the pointer to be told [px]. */
const REACH = 40;

/** Let a plot of curves follow the pointer. */
function followPointer(lines) {
  const { area } = lines;
  const panelAt = ([, y]) => lines.panels.find(({ frame }) => y >= frame.top - 20 && y <= frame.bottom + 10);
  area.addEventListener("pointermove", (event) => {
    lines.pointer = pointerAt(area, event);
    if (lines.drag) lines.drag.to = within(lines.drag.frame, lines.pointer);
    lines.overlay();
  });
  area.addEventListener("pointerleave", () => {
    lines.pointer = null;
    lines.overlay();
  });
  area.addEventListener("pointerdown", (event) => {
    const at = pointerAt(area, event);
    const panel = panelAt(at);
    if (!panel || event.button !== 0 || event.pointerType === "touch") return;
    area.setPointerCapture(event.pointerId);
    lines.drag = { ...panel, from: within(panel.frame, at), to: within(panel.frame, at) };
  });
  area.addEventListener("pointerup", () => endDrag(lines));
  area.addEventListener("pointercancel", () => {
    lines.drag = null;
    lines.overlay();
  });
  area.addEventListener("click", (event) => {
    if (!lines.dragged) goToPointer(lines, pointerAt(area, event));
  });
  area.addEventListener("dblclick", () => lines.whole());
}

/** Return a point of a frame, the nearest one. */
function within(frame, [x, y]) {
  return [Math.max(frame.left, Math.min(frame.right, x)), Math.max(frame.top, Math.min(frame.bottom, y))];
}

/** Shade what a drag has reached. */
function shadeDrag(pen, { frame, from, to }) {
  const high = Math.abs(to[1] - from[1]) >= UPRIGHT_DRAG;
  const [top, bottom] = high ? [from[1], to[1]] : [frame.top, frame.bottom];
  pen.fillStyle = theme.colour("accent");
  pen.globalAlpha = 0.16;
  pen.fillRect(from[0], top, to[0] - from[0], bottom - top);
  pen.globalAlpha = 1;
}

/** Zoom to what a drag has reached. */
function endDrag(lines) {
  const { drag } = lines;
  lines.drag = null;
  lines.dragged = Boolean(drag) && Math.abs(drag.to[0] - drag.from[0]) >= DRAG;
  if (!lines.dragged) return;
  const order = (a, b) => (a < b ? [a, b] : [b, a]);
  const [from, to] = [drag.from, drag.to];
  lines.view = order(lines.x.back(from[0]), lines.x.back(to[0]));
  if (Math.abs(to[1] - from[1]) >= UPRIGHT_DRAG) {
    lines.limits[lines.panels.findIndex(({ panel }) => panel === drag.panel)] = order(
      drag.y.back(from[1]),
      drag.y.back(to[1]),
    );
  }
  lines.paint();
}

/** Set the clock to the time under the pointer. */
function goToPointer(lines, [x]) {
  if (lines.data.time && clock.frames) clock.goTo(lines.x.back(x) / lines.data.scale);
}

/** Return the number of the point of a curve that is nearest to a place [px] along x, or in the plane. */
function nearest(lines, y, curve, [px, py], plane) {
  let [best, least] = [-1, Infinity];
  for (let n = 0; n < curve.x.length; n++) {
    if (Number.isNaN(curve.y[n])) continue;
    const dx = Math.abs(lines.x.at(curve.x[n]) - px);
    if (dx >= least) continue;
    const far = plane ? Math.hypot(dx, y.at(curve.y[n]) - py) : dx;
    if (far < least) [best, least] = [n, far];
  }
  return least <= REACH ? { n: best, far: least } : null;
}

/** Write the values under the pointer into the box beside it, and mark them. */
function tellValues(lines, pen) {
  const { pointer, data, hidden, hover } = lines;
  const place = pointer && !lines.drag && lines.panels.find(({ frame }) => isInside(frame, pointer));
  const plane = !data.time;
  let found = (place ? place.panel.curves : [])
    .filter((curve) => !hidden.has(curve.name))
    .map((curve) => ({ curve, at: nearest(lines, place.y, curve, pointer, plane) }))
    .filter(({ at }) => at);
  if (plane) found = found.sort((a, b) => a.at.far - b.at.far).slice(0, 1);
  hover.hidden = !found.length;
  if (!found.length) return;
  const value = ({ curve, at }) =>
    plane ? `${number(curve.x[at.n], 4)}, ${number(curve.y[at.n], 4)}` : number(curve.y[at.n], 4);
  const alone = place.panel.curves.length === 1;
  const rows = found.map((one) => element("div", {}, `${alone ? place.panel.label : one.curve.name}: ${value(one)}`));
  const title = `t = ${lines.x.back(pointer[0]).toFixed(4)} ${data.unit}`;
  hover.replaceChildren(...(plane ? [] : [element("strong", {}, title)]), ...rows);
  placeHover(lines, pointer);
  for (const { curve, at } of found) {
    Object.assign(pen, { fillStyle: theme.colour(curve.colour), strokeStyle: theme.colour("card"), lineWidth: 1 });
    drawMark(pen, "circle", lines.x.at(curve.x[at.n]), place.y.at(curve.y[at.n]), 3.5);
  }
}

/** Tell whether a point lies in a frame. */
function isInside(frame, [x, y]) {
  return x >= frame.left && x <= frame.right && y >= frame.top && y <= frame.bottom;
}

/** Put the box of values beside the pointer, on the side with more room. */
function placeHover({ hover, area }, [x, y]) {
  const left = x > 0.5 * area.clientWidth;
  hover.style.left = left ? "" : `${x + 14}px`;
  hover.style.right = left ? `${area.clientWidth - x + 14}px` : "";
  hover.style.top = `${Math.max(0, Math.min(y - 12, area.clientHeight - hover.offsetHeight))}px`;
}
