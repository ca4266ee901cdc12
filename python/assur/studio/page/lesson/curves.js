// What the three diagrams show beside what has been run.

import { digits } from "../../../pictures/page/numbers.js";
import { lengthText } from "./entries.js";
import { withinTurn } from "./motion.js";
import { sayLesson } from "./lesson_words.js";

const WHOLE_TURN = 2 * Math.PI;
const CURVE_POINTS = 360;
/** A support that is held is a line in the middle of so much, of l4. */
const LEAST_SPAN = 4e-3;

/** Return a table over 0 to 2π as points of the turn that begins at `low`. */
export function turnedTable(values, low) {
  const rows = values.length;
  const at = (angle) => {
    const place = (withinTurn(angle, 0) / WHOLE_TURN) * (rows - 1);
    const row = Math.min(Math.floor(place), rows - 2);
    return values[row] + (place - row) * (values[row + 1] - values[row]);
  };
  return Array.from({ length: rows }, (_, i) => low + (i / (rows - 1)) * WHOLE_TURN).map((angle) => [angle, at(angle)]);
}

/** Return intervals of crank angles, within the turn that begins at `low`. */
export function blockedWithin(stretches, low) {
  const high = low + WHOLE_TURN;
  const shifts = [-1, 0, 1, 2].map((k) => (k + Math.floor(low / WHOLE_TURN)) * WHOLE_TURN);
  return stretches
    .filter((one) => one.side !== null)
    .flatMap(({ start, end }) => shifts.map((shift) => [start + shift, end + shift]))
    .map(([from, to]) => [Math.max(from, low), Math.min(to, high)])
    .filter(([from, to]) => to > from);
}

/** Return the crank angles of a curve: even, and where something changes. */
function curveAngles(motion, low) {
  const even = Array.from({ length: CURVE_POINTS + 1 }, (_, i) => low + (i / CURVE_POINTS) * WHOLE_TURN);
  const slides = motion.stretches.filter((one) => one.side !== null);
  const changes = slides.flatMap(({ start, end }) => [withinTurn(start, low), withinTurn(end, low)]);
  return [...even, ...changes].sort((a, b) => a - b);
}

/** Return how far D slides at most, in each stretch in which it does. */
function slideMarks(angles, figures, stretches, low, l4) {
  return blockedWithin(stretches, low).flatMap(([from, to]) => {
    const isOwn = (i) => angles[i] >= from && angles[i] <= to && Number.isFinite(figures[i].l4);
    const own = angles.map((angle, i) => i).filter(isOwn);
    const away = (i) => Math.abs(figures[i].l4 - l4);
    const most = own.reduce((best, i) => (best === null || away(i) > away(best) ? i : best), null);
    // None at the ends of the axis: there the slide is cut.
    if (most === null || most === 0 || most === angles.length - 1 || away(most) === 0) return [];
    const { l4: value } = figures[most];
    return [{ angle: angles[most], value, text: `${value > l4 ? "+" : ""}${digits(value - l4)}` }];
  });
}

/**
 * Return the data of the diagrams of γ, φ3 and l4.
 * @param {import("./motion.js").LessonMotion} motion
 * @param {boolean} givesWay whether the support does
 * @returns {Object<string, import("./diagram.js").DiagramData>}
 */
export function diagramData(motion, givesWay) {
  const { asked, header, arrays, stretches, lengths } = motion;
  const low = asked.speed > 0 ? asked.start : asked.start - WHOLE_TURN;
  const pose = motion.pose();
  const angles = curveAngles(motion, low);
  const figures = angles.map((angle) => {
    motion.sample(angle, pose);
    const isThere = pose.known && (givesWay || pose.stretch.side === null);
    return isThere ? motion.figures(pose) : { gamma: NaN, phi3: NaN, l4: NaN };
  });
  const grounds = asked.grounds ?? [];
  // Out there the curves of shorter grounds are below.
  const isLong = grounds.length > 0 && grounds[0] < lengths.l4;
  const curve = (key, name) => {
    const points = angles.map((angle, i) => [angle, figures[i][key]]);
    return { kind: "turn", name, isBelow: !isLong, points };
  };
  const blocked = blockedWithin(stretches, low);
  const rows = arrays.phi1.length;
  const beside = grounds.map((ground, k) => ({
    kind: "beside",
    isBelow: isLong,
    name: k === grounds.length - 1 ? `l_4 = ${Number(ground.toPrecision(6))}` : undefined,
    points: turnedTable(arrays.gamma_of.subarray(k * rows, (k + 1) * rows), low),
  }));
  const isBlocked = (angle) => blocked.some(([from, to]) => angle > from && angle < to);
  const rigid = turnedTable(arrays.gamma, low).map(([angle, value]) => [angle, isBlocked(angle) ? value : NaN]);
  const marks = givesWay ? slideMarks(angles, figures, stretches, low, lengths.l4) : [];
  const common = { low, sense: Math.sign(asked.speed), blocked };
  const gamma = [...beside, { kind: "rigid", points: rigid }, curve("gamma", lengthText(lengths.l4))];
  const limit = { limit: header.gamma_min, limitText: sayLesson("jamsBelow") };
  return {
    gamma: { ...common, curves: gamma, ...limit, least: 0 },
    phi3: { ...common, curves: [curve("phi3")], isAngle: true },
    l4: { ...common, curves: [curve("l4")], marks, span: LEAST_SPAN * lengths.l4 },
  };
}
