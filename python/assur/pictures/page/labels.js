// Places of names: of sixteen about a point the one farthest from lines and other names, kept
// until another is better by much, so that names do not jump.

const PLACES = 16;
/** Beyond this distance nothing is better for being farther, px. */
const ENOUGH = 14;
/** What a place that is not above and right of its point loses, px. */
const HABIT = 1.5;
/** So much better another place must be, px. */
const KEEP = 6;
/** Between the symbol and the box, px. */
const REACH = 3;

const DIRECTIONS = Array.from({ length: PLACES }, (_, i) => {
  const angle = (i * 2 * Math.PI) / PLACES - Math.PI / 4;
  return [Math.cos(angle), Math.sin(angle)];
});
const HABITS = DIRECTIONS.map(([x, y]) => (HABIT * (1 - (x - y) / Math.SQRT2)) / 2);

/**
 * @typedef {Object} Label
 * @property {number} x px, what it names
 * @property {number} y
 * @property {number} width of its text
 * @property {number} height
 * @property {number} radius of the symbol at the point
 * @property {number} [place] which of the sixteen it had
 */

/**
 * Return the distance of a box from a segment, negative if it crosses or lies inside: that of the
 * box's middle from the segment grown by the box, along the axis that separates best.
 */
export function clearance(cx, cy, hx, hy, [ax, ay], [bx, by]) {
  ax -= cx;
  ay -= cy;
  bx -= cx;
  by -= cy;
  // Apart along x, along y, or across the segment (separating axes).
  const alongX = Math.max(Math.min(ax, bx) - hx, -hx - Math.max(ax, bx));
  const alongY = Math.max(Math.min(ay, by) - hy, -hy - Math.max(ay, by));
  const length = Math.hypot(bx - ax, by - ay);
  let across = -Infinity;
  if (length > 1e-9) {
    const nx = (ay - by) / length;
    const ny = (bx - ax) / length;
    across = Math.abs(ax * nx + ay * ny) - hx * Math.abs(nx) - hy * Math.abs(ny);
  }
  return Math.max(alongX, alongY, across);
}

/** Return the distance of two boxes. */
function apart(cx, cy, hx, hy, x, y, rx, ry) {
  return Math.max(Math.abs(cx - x) - hx - rx, Math.abs(cy - y) - hy - ry);
}

/**
 * Place labels; each one's `place` is set.
 * @param {Label[]} labels
 * @param {number[][][]} lines polylines to keep clear of, px
 * @param {{low: number[], high: number[]}} bounds corners of what is seen, px
 * @returns {{x: number, y: number}[]} middles of the boxes
 */
export function placeLabels(labels, lines, bounds) {
  const taken = [];
  const segments = [];
  for (const line of lines) {
    for (let i = 1; i < line.length; i++) segments.push([line[i - 1], line[i]]);
  }
  return labels.map((label) => {
    const hx = label.width / 2;
    const hy = label.height / 2;
    const gap = label.radius + REACH;
    const far = gap + 2 * Math.max(hx, hy) + ENOUGH;
    const isNear = ({ x, y }, rx, ry) => Math.abs(x - label.x) < far + rx && Math.abs(y - label.y) < far + ry;
    const near = segments.filter(
      ([a, b]) =>
        Math.min(a[0], b[0]) < label.x + far && Math.max(a[0], b[0]) > label.x - far &&
        Math.min(a[1], b[1]) < label.y + far && Math.max(a[1], b[1]) > label.y - far,
    );
    const others = labels.filter((other) => other !== label && isNear(other, other.radius, other.radius));
    const boxes = taken.filter((other) => isNear(other, other.hx, other.hy));
    const score = (place) => {
      const [dx, dy] = DIRECTIONS[place];
      const away = gap + Math.abs(dx) * hx + Math.abs(dy) * hy;
      const x = label.x + dx * away;
      const y = label.y + dy * away;
      let free = Math.min(
        x - hx - bounds.low[0], y - hy - bounds.low[1],
        bounds.high[0] - x - hx, bounds.high[1] - y - hy, ENOUGH,
      );
      for (const [a, b] of near) free = Math.min(free, clearance(x, y, hx, hy, a, b));
      for (const other of boxes) free = Math.min(free, apart(x, y, hx, hy, other.x, other.y, other.hx, other.hy));
      for (const other of others) free = Math.min(free, apart(x, y, hx, hy, other.x, other.y, other.radius, other.radius));
      return { x, y, hx, hy, free: free - HABITS[place], place };
    };
    let best = label.place === undefined ? null : score(label.place);
    // A place with all room needs no search.
    if (!best || best.free < ENOUGH - HABIT - KEEP) {
      const kept = best;
      for (let place = 0; place < PLACES; place++) {
        const other = score(place);
        if (!best || other.free > best.free) best = other;
      }
      if (kept && best.free < kept.free + KEEP && kept.free > 0) best = kept;
    }
    label.place = best.place;
    taken.push(best);
    return best;
  });
}
