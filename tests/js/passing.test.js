import assert from "node:assert/strict";
import test from "node:test";
import { passing } from "../../python/assur/studio/page/model/passing.js";

const wait = (time) => new Promise((resolve) => setTimeout(resolve, time));

test("what follows a picture is done in turn, each after a frame, and the last is not lost", async () => {
  const order = [];
  globalThis.requestAnimationFrame = (f) => setTimeout(() => (order.push("frame"), f()), 1);
  const pass = passing([() => order.push("fields"), () => order.push("diagrams")]);
  pass();
  pass();
  assert.deepEqual(order, []);
  await wait(120);
  assert.deepEqual(order, ["frame", "fields", "frame", "diagrams"]);
  order.length = 0;
  // What is wanted again meanwhile waits behind the others.
  pass();
  while (!order.includes("fields")) await wait(1);
  pass();
  await wait(160);
  assert.deepEqual(order, ["frame", "fields", "frame", "diagrams", "frame", "fields"]);
  delete globalThis.requestAnimationFrame;
});
