// What the tools do to a document: each takes a document and returns a new one. Pure.

import { addJoint, addPlateJoint, joinToLink, mergeJoints, removeJoint, setGround } from "../document/joints.js";
import { addLink, removeLink, setDriver } from "../document/links.js";
import { allLinks, isCylinder, listOf, nameJoint, tableOf } from "../document/names.js";
import { addCylinder, addSlide, removeSlide } from "../document/slides.js";
import { placeOf, slidesOf } from "../document/structure.js";

/** Directions of guides go to whole steps of this angle if they are as near, rad. */
const ROUND_ANGLE = Math.PI / 12;
const NEAR_ROUND = Math.PI / 60;
const WHOLE_DEGREE = Math.PI / 180;

/**
 * Where something begins or ends: at a joint, on a link, or in the plane.
 * @typedef {{joint?: string, link?: string, at: number[]}} End
 */

/**
 * Return the document with a joint at an end, and the joint.
 * @param {Object} document
 * @param {End} end
 * @returns {{document: Object, joint: string}}
 */
export function withEnd(document, end) {
  if (end.joint && Object.hasOwn(tableOf(document.joints), end.joint)) return { document, joint: end.joint };
  const joint = nameJoint(document);
  const isOnLink = end.link && Object.hasOwn(allLinks(document), end.link);
  const made = isOnLink ? addPlateJoint(document, end.link, end.at, joint) : addJoint(document, end.at, joint);
  return { document: made, joint };
}

/** Whether one link has all of these joints. */
export function areOnOneLink(document, joints) {
  const hasAll = (own) => joints.every((joint) => own.includes(joint));
  return Object.entries(allLinks(document)).some(([link, own]) => link !== "ground" && hasAll(own));
}

/** Draw a link through ends; of a pair that one link has already none is made. */
export function linkThrough(document, ends) {
  let made = document;
  const joints = ends.map((end) => {
    const own = withEnd(made, end);
    made = own.document;
    return own.joint;
  });
  const all = [...new Set(joints)];
  const isNew = all.length > 1 && !areOnOneLink(made, all);
  return { document: isNew ? addLink(made, all) : made, joint: joints[joints.length - 1] };
}

/** Make a place, or a joint, a joint of a link. */
export function withPoint(document, link, end) {
  return end.joint ? joinToLink(document, end.joint, link) : addPlateJoint(document, link, end.at);
}

/**
 * Let a joint slide on the ground in a direction. What was fixed to the ground there is so no more.
 * @param {Object} document
 * @param {End} end
 * @param {number} angle rad
 */
export function slideOnGround(document, end, angle) {
  const { document: own, joint } = withEnd(document, end);
  const free = setGround(own, joint, false);
  return addSlide(free, { joint, on: "ground", angle, origin: listOf(tableOf(free.links).ground)[0] });
}

/** Let a joint slide along a link: along that side of it which is nearest to a place. */
export function slideOnLink(document, link, place, end) {
  const along = sideNear(document, link, place);
  if (!along) return document;
  const { document: own, joint } = withEnd(document, end);
  if (allLinks(own)[link].includes(joint)) return document;
  return addSlide(own, { joint, on: link, along, origin: along[0] });
}

/** Return the two joints of a link whose line is nearest to a place. */
export function sideNear(document, link, [x, y]) {
  const joints = listOf(allLinks(document)[link]).filter((joint) => placeOf(document, joint));
  let best = null;
  let least = Infinity;
  joints.forEach((from, i) => {
    for (const to of joints.slice(i + 1)) {
      const [a, b] = [placeOf(document, from), placeOf(document, to)];
      const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
      const length = Math.hypot(dx, dy);
      const distance = length ? Math.abs((x - a[0]) * dy - (y - a[1]) * dx) / length : Infinity;
      if (distance < least) [least, best] = [distance, [from, to]];
    }
  });
  return best;
}

/** Put a cylinder between two ends. */
export function cylinderBetween(document, from, to) {
  const start = withEnd(document, from);
  const end = withEnd(start.document, to);
  const made = addCylinder(end.document, start.joint, end.joint);
  return made === end.document ? document : made;
}

/** Fix a joint to the ground, or free it. */
export function groundToggled(document, end) {
  const { document: own, joint } = withEnd(document, end);
  return setGround(own, joint, !listOf(tableOf(own.links).ground).includes(joint));
}

/** Return the names of the drivers that are a link or a slide. */
export function driversIn(document) {
  return (Array.isArray(document.driver) ? document.driver : [document.driver]).filter(Boolean);
}

/** Let a link or slide drive, beside the others or in their place; what drives already no longer does. */
export function driverToggled(document, name, isMore) {
  const before = driversIn(document);
  const others = before.filter((own) => own !== name && own?.link !== name);
  if (others.length < before.length) return setDriver(document, others.length ? others : null);
  return setDriver(document, isMore ? [...before, name] : name);
}

/** Return the slide that a link is nothing without: that of a block, or of a cylinder's part. */
export function slideOfBlock(document, link) {
  if (!Object.hasOwn(allLinks(document), link) || link === "ground") return undefined;
  const own = slidesOf(document, link);
  const ofCylinder = own.find((name) => isCylinder(document.slides[name]));
  if (ofCylinder && !Object.hasOwn(tableOf(document.links), link)) return ofCylinder;
  return own.length === 1 && allLinks(document)[link].length < 2 ? own[0] : undefined;
}

/** Remove a joint, a link or a slide. */
export function withoutItem(document, { kind, name }) {
  if (kind === "joint") return removeJoint(document, name);
  return kind === "slide" ? removeSlide(document, name) : removeLink(document, name);
}

/** Join a dragged joint to what it was dropped on. */
export function joinedTo(document, joint, target) {
  return target.joint ? mergeJoints(document, joint, target.joint) : joinToLink(document, joint, target.link);
}

/** Return the direction from one place to another, rad: a round one if it is near, else whole degrees. */
export function guideDirection([x0, y0], [x1, y1], isFree) {
  const angle = Math.atan2(y1 - y0, x1 - x0);
  if (isFree) return angle;
  const round = Math.round(angle / ROUND_ANGLE) * ROUND_ANGLE;
  return Math.abs(round - angle) <= NEAR_ROUND ? round : Math.round(angle / WHOLE_DEGREE) * WHOLE_DEGREE;
}

/** Whether two ends are the same. */
export function isSameEnd(one, other) {
  if (one.joint || other.joint) return one.joint === other.joint;
  return one.at[0] === other.at[0] && one.at[1] === other.at[1];
}
