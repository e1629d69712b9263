// What the face says, heard in time with its lips.

import { Recent, startOf } from "./clock.js";

const MOST_BYTES = 48 << 20; // More than ten minutes, which is the most that can wait to be said.
const FADE_S = 0.012; // Short enough not to be heard as a fade, long enough not to click.
const SOON_S = 0.01; // What is scheduled nearer than this starts late.
const LEAD_S = 0.05; // Live speech begins with more silence than this, which may be skipped.
const ASTRAY_S = 0.06; // Sound that has left its lips by more is started anew.
const PATIENCE_S = 0.4;

/**
 * @typedef {object} Playing
 * @property {number} number of the utterance
 * @property {number} faceS the face's time of its first sample
 * @property {number} firstS the same moment on the audio clock
 * @property {number} whenS when it starts to sound, on the audio clock
 * @property {number} endS when it is over, on the audio clock
 * @property {AudioBufferSourceNode} source
 * @property {GainNode} gain
 */

export class Sound {
  /** @param {(state: "off" | "blocked" | "on") => void} onChange */
  constructor(onChange) {
    this.onChange = onChange;
    this.context = new AudioContext({ latencyHint: "interactive" });
    this.context.addEventListener("statechange", () => this.change());
    // A context that may sound takes a moment to say so.
    window.setTimeout(() => this.change(), 400);
    /** @type {Map<number, {rateHz: number, samples: Int16Array}>} */
    this.kept = new Map();
    this.keptBytes = 0;
    /** @type {{number: number, faceS: number} | null} */
    this.saying = null;
    /** @type {Playing[]} */
    this.playing = [];
    /** @type {number | null} */
    this.delayS = null;
    this.aheadS = 0;
    this.readings = new Recent(2);
    this.astraySinceS = Infinity;
  }

  get state() {
    return this.context.state === "running" ? "on" : "blocked";
  }

  change() {
    this.readings.clear();
    this.onChange(this.state);
    if (this.state === "on") this.play();
  }

  /** Begin to sound, where a browser wants to be asked; in the middle of a sentence if one is running. */
  async resume() {
    if (this.state === "blocked") await this.context.resume();
  }

  /**
   * Keep what is going to be said.
   * @param {number} number of the utterance
   * @param {number} rateHz
   * @param {Int16Array} samples
   */
  keep(number, rateHz, samples) {
    this.drop(number);
    this.kept.set(number, { rateHz, samples });
    this.keptBytes += samples.byteLength;
    for (const oldest of this.kept.keys()) {
      if (this.keptBytes <= MOST_BYTES) break;
      this.drop(oldest);
    }
  }

  /** @param {number} number */
  drop(number) {
    this.keptBytes -= this.kept.get(number)?.samples.byteLength ?? 0;
    this.kept.delete(number);
  }

  /**
   * An utterance begins.
   * @param {number} number
   * @param {number} faceS the face's time of its first sample
   */
  start(number, faceS) {
    this.saying = { number, faceS };
    this.play();
  }

  /**
   * An utterance is over, or broken off: then it falls silent at once.
   * @param {number} number
   * @param {boolean} brokenOff
   */
  end(number, brokenOff) {
    if (this.saying?.number === number) this.saying = null;
    this.drop(number);
    if (brokenOff) this.silence(number);
  }

  /** All is over: the connection is lost, and another server may answer. */
  forget() {
    this.saying = this.delayS = null;
    this.kept.clear();
    this.keptBytes = 0;
    for (const { number } of [...this.playing]) this.silence(number);
  }

  /** Play what is being said from where it is now. */
  play() {
    const { context, saying } = this;
    const sound = saying && this.kept.get(saying.number);
    if (!sound?.samples.length || this.state !== "on" || this.delayS === null) return;
    this.readClock(performance.now() / 1000);
    const lengthS = sound.samples.length / sound.rateHz;
    const firstS = saying.faceS + this.delayS + this.aheadS;
    const start = startOf(firstS, context.currentTime + SOON_S, lengthS);
    if (!start) return;
    this.silence(saying.number);
    const buffer = context.createBuffer(1, sound.samples.length, sound.rateHz);
    buffer.copyToChannel(Float32Array.from(sound.samples, (sample) => sample / 32768), 0);
    const source = new AudioBufferSourceNode(context, { buffer });
    const gain = new GainNode(context);
    if (start.offsetS > 0) {
      gain.gain.setValueAtTime(0, start.whenS);
      gain.gain.linearRampToValueAtTime(1, start.whenS + FADE_S);
    }
    source.connect(gain).connect(context.destination);
    source.start(start.whenS, start.offsetS);
    const playing = { ...saying, firstS, whenS: start.whenS, endS: firstS + lengthS, source, gain };
    this.playing.push(playing);
    source.onended = () => {
      gain.disconnect();
    };
  }

  /** @param {number} number */
  silence(number) {
    const nowS = this.context.currentTime;
    for (const { source, gain } of this.playing.filter((each) => each.number === number)) {
      gain.gain.cancelAndHoldAtTime?.(nowS);
      gain.gain.setTargetAtTime(0, nowS, FADE_S / 4);
      source.stop(nowS + FADE_S);
    }
    this.playing = this.playing.filter((each) => each.number !== number);
  }

  /**
   * Read how far the audio clock, as it is heard, is ahead of the page's; half of the last readings are below it.
   * Source: Web Audio API, AudioContext.getOutputTimestamp and outputLatency.
   * @param {number} nowS the page's clock
   */
  readClock(nowS) {
    const { contextTime = 0, performanceTime = 0 } = this.context.getOutputTimestamp?.() ?? {};
    // Some browsers tell nothing, or what was true before the device changed.
    const told = contextTime > 0 && Math.abs(nowS - performanceTime / 1000) < 1;
    const aheadS = told
      ? contextTime - performanceTime / 1000
      : this.context.currentTime - this.latencyS - nowS;
    this.readings.add(aheadS, nowS);
    this.aheadS = this.readings.percentile(0.5);
  }

  /** Seconds from the audio clock to the ear. */
  get latencyS() {
    return this.context.outputLatency || this.context.baseLatency || 0;
  }

  /** How much later than they could be pictures must be drawn for sound to keep up with them, seconds. */
  get slowS() {
    return this.state === "on" ? Math.max(0, this.latencyS - LEAD_S) : 0;
  }

  /**
   * The face's time of what is heard now; null where nothing sounds.
   * @param {number} nowS the page's clock
   * @param {number} delayS how much later than the face's time pictures of it are drawn, on the page's clock
   * @returns {number | null}
   */
  heardS(nowS, delayS) {
    const first = this.delayS === null;
    this.delayS = delayS;
    if (this.state !== "on") return null;
    if (first) this.play();
    this.readClock(nowS);
    const heardS = nowS + this.aheadS;
    this.playing = this.playing.filter((each) => heardS < each.endS);
    const sounding = this.playing.findLast((each) => each.whenS <= heardS);
    if (!sounding) return null;
    this.keepTogether(sounding, nowS);
    return sounding.faceS + heardS - sounding.firstS;
  }

  /**
   * Start a sound anew that has left the pictures: the face was held up, or the sound was.
   * @param {Playing} sounding
   * @param {number} nowS
   */
  keepTogether(sounding, nowS) {
    const astrayS = sounding.firstS - this.aheadS - this.delayS - sounding.faceS;
    this.astraySinceS = Math.abs(astrayS) < ASTRAY_S ? Infinity : Math.min(this.astraySinceS, nowS);
    if (nowS - this.astraySinceS < PATIENCE_S || sounding.number !== this.saying?.number) return;
    this.astraySinceS = Infinity;
    this.play();
  }
}
