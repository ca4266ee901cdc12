// How far the driver can go, in words.

import { degrees, digits } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";

const FULL = 2 * Math.PI;

/**
 * Return the interval that a coordinate is in; of angles it may be turns away.
 * @param {(number | null)[][]} intervals null: no end
 * @param {number} q
 * @param {boolean} isAngle
 */
export function intervalAt(intervals, q, isAngle) {
  const ends = intervals.map(([low, high]) => [low ?? -Infinity, high ?? Infinity]);
  for (const shift of isAngle ? [0, FULL, -FULL] : [0]) {
    const found = ends.find(([low, high]) => low - 1e-9 <= q + shift && q + shift <= high + 1e-9);
    if (found) return found;
  }
  return undefined;
}

/**
 * Write where the driver can go from q.
 * @param {{intervals: (number | null)[][], full_rotation: boolean, period: number | null} | null} reach
 * @param {number} q
 * @param {boolean} isAngle
 * @param {{name: string, factor: number}} length
 */
export function reachText(reach, q, isAngle, length) {
  if (!reach) return "";
  if (reach.full_rotation) return reach.period > 1 ? say("turnsToClose", { n: reach.period }) : say("fullTurn");
  const found = intervalAt(reach.intervals, q, isAngle);
  if (!found) return "";
  if (!found.every(Number.isFinite)) return say("noEnd");
  const [low, high] = found.map((own) => (isAngle ? degrees(own, 0) : digits(own * length.factor)));
  return isAngle ? say("of", { low, high }) : `${say("of", { low, high })} ${length.name}`;
}
