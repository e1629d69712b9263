/** What both views need: the size of a canvas in pixels, and the transfer function of sRGB (IEC 61966-2-1). */

/**
 * Gives a canvas the pixels of its place on the screen; says whether they have changed.
 *
 * @param {HTMLCanvasElement} canvas
 */
export function fitPixels(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width === width && canvas.height === height) return false;
  canvas.width = width;
  canvas.height = height;
  return true;
}

const LINEAR = Float32Array.from({ length: 256 }, (_, code) => {
  const share = code / 255;
  return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
});

/** Linear light 0..1 of a code 0..255. @param {number} code */
export function toLinear(code) {
  return LINEAR[code];
}

/** sRGB share 0..1 of linear light. @param {number} light */
export function fromLinear(light) {
  const share = Math.min(Math.max(light, 0), 1);
  return share <= 0.0031308 ? 12.92 * share : 1.055 * share ** (1 / 2.4) - 0.055;
}
