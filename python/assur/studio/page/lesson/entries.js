// What is typed into the fields of the lesson, and how its lengths and angles are written.

import { degrees, digits } from "../../../pictures/page/numbers.js";
import { parseQuantity } from "../document/units.js";

const DEGREE_IN_RAD = Math.PI / 180;

/** Kinds of fields: the unit of the value, and that of a number alone. */
export const FIELD_KINDS = {
  number: ["", ""],
  /** A length relative to the crank. */
  ratio: ["", ""],
  length: ["m", "m"],
  degrees: ["rad", "°"],
  rad: ["rad", "rad"],
  speed: ["rad/s", "rad/s"],
};

/**
 * Read what was typed: `4.5`, `9/2`, `12 cm`, `−60°`, `1,5`.
 * @param {string} text
 * @param {keyof typeof FIELD_KINDS} kind
 * @returns {{value: number} | {error: string, values: Object<string, string>}}
 */
export function readTyped(text, kind) {
  return parseQuantity(text, ...FIELD_KINDS[kind]);
}

/** Write a length: five digits, at least three decimals if there is room. */
export function lengthText(x) {
  if (!Number.isFinite(x)) return "–";
  const own = Number(x.toPrecision(5));
  const decimals = (String(own).split(".")[1] ?? "").length;
  const isPlain = Math.abs(own) >= 1e-3 && Math.abs(own) < 1e3;
  const text = isPlain ? own.toFixed(Math.max(3, Math.min(decimals, 6))) : digits(own, 5);
  return text.replaceAll("-", "−");
}

/** Write a value as its field does. */
export function typedText(value, kind) {
  if (kind === "degrees") return (value / DEGREE_IN_RAD).toFixed(1).replace("-", "−");
  if (kind === "length" || kind === "ratio") return lengthText(value);
  return Math.abs(value) >= 1e-3 && Math.abs(value) < 1e3 ? fourDigits(value) : digits(value, 4);
}

function fourDigits(value) {
  const decimals = (String(Number(value.toPrecision(6))).split(".")[1] ?? "").length;
  return value.toFixed(Math.max(3, Math.min(decimals, 6))).replace("-", "−");
}

/** Write a crank angle of any turn, 0° to 360°. */
export function turnText(angle, decimals = 1) {
  const whole = 10 ** decimals;
  const own = Math.round(((((angle / DEGREE_IN_RAD) % 360) + 360) % 360) * whole) / whole;
  return degrees((own % 360) * DEGREE_IN_RAD, decimals);
}
