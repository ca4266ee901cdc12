// Where a dragged point goes: to a joint, to a link, along a line, to the grid.

import { niceLength } from "../../../pictures/page/numbers.js";
import { listOf, tableOf } from "./names.js";
import { hullOf, nearestOn } from "./plane.js";
import { placeOf } from "./structure.js";

/** From so near joints and links catch, px; the grid is about so wide. */
const JOINT_REACH = 13;
const LINK_REACH = 10;
const GRID = 20;
/** With Shift a joint catches only if it lies on the line, px. */
const ON_GUIDE = 0.5;

/** Return the step of the grid, m: 1, 2 or 5 times a power of ten, about 20 px. */
export function gridStep(scale) {
  return niceLength((1.4 * GRID) / scale);
}

/** Return the place on the grid, without the rounding of its steps. */
function onGrid(place, step) {
  return place.map((own) => Number((Math.round(own / step) * step).toPrecision(12)) + 0);
}

/** Return the entry that is nearest, if it is within reach. */
function nearestWithin(found, reach) {
  const within = found.filter(({ distance }) => distance <= reach);
  return within.reduce((best, own) => (best === null || own.distance < best.distance ? own : best), null);
}

/**
 * Return where a dragged point goes.
 *
 * It goes to a joint within 13 px, else to the line of a link within 10 px, else to the grid. With
 * Shift it stays on a line through `from`: along x or y, or along a link of the dragged joint,
 * whichever is nearest; a joint catches if it lies there. With Alt nothing catches.
 * @param {number[]} place m
 * @param {Object} options
 * @param {Object} options.document
 * @param {number} options.scale px to a metre
 * @param {string[]} [options.exclude] joints and links that do not catch: those that are dragged
 * @param {boolean} [options.alt]
 * @param {boolean} [options.shift]
 * @param {number[]} [options.from] where the gesture began, or the first end of a new link
 * @param {Object<string, number[]>} [options.places] of joints, where they are not as in the drawing
 * @returns {{at: number[], joint?: string, link?: string, guide?: {from: number[], along: number[]}}}
 */
export function snapped(place, options) {
  const { document, scale, exclude = [], alt = false, shift = false, from = null, places = {} } = options;
  if (alt || !(scale > 0) || !Number.isFinite(scale)) return { at: [...place] };
  const at = (joint) => (Object.hasOwn(places, joint) ? places[joint] : placeOf(document, joint));
  const px = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) * scale;
  const guide = shift && from ? guideThrough(place, from, shiftDirections(document, exclude, from, at)) : null;
  const own = guide ? guide.at : place;
  const joints = Object.keys(tableOf(document.joints)).filter((joint) => !exclude.includes(joint) && at(joint));
  const near = joints.map((joint) => ({ joint, at: at(joint), distance: px(at(joint), own) }));
  if (guide) {
    const line = { from: [...from], along: guide.along };
    const [ux, uy] = guide.along;
    const isOn = ({ at: [x, y] }) => Math.abs((y - from[1]) * ux - (x - from[0]) * uy) * scale <= ON_GUIDE;
    const caught = nearestWithin(near.filter(isOn), JOINT_REACH);
    if (caught) return { at: [...caught.at], joint: caught.joint, guide: line };
    return { at: alongGrid(guide, from, scale), guide: line };
  }
  const joint = nearestWithin(near, JOINT_REACH);
  if (joint) return { at: [...joint.at], joint: joint.joint };
  const lines = Object.entries(tableOf(document.links)).flatMap(([link, own]) => {
    const isDragged = exclude.includes(link) || listOf(own).some((name) => exclude.includes(name));
    const points = link === "ground" || isDragged ? [] : listOf(own).map(at).filter(Boolean);
    return sidesOf(points).map(([a, b]) => {
      const foot = nearestOn(place, a, b);
      return { link, at: foot, distance: px(foot, place) };
    });
  });
  const line = nearestWithin(lines, LINK_REACH);
  if (line) return { at: line.at, link: line.link };
  return { at: onGrid(place, gridStep(scale)) };
}

/** Return the lines of a link as it is drawn: a bar, or the sides of a plate. */
function sidesOf(points) {
  const corners = hullOf(points);
  return corners.length < 2 ? [] : corners.map((corner, i) => [corner, corners[(i + 1) % corners.length]]);
}

/** Return the directions that Shift offers: x, y, and those of the links of a dragged joint. */
function shiftDirections(document, exclude, from, at) {
  const found = [[1, 0], [0, 1]];
  for (const [link, joints] of Object.entries(tableOf(document.links))) {
    if (link === "ground" || !listOf(joints).some((joint) => exclude.includes(joint))) continue;
    for (const joint of listOf(joints).filter((name) => !exclude.includes(name) && at(name))) {
      const [dx, dy] = [at(joint)[0] - from[0], at(joint)[1] - from[1]];
      const length = Math.hypot(dx, dy);
      if (length > 0) found.push([dx / length, dy / length]);
    }
  }
  return found;
}

/** Return the foot of a place on the nearest line through a point. */
function guideThrough(place, from, all) {
  const [dx, dy] = [place[0] - from[0], place[1] - from[1]];
  const off = (along) => Math.abs(dy * along[0] - dx * along[1]);
  const { along } = nearestWithin(all.map((one) => ({ along: one, distance: off(one) })), Infinity);
  const length = dx * along[0] + dy * along[1];
  return { along, at: [from[0] + length * along[0], from[1] + length * along[1]] };
}

/** Along x and y a point goes on by the grid, along a link freely. */
function alongGrid({ along, at }, from, scale) {
  const grid = onGrid(at, gridStep(scale));
  if (along[1] === 0) return [grid[0], from[1]];
  return along[0] === 0 ? [from[0], grid[1]] : at;
}
