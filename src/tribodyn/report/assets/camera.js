// Where a scene is looked at from; drags, wheels and keys move it.

/** Half the height that is seen, over the distance. */
const SIGHT = 0.4;
const HIGHEST = 1.5;
/** Room around what is shown, over its size. */
const MARGIN = 1.12;

class Camera {
  /** Look at points from a direction, so that they fill a picture of a width over its height. */
  constructor(points, from, up, wide) {
    this.up = up;
    this.middle = points[0];
    this.eye = unit(from);
    const axes = this.axes();
    for (const axis of axes) {
      const along = points.map((point) => dot(minus(point, this.middle), axis));
      this.middle = plus(this.middle, axis, 0.5 * (Math.min(...along) + Math.max(...along)));
    }
    const far = points.map((point) => {
      const [right, above, back] = axes.map((axis) => dot(minus(point, this.middle), axis));
      return back + (MARGIN * Math.max(Math.abs(right) / wide, Math.abs(above))) / SIGHT;
    });
    this.approach(Math.max(...far));
  }

  /** Turn around the upright axis and rise above the horizon [rad]. */
  turn(around, rise) {
    const eye = rotate(this.eye, this.up, around);
    const height = Math.asin(Math.max(-1, Math.min(1, dot(unit(eye), this.up))));
    const wanted = Math.max(-HIGHEST, Math.min(HIGHEST, height + rise));
    this.eye = rotate(eye, unit(cross(this.up, eye)), height - wanted);
  }

  /** Move to a multiple of the distance. */
  approach(factor) {
    this.eye = this.eye.map((value) => factor * value);
  }

  /** Return the directions right, up and back of what is seen. */
  axes() {
    const back = unit(this.eye);
    const right = unit(cross(this.up, back));
    return [right, cross(back, right), back];
  }

  /** Return the matrix, column by column, that takes points to what is seen, for a width over a height. */
  matrix(wide) {
    const [right, up, back] = this.axes();
    const distance = Math.hypot(...this.eye);
    const [near, far] = [0.05 * distance, 4 * distance];
    const eye = plus(this.middle, this.eye);
    const rows = [right, up, back].map((axis) => [...axis, -dot(axis, eye)]);
    const depth = [(near + far) / (near - far), (2 * near * far) / (near - far)];
    const columns = [0, 1, 2, 3].map((n) => [
      rows[0][n] / (SIGHT * wide),
      rows[1][n] / SIGHT,
      depth[0] * rows[2][n] + (n === 3 ? depth[1] : 0),
      -rows[2][n],
    ]);
    return new Float32Array(columns.flat());
  }
}

/** Make the stage of a figure that keys and the pointer turn. */
function turnableStage(box) {
  const moved = (change) => {
    change(stage.camera);
    stage.turned = true;
    stage.draw();
  };
  const hint = "Keys: arrows turn it, plus and minus move nearer and away. Follows the time slider.";
  const area = plotArea(box, isNarrow() ? 270 : 430, cameraKeys(moved), hint);
  const stage = new Stage(area);
  cameraPointer(area, moved);
  return stage;
}

/** Return what keys do in a scene. */
function cameraKeys(moved) {
  const turn = (around, rise) => () => moved((camera) => camera.turn(around, rise));
  const approach = (factor) => () => moved((camera) => camera.approach(factor));
  return {
    ArrowLeft: turn(-0.15, 0),
    ArrowRight: turn(0.15, 0),
    ArrowUp: turn(0, 0.12),
    ArrowDown: turn(0, -0.12),
    "+": approach(0.85),
    "=": approach(0.85),
    "-": approach(1 / 0.85),
  };
}

/** Let a pointer turn what an area shows, and the wheel with Ctrl come nearer; a finger scrolls the page. */
function cameraPointer(area, moved) {
  let last = null;
  area.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || event.pointerType === "touch") return;
    area.setPointerCapture(event.pointerId);
    last = pointerAt(area, event);
  });
  area.addEventListener("pointermove", (event) => {
    if (!last) return;
    const at = pointerAt(area, event);
    const [across, down] = [at[0] - last[0], at[1] - last[1]];
    last = at;
    moved((camera) => camera.turn(-0.01 * across, 0.01 * down));
  });
  for (const end of ["pointerup", "pointercancel"]) area.addEventListener(end, () => (last = null));
  area.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      moved((camera) => camera.approach(Math.exp(0.002 * event.deltaY)));
    },
    { passive: false },
  );
}
