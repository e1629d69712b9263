/**
 * Drawings on a Canvas2D: the canvas of the drawing, centred, as large as fits.
 *
 * @import { DrawingFrame, Outline, Path, Setup } from "./frames.js"
 */

import { fitPixels, fromLinear, toLinear } from "./canvas.js";

/** Stops of the background: it runs evenly in linear light, and gradients run in sRGB. */
const STOPS = 17;

/** Width of the line around what fills a hole, half of it under what has the hole; pixels. */
const OVERLAP_PX = 2;

export class DrawingView {
  /** @param {HTMLCanvasElement} canvas @param {Setup} _setup */
  constructor(canvas, _setup) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    /** @type {DrawingFrame | null} */
    this.frame = null;
    fitPixels(canvas);
  }

  /** @param {DrawingFrame} frame */
  draw(frame) {
    this.frame = frame;
    const { canvas, context } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.fillStyle = gradient(context, canvas.height, frame.background);
    context.fillRect(0, 0, canvas.width, canvas.height);
    const [width, height] = frame.size;
    const scale = Math.min(canvas.width / width, canvas.height / height);
    // It stands on the lower edge: what lies below, such as a hand that rests, is out of sight.
    const [left, bottom] = [(canvas.width - scale * width) / 2, canvas.height];
    const areas = frame.outlines.map((outline) => trace(outline, scale, left, bottom));
    for (const path of frame.paths) this.fill(path, areas, frame);
  }

  /** The canvas has another size: draws the last frame again. */
  resize() {
    if (fitPixels(this.canvas) && this.frame) this.draw(this.frame);
  }

  dispose() {
    this.frame = null;
  }

  /** @param {Path} path @param {Path2D[]} areas of all outlines @param {DrawingFrame} frame */
  fill(path, areas, { outlines, paths }) {
    const { context } = this;
    context.save();
    for (const number of path.inside) context.clip(areas[number], outlines[number].rule);
    for (const number of path.outside) context.clip(around(this.canvas, areas[number]), "evenodd");
    context.fillStyle = context.strokeStyle = css(path.color);
    context.fill(areas[path.outline], outlines[path.outline].rule);
    context.restore();
    for (const number of path.under) {
      // Where the hole that it fills ends both cover their part of a pixel; nothing may shine through.
      context.save();
      context.clip(areas[number], outlines[number].rule);
      context.strokeStyle = css(path.color);
      context.lineWidth = OVERLAP_PX;
      context.stroke(areas[path.outline]);
      context.restore();
    }
  }
}

/** @param {Outline} outline @param {number} scale @param {number} left @param {number} bottom pixels */
function trace({ contours }, scale, left, bottom) {
  const area = new Path2D();
  for (const line of contours) {
    for (let n = 0; n < line.length; n += 2) {
      const [x, y] = [left + line[n] * scale, bottom - line[n + 1] * scale];
      if (n) area.lineTo(x, y);
      else area.moveTo(x, y);
    }
    area.closePath();
  }
  return area;
}

/** All of the canvas but an area, by the rule evenodd. @param {HTMLCanvasElement} canvas @param {Path2D} area */
function around(canvas, area) {
  const all = new Path2D(area);
  all.rect(0, 0, canvas.width, canvas.height);
  return all;
}

/** @param {CanvasRenderingContext2D} context @param {number} height @param {[number[], number[]]} background */
function gradient(context, height, [bottom, top]) {
  const gradient = context.createLinearGradient(0, height, 0, 0);
  for (let stop = 0; stop < STOPS; stop++) {
    const up = stop / (STOPS - 1);
    const mixed = [0, 1, 2].map((c) => 255 * fromLinear(toLinear(bottom[c]) * (1 - up) + toLinear(top[c]) * up));
    gradient.addColorStop(up, css([...mixed, bottom[3] * (1 - up) + top[3] * up]));
  }
  return gradient;
}

/** @param {number[]} color sRGB bytes and straight alpha */
function css([red, green, blue, alpha]) {
  return `rgb(${red} ${green} ${blue} / ${alpha / 255})`;
}
