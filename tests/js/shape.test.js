import assert from "node:assert/strict";
import test from "node:test";
import { hasShapeOfDocument, isTargetPath } from "../../python/assur/studio/page/document/shape.js";

const own = { joints: { A: [0, 0], B: [1, 0] }, links: { ground: ["A"], crank: ["A", "B"] } };

test("what has the shape of a document", () => {
  const slides = { s: { link: "a", on: "ground", angle: 0 } };
  const machine = { bodies: { crank: { mass: 1 } }, loads: [{ type: "Force" }], motor: [{ type: "None" }], friction: {} };
  for (const driver of ["crank", ["a", "b"], { link: "a", relative_to: "b" }, [{ link: "a" }, "b"], undefined]) {
    assert.ok(hasShapeOfDocument({ ...own, driver, slides, ...machine }));
  }
  assert.ok(hasShapeOfDocument({}));
});

test("what has not", () => {
  for (const value of [undefined, null, 5, "x", [], () => {}]) assert.ok(!hasShapeOfDocument(value));
  const wrong = {
    driver: [5, [null], ["a", 1]], joints: [null, [], { A: 1 }, { A: [1] }, { A: [1, null] }, { A: [1, "2"] }, { A: [1, NaN] }],
    links: [7, { a: "AB" }, { a: [1] }, { a: null }], slides: [[], { s: null }], loads: [{}, [null], "x"],
    bodies: [{ a: 5 }], motor: ["x", [1]], dimensions: ["x", []], assembly: [1],
  };
  for (const key in wrong) for (const part of wrong[key]) assert.ok(!hasShapeOfDocument({ ...own, [key]: part }), key);
});

test("what is a path to be taken", () => {
  assert.ok(isTargetPath({ points: [[0, 1], [2, 3]], closed: true }));
  for (const points of [undefined, [], [[1, 2]], [1, 2], [["a", null], [1, 2]]]) assert.ok(!isTargetPath({ points }));
  assert.ok(!isTargetPath(null));
});
