// How far a path passes from a target path: at each place of the target the distance to the path.

/**
 * A path that one wants, m.
 * @typedef {{points: number[][], closed: boolean}} Target
 */

/** Return the places of a line, closed by its first. */
function closedLine({ points, closed }) {
  return closed && points.length > 2 ? [...points, points[0]] : points;
}

/**
 * Return n + 1 places at even steps along a line.
 * @param {number[][]} line
 * @param {number} n
 */
export function evenPlaces(line, n) {
  const along = [0];
  for (let i = 1; i < line.length; i++) {
    along.push(along[i - 1] + Math.hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]));
  }
  const length = along.at(-1);
  if (!length) return [line[0]];
  let i = 1;
  return Array.from({ length: n + 1 }, (_, k) => {
    const own = (k / n) * length;
    while (i < line.length - 1 && along[i] < own) i++;
    const part = Math.min((own - along[i - 1]) / (along[i] - along[i - 1] || 1), 1);
    return [0, 1].map((c) => line[i - 1][c] + part * (line[i][c] - line[i - 1][c]));
  });
}

/** Return the place of a segment next to a point. */
function nearestOnSegment([x, y], [ax, ay], [bx, by]) {
  const dx = bx - ax;
  const dy = by - ay;
  const length2 = dx * dx + dy * dy;
  const t = length2 ? Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / length2, 0), 1) : 0;
  return [ax + t * dx, ay + t * dy];
}

/**
 * Return how far a path passes from a target.
 * @param {Target} target
 * @param {number[][][]} lines of the path, m: it is broken where there is no position
 * @param {number} [n] places of the target that are measured
 * @returns {{greatest: number, rms: number, from: number[], to: number[]} | null} m; where it is
 *   farthest, and the place of the path that is nearest there; null without a path
 */
export function deviationFrom(target, lines, n = 240) {
  const places = evenPlaces(closedLine(target), n);
  let greatest = -1;
  let sum = 0;
  let from = null;
  let to = null;
  for (const place of places) {
    let least = Infinity;
    let nearest = null;
    for (const line of lines) {
      for (let i = 0; i < line.length; i++) {
        const [x, y] = nearestOnSegment(place, line[Math.max(i - 1, 0)], line[i]);
        const distance = Math.hypot(place[0] - x, place[1] - y);
        if (distance < least) {
          least = distance;
          nearest = [x, y];
        }
      }
    }
    if (!nearest) return null;
    sum += least * least;
    if (least > greatest) {
      greatest = least;
      from = place;
      to = nearest;
    }
  }
  return { greatest, rms: Math.sqrt(sum / places.length), from, to };
}

/**
 * Make a target of places drawn by hand.
 * @param {number[][]} drawn m
 * @param {number} spacing places nearer to the one before are left out, m
 * @param {number} closing ends so near to each other are joined, m
 * @returns {Target | null} null of less than two places
 */
export function targetOf(drawn, spacing, closing) {
  const points = [];
  for (const [x, y] of drawn) {
    const last = points.at(-1);
    if (!last || Math.hypot(x - last[0], y - last[1]) >= spacing) points.push([x, y]);
  }
  if (points.length < 2) return null;
  const [first, last] = [points[0], points.at(-1)];
  const closed = points.length > 3 && Math.hypot(last[0] - first[0], last[1] - first[1]) <= closing;
  return { points, closed };
}
