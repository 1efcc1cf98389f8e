// Scales, round marks, and the axes drawn of them.

const TEXT = 11;

/** Return a scale that takes values to pixels and back. */
function scaleOf(low, high, begin, end) {
  const factor = (end - begin) / (high - low || 1);
  return {
    low,
    high,
    begin,
    end,
    at: (value) => begin + (value - low) * factor,
    back: (pixel) => low + (pixel - begin) / factor,
  };
}

/** Return round values between two, about `most`, with their texts. */
function roundMarks(low, high, most) {
  const exact = (high - low) / Math.max(most, 1);
  if (!(exact > 0)) return [];
  const power = 10 ** Math.floor(Math.log10(exact));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= 0.75 * exact);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) {
    marks.push({ value: k * step, text: markText(k * step, digits, step) });
  }
  return marks;
}

/** Write the value at a mark; very large and very small ones with a power of ten. */
function markText(value, digits, step) {
  if (digits > 5 || step >= 1e6) return number(value, 4);
  return (Math.abs(value) < 1e-9 * step ? 0 : value).toFixed(digits).replace("-", "−");
}

/** Draw fine lines across a frame at marks along x or y. */
function drawGrid(pen, frame, marks, scale, upright) {
  pen.strokeStyle = theme.colour("grid");
  pen.lineWidth = 1;
  pen.setLineDash([]);
  pen.beginPath();
  for (const { value } of marks) {
    const at = Math.round(scale.at(value)) + 0.5;
    pen.moveTo(upright ? at : frame.left, upright ? frame.top : at);
    pen.lineTo(upright ? at : frame.right, upright ? frame.bottom : at);
  }
  pen.stroke();
}

/** Draw the line, the marks and the title of the axis below a frame. */
function drawBelow(pen, frame, marks, scale, title) {
  axisPen(pen);
  pen.beginPath();
  pen.moveTo(frame.left, frame.bottom + 0.5);
  pen.lineTo(frame.right, frame.bottom + 0.5);
  for (const { value } of marks) {
    const at = Math.round(scale.at(value)) + 0.5;
    pen.moveTo(at, frame.bottom);
    pen.lineTo(at, frame.bottom + 3);
  }
  pen.stroke();
  pen.textBaseline = "top";
  pen.textAlign = "center";
  for (const { value, text } of marks) pen.fillText(text, scale.at(value), frame.bottom + 6);
  if (!title) return;
  pen.fillStyle = theme.colour("ink");
  pen.font = theme.font();
  pen.fillText(title, 0.5 * (frame.left + frame.right), frame.bottom + 22);
}

/** Draw the line, the marks and the title of the axis left of a frame. */
function drawLeft(pen, frame, marks, scale, title) {
  axisPen(pen);
  pen.beginPath();
  pen.moveTo(frame.left - 0.5, frame.top);
  pen.lineTo(frame.left - 0.5, frame.bottom);
  for (const { value } of marks) {
    const at = Math.round(scale.at(value)) + 0.5;
    pen.moveTo(frame.left - 3, at);
    pen.lineTo(frame.left, at);
  }
  pen.stroke();
  pen.textBaseline = "middle";
  pen.textAlign = "right";
  for (const { value, text } of marks) pen.fillText(text, frame.left - 6, scale.at(value));
  if (!title) return;
  pen.save();
  pen.fillStyle = theme.colour("ink");
  pen.font = theme.font();
  pen.translate(13, 0.5 * (frame.top + frame.bottom));
  pen.rotate(-0.5 * Math.PI);
  pen.textAlign = "center";
  pen.fillText(title, 0, 0);
  pen.restore();
}

/** Make a pen ready for an axis. */
function axisPen(pen) {
  pen.strokeStyle = theme.colour("rule");
  pen.fillStyle = theme.colour("quiet");
  pen.lineWidth = 1;
  pen.setLineDash([]);
  pen.font = theme.font(TEXT);
}

/** Let a pen draw inside a frame only, while `draw` runs. */
function inside(pen, frame, draw) {
  pen.save();
  pen.beginPath();
  pen.rect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top);
  pen.clip();
  draw();
  pen.restore();
}

/** Draw a curve; values that are no numbers leave a gap. */
function drawCurve(pen, x, y, { at: across }, { at: up }) {
  pen.beginPath();
  let gap = true;
  for (let n = 0; n < x.length; n++) {
    if (Number.isNaN(y[n])) {
      gap = true;
      continue;
    }
    if (gap) pen.moveTo(across(x[n]), up(y[n]));
    else pen.lineTo(across(x[n]), up(y[n]));
    gap = false;
  }
  pen.stroke();
}

/** Draw a mark: circle, square or diamond. */
function drawMark(pen, symbol, x, y, radius) {
  pen.beginPath();
  if (symbol === "circle") pen.arc(x, y, radius, 0, 2 * Math.PI);
  else if (symbol === "square") pen.rect(x - 0.9 * radius, y - 0.9 * radius, 1.8 * radius, 1.8 * radius);
  else {
    const r = 1.2 * radius;
    for (const [a, b] of [[r, 0], [0, r], [-r, 0], [0, -r]]) pen.lineTo(x + a, y + b);
    pen.closePath();
  }
  pen.fill();
  pen.stroke();
}
