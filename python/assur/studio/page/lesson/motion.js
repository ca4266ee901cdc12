// The motion of the lesson as the server gave it: stretches of the turn, each smooth; in between
// joint C jams, or the rocker swings again.

import { pointState } from "../../../pictures/page/quantities.js";
import { Turn } from "../../../pictures/page/turn.js";

const FULL_TURN = 2 * Math.PI;
const ORDERS = 3;
const MOVING_LINKS = 4;
/** Links of a pose: those of the table, then what is drawn where the support belongs, and its pivot. */
export const LESSON_LINKS = ["ground", "crank", "coupler", "rocker", "support", "home", "pivot"];
const [CRANK, COUPLER, ROCKER, SUPPORT, HOME_MARK, PIVOT] = [1, 2, 3, 4, 5, 6];

/** Bring an angle into the turn that begins at `low`. */
export function withinTurn(angle, low) {
  return angle - FULL_TURN * Math.floor((angle - low) / FULL_TURN);
}

/**
 * A position of the lesson.
 * @typedef {import("../../../pictures/page/turn.js").Pose & {stretch: Object|null}} LessonPose
 *   `stretch`: in which part of the turn; its `side` is null while the rocker swings
 */

export class LessonMotion {
  /**
   * @param {{header: Object, arrays: Object<string, Float64Array>}} answer of the kind `lesson`
   * @param {Object} asked the request
   */
  constructor({ header, arrays }, asked) {
    this.header = header;
    this.lengths = { l1: asked.l1, l2: asked.l2, l3: asked.l3, l4: asked.l4 };
    this.asked = asked;
    this.arrays = arrays;
    const rows = arrays.frames.length / (header.stretches.length * ORDERS * MOVING_LINKS * 3);
    const per = ORDERS * rows * MOVING_LINKS * 3;
    this.stretches = header.stretches.map((stretch, i) => ({
      ...stretch,
      rows,
      turn: new Turn({
        grid: { kind: "linear", low: stretch.start, high: stretch.end },
        closes: false,
        rows,
        orders: ORDERS,
        values: arrays.frames.subarray(i * per, (i + 1) * per),
      }),
      byGround: arrays.by_ground.subarray(i * rows * 2, (i + 1) * rows * 2),
    }));
    /** The turn that is drawn. */
    this.low = this.stretches[0].start;
    this.high = this.low + FULL_TURN;
    const { l1, l3 } = this.lengths;
    const joint = (name, link, x, radius = 5) => ({ name, link, at: [x, 0], radius });
    this.joints = [joint("A", 0, 0, 5.5), joint("B", CRANK, l1), joint("C", ROCKER, l3), joint("D", SUPPORT, 0, 15)];
  }

  /** Return the part of the turn in which a crank angle is. */
  stretchAt(angle) {
    return this.#stretchOf(withinTurn(angle, this.low));
  }

  /** The same of an angle within the turn: brought there twice, its end might become its beginning. */
  #stretchOf(own) {
    return this.stretches.find((one) => own < one.end) ?? this.stretches[this.stretches.length - 1];
  }

  /** Return coordinates of n + 1 places over the turn. */
  coordinates(n) {
    return Array.from({ length: n + 1 }, (_, i) => this.low + (i / n) * FULL_TURN);
  }

  /** @returns {LessonPose} */
  pose() {
    const make = () => new Float64Array(3 * LESSON_LINKS.length);
    return { q: this.low, known: false, stretch: null, value: make(), d1: make(), d2: make() };
  }

  /**
   * Return the position at a crank angle; derivatives are by it.
   * @param {number} q
   * @param {LessonPose} [pose] to overwrite
   * @param {number} [drift] dl4/dφ1, of a support that is dragged
   */
  sample(q, pose = this.pose(), drift = 0) {
    const own = withinTurn(q, this.low);
    const stretch = this.#stretchOf(own);
    const { turn } = stretch;
    // Its own pose is shorter: the table's links alone.
    stretch.pose = turn.sample(own, stretch.pose ?? turn.pose());
    for (const key of ["value", "d1", "d2"]) pose[key].set(stretch.pose[key]);
    pose.q = q;
    pose.known = stretch.pose.known;
    pose.stretch = stretch;
    if (drift !== 0 && stretch.side === null) this.#drift(pose, own, drift);
    return this.#dress(pose);
  }

  /** Add the velocities that the moving support gives: its own, and the turning of the links. */
  #drift(pose, own, drift) {
    const { start, end, rows, byGround } = pose.stretch;
    const place = ((own - start) / (end - start)) * (rows - 1);
    const row = Math.min(Math.max(Math.floor(place), 0), rows - 2);
    const part = place - row;
    [COUPLER, ROCKER].forEach((link, column) => {
      const at = (k) => byGround[2 * k + column];
      pose.d1[3 * link + 2] += drift * (at(row) + part * (at(row + 1) - at(row)));
      // Those twice by l4 are of where it was asked last: they change little until the next answer.
      const [mixed, twice] = this.header.position.by_ground[["coupler", "rocker"][column]];
      pose.d2[3 * link + 2] += drift * (2 * mixed + drift * twice);
    });
    pose.d1[3 * ROCKER] -= drift;
    pose.d1[3 * SUPPORT] -= drift;
  }

  /** The same turn without what slides: for paths while the support is held. */
  get swinging() {
    const sample = (q, pose = this.pose()) => {
      this.sample(q, pose);
      pose.known &&= pose.stretch.side === null;
      return pose;
    };
    return { low: this.low, high: this.high, coordinates: (n) => this.coordinates(n), pose: () => this.pose(), sample };
  }

  /** Return the position with the support held although C is jammed, if there is one. */
  held(q, pose = this.pose()) {
    const { held } = this.header.position;
    pose.q = q;
    pose.stretch = this.stretchAt(q);
    pose.known = held.every((frame) => frame.every((x) => x !== null));
    pose.value.set(held.flat(), 3);
    pose.d1.fill(0);
    pose.d2.fill(0);
    return this.#dress(pose);
  }

  #dress(pose) {
    pose.value[3 * HOME_MARK] = -this.lengths.l4;
    for (let k = 0; k < 3; k++) {
      for (const key of ["value", "d1", "d2"]) pose[key][3 * PIVOT + k] = pose[key][3 * SUPPORT + k];
    }
    return pose;
  }

  /** Return the figures of a position. */
  figures(pose) {
    const { value } = pose;
    const cosine = Math.cos(value[3 * COUPLER + 2] - value[3 * ROCKER + 2]);
    const gamma23 = Math.acos(Math.min(Math.max(cosine, -1), 1));
    const phi3 = value[3 * ROCKER + 2];
    return {
      phi1: pose.q,
      side: pose.stretch?.side ?? null,
      gamma: Math.min(gamma23, Math.PI - gamma23),
      phi3: Math.atan2(Math.sin(phi3), Math.cos(phi3)),
      l4: -value[3 * SUPPORT],
    };
  }

  /** Return places and derivatives of B, C and D at a position. */
  points(pose) {
    return Object.fromEntries(this.joints.slice(1).map(({ name, link, at }) => [name, pointState(pose, link, at)]));
  }

  /** Return what must be seen: x0, y0, x1, y1, m. */
  get bounds() {
    const { l1, l4 } = this.lengths;
    const pose = this.pose();
    let [x0, y0, x1, y1] = [-Math.max(l1, l4), -l1, l1, l1];
    for (const q of this.coordinates(72)) {
      if (!this.sample(q, pose).known) continue;
      for (const { x, y } of Object.values(this.points(pose))) {
        [x0, y0, x1, y1] = [Math.min(x0, x), Math.min(y0, y), Math.max(x1, x), Math.max(y1, y)];
      }
    }
    return [x0, y0, x1, y1];
  }
}
