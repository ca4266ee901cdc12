// What the lesson asks the server, and which other grounds it compares with.

import { niceLength } from "../../../pictures/page/numbers.js";
import { LessonMotion } from "./motion.js";

const LESSON_ROWS = 181;
const NEIGHBOURS = 4;
/** How often a request is sent whose place another took. */
const ATTEMPTS = 3;
/** Between the grounds compared, of the range in which the crank turns. */
const NEIGHBOUR_PART = 0.06;

/** Return grounds beside l4, towards the middle of where the crank turns. */
export function neighbours({ l1, l2, l3, l4 }) {
  const range = 2 * (Math.min(l2, l3) - l1);
  if (!(range > 0)) return null;
  const step = niceLength(NEIGHBOUR_PART * range);
  const sense = l4 > Math.max(l2, l3) ? -1 : 1;
  // Only where the crank turns is there a curve over the turn.
  const within = Math.min(Math.max(l4, Math.max(l2, l3) - range / 2), Math.max(l2, l3) + range / 2);
  const first = sense < 0 ? Math.ceil(within / step - 1e-6) - 1 : Math.floor(within / step + 1e-6) + 1;
  const grounds = Array.from({ length: NEIGHBOURS }, (_, k) => Number(((first + sense * k) * step).toPrecision(9)));
  return grounds.filter((one) => one > 0).length === NEIGHBOURS ? grounds : null;
}

/**
 * Return the fields of a request.
 * @param {import("./fields.js").Design} design
 * @param {number} phi1 rad
 * @param {number} groundSpeed dl4/dt, m/s
 */
export function lessonRequest(design, phi1, groundSpeed) {
  const { l1, l2, l3, l4, speed, least, friction } = design;
  const fields = { l1, l2, l3, l4, phi1, speed, ground_speed: groundSpeed };
  const wanted = { motion: true, rows: LESSON_ROWS, grounds: neighbours(design) };
  return { ...fields, ...wanted, ...(friction ? { friction } : { gamma_min: least }) };
}

/**
 * Ask the server for the motion of a design.
 * @param {(kind: string, fields: Object) => Promise<Object|null>} ask
 * @param {import("./fields.js").Design} design
 * @param {number} phi1
 * @param {number} groundSpeed
 * @returns {Promise<LessonMotion>}
 */
export async function askForMotion(ask, design, phi1, groundSpeed) {
  const asked = lessonRequest(design, phi1, groundSpeed);
  for (let i = 0; i < ATTEMPTS; i++) {
    const answer = await ask("lesson", asked);
    if (answer) return new LessonMotion(answer, { ...asked, start: design.start });
  }
  throw Object.assign(new Error("the server has too much to do"), { kind: "busy" });
}

/** Return a design in crank lengths, or one of another crank length. */
export function scaledDesign(design, factor) {
  const scaled = { ...design };
  for (const key of ["l1", "l2", "l3", "l4"]) scaled[key] = design[key] * factor;
  const { friction } = design;
  if (friction) scaled.friction = { ...friction, r_c: friction.r_c * factor, r_d: friction.r_d * factor };
  return scaled;
}
