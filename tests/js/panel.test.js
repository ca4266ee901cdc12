import assert from "node:assert/strict";
import test from "node:test";
import { concernedBy, dimensionLabel, givenDimensions, groupDimensions, withDimension } from "../../python/assur/studio/page/panel/dimensions_of.js";
import { driverList } from "../../python/assur/studio/page/panel/drivers.js";
import { outputsOf, perUnit, rangesOf, signed, usualOutput } from "../../python/assur/studio/page/panel/outputs.js";
import { intervalAt, reachText } from "../../python/assur/studio/page/panel/reach.js";
import { blocks, skeleton } from "../../python/assur/studio/page/panel/skeleton.js";
import { fieldText, panelLength, stepped } from "../../python/assur/studio/page/panel/steps.js";
import { poorest } from "../../python/assur/studio/page/panel/transmission.js";
import { PANEL_WORDS } from "../../python/assur/studio/page/words/panel.js";
import { Turn } from "../../python/assur/pictures/page/turn.js";
import { learn } from "../../python/assur/pictures/page/words.js";

learn(PANEL_WORDS);

const CRANE = {
  driver: ["bore", "arm"],
  joints: { A: [0, 0], B: [0, 1], C: [3, 1], D: [3, 0], P: [1, 3] },
  links: { ground: ["A", "D"], crank: ["A", "B"], coupler: ["B", "C", "P"], block: ["C"] },
  slides: { rail: { link: "block", on: "ground", angle: 0.5 }, bore: { base: "A", end: "P", barrel: "tube" } },
};
const of = (name, unit = "m") => ({ name, value: 1, unit });

test("lengths come first, then pivots, corners, angles and slides", () => {
  const names = ["rail.offset", "ground.D.x", "coupler.P.x", "rail.angle", "crank.length", "bore.offset", "coupler.length"];
  const groups = groupDimensions(names.map((name) => of(name)), CRANE);
  const found = groups.map(({ key, dimensions }) => [key, dimensions.map((one) => one.name)]);
  assert.deepEqual(found, [
    ["lengths", ["crank.length", "coupler.length"]],
    ["pivots", ["ground.D.x"]],
    ["corners", ["coupler.P.x"]],
    ["angles", ["rail.angle"]],
    ["slides", ["rail.offset", "bore.offset"]],
  ]);
});

test("labels say what the group does not", () => {
  assert.deepEqual(dimensionLabel("crank.length"), { owner: "crank", joint: "", word: "" });
  assert.deepEqual(dimensionLabel("ground.D.x"), { owner: "", joint: "D", word: "x" });
  assert.deepEqual(dimensionLabel("coupler.P.y"), { owner: "coupler", joint: "P", word: "y" });
  assert.deepEqual(dimensionLabel("y.origin.x"), { owner: "y", joint: "", word: "x" });
  assert.deepEqual(dimensionLabel("rail.angle"), { owner: "rail", joint: "", word: "angle" });
});

test("a dimension concerns its link and joint, of a slide what slides", () => {
  assert.deepEqual(concernedBy("coupler.P.x", CRANE), { links: ["coupler"], joints: ["P"] });
  assert.deepEqual(concernedBy("ground.D.x", CRANE), { links: [], joints: ["D"] });
  assert.deepEqual(concernedBy("rail.angle", CRANE), { links: ["block"], joints: [] });
  assert.deepEqual(concernedBy("bore.offset", CRANE), { links: ["tube", "bore_rod"], joints: [] });
});

test("a dimension is given, changed, and back at the drawing", () => {
  const nested = { ...CRANE, dimensions: { crank: { length: 2 }, "coupler.P.x": 3 } };
  assert.deepEqual(givenDimensions(nested), { "crank.length": 2, "coupler.P.x": 3 });
  assert.deepEqual(withDimension(nested, "crank.length", 4).dimensions, { "crank.length": 4, "coupler.P.x": 3 });
  const back = withDimension(withDimension(CRANE, "crank.length", 4), "crank.length", null);
  assert.equal("dimensions" in back, false);
  assert.equal(CRANE.dimensions, undefined);
});

test("fields show few digits, all of them while one edits", () => {
  assert.equal(fieldText(0.08000000000000002, "m", "mm"), "80");
  assert.equal(fieldText(0.04, "m", "mm"), "40");
  assert.equal(fieldText(0.0542837465, "m", "mm"), "54.28");
  assert.equal(fieldText(0.0542837465, "m", "mm", true), "54.2837465");
  assert.equal(fieldText(0.07999999999999997, "m", "mm", true), "80");
  assert.equal(fieldText(-1.11, "m", "m"), "−1.11");
});

test("a step is round, and a length stays above zero", () => {
  const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-15, `${a} is not ${b}`);
  near(stepped(0.12, 1000, 1, { usual: 0.1 }), 0.122);
  near(stepped(0.1203, 1000, -1, { usual: 0.1 }), 0.118);
  near(stepped(0, 1000, 1, { usual: 0.1 }), 0.0001);
  near(stepped(Math.PI / 6, 180 / Math.PI, 10, { usual: 0.1, isAngle: true }), (40 * Math.PI) / 180);
  assert.equal(stepped(0.001, 1000, -1000, { usual: 0.1, isPositive: true }), 0.001);
});

const SCENE = {
  links: ["ground", "crank", "coupler"],
  slides: [{ name: "rail" }],
  joints: [{ name: "A", link: 0 }, { name: "P", link: 2 }],
  diagrams: ["rail.v"],
  bounds: [0, 0, 0.4, 0.2],
};

test("outputs are links, slides and moving joints", () => {
  assert.deepEqual(outputsOf(SCENE).map((one) => one.of), ["crank", "coupler", "rail", "P.x", "P.y"]);
  assert.equal(usualOutput(SCENE), "rail");
  assert.equal(usualOutput({ ...SCENE, diagrams: ["P.x"] }), "P.x");
  assert.equal(panelLength(SCENE).name, "mm");
});

test("derivatives are written per mm and °", () => {
  const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-12, `${a} is not ${b}`);
  near(perUnit(Math.PI, true, false, 1000), 0.18);
  near(perUnit(2, false, false, 1000), 2);
  near(perUnit(2, true, true, 1000), 2);
  near(perUnit(0.18 / Math.PI, false, true, 1000), 1);
  assert.deepEqual(["1.5", "−1.5", "0", "–", "0.5"].map(signed), ["+1.5", "−1.5", "0", "–", "+0.5"]);
});

test("a reach is a full turn, an interval, or has no end", () => {
  const mm = { name: "mm", factor: 1000 };
  const full = { full_rotation: true, period: 1, intervals: [[null, null]], dead_points: [] };
  assert.equal(reachText(full, 0, true, mm), "full turn");
  assert.equal(reachText({ ...full, period: 2 }, 0, true, mm), "closes after 2 turns");
  const part = { ...full, full_rotation: false, period: null, intervals: [[-1, 1], [2, 2.5]] };
  assert.equal(reachText(part, 2.1 + 2 * Math.PI, true, mm), "115° to 143°");
  assert.equal(reachText({ ...part, intervals: [[0.1, 0.35]] }, 0.2, false, mm), "100 to 350 mm");
  assert.equal(reachText({ ...part, intervals: [[0.1, null]] }, 0.2, false, mm), "no end");
  assert.equal(reachText(null, 0, true, mm), "");
  assert.equal(intervalAt([[0, 1]], 2, false), undefined);
});

test("plates are drawn around their joints, cylinders from base to end", () => {
  // A joint inside of a plate is no corner of it.
  const plate = { joints: {}, links: { plate: ["A", "B", "C", "D", "E"] } };
  const places = { A: [0, 0], B: [2, 2], C: [1, 0.5], D: [2, 0], E: [0, 2] };
  assert.deepEqual(skeleton(plate, places)[0].corners.map(String).sort(), ["0,0", "0,2", "2,0", "2,2"]);
  const found = Object.fromEntries(skeleton(CRANE, CRANE.joints).map(({ link, corners }) => [link, corners.length]));
  assert.deepEqual(found, { crank: 2, coupler: 3, bore_rod: 2 });
  assert.deepEqual(blocks(CRANE, CRANE.joints), [{ at: [3, 1], angle: 0.5 }]);
});

test("drivers know whether they turn", () => {
  assert.deepEqual(driverList(CRANE).map(({ name, isAngle }) => [name, isAngle]), [["bore", false], ["arm", true]]);
  assert.equal(driverList({ driver: { link: "a", relative_to: "b" } })[0].name, "a − b");
  assert.deepEqual(driverList({}), []);
});

test("the poorest transmission is said below 40° only", () => {
  const degree = Math.PI / 180;
  assert.equal(poorest([{ at: "C", min: 41 * degree, q: 0 }]), null);
  assert.equal(poorest([{ at: "C", min: 39 * degree, q: 0 }, { at: "E", min: 12 * degree, q: 1 }]).at, "E");
  assert.equal(poorest(null), null);
});

test("ranges are those of the turn", () => {
  const rows = 181;
  const q = Array.from({ length: rows }, (_, i) => (2 * Math.PI * i) / (rows - 1));
  const values = Float64Array.from([...q.flatMap((own) => [0, 0, own]), ...q.flatMap(() => [0, 0, 1]), ...q.flatMap(() => [0, 0, 0])]);
  const turn = new Turn({ grid: { kind: "linear", low: 0, high: 2 * Math.PI }, closes: true, rows, orders: 3, values });
  const quantity = { id: "x", value: (pose, speed) => speed * Math.cos(pose.value[5]) };
  const { low, high } = rangesOf(turn, [quantity], 3).get("x");
  assert.ok(Math.abs(low + 3) < 1e-3 && Math.abs(high - 3) < 1e-3);
});

test("every text of the panel is in four languages, with the same values", () => {
  const values = (text) => [...text.matchAll(/\{(\w+)\}/g)].map((one) => one[1]).sort().join();
  for (const code of ["de", "ru", "uk"]) {
    for (const [key, text] of Object.entries(PANEL_WORDS.en)) {
      assert.equal(values(PANEL_WORDS[code][key] ?? "-"), values(text), `${code}: ${key}`);
    }
    assert.deepEqual(Object.keys(PANEL_WORDS[code]).sort(), Object.keys(PANEL_WORDS.en).sort());
  }
});
