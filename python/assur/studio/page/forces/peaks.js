// What is large of numbers along a turn: a press has peaks; toward a dead point there is no greatest.

/** So many times the usual magnitude is more than a peak, and so many times it is shown then. */
const MORE_THAN_PEAK = 1000;
const MOST_PEAK = 50;
const PEAK_USUAL = 0.9;

/** Whether a number is one that grows without limit, by what is shown of them. */
export const withoutLimit = (value, most) => Math.abs(value) * MOST_PEAK > MORE_THAN_PEAK * most && most > 0;

/**
 * Return the greatest magnitude, or of numbers without limit what of them is shown.
 * @param {Iterable<number>} values
 * @param {boolean} closes whether the motion goes round: then there is no dead point
 * @returns {{most: number, isUnbounded: boolean}}
 */
export function peakOf(values, closes) {
  const sizes = Array.from(values, Math.abs).filter(Number.isFinite).sort((a, b) => a - b);
  const greatest = sizes.at(-1) ?? 0;
  const usual = sizes[Math.floor(PEAK_USUAL * sizes.length)] ?? 0;
  const isUnbounded = !closes && usual > 0 && greatest > MORE_THAN_PEAK * usual;
  return { most: isUnbounded ? MOST_PEAK * usual : greatest, isUnbounded };
}
