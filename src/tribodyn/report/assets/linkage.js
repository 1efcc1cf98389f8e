// A mechanism of any bodies and joints in space: rods between joints. Lengths in mm.

/** Sizes of what is drawn, over the size of the mechanism. */
const THICK = { rod: 0.011, joint: 0.019, pin: 0.08, block: 0.03, line: 0.003 };

widgets.linkage = (box) => {
  const stage = turnableStage(box);
  const state = { data: null, ghosts: [], magnification: 0, arrows: new Set(["force", "load_force"]) };
  const again = () => show(clock.frame);
  const magnifier = sceneMagnifier(state, again);
  const arrows = element("span", { class: "buttons" });
  tools(box, arrows, element("span", { class: "gap" }), magnifier.label);
  const key = tools(box);

  const take = (data, ghosts) => {
    Object.assign(state, { data, ghosts });
    magnifier.label.hidden = !data.magnification;
    if (data.magnification) magnifier.take(data.magnification);
    arrows.replaceChildren("Arrows of full length: ", ...Object.entries(data.forces).map(([kind, about]) => arrowButton(state, kind, about, again)));
    key.replaceChildren(
      ...data.bodies.map(({ name, colour }) => element("span", { class: "key" }, bar(colour), name)),
    );
  };
  const show = (frame) => {
    const { data, ghosts, magnification } = state;
    stage.look((wide) => new Camera(shownPlaces(data, state.arrows), data.eye, data.up, wide));
    const [solid, clear, above] = [new Solid(), new Solid(), new Solid()];
    for (const { data: other, strength } of ghosts) addLinkage(clear, other, frame, strength, magnification);
    addLinkage(solid, data, frame, 1, magnification);
    addBores(clear, data, frame, magnification);
    for (const kind of state.arrows) addArrows(above, data, kind, frame);
    stage.set([solid, clear, above], jointNames(data, frame, magnification));
  };
  return { take, paint: () => clock.frames || show(0), show };
};

/** Return where bodies, joints and the tips of arrows of some kinds are, at some of the frames. */
function shownPlaces(data, kinds) {
  const SOME = 24;
  const { bodies, joints, outlines } = data;
  const bores = joints.filter(({ clearance }) => clearance).flatMap(aroundBore);
  const all = [...bores, ...bodies, ...bodies.flatMap(({ solid }) => solid ?? []), ...outlines, ...joints.map((joint) => ({ points: joint.points, n: 2, shown: 1 }))];
  const frames = Math.max(...all.map(({ points, n }) => points.length / (3 * n)));
  const tips = Array.from({ length: SOME }, (_, k) => Math.floor((k * frames) / SOME)).flatMap((frame) =>
    [...kinds].flatMap((kind) => arrowsNow(data, kind, frame).map(({ from, along, length }) => plus(from, along, length))),
  );
  const places = all.flatMap(({ points, n, shown = n }) => {
    const frames = points.length / (3 * n);
    const step = Math.max(1, Math.floor(frames / SOME));
    const found = [];
    for (let frame = 0; frame < frames; frame += step) {
      for (let k = 0; k < shown; k++) found.push(pointAt(points, n, frame, k));
    }
    return found;
  });
  return [...places, ...tips];
}

/** Return points at a distance around a joint on all sides, so that the camera leaves room for its bore; not for a ring. */
function aroundBore({ points, clearance }) {
  if (isRing(clearance)) return [];
  const far = 2 * clearance.radius;
  const ways = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
  return ways.map((way) => ({ points: points.map((value, k) => value + far * way[k % 3]), n: 2, shown: 1 }));
}

/** Return a stretch of colour for the key. */
function bar(colour) {
  return element("span", { class: "mark square", style: `background: var(--${colour})` });
}

/** Return a point of packed points: of a frame, the one with a number among `n`. */
function pointAt(points, n, frame, number) {
  const at = 3 * (n * frame + number);
  return [points[at], points[at + 1], points[at + 2]];
}

/** Add all rods, joints and springs at one frame; those of another run are faint. */
function addLinkage(solid, data, frame, strength, magnification) {
  const paint = (name) => [...theme.rgb(name), 255 * strength];
  for (const { n, points, colour, solid: own } of data.bodies) {
    if (own) addSolid(solid, own, frame, paint(colour));
    const thick = (own ? THICK.line : THICK.rod) * data.size;
    const at = Math.min(frame, points.length / (3 * n) - 1);
    const from = pointAt(points, n, at, 0);
    if (!own && n === 2 && Math.hypot(...minus(pointAt(points, n, at, 1), from)) < THICK.rod * data.size) {
      addBlock(solid, from, THICK.block * data.size, paint(colour));
      continue;
    }
    for (let k = 1; k < n; k++) {
      solid.rod(from, pointAt(points, n, at, k), thick, paint(colour), 12);
    }
  }
  for (const { n, points, colour } of data.outlines) {
    const at = Math.min(frame, points.length / (3 * n) - 1);
    for (let k = 1; k < n; k++) {
      const ends = [k - 1, k].map((number) => pointAt(points, n, at, number));
      solid.rod(...ends, THICK.line * data.size, paint(colour), 4);
    }
  }
  for (const points of data.springs) addCoil(solid, data, points, frame, paint("green"));
  for (const joint of data.joints) {
    addJoint(solid, data, joint, frame, magnification, paint(joint.real ? "vermilion" : "quiet"));
    if (joint.grounded) addGround(solid, data, joint, frame, paint("pale"));
  }
}

/** Add a body in its sizes: a round one between the middles of its ends, a box or mesh from its centre and three faces. */
function addSolid(solid, { n, points, radius, inner, triangles }, frame, colour) {
  const at = Math.min(frame, points.length / (3 * n) - 1);
  const places = Array.from({ length: n }, (_, k) => pointAt(points, n, at, k));
  if (radius) {
    const [from, to] = places;
    const length = Math.hypot(...minus(to, from));
    if (inner) solid.sleeve(plus(from, minus(to, from), 0.5), unit(minus(to, from)), 0.5 * length, inner, radius, colour, 40);
    else solid.rod(from, to, radius, colour, 40);
    return;
  }
  const [centre, ...faces] = places;
  const [along, up, aside] = faces.map((face) => minus(face, centre));
  if (triangles) {
    solid.mesh(centre, [along, up, aside], triangles, colour);
    return;
  }
  const [width, thickness] = [aside, up].map((half) => 2 * Math.hypot(...half));
  solid.bar(minus(centre, along), plus(centre, along), unit(up), width, thickness, colour);
}

/** Add a body that has no length, such as a slider: a cube. */
function addBlock(solid, at, half, colour) {
  const [from, to] = [-half, half].map((by) => [at[0] + by, at[1], at[2]]);
  solid.bar(from, to, [0, 0, 1], 2 * half, 2 * half, colour);
}

/** Return the joints' names where the joints are, above what is drawn of them; those of one place stand side by side. */
function jointNames(data, frame, magnification) {
  const names = [];
  for (const joint of data.joints) {
    const { at, radius } = jointAt(data, joint, frame, magnification);
    const here = names.find((other) => Math.hypot(...minus(other.at, at)) < THICK.joint * data.size);
    const above = joint.clearance && isRing(joint.clearance) ? 0 : 1.5 * radius;
    if (here) {
      here.text += `, ${joint.name}`;
      here.above = Math.max(here.above, above);
    } else names.push({ text: joint.name, at, aside: [8, -8], above });
  }
  return names;
}
