// The mechanism in space. Lengths in mm; the motion in the clearance is magnified, nothing else is.

const RING = { before: 0.3, after: 0.22, half: 5, parts: 64 };
const BLADE = { chord: 34, thick: 6 };

widgets.scene = (box) => {
  const stage = turnableStage(box);
  const state = { view: "whole", magnification: 0, data: null, ghosts: [] };

  const views = Object.keys(VIEWS).map((name) =>
    button(
      VIEWS[name].label,
      () => {
        state.view = name;
        views.forEach((one, k) => one.setAttribute("aria-pressed", String(Object.keys(VIEWS)[k] === name)));
        stage.turned = false;
        stage.camera = null;
        show(clock.frame);
      },
      { "aria-pressed": String(name === state.view) },
    ),
  );
  const magnifier = sceneMagnifier(state, () => show(clock.frame));
  tools(box, ...views, element("span", { class: "gap" }), magnifier.label);

  const take = (data, ghosts) => {
    Object.assign(state, { data, ghosts });
    magnifier.take(data.magnification);
  };
  const show = (frame) => {
    const { data } = state;
    const view = VIEWS[state.view];
    stage.look((wide) => new Camera(view.points(data), view.from, [0, 0, 1], wide));
    const load = loadOn(data, page.figures.pressure, frame, state.magnification);
    stage.set([movingParts(data, frame, state.magnification), clearParts(state, frame), load], names(data, state));
  };
  return { take, paint: () => clock.frames || show(0), show };
};

/** Make the slider of the magnification; it begins where the run says and stays where it is put. */
function sceneMagnifier(state, changed) {
  const output = element("output");
  const slider = element("input", { type: "range", min: 1, step: 1 });
  const write = () => {
    output.textContent = `${state.magnification}×`;
    slider.setAttribute("aria-valuetext", output.textContent);
  };
  const put = (value) => {
    slider.value = value;
    state.magnification = Number(slider.value);
    write();
  };
  slider.addEventListener("input", () => {
    state.magnification = Number(slider.value);
    write();
    changed();
  });
  const take = ({ value, most }) => {
    slider.max = Math.max(most, state.magnification);
    if (!state.magnification) put(value);
  };
  return { label: element("label", { class: "magnifier" }, "Clearance motion magnified", slider, output), take };
}

/** Return what carries a point of the trunnion (its own axes, mm from O_j) to where it is. */
function trunnionAt(data, frame, magnification) {
  const [e_x, e_y] = [magnification * data.e_x[frame], magnification * data.e_y[frame]];
  const tan_x = Math.tan(magnification * data.phi_x[frame]);
  const tan_y = Math.tan(magnification * data.phi_y[frame]);
  const [cos, sin] = [Math.cos(data.theta_v[frame]), Math.sin(data.theta_v[frame])];
  const height = data.size.ring_radius - 0.5 * data.size.length;
  return ([a, b, c]) => {
    const [x, y] = [a * cos - b * sin, a * sin + b * cos];
    return [e_x + x - c * tan_y, e_y + y - c * tan_x, height + c + x * tan_y + y * tan_x];
  };
}

/** Return a point of the ring at an angle from its pin [rad], at a radius [mm]. */
function ringPoint(data, frame, angle, radius) {
  const beta = angle - data.theta_b[frame];
  return [radius * Math.sin(beta), data.size.lever + data.h_1[frame], radius * Math.cos(beta)];
}

/** Return all that moves, at one frame. */
function movingParts(data, frame, magnification) {
  const solid = new Solid();
  addRods(solid, data, frame);
  addRing(solid, data, frame);
  const place = trunnionAt(data, frame, magnification);
  addVane(solid, data, place);
  addTrunnion(solid, data, place, theme.rgb("part-trunnion"), theme.rgb("part-collar"));
  return solid;
}

/**
 * Return what is seen through: the bushing, and where other runs have the trunnion. Of these lever and blade are
 * left out: they would lie in the very place of those that are shown, and come through them in patches.
 */
function clearParts({ data, ghosts, magnification }, frame) {
  const solid = new Solid();
  for (const { data: other, strength } of ghosts) {
    const faint = [...theme.rgb("quiet"), 255 * strength];
    const at = Math.min(frame, other.theta_v.length - 1);
    addTrunnion(solid, other, trunnionAt(other, at, magnification), faint, faint);
  }
  addBushing(solid, data, magnification);
  return solid;
}

/** Add crank and drag link with their joints. */
function addRods(solid, data, frame) {
  const tip = data.crank_tip.subarray(3 * frame, 3 * frame + 3);
  const [pivot, end] = [data.pivot, [...tip]];
  const joint = ringPoint(data, frame, data.size.ring_angle, data.size.ring_radius);
  const aside = ([x, y, z], by) => [x, y + by, z];
  solid.rod(aside(pivot, -16), aside(pivot, 16), 7, theme.rgb("quiet"));
  solid.bar(pivot, end, [0, 1, 0], 14, 9, theme.rgb("part-crank"));
  solid.rod(aside(end, -8), aside(end, 8), 5, theme.rgb("quiet"));
  solid.rod(end, joint, 4, theme.rgb("part-link"));
  solid.rod(aside(joint, -8), aside(joint, 8), 5, theme.rgb("quiet"));
}

/** Add the stretch of the unison ring that matters, and its radial pin. */
function addRing(solid, data, frame) {
  const { ring_radius, ring_angle } = data.size;
  const [from, to] = [-RING.before, ring_angle + RING.after];
  const loops = Array.from({ length: RING.parts + 1 }, (_, n) => {
    const angle = from + ((to - from) * n) / RING.parts;
    const corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]];
    return corners.map(([a, b]) => {
      const [x, y, z] = ringPoint(data, frame, angle, ring_radius + RING.half * a);
      return [x, y + RING.half * b, z];
    });
  });
  solid.loft(loops, theme.rgb("part-ring"));
  const pin = [-14, 14].map((by) => ringPoint(data, frame, 0, ring_radius + by));
  solid.rod(...pin, 3, theme.rgb("quiet"), 12);
}

/** Add lever and blade, which are one body with the trunnion. */
function addVane(solid, { size: { lever, vane, length } }, place) {
  const top = 0.5 * length;
  const box = [[0, -4.5], [lever + 5, -4.5], [lever + 5, 4.5], [0, 4.5]];
  solid.loft([top + 1, top + 6].map((z) => box.map(([a, b]) => place([a, b, z]))), theme.rgb("part-lever"));
  const blade = (z) => bladeSection().map(([a, b]) => place([a, b, z]));
  solid.loft([blade(-top - 4), blade(top - vane)], theme.rgb("part-vane"));
}

/** Add the trunnion with its collar. */
function addTrunnion(solid, { size: { radius, length, collar } }, place, colour, colourOfCollar) {
  const bottom = -0.5 * length;
  const round = (height, r, thick, painted) => {
    const loop = (z) => circle(24).map(([c, s]) => place([r * c, r * s, z]));
    solid.loft([loop(height), loop(height + thick)], painted);
  };
  round(bottom - 1, radius, length + 4, colour);
  round(bottom - 4, collar, 3, colourOfCollar);
}

/** Return the section of the blade: a slim lens along the lever. */
function bladeSection() {
  return circle(20).map(([c, s]) => [
    BLADE.chord * c,
    0.5 * BLADE.thick * s * Math.sqrt(Math.max(0, 1 - c * c) + 0.05),
  ]);
}

/** Add the bushing: a sleeve whose bore shows the magnified clearance. */
function addBushing(solid, data, magnification) {
  const { radius, length, clearance, ring_radius } = data.size;
  const bore = radius + magnification * clearance;
  const wall = wallOf(data, magnification);
  const loop = (r, z) => circle(40).map(([c, s]) => [r * c, r * s, z]);
  const [low, high] = [ring_radius - length, ring_radius];
  const skin = [loop(bore, low), loop(bore, high), loop(wall, high), loop(wall, low), loop(bore, low)];
  solid.loft(skin, [...theme.rgb("part-bushing"), 56], false);
}

/** Return the outer radius of the bushing as it is drawn [mm]. */
function wallOf({ size, magnification: { most } }, magnification) {
  return size.radius + Math.max(most, magnification) * size.clearance + 4;
}

/** Return the load in its colours, on the outside of the bushing, where the trunnion does not hide it. */
function loadOn(data, load, frame, magnification) {
  const solid = new Solid();
  if (!load || load.stages.length > 1) return solid;
  const wall = wallOf(data, magnification);
  const middle = data.size.ring_radius - 0.5 * data.size.length;
  const shown = Math.min(frame, load.peaks.length - 1);
  const [columns, rows] = [load.angle.length, load.z.length];
  const factor = load.peaks[shown] / 255 / (load.usual || 1);
  const ramp = theme.ramp();
  for (let n = 0; n < columns * rows; n++) {
    const share = Math.min(1, factor * load.steps[shown * columns * rows + n]);
    const angle = (load.angle[n % columns] * Math.PI) / 180;
    const at = 3 * Math.round(share * (SHADES_OF_LOAD - 1));
    const point = [wall * Math.cos(angle), wall * Math.sin(angle), middle + load.z[Math.floor(n / columns)]];
    solid.corner(point, [ramp[at], ramp[at + 1], ramp[at + 2], 255 * Math.min(0.9, 3 * share)]);
  }
  const loaded = (corner) => solid.colours[4 * corner + 3] > 0;
  for (let n = 0; n < columns * (rows - 1); n++) {
    const four = [n, n + 1, n + columns + 1, n + columns];
    if (n % columns < columns - 1 && four.some(loaded)) solid.face(...four);
  }
  return solid;
}

const VIEWS = {
  whole: {
    label: "Whole mechanism",
    from: [0.32, -1, 0.42],
    points(data) {
      const { ring_radius, ring_angle, vane } = data.size;
      const last = data.theta_v.length - 1;
      const stretch = [-RING.before, 0, 0.5 * ring_angle, ring_angle, ring_angle + RING.after];
      const ring = [0, last >> 1, last].flatMap((frame) => stretch.map((angle) => ringPoint(data, frame, angle, ring_radius)));
      const blade = [-1, 1].flatMap((side) => [[side * BLADE.chord, 0, ring_radius - vane], [side * BLADE.chord, 0, ring_radius + 15]]);
      return [...ring, ...blade, plus(data.pivot, [12, 0, -12])];
    },
  },
  joint: {
    label: "Trunnion and bushing",
    from: [0.65, -1, 0.55],
    points({ size }) {
      const half = size.length;
      const [low, high] = [size.ring_radius - 2.2 * half, size.ring_radius + 0.6 * half];
      return [-1, 1].flatMap((x) => [-1, 1.5].flatMap((y) => [low, high].map((z) => [x * half, y * half, z])));
    },
  },
};

/** Return names, where they point to, and how far beside it they stand [px]. */
function names(data, state) {
  return partNames(data, state).map(([text, at, ...aside]) => ({ text, at, aside }));
}

/** Return text, point and offset of each name. */
function partNames(data, state) {
  const { ring_radius, lever, vane, length, ring_angle } = data.size;
  const middle = Math.floor(clock.frames / 4);
  const tip = [...data.crank_tip.subarray(3 * middle, 3 * middle + 3)];
  const joint = ringPoint(data, middle, ring_angle, ring_radius);
  const half = (a, b) => a.map((value, n) => 0.5 * (value + b[n]));
  const both = [
    ["lever", [0, 0.7 * lever, ring_radius + 4], -20, -34],
    ["bushing", [-9, 0, ring_radius - 0.6 * length], -58, 14],
    ["vane", [12, 0, ring_radius - 0.55 * vane], 46, 12],
  ];
  if (state.view === "joint") {
    return [...both.slice(0, 2), ["trunnion", [4, -4, ring_radius + 2], 56, -30],
      ["collar", [10, -6, ring_radius - length - 3], 50, 24],
      ["vane", [14, 0, ring_radius - 1.6 * length], 64, 20]];
  }
  return [...both, ["crank", half(data.pivot, tip), -44, 24], ["drag link", half(tip, joint), 10, -40],
    ["unison ring", ringPoint(data, middle, 0.5 * ring_angle, ring_radius), 30, -38]];
}
