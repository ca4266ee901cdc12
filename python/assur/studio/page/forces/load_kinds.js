// What loads there are: the fields of each, what a new one is, and how it is said in a line.

import { digits, forceUnit } from "../../../pictures/page/numbers.js";
import { allLinks, listOf, tableOf } from "../document/names.js";
import { constantOf, isValueTable } from "./values.js";

/**
 * A field: its key in the file, what it is (`joint` a joint or a place, `link`, `axes` a link or
 * none, `components` two values, `value` one, `vector` two numbers, `number`, `way` when it acts) and
 * the unit.
 */
const field = (key, is, unit = "") => ({ key, is, unit });

/** Those that can be edited; others are shown, and can be removed. */
export const LOAD_FIELDS = {
  Force: [field("at", "joint"), field("force", "components", "N"), field("axes", "axes"), field("while_", "way")],
  Torque: [field("link", "link"), field("on", "link"), field("torque", "value", "N·m"), field("while_", "way")],
  Spring: [
    ...[field("first", "joint"), field("second", "joint"), field("stiffness", "number", "N/m")],
    ...[field("length", "number", "m"), field("preload", "number", "N")],
  ],
  Damper: [field("first", "joint"), field("second", "joint"), field("damping", "number", "N·s/m")],
  TorsionSpring: [
    ...[field("link", "link"), field("on", "link"), field("stiffness", "number", "N·m/rad")],
    ...[field("angle", "number", "rad"), field("preload", "number", "N·m")],
  ],
  TorsionDamper: [field("link", "link"), field("on", "link"), field("damping", "number", "N·m·s/rad")],
  Gravity: [field("acceleration", "vector", "m/s²")],
};

/** Gravity where none is given: along the drawing's −y, m/s². */
export const USUAL_GRAVITY = [0, -9.81];

/** Moving links, and joints that lie on one. */
export function movingParts(document) {
  const links = Object.keys(allLinks(document)).filter((name) => name !== "ground");
  const on = new Set(links.flatMap((name) => allLinks(document)[name]));
  const joints = Object.keys(tableOf(document.joints)).filter((name) => on.has(name));
  return { links, joints };
}

/** Return the link that drives, or null of a slide. */
export function drivenLink(document) {
  const first = Array.isArray(document.driver) ? document.driver[0] : document.driver;
  const name = typeof first === "object" && first ? first.link : first;
  return Object.hasOwn(allLinks(document), name) ? name : (tableOf(document.slides)[name]?.link ?? null);
}

/**
 * Return the slide whose link a joint lies on, with its way on the ground, or null: what acts on a ram acts along it.
 * @returns {{name: string, way: number[]} | null} `way` of length 1
 */
export function slideAt(document, joint) {
  for (const [name, { link, on = "ground", angle, along }] of Object.entries(tableOf(document.slides))) {
    if (on !== "ground" || !listOf(allLinks(document)[link]).includes(joint)) continue;
    const given = tableOf(document.dimensions)[`${name}.angle`] ?? angle;
    const [a, b] = listOf(along).map((end) => tableOf(document.joints)[end]);
    const own = a && b ? Math.atan2(b[1] - a[1], b[0] - a[0]) : given;
    if (Number.isFinite(own)) return { name, way: [Math.cos(own), Math.sin(own)] };
  }
  return null;
}

/** Return a force of 100 N: against a slide that goes forward, or down. */
function newForce(document, at) {
  const slide = slideAt(document, at);
  if (!slide) return { at, force: [0, -100] };
  return { at, force: slide.way.map((part) => Number((-100 * part).toFixed(3)) || 0) };
}

/**
 * Return a new load, for a document: it acts where something moves, and can be seen.
 * @param {string} type
 */
export function newLoad(document, type) {
  const { links, joints } = movingParts(document);
  const ground = listOf(tableOf(document.links).ground);
  const free = joints.filter((name) => !ground.includes(name));
  const at = free.at(-1) ?? joints.at(-1) ?? "";
  const link = drivenLink(document) ?? links[0] ?? "";
  const other = [...ground, ...joints].find((name) => name !== at) ?? "";
  const [a, b] = [at, other].map((name) => tableOf(document.joints)[name] ?? [0, 0]);
  const length = Number(Math.hypot(a[0] - b[0], a[1] - b[1]).toPrecision(3));
  const made = {
    Force: newForce(document, at),
    Torque: { link, torque: -10 },
    Spring: { first: other, second: at, stiffness: 1000, length },
    Damper: { first: other, second: at, damping: 100 },
    TorsionSpring: { link, stiffness: 10 },
    TorsionDamper: { link, damping: 1 },
    Gravity: { acceleration: [...USUAL_GRAVITY] },
  }[type];
  return { type, ...made };
}

/** Write a place: a joint, or a point of a link. */
export function placeText(at) {
  if (typeof at === "string") return at;
  return Array.isArray(at) ? `${at[0]} (${listOf(at[1]).map((one) => digits(one)).join(", ")})` : "";
}

function loadValueText(value, unit, say) {
  if (isValueTable(value)) return say("tableRows", { n: value.q.length });
  const own = forceUnit(unit, constantOf(value));
  return `${digits(constantOf(value) * own.factor)} ${own.name}`;
}

/**
 * Say a load in a line: what it is, where it acts, how large.
 * @param {Object} load
 * @param {(key: string, values?: Object) => string} say
 * @returns {{what: string, size: string}}
 */
export function loadText(load, say) {
  const { type } = load;
  const when = load.while_ ? ` · ${say(load.while_ === "forward" ? "actsForward" : "actsBackward")}` : "";
  switch (type) {
    case "Force": {
      const parts = listOf(load.force);
      const size = parts.some(isValueTable)
        ? parts.filter((one) => one !== 0).map((one) => loadValueText(one, "N", say)).join("; ")
        : loadValueText(Math.hypot(...parts), "N", say);
      return { what: say("forceOn", { at: placeText(load.at) }), size: size + when };
    }
    case "Torque":
      return { what: say("torqueOn", { link: load.link }), size: loadValueText(load.torque, "N·m", say) + when };
    case "Spring":
      return { what: say("springBetween", ends(load)), size: `${digits(load.stiffness)} N/m` };
    case "Damper":
      return { what: say("damperBetween", ends(load)), size: `${digits(load.damping)} N·s/m` };
    case "TorsionSpring":
      return { what: say("torsionSpringOn", { link: load.link }), size: `${digits(load.stiffness)} N·m/rad` };
    case "TorsionDamper":
      return { what: say("torsionDamperOn", { link: load.link }), size: `${digits(load.damping)} N·m·s/rad` };
    case "Gravity":
      return { what: say("weight"), size: `${digits(Math.hypot(...listOf(load.acceleration ?? USUAL_GRAVITY)))} m/s²` };
    case "Pressure":
      return {
        what: say("pressureIn", { slide: load.slide }),
        size: isValueTable(load.pressure) ? say("tableRows", { n: load.pressure.q.length }) : "",
      };
    default:
      return { what: String(type), size: "" };
  }
}

const ends = ({ first, second }) => ({ first: placeText(first), second: placeText(second) });
