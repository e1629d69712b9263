// What is being said, for the eyes and for screen readers.

const LINGER_MS = 2500;

/** @param {string} text @returns {string} its letters and digits, small */
const plain = (text) => text.toLowerCase().replace(/[^\p{L}\p{N}']/gu, "");

/**
 * The number of words of a text that have been said when one is: words of the voice are not always those of the text
 * (numbers are spelled out), so they are looked for, a few words on.
 * @param {string[]} words of the text
 * @param {number} said before
 * @param {string} word that is said now
 * @returns {number}
 */
export function countSaid(words, said, word) {
  const at = words.slice(said, said + 4).findIndex((each) => plain(each) === plain(word));
  return at < 0 ? said : said + at + 1;
}

export class Captions {
  /**
   * @param {HTMLElement} board where they are shown
   * @param {HTMLElement} heard what screen readers read
   */
  constructor(board, heard) {
    this.board = board;
    this.heard = heard;
    this.shown = false;
    this.words = [];
    this.said = 0;
    this.timer = 0;
  }

  /** @param {boolean} shown */
  show(shown) {
    this.shown = shown;
    this.board.hidden = !shown || !this.words.length;
  }

  /** @param {string} text that begins to be said */
  start(text) {
    window.clearTimeout(this.timer);
    this.words = text.split(/\s+/).filter(Boolean);
    this.said = 0;
    this.heard.textContent = text;
    this.board.replaceChildren(
      ...this.words.flatMap((word) => {
        const span = document.createElement("span");
        span.textContent = word;
        return [span, " "];
      }),
    );
    this.show(this.shown);
  }

  /** @param {string} word that begins to be said */
  word(word) {
    this.mark(countSaid(this.words, this.said, word));
  }

  /** @param {boolean} brokenOff whether the rest is not said any more */
  end(brokenOff) {
    if (!brokenOff) this.mark(this.words.length);
    this.timer = window.setTimeout(() => this.clear(), LINGER_MS);
  }

  clear() {
    this.words = [];
    this.show(this.shown);
  }

  /** @param {number} said */
  mark(said) {
    this.said = said;
    [...this.board.children].forEach((span, at) => span.classList.toggle("said", at < said));
  }
}
