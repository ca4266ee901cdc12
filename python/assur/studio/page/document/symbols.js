// Symbols of links, joints, pivots and drivers, as the server draws them (pictures/scene): all
// parts are in the drawing's axes. A vertex is x, y in m and dx, dy in px.

import { extentOf, hullOf, ON_LINE, unitVector } from "./plane.js";

/** Sizes of symbols, px: those of pictures/sizes.py, which a test compares. */
export const SIZES = {
  ...{ JOINT: 5, PIVOT: 5.5, PIVOT_WIDTH: 19, PIVOT_HEIGHT: 15, PIVOT_BASE: 30, GROUND_SPACING: 6 },
  ...{ BAR: 3.5, DRIVEN_BAR: 4.5, PLATE: 2.5, OUTLINE: 1.9, BLOCK_LENGTH: 30, BLOCK_WIDTH: 19, GUIDE: 1.75 },
  ...{ GUIDE_SPACING: 7, SLEEVE_LENGTH: 34, SLEEVE_GAP: 13, BARREL: 15, ROD: 4.5, PISTON: 3.5, BRIDGE: 18 },
  ...{ ARROW_RADIUS: 24, ARROW: 2.25, ARROW_HEAD: 10, ARROW_HEAD_WIDTH: 9, DRIVE_LENGTH: 30, DRIVE_DISTANCE: 12 },
};
/** From the driven link to the arrow's tail and to its head, rad. */
const ARROW_TAIL = 0.44;
const ARROW_TIP = 1.5;

/** Return a vertex at a point, moved by px. */
export const vertexAt = ([x, y], dx = 0, dy = 0) => [x, y, dx, dy];

/** Return a shape given in px about a point, turned by an angle. */
export function shapeAbout(point, angle, shape) {
  const [cosine, sine] = unitVector(angle);
  return shape.map(([x, y]) => vertexAt(point, cosine * x - sine * y, sine * x + cosine * y));
}

/** Return points of an arc in px, angles in rad. */
function arcPoints(radius, start, end, count = 17) {
  const angles = Array.from({ length: count }, (_, i) => start + ((end - start) * i) / (count - 1));
  return angles.map((angle) => unitVector(angle).map((own) => radius * own));
}

/** Return a part that is a line or an area; `more` as `closed`, `fill`, `floor`. */
export function strokePart(link, name, vertices, width, more = {}) {
  return { link, name, at: vertices.flat(), width, floor: 1, ...more };
}

/** Return a part that is hatching on the right of a line. */
export function hatchingPart(name, start, end, spacing) {
  return { link: 0, name, colour: "ink", hatching: spacing, at: [...start, ...end] };
}

/** Draw a bar between two joints, a plate for more, nothing for a link of one joint. */
export function linkParts(link, name, points, isDriven) {
  if (points.length < 2 || !extentOf(points)) return [];
  const width = isDriven ? SIZES.DRIVEN_BAR : SIZES.BAR;
  const corners = hullOf(points);
  if (corners.length > 2) {
    const plate = (SIZES.PLATE * width) / SIZES.BAR;
    const more = { closed: true, fill: "tint", hatched: true, floor: 0 };
    return [strokePart(link, `link ${name}`, corners.map((point) => vertexAt(point)), plate, more)];
  }
  // Along the link's frame, from its first joint to its second: a bridge is on its left.
  const [first, second] = points;
  const forward = ([x, y]) => x * (second[0] - first[0]) + y * (second[1] - first[1]);
  const [a, b] = corners.sort((one, other) => forward(one) - forward(other));
  const bar = strokePart(link, `link ${name}`, [vertexAt(a), vertexAt(b)], width);
  const angle = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const isInner = (point) => [a, b].every((end) => Math.hypot(point[0] - end[0], point[1] - end[1]) > ON_LINE * length);
  // Through a joint inside it a bar goes on under a bridge.
  const bridges = points.filter(isInner).map((point) => {
    return strokePart(link, `link ${name}`, shapeAbout(point, angle, arcPoints(SIZES.BRIDGE, 0, Math.PI)), 2);
  });
  return [bar, ...bridges];
}

/** Draw a fixed pivot: a triangle on hatched ground. */
export function pivotParts(joint, point) {
  const name = `pivot ${joint}`;
  const [half, base, height] = [SIZES.PIVOT_WIDTH / 2, SIZES.PIVOT_BASE / 2, -SIZES.PIVOT_HEIGHT];
  const triangle = [vertexAt(point), vertexAt(point, -half, height), vertexAt(point, half, height)];
  const [left, right] = [vertexAt(point, -base, height), vertexAt(point, base, height)];
  return [
    strokePart(0, name, triangle, SIZES.GUIDE, { colour: "ink", closed: true, fill: "canvas" }),
    strokePart(0, name, [left, right], SIZES.GUIDE, { colour: "ink" }),
    hatchingPart(name, left, right, SIZES.GROUND_SPACING),
  ];
}

/** Draw a turning pair as a circle; a point of one link is a dot, and so is one of none, but paler. */
export function jointPart(joint, link, point, links, isFixed) {
  const own = { link, name: `joint ${joint}`, colour: links ? "ink" : "second", at: vertexAt(point) };
  if (links < 2 && !isFixed) return { ...own, disc: 0.64 * SIZES.JOINT, width: 0, fill: "solid" };
  return { ...own, disc: isFixed ? SIZES.PIVOT : SIZES.JOINT, width: SIZES.OUTLINE, fill: "canvas" };
}

/** Draw the sense of +q about a pivot; `toward` is the link's direction, rad. */
export function turningArrow(link, pivot, toward) {
  const radius = SIZES.ARROW_RADIUS;
  // The arc ends within the head.
  const inside = ARROW_TIP - (0.8 * SIZES.ARROW_HEAD) / radius;
  const tip = unitVector(ARROW_TIP).map((own) => radius * own);
  const end = unitVector(inside).map((own) => radius * own);
  const head = arrowHead(tip, Math.atan2(tip[1] - end[1], tip[0] - end[0]));
  return arrowParts(link, pivot, toward, arcPoints(radius, ARROW_TAIL, inside), head);
}

/** Draw the sense of +q beside a driven slide. */
export function slidingArrow(link, point, angle) {
  const half = SIZES.DRIVE_LENGTH / 2;
  const side = SIZES.DRIVE_DISTANCE + SIZES.BLOCK_WIDTH / 2;
  const shaft = [[-half, side], [half - 0.8 * SIZES.ARROW_HEAD, side]];
  return arrowParts(link, point, angle, shaft, arrowHead([half, side], 0));
}

function arrowParts(link, point, angle, shaft, head) {
  return [
    strokePart(link, "driver", shapeAbout(point, angle, shaft), SIZES.ARROW, { colour: "driver" }),
    strokePart(link, "driver", shapeAbout(point, angle, head), 0, { colour: "driver", closed: true, fill: "solid" }),
  ];
}

/** Return a filled arrow head in px. */
function arrowHead([x, y], angle) {
  const [ux, uy] = unitVector(angle);
  const [back, half] = [SIZES.ARROW_HEAD, SIZES.ARROW_HEAD_WIDTH / 2];
  const [bx, by] = [x - back * ux, y - back * uy];
  return [[x, y], [bx - half * uy, by + half * ux], [bx + half * uy, by - half * ux]];
}
