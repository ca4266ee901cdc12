// Numbers and lengths as they are written: three digits, a true minus, the unit that suits.

/**
 * Write a number.
 * @param {number} x
 * @param {number} [count] significant digits
 */
export function digits(x, count = 3) {
  if (!Number.isFinite(x)) return "–";
  const size = Math.abs(x);
  if (size < 1e-12) return "0";
  const text = x.toPrecision(count);
  const isPlain = size >= 1e-3 && size < 1e6;
  // toPrecision writes 1.23e+3 of 1234.
  const own = isPlain && text.includes("e") ? String(Number(text)) : text;
  return (isPlain ? own : String(Number(text))).replaceAll("-", "−");
}

/** Write a number of an axis: without zeros at its end. */
export function tickText(x) {
  return String(Number(x.toPrecision(6))).replaceAll("-", "−");
}

/** Write an angle given in rad, in degrees with one decimal at most. */
export function degrees(angle, decimals = 1) {
  const text = ((angle * 180) / Math.PI).toFixed(decimals);
  return `${Number(text)}°`.replace("-", "−");
}

/**
 * Choose the unit of lengths by the size of what is shown.
 * @param {number} size m
 * @returns {{name: string, factor: number}} factor: units to a metre
 */
export function lengthUnit(size) {
  if (size >= 1e3) return { name: "km", factor: 1e-3 };
  if (size >= 1) return { name: "m", factor: 1 };
  if (size >= 2e-4) return { name: "mm", factor: 1e3 };
  return { name: "µm", factor: 1e6 };
}

/**
 * Choose the unit of a force, a moment, a power or an energy: N, kN, MN.
 * @param {string} unit SI
 * @param {number} greatest of what is shown, SI
 * @returns {{name: string, factor: number}} factor: units to one SI unit
 */
export function forceUnit(unit, greatest) {
  const size = Math.abs(greatest);
  if (size >= 1e6) return { name: `M${unit}`, factor: 1e-6 };
  if (size >= 1e3) return { name: `k${unit}`, factor: 1e-3 };
  if (size >= 0.1 || size === 0) return { name: unit, factor: 1 };
  return { name: `m${unit}`, factor: 1e3 };
}

/** Return the greatest 1, 2 or 5 times a power of ten up to a length. */
export function niceLength(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return [5, 2, 1].map((step) => step * power).find((nice) => nice <= length * (1 + 1e-12)) ?? power;
}

/**
 * Return round numbers within a range.
 * @param {number} low
 * @param {number} high
 * @param {number} count about how many
 */
export function ticks(low, high, count) {
  if (!(high > low)) return [low];
  const step = niceLength(((high - low) / count) * 1.6);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

/** Return angles for an axis, rad: whole parts of a turn. */
export function angleTicks(low, high, count) {
  const turn = 2 * Math.PI;
  const steps = [1 / 72, 1 / 36, 1 / 24, 1 / 12, 1 / 8, 1 / 6, 1 / 4, 1 / 2, 1, 2, 5, 10];
  const step = turn * (steps.find((part) => (high - low) / (part * turn) <= count) ?? 10);
  const first = Math.ceil(low / step - 1e-6);
  const last = Math.floor(high / step + 1e-6);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}
