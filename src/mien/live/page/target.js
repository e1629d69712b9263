/**
 * Where a picture is drawn before it is shown: four samples a pixel, averaged in linear light.
 *
 * A canvas averages codes of sRGB, which makes lashes too dark and the spots in eyes too dim. What is drawn here is
 * linear and already multiplied by its alpha; textures of sRGB keep it in eight bits.
 */

import { link } from "./program.js";
import { SHOW_FRAGMENT, WHOLE_VERTEX } from "./shaders.js";

const SAMPLES = 4;

export class Target {
  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    this.program = link(gl, WHOLE_VERTEX, SHOW_FRAGMENT);
    this.samples = gl.createFramebuffer();
    this.averages = gl.createFramebuffer();
    this.color = gl.createRenderbuffer();
    this.depth = gl.createRenderbuffer();
    this.texture = gl.createTexture();
    this.width = this.height = 0;
  }

  /** What is drawn from now on comes here. @param {number} width @param {number} height pixels */
  begin(width, height) {
    const { gl } = this;
    if (width !== this.width || height !== this.height) this.fit(width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.samples);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  /** Shows it on the canvas. */
  show() {
    const { gl, width, height } = this;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.samples);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.averages);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.useProgram(this.program.program);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  dispose() {
    const { gl } = this;
    for (const buffer of [this.samples, this.averages]) gl.deleteFramebuffer(buffer);
    for (const buffer of [this.color, this.depth]) gl.deleteRenderbuffer(buffer);
    gl.deleteTexture(this.texture);
    gl.deleteProgram(this.program.program);
  }

  /** @param {number} width @param {number} height */
  fit(width, height) {
    const { gl } = this;
    this.width = width;
    this.height = height;
    const samples = Math.min(SAMPLES, gl.getParameter(gl.MAX_SAMPLES));
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.samples);
    for (const [buffer, format, place] of [
      [this.color, gl.SRGB8_ALPHA8, gl.COLOR_ATTACHMENT0],
      [this.depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT],
    ]) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
    }
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.averages);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.texture, 0);
  }
}
