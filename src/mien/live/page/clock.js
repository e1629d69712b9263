// Clocks, percentiles and pauses: pure, so that they can be tried without sound and without a server.

/** Values of the last seconds. */
export class Recent {
  /** @param {number} spanS how long a value counts, seconds */
  constructor(spanS) {
    this.spanS = spanS;
    /** @type {{nowS: number, value: number}[]} */
    this.values = [];
  }

  /**
   * @param {number} value
   * @param {number} nowS clock that never goes back, seconds
   */
  add(value, nowS) {
    this.values.push({ nowS, value });
    this.forget(nowS);
  }

  /** @param {number} nowS */
  forget(nowS) {
    const kept = this.values.findIndex((each) => each.nowS > nowS - this.spanS);
    this.values.splice(0, kept < 0 ? this.values.length : kept);
  }

  clear() {
    this.values.length = 0;
  }

  /** @returns {number} how many values count */
  get count() {
    return this.values.length;
  }

  /**
   * The value that a share of the values does not pass; null where there are none.
   * @param {number} share 0 to 1
   * @param {(value: number) => number} [of] what is compared
   * @returns {number | null}
   */
  percentile(share, of = (value) => value) {
    const sorted = this.values.map((each) => of(each.value)).sort((one, other) => one - other);
    return sorted.length ? sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)] : null;
  }

  /** @returns {number} values a second, 0 where there are fewer than two */
  get perSecond() {
    const lasted = this.values.length > 1 ? this.values.at(-1).nowS - this.values[0].nowS : 0;
    return lasted > 0 ? (this.values.length - 1) / lasted : 0;
  }
}

const FIRST_PAUSE_MS = 250;
const LONGEST_PAUSE_MS = 5000;

/**
 * How long to wait before trying again: twice as long each time, up to five seconds, between half and all of it by
 * chance, so that many pages do not come back at once.
 * @param {number} failures in a row, from 1
 * @param {number} chance 0 to 1
 * @returns {number} milliseconds
 */
export function retryPause(failures, chance) {
  return Math.min(LONGEST_PAUSE_MS, FIRST_PAUSE_MS * 2 ** (failures - 1)) * (0.5 + chance / 2);
}

/**
 * The newest picture that is not ahead of a time of the face; null where all are.
 * @template {{timeS: number}} P
 * @param {P[]} pictures oldest first
 * @param {number} faceS the face's time, seconds
 * @returns {P | null}
 */
export function pictureAt(pictures, faceS) {
  return pictures.findLast((each) => each.timeS <= faceS) ?? null;
}

/**
 * When to start a sound, and where in it, so that it is heard in time: its first sample belongs to a moment that may
 * be over already.
 * @param {number} firstS when its first sample should have started, on the audio clock
 * @param {number} soonestS the first moment that can still be kept
 * @param {number} lengthS how long it is
 * @returns {{whenS: number, offsetS: number} | null} null where it would be over
 */
export function startOf(firstS, soonestS, lengthS) {
  const offsetS = Math.max(0, soonestS - firstS);
  return offsetS < lengthS ? { whenS: firstS + offsetS, offsetS } : null;
}
