// Plane geometry of drawings: hulls, lines, directions.

/** Points nearer to a line than this part of the link's size lie on it. */
export const ON_LINE = 1e-6;

/** Return the unit vector at an angle. */
export const unitVector = (angle) => [Math.cos(angle), Math.sin(angle)];

/** Return how far a point lies along a direction and to its left, seen from the origin. */
export function alongAndLeft([x, y], [ux, uy]) {
  return [x * ux + y * uy, y * ux - x * uy];
}

/** Return the longer side of the frame of points. */
export function extentOf(points) {
  if (!points.length) return 0;
  return Math.max(...[0, 1].map((axis) => {
    const own = points.map((point) => point[axis]);
    return Math.max(...own) - Math.min(...own);
  }));
}

/** Return the corners of the convex hull, turning left (Andrew's monotone chain). */
export function hullOf(points) {
  const near = ON_LINE * extentOf(points) ** 2;
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const half = (own) => {
    const chain = [];
    for (const point of own) {
      while (chain.length > 1 && turn(chain[chain.length - 2], chain[chain.length - 1], point) <= near) chain.pop();
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  const corners = [...half(sorted), ...half([...sorted].reverse())];
  return corners.length ? corners : sorted.slice(0, 1);
}

/** Return the point of a segment that is nearest to a place. */
export function nearestOn(place, a, b) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const square = dx * dx + dy * dy;
  const t = square ? Math.min(Math.max(((place[0] - a[0]) * dx + (place[1] - a[1]) * dy) / square, 0), 1) : 0;
  return [a[0] + t * dx, a[1] + t * dy];
}

/** Return where two lines cross, each a point and a unit vector; null if they are parallel. */
export function crossing([p, u], [q, v]) {
  const sine = u[0] * v[1] - u[1] * v[0];
  if (Math.abs(sine) < 1e-9) return null;
  const t = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / sine;
  return [p[0] + t * u[0], p[1] + t * u[1]];
}
