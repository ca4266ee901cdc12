// The cells of a map: which step of colour each has, where a word fits, which value a place stands for.

import { niceLength } from "../../../pictures/page/numbers.js";

/** Steps of colour. */
export const COLOUR_STEPS = 7;

/**
 * What `map` answered.
 * @typedef {{x: Float64Array, y: Float64Array, value: Float64Array, reason: Uint8Array, reasons: string[]}} Grid2
 */

/**
 * Return round ends of the colours that hold all values.
 * @param {Float64Array} value
 * @param {number} factor units to an SI unit
 * @returns {{low: number, high: number} | null} in the unit; null if there is no value
 */
export function colourRange(value, factor) {
  let low = Infinity;
  let high = -Infinity;
  for (const one of value) {
    if (!Number.isFinite(one)) continue;
    low = Math.min(low, one * factor);
    high = Math.max(high, one * factor);
  }
  if (low > high) return null;
  if (high - low < 1e-9 * Math.max(Math.abs(low), Math.abs(high), 1)) return { low, high };
  const step = niceLength((high - low) / COLOUR_STEPS);
  return { low: step * Math.floor(low / step + 1e-9), high: step * Math.ceil(high / step - 1e-9) };
}

/** Return which step of colour a value has, from 0; −1 for none. */
export function stepOf(value, { low, high }) {
  if (!Number.isFinite(value)) return -1;
  if (!(high > low)) return COLOUR_STEPS - 1;
  return Math.min(Math.max(Math.floor((COLOUR_STEPS * (value - low)) / (high - low)), 0), COLOUR_STEPS - 1);
}

/**
 * Return a path for each class of cells, rows of equal ones in one rectangle.
 * @param {number[]} classes [row][column], row 0 is the lowest
 * @param {number} n cells along each side
 * @param {number} width px
 * @param {number} height px
 * @returns {Map<number, string>}
 */
export function cellPaths(classes, n, width, height) {
  const paths = new Map();
  const w = width / n;
  const h = height / n;
  for (let row = 0; row < n; row++) {
    for (let from = 0, to; from < n; from = to) {
      const own = classes[row * n + from];
      to = from + 1;
      while (to < n && classes[row * n + to] === own) to++;
      const [x, y, across] = [from * w, height - (row + 1) * h, (to - from) * w].map((px) => Number(px.toFixed(2)));
      paths.set(own, `${paths.get(own) ?? ""}M${x} ${y}h${across}v${Number(h.toFixed(2))}h${-across}Z`);
    }
  }
  return paths;
}

/**
 * Return the rows of cells of one class in which a word has most room: the middle of the greatest
 * rectangle of a given shape.
 * @param {number[]} classes
 * @param {number} n
 * @param {number} own the class
 * @param {number} columns that the word takes
 * @param {number} rows
 * @returns {{column: number, row: number} | null} its middle, in cells; null if it has no room
 */
export function roomFor(classes, n, own, columns, rows) {
  // Sums over rectangles from the corner tell how many cells of the class a rectangle has.
  const sums = new Int32Array((n + 1) * (n + 1));
  const at = (row, column) => sums[row * (n + 1) + column];
  for (let row = 0; row < n; row++) {
    for (let column = 0; column < n; column++) {
      const is = classes[row * n + column] === own ? 1 : 0;
      sums[(row + 1) * (n + 1) + column + 1] = is + at(row, column + 1) + at(row + 1, column) - at(row, column);
    }
  }
  const isFull = (row, column, high, wide) => {
    if (row < 0 || column < 0 || row + high > n || column + wide > n) return false;
    const left = at(row + high, column) - at(row, column);
    return at(row + high, column + wide) - at(row, column + wide) - left === high * wide;
  };
  let best = null;
  let most = -1;
  for (let row = 0; row + rows <= n; row++) {
    for (let column = 0; column + columns <= n; column++) {
      let room = -1;
      while (isFull(row - room - 1, column - room - 1, rows + 2 * (room + 1), columns + 2 * (room + 1))) room++;
      if (room > most) {
        most = room;
        best = { column: column + columns / 2, row: row + rows / 2 };
      }
    }
  }
  return most < 0 ? null : best;
}

/** Return the index of the value next to a number, of even values. */
export function nearestIndex(values, own) {
  const last = values.length - 1;
  return Math.min(Math.max(Math.round((last * (own - values[0])) / (values[last] - values[0])), 0), last);
}

/** Return the part of the side at which a value is: cells are about their values. */
export function partOfSide(values, own) {
  const last = values.length - 1;
  return ((last * (own - values[0])) / (values[last] - values[0]) + 0.5) / values.length;
}

/** Return the value at a part of the side. */
export function valueAtPart(values, part) {
  const last = values.length - 1;
  const cell = Math.min(Math.max(part * values.length - 0.5, 0), last);
  return values[0] + (cell / last) * (values[last] - values[0]);
}

/**
 * Return the least and the greatest value and how many cells have none.
 * @param {Float64Array} value
 * @returns {{least: number, greatest: number, without: number}} indices, −1 if there is none
 */
export function mapExtremes(value) {
  let least = -1;
  let greatest = -1;
  let without = 0;
  value.forEach((one, i) => {
    if (!Number.isFinite(one)) without += 1;
    else {
      if (least < 0 || one < value[least]) least = i;
      if (greatest < 0 || one > value[greatest]) greatest = i;
    }
  });
  return { least, greatest, without };
}
