import assert from "node:assert/strict";
import test from "node:test";
import { Turn } from "../../python/assur/pictures/page/turn.js";
import { pointState, slideState, toLocal } from "../../python/assur/pictures/page/quantities.js";

// A link whose origin goes along (cos, sin), its angle is sin q + 2 q: all derivatives are known.
const exact = {
  value: (q) => [Math.cos(q), Math.sin(q), Math.sin(q) + 2 * q],
  d1: (q) => [-Math.sin(q), Math.cos(q), Math.cos(q) + 2],
  d2: (q) => [-Math.cos(q), -Math.sin(q), -Math.sin(q)],
};

function turnOf(q, grid, orders = 3, Array = Float64Array, scale = () => [1, 0]) {
  const flat = [];
  for (const order of ["value", "d1", "d2"].slice(0, orders)) {
    for (const own of q) {
      const [du, d2u] = scale(own);
      exact[order](own).forEach((number, i) => {
        if (order === "value") flat.push(number);
        if (order === "d1") flat.push(number * du);
        if (order === "d2") flat.push(number * du * du + exact.d1(own)[i] * d2u);
      });
    }
  }
  return new Turn({ grid, closes: false, rows: q.length, orders, values: Array.from(flat) });
}

const even = (low, high, n) => globalThis.Array.from({ length: n }, (_, i) => low + ((high - low) * i) / (n - 1));
const TURN = 2 * Math.PI;
const linear = (orders, Array) => turnOf(even(0, TURN, 181), { kind: "linear", low: 0, high: TURN }, orders, Array);

function greatestError(turn, order, places) {
  let greatest = 0;
  for (const q of places) {
    const pose = turn.sample(q);
    exact[order](pose.q).forEach((number, i) => {
      greatest = Math.max(greatest, Math.abs(pose[order][3 + i] - number));
    });
  }
  return greatest;
}

test("between rows of 2° a quintic is as good as the numbers", () => {
  const turn = linear(3, Float64Array);
  const places = even(0.001, 6.28, 777);
  assert.ok(greatestError(turn, "value", places) < 1e-12);
  assert.ok(greatestError(turn, "d1", places) < 1e-8);
  assert.ok(greatestError(turn, "d2", places) < 3e-6);
});

test("with value and first derivative alone a cubic is true to 5e-8 of the size, as while dragging", () => {
  const turn = linear(2, Float64Array);
  const places = even(0.001, 6.28, 777);
  assert.ok(greatestError(turn, "value", places) < 5e-8);
  assert.ok(greatestError(turn, "d1", places) < 1e-6);
  assert.ok(greatestError(turn, "d2", places) < 3e-4);
});

test("numbers of single precision stay such: derivatives are not those of rounded values", () => {
  const turn = linear(3, Float32Array);
  const places = even(0.001, 6.28, 777);
  assert.ok(greatestError(turn, "value", places) < 1e-6);
  assert.ok(greatestError(turn, "d1", places) < 3e-7);
  assert.ok(greatestError(turn, "d2", places) < 2e-5);
});

test("rows that are dense at dead points give the derivatives by q", () => {
  const [middle, half, low, high] = [1, 1.5, 0.002, Math.PI - 0.002];
  const u = even(low, high, 181);
  const q = u.map((own) => middle - half * Math.cos(own));
  const by = (own) => {
    const angle = Math.acos((middle - own) / half);
    return [half * Math.sin(angle), half * Math.cos(angle)];
  };
  const turn = turnOf(q, { kind: "cosine", middle, half, low, high }, 3, Float64Array, by);
  assert.ok(Math.abs(turn.low - q[0]) < 1e-12 && Math.abs(turn.high - q[180]) < 1e-12);
  const places = even(-0.45, 2.45, 333);
  assert.ok(greatestError(turn, "value", places) < 1e-11);
  assert.ok(greatestError(turn, "d1", places) < 1e-7);
  assert.ok(greatestError(turn, "d2", places) < 3e-5);
});

test("rows at any coordinates are met exactly and lie between", () => {
  const q = [0, 0.03, 0.05, 0.09, 0.1];
  const turn = turnOf(q, { kind: "rows", q });
  for (const own of q) assert.ok(greatestError(turn, "d2", [own]) < 1e-12);
  assert.ok(greatestError(turn, "value", even(0, 0.1, 57)) < 1e-11);
});

test("a closed turn goes around, a bounded one ends", () => {
  const turn = linear(3, Float64Array);
  assert.equal(turn.bring(7), TURN);
  turn.closes = true;
  assert.ok(Math.abs(turn.bring(7) - (7 - TURN)) < 1e-12);
  assert.ok(Math.abs(turn.bring(-0.5) - (TURN - 0.5)) < 1e-12);
  assert.equal(turn.bring(1), 1);
});

test("a row without a position leaves a gap of two cells", () => {
  const turn = linear(3, Float64Array);
  turn.values[90 * 3] = NaN;
  const known = [88.5, 89.5, 90, 90.5, 91.5].map((row) => turn.sample((row * TURN) / 180).known);
  assert.deepEqual(known, [true, false, false, false, true]);
});

test("of some links alone nothing else is touched", () => {
  const turn = linear(3, Float64Array);
  const whole = turn.sample(1.2345);
  const own = turn.sample(1.2345, turn.pose(), [0, 1]);
  for (const key of ["q", "known", "value", "d1", "d2"]) assert.deepEqual(own[key], whole[key]);
  const none = turn.sample(1.2345, turn.pose(), [0]);
  assert.deepEqual([...none.value.slice(3)], [0, 0, 0]);
});

test("the ground has its own frame", () => {
  const values = new Float64Array(9 * 2);
  const turn = new Turn({ grid: { kind: "linear", low: 0, high: 1 }, closes: false, rows: 2, orders: 3, values, ground: [1, 2, 0.5] });
  assert.deepEqual([...turn.sample(0.3).value.slice(0, 3)], [1, 2, 0.5]);
});

test("velocity and acceleration of a point are those of differences", () => {
  const turn = linear(3, Float64Array);
  const at = [0.7, -0.4];
  const place = (q) => pointState(turn.sample(q), 1, at);
  const h = 1e-4;
  for (const q of [0.4, 2.2, 5.1]) {
    const [before, now, after] = [place(q - h), place(q), place(q + h)];
    for (const axis of ["x", "y"]) {
      assert.ok(Math.abs((after[axis] - before[axis]) / (2 * h) - now[`${axis}1`]) < 1e-6);
      assert.ok(Math.abs((after[`${axis}1`] - before[`${axis}1`]) / (2 * h) - now[`${axis}2`]) < 1e-4);
    }
    const [x, y] = toLocal(turn.sample(q), 1, now.x, now.y);
    assert.ok(Math.hypot(x - at[0], y - at[1]) < 1e-12);
  }
});

test("a slide is a projection, with the rates of differences", () => {
  // The guide turns with the link, the point stands on the ground.
  const slide = { link: 0, on: 1, at: [2, 3], origin: [0.1, 0.2], angle: 0.6, offset: 0.25 };
  const turn = linear(3, Float64Array);
  const state = (q) => slideState(turn.sample(q), slide);
  const h = 1e-4;
  for (const q of [0.4, 2.2, 5.1]) {
    const [before, now, after] = [state(q - h), state(q), state(q + h)];
    assert.ok(Math.abs((after[0] - before[0]) / (2 * h) - now[1]) < 1e-6);
    assert.ok(Math.abs((after[1] - before[1]) / (2 * h) - now[2]) < 1e-4);
    const [x, y, angle] = exact.value(q);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const along = [Math.cos(angle + 0.6), Math.sin(angle + 0.6)];
    const origin = [x + c * 0.1 - s * 0.2, y + s * 0.1 + c * 0.2];
    assert.ok(Math.abs((2 - origin[0]) * along[0] + (3 - origin[1]) * along[1] - 0.25 - now[0]) < 1e-10);
  }
});
