// What is said of a driver that cannot go round.

import assert from "node:assert/strict";
import { test } from "node:test";

import { deadEnds } from "../../python/assur/studio/page/panel/dead_ends.js";
import { learn } from "../../python/assur/pictures/page/words.js";
import { BUILD_WORDS } from "../../python/assur/studio/page/words/build.js";

learn(BUILD_WORDS);

const DYAD = { class: "II", kind: "RRR", links: ["rod", "arm"], joints: ["C", "E", "F"] };
/** Ends as the server says them, one with each of these shapes. */
const ends = (...shapes) => shapes.map((shape, i) => ({ q: 3 * i - 1, group: "II(rod, arm)", inner: "F", shape }));

test("a dyad that is stretched at both ends is said once, with its inner joint", () => {
  const [end, ...others] = deadEnds(ends("stretched", "stretched"), [DYAD]);
  assert.deepEqual(others, []);
  assert.deepEqual([end.key, end.at, end.links], ["deadStretched", [-1, 2], ["rod", "arm"]]);
  assert.deepEqual(end.values, { group: "II(rod, arm)", links: "rod and arm", joint: "F" });
});

test("stretched at one end and folded at the other are two", () => {
  const found = deadEnds(ends("stretched", "folded"), [DYAD]).map((end) => [end.key, end.at]);
  assert.deepEqual(found, [["deadStretched", [-1]], ["deadFolded", [2]]]);
});

test("other groups, and groups that are not known, are at a dead point", () => {
  assert.equal(deadEnds(ends(null), [{ ...DYAD, kind: "RRP" }])[0].key, "deadGroup");
  assert.deepEqual(deadEnds(ends(null), [])[0].links, []);
  assert.deepEqual(deadEnds([], [DYAD]), []);
});
