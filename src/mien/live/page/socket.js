// The connection to the face: it opens by itself, again and again, and says why it is not there.

import { retryPause } from "./clock.js";

const SILENT_MS = 8000; // A live face sends many pictures a second: a line without any is dead.
const DRAWN = 1;
const PCM = 2;
const MOST_WAITING = 1 << 18; // Bytes; a voice that cannot be sent now is not wanted later.

/**
 * @typedef {object} Handlers
 * @property {() => object} subscription what to ask for when the connection opens
 * @property {(message: object) => void} onMessage a message in JSON
 * @property {(buffer: ArrayBuffer) => void} onBinary
 * @property {(why: string | null) => void} onChange it has opened (null), or why it has not
 */

/** One WebSocket after another to the host that the page came from; its cookie opens them. */
export class Connection {
  /** @param {Handlers} handlers */
  constructor(handlers) {
    this.handlers = handlers;
    this.failures = 0;
    /** @type {WebSocket | null} */
    this.socket = null;
    this.retry = 0;
    document.addEventListener("visibilitychange", () => this.hurry());
    window.addEventListener("online", () => this.hurry());
    window.setInterval(() => this.watch(), SILENT_MS / 4);
    this.open();
  }

  get opened() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  open() {
    window.clearTimeout(this.retry);
    this.retry = 0;
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss:" : "ws:"}//${location.host}/live`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.heardMs = performance.now();
    let greeted = false;
    socket.onopen = () => {
      greeted = true;
      this.send({ kind: "subscribe", ...this.handlers.subscription() });
      this.handlers.onChange(null);
    };
    socket.onmessage = ({ data }) => {
      this.failures = 0;
      this.heardMs = performance.now();
      if (typeof data !== "string") {
        this.handlers.onBinary(data);
        return;
      }
      const value = JSON.parse(data);
      for (const message of Array.isArray(value) ? value : [value]) this.handlers.onMessage(message);
    };
    socket.onclose = (event) => this.lose(socket, greeted, event.reason);
  }

  /**
   * @param {WebSocket} socket
   * @param {boolean} greeted whether it had opened
   * @param {string} reason that the server gave
   */
  async lose(socket, greeted, reason) {
    if (socket !== this.socket) return;
    this.socket = null;
    this.failures += 1;
    this.retry = window.setTimeout(() => this.open(), retryPause(this.failures, Math.random()));
    const why = greeted ? reason || "The connection is lost." : await whyNot();
    if (!this.opened) this.handlers.onChange(why);
  }

  /** Try now instead of later: somebody looks, or the network is back. */
  hurry() {
    if (this.retry && !document.hidden) this.open();
  }

  watch() {
    const { socket } = this;
    if (!socket || document.hidden || performance.now() - this.heardMs < SILENT_MS) return;
    // Closing waits for an answer, which a dead line does not give.
    socket.close();
    void this.lose(socket, true, "");
  }

  /** @param {object} message */
  send(message) {
    if (this.opened) this.socket.send(JSON.stringify(message));
  }

  /**
   * Tell that a picture was drawn, so that newer ones may come.
   * @param {number} setup
   * @param {number} loop
   */
  sendDrawn(setup, loop) {
    if (!this.opened) return;
    const view = new DataView(new ArrayBuffer(8));
    view.setUint8(0, DRAWN);
    view.setUint16(2, setup, true);
    view.setUint32(4, loop, true);
    this.socket.send(view.buffer);
  }

  /**
   * Send a piece of a live voice.
   * @param {number} rateHz
   * @param {Int16Array} samples
   */
  sendVoice(rateHz, samples) {
    if (!this.opened || this.socket.bufferedAmount > MOST_WAITING) return;
    const view = new DataView(new ArrayBuffer(8 + 2 * samples.length));
    view.setUint8(0, PCM);
    view.setUint32(4, rateHz, true);
    samples.forEach((sample, at) => view.setInt16(8 + 2 * at, sample, true));
    this.socket.send(view.buffer);
  }
}

/** Why no WebSocket opens: browsers do not tell, an ordinary request does. */
async function whyNot() {
  try {
    const { status } = await fetch("/about", { cache: "no-store" });
    if (status === 401 || status === 403) return "This link is no longer valid: open the one that mien live has printed.";
    return "The face does not take a connection.";
  } catch {
    return "The face does not answer.";
  }
}
