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
    const { matrix_rows, vertex_points, polygon_starts, node_starts } = setup.arrays;
    const vertices = vertex_points.length;
    this.refined = new Float32Array(3 * setup.refined_points);
    this.refinedColors = new Float32Array(setup.colored_by === "vertex" ? this.refined.length : 0);
    this.made = new Float32Array(3 * matrix_rows.length);
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
    const [x, y, z] = setup.middle;
    for (let n = 0; n < points.length; n += 3) {
      put(refined, n, x + step * points[n], y + step * points[n + 1], z + step * points[n + 2]);
    }
    refine(refined, setup.arrays, this.made);
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
    if (byVertex) refine(source, setup.arrays, this.made);
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

/**
 * Makes the rows of a surface that are no mere copies of the cage; the cage lies in the first ones.
 *
 * @param {Float32Array} values three a row @param {Object<string, any>} arrays of the setup @param {Float32Array} made
 */
function refine(values, { matrix_rows: rows, matrix_starts: starts, matrix_columns, matrix_weights }, made) {
  // All are made of the cage as it was before its own rows move.
  for (let n = 0; n < rows.length; n++) {
    const end = starts[n + 1];
    let x = 0;
    let y = 0;
    let z = 0;
    for (let entry = starts[n]; entry < end; entry++) {
      const column = 3 * matrix_columns[entry];
      const weight = matrix_weights[entry];
      x += weight * values[column];
      y += weight * values[column + 1];
      z += weight * values[column + 2];
    }
    put(made, 3 * n, x, y, z);
  }
  for (let n = 0; n < rows.length; n++) put(values, 3 * rows[n], made[3 * n], made[3 * n + 1], made[3 * n + 2]);
}

/**
 * Normals of polygons, each as long as twice its area.
 *
 * @param {Float32Array} points @param {Object<string, any>} arrays of the setup @param {Float32Array} out
 */
function sumPolygons(points, { polygon_starts: starts, polygon_corners: corners }, out) {
  for (let f = 0; f + 1 < starts.length; f++) {
    const last = starts[f + 1] - 1;
    const a = 3 * corners[starts[f]];
    let x = 0;
    let y = 0;
    let z = 0;
    for (let corner = starts[f] + 1; corner < last; corner++) {
      const b = 3 * corners[corner];
      const c = 3 * corners[corner + 1];
      const ux = points[b] - points[a];
      const uy = points[b + 1] - points[a + 1];
      const uz = points[b + 2] - points[a + 2];
      const wx = points[c] - points[a];
      const wy = points[c + 1] - points[a + 1];
      const wz = points[c + 2] - points[a + 2];
      x += uy * wz - uz * wy;
      y += uz * wx - ux * wz;
      z += ux * wy - uy * wx;
    }
    put(out, 3 * f, x, y, z);
  }
}

/**
 * Unit normals of nodes, from those of the polygons around them.
 *
 * @param {Float32Array} normals @param {Object<string, any>} arrays of the setup @param {Float32Array} out
 */
function sumNodes(normals, { node_starts: starts, node_polygons: polygons }, out) {
  for (let n = 0; n + 1 < starts.length; n++) {
    const end = starts[n + 1];
    let x = 0;
    let y = 0;
    let z = 0;
    for (let entry = starts[n]; entry < end; entry++) {
      const polygon = 3 * polygons[entry];
      x += normals[polygon];
      y += normals[polygon + 1];
      z += normals[polygon + 2];
    }
    const scale = 1 / Math.max(Math.sqrt(x * x + y * y + z * z), 1e-30);
    put(out, 3 * n, x * scale, y * scale, z * scale);
  }
}

/** @param {Float32Array} values @param {ArrayLike<number>} numbers @param {Float32Array} out */
function gather(values, numbers, out) {
  for (let n = 0; n < numbers.length; n++) {
    const from = 3 * numbers[n];
    put(out, 3 * n, values[from], values[from + 1], values[from + 2]);
  }
}

/** @param {Float32Array} out @param {number} place @param {number} x @param {number} y @param {number} z */
function put(out, place, x, y, z) {
  out[place] = x;
  out[place + 1] = y;
  out[place + 2] = z;
}
