// The mechanism in space. Lengths in mm; the motion in the clearance is magnified, nothing else is.

const RING = { before: 0.3, after: 0.22, half: 5, parts: 64 };
const BLADE = { chord: 34, thick: 6 };

widgets.scene = (box, data) => {
  const area = plotArea(
    box,
    isNarrow() ? 320 : 430,
    cameraKeys(() => area),
    "Keys: arrows turn it, plus and minus move nearer and away. Follows the time slider.",
  );
  const state = { view: "whole", magnification: data.magnification.value };

  const camera = () => area.layout.scene.camera;

  const views = Object.keys(VIEWS).map((name) =>
    button(
      VIEWS[name].label,
      () => {
        state.view = name;
        views.forEach((one, k) => one.setAttribute("aria-pressed", String(Object.keys(VIEWS)[k] === name)));
        paint(true);
      },
      { "aria-pressed": String(name === state.view) },
    ),
  );
  tools(box, ...views, element("span", { class: "gap" }), magnifier(data, state, () => paint()));

  const paint = (fresh = false) => {
    const kept = !fresh && area.layout ? camera() : cameraOf(data, state, area);
    react(area, sceneTraces(data, state), sceneLayout(data, state, kept));
  };
  const show = (frame) => {
    const { x, y, z } = movingParts(data, frame, state.magnification);
    Plotly.restyle(area, { x: [x], y: [y], z: [z] }, [0]);
  };
  return { paint, show };
};

/** Make the slider of the magnification. */
function magnifier(data, state, changed) {
  const { value, most } = data.magnification;
  const output = element("output", {}, `${value}×`);
  const slider = element("input", { type: "range", min: 1, max: most, step: 1, value });
  slider.addEventListener("input", () => {
    state.magnification = Number(slider.value);
    output.textContent = `${slider.value}×`;
    changed();
  });
  return element("label", { class: "magnifier" }, "Clearance motion magnified", slider, output);
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
  addVane(solid, data, trunnionAt(data, frame, magnification));
  return solid;
}

/** Add crank and drag link with their joints. */
function addRods(solid, data, frame) {
  const tip = data.crank_tip.subarray(3 * frame, 3 * frame + 3);
  const [pivot, end] = [data.pivot, [...tip]];
  const joint = ringPoint(data, frame, data.size.ring_angle, data.size.ring_radius);
  const aside = ([x, y, z], by) => [x, y + by, z];
  solid.rod(aside(pivot, -16), aside(pivot, 16), 7, theme.colour("quiet"));
  solid.bar(pivot, end, [0, 1, 0], 14, 9, theme.colour("part-crank"));
  solid.rod(aside(end, -8), aside(end, 8), 5, theme.colour("quiet"));
  solid.rod(end, joint, 4, theme.colour("part-link"));
  solid.rod(aside(joint, -8), aside(joint, 8), 5, theme.colour("quiet"));
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
  solid.loft(loops, theme.colour("part-ring"));
  const pin = [-14, 14].map((by) => ringPoint(data, frame, 0, ring_radius + by));
  solid.rod(...pin, 3, theme.colour("quiet"), 12);
}

/** Add lever, trunnion, collar and blade, which are one body. */
function addVane(solid, data, place) {
  const { lever, vane, radius, length, collar } = data.size;
  const top = 0.5 * length;
  const bottom = top - vane;
  const round = (height, r, colour, thick) => {
    const loop = (z) => circle(24).map(([c, s]) => place([r * c, r * s, z]));
    solid.loft([loop(height), loop(height + thick)], colour);
  };
  const box = [[0, -4.5], [lever + 5, -4.5], [lever + 5, 4.5], [0, 4.5]];
  solid.loft([top + 1, top + 6].map((z) => box.map(([a, b]) => place([a, b, z]))), theme.colour("part-lever"));
  round(-top - 1, radius, theme.colour("part-trunnion"), length + 4);
  round(-top - 4, collar, theme.colour("part-collar"), 3);
  const blade = (z) => bladeSection().map(([a, b]) => place([a, b, z]));
  solid.loft([blade(-top - 4), blade(bottom)], theme.colour("part-vane"));
}

/** Return the section of the blade: a slim lens along the lever. */
function bladeSection() {
  return circle(20).map(([c, s]) => [
    BLADE.chord * c,
    0.5 * BLADE.thick * s * Math.sqrt(Math.max(0, 1 - c * c) + 0.05),
  ]);
}

/** Return the bushing: a sleeve whose bore shows the magnified clearance. */
function bushing(data, magnification) {
  const { radius, length, clearance, ring_radius } = data.size;
  const bore = radius + magnification * clearance;
  const wall = radius + data.magnification.most * clearance + 4;
  const solid = new Solid();
  const loop = (r, z) => circle(40).map(([c, s]) => [r * c, r * s, z]);
  const [low, high] = [ring_radius - length, ring_radius];
  const skin = [loop(bore, low), loop(bore, high), loop(wall, high), loop(wall, low), loop(bore, low)];
  solid.loft(skin, theme.colour("part-bushing"), false);
  return solid;
}

/** Return the traces: what moves, the bushing, the directions. */
function sceneTraces(data, state) {
  const light = { ambient: 0.72, diffuse: 0.55, specular: 0.08, roughness: 0.8, fresnel: 0.02 };
  const common = { type: "mesh3d", hoverinfo: "skip", flatshading: true, lighting: light };
  const moving = movingParts(data, clock.frame, state.magnification);
  return [
    { ...common, ...moving, lightposition: { x: 3000, y: -9000, z: 9000 } },
    { ...common, ...bushing(data, state.magnification), opacity: 0.32 },
    directions(data, state),
  ];
}

/** Return three short lines that name the directions. */
function directions(data, state) {
  const [at, size] = VIEWS[state.view].corner(data);
  const ends = [0, 1, 2].map((n) => at.map((value, m) => value + (m === n ? size : 0)));
  const points = ends.flatMap((end) => [at, end, [null, null, null]]);
  return {
    type: "scatter3d",
    mode: "lines+text",
    x: points.map((p) => p[0]),
    y: points.map((p) => p[1]),
    z: points.map((p) => p[2]),
    text: ["", "X", "", "", "Y", "", "", "Z", ""],
    textfont: { size: 12, color: theme.colour("quiet") },
    line: { color: theme.colour("quiet"), width: 3 },
    hoverinfo: "skip",
  };
}

const VIEWS = {
  whole: {
    label: "Whole mechanism",
    from: [0.32, -1, 0.42],
    ranges({ pivot, size }) {
      const { ring_radius, lever, vane } = size;
      return [
        [-ring_radius * Math.sin(RING.before) - 25, pivot[0] + 65],
        [-60, lever + 45],
        [Math.min(pivot[2], ring_radius - vane) - 55, ring_radius + 30],
      ];
    },
    corner: ({ size }) => [[-size.ring_radius * Math.sin(RING.before), -40, size.ring_radius - size.vane], 45],
  },
  joint: {
    label: "Trunnion and bushing",
    from: [0.65, -1, 0.55],
    ranges({ size }) {
      const half = 2.2 * size.length;
      const middle = size.ring_radius - 0.8 * size.length;
      return [[-half, half], [-half, 1.3 * half], [middle - 1.1 * half, middle + 0.9 * half]];
    },
    corner: ({ size }) => [[-2 * size.length, -2 * size.length, size.ring_radius - 3 * size.length], 9],
  },
};

/** Return a camera that looks from the side of the view and sees all of it, on a wide or a narrow screen. */
function cameraOf(data, state, area) {
  const view = VIEWS[state.view];
  const sizes = view.ranges(data).map(([low, high]) => high - low);
  // The plotting library scales the box of the scene to the volume 1; it sees 0.83 of the distance in height.
  const scale = Math.cbrt(sizes[0] * sizes[1] * sizes[2]);
  const wide = area.clientWidth / area.clientHeight;
  const far = Math.max(sizes[0] / wide, sizes[2]) / scale / 0.83 + (0.5 * sizes[1]) / scale;
  const [x, y, z] = unit(view.from).map((value) => value * far);
  return { eye: { x, y, z }, center: { x: 0, y: 0, z: 0 }, up: { x: 0, y: 0, z: 1 } };
}

/** Return where names point to, and how far beside it they stand [px]. */
function names(data, state) {
  const { ring_radius, lever, vane, length, ring_angle } = data.size;
  const middle = Math.floor(clock.frames / 4);
  const tip = [...data.crank_tip.subarray(3 * middle, 3 * middle + 3)];
  const joint = ringPoint(data, middle, ring_angle, ring_radius);
  const half = (a, b) => a.map((value, n) => 0.5 * (value + b[n]));
  const both = [
    ["lever", [0, 0.7 * lever, ring_radius + 4], -20, -34],
    ["bushing", [9, 0, ring_radius - 0.6 * length], 58, 20],
    ["vane", [12, 0, ring_radius - 0.55 * vane], 46, 12],
  ];
  if (state.view === "joint") {
    return [...both.slice(0, 2), ["trunnion", [4, -4, ring_radius + 2], 56, -30],
      ["collar", [10, -6, ring_radius - length - 3], 50, 24],
      ["vane", [0, -2, ring_radius - 1.9 * length], 60, 10]];
  }
  return [...both, ["crank", half(data.pivot, tip), -44, 24], ["drag link", half(tip, joint), 10, -40],
    ["unison ring", ringPoint(data, middle, 0.5 * ring_angle, ring_radius), 30, -38]];
}

/** Return the layout: no axes, names with leader lines, the camera. */
function sceneLayout(data, state, camera) {
  const [x, y, z] = VIEWS[state.view].ranges(data);
  const off = { visible: false, showspikes: false };
  const annotations = names(data, state).map(([text, at, ax, ay]) => ({
    text,
    x: at[0],
    y: at[1],
    z: at[2],
    ax,
    ay,
    arrowhead: 0,
    arrowwidth: 1,
    arrowcolor: theme.colour("quiet"),
    font: { size: 12, color: theme.colour("ink") },
  }));
  return {
    margin: { l: 0, r: 0, t: 0, b: 0 },
    scene: {
      xaxis: { ...off, range: x },
      yaxis: { ...off, range: y },
      zaxis: { ...off, range: z },
      aspectmode: "data",
      camera,
      annotations,
      dragmode: theme.coarse.matches ? false : "orbit",
    },
  };
}
