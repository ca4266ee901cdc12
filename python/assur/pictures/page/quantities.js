// What follows from the frames of the links: points, angles, values of slides, and their rates.

import { forceUnit, lengthUnit } from "./numbers.js";

/**
 * A point with its derivatives by q.
 * @typedef {{x: number, y: number, x1: number, y1: number, x2: number, y2: number}} PointState
 */

/**
 * Return a point of a link.
 * @param {import("./turn.js").Pose} pose
 * @param {number} link
 * @param {number[]} at in the link's frame, m
 * @returns {PointState}
 */
export function pointState(pose, link, at) {
  const i = 3 * link;
  const { value, d1, d2 } = pose;
  const cosine = Math.cos(value[i + 2]);
  const sine = Math.sin(value[i + 2]);
  const rx = cosine * at[0] - sine * at[1];
  const ry = sine * at[0] + cosine * at[1];
  const w = d1[i + 2];
  const e = d2[i + 2];
  return {
    x: value[i] + rx,
    y: value[i + 1] + ry,
    x1: d1[i] - w * ry,
    y1: d1[i + 1] + w * rx,
    x2: d2[i] - e * ry - w * w * rx,
    y2: d2[i + 1] + e * rx - w * w * ry,
  };
}

/**
 * Return where a point of the picture is in a link's frame.
 * @param {import("./turn.js").Pose} pose
 */
export function toLocal(pose, link, x, y) {
  const i = 3 * link;
  const cosine = Math.cos(pose.value[i + 2]);
  const sine = Math.sin(pose.value[i + 2]);
  const dx = x - pose.value[i];
  const dy = y - pose.value[i + 1];
  return [cosine * dx + sine * dy, cosine * dy - sine * dx];
}

/**
 * Return the value of a slide with its derivatives by q: a point of one link, projected on a
 * direction of the other.
 * @returns {number[]}
 */
export function slideState(pose, slide) {
  const p = pointState(pose, slide.link, slide.at);
  const o = pointState(pose, slide.on, slide.origin);
  const i = 3 * slide.on + 2;
  const angle = pose.value[i] + slide.angle;
  const w = pose.d1[i];
  const ux = Math.cos(angle);
  const uy = Math.sin(angle);
  // Along the guide, and across it to its left.
  const along = (x, y) => x * ux + y * uy;
  const across = (x, y) => y * ux - x * uy;
  const r = [p.x - o.x, p.y - o.y];
  const r1 = [p.x1 - o.x1, p.y1 - o.y1];
  const r2 = [p.x2 - o.x2, p.y2 - o.y2];
  return [
    along(...r) - slide.offset,
    along(...r1) + w * across(...r),
    along(...r2) + 2 * w * across(...r1) + pose.d2[i] * across(...r) - w * w * along(...r),
  ];
}

/**
 * Something to show in a diagram.
 * @typedef {Object} Quantity
 * @property {string} id as in the columns of Motion.to_dataframe: "C.x", "rocker.omega", "bore.v"
 * @property {string} of name of the joint, link or slide
 * @property {string} what key of its words: "x", "angle", "omega", "v" …
 * @property {number} order how many derivatives by time it has
 * @property {boolean} isAngle of a link
 * @property {number} size what is large, if the coordinate goes with speed 1: rad, m
 * @property {number[]} [links] whose frames it needs; by default all
 * @property {(pose: import("./turn.js").Pose, speed: number) => number} value in SI units
 * @property {string} [unit] SI, of what is no angle and no length: "N"
 * @property {string} [role] its colour
 */

const ROLES = ["ink", "velocity", "acceleration"];
const PER = ["", "/s", "/s²"];

/** Return the name of a quantity's colour. */
export const roleOf = (quantity) => quantity.role ?? ROLES[quantity.order];

/**
 * Return the unit in which a quantity is written.
 * @param {Quantity} quantity
 * @param {number} greatest of its values, SI
 * @returns {{name: string, factor: number}}
 */
export function unitOf({ isAngle, order, size, unit }, greatest) {
  if (unit) return forceUnit(unit, greatest);
  if (isAngle) return order ? { name: `rad${PER[order]}`, factor: 1 } : { name: "°", factor: 180 / Math.PI };
  // Positions all have the unit of the picture.
  const { name, factor } = lengthUnit(order ? greatest : size);
  return { name: name + PER[order], factor };
}

/**
 * Return everything that can be shown, grouped.
 * @param {Object} scene the page's data
 * @returns {{name: string, quantities: Quantity[]}[]}
 */
export function allQuantities(scene) {
  const [x0, y0, x1, y1] = scene.bounds;
  const size = Math.max(x1 - x0, y1 - y0);
  const group = (name, isAngle, links, list) => {
    const make = ([suffix, what, order, value]) => {
      const id = suffix ? `${name}.${suffix}` : name;
      return { id, of: name, what, order, isAngle, links, size: isAngle ? 1 : size, value };
    };
    return { name, quantities: list.map(make) };
  };
  const ofLink = (link, i) => {
    const c = 3 * i + 2;
    return group(link, true, [i], [
      ["", "angle", 0, (pose) => pose.value[c]],
      ["omega", "omega", 1, (pose, speed) => pose.d1[c] * speed],
      ["alpha", "alpha", 2, (pose, speed) => pose.d2[c] * speed * speed],
    ]);
  };
  const ofSlide = (slide) =>
    group(slide.name, false, [slide.link, slide.on], [
      ["", "value", 0, (pose) => slideState(pose, slide)[0]],
      ["v", "v", 1, (pose, speed) => slideState(pose, slide)[1] * speed],
      ["a", "a", 2, (pose, speed) => slideState(pose, slide)[2] * speed * speed],
    ]);
  const ofJoint = (joint) => {
    const at = (pose) => pointState(pose, joint.link, joint.at);
    const length = (x, y) => Math.hypot(x, y);
    return group(joint.name, false, [joint.link], [
      ["x", "x", 0, (pose) => at(pose).x],
      ["y", "y", 0, (pose) => at(pose).y],
      ["v", "v", 1, (pose, speed) => length(at(pose).x1, at(pose).y1) * Math.abs(speed)],
      ["vx", "vx", 1, (pose, speed) => at(pose).x1 * speed],
      ["vy", "vy", 1, (pose, speed) => at(pose).y1 * speed],
      ["a", "a", 2, (pose, speed) => length(at(pose).x2, at(pose).y2) * speed * speed],
      ["ax", "ax", 2, (pose, speed) => at(pose).x2 * speed * speed],
      ["ay", "ay", 2, (pose, speed) => at(pose).y2 * speed * speed],
    ]);
  };
  return [
    ...scene.links.map(ofLink).slice(1),
    ...scene.slides.map(ofSlide),
    ...scene.joints.filter((joint) => joint.link !== 0).map(ofJoint),
  ];
}
