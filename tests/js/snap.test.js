import assert from "node:assert/strict";
import test from "node:test";
import { crossing, hullOf, nearestOn } from "../../python/assur/studio/page/document/plane.js";
import { gridStep, snapped } from "../../python/assur/studio/page/document/snap.js";

const DOCUMENT = {
  joints: { A: [0, 0], B: [0, 1], C: [3, 2], P: [1, 3], D: [4, 0], Z: ["x", 1] },
  links: { ground: ["A", "D"], crank: ["A", "B"], coupler: ["B", "C", "P"], rocker: ["D", "C"], stub: ["D"], bad: null },
};
/** 100 px to a metre: 13 px are 0.13 m. */
const base = { document: DOCUMENT, scale: 100 };

test("a joint catches within 13 px, before a link does", () => {
  assert.deepEqual(snapped([3.09, 2.09], base), { at: [3, 2], joint: "C" });
  assert.equal(snapped([3.1, 2.1], base).joint, undefined);
  assert.deepEqual(snapped([0.05, 0.9], base), { at: [0, 1], joint: "B" });
  assert.equal(snapped([3.09, 2.09], { ...base, exclude: ["C"] }).joint, undefined);
  // The nearer one of two.
  const two = { joints: { A: [0, 0], B: [0.1, 0] } };
  assert.equal(snapped([0.06, 0], { document: two, scale: 100 }).joint, "B");
  assert.equal(snapped([0, 1.5], { ...base, places: { C: [0.05, 1.5] } }).joint, "C");
});

test("a link's line catches within 10 px, but not one that is dragged", () => {
  assert.deepEqual(snapped([0.09, 0.5], base), { at: [0, 0.5], link: "crank" });
  assert.equal(snapped([0.11, 0.5], base).link, undefined);
  const [x, y] = snapped([3.5, 1.05], base).at;
  assert.ok(Math.abs((x - 4) * 2 - y * -1) < 1e-12 && snapped([3.5, 1.05], base).link === "rocker");
  assert.equal(snapped([0.09, 0.5], { ...base, exclude: ["B"] }).link, undefined);
  assert.equal(snapped([0.09, 0.5], { ...base, exclude: ["crank"] }).link, undefined);
  // All three sides of a plate; not between the joints of the ground.
  for (const [a, b] of [["B", "C"], ["C", "P"], ["P", "B"]]) {
    const middle = [0, 1].map((i) => (DOCUMENT.joints[a][i] + DOCUMENT.joints[b][i]) / 2);
    assert.equal(snapped(middle, base).link, "coupler");
  }
  assert.deepEqual(snapped([2, 0.01], base), { at: [2, 0] });
});

test("the grid is 1, 2 or 5 times a power of ten, about 20 px", () => {
  for (let k = -60; k < 60; k++) {
    const scale = 10 ** (k / 10);
    const step = gridStep(scale);
    assert.ok(step * scale > 11 && step * scale <= 28.001, `${step * scale} px`);
    assert.ok([1, 2, 5].includes(Number(String((step / 10 ** Math.floor(Math.log10(step * 1.0001))).toPrecision(6)))));
  }
  assert.deepEqual(snapped([5.34, 6.71], base), { at: [5.4, 6.8] });
  assert.deepEqual(snapped([-0.31, -5.29], base), { at: [-0.4, -5.2] });
  assert.deepEqual(snapped([5, 5], { document: {}, scale: 100 }), { at: [5, 5] });
});

test("with Shift a point stays on x, y or a link's line", () => {
  const from = [3, 2];
  const along = (place, more = {}) => snapped(place, { ...base, shift: true, from, exclude: ["C"], ...more });
  assert.deepEqual(along([5.01, 2.07]), { at: [5, 2], guide: { from, along: [1, 0] } });
  assert.deepEqual(along([3.1, 4.99]), { at: [3, 5], guide: { from, along: [0, 1] } });
  const line = along([2.5, 3.05]);
  assert.ok(Math.abs((line.at[1] - 2) / (line.at[0] - 3) + 2) < 1e-12, String(line.at));
  assert.deepEqual(along([1.06, 2.96]).joint, "P");
  // A joint beside the line does not catch, one on it does.
  assert.equal(along([4.01, 2.02], { document: { ...DOCUMENT, joints: { ...DOCUMENT.joints, Q: [4, 2.05] } } }).joint, undefined);
  assert.equal(along([4.01, 2.02], { document: { ...DOCUMENT, joints: { ...DOCUMENT.joints, Q: [4, 2] } } }).joint, "Q");
  assert.deepEqual(snapped([5.01, 2.07], { ...base, shift: true }), { at: [5, 2] });
});

test("with Alt nothing catches", () => {
  assert.deepEqual(snapped([3.001, 2.001], { ...base, alt: true, shift: true, from: [0, 0] }), { at: [3.001, 2.001] });
  assert.deepEqual(snapped([1, 2], { document: {}, scale: NaN }), { at: [1, 2] });
});

test("plane geometry", () => {
  assert.deepEqual(hullOf([[0, 0], [2, 0], [1, 0.5], [2, 2], [0, 2], [1, 0]]), [[0, 0], [2, 0], [2, 2], [0, 2]]);
  assert.deepEqual(hullOf([[0, 0], [2, 2], [1, 1]]), [[0, 0], [2, 2]]);
  assert.deepEqual([hullOf([[1, 1]]), hullOf([])], [[[1, 1]], []]);
  assert.deepEqual(nearestOn([5, 1], [0, 0], [2, 0]), [2, 0]);
  assert.deepEqual(nearestOn([5, 1], [2, 0], [2, 0]), [2, 0]);
  assert.deepEqual(crossing([[0, 1], [1, 0]], [[2, 5], [0, 1]]), [2, 1]);
  assert.equal(crossing([[0, 1], [1, 0]], [[2, 5], [1, 0]]), null);
});
