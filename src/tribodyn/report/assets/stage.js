// A small scene: triangles in light, on the graphics card by WebGL 2, or on a plain canvas where there is none.

const AMBIENT = 0.62;
const DIFFUSE = 0.42;
/** Height of a line of names, and side of the corner with the three directions [px]. */
const LINE = 15;
const CORNER = 62;
/** Lines by which a name may stand away from where it belongs. */
const FARTHEST = 8;
const VERTEX = `#version 300 es
uniform mat4 see;
in vec3 point;
in vec4 colour;
out vec3 place;
out vec4 paint;
void main() {
  place = point;
  paint = colour;
  gl_Position = see * vec4(point, 1.0);
}`;
// Faces are flat: how a face lies is how its place changes from pixel to pixel.
const FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 light;
in vec3 place;
in vec4 paint;
out vec4 seen;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  float bright = ${AMBIENT} + ${DIFFUSE} * abs(dot(normal, light));
  seen = vec4(paint.rgb * bright * paint.a, paint.a);
}`;

class Stage {
  constructor(area) {
    this.area = area;
    this.sheet = new Sheet(area);
    this.words = new Sheet(area);
    this.solids = [];
    /** Whether a reader has turned it. */
    this.turned = false;
    this.gl = this.sheet.canvas.getContext("webgl2", { antialias: true, premultipliedAlpha: true });
    if (!this.gl) return;
    this.program = linked(this.gl);
    this.sheet.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.sheet.canvas.addEventListener("webglcontextrestored", () => {
      this.program = linked(this.gl);
      this.draw();
    });
  }

  /** Look from where `make` puts a camera for a width over a height; anew for another size, unless a reader turned it. */
  look(make) {
    const wide = this.wide();
    if (this.camera && (this.turned || this.lookedAt === wide)) return;
    this.camera = make(wide);
    this.lookedAt = wide;
  }

  /** Return width over height. */
  wide() {
    return this.area.clientWidth / this.area.clientHeight || 1;
  }

  /**
   * Draw solids: one, one that is seen through, and one that shines through all; names beside points: [{text, at, aside}].
   * What is named may reach `above` its point, in the unit of the points.
   */
  set(solids, names) {
    this.solids = solids.map((solid) => solid.packed());
    this.names = names;
    this.area.plotted = this;
    this.draw();
  }

  draw() {
    if (!this.camera || !this.sheet.fit()) return;
    const matrix = this.camera.matrix(this.wide());
    const light = unit(plus(plus(this.camera.axes()[2], this.camera.axes()[1], 0.6), this.camera.axes()[0], -0.5));
    if (this.gl) drawByCard(this, matrix, light);
    else drawByHand(this, matrix, light);
    const pen = this.words.fresh();
    this.written = [];
    for (const name of this.names) this.write(pen, matrix, name, this.written);
    this.showDirections(pen);
  }

  /** Return where a point is seen [px], and how deep. */
  project(matrix, [x, y, z]) {
    const of = (row) => matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + matrix[12 + row];
    const depth = of(3);
    return [
      (0.5 + (0.5 * of(0)) / depth) * this.area.clientWidth,
      (0.5 - (0.5 * of(1)) / depth) * this.area.clientHeight,
      depth,
    ];
  }

  /** Write a name beside what it names, with a line to it, where no other is written; one without room is left out. */
  write(pen, matrix, { text, at, aside: [right, down], above = 0 }, written) {
    pen.font = theme.font();
    const [x, y] = this.project(matrix, at);
    const reach = above && y - this.project(matrix, plus(at, this.camera.axes()[1], above))[1];
    const box = this.room(x, y, pen.measureText(text).width, [right, down < 0 ? down - reach : down + reach], written);
    if (!box) return;
    written.push(box);
    const middle = 0.5 * (box.top + box.bottom);
    Object.assign(pen, { strokeStyle: theme.colour("quiet"), lineWidth: 1, fillStyle: theme.colour("ink") });
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(Math.max(box.left, Math.min(x, box.right)), middle);
    pen.stroke();
    Object.assign(pen, { strokeStyle: theme.colour("card"), lineWidth: 3, lineJoin: "round" });
    Object.assign(pen, { textBaseline: "middle", textAlign: "left" });
    pen.strokeText(text, box.left, middle);
    pen.fillText(text, box.left, middle);
  }

  /** Return the box of a name beside a point [px], farther away where others are; nothing where there is no room. */
  room(x, y, wide, [right, down], written) {
    const [width, height] = [this.area.clientWidth, this.area.clientHeight];
    const taken = [...written, { left: 0, right: CORNER, top: height - CORNER, bottom: height }];
    const apart = (a, b) => a.right < b.left || b.right < a.left || a.bottom <= b.top || b.bottom <= a.top;
    for (let k = 0; k < FARTHEST; k++) {
      for (const [a, b] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
        const beside = x + a * right;
        const begin = Math.abs(right) < 15 ? beside - 0.5 * wide : a * right < 0 ? beside - wide - 3 : beside + 3;
        const left = Math.max(3, Math.min(begin, width - wide - 3));
        const middle = y + b * (down + (Math.sign(down) || -1) * k * LINE);
        const box = { left, right: left + wide, top: middle - 0.5 * LINE, bottom: middle + 0.5 * LINE };
        if (box.top >= 0 && box.bottom <= height && taken.every((other) => apart(box, other))) return box;
      }
    }
    return null;
  }

  /** Draw the three directions in the corner. */
  showDirections(pen) {
    const [right, up] = this.camera.axes();
    const [x, y, size] = [34, this.area.clientHeight - 34, 20];
    Object.assign(pen, { strokeStyle: theme.colour("quiet"), fillStyle: theme.colour("quiet"), lineWidth: 1.5 });
    Object.assign(pen, { font: theme.font(TEXT), textAlign: "center", textBaseline: "middle" });
    ["X", "Y", "Z"].forEach((name, n) => {
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + size * right[n], y - size * up[n]);
      pen.stroke();
      pen.fillText(name, x + 1.4 * size * right[n], y - 1.4 * size * up[n]);
    });
  }
}

/** Return the program of the graphics card. */
function linked(gl) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "point");
  gl.bindAttribLocation(program, 1, "colour");
  gl.linkProgram(program);
  const buffers = [gl.createBuffer(), gl.createBuffer(), gl.createBuffer()];
  return { program, buffers, see: gl.getUniformLocation(program, "see"), light: gl.getUniformLocation(program, "light") };
}

/** Draw by the graphics card. */
function drawByCard({ gl, program, sheet, solids }, matrix, light) {
  gl.viewport(0, 0, sheet.canvas.width, sheet.canvas.height);
  gl.clearColor(0, 0, 0, 0);
  gl.enable(gl.DEPTH_TEST);
  gl.depthMask(true);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.useProgram(program.program);
  gl.uniformMatrix4fv(program.see, false, matrix);
  gl.uniform3fv(program.light, light);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  solids.forEach((solid, n) => {
    gl.depthMask(n === 0);
    if (n === 2) gl.disable(gl.DEPTH_TEST);
    fillBuffers(gl, program.buffers, solid);
    gl.drawElements(gl.TRIANGLES, solid.corners.length, gl.UNSIGNED_INT, 0);
  });
}

/** Hand a solid to the graphics card. */
function fillBuffers(gl, [points, colours, corners], solid) {
  gl.bindBuffer(gl.ARRAY_BUFFER, points);
  gl.bufferData(gl.ARRAY_BUFFER, solid.points, gl.DYNAMIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ARRAY_BUFFER, colours);
  gl.bufferData(gl.ARRAY_BUFFER, solid.colours, gl.DYNAMIC_DRAW);
  gl.enableVertexAttribArray(1);
  gl.vertexAttribPointer(1, 4, gl.UNSIGNED_BYTE, true, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, corners);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, solid.corners, gl.DYNAMIC_DRAW);
}

/** Draw on a plain canvas: the same triangles, the farthest first. */
function drawByHand(stage, matrix, light) {
  const pen = stage.sheet.fresh();
  const farthest = (solids) =>
    solids.flatMap((solid) => facesOf(stage, solid, matrix, light)).sort((a, b) => b.depth - a.depth);
  const faces = [...farthest(stage.solids.slice(0, 2)), ...farthest(stage.solids.slice(2))];
  pen.lineWidth = 0.7;
  for (const { at, colour, strength } of faces) {
    pen.globalAlpha = strength;
    pen.fillStyle = colour;
    pen.strokeStyle = colour;
    pen.beginPath();
    for (const [x, y] of at) pen.lineTo(x, y);
    pen.closePath();
    pen.fill();
    // Without its edge a face leaves a hairline to its neighbour.
    if (strength === 1) pen.stroke();
  }
  pen.globalAlpha = 1;
}

/** Return the faces of a solid as they are seen: corners [px], depth, colour in the light, strength. */
function facesOf(stage, { points, colours, corners }, matrix, light) {
  const count = points.length / 3;
  const point = (n) => [points[3 * n], points[3 * n + 1], points[3 * n + 2]];
  const seen = Array.from({ length: count }, (_, n) => stage.project(matrix, point(n)));
  const faces = [];
  for (let n = 0; n < corners.length; n += 3) {
    const three = [corners[n], corners[n + 1], corners[n + 2]];
    const mean = (channel) => three.reduce((sum, corner) => sum + colours[4 * corner + channel], 0) / 3;
    const strength = mean(3) / 255;
    if (strength === 0) continue;
    const [a, b, c] = three.map(point);
    const bright = AMBIENT + DIFFUSE * Math.abs(dot(unit(cross(minus(b, a), minus(c, a))), light));
    const colour = `rgb(${[0, 1, 2].map((channel) => Math.min(255, mean(channel) * bright).toFixed(0)).join(",")})`;
    const at = three.map((corner) => seen[corner]);
    faces.push({ at, depth: at[0][2] + at[1][2] + at[2][2], colour, strength });
  }
  return faces;
}
