// Values as fields show and step them.

import { lengthUnit, niceLength } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { writeQuantity } from "../document/units.js";

/** Digits of a field that is not being edited: all, if they are not more. */
const SHOWN_DIGITS = 5;
const ROUNDED_DIGITS = 4;
/** And of one that is being edited: what is beyond is rounding. */
const EDITED_DIGITS = 10;

/** Return the unit of lengths in the panel: that of the picture and the diagrams. */
export function panelLength(data) {
  const [x0, y0, x1, y1] = data.bounds;
  return lengthUnit(Math.max(x1 - x0, y1 - y0));
}

/** Add to what is wrong with a value that the one before stays. */
export const keeping = (wrong, kept) => `${wrong} ${say("pictureKeeps", { kept })}`;

/** Write a value for a field: short; `isWhole` with those that one edits. */
export function fieldText(value, unit, shown, isWhole = false) {
  const all = writeQuantity(value, unit, shown);
  const count = all.replace(/e.*$/, "").replace(/[^\d]/g, "").replace(/^0+/, "").length;
  if (count <= (isWhole ? EDITED_DIGITS : SHOWN_DIGITS)) return all;
  const rounded = writeQuantity(value, unit, shown, isWhole ? EDITED_DIGITS : ROUNDED_DIGITS);
  return rounded.includes(".") && !rounded.includes("e") ? rounded.replace(/\.?0+$/, "") : rounded;
}

/**
 * Return the value one small step further: about a hundredth, a round number of the unit shown.
 * @param {number} value SI
 * @param {number} factor units shown to an SI unit
 * @param {number} count of steps, with their sign
 * @param {number} usual of which a hundredth is a small step, where the value is zero
 * @param {boolean} isAngle steps of 1
 * @param {boolean} isPositive it stays above zero
 */
export function stepped(value, factor, count, { usual, isAngle = false, isPositive = false }) {
  const own = value * factor;
  const step = isAngle ? 1 : niceLength(Math.max(Math.abs(own), Math.abs(usual * factor) / 10) / 60);
  const next = (Math.round(own / step) + count) * step;
  const round = Number(next.toPrecision(12));
  return isPositive && round <= 0 ? value : round / factor;
}
