// Pictures on their way to the screen: which one is drawn now, and how late.

import { Recent, pictureAt } from "./clock.js";

const MOST = 2;
const MOST_HELD = 30; // Half a second at 60 Hz: no headphones are slower than that.
const RECENT_S = 2;

/** @typedef {{setup: number, loop: number, timeS: number}} Picture */

/** The newest pictures, and what they are measured by. Clocks are the page's, in seconds. */
export class Pictures {
  constructor() {
    this.lags = new Recent(RECENT_S);
    this.draws = new Recent(RECENT_S);
    this.forget();
  }

  /** Nothing is known any more: another face, or another server. */
  forget() {
    /** @type {Picture[]} */
    this.waiting = [];
    /** @type {Picture | null} */
    this.drawn = null;
    /** @type {Picture | null} */
    this.newest = null;
    this.seen = this.told = true;
    this.lags.clear();
  }

  /**
   * @param {Picture} picture
   * @param {boolean} held whether pictures are held back for a slow sound
   */
  add(picture, held) {
    this.waiting.push(picture);
    this.waiting.splice(0, this.waiting.length - (held ? MOST_HELD : MOST));
    this.newest = picture;
    this.seen = this.told = false;
  }

  /**
   * See how late the newest picture could be drawn.
   * @param {number} nowS
   */
  look(nowS) {
    if (!this.seen) this.lags.add(nowS - this.newest.timeS, nowS);
    this.seen = true;
  }

  /** By how much the page's clock is ahead of the face's when a picture can be drawn; null where none has come. */
  get lagS() {
    return this.lags.percentile(0.5);
  }

  /**
   * The picture to draw now; null where it is drawn already.
   * @param {number} nowS
   * @param {number | null} faceS the face's time that is wanted; null for the newest
   * @returns {Picture | null}
   */
  take(nowS, faceS) {
    const chosen = faceS === null ? this.waiting.at(-1) : pictureAt(this.waiting, faceS);
    if (!chosen) return null;
    this.waiting.splice(0, this.waiting.indexOf(chosen) + 1);
    this.drawn = chosen;
    this.draws.add(chosen.loop, nowS);
    return chosen;
  }

  /**
   * The picture that the server may be told to be through, so that newer ones come; null where it has been told.
   * @returns {Picture | null}
   */
  tell() {
    if (this.told) return null;
    this.told = true;
    return this.newest;
  }
}
