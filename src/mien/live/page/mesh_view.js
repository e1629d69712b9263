/**
 * Meshes by WebGL2: light on every pixel, orbit by dragging; a double click turns back.
 *
 * @import { MeshFrame, Setup } from "./frames.js"
 */

import { fitPixels } from "./canvas.js";
import { Orbit, project } from "./orbit.js";
import { link } from "./program.js";
import * as shaders from "./shaders.js";
import { Surface } from "./surface.js";
import { Target } from "./target.js";

export class MeshView {
  /** @param {HTMLCanvasElement} canvas @param {Setup} setup */
  constructor(canvas, setup) {
    this.canvas = canvas;
    this.setup = setup;
    this.surface = new Surface(setup);
    this.orbit = new Orbit(canvas, () => this.paintSoon());
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL2, which a head is drawn by");
    this.gl = gl;
    this.drawn = false;
    /** Number of the paint that is asked for; 0 where none is. */
    this.awaited = 0;
    this.listeners = new AbortController();
    const { signal } = this.listeners;
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault(), { signal });
    canvas.addEventListener("webglcontextrestored", () => this.restore(), { signal });
    fitPixels(canvas);
    this.prepare();
  }

  /** @param {MeshFrame} frame */
  draw(frame) {
    const recolored = this.surface.update(frame);
    this.drawn = true;
    if (this.gl.isContextLost()) return;
    this.upload(recolored);
    this.paint();
  }

  /** The canvas has another size: draws the last frame again. */
  resize() {
    if (fitPixels(this.canvas)) this.paint();
  }

  dispose() {
    this.listeners.abort();
    this.orbit.dispose();
    cancelAnimationFrame(this.awaited);
    const { gl } = this;
    for (const buffer of [...Object.values(this.buffers), this.triangles]) gl.deleteBuffer(buffer);
    gl.deleteVertexArray(this.vertices);
    this.target.dispose();
    for (const program of [this.program, this.behind]) gl.deleteProgram(program.program);
  }

  /** Programs and buffers: at the start, and when the context has come back. */
  prepare() {
    const { gl, surface } = this;
    this.program = link(gl, shaders.SURFACE_VERTEX, shaders.SURFACE_FRAGMENT);
    this.behind = link(gl, shaders.WHOLE_VERTEX, shaders.BACKGROUND_FRAGMENT);
    this.target = new Target(gl);
    this.vertices = gl.createVertexArray();
    gl.bindVertexArray(this.vertices);
    this.buffers = {
      point: this.attribute("point", surface.points),
      normal: this.attribute("normal", surface.normals),
      color: this.attribute("color", surface.colors),
    };
    this.triangles = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.triangles);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, this.setup.arrays.triangles, gl.STATIC_DRAW);
  }

  restore() {
    this.prepare();
    if (this.drawn) this.paint();
  }

  /** @param {string} name @param {Float32Array} values three a vertex */
  attribute(name, values) {
    const { gl } = this;
    const place = gl.getAttribLocation(this.program.program, name);
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    return buffer;
  }

  /** @param {boolean} recolored whether colours have changed too */
  upload(recolored) {
    const { gl, surface, buffers } = this;
    const rows = [
      [buffers.point, surface.points],
      [buffers.normal, surface.normals],
      ...(recolored ? [[buffers.color, surface.colors]] : []),
    ];
    for (const [buffer, values] of rows) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, values);
    }
  }

  /** Paints before the browser next shows anything: a hand moves more often than that. */
  paintSoon() {
    this.awaited ||= requestAnimationFrame(() => this.paint());
  }

  /** Draws what was sent last, as it is seen from here. */
  paint() {
    const { gl, canvas, setup } = this;
    cancelAnimationFrame(this.awaited);
    this.awaited = 0;
    if (!this.drawn || gl.isContextLost()) return;
    this.target.begin(canvas.width, canvas.height);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.useProgram(this.behind.program);
    gl.uniform4fv(this.behind.place("ends"), setup.background.flat());
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.program.program);
    this.light();
    gl.bindVertexArray(this.vertices);
    const { BYTES_PER_ELEMENT, constructor } = setup.arrays.triangles;
    const kind = constructor === Uint16Array ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT;
    for (const part of setup.parts) {
      if (part.two_sided) gl.disable(gl.CULL_FACE);
      else gl.enable(gl.CULL_FACE);
      gl.uniform3f(this.program.place("material"), part.gloss, part.power, part.lit ? 1 : 0);
      gl.drawElements(gl.TRIANGLES, 3 * part.count, kind, 3 * part.first * BYTES_PER_ELEMENT);
    }
    this.target.show();
  }

  /** Camera and lamps. */
  light() {
    const { gl, canvas, setup, program, orbit } = this;
    const { camera, lamps } = setup;
    const position = orbit.turn(camera.position, camera.at);
    gl.uniformMatrix4fv(program.place("projection"), false, project(camera, position, canvas.width, canvas.height));
    gl.uniform3fv(program.place("viewer"), position);
    gl.uniform3fv(program.place("ambient"), setup.ambient.flat());
    const seen = lamps.slice(0, shaders.MOST_LAMPS);
    const places = seen.map((lamp) => (setup.lamps_follow ? orbit.swing(lamp.position) : lamp.position));
    gl.uniform1i(program.place("lampCount"), seen.length);
    if (seen.length) {
      gl.uniform4fv(program.place("lampPlace"), seen.flatMap((lamp, n) => [...places[n], lamp.wrap]));
      gl.uniform3fv(program.place("lampColor"), seen.flatMap((lamp) => lamp.color));
    }
    gl.uniform1f(program.place("cosinePower"), setup.cosine_power);
  }
}
