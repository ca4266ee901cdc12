// How far the crank can go: where C is jammed and the support is held, it stops.

const AROUND = 2 * Math.PI;
const AT_EDGE = 1e-9;

/**
 * Return where the crank comes to.
 * @param {{start: number, end: number, side: string|null}[]} stretches of the motion
 * @param {number} from
 * @param {number} to
 * @returns {{to: number, isStopped: boolean}}
 */
export function reachable(stretches, from, to) {
  const sense = Math.sign(to - from);
  for (const { start, end, side } of stretches) {
    if (side === null) continue;
    // The interval, shifted by turns, that is met first.
    const k = sense > 0 ? Math.ceil((from - end - AT_EDGE) / AROUND) : Math.floor((from - start + AT_EDGE) / AROUND);
    const [low, high] = [start + k * AROUND, end + k * AROUND];
    const isInside = from > low - AT_EDGE && from < high + AT_EDGE;
    if (isInside) {
      // Out again the way it came in; from the middle, where it was put, either way.
      const isOut = to < low - AT_EDGE || to > high + AT_EDGE;
      const isBack = (sense > 0 && from > low + AT_EDGE) || (sense < 0 && from < high - AT_EDGE);
      const isAtEnd = sense > 0 ? from > high - AT_EDGE : from < low + AT_EDGE;
      if (isAtEnd || (isOut && isBack)) continue;
      return { to: from, isStopped: true };
    }
    const edge = sense > 0 ? low : high;
    if (sense * (edge - from) > 0 && sense * (to - edge) >= 0) return { to: edge, isStopped: true };
  }
  return { to, isStopped: false };
}
