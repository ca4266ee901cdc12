// Values of loads as files have them: a number, or a table over a coordinate.

import { isTable, listOf } from "../document/names.js";
import { parseQuantity, writeQuantity } from "../document/units.js";

/** Whether a value is a table. */
export const isValueTable = (value) => isTable(value) && Array.isArray(value.q);

/** Return a constant that stands for a value: of a table the value that is largest. */
export function constantOf(value) {
  if (typeof value === "number") return value;
  return listOf(value?.value).reduce((most, own) => (Math.abs(own) > Math.abs(most) ? own : most), 0);
}

/**
 * Return a table over a turn that stands for a constant, linear from row to row.
 * @param {number} value
 * @param {boolean} isAngle whether the coordinate is an angle; else from 0 to `reach`, m
 */
export function tableOfConstant(value, isAngle, reach = 1) {
  const end = isAngle ? 2 * Math.PI : reach;
  return { q: [0, end / 4, end / 2, end], value: [0, value, value, 0], spline: "linear" };
}

/** Digits of the coordinates and values that lines show. */
const LINE_DIGITS = 6;

/**
 * Write the rows of a table as lines.
 * @param {{q: number[], value: number[]}} table
 * @param {{unit: string, shown: string}} coordinate
 * @param {string} unit of the values
 */
export function linesOf(table, coordinate, unit) {
  const rows = table.q.map((q, i) => {
    const short = (value, own, shown) => {
      const whole = writeQuantity(value, own, shown);
      return whole.length <= LINE_DIGITS + 2 ? whole : writeQuantity(value, own, shown, LINE_DIGITS);
    };
    return `${short(q, coordinate.unit, coordinate.shown)}   ${short(table.value[i], unit)}`;
  });
  return rows.join("\n");
}

/** Read a line: wherever it can be cut into a coordinate and a value, each perhaps with a unit. */
function pairOf(line, coordinate, unit) {
  const words = line.split(/[\s;]+/).filter(Boolean);
  for (let cut = 1; cut < words.length; cut++) {
    const place = parseQuantity(words.slice(0, cut).join(" "), coordinate.unit, coordinate.shown);
    const size = parseQuantity(words.slice(cut).join(" "), unit);
    if (!place.error && !size.error) return { place: place.value, size: size.value };
  }
  if (words.length !== 2) return { error: "tableLine", values: {} };
  const isPlace = Boolean(parseQuantity(words[0], coordinate.unit, coordinate.shown).error);
  return { error: "tableNumber", values: { text: words[isPlace ? 0 : 1] } };
}

/**
 * Read the rows of a table: on each line a coordinate and a value, apart by blanks, a tab or a semicolon.
 * A line that was not changed keeps the digits that it does not show.
 * @param {string} text
 * @param {{unit: string, shown: string}} coordinate
 * @param {string} unit of the values
 * @param {{q: number[], value: number[]}} [table] that was shown
 * @returns {{q: number[], value: number[]} | {error: string, values: Object}}
 */
export function readLines(text, coordinate, unit, table = { q: [], value: [] }) {
  const kept = new Map(linesOf(table, coordinate, unit).split("\n").map((line, i) => [line, i]));
  const q = [];
  const value = [];
  const lines = text.split("\n").map((line) => line.trim());
  for (const [i, line] of lines.entries()) {
    if (!line) continue;
    const n = i + 1;
    const own = kept.get(line);
    if (own !== undefined && table.q.length) {
      if (q.length && table.q[own] < q[q.length - 1]) return { error: "tableOrder", values: { n } };
      q.push(table.q[own]);
      value.push(table.value[own]);
      continue;
    }
    const pair = pairOf(line, coordinate, unit);
    if (pair.error) return { error: pair.error, values: { n, ...pair.values } };
    const { place, size } = pair;
    if (q.length && place < q[q.length - 1]) return { error: "tableOrder", values: { n } };
    q.push(place);
    value.push(size);
  }
  if (q.length < 2) return { error: "tableShort", values: {} };
  return { q, value };
}
