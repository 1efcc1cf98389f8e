// Joints of a mechanism: pins in bores, balls, supports; springs; forces and moments. Lengths in mm.

/** Turns of a spring, straight parts of a turn, and its radius over the size of the mechanism. */
const COIL = { turns: 7, parts: 10, radius: 0.018 };
/** Length of an arrow of usual force over the size of the mechanism, and how many times that it may be long. */
const ARROW = { length: 0.2, most: 1.6, least: 0.02, thick: 0.005, head: 0.03 };
const ARROW_COLOURS = { force: "ink", moment: "purple", load_force: "fail-rule", load_moment: "fail-rule" };
/** How much of what is behind it a bore hides, of 255. */
const BORE = 70;
/** Radius of a bore over its length above which it is drawn as a ring, and the straight parts of that. */
const SHORT = 4;
const RING_PARTS = 96;

/** Return one of packed points, `n` a frame, at a frame of the clock; another run may have fewer. */
function pointNow(points, n, frame, number) {
  return pointAt(points, n, Math.min(frame, points.length / (3 * n) - 1), number);
}

/** Return where a joint is, its direction, and its pin as it is drawn; a ball has no direction. */
function jointAt(data, { points, clearance }, frame, magnification) {
  const at = pointNow(points, 2, frame, 0);
  const direction = minus(pointNow(points, 2, frame, 1), at);
  const ball = Math.hypot(...direction) < 0.5;
  const [axis, least] = [unit(direction), THICK.joint * data.size];
  if (!clearance) return { at, pin: at, axis, along: axis, ball, radius: ball ? 1.2 * least : least, half: 0.5 * THICK.pin * data.size };
  if (clearance.walls) return blockAt(at, axis, clearance, frame, magnification);
  const radius = Math.max(clearance.radius, 0.6 * least);
  const ring = isRing(clearance);
  // All joints are magnified alike, but a wide clearance stays within what is drawn of its bore.
  const factor = Math.min(magnification, radius / clearance.radial);
  return {
    at,
    pin: plus(at, pointNow(clearance.offset, 1, frame, 0), factor),
    axis,
    along: unit(plus(axis, pointNow(clearance.tilt, 1, frame, 0), factor)),
    ball: ball || !clearance.length,
    radius,
    gap: factor * clearance.radial,
    half: 0.6 * Math.max(clearance.length, ring ? 0 : 2 * radius),
    ring,
    wall: ring ? 0.5 * least : 0.35 * radius,
  };
}

/** Return the block of a guide, slid along its axis, and its channel from end to end of the way of the block. */
function blockAt(at, axis, { offset, tilt, slid, aside, radius, radial, half, ends }, frame, magnification) {
  const factor = Math.min(magnification, radius / radial);
  const pin = plus(plus(at, axis, slid[Math.min(frame, slid.length - 1)]), pointNow(offset, 1, frame, 0), factor);
  const [along, x] = [unit(plus(axis, pointNow(tilt, 1, frame, 0), factor)), pointNow(aside, 1, frame, 0)];
  return { at, pin, axis, along, radius, half, ends, gap: factor * radial, aside: unit(plus(x, along, -dot(along, x))) };
}

/** Add a block or a wall: its cross-section between two places along an axis, set off by a gap. */
function addPrism(solid, middle, along, aside, { corners, ways }, [from, to], gap, colour) {
  const up = unit(cross(along, aside));
  const section = (way) =>
    corners.map(([x, y], k) => plus(plus(plus(middle, along, way), aside, x + gap * ways[k][0]), up, y + gap * ways[k][1]));
  solid.loft([section(from), section(to)], colour);
}

/** Tell whether a bore is so short for its radius that pin and bore are drawn as rings: a disc would hide what is behind. */
function isRing({ radius, length }) {
  return length > 0 && radius > SHORT * length;
}

/** Add the pin or ball of a joint. */
function addJoint(solid, data, joint, frame, magnification, colour) {
  const { pin, along, ball, radius, half, ring, wall, aside } = jointAt(data, joint, frame, magnification);
  if (aside && joint.clearance.across) solid.rod(plus(pin, aside, -1.1 * half), plus(pin, aside, 1.1 * half), radius, colour, 20);
  else if (aside) addPrism(solid, pin, along, aside, joint.clearance.walls[0], [-half, half], 0, colour);
  else if (ball) solid.ball(pin, radius, colour);
  else if (ring) solid.sleeve(pin, along, half, radius - wall, radius, colour, RING_PARTS);
  else solid.rod(plus(pin, along, -half), plus(pin, along, half), radius, colour, 20);
}

/** Add the bores of joints with clearance, as wide as the magnified clearance makes them; they are seen through. */
function addBores(solid, data, frame, magnification) {
  const colour = [...theme.rgb("part-bushing"), BORE];
  for (const joint of data.joints.filter(({ clearance }) => clearance)) {
    const { at, axis, ball, radius, gap, half, ring, wall, aside, ends } = jointAt(data, joint, frame, magnification);
    const bore = radius + gap;
    if (aside) for (const wall of joint.clearance.walls) addPrism(solid, at, axis, aside, wall, ends, gap, colour);
    else if (ball) solid.ball(at, bore, colour, 20);
    else if (ring) solid.sleeve(at, axis, 0.8 * half, bore, bore + wall, colour, RING_PARTS);
    else solid.sleeve(at, axis, 0.8 * half, bore, Math.max(1.8 * radius, bore + wall), colour);
  }
}

/** Add the support of a joint on the ground: a foot below it, across its axis. */
function addGround(solid, data, { points }, frame, colour) {
  const top = pointNow(points, 2, frame, 0);
  const axis = unit(minus(pointNow(points, 2, frame, 1), top));
  const across_ = minus(data.up, axis.map((value) => dot(axis, data.up) * value));
  const down = unit((Math.hypot(...across_) > 0.3 ? across_ : data.up).map((value) => -value));
  const [u, v] = across(top, plus(top, down));
  const size = THICK.joint * data.size;
  const square = (far, half) =>
    [[1, 1], [1, -1], [-1, -1], [-1, 1]].map(([a, b]) => plus(plus(plus(top, down, far * size), u, half * size * a), v, half * size * b));
  solid.loft([square(0.9, 0.5), square(2.4, 1.3)], colour);
  solid.loft([square(2.4, 1.9), square(2.8, 1.9)], colour);
}

/** Add a spring as a coil between its ends. */
function addCoil(solid, data, points, frame, colour) {
  const [from, to] = [0, 1].map((end) => pointNow(points, 2, frame, end));
  const [u, v] = across(from, to);
  const [count, radius, along] = [COIL.turns * COIL.parts, COIL.radius * data.size, minus(to, from)];
  const place = (k) => {
    const angle = (2 * Math.PI * k) / COIL.parts;
    const middle = plus(from, along, 0.1 + (0.8 * k) / count);
    return plus(plus(middle, u, radius * Math.cos(angle)), v, radius * Math.sin(angle));
  };
  const turns = Array.from({ length: count + 1 }, (_, k) => place(k));
  const line = [from, plus(from, along, 0.1), ...turns, plus(from, along, 0.9), to];
  for (let k = 1; k < line.length; k++) solid.rod(line[k - 1], line[k], THICK.line * data.size, colour, 5);
}

/** Return the button that shows arrows of a kind; its words say what an arrow of full length represents. */
function arrowButton({ arrows }, kind, { label: what, words }, changed) {
  const label = `${what} ${words}`;
  const made = button(
    label,
    () => {
      if (!arrows.delete(kind)) arrows.add(kind);
      made.setAttribute("aria-pressed", String(arrows.has(kind)));
      changed();
    },
    { "aria-pressed": String(arrows.has(kind)) },
  );
  return made;
}

/** Return forces or moments of joints, or of loads where they act, as arrows: [{from, along, length}]. */
function arrowsNow(data, kind, frame) {
  const about = data.forces[kind];
  return Object.entries(about ? about.at : {}).flatMap(([name, vectors]) => {
    const from = about.points[name]
      ? pointNow(about.points[name], 1, frame, 0)
      : pointNow(data.joints.find((joint) => joint.name === name).points, 2, frame, 0);
    const vector = pointNow(vectors, 1, frame, 0);
    const share = Math.hypot(...vector) / about.scale;
    if (share < ARROW.least) return [];
    return [{ from, along: unit(vector), length: ARROW.length * data.size * Math.min(share, ARROW.most) }];
  });
}

/** Add arrows of a kind; those of moments have two heads. */
function addArrows(solid, data, kind, frame) {
  const colour = theme.rgb(ARROW_COLOURS[kind]);
  for (const { from, along, length } of arrowsNow(data, kind, frame)) {
    addArrow(solid, data.size, from, along, length, kind.endsWith("moment") ? 2 : 1, colour);
  }
}

/** Add an arrow with some heads. */
function addArrow(solid, size, from, along, length, heads, colour) {
  const head = Math.min(ARROW.head * size, 0.6 * length);
  solid.rod(from, plus(from, along, length - head), ARROW.thick * size, colour, 8);
  for (let k = 0; k < heads; k++) {
    const tip = length - 0.7 * k * head;
    solid.cone(plus(from, along, tip - head), plus(from, along, tip), 0.35 * head, colour);
  }
}
