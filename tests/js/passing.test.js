import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { passing } from "../../python/assur/studio/page/model/passing.js";

const needs = { skip: !mock.timers && "Node 20 has timers that a test moves" };

test("with each picture at most one thing follows, in turn, and the last is not lost", needs, () => {
  let now = 1000;
  mock.timers.enable({ apis: ["setTimeout"] });
  mock.method(performance, "now", () => now);
  const tick = (time) => {
    now += time;
    mock.timers.tick(time);
  };
  const done = [];
  const pass = passing([() => done.push("fields"), () => done.push("diagrams")]);
  pass();
  assert.deepEqual(done, []);
  tick(1);
  assert.deepEqual(done, ["fields"]);
  // Pictures come every 20 ms: every third has one.
  for (let i = 0; i < 6; i++) {
    tick(20);
    pass();
    tick(1);
  }
  assert.deepEqual(done, ["fields", "diagrams", "fields"]);
  // No picture comes any more: what the last one has not had follows once.
  tick(200);
  assert.deepEqual(done, ["fields", "diagrams", "fields", "diagrams"]);
  mock.restoreAll();
  mock.timers.reset();
});
