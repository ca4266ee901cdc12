// Quantities as people type them, and as fields show them. Inside all is SI and rad.

import { digits, lengthUnit } from "../../../pictures/page/numbers.js";
import { PER_MINUTE, SPEEDS } from "../../../pictures/page/speeds.js";

/**
 * Units by the SI unit of the quantity: how many SI units one is, as [factor, divisor], both whole
 * where that is possible, so that 83 mm is the same number as 0.083 m.
 */
const UNITS = {
  "rad/s": {
    ...SPEEDS["rad/s"],
    ...{ "deg/s": [Math.PI, 180], "min⁻¹": PER_MINUTE, "rev/min": PER_MINUTE, "U/min": PER_MINUTE, "об/мин": PER_MINUTE, "об/хв": PER_MINUTE },
  },
  "m/s": { ...SPEEDS["m/s"], "mm/min": [1, 6e4], "km/h": [5, 18] },
  "": { "": [1, 1], "%": [1, 100] },
  m: {
    ...{ m: [1, 1], mm: [1, 1e3], cm: [1, 100], dm: [1, 10], "µm": [1, 1e6], um: [1, 1e6], km: [1e3, 1] },
    ...{ in: [127, 5000], ft: [381, 1250] },
  },
  rad: { rad: [1, 1], "°": [Math.PI, 180], deg: [Math.PI, 180], turn: [2 * Math.PI, 1], turns: [2 * Math.PI, 1] },
  "m²": { "m²": [1, 1], "cm²": [1, 1e4], "mm²": [1, 1e6] },
  s: { s: [1, 1], ms: [1, 1e3], min: [60, 1] },
  kg: { kg: [1, 1], g: [1, 1e3], t: [1e3, 1] },
  "kg·m²": { "kg·m²": [1, 1], "kg·cm²": [1, 1e4], "kg·mm²": [1, 1e6], "g·cm²": [1, 1e7], "t·m²": [1e3, 1] },
  N: { N: [1, 1], kN: [1e3, 1], MN: [1e6, 1] },
  "N·m": { "N·m": [1, 1], "kN·m": [1e3, 1], "N·cm": [1, 100], "N·mm": [1, 1e3] },
  Pa: { Pa: [1, 1], kPa: [1e3, 1], MPa: [1e6, 1], bar: [1e5, 1] },
  W: { W: [1, 1], kW: [1e3, 1] },
  J: { J: [1, 1], kJ: [1e3, 1] },
  "rad/s²": { "rad/s²": [1, 1], "°/s²": [Math.PI, 180], "deg/s²": [Math.PI, 180] },
  "m/s²": { "m/s²": [1, 1], "mm/s²": [1, 1e3] },
  "N/m": { "N/m": [1, 1], "N/mm": [1e3, 1], "kN/m": [1e3, 1] },
  "N·s/m": { "N·s/m": [1, 1], "kN·s/m": [1e3, 1] },
  "N·m/rad": { "N·m/rad": [1, 1], "N·m/°": [180, Math.PI] },
  "N·m·s/rad": { "N·m·s/rad": [1, 1] },
};

/** The key of what to say if a text is none of them; of other quantities that it is no number. */
const REFUSALS = { m: "notALength", rad: "notAnAngle", "rad/s": "notASpeed", "m/s": "notASpeed" };

const TYPED_NUMBER = /^(\d+(?:[.,]\d*)?|[.,]\d+)(e[+-]?\d+)?/i;
/** Whoever types more did not mean a quantity. */
const MOST_FACTORS = 20;
const TYPED_PI = /^(π|pi(?![a-z]))/i;

/** Write a unit as it is known here: `kg m^2` and `kgm2` are kg·m², but ms is not m·s. */
function plainUnit(text) {
  const letters = text.replaceAll("\u03bc", "µ").replaceAll("º", "°").replace(/(⁻|\^?-)[1¹]$/, "⁻¹");
  return letters.replace(/\^?2(?!\d)/g, "²").replace(/[*⋅·.\s]/g, "");
}

/** Return the unit of a quantity by what was typed; of `12 CM` too, if only one can be meant. */
function unitNamed(text, unit) {
  const known = Object.keys(UNITS[unit] ?? {});
  const own = plainUnit(text);
  const exact = known.find((name) => plainUnit(name) === own);
  if (exact !== undefined) return exact;
  const alike = known.filter((name) => plainUnit(name).toLowerCase() === own.toLowerCase());
  return alike.length === 1 ? alike[0] : undefined;
}

/** No quantity of a machine is larger, SI: beyond, squares and differences are no numbers any more. */
const LARGEST_QUANTITY = 1e15;

/**
 * Read factors: numbers and π, multiplied and divided.
 * @returns {{value: number, rest: string, hasPi: boolean, hasZero: boolean} | null} hasZero: as a divisor
 */
function readProduct(text) {
  let rest = text;
  let value = 1;
  let hasPi = false;
  let hasZero = false;
  let divides = false;
  let count = 0;
  for (;;) {
    const isPi = TYPED_PI.test(rest);
    const [own] = rest.match(isPi ? TYPED_PI : TYPED_NUMBER) ?? [];
    if (own === undefined) return null;
    const factor = isPi ? Math.PI : Number(own.replace(",", "."));
    value = divides ? value / factor : value * factor;
    hasPi ||= isPi;
    hasZero ||= divides && factor === 0;
    count += 1;
    rest = rest.slice(own.length);
    const after = rest.trimStart();
    // A sign goes on only before another factor: 1500 1/min, and 2 π without a sign.
    const sign = after.match(/^[*·×⋅/]\s*/)?.[0] ?? "";
    const next = after.slice(sign.length);
    const goesOn = sign ? TYPED_NUMBER.test(next) || TYPED_PI.test(next) : !isPi && TYPED_PI.test(next);
    if (!goesOn || count > MOST_FACTORS) break;
    divides = sign.startsWith("/");
    rest = next;
  }
  return { value, rest: rest.trim(), hasPi, hasZero };
}

/**
 * Read a quantity.
 *
 * Takes `12 cm`, `3,5 mm`, `−2`, `1e-3`, `1/3`, `30°`, `0.5 turn`, `pi/3`. Without a unit it is in the
 * one that the field shows; an angle with π is then in rad. A comma is a decimal point.
 * @param {string} text
 * @param {string} unit the SI unit of the quantity, "" of a number: the keys of UNITS
 * @param {string} [shown] the unit that the field shows
 * @returns {{value: number} | {error: string, values: Object<string, string>}} SI; or what to say,
 *   by its key: `notALength`, `notAnAngle`, `notASpeed`, `notANumber`, `emptyField`, `notAUnitHere`,
 *   `dividedByZero`, `tooLargeNumber`
 */
export function parseQuantity(text, unit, shown = unit) {
  const typed = String(text ?? "").trim();
  const refusal = (error, values = {}) => ({ error, values: { text: typed, ...values } });
  if (!typed) return refusal("emptyField");
  const plain = typed.replace(/[\u2212\u2013\u2012]/g, "-").replace(/[\u00a0\u202f\u2009]/g, " ");
  const sign = plain.match(/^[+-]\s*/)?.[0] ?? "";
  const found = readProduct(plain.slice(sign.length));
  if (!found) return refusal(REFUSALS[unit] ?? "notANumber");
  const { value, rest, hasPi, hasZero } = found;
  const own = rest ? unitNamed(rest, unit) : hasPi && unit === "rad" ? "rad" : unitNamed(shown, unit);
  const scale = UNITS[unit]?.[own];
  // What goes on like a number or a sum names no unit: 1.2.3, 2 + 3.
  if (!scale && /^[\d.,+\-/*·×]/.test(rest)) return refusal(REFUSALS[unit] ?? "notANumber");
  if (!scale) return refusal("notAUnitHere", { given: rest || shown, units: unitList(unit) });
  const number = (value * scale[0]) / scale[1];
  if (hasZero) return refusal("dividedByZero");
  if (!(Math.abs(number) <= LARGEST_QUANTITY)) return refusal("tooLargeNumber");
  return { value: sign.startsWith("-") ? -number : number };
}

/** Other names of units: they are taken, but not offered. */
const OTHER_NAMES = [
  ...["um", "deg", "turns", "deg/s", "deg/s²", "Hz", "/min", "min⁻¹", "rev/min", "U/min", "об/мин", "об/хв"],
];

/** Return the units of a quantity, for a sentence. */
export function unitList(unit) {
  return Object.keys(UNITS[unit] ?? {}).filter((name) => name && !OTHER_NAMES.includes(name)).join(", ");
}

/**
 * Write a quantity in the unit shown, without its name.
 * @param {number} value SI
 * @param {string} unit
 * @param {string} [shown]
 * @param {number} [count] significant digits; by default as many as give the same value again
 */
export function writeQuantity(value, unit, shown = unit, count = undefined) {
  const scale = UNITS[unit]?.[unitNamed(shown, unit)];
  if (!scale || !Number.isFinite(value)) return "–";
  const [factor, divisor] = scale;
  const own = (value * divisor) / factor;
  if (count !== undefined) return digits(own, count);
  let text = String(own);
  for (let n = 1; n < 17; n++) {
    const shorter = String(Number(own.toPrecision(n)));
    if ((Number(shorter) * factor) / divisor === value) {
      text = shorter;
      break;
    }
  }
  return text.replaceAll("-", "−");
}

/** Write a quantity with the name of its unit: 120 mm, 38°. */
export function writeWithUnit(value, unit, shown = unit, count = undefined) {
  const text = writeQuantity(value, unit, shown, count);
  return shown ? `${text}${/^[°%]/.test(shown) ? "" : " "}${shown}` : text;
}

/**
 * Return the unit in which the lengths of a document are shown.
 * @param {number} documentSize m
 * @returns {{name: string, factor: number}} factor: units to a metre
 */
export function usualUnit(documentSize) {
  return lengthUnit(Number.isFinite(documentSize) && documentSize > 0 ? documentSize : 0.1);
}
