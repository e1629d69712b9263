// What the page tells about itself: a notice when something is wrong, numbers when somebody asks.

const STALE_S = 1.5;
const PASSING_MS = 7000;

/** A line for people: what lasts (no picture), or for some seconds what has just happened. */
export class Notice {
  /** @param {HTMLElement} board */
  constructor(board) {
    this.board = board;
    this.lasting = "";
    this.passing = "";
    this.timer = 0;
  }

  /** @param {string} text empty where all is well */
  last(text) {
    this.lasting = text;
    this.write();
  }

  /** @param {string} text */
  pass(text) {
    window.clearTimeout(this.timer);
    this.passing = text;
    this.timer = window.setTimeout(() => this.pass(""), PASSING_MS);
    this.write();
  }

  write() {
    const text = this.lasting || this.passing;
    if (this.board.textContent !== text) this.board.textContent = text;
    this.board.hidden = !text;
  }
}

/**
 * What is wrong with the picture; empty where nothing is.
 * @param {string | null} why there is no connection; null where there is one
 * @param {number | null} silentS since the last picture came; null where none has
 * @returns {string}
 */
export function trouble(why, silentS) {
  if (silentS === null) return why ?? "";
  if (silentS < STALE_S) return "";
  return `No picture for ${Math.floor(silentS)} s. ${why ?? "The face is not sending any."}`;
}

/**
 * @param {HTMLElement} board a list of descriptions
 * @param {[string, string][]} rows names and values
 */
export function writeStatus(board, rows) {
  board.replaceChildren(
    ...rows.flatMap(([name, value]) => {
      const [term, description] = [document.createElement("dt"), document.createElement("dd")];
      term.textContent = name;
      description.textContent = value;
      return [term, description];
    }),
  );
}

/**
 * @param {number | null} seconds
 * @returns {string} in milliseconds
 */
export function showMs(seconds) {
  return seconds === null ? "–" : `${(seconds * 1000).toFixed(0)} ms`;
}
