import assert from "node:assert/strict";
import test from "node:test";
import { hatchedArea, hatchedLine, placed } from "../../python/assur/pictures/page/draw.js";
import { clearance, placeLabels } from "../../python/assur/pictures/page/labels.js";
import { View } from "../../python/assur/pictures/page/view.js";
import { arcPath } from "../../python/assur/pictures/page/dial.js";

/** A generator of numbers that are the same in every run (mulberry32). */
function random(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const bounds = { low: [0, 0], high: [800, 600] };
const boxOf = (label, middle) => [middle.x - label.width / 2, middle.y - label.height / 2, middle.x + label.width / 2, middle.y + label.height / 2];
const meet = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

test("names keep clear of lines, of each other, and within the picture", () => {
  const next = random(7);
  let overlaps = 0;
  let count = 0;
  for (let trial = 0; trial < 40; trial++) {
    const points = Array.from({ length: 8 }, () => [40 + 720 * next(), 40 + 520 * next()]);
    const labels = points.map(([x, y]) => ({ x, y, width: 16, height: 17, radius: 5 }));
    const lines = points.slice(1).map((point, i) => [points[i], point]);
    const middles = placeLabels(labels, lines, bounds);
    labels.forEach((label, i) => {
      count += 1;
      const box = boxOf(label, middles[i]);
      assert.ok(box[0] >= 0 && box[1] >= 0 && box[2] <= 800 && box[3] <= 600);
      const others = labels.some((other, k) => k > i && meet(box, boxOf(other, middles[k])));
      const crossed = lines.some(([a, b]) => clearance(middles[i].x, middles[i].y, 8, 8.5, a, b) < 0);
      if (others || crossed) overlaps += 1;
    });
  }
  assert.ok(overlaps <= 0.02 * count, `${overlaps} of ${count}`);
});

test("a name stays where it is while that is nearly as good", () => {
  const label = { x: 300, y: 300, width: 16, height: 17, radius: 5 };
  const bar = (angle) => [[[300, 300], [300 + 200 * Math.cos(angle), 300 + 200 * Math.sin(angle)]]];
  const places = new Set();
  let changes = 0;
  for (let degree = 0; degree <= 360; degree += 2) {
    const before = label.place;
    placeLabels([label], bar((degree * Math.PI) / 180), bounds);
    if (before !== undefined && before !== label.place) changes += 1;
    places.add(label.place);
  }
  // Once around the bar pushes it away now and then, not at every step.
  assert.ok(changes >= 1 && changes <= 8, String(changes));
});

test("the distance of a box from a segment", () => {
  assert.equal(clearance(0, 0, 2, 1, [5, -9], [5, 9]), 3);
  assert.equal(clearance(0, 0, 2, 1, [-9, 4], [9, 4]), 3);
  assert.ok(clearance(0, 0, 2, 1, [-9, 0.5], [9, 0.5]) < 0);
  assert.ok(clearance(0, 0, 2, 1, [0.1, 0], [0.2, 0]) < 0);
  // Across a corner: the line x + y = 4 is (4 − 3)/√2 from the corner (2, 1).
  assert.ok(Math.abs(clearance(0, 0, 2, 1, [-6, 10], [10, -6]) - Math.SQRT1_2) < 1e-12);
});

test("hatching lies on the right of its line and within its ends", () => {
  // Right of a line to the right is down, where y grows.
  const strokes = hatchedLine([0, 0], [30, 0], 6, 7);
  assert.equal(strokes.length, 5);
  for (const [foot, end] of strokes) {
    assert.equal(foot[1], 0);
    assert.ok(end[1] > 0 && end[1] <= 7 && end[0] >= 0 && end[0] < foot[0]);
  }
});

test("strokes of a plate end on its outline", () => {
  const corners = [[0, 0], [100, 0], [50, 80]];
  const strokes = hatchedArea(corners, 9);
  assert.ok(strokes.length > 5);
  const onEdge = ([x, y]) =>
    corners.some(([ax, ay], i) => {
      const [bx, by] = corners[(i + 1) % 3];
      return Math.abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) < 1e-6 * 100;
    });
  for (const stroke of strokes) assert.ok(stroke.every(onEdge));
});

test("symbols have px of the view, places those of the zoom", () => {
  assert.deepEqual(placed([1, 2, 3, 4], 10, 0.5), [[11.5, -22]]);
});

test("zoom keeps the point under the pointer, fit shows all", () => {
  const view = new View();
  view.resize(800, 600);
  view.fit([-1, -2, 3, 2], { left: 40, right: 40, top: 40, bottom: 80 });
  const corners = [view.px(-1, -2), view.px(3, 2)];
  for (const [x, y] of corners) assert.ok(x >= 40 - 1e-9 && x <= 760 + 1e-9 && y >= 40 - 1e-9 && y <= 520 + 1e-9);
  const before = view.m(123, 456);
  view.zoom(123, 456, 1.7);
  assert.ok(Math.hypot(view.m(123, 456)[0] - before[0], view.m(123, 456)[1] - before[1]) < 1e-12);
  view.zoom(0, 0, 1e9);
  assert.equal(view.scale, 60 * view.fitted);
  assert.equal(view.density(1e9), 1);
  assert.equal(view.density(0), 0.6);
});

test("arcs go counter-clockwise; a whole one is two", () => {
  assert.equal(arcPath(52, 0, Math.PI / 2), "M130.00 78.00A52 52 0 0 0 78.00 26.00");
  assert.equal(arcPath(52, 0, 2 * Math.PI).match(/A/g).length, 2);
});
