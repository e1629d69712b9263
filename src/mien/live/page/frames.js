/**
 * Binary messages of the server, decoded, and the view that draws them. The format: docs/frames.md.
 *
 * @typedef {{type: "setup", setup: number, loop: number, timeS: number, face: string, rate: number,
 *   shape: "mesh" | "drawing", arrays: Object<string, TypedArray>, [fact: string]: any}} Setup
 * @typedef {{type: "frame", setup: number, loop: number, timeS: number, shape: "mesh", step: number,
 *   points: Int16Array, runs: Uint16Array, normals: Int8Array, colors: Uint8Array}} MeshFrame
 * @typedef {{type: "frame", setup: number, loop: number, timeS: number, shape: "drawing", size: [number, number],
 *   background: [number[], number[]], outlines: Outline[], paths: Path[]}} DrawingFrame
 * @typedef {{contours: Float64Array[], rule: "evenodd" | "nonzero"}} Outline points x, y, x, y …; y runs up
 * @typedef {{outline: number, color: number[], inside: number[], outside: number[], under: number[]}} Path
 *   numbers of outlines; colours are sRGB bytes and straight alpha
 * @typedef {{type: "sound", setup: number, loop: number, timeS: number, speech: number, rateHz: number,
 *   samples: Int16Array}} Sound
 * @typedef {Int8Array | Uint8Array | Uint16Array | Int32Array | Uint32Array | Float32Array} TypedArray
 * @typedef {{draw(frame: MeshFrame | DrawingFrame): void, resize(): void, dispose(): void,
 *   canvas: HTMLCanvasElement}} View
 */

import { DrawingView } from "./drawing_view.js";
import { MeshView } from "./mesh_view.js";

const VERSION = 1;
const HEADER_BYTES = 16;
const CUTS = ["inside", "outside", "under"];
const KINDS = {
  int8: Int8Array,
  uint8: Uint8Array,
  uint16: Uint16Array,
  int32: Int32Array,
  uint32: Uint32Array,
  float32: Float32Array,
};

/**
 * The message in a buffer; its arrays share the buffer's memory.
 *
 * @param {ArrayBuffer} buffer
 * @returns {Setup | MeshFrame | DrawingFrame | Sound}
 * @throws {Error} it is of another version, of no known type, or too short
 */
export function decode(buffer) {
  const view = new DataView(buffer);
  const [type, version] = [view.getUint8(0), view.getUint8(1)];
  const head = { setup: view.getUint16(2, true), loop: view.getUint32(4, true), timeS: view.getFloat64(8, true) };
  if (version !== VERSION) throw new Error(`a message of version ${version}, and this page reads ${VERSION}`);
  if (type === 1) return { type: "setup", ...head, ...decodeSetup(buffer, view) };
  if (type === 2) return { type: "frame", ...head, ...decodeFrame(buffer, view) };
  if (type === 3) return { type: "sound", ...head, ...decodeSound(buffer, view) };
  throw new Error(`a message of type ${type}, and this page reads 1 to 3`);
}

/**
 * The view that draws the frames of a setup. Where a canvas has been used for the other kind of view, a new one takes
 * its place: `view.canvas` is the one that is drawn on.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {Setup} setup
 * @returns {View}
 */
export function makeView(canvas, setup) {
  const [Kind, context] = setup.shape === "mesh" ? [MeshView, "webgl2"] : [DrawingView, "2d"];
  if (canvas.dataset.context && canvas.dataset.context !== context) {
    const fresh = /** @type {HTMLCanvasElement} */ (canvas.cloneNode());
    canvas.replaceWith(fresh);
    canvas = fresh;
  }
  canvas.dataset.context = context;
  return new Kind(canvas, setup);
}

/** @param {ArrayBuffer} buffer @param {DataView} view */
function decodeSetup(buffer, view) {
  const length = view.getUint32(HEADER_BYTES, true);
  const { arrays, ...facts } = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, HEADER_BYTES + 4, length)));
  const named = arrays.map(({ name, dtype, shape, offset }) => {
    const count = shape.reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b, 1);
    return [name, new KINDS[dtype](buffer, offset, count)];
  });
  return { ...facts, arrays: Object.fromEntries(named) };
}

/** @param {ArrayBuffer} buffer @param {DataView} view */
function decodeFrame(buffer, view) {
  const step = view.getFloat32(16, true);
  return view.getUint32(20, true) === 0 ? decodeMesh(buffer, view, step) : decodeDrawing(buffer, view, step);
}

/** @param {ArrayBuffer} buffer @param {DataView} view @param {number} step */
function decodeMesh(buffer, view, step) {
  const [points, normals, runs, colors] = [24, 28, 32, 36].map((place) => view.getUint32(place, true));
  const take = taker(buffer, 40);
  return {
    shape: "mesh",
    step,
    points: take(Int16Array, 3 * points),
    runs: take(Uint16Array, 2 * runs),
    normals: take(Int8Array, 3 * normals),
    colors: take(Uint8Array, 3 * colors),
  };
}

/** @param {ArrayBuffer} buffer @param {DataView} view @param {number} step */
function decodeDrawing(buffer, view, step) {
  const [points, contours, outlines, paths, cuts] = [24, 28, 32, 36, 40].map((place) => view.getUint32(place, true));
  const size = [view.getFloat32(44, true), view.getFloat32(48, true)];
  const take = taker(buffer, 52);
  const contourEnds = take(Uint32Array, contours);
  const outlineEnds = take(Uint32Array, outlines);
  const cutEnds = take(Uint32Array, paths);
  const steps = take(Int16Array, 2 * points);
  const own = take(Uint16Array, paths);
  const cutBy = take(Uint16Array, 2 * cuts);
  const colors = take(Uint8Array, 4 * (2 + paths));
  const nonzero = take(Uint8Array, outlines);
  const places = Float64Array.from(steps, (value, n) => value * step + size[n % 2] / 2);
  const lines = slices(contourEnds).map(([from, to]) => places.subarray(2 * from, 2 * to));
  const color = (/** @type {number} */ n) => Array.from(colors.subarray(4 * n, 4 * n + 4));
  return {
    shape: "drawing",
    size,
    background: [color(0), color(1)],
    outlines: slices(outlineEnds).map(([from, to], n) => ({
      contours: lines.slice(from, to),
      rule: nonzero[n] ? "nonzero" : "evenodd",
    })),
    paths: slices(cutEnds).map(([from, to], n) => {
      const path = { outline: own[n], color: color(2 + n), inside: [], outside: [], under: [] };
      for (let cut = from; cut < to; cut++) path[CUTS[cutBy[2 * cut + 1]]].push(cutBy[2 * cut]);
      return path;
    }),
  };
}

/** @param {ArrayBuffer} buffer @param {DataView} view */
function decodeSound(buffer, view) {
  const [speech, rateHz] = [view.getUint32(16, true), view.getUint32(20, true)];
  return { speech, rateHz, samples: new Int16Array(buffer, 24) };
}

/** Takes one array after the other out of a buffer. @param {ArrayBuffer} buffer @param {number} start */
function taker(buffer, start) {
  let offset = start;
  return (/** @type {any} */ Kind, /** @type {number} */ count) => {
    const array = new Kind(buffer, offset, count);
    offset += array.byteLength;
    return array;
  };
}

/** From where to where each run reaches that ends there. @param {Uint32Array} ends @returns {[number, number][]} */
function slices(ends) {
  return Array.from(ends, (end, n) => [n ? ends[n - 1] : 0, end]);
}
