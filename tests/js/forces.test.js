import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { Along } from "../../python/assur/studio/page/forces/along.js";
import { hasMachine, driveAt, jointForce } from "../../python/assur/studio/page/forces/answers.js";
import { shownForces } from "../../python/assur/studio/page/forces/arrows.js";
import { driveFacts } from "../../python/assur/studio/page/forces/drive.js";
import { readField, notNegative, positive } from "../../python/assur/studio/page/forces/fields.js";
import { forceQuantities } from "../../python/assur/studio/page/forces/force_quantities.js";
import { runRequest, firstRun } from "../../python/assur/studio/page/forces/laws.js";
import { withOpposite } from "../../python/assur/studio/page/forces/load_form.js";
import { LOAD_FIELDS, loadText, newLoad, slideAt } from "../../python/assur/studio/page/forces/load_kinds.js";
import { bodyWith, gravityOf, withWeight } from "../../python/assur/studio/page/forces/masses.js";
import { peakOf } from "../../python/assur/studio/page/forces/peaks.js";
import { discDiameter, surplusAreas, tangentsOf } from "../../python/assur/studio/page/forces/surplus.js";
import { linesOf, readLines, tableOfConstant } from "../../python/assur/studio/page/forces/values.js";
import { say } from "../../python/assur/pictures/page/words.js";
import { LOADS_WORDS } from "../../python/assur/studio/page/words/loads.js";

const TURN = 2 * Math.PI;
const ROCKER = {
  driver: "crank",
  joints: { A: [0, 0], B: [0, 1], C: [4, 3], D: [5, 0] },
  links: { ground: ["A", "D"], crank: ["A", "B"], coupler: ["B", "C"], rocker: ["D", "C"] },
};

test("numbers between rows lie on lines, around a period, and none lie beyond an end", () => {
  const along = new Along([0, 1, 3], true);
  const values = [0, 10, 2, 20, 0, 10];
  assert.deepEqual(along.at(values, 0.5, 2, 0, 2), [1, 15]);
  assert.deepEqual(along.at(values, 2, 2, 0, 1), [1]);
  assert.deepEqual(along.at(values, -1, 2, 0, 1), along.at(values, 2, 2, 0, 1));
  assert.deepEqual(along.at(values, 3.5, 2), [1]);
  const once = new Along([0, 1, 3], false);
  assert.ok(Number.isNaN(once.at(values, 3.5, 2)[0]));
  assert.deepEqual(once.at(values, 3, 2), [0]);
  // A jump to nothing does not take away the row before it.
  assert.deepEqual(once.at([1, 2, NaN], 1), [2]);
  assert.equal(once.mean([0, 2, 4]), (1 + 2 * 3) / 3);
  assert.deepEqual(once.greatest([1, -5, NaN]), { value: -5, place: 1 });
});

/** Forces along a turn in which the drive is 3 + 4 cos q, and one joint has (cos q, 2). */
function turnForces(speed) {
  const q = Array.from({ length: 361 }, (_, i) => (i * TURN) / 360);
  return {
    along: new Along(q, true), speed, joints: [{ joint: "B", on: "crank", from: "coupler" }],
    slides: [], applied: [{ load: 1, on: "crank", joint: "B" }],
    arrays: {
      drive: q.map((own) => 3 + 4 * Math.cos(own)), forces: q.flatMap((own) => [Math.cos(own), 2]),
      applied: q.flatMap((own) => [5, 6, -Math.sin(own), 0]), slide_forces: [],
    },
  };
}

test("the drive is told: greatest, mean, power", () => {
  const forces = turnForces(10);
  const { greatest, mean, power } = driveFacts(forces);
  assert.deepEqual(greatest, { value: 7, place: 0 });
  assert.ok(Math.abs(mean - 3) < 1e-12 && Math.abs(power - 30) < 1e-11);
  const { drive, power: now } = driveAt(forces, Math.PI + TURN);
  assert.ok(Math.abs(drive + 1) < 1e-12 && Math.abs(now + 10) < 1e-11);
  const [x, y] = jointForce(forces, 0, Math.PI / 3);
  assert.ok(Math.abs(x - 0.5) < 1e-12 && y === 2);
});

test("toward a dead point there is no greatest force", () => {
  const press = Array.from({ length: 100 }, (_, i) => (i === 50 ? 900 : 1));
  assert.deepEqual(peakOf(press, true), { most: 900, isUnbounded: false });
  assert.deepEqual(peakOf([...press, 1e9], false), { most: 50, isUnbounded: true });
  assert.deepEqual(peakOf([0, 0, -5, NaN], false), { most: 5, isUnbounded: false });
});

test("forces are quantities of diagrams", () => {
  const [{ quantities }] = forceQuantities(turnForces(10), { driver: "crank", isSlide: false });
  const by = Object.fromEntries(quantities.map((own) => [own.id, own]));
  assert.deepEqual(Object.keys(by), ["crank.drive", "crank.power", "B.F", "B.Fx", "B.Fy"]);
  assert.equal(by["crank.drive"].unit, "N·m");
  assert.equal(by["B.F"].value({ q: 0 }), Math.hypot(1, 2));
});

test("arrows stand in chosen joints, loads always", () => {
  const data = { joints: [{ name: "B", link: 1, at: [0, 0], links: [1, 2] }], links: ["ground", "crank"], slides: [] };
  const keys = (chosen) => shownForces(turnForces(1), data, chosen).map((own) => own.key);
  assert.deepEqual(keys([]), ["R B crank", "F 1 crank 0"]);
  assert.deepEqual(keys(["C"]), ["F 1 crank 0"]);
  const [, load] = shownForces(turnForces(1), data, []);
  assert.deepEqual(load.at({ q: Math.PI / 2 }).slice(0, 3), [5, 6, -1]);
});

test("areas of surplus end where the curve crosses zero", () => {
  const areas = surplusAreas([0, 1, 2, 3], [2, -2, -2, 2]);
  assert.deepEqual(areas.map((own) => own.isLeft), [true, false, true]);
  assert.deepEqual(areas[1].points, [[0.5, 0], [1, -2], [2, -2], [2.5, 0]]);
  const size = ({ points }) => points.reduce((sum, [x, y], i) => {
    const [u, v] = points[(i + 1) % points.length];
    return sum + (x * v - u * y) / 2;
  }, 0);
  assert.equal(areas.reduce((sum, own) => sum - size(own), 0), -2);
});

test("Wittenbauer's tangents meet at the flywheel", () => {
  // E = ½ (I + J) ω² − ½ J ω0²
  const flywheel = { inertia: 3, speed0: 10, max: { value: 11 }, min: { value: 9 } };
  const { meet, lines } = tangentsOf(flywheel);
  for (const [i, speed] of [11, 9].entries()) {
    const [inertia, energy] = [2, 0.5 * (2 + 3) * speed ** 2 - 0.5 * 3 * 100];
    assert.ok(Math.abs(meet[1] + lines[i].slope * (inertia - meet[0]) - energy) < 1e-9);
  }
});

test("a disc has the inertia that is needed", () => {
  const [thickness, density] = [0.06, 7850];
  const radius = discDiameter(20.64, thickness, density) / 2;
  assert.ok(Math.abs((Math.PI * radius ** 2 * thickness * density * radius ** 2) / 2 - 20.64) < 1e-9);
  assert.equal((2e3 * radius).toFixed(0), "817");
});

test("tables are read as they are typed, and keep what is not shown of unchanged lines", () => {
  const degree = { unit: "rad", shown: "°" };
  const table = { q: [0, 1, TURN], value: [0, -1234.56789, 0], spline: "linear" };
  const text = linesOf(table, degree, "N");
  assert.equal(text.split("\n").length, 3);
  assert.deepEqual(readLines(text, degree, "N", table), { q: table.q, value: table.value });
  const changed = readLines(text.replace("360   0", "360°; 2 kN"), degree, "N", table);
  assert.deepEqual(changed, { q: table.q, value: [0, -1234.56789, 2000] });
  const error = (own) => readLines(own, degree, "N").error;
  assert.equal(error("0 1\n90"), "tableLine");
  assert.equal(error("0 1\n90 x"), "tableNumber");
  assert.equal(error("90 1\n0 1"), "tableOrder");
  assert.equal(error("0 1"), "tableShort");
  assert.deepEqual(readLines("0 1\n0.5 turn 2 kN", degree, "N"), { q: [0, Math.PI], value: [1, 2000] });
  assert.deepEqual(readLines("0 1\n90 1\n90 5\n360 1", degree, "N").q, [0, Math.PI / 2, Math.PI / 2, TURN]);
  assert.equal(tableOfConstant(-5, true).q.at(-1), TURN);
});

test("fields refuse what is no mass", () => {
  const field = { unit: "kg", check: notNegative, isOptional: true };
  assert.deepEqual(readField("2 t", field), { value: 2000 });
  assert.deepEqual(readField(" ", field), { value: null });
  assert.ok(readField("-1", field).error);
  assert.ok(readField("heavy", field).error);
  assert.ok(readField("0", { unit: "", check: positive }).error);
});

test("bodies come and go with their numbers", () => {
  assert.deepEqual(bodyWith(undefined, "mass", 3), { mass: 3 });
  assert.deepEqual(bodyWith({ mass: 3, at: "B" }, "inertia", 0.1), { mass: 3, at: "B", inertia: 0.1 });
  assert.equal(bodyWith({ mass: 3, at: "B" }, "mass", null), null);
});

test("weight is one load, and goes again", () => {
  const made = withWeight({ ...ROCKER, loads: [{ type: "Force", at: "C", force: [1, 2] }] }, true);
  assert.deepEqual(gravityOf(made), [0, -9.81]);
  const twice = withWeight(made, true);
  assert.deepEqual(withWeight(twice, false).loads, [{ type: "Force", at: "C", force: [1, 2] }]);
  assert.equal(gravityOf(ROCKER), null);
  assert.ok(!hasMachine(ROCKER) && hasMachine(made));
});

test("every new load names parts of the document, and is said in words", () => {
  for (const type of Object.keys(LOAD_FIELDS)) {
    const load = newLoad(ROCKER, type);
    assert.equal(load.type, type);
    for (const key of ["at", "first", "second"]) if (key in load) assert.ok(load[key] in ROCKER.joints);
    if ("link" in load) assert.equal(load.link, "crank");
    assert.notEqual(load.first ?? "", load.second);
    const { what, size } = loadText(load, say);
    assert.ok(what && size, type);
  }
  assert.equal(loadText({ type: "Pressure", slide: "bore", pressure: 1e5 }, (key) => key).what, "pressureIn");
});

test("the fields of a load are those of its file, and have labels", () => {
  const { definitions } = JSON.parse(readFileSync(new URL("../../python/assur/files/schema.json", import.meta.url)));
  const ownForm = definitions.load.properties.type.enum.filter((type) => type !== "Pressure");
  assert.deepEqual(Object.keys(LOAD_FIELDS).sort(), ownForm.sort());
  for (const [type, fields] of Object.entries(LOAD_FIELDS)) {
    const keys = fields.map((own) => own.key);
    for (const key of keys) assert.ok(key in definitions[type].properties, `${type} ${key}`);
    for (const key of definitions[type].required ?? []) assert.ok(keys.includes(key), `${type} ${key}`);
    assert.ok(`load${type}` in LOADS_WORDS.en, type);
    const labelled = fields.filter((own) => ["joint", "link", "number"].includes(own.is));
    for (const { key } of labelled) assert.ok(`field_${key}` in LOADS_WORDS.en, key);
  }
});

test("a new force on what slides is against its slide", () => {
  const ram = { ...ROCKER, links: { ...ROCKER.links, ram: ["C"] }, slides: { guide: { link: "ram", angle: Math.PI / 2 } } };
  const down = { ...ram, joints: { ...ram.joints }, links: { ground: ["A", "D"], crank: ["A", "B"], rod: ["B", "C"], ram: ["C"] } };
  assert.deepEqual(newLoad(down, "Force"), { type: "Force", at: "C", force: [0, -100] });
  const across = { ...down, slides: { guide: { link: "ram", on: "ground", along: ["A", "D"] } } };
  assert.deepEqual(newLoad(across, "Force").force, [-100, 0]);
  assert.equal(slideAt(across, "C").name, "guide");
  // What the file says of the angle counts more than the drawing; a guide that moves has no way of its own.
  const turned = { ...down, dimensions: { "guide.angle": Math.PI } };
  assert.deepEqual(newLoad(turned, "Force").force, [100, 0]);
  assert.equal(slideAt({ ...down, slides: { guide: { link: "ram", on: "crank", angle: 0 } } }, "C"), null);
  assert.deepEqual(newLoad(ROCKER, "Force").force, [0, -100]);
});

test("a load that opposes the motion is two, one for each way", () => {
  const load = { type: "Force", at: "C", force: [-5, { q: [0, 1], value: [0, 2] }], while_: "forward", over: "guide" };
  const { loads } = withOpposite({ loads: [load] }, load);
  assert.deepEqual(loads[1], { ...load, force: [5, { q: [0, 1], value: [0, -2] }], while_: "backward" });
});

test("runs are asked for as the protocol has them", () => {
  const first = firstRun({ isSlide: false, q: 1, low: 0, high: TURN });
  assert.deepEqual(runRequest({ ...first, speed: 4 }, 1, false), { by: "speed", q0: 1, speed: 4, t_end: TURN });
  const law = { law: "Cycloidal", start: 1, end: 1 + TURN, duration: 1 };
  assert.deepEqual(runRequest({ ...first, by: "law" }, 1, true), { by: "law", law, reactions: true });
  assert.deepEqual(runRequest({ ...first, by: "machine" }, 1, true), { by: "machine", q0: 1, speed: 0, t_end: 1, reactions: true });
});
