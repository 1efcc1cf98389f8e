// Simple bodies as triangles with a colour for each corner.

class Solid {
  constructor() {
    Object.assign(this, { points: [], colours: [], corners: [] });
  }

  /** Add a corner with red, green, blue and strength, 0 to 255; return its number. */
  corner([x, y, z], [red, green, blue, strength = 255]) {
    this.points.push(x, y, z);
    this.colours.push(red, green, blue, strength);
    return this.points.length / 3 - 1;
  }

  /** Add a triangle or a convex polygon by the numbers of its corners. */
  face(...corners) {
    for (let n = 1; n + 1 < corners.length; n++) this.corners.push(corners[0], corners[n], corners[n + 1]);
  }

  /** Add the skin between loops of equally many points, each loop closed, with lids unless given otherwise. */
  loft(loops, colour, lids = true) {
    const rings = loops.map((loop) => loop.map((point) => this.corner(point, colour)));
    for (let n = 0; n + 1 < rings.length; n++) {
      const [a, b] = [rings[n], rings[n + 1]];
      a.forEach((_, m) => this.face(a[m], a[(m + 1) % a.length], b[(m + 1) % a.length], b[m]));
    }
    if (!lids) return;
    for (const loop of [loops[0], loops[loops.length - 1]]) {
      this.face(...loop.map((point) => this.corner(point, colour)));
    }
  }

  /** Add a round rod between two points. */
  rod(from, to, radius, colour, sides = 16) {
    const [u, v] = across(from, to);
    const loop = (centre) =>
      circle(sides).map(([c, s]) => centre.map((value, n) => value + radius * (c * u[n] + s * v[n])));
    this.loft([loop(from), loop(to)], colour);
  }

  /** Add a cone from the middle of its base to its tip. */
  cone(from, tip, radius, colour, sides = 12) {
    const [u, v] = across(from, tip);
    const loop = (centre, size) => circle(sides).map(([c, s]) => plus(plus(centre, u, size * c), v, size * s));
    this.loft([loop(from, radius), loop(tip, 0)], colour);
  }

  /** Add a sleeve about a middle, of half its length along a direction, from an inner to an outer radius. */
  sleeve(middle, along, half, inner, outer, colour, sides = 32) {
    const [u, v] = across(middle, plus(middle, along));
    const loop = (radius, by) =>
      circle(sides).map(([c, s]) => plus(plus(plus(middle, along, by), u, radius * c), v, radius * s));
    const skin = [loop(inner, -half), loop(inner, half), loop(outer, half), loop(outer, -half), loop(inner, -half)];
    this.loft(skin, colour, false);
  }

  /** Add triangles whose corners are given along three vectors from a centre. */
  mesh(centre, axes, corners, colour) {
    for (let n = 0; n < corners.length; n += 9) {
      const three = [0, 3, 6].map((k) => {
        const [a, b, c] = corners.subarray(n + k, n + k + 3);
        return this.corner(plus(plus(plus(centre, axes[0], a), axes[1], b), axes[2], c), colour);
      });
      this.face(...three);
    }
  }

  /** Add a ball. */
  ball(centre, radius, colour, sides = 16) {
    const rings = Array.from({ length: sides / 2 + 1 }, (_, n) => {
      const angle = (2 * Math.PI * n) / sides;
      const [high, wide] = [radius * Math.cos(angle), radius * Math.sin(angle)];
      return circle(sides).map(([c, s]) => plus(centre, [wide * c, wide * s, high]));
    });
    this.loft(rings, colour, false);
  }

  /** Add a flat bar between two points, wide across `up`. */
  bar(from, to, up, width, thickness, colour) {
    const along = unit(minus(to, from));
    const side = unit(cross(up, along));
    const high = cross(along, side);
    const corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]];
    const loop = (centre) =>
      corners.map(([a, b]) =>
        centre.map((value, n) => value + 0.5 * (a * width * side[n] + b * thickness * high[n])),
      );
    this.loft([loop(from), loop(to)], colour);
  }

  /** Return the triangles as what a graphics card takes. */
  packed() {
    return {
      points: new Float32Array(this.points),
      colours: new Uint8Array(this.colours),
      corners: new Uint32Array(this.corners),
    };
  }
}

/** Return `sides` points on the unit circle. */
function circle(sides) {
  return Array.from({ length: sides }, (_, n) => {
    const angle = (2 * Math.PI * n) / sides;
    return [Math.cos(angle), Math.sin(angle)];
  });
}

function plus(a, b, factor = 1) {
  return a.map((value, n) => value + factor * b[n]);
}

function minus(a, b) {
  return plus(a, b, -1);
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function dot(a, b) {
  return a.reduce((sum, value, n) => sum + value * b[n], 0);
}

/** Return a vector turned about a unit vector [rad]. */
function rotate(vector, axis, angle) {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const beside = cross(axis, vector);
  const along = (1 - cos) * dot(axis, vector);
  return vector.map((value, n) => value * cos + beside[n] * sin + axis[n] * along);
}

function unit(a) {
  const size = Math.hypot(...a) || 1;
  return a.map((value) => value / size);
}

/** Return two unit vectors across the line between two points, and across each other. */
function across(from, to) {
  const along = unit(minus(to, from));
  const helper = Math.abs(along[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const u = unit(cross(along, helper));
  return [u, cross(along, u)];
}
