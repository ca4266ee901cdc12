// The clock of the lesson, and how fast the support is dragged.

/** A step is no longer than this, s: after a pause of the browser nothing jumps. */
const LONGEST_LESSON_STEP = 0.1;
/** The speed of the support is that of so much time, s. */
const SPEED_WINDOW = 0.05;

/**
 * What gives frames; tests have their own.
 * @typedef {Object} Frames
 * @property {(frame: (now: number) => void) => number} request
 * @property {(id: number) => void} cancel
 * @property {() => number} now ms
 */

/** @type {Frames} */
export const BROWSER_FRAMES = {
  request: (frame) => requestAnimationFrame(frame),
  cancel: (id) => cancelAnimationFrame(id),
  now: () => performance.now(),
};

export class LessonClock {
  #frame = 0;
  #last = null;

  /**
   * @param {(seconds: number) => void} step called for each frame
   * @param {Frames} frames
   */
  constructor(step, frames) {
    this.step = step;
    this.frames = frames;
  }

  get isRunning() {
    return this.#frame !== 0;
  }

  start() {
    if (this.isRunning) return;
    this.#last = null;
    this.#frame = this.frames.request((now) => this.#tick(now));
  }

  stop() {
    if (this.isRunning) this.frames.cancel(this.#frame);
    this.#frame = 0;
  }

  #tick(now) {
    this.#frame = this.frames.request((next) => this.#tick(next));
    const seconds = this.#last === null ? 0 : Math.min((now - this.#last) / 1000, LONGEST_LESSON_STEP);
    this.#last = now;
    this.step(seconds);
  }
}

export class SupportSpeed {
  #places = [];

  /**
   * Note where the support is.
   * @param {number} l4
   * @param {number} now s
   */
  note(l4, now) {
    this.#places.push([now, l4]);
    // One before the window stays: there the support was when the window begins.
    while (this.#places.length > 1 && this.#places[1][0] <= now - SPEED_WINDOW) this.#places.shift();
  }

  /** The support stands: what was before does not count. */
  clear() {
    this.#places = [];
  }

  /** Return dl4/dt over the last 50 ms, m to a second of the screen. */
  at(now) {
    if (!this.#places.length) return 0;
    const from = now - SPEED_WINDOW;
    let before = this.#places[0];
    for (const place of this.#places) if (place[0] <= from) before = place;
    // A drag that has just begun came from standing.
    return (this.#places[this.#places.length - 1][1] - before[1]) / SPEED_WINDOW;
  }
}
