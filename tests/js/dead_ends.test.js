// What is said of a driver that cannot go round.

import assert from "node:assert/strict";
import { test } from "node:test";

import { deadEnds } from "../../python/assur/studio/page/panel/dead_ends.js";
import { learn } from "../../python/assur/pictures/page/words.js";
import { BUILD_WORDS } from "../../python/assur/studio/page/words/build.js";

learn(BUILD_WORDS);

/** Joints of three links that lie where `places` has them at a coordinate: all angles are zero. */
function drawn(places, dead) {
  const joints = ["C", "E", "F"].map((name, link) => ({ name, link: link + 1, at: [0, 0] }));
  const turn = {
    pose: () => ({ value: new Float64Array(12), d1: new Float64Array(12), d2: new Float64Array(12) }),
    sample: (q, pose) => places(q).forEach(([x, y], i) => pose.value.set([x, y, 0], 3 * (i + 1))),
  };
  return [{ joints, turn: { dead } }, turn];
}

const DYAD = { class: "II", kind: "RRR", links: ["rod", "arm"], joints: ["C", "E", "F"] };
const both = [{ q: -1, group: "II(rod, arm)" }, { q: 2, group: "II(rod, arm)" }];

test("a dyad that is stretched at both ends is said once", () => {
  const [data, turn] = drawn(() => [[0, 0], [1, 0], [3, 0]], both);
  const [end, ...others] = deadEnds(data, turn, [DYAD]);
  assert.deepEqual(others, []);
  assert.deepEqual([end.key, end.at, end.links], ["deadStretched", [-1, 2], ["rod", "arm"]]);
  assert.deepEqual(end.values, { group: "II(rod, arm)", links: "rod and arm", joint: "E" });
});

test("stretched at one end and folded at the other are two", () => {
  const [data, turn] = drawn((q) => [[0, 0], [1, 0], q < 0 ? [3, 0] : [0.5, 0]], both);
  assert.deepEqual(deadEnds(data, turn, [DYAD]).map((end) => [end.key, end.at]), [["deadStretched", [-1]], ["deadFolded", [2]]]);
});

test("other groups, and groups that are not known, are at a dead point", () => {
  const [data, turn] = drawn(() => [[0, 0], [1, 0], [3, 0]], both.slice(0, 1));
  assert.equal(deadEnds(data, turn, [{ ...DYAD, kind: "RRP" }])[0].key, "deadGroup");
  assert.deepEqual(deadEnds(data, turn, [])[0].links, []);
  assert.deepEqual(deadEnds({ ...data, turn: { dead: [] } }, turn, [DYAD]), []);
});
