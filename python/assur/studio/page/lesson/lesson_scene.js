// The parts of the crank-rocker, as payload.py writes those of any mechanism: vertices x, y (m),
// dx, dy (px).

import { LESSON_LINKS } from "./motion.js";

const point = (x, dx = 0, dy = 0) => [x, 0, dx, dy];
/** px: half the guide of the support, its block, and the arrow of the driver. */
const HALF_GUIDE = 62;
const SUPPORT_BLOCK = [20, 12];
const ARROW_RADIUS = 36;
const ARROW_FROM = 0.55;
const ARROW_TO = 1.35;
const ARROW_STEPS = 12;

/** Return where the arrow of the driver turns, in its sense. */
function arrow(sense) {
  const angle = (i) => sense * (ARROW_FROM + (i / ARROW_STEPS) * (ARROW_TO - ARROW_FROM));
  const at = (radius, own) => point(0, radius * Math.cos(own), radius * Math.sin(own));
  const arc = Array.from({ length: ARROW_STEPS + 1 }, (_, i) => at(ARROW_RADIUS, angle(i))).flat();
  const end = angle(ARROW_STEPS);
  const tip = at(ARROW_RADIUS, end + (sense * 11) / ARROW_RADIUS);
  return [arc, [...tip, ...at(ARROW_RADIUS + 5, end), ...at(ARROW_RADIUS - 5, end)]];
}

/** Return the parts of a ground triangle with its hatching, in the frame of a link. */
function lessonPivot(link, name) {
  const own = { link, name, colour: "ink" };
  const triangle = [...point(0), ...point(0, -9.5, -15), ...point(0, 9.5, -15)];
  const base = [...point(0, -15, -15), ...point(0, 15, -15)];
  return [
    { ...own, at: triangle, width: 1.75, closed: true, fill: "canvas", floor: 1 },
    { ...own, at: base, width: 1.75, floor: 1 },
    { ...own, at: base, hatching: 6 },
  ];
}

/**
 * Return the scene of some lengths.
 * @param {{l1: number, l2: number, l3: number}} lengths
 * @param {number} sense of the crank
 */
export function lessonScene({ l1, l2, l3 }, sense) {
  const index = (name) => LESSON_LINKS.indexOf(name);
  const [crank, coupler, rocker] = ["crank", "coupler", "rocker"].map(index);
  const [support, home, pivot] = ["support", "home", "pivot"].map(index);
  const bar = (link, length, width) => {
    const at = [...point(0), ...point(length)];
    return { link, name: `link ${LESSON_LINKS[link]}`, at, width, floor: 1 };
  };
  const joint = (name, link, x, disc = 5) => {
    const own = { link, name: `joint ${name}`, colour: "ink", disc };
    return { ...own, at: point(x), width: 1.9, fill: "canvas" };
  };
  const guide = [...point(0, -HALF_GUIDE, -SUPPORT_BLOCK[1]), ...point(0, HALF_GUIDE, -SUPPORT_BLOCK[1])];
  const [width, height] = SUPPORT_BLOCK;
  const signs = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
  const corners = signs.flatMap(([x, y]) => point(0, x * width, y * height));
  const [arc, head] = arrow(sense);
  const parts = [
    { link: home, name: "slide line", colour: "ink", at: guide, width: 1.75, floor: 1 },
    { link: home, name: "slide line", colour: "ink", at: guide, hatching: 7 },
    { link: support, name: "slide line", at: corners, width: 1.9, closed: true, fill: "canvas", floor: 2 },
    ...lessonPivot(pivot, "pivot D"),
    ...lessonPivot(0, "pivot A"),
    bar(coupler, l2, 3.5),
    bar(rocker, l3, 3.5),
    bar(crank, l1, 4.5),
    { link: crank, name: "driver", colour: "driver", at: arc, width: 2.25, floor: 1 },
    { link: crank, name: "driver", colour: "driver", at: head, width: 0, closed: true, fill: "solid", floor: 1 },
    joint("A", 0, 0, 5.5),
    joint("B", crank, l1),
    joint("C", rocker, l3),
    joint("D", rocker, 0),
  ];
  return { links: LESSON_LINKS, parts, groups: LESSON_LINKS.map(() => -1), driven: [crank] };
}
