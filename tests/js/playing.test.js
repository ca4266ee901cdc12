import assert from "node:assert/strict";
import test from "node:test";
import { chartRange, extremes } from "../../python/assur/pictures/page/chart.js";
import { fromSegment, isInside, nearestCoordinate } from "../../python/assur/pictures/page/drag.js";
import { angleTicks, degrees, digits, lengthUnit, niceLength, ticks } from "../../python/assur/pictures/page/numbers.js";
import { Player, slowness } from "../../python/assur/pictures/page/player.js";
import { Turn } from "../../python/assur/pictures/page/turn.js";
import { say } from "../../python/assur/pictures/page/words.js";

const TURN = 2 * Math.PI;

/** A crank about the origin, over a turn or from low to high. */
function crank(low = 0, high = TURN, closes = true) {
  const rows = 181;
  const q = Array.from({ length: rows }, (_, i) => low + ((high - low) * i) / (rows - 1));
  const values = Float64Array.from([...q.flatMap((own) => [0, 0, own]), ...q.flatMap(() => [0, 0, 1]), ...q.flatMap(() => [0, 0, 0])]);
  return new Turn({ grid: { kind: "linear", low, high }, closes, rows, orders: 3, values });
}

test("a gripped crank points at the pointer, around and around", () => {
  const turn = crank();
  let q = 0;
  for (let degree = 0; degree <= 800; degree += 7) {
    const angle = (degree * Math.PI) / 180;
    q = nearestCoordinate(turn, 1, [1, 0], [3 * Math.cos(angle), 3 * Math.sin(angle)], q);
    const error = Math.abs(Math.sin((q - angle) / 2));
    assert.ok(error < 1e-6, `${degree}: ${q}`);
  }
});

test("a bounded crank stops at its end", () => {
  const turn = crank(-1, 1, false);
  const q = nearestCoordinate(turn, 1, [1, 0], [Math.cos(2), Math.sin(2)], 0.3);
  assert.ok(Math.abs(q - 1) < 1e-6);
});

test("of two equal ways it goes on as before", () => {
  // A point that comes back along its own path: x = cos q, seen from its end.
  const rows = 181;
  const q = Array.from({ length: rows }, (_, i) => (TURN * i) / (rows - 1));
  const d = [(a) => Math.cos(a), (a) => -Math.sin(a), (a) => -Math.cos(a)];
  const values = Float64Array.from(d.flatMap((f) => q.flatMap((own) => [f(own), 0, 0])));
  const turn = new Turn({ grid: { kind: "linear", low: 0, high: TURN }, closes: true, rows, orders: 3, values });
  const on = nearestCoordinate(turn, 1, [0, 0], [-0.5, 0], Math.PI, 1);
  const back = nearestCoordinate(turn, 1, [0, 0], [-0.5, 0], Math.PI, -1);
  assert.ok(Math.abs(on - (4 * Math.PI) / 3) < 1e-6 && Math.abs(back - (2 * Math.PI) / 3) < 1e-6);
});

test("the clock turns at the speed given, around", () => {
  const player = new Player(crank(), () => {}, { request: () => 1, cancel: () => {} });
  player.speed = 2;
  player.q = 6;
  player.advance(0.5);
  assert.ok(Math.abs(player.q - (7 - TURN)) < 1e-12 && player.turns === 1);
});

test("between dead points it plays to and fro", () => {
  const player = new Player(crank(-1, 1, false), () => {}, { request: () => 1, cancel: () => {} });
  player.speed = 0.5;
  player.q = 0.9;
  player.advance(0.6);
  assert.ok(Math.abs(player.q - 0.8) < 1e-12 && player.sense === -1);
  player.advance(3.8);
  assert.ok(Math.abs(player.q + 0.9) < 1e-12 && player.sense === 1);
});

test("frames come from the clock, and pausing ends them", () => {
  let frame = null;
  const shown = [];
  const clock = { request: (f) => ((frame = f), 1), cancel: () => (frame = null) };
  const player = new Player(crank(), (q) => shown.push(q), clock);
  player.speed = 1;
  player.play();
  frame(1000);
  frame(1050);
  // After a pause of the browser nothing jumps.
  frame(9000);
  assert.ok(Math.abs(shown[1] - 0.05) < 1e-12 && Math.abs(shown[2] - 0.15) < 1e-12);
  player.pause();
  assert.ok(frame === null && !player.isPlaying);
});

test("what is too quick for the eye is played slower by 2, 5, 10", () => {
  assert.equal(slowness(TURN, 1), 1);
  assert.equal(slowness(TURN, 3.9), 1);
  assert.equal(slowness(TURN, 10), 5);
  assert.equal(slowness(TURN, 150), 50);
  assert.equal(slowness(1, 0), 1);
});

test("three digits, a true minus, degrees", () => {
  const texts = [[1234, "1230"], [-0.012345, "−0.0123"], [0, "0"], [66.81, "66.8"], [NaN, "–"], [5.7912e5, "579000"], [1.5e-7, "1.5e−7"], [9.999, "10.0"]];
  for (const [x, text] of texts) assert.equal(digits(x), text);
  assert.equal(degrees(-Math.PI / 3), "−60°");
  assert.equal(degrees(1.23456), "70.7°");
});

test("ticks are round and within the range", () => {
  assert.deepEqual(ticks(-1.1, 2.3, 4).map((x) => Number(x.toFixed(9))), [-1, 0, 1, 2]);
  assert.deepEqual(angleTicks(0, TURN, 8).map((x) => Math.round((x * 180) / Math.PI)), [0, 45, 90, 135, 180, 225, 270, 315, 360]);
  assert.ok(angleTicks(-1.68, 1.68, 6).every((x) => x >= -1.69 && x <= 1.69));
  assert.equal(niceLength(0.037), 0.02);
  assert.deepEqual(lengthUnit(0.15), { name: "mm", factor: 1e3 });
});

test("the range of a diagram leaves out what is infinite at a dead point", () => {
  const places = Array.from({ length: 361 }, (_, i) => 1 - Math.cos(0.002 + (i / 360) * (Math.PI - 0.004)));
  const values = places.map((q) => 1 / Math.sqrt(q * (2 - q)));
  const { low, high, isCut } = chartRange(values, places, 1, 150);
  assert.ok(isCut && high < 30 && low < 1);
  const plain = chartRange(places, places, 1, 150);
  assert.ok(!plain.isCut && plain.low < 0 && plain.high > 2 && plain.high < 3);
  const still = chartRange(places.map((_, i) => 5 + 1e-7 * Math.sin(i)), places, 1, 150);
  assert.ok(still.isConstant && still.high - still.low > 1);
});

test("extremes", () => {
  assert.deepEqual(extremes([3, NaN, 1, 7, 2]), [2, 3]);
  assert.deepEqual(extremes([NaN]), []);
});

test("what is under the pointer", () => {
  assert.equal(fromSegment(5, 3, [0, 0], [10, 0]), 3);
  assert.equal(fromSegment(-3, 4, [0, 0], [10, 0]), 5);
  const square = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]];
  assert.ok(isInside(1, 2, square) && !isInside(5, 2, square));
});

test("words come in a language, with their values", () => {
  assert.equal(say("turn", { n: 3 }), "turn 3");
});
