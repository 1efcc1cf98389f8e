// A mechanism of any bodies and joints in space: rods between joints. Lengths in mm.

/** Sizes of what is drawn, over the size of the mechanism. */
const THICK = { rod: 0.011, joint: 0.019, pin: 0.05, block: 0.03 };

widgets.linkage = (box, data) => {
  const area = plotArea(
    box,
    isNarrow() ? 320 : 430,
    cameraKeys(() => area),
    "Keys: arrows turn it, plus and minus move nearer and away. Follows the time slider.",
  );
  const key = data.bodies.map(({ name, colour }) => element("span", { class: "key" }, bar(colour), name));
  tools(box, ...key);
  const paint = () => {
    const kept = area.layout ? area.layout.scene.camera : linkageCamera(data, area);
    react(area, linkageTraces(data, clock.frame), linkageLayout(data, kept));
  };
  const show = (frame) => {
    const { x, y, z } = linkageParts(data, frame);
    const names = jointNames(data, frame);
    Plotly.restyle(area, { x: [x, names.x], y: [y, names.y], z: [z, names.z] }, [0, 1]);
  };
  return { paint, show };
};

/** Return a stretch of colour for the key. */
function bar(colour) {
  return element("span", { class: "mark square", style: `background: var(--${colour})` });
}

/** Return a point of packed points: of a frame, the one with a number among `n`. */
function pointAt(points, n, frame, number) {
  const at = 3 * (n * frame + number);
  return [points[at], points[at + 1], points[at + 2]];
}

/** Return all rods and joints at one frame. */
function linkageParts(data, frame) {
  const solid = new Solid();
  for (const { n, points, colour } of data.bodies) {
    const from = pointAt(points, n, frame, 0);
    if (n === 2 && Math.hypot(...minus(pointAt(points, n, frame, 1), from)) < THICK.rod * data.size) {
      addBlock(solid, from, THICK.block * data.size, theme.colour(colour));
      continue;
    }
    for (let k = 1; k < n; k++) {
      solid.rod(from, pointAt(points, n, frame, k), THICK.rod * data.size, theme.colour(colour), 12);
    }
  }
  for (const joint of data.joints) addJoint(solid, data, joint, frame);
  return solid;
}

/** Add a body that has no length, such as a slider: a cube. */
function addBlock(solid, at, half, colour) {
  const [from, to] = [-half, half].map((by) => [at[0] + by, at[1], at[2]]);
  solid.bar(from, to, [0, 0, 1], 2 * half, 2 * half, colour);
}

/** Add a joint: a short pin along its axis, or across it where it has none. */
function addJoint(solid, data, joint, frame) {
  const at = pointAt(joint.points, 2, frame, 0);
  const axis = minus(pointAt(joint.points, 2, frame, 1), at);
  const ball = Math.hypot(...axis) < 0.5;
  const along = ball ? [0, 0, 1] : unit(axis);
  const half = (ball ? THICK.joint : 0.5 * THICK.pin) * data.size;
  const ends = [-half, half].map((by) => at.map((value, n) => value + by * along[n]));
  solid.rod(...ends, THICK.joint * data.size, theme.colour(joint.real ? "vermilion" : "quiet"), ball ? 8 : 16);
}

/** Return the joints' names where the joints are. */
function jointNames(data, frame) {
  const places = data.joints.map((joint) => pointAt(joint.points, 2, frame, 0));
  return { x: places.map((p) => p[0]), y: places.map((p) => p[1]), z: places.map((p) => p[2]) };
}

/** Return the traces: bodies and joints, and the names of the joints. */
function linkageTraces(data, frame) {
  const light = { ambient: 0.75, diffuse: 0.5, specular: 0.08, roughness: 0.8, fresnel: 0.02 };
  return [
    { type: "mesh3d", hoverinfo: "skip", flatshading: true, lighting: light, ...linkageParts(data, frame) },
    {
      type: "scatter3d",
      mode: "text",
      ...jointNames(data, frame),
      text: data.joints.map(({ name }) => literal(name)),
      textposition: "top right",
      textfont: { size: 12, color: theme.colour("ink") },
      hoverinfo: "skip",
    },
  ];
}

/** Return a camera that sees all of it from where it is best seen, on a wide or a narrow screen. */
function linkageCamera(data, area) {
  const spans = data.ranges.map(([low, high]) => high - low);
  const extent = (direction) => spans.reduce((sum, span, n) => sum + span * Math.abs(direction[n]), 0);
  const right = unit(cross(data.up, data.eye));
  // The plotting library scales the box of the scene to the volume 1; it sees 0.83 of the distance in height.
  const scale = Math.cbrt(spans[0] * spans[1] * spans[2]);
  const wide = area.clientWidth / area.clientHeight;
  const far = Math.max(extent(right) / wide, extent(cross(data.eye, right))) / 0.83 + 0.5 * extent(data.eye);
  const [x, y, z] = data.eye.map((value) => (value * far) / scale);
  const [a, b, c] = data.up;
  return { eye: { x, y, z }, center: { x: 0, y: 0, z: 0 }, up: { x: a, y: b, z: c } };
}

/** Return the layout: no axes, the camera. */
function linkageLayout(data, camera) {
  const off = { visible: false, showspikes: false };
  const [x, y, z] = data.ranges;
  const spans = data.ranges.map(([low, high]) => high - low);
  // Not "data": that is of one frame, in which a mechanism may lie flat.
  const [a, b, c] = spans.map((span) => span / Math.cbrt(spans[0] * spans[1] * spans[2]));
  return {
    margin: { l: 0, r: 0, t: 0, b: 0 },
    scene: {
      xaxis: { ...off, range: x },
      yaxis: { ...off, range: y },
      zaxis: { ...off, range: z },
      aspectmode: "manual",
      aspectratio: { x: a, y: b, z: c },
      camera,
      dragmode: theme.coarse.matches ? false : "orbit",
    },
  };
}
