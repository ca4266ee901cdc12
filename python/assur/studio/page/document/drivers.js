// The drivers of a document: what moves by itself, and in what its coordinate is measured.

import { tableOf } from "./names.js";

/** Whether a driver (by default the first) is a slide: it has m and N where others have rad and N·m. */
export function drivesSlide(document, axis = 0) {
  const own = [document.driver ?? []].flat()[axis];
  return typeof own === "string" && Object.hasOwn(tableOf(document.slides), own);
}

/** Return the speed that a document gives a driver, rad/s or m/s; null without one. */
export function inputSpeed(document, axis) {
  const own = [document.input_speed ?? []].flat()[axis];
  return Number.isFinite(own) ? own : null;
}

/**
 * Give a driver a speed. Of several drivers those that had none get the speed that all were played at.
 * @param {Object} document
 * @param {number} axis
 * @param {number} speed rad/s or m/s
 * @param {number} others
 */
export function withInputSpeed(document, axis, speed, others) {
  const { driver } = document;
  if (!Array.isArray(driver)) return { ...document, input_speed: speed };
  const all = driver.map((_, i) => (i === axis ? speed : (inputSpeed(document, i) ?? others)));
  return { ...document, input_speed: all };
}
