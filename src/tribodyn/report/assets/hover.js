// The pointer over curves: their values under it, zoom by a drag, and the clock by a click.

/** Least stretch of a drag that zooms [px]; a shorter one is a click. */
const DRAG = 6;
/** Least height of a drag that zooms the ordinate too [px]. */
const UPRIGHT_DRAG = 24;
/** Farthest that a point may be from the pointer to be shown [px]. */
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

/** Return the point of a curve over time that is above or below a place, on the line between its points. */
function valueUnder({ x, y }, at) {
  const n = x.findIndex((value) => value >= at);
  if (n < 1) return x[n] === at && Number.isFinite(y[n]) ? { x: at, y: y[n], far: 0 } : null;
  const value = y[n - 1] + ((at - x[n - 1]) / (x[n] - x[n - 1])) * (y[n] - y[n - 1]);
  return Number.isFinite(value) ? { x: at, y: value, far: 0 } : null;
}

/** Return the point of a curve in a plane that is nearest to a place [px], on the lines between its points. */
function nearestOnCurve(scales, curve, [px, py]) {
  let best = null;
  let [ax, ay] = [NaN, NaN];
  for (let n = 0; n < curve.x.length; n++) {
    const [bx, by] = [scales.x.at(curve.x[n]), scales.y.at(curve.y[n])];
    if (Number.isNaN(by)) continue;
    const along = ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2);
    const back = n && !Number.isNaN(curve.y[n - 1]) ? 1 - Math.min(1, Math.max(0, along || 0)) : 0;
    const [x, y] = back ? [bx - back * (bx - ax), by - back * (by - ay)] : [bx, by];
    const far = Math.hypot(x - px, y - py);
    if (far <= REACH && !(far >= best?.far)) best = { x: scales.x.back(x), y: scales.y.back(y), far };
    [ax, ay] = [bx, by];
  }
  return best;
}

/** Write the values under the pointer into the box beside it, and mark them. */
function tellValues(lines, pen) {
  const { pointer, data, hidden, hover } = lines;
  const place = pointer && !lines.drag && lines.panels.find(({ frame }) => isInside(frame, pointer));
  const plane = !data.time;
  const time = pointer && lines.x.back(pointer[0]);
  let found = (place ? place.panel.curves : [])
    .filter((curve) => !hidden.has(curve.name))
    .map((curve) => ({ curve, at: plane ? nearestOnCurve({ x: lines.x, y: place.y }, curve, pointer) : valueUnder(curve, time) }))
    .filter(({ at }) => at);
  if (plane) found = found.sort((a, b) => a.at.far - b.at.far).slice(0, 1);
  hover.hidden = !found.length;
  if (!found.length) return;
  const value = ({ at }) =>
    plane ? `${number(at.x, 4)}, ${number(at.y, 4)}` : number(at.y, 4);
  const alone = place.panel.curves.length === 1;
  const rows = found.map((one) => element("div", {}, `${alone ? place.panel.label : one.curve.name}: ${value(one)}`));
  const title = `t = ${time.toFixed(4)} ${data.unit}`;
  hover.replaceChildren(...(plane ? [] : [element("strong", {}, title)]), ...rows);
  placeHover(lines, pointer);
  for (const { curve, at } of found) {
    Object.assign(pen, { fillStyle: theme.colour(curve.colour), strokeStyle: theme.colour("card"), lineWidth: 1 });
    drawMark(pen, "circle", lines.x.at(at.x), place.y.at(at.y), 3.5);
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
