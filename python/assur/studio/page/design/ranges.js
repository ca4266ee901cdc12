// Over which values a dimension slides, in which unit, and which dimensions are chosen first.

import { niceLength } from "../../../pictures/page/numbers.js";
import { writeWithUnit } from "../document/units.js";
import { panelLength } from "../panel/steps.js";

/** Angles slide so far to both sides, rad. */
const ANGLE_REACH = Math.PI / 3;
/** A coordinate less than this part of a usual link is about zero, and has no double. */
const NEARLY_ZERO = 0.25;
/** Steps of a slider, about. */
const SLIDER_STEPS = 200;

/**
 * A dimension as the server tells it.
 * @typedef {{name: string, value: number, unit: "m" | "rad"}} Dimension
 */

/**
 * Return from where to where a dimension may go, SI.
 * @param {Dimension} dimension
 * @param {number} usual the usual length of a link, m
 * @param {number} [most] how many times its present value
 * @returns {[number, number]}
 */
export function designRange({ name, value, unit }, usual, most = 2) {
  if (unit === "rad") return [value - ANGLE_REACH, value + ANGLE_REACH];
  if (value > 0 && name.endsWith(".length")) return [value / 2, value * most];
  if (Math.abs(value) < NEARLY_ZERO * usual) return [value - usual, value + usual];
  return value > 0 ? [value / 2, value * most] : [value * most, value / 2];
}

/**
 * Return the round values of a slider between two ends, in the unit shown.
 * @param {[number, number]} range SI
 * @param {number} factor units to an SI unit
 * @returns {{low: number, high: number, step: number}}
 */
export function sliderSteps([low, high], factor) {
  const step = niceLength(((high - low) * factor) / SLIDER_STEPS);
  const round = (n) => Number((n * step).toPrecision(12));
  const [first, last] = [(low * factor) / step, (high * factor) / step];
  return { low: round(Math.ceil(first - 1e-9)), high: round(Math.floor(last + 1e-9)), step };
}

/**
 * Return a value rounded to a step of a slider.
 * @param {number} value SI
 * @param {[number, number]} range SI
 * @param {number} factor units to an SI unit
 */
export function roundedWithin(value, range, factor) {
  const { low, high, step } = sliderSteps(range, factor);
  const own = Math.min(Math.max(Math.round((value * factor) / step) * step, low), high);
  return Number(own.toPrecision(12)) / factor;
}

/**
 * Return the unit in which a dimension is shown.
 * @param {Object} data the page's data
 * @param {string} unit "m" or "rad"
 * @returns {{name: string, factor: number}}
 */
export function unitShown(data, unit) {
  return unit === "rad" ? { name: "°", factor: 180 / Math.PI } : panelLength(data);
}

/**
 * Write a value with its unit, with four digits at most and without zeros at its end.
 * @param {Object} data the page's data
 * @param {number} value SI
 * @param {string} unit "m" or "rad"
 */
export function valueText(data, value, unit) {
  const count = unit === "rad" ? 4 : undefined;
  return writeWithUnit(Number(value.toPrecision(4)), unit, unitShown(data, unit).name, count);
}

/** Write the name of a dimension: that of a link's length is the link. */
export function dimensionText(name) {
  return name.replace(/\.length$/, "").replace(".", " ");
}

/**
 * Return the names of dimensions as one may want to change them: first lengths of links that are
 * not the driver.
 * @param {Dimension[]} dimensions
 * @param {string[]} drivers
 * @returns {string[]}
 */
export function mostUsefulFirst(dimensions, drivers) {
  const rank = ({ name, value, unit }) => {
    const isLength = name.endsWith(".length");
    if (isLength && !drivers.includes(name.slice(0, -".length".length))) return 0;
    if (isLength) return 1;
    return unit === "m" && value !== 0 ? 2 : 3;
  };
  return [...dimensions].sort((a, b) => rank(a) - rank(b)).map((one) => one.name);
}
