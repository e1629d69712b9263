/**
 * What becomes of a cage in every frame: subdivided points, normals, colours, one of each a drawn vertex.
 *
 * @import { MeshFrame, Setup } from "./frames.js"
 */

import { toLinear } from "./canvas.js";

export class Surface {
  /** @param {Setup} setup of a mesh */
  constructor(setup) {
    this.setup = setup;
    const { vertex_points, polygon_starts, node_starts } = setup.arrays;
    const vertices = vertex_points.length;
    this.refined = new Float32Array(3 * setup.refined_points);
    this.refinedColors = new Float32Array(setup.colored_by === "vertex" ? this.refined.length : 0);
    this.polygonNormals = new Float32Array(3 * (polygon_starts.length - 1));
    this.nodeNormals = new Float32Array(3 * (node_starts.length - 1));
    /** Metres, three a drawn vertex. */
    this.points = new Float32Array(3 * vertices);
    this.normals = new Float32Array(3 * vertices);
    /** Linear RGB. */
    this.colors = new Float32Array(3 * vertices);
    this.codes = Uint8Array.from(setup.arrays.colors);
    this.tint();
  }

  /** Fills points, normals and colours from a frame; says whether colours have changed. @param {MeshFrame} frame */
  update(frame) {
    const { refined, nodeNormals, setup } = this;
    const { step, points } = frame;
    for (let n = 0; n < points.length; n++) refined[n] = setup.middle[n % 3] + step * points[n];
    refine(refined, setup.arrays);
    sumPolygons(refined, setup.arrays, this.polygonNormals);
    sumNodes(this.polygonNormals, setup.arrays, nodeNormals);
    const { round_nodes, vertex_points, vertex_nodes } = setup.arrays;
    for (let n = 0; n < round_nodes.length; n++) {
      for (let c = 0; c < 3; c++) nodeNormals[3 * round_nodes[n] + c] = frame.normals[3 * n + c] / 127;
    }
    gather(refined, vertex_points, this.points);
    gather(nodeNormals, vertex_nodes, this.normals);
    return this.recolor(frame);
  }

  /** @param {MeshFrame} frame */
  recolor({ runs, colors }) {
    const codes = Uint8Array.from(this.setup.arrays.colors);
    let taken = 0;
    for (let n = 0; n < runs.length; n += 2) {
      codes.set(colors.subarray(taken, taken + 3 * runs[n + 1]), 3 * runs[n]);
      taken += 3 * runs[n + 1];
    }
    if (codes.every((code, n) => code === this.codes[n])) return false;
    this.codes = codes;
    this.tint();
    return true;
  }

  /** Fills the colours of drawn vertices from the codes of the cage. */
  tint() {
    const { codes, colors, setup } = this;
    const { vertex_colors, polygon_starts, polygon_corners } = setup.arrays;
    const byVertex = setup.colored_by === "vertex";
    const source = byVertex ? this.refinedColors : new Float32Array(codes.length);
    for (let n = 0; n < codes.length; n++) source[n] = toLinear(codes[n]);
    if (byVertex) refine(source, setup.arrays);
    for (let n = 0; n < vertex_colors.length; n++) {
      const number = vertex_colors[n];
      for (let c = 0; c < 3; c++) {
        if (number >= 0) {
          colors[3 * n + c] = source[3 * number + c];
          continue;
        }
        const [first, last] = [polygon_starts[-1 - number], polygon_starts[-number]];
        let sum = 0;
        for (let corner = first; corner < last; corner++) sum += source[3 * polygon_corners[corner] + c];
        colors[3 * n + c] = sum / (last - first);
      }
    }
  }
}

/** Rows that are no mere copies of the cage, after those that are. @param {Float32Array} values */
function refine(values, { matrix_rows, matrix_starts, matrix_columns, matrix_weights }) {
  // From the last row to the first: rows of the cage itself move too, and all are made of the cage as it was.
  const made = new Float32Array(3 * matrix_rows.length);
  for (let n = 0, entry = 0; n < matrix_rows.length; n++) {
    let [x, y, z] = [0, 0, 0];
    for (const end = matrix_starts[n + 1]; entry < end; entry++) {
      const column = 3 * matrix_columns[entry];
      const weight = matrix_weights[entry];
      x += weight * values[column];
      y += weight * values[column + 1];
      z += weight * values[column + 2];
    }
    made[3 * n] = x;
    made[3 * n + 1] = y;
    made[3 * n + 2] = z;
  }
  for (let n = 0; n < matrix_rows.length; n++) {
    const row = 3 * matrix_rows[n];
    values[row] = made[3 * n];
    values[row + 1] = made[3 * n + 1];
    values[row + 2] = made[3 * n + 2];
  }
}

/** Normals of polygons, each as long as twice its area. */
function sumPolygons(points, { polygon_starts, polygon_corners }, out) {
  for (let f = 0; f + 1 < polygon_starts.length; f++) {
    const [start, end] = [polygon_starts[f], polygon_starts[f + 1]];
    const a = 3 * polygon_corners[start];
    let [x, y, z] = [0, 0, 0];
    for (let corner = start + 1; corner + 1 < end; corner++) {
      const b = 3 * polygon_corners[corner];
      const c = 3 * polygon_corners[corner + 1];
      const [ux, uy, uz] = [points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]];
      const [wx, wy, wz] = [points[c] - points[a], points[c + 1] - points[a + 1], points[c + 2] - points[a + 2]];
      x += uy * wz - uz * wy;
      y += uz * wx - ux * wz;
      z += ux * wy - uy * wx;
    }
    out[3 * f] = x;
    out[3 * f + 1] = y;
    out[3 * f + 2] = z;
  }
}

/** Unit normals of nodes, from those of the polygons around them. */
function sumNodes(normals, { node_starts, node_polygons }, out) {
  for (let n = 0, entry = 0; n + 1 < node_starts.length; n++) {
    let [x, y, z] = [0, 0, 0];
    for (const end = node_starts[n + 1]; entry < end; entry++) {
      const polygon = 3 * node_polygons[entry];
      x += normals[polygon];
      y += normals[polygon + 1];
      z += normals[polygon + 2];
    }
    const scale = 1 / Math.max(Math.sqrt(x * x + y * y + z * z), 1e-30);
    out[3 * n] = x * scale;
    out[3 * n + 1] = y * scale;
    out[3 * n + 2] = z * scale;
  }
}

/** @param {Float32Array} values @param {ArrayLike<number>} numbers @param {Float32Array} out */
function gather(values, numbers, out) {
  for (let n = 0; n < numbers.length; n++) {
    const from = 3 * numbers[n];
    out[3 * n] = values[from];
    out[3 * n + 1] = values[from + 1];
    out[3 * n + 2] = values[from + 2];
  }
}
