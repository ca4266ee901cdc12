// One quantity in large digits.

import { digits, lengthUnit } from "../../../pictures/page/numbers.js";
import { pointState, unitOf } from "../../../pictures/page/quantities.js";

/** Places at which the greatest value is looked for: it chooses the unit. */
const SOUGHT = 60;

/**
 * Return the places of the moving joints as quantities of two numbers.
 * @param {Object} data the page's data
 */
export function placeQuantities(data) {
  const [x0, y0, x1, y1] = data.bounds;
  const size = Math.max(x1 - x0, y1 - y0);
  const moving = data.joints.filter((joint) => joint.link !== 0);
  const place = { isPlace: true, order: 0, isAngle: false, size };
  const make = (joint) => ({ ...place, id: `${joint.name}.place`, of: joint.name, joint });
  return moving.map((joint) => ({ name: joint.name, quantities: [make(joint)] }));
}

/** Return the greatest value over a turn, SI; of places none is needed. */
export function greatestOf(quantity, turn, speed) {
  if (quantity.isPlace) return 0;
  const poses = turn.coordinates(SOUGHT).map((q) => turn.sample(q)).filter((pose) => pose.known);
  const values = poses.map((pose) => Math.abs(quantity.value(pose, speed)));
  return Math.max(0, ...values.filter(Number.isFinite));
}

/** Write a quantity with its unit. */
export function numberText(quantity, pose, speed, greatest) {
  if (quantity.isPlace) {
    const { x, y } = pointState(pose, quantity.joint.link, quantity.joint.at);
    const { name, factor } = lengthUnit(quantity.size);
    return `${digits(x * factor)}, ${digits(y * factor)} ${name}`;
  }
  const { name, factor } = unitOf(quantity, greatest);
  // Rounding of what is zero is not shown.
  const value = quantity.value(pose, speed);
  const own = Math.abs(value) < 1e-9 * greatest ? 0 : value;
  return `${digits(own * factor)}${name === "°" ? "" : " "}${name}`;
}
