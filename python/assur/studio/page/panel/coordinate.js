// A driver's coordinate as the panel writes it, of the mechanism that is meant: what plays may still be
// the turn before, of another driver, or a run, whose rows go along time.

import { degrees, digits } from "../../../pictures/page/numbers.js";
import { drivesSlide } from "../document/drivers.js";
import { panelLength } from "./steps.js";

/**
 * Write a coordinate in the unit of the picture.
 * @param {Object} data the page's
 * @param {number} q rad or m
 * @param {boolean} isLength
 */
export function coordinateText(data, q, isLength) {
  if (!isLength) return degrees(q);
  const { name, factor } = panelLength(data);
  return `${digits(q * factor)} ${name}`;
}

/**
 * Write a coordinate of the driver that moves, of the present document.
 * @param {import("../model/model.js").Model} model
 */
export const ownCoordinateText = ({ document, axis, data }, q) => coordinateText(data, q, drivesSlide(document, axis));
