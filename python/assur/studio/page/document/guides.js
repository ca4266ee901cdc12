// Symbols of sliding pairs: a block on a guide, a rod in a sleeve, a cylinder, as the server draws
// them (pictures/scene/slides.py, cylinders.py). A sketch knows no stroke: guides reach a part of
// the drawing's size both ways, and a piston stands in the middle of its barrel.

import { alongAndLeft, ON_LINE, unitVector } from "./plane.js";
import { hatchingPart, shapeAbout, SIZES, slidingArrow, strokePart, vertexAt } from "./symbols.js";

/** What of a guide is seen beyond the block, px. */
const BEYOND_BLOCK = 8;
/** How far a guide reaches, relative to the drawing's size. */
const FREE_STROKE = 0.15;
/** Of a cylinder's length: the least to which it would retract, the barrel of that, the piston's place. */
const RETRACTED = 0.75;
const BARREL_OF_LEAST = 0.86;
const PISTON_OF_BARREL = 0.5;
/** Between the joint and the barrel, px. */
const EYE = 9;

/**
 * A sliding pair in the drawing. `joints` of both are places, `isAlone` is whether no other slide
 * touches either link and neither is driven.
 * @typedef {Object} Pair
 * @property {string} name
 * @property {number} sliding index of the link
 * @property {number} guide
 * @property {string} slidingName
 * @property {string} guideName
 * @property {number[][]} slidingJoints
 * @property {number[][]} guideJoints
 * @property {number[]} block the sliding point
 * @property {number[]} carrier where the guide's link is, if it has no joint
 * @property {number} angle of the guide, rad
 * @property {boolean} isAlone
 * @property {boolean} isDriven whether the slide drives
 * @property {boolean} isGuideDriven whether the guide's link is driven
 */

/**
 * Draw a sliding pair, and the arrow if it drives.
 * @param {Pair} pair
 * @param {number} size of the drawing, m
 * @param {number[][]} ground the fixed joints
 * @returns {{parts: Object[], arrows: Object[]}}
 */
export function slideParts(pair, size, ground) {
  const held = jointOnAxis(pair, size);
  const arrows = pair.isDriven ? slidingArrow(pair.sliding, pair.block, pair.angle) : [];
  if (held && pair.slidingJoints.length === 1 && pair.isAlone) return { parts: cylinderParts(pair, held), arrows };
  if (pair.slidingJoints.length) return { parts: blockParts(pair, size), arrows };
  if (pair.guide === 0) return { parts: sleeveParts(pair, size, ground), arrows };
  if (!held) return { parts: blockParts(pair, size), arrows };
  // The block is the link that has the joint; the other one is the rod through it.
  const turned = {
    ...pair,
    ...{ sliding: pair.guide, guide: pair.sliding, slidingName: pair.guideName, guideName: pair.slidingName },
    ...{ guideJoints: [], block: held, carrier: pair.block, isGuideDriven: false },
  };
  return { parts: blockParts(turned, size), arrows };
}

/** Return the guide's only joint if it lies on the axis. */
function jointOnAxis({ guide, guideJoints, block, angle }, size) {
  if (guide === 0 || guideJoints.length !== 1) return null;
  const [own] = guideJoints;
  const off = alongAndLeft([own[0] - block[0], own[1] - block[1]], unitVector(angle))[1];
  return Math.abs(off) <= ON_LINE * size ? own : null;
}

function rectangleShape(length, width) {
  const [a, b] = [length / 2, width / 2];
  return [[-a, -b], [a, -b], [a, b], [-a, b]];
}

function blockParts(pair, size) {
  const { sliding, block, angle } = pair;
  const half = SIZES.BLOCK_LENGTH / 2;
  const name = `slide ${pair.name}`;
  const shape = shapeAbout(block, angle, rectangleShape(SIZES.BLOCK_LENGTH, SIZES.BLOCK_WIDTH));
  const own = strokePart(sliding, name, shape, SIZES.OUTLINE, { closed: true, fill: "canvas", floor: 2 });
  const beyond = half + BEYOND_BLOCK;
  if (pair.guide === 0) return [...groundGuide(pair, name, FREE_STROKE * size, beyond), own];
  const inside = shapeAbout(block, angle, [[-half, 0], [half, 0]]);
  const middle = strokePart(sliding, name, inside, 1, { colour: "second", dashes: [4, 3], floor: 3 });
  return [...movingGuide(pair, size, beyond), own, middle];
}

/** Draw a hatched line under the block: on the side that is down, or right if it is upright. */
function groundGuide({ block, angle }, name, reach, beyond) {
  const [ux, uy] = unitVector(angle);
  const isDown = ux > 1e-9 || (Math.abs(ux) <= 1e-9 && uy > 0);
  const side = isDown ? -SIZES.BLOCK_WIDTH / 2 : SIZES.BLOCK_WIDTH / 2;
  const end = (sign) => {
    const point = [block[0] + sign * reach * ux, block[1] + sign * reach * uy];
    return vertexAt(point, sign * beyond * ux - side * uy, sign * beyond * uy + side * ux);
  };
  const ends = [end(-1), end(1)];
  // Hatching lies on the right of its line.
  const [from, to] = side < 0 ? ends : [ends[1], ends[0]];
  return [strokePart(0, name, ends, SIZES.GUIDE, { colour: "ink" }), hatchingPart(name, from, to, SIZES.GUIDE_SPACING)];
}

/** Draw a line along the axis, and what carries it. */
function movingGuide(pair, size, beyond) {
  const { guide, guideJoints, block, angle } = pair;
  const forward = unitVector(angle);
  const reach = FREE_STROKE * size;
  const carried = guideJoints.length ? guideJoints : [pair.carrier];
  const seen = carried.map((joint) => {
    const [along, off] = alongAndLeft([joint[0] - block[0], joint[1] - block[1]], forward);
    return { joint, along, isOn: Math.abs(off) <= ON_LINE * size };
  });
  // The line ends at a joint; where there is none it goes on.
  const ends = seen.filter(({ isOn }) => isOn).map(({ along }) => along);
  const [first, last] = [Math.min(0, ...ends), Math.max(0, ...ends)];
  const hasJoints = guideJoints.length > 0;
  const low = first < 0 && hasJoints ? [first, 0] : [Math.min(first, -reach), -beyond];
  const high = last > 0 && hasJoints ? [last, 0] : [Math.max(last, reach), beyond];
  const on = (along) => [block[0] + along * forward[0], block[1] + along * forward[1]];
  const line = [low, high].map(([along, px]) => vertexAt(on(along), forward[0] * px, forward[1] * px));
  const name = `link ${pair.guideName}`;
  const parts = [strokePart(guide, name, line, pair.isGuideDriven ? SIZES.DRIVEN_BAR : SIZES.BAR)];
  if (ends.length) return parts;
  const outside = ({ along }) => Math.max(low[0] - along, along - high[0], 0);
  const nearest = seen.reduce((best, own) => (outside(own) < outside(best) ? own : best));
  const foot = on(Math.min(Math.max(nearest.along, low[0]), high[0]));
  return [...parts, strokePart(guide, name, [vertexAt(nearest.joint), vertexAt(foot)], SIZES.BAR)];
}

/** Draw a rod of a link without joints in a sleeve on the ground. */
function sleeveParts({ name, sliding, slidingName, block, angle }, size, ground) {
  const reach = FREE_STROKE * size;
  const forward = unitVector(angle);
  const on = (along) => [block[0] + along * forward[0], block[1] + along * forward[1]];
  // Clear of the ground's joints, if anywhere.
  const isClear = (along) => ground.every(([x, y]) => Math.hypot(on(along)[0] - x, on(along)[1] - y) > reach / 2);
  const along = [0, reach, -reach].find(isClear) ?? 0;
  const half = SIZES.SLEEVE_LENGTH / 2;
  const walls = [1, -1].flatMap((side) => {
    const gap = (side * SIZES.SLEEVE_GAP) / 2;
    const ends = shapeAbout(on(along), angle, [[side * half, gap], [-side * half, gap]]);
    // The wall is beyond the line.
    const own = strokePart(0, `slide ${name}`, ends, 2, { colour: "ink" });
    return [own, hatchingPart(`slide ${name}`, ends[0], ends[1], SIZES.GROUND_SPACING)];
  });
  const px = half + 2 * BEYOND_BLOCK;
  const rod = [-1, 1].map((sign) => vertexAt(on(sign * reach + along), sign * px * forward[0], sign * px * forward[1]));
  return [...walls, strokePart(sliding, `link ${slidingName}`, rod, SIZES.BAR)];
}

/** Draw a barrel from the guide's joint, and a rod with its piston to the sliding one. */
function cylinderParts({ name, guide, sliding, block, angle, isDriven }, base) {
  const length = Math.hypot(block[0] - base[0], block[1] - base[1]);
  const forward = length ? [(block[0] - base[0]) / length, (block[1] - base[1]) / length] : unitVector(angle);
  const left = [-forward[1], forward[0]];
  const barrel = BARREL_OF_LEAST * RETRACTED * length;
  const colour = isDriven ? { colour: "driver" } : {};
  const half = SIZES.BARREL / 2;
  const at = (along, px, off) => {
    const point = [base[0] + along * forward[0], base[1] + along * forward[1]];
    return vertexAt(point, px * forward[0] + off * left[0], px * forward[1] + off * left[1]);
  };
  const outline = [at(barrel, 0, -half), at(0, EYE, -half), at(0, EYE, half), at(barrel, 0, half)];
  const piston = PISTON_OF_BARREL * barrel;
  const reach = half - 2;
  const own = `slide ${name}`;
  return [
    strokePart(guide, own, [at(0, 0, 0), at(0, EYE, 0)], SIZES.BAR, colour),
    strokePart(guide, own, outline, SIZES.OUTLINE, { ...colour, closed: true, fill: "tint", floor: 2 }),
    strokePart(sliding, own, [at(piston, 0, 0), vertexAt(block)], SIZES.ROD, { ...colour, floor: 3 }),
    strokePart(sliding, own, [at(piston, 0, -reach), at(piston, 0, reach)], SIZES.PISTON, { ...colour, floor: 3 }),
  ];
}
