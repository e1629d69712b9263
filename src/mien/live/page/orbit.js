/** Where a face is seen from: around it by dragging, back by a double click. Angles stay with the canvas. */

/** Radians a pixel of dragging. */
const SPEED = 0.008;

/** Farthest up or down, radians. */
const STEEPEST = 1.4;

/** Nothing nearer to the viewer than this is drawn, metres; and how far around the middle a face may reach. */
const NEAR_M = 0.01;
const REACH_M = 0.6;

/** @typedef {[number, number, number]} Vector */

/** @type {WeakMap<HTMLCanvasElement, {yaw: number, pitch: number}>} */
const angles = new WeakMap();

export class Orbit {
  /** @param {HTMLCanvasElement} canvas @param {() => void} changed called after every turn */
  constructor(canvas, changed) {
    if (!angles.has(canvas)) angles.set(canvas, { yaw: 0, pitch: 0 });
    this.angles = /** @type {{yaw: number, pitch: number}} */ (angles.get(canvas));
    this.changed = changed;
    this.from = [0, 0];
    this.listeners = new AbortController();
    const { signal } = this.listeners;
    canvas.style.touchAction = "none";
    canvas.addEventListener("pointerdown", (event) => this.grasp(canvas, event), { signal });
    canvas.addEventListener("pointermove", (event) => this.drag(canvas, event), { signal });
    canvas.addEventListener("dblclick", () => this.set(0, 0), { signal });
  }

  dispose() {
    this.listeners.abort();
  }

  /** @param {HTMLCanvasElement} canvas @param {PointerEvent} event */
  grasp(canvas, event) {
    canvas.setPointerCapture(event.pointerId);
    this.from = [event.clientX, event.clientY];
  }

  /** @param {HTMLCanvasElement} canvas @param {PointerEvent} event */
  drag(canvas, { pointerId, clientX, clientY }) {
    if (!canvas.hasPointerCapture(pointerId)) return;
    // Browsers do not agree on how far an event says that a finger has moved.
    const [x, y] = this.from;
    this.from = [clientX, clientY];
    this.set(this.angles.yaw - SPEED * (clientX - x), this.angles.pitch + SPEED * (clientY - y));
  }

  /** @param {number} yaw @param {number} pitch radians, beside those of the scene */
  set(yaw, pitch) {
    this.angles.yaw = yaw;
    this.angles.pitch = Math.min(Math.max(pitch, -STEEPEST), STEEPEST);
    this.changed();
  }

  /** The place of a camera, turned around what it looks at. @param {Vector} position @param {Vector} at */
  turn(position, at) {
    const [x, y, z] = position.map((value, n) => value - at[n]);
    const level = Math.hypot(x, z);
    const distance = Math.hypot(level, y);
    const yaw = Math.atan2(x, z) + this.angles.yaw;
    const pitch = Math.min(Math.max(Math.atan2(y, level) + this.angles.pitch, -STEEPEST), STEEPEST);
    return [
      at[0] + distance * Math.sin(yaw) * Math.cos(pitch),
      at[1] + distance * Math.sin(pitch),
      at[2] + distance * Math.cos(yaw) * Math.cos(pitch),
    ];
  }

  /** A place that goes around with the viewer. @param {Vector} place */
  swing([x, y, z]) {
    const [sine, cosine] = [Math.sin(this.angles.yaw), Math.cos(this.angles.yaw)];
    return [x * cosine + z * sine, y, z * cosine - x * sine];
  }
}

/**
 * The matrix from metres to the screen, column by column.
 *
 * @param {{at: Vector, fov_deg: number}} camera the field of view is that along the shorter side
 * @param {number[]} position
 * @param {number} width
 * @param {number} height
 */
export function project({ at, fov_deg }, position, width, height) {
  const back = unit(position.map((value, n) => value - at[n]));
  const level = Math.abs(back[0]) + Math.abs(back[2]) > 1e-6;
  const right = unit(cross(level ? [0, 1, 0] : [0, 0, -1], back));
  const up = cross(back, right);
  const focal = Math.min(width, height) / Math.tan((fov_deg * Math.PI) / 360);
  const distance = Math.hypot(...position.map((value, n) => value - at[n]));
  const [near, far] = [Math.max(NEAR_M, distance - REACH_M), distance + REACH_M];
  const rows = [
    right.map((value) => (value * focal) / width),
    up.map((value) => (value * focal) / height),
    back.map((value) => (value * (near + far)) / (near - far)),
    back.map((value) => -value),
  ];
  const moved = rows.map((row) => -(row[0] * position[0] + row[1] * position[1] + row[2] * position[2]));
  moved[2] += (2 * near * far) / (near - far);
  return new Float32Array([0, 1, 2].flatMap((n) => rows.map((row) => row[n])).concat(moved));
}

/** @param {number[]} a @param {number[]} b */
function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** @param {number[]} vector */
function unit(vector) {
  const length = Math.hypot(...vector);
  return vector.map((value) => value / length);
}
