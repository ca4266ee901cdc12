// Speeds of the driver as people type them.

export const PER_MINUTE = [Math.PI, 30];
/** Units of speeds by the SI unit: how many SI units one is, as [factor, divisor]. */
export const SPEEDS = {
  "rad/s": {
    ...{ "rad/s": [1, 1], rpm: PER_MINUTE, "1/min": PER_MINUTE, "°/s": [Math.PI, 180], "rev/s": [2 * Math.PI, 1] },
    ...{ Hz: [2 * Math.PI, 1], "/min": PER_MINUTE },
  },
  "m/s": { "m/s": [1, 1], "mm/s": [1, 1e3], "cm/s": [1, 100], "m/min": [1, 60] },
};

/**
 * Read a speed: a number, with a unit or in the usual one. A comma is a decimal point.
 * @param {string} text
 * @param {string} unit the SI unit
 * @returns {{value: number} | {error: string, values: Object}} what to say, by its key
 */
export function readSpeed(text, unit) {
  const [, number, name] = text.replace(/[−–]/g, "-").replace(",", ".").match(/^\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*(.*?)\s*$/i) ?? [];
  const own = Object.keys(SPEEDS[unit]).find((one) => one.toLowerCase() === (name || unit).toLowerCase());
  const [factor, divisor] = SPEEDS[unit][own] ?? [];
  const value = (Number(number) * factor) / divisor;
  return Number.isFinite(value) ? { value } : { error: "notASpeed", values: { text: text.trim() } };
}
