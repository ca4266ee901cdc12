// The clock: the coordinate at a given speed, around or to and fro, slower than life if need be.

/** A turn, or a stroke, takes at least so long on the screen, s. */
const SHORTEST = 1.6;
/** A step of the clock is no longer than this, s: after a pause of the browser nothing jumps. */
const LONGEST_STEP = 0.1;
const SLOW = [1, 2, 5];

/**
 * Return how many times slower than life a range is played: 1, 2, 5, 10 …
 * @param {number} span of the coordinate
 * @param {number} speed of it
 */
export function slowness(span, speed) {
  const wanted = (SHORTEST * Math.abs(speed)) / span;
  if (!(wanted > 1) || !Number.isFinite(wanted)) return 1;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * (SLOW.find((step) => step * power >= wanted * (1 - 1e-9)) ?? 10);
}

export class Player {
  /**
   * @param {import("./turn.js").Turn} turn
   * @param {(q: number) => void} show called for each frame
   * @param {{request: (f: (now: number) => void) => number, cancel: (id: number) => void}} [clock]
   */
  constructor(turn, show, clock = { request: (f) => requestAnimationFrame(f), cancel: (id) => cancelAnimationFrame(id) }) {
    this.turn = turn;
    this.show = show;
    this.clock = clock;
    this.q = turn.low;
    this.speed = 1;
    /** The way it goes: a bounded motion turns about at its ends. */
    this.sense = 1;
    this.turns = 0;
    this.frame = 0;
    this.last = null;
  }

  get isPlaying() {
    return this.frame !== 0;
  }

  /** How many times slower than life it is played. */
  get slowness() {
    const span = this.turn.closes ? Math.min(this.turn.high - this.turn.low, 2 * Math.PI) : this.turn.high - this.turn.low;
    return slowness(span, this.speed);
  }

  play() {
    if (this.isPlaying) return;
    this.last = null;
    this.frame = this.clock.request((now) => this.#tick(now));
  }

  pause() {
    if (!this.isPlaying) return;
    this.clock.cancel(this.frame);
    this.frame = 0;
  }

  /** Go to a coordinate; beyond the range to its end, or around. */
  seek(q) {
    const own = this.turn.bring(q);
    this.q = own;
    this.show(own);
  }

  /** Advance by a time, s. */
  advance(seconds) {
    const { turn } = this;
    const step = (this.sense * this.speed * seconds) / this.slowness;
    let q = this.q + step;
    if (turn.closes) {
      if (q >= turn.high) this.turns += 1;
      if (q < turn.low) this.turns -= 1;
      q = turn.bring(q);
    } else if (q > turn.high && turn.unit === "time") {
      // Time does not go back: from the beginning again.
      q = turn.low;
    } else if (q > turn.high || q < turn.low) {
      // To and fro.
      const end = q > turn.high ? turn.high : turn.low;
      q = Math.min(Math.max(2 * end - q, turn.low), turn.high);
      this.sense = -this.sense;
    }
    this.q = q;
  }

  #tick(now) {
    this.frame = this.clock.request((next) => this.#tick(next));
    if (this.last !== null) this.advance(Math.min((now - this.last) / 1000, LONGEST_STEP));
    this.last = now;
    this.show(this.q);
  }
}
