// Positions over a turn: one array, interpolated between its rows.

/**
 * How the coordinate q goes along the rows: `linear` from low to high; `cosine`, where
 * q = middle − half · cos u and u goes from low to high (dense at dead points); `rows` with q each.
 * @typedef {{kind: "linear", low: number, high: number}
 *   | {kind: "cosine", middle: number, half: number, low: number, high: number}
 *   | {kind: "rows", q: number[]}} Grid
 */

/**
 * All links at one coordinate: x, y, angle of each link in turn, the first is the ground.
 * @typedef {Object} Pose
 * @property {number} q
 * @property {boolean} known whether there is such a position
 * @property {Float64Array} value m, rad
 * @property {Float64Array} d1 by q
 * @property {Float64Array} d2 by q
 */

/**
 * @typedef {Object} TurnData
 * @property {Grid} grid
 * @property {boolean} closes
 * @property {"angle"|"length"|"time"} [unit]
 * @property {number} rows
 * @property {number} orders 2 or 3: value, first and perhaps second derivative by the parameter
 * @property {number[]} [ground] its frame: x, y, angle
 * @property {Float32Array|Float64Array} values [order][row][moving link][x, y, angle]
 */

/** Read an array of Float32 from base64. */
export function fromBase64(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

/**
 * Weights of value, h · first and h² · second derivative at both ends (Hermite, quintic).
 * @param {number} t 0 to 1
 * @returns {number[]} six
 */
export function quintic(t) {
  const t2 = t * t;
  const t3 = t2 * t;
  const t4 = t3 * t;
  const t5 = t4 * t;
  return [
    1 - 10 * t3 + 15 * t4 - 6 * t5,
    t - 6 * t3 + 8 * t4 - 3 * t5,
    t2 / 2 - 1.5 * t3 + 1.5 * t4 - t5 / 2,
    10 * t3 - 15 * t4 + 6 * t5,
    -4 * t3 + 7 * t4 - 3 * t5,
    t3 / 2 - t4 + t5 / 2,
  ];
}

/**
 * Weights of value and h · first derivative at both ends (Hermite, cubic), for the value and for
 * its first and second derivative by t.
 * @param {number} t 0 to 1
 * @returns {number[][]} three rows of four
 */
export function cubic(t) {
  const t2 = t * t;
  const t3 = t2 * t;
  return [
    [1 - 3 * t2 + 2 * t3, t - 2 * t2 + t3, 3 * t2 - 2 * t3, t3 - t2],
    [6 * t2 - 6 * t, 1 - 4 * t + 3 * t2, 6 * t - 6 * t2, 3 * t2 - 2 * t],
    [12 * t - 6, 6 * t - 4, 6 - 12 * t, 6 * t - 2],
  ];
}

export class Turn {
  /** @param {TurnData} data */
  constructor(data) {
    this.grid = data.grid;
    this.closes = data.closes;
    /** Of what goes along the rows: "angle", "length" or "time". */
    this.unit = data.unit;
    this.rows = data.rows;
    this.orders = data.orders;
    this.values = data.values;
    this.ground = data.ground ?? [0, 0, 0];
    const per = data.orders * data.rows * 3;
    /** Number of links, with the ground. */
    this.links = data.values.length / per + 1;
    /** First and last coordinate. */
    this.low = this.#at(0);
    this.high = this.#at(data.rows - 1);
  }

  /** Return the coordinate of a row, which may lie between two. */
  #at(row) {
    const { grid, rows } = this;
    if (grid.kind === "rows") {
      const i = Math.min(Math.floor(row), rows - 2);
      return grid.q[i] + (row - i) * (grid.q[i + 1] - grid.q[i]);
    }
    const own = grid.low + (row / (rows - 1)) * (grid.high - grid.low);
    return grid.kind === "linear" ? own : grid.middle - grid.half * Math.cos(own);
  }

  /** Return the coordinates of n + 1 places, as dense as the rows are. */
  coordinates(n) {
    return Array.from({ length: n + 1 }, (_, i) => this.#at((i / n) * (this.rows - 1)));
  }

  /** Bring a coordinate into the range: around, or to its nearer end. */
  bring(q) {
    if (this.closes) {
      const span = this.high - this.low;
      const turns = Math.floor((q - this.low) / span);
      return turns ? q - turns * span : q;
    }
    return Math.min(Math.max(q, this.low), this.high);
  }

  /** @returns {Pose} an empty pose to fill */
  pose() {
    const make = () => new Float64Array(3 * this.links);
    const value = make();
    value.set(this.ground);
    return { q: this.low, known: false, value, d1: make(), d2: make() };
  }

  /**
   * Return the position at a coordinate.
   * @param {number} q brought into the range
   * @param {Pose} [pose] to overwrite
   * @param {number[]} [only] the links that are wanted: the others stay as they are
   * @returns {Pose}
   */
  sample(q, pose = this.pose(), only) {
    pose.q = this.bring(q);
    const cell = this.#locate(pose.q);
    cell.cubic = cubic(cell.part);
    cell.quintic = quintic(cell.part);
    pose.known = true;
    if (only) for (const link of only) this.#place(pose, cell, 3 * link - 3, 3 * link);
    else this.#place(pose, cell, 0, 3 * this.links - 3);
    return pose;
  }

  /** Fill columns of a pose, of the ground none. */
  #place(pose, { row, step, du, d2u, cubic: [c0, c1, c2], quintic: w }, from, to) {
    const { values, orders } = this;
    const columns = 3 * (this.links - 1);
    const order = this.rows * columns;
    for (let c = Math.max(from, 0); c < to; c++) {
      const a = row * columns + c;
      const b = a + columns;
      const f0 = values[a];
      const f1 = values[b];
      const g0 = values[order + a];
      const g1 = values[order + b];
      let value;
      let first;
      let second;
      if (orders > 2) {
        // Each from the highest given, so that the rounding of the lower ones does not grow.
        const h0 = step * values[2 * order + a];
        const h1 = step * values[2 * order + b];
        value = w[0] * f0 + step * (w[1] * g0 + w[2] * h0 + w[4] * g1 + w[5] * h1) + w[3] * f1;
        first = c0[0] * g0 + c0[1] * h0 + c0[2] * g1 + c0[3] * h1;
        second = (c1[0] * g0 + c1[1] * h0 + c1[2] * g1 + c1[3] * h1) / step;
      } else {
        const mix = (k) => k[0] * f0 + k[2] * f1 + step * (k[1] * g0 + k[3] * g1);
        value = mix(c0);
        first = mix(c1) / step;
        second = mix(c2) / (step * step);
      }
      // By the parameter, then by q.
      const d1 = first / du;
      pose.value[c + 3] = value;
      pose.d1[c + 3] = d1;
      pose.d2[c + 3] = (second - d1 * d2u) / (du * du);
      pose.known &&= Number.isFinite(value);
    }
  }

  /** Find the cell of a coordinate, and how the parameter goes with it. */
  #locate(q) {
    const { grid, rows } = this;
    if (grid.kind === "rows") {
      let row = 0;
      let end = rows - 1;
      while (end - row > 1) {
        const middle = (row + end) >> 1;
        if (grid.q[middle] <= q) row = middle;
        else end = middle;
      }
      const step = grid.q[row + 1] - grid.q[row];
      return { row, part: (q - grid.q[row]) / step, step, du: 1, d2u: 0 };
    }
    let u = q;
    let du = 1;
    let d2u = 0;
    if (grid.kind === "cosine") {
      const cosine = Math.min(Math.max((grid.middle - q) / grid.half, -1), 1);
      u = Math.min(Math.max(Math.acos(cosine), grid.low), grid.high);
      du = grid.half * Math.sin(u);
      d2u = grid.half * Math.cos(u);
    }
    const step = (grid.high - grid.low) / (rows - 1);
    const place = (u - grid.low) / step;
    const row = Math.min(Math.max(Math.floor(place), 0), rows - 2);
    return { row, part: place - row, step, du, d2u };
  }
}
