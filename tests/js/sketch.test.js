import assert from "node:assert/strict";
import test from "node:test";
import { allQuantities, pointState } from "../../python/assur/pictures/page/quantities.js";
import { Turn } from "../../python/assur/pictures/page/turn.js";
import { sketchScene } from "../../python/assur/studio/page/document/sketch.js";

/** All numbers of a scene are numbers: what is not cannot be drawn. */
function numbersOf(value, found = []) {
  if (typeof value === "number") found.push(value);
  else if (value !== null && typeof value === "object") Object.values(value).forEach((own) => numbersOf(own, found));
  return found;
}

const parts = (scene, name) => scene.parts.filter((part) => part.name === name);

const SLIDER = {
  driver: "crank",
  joints: { O: [0, 0], A: [0, 0.1], B: [0.39, 0], X: [0.2, 0.2] },
  links: { ground: ["O"], crank: ["O", "A"], rod: ["A", "B"], ram: ["B"] },
  slides: { guide: { link: "ram", on: "ground", angle: 0, origin: "O" } },
};

test("a half-drawn mechanism has its symbols", () => {
  const scene = sketchScene(SLIDER);
  assert.deepEqual(scene.links, ["ground", "crank", "rod", "ram"]);
  assert.deepEqual(scene.driven, [1]);
  assert.equal(parts(scene, "pivot O").length, 3);
  assert.equal(parts(scene, "driver").length, 2);
  assert.deepEqual(parts(scene, "link rod")[0].at, [0, 0.1, 0, 0, 0.39, 0, 0, 0]);
  const [line, hatching, block] = parts(scene, "slide guide");
  assert.ok(line.at[0] < 0.39 && line.at[4] > 0.39 && hatching.hatching === 7 && block.fill === "canvas");
  // A joint of no link is a paler dot.
  const [loose] = parts(scene, "joint X");
  assert.deepEqual([loose.colour, loose.fill, loose.link], ["second", "solid", 0]);
  assert.deepEqual(scene.joints.find(({ name }) => name === "X").links, []);
  const kinds = Object.fromEntries(scene.joints.map(({ name, links }) => [name, links]));
  assert.deepEqual(kinds, { O: [0, 1], A: [1, 2], B: [2, 3], X: [] });
});

test("it stands still as a turn, and its joints are where they are drawn", () => {
  const scene = sketchScene(SLIDER);
  const turn = new Turn(scene.turn);
  assert.equal(turn.links, scene.links.length);
  for (const q of [0, 0.3, 1]) {
    const pose = turn.sample(q);
    assert.ok(pose.known);
    for (const { name, link, at } of scene.joints) {
      const { x, y } = pointState(pose, link, at);
      assert.deepEqual([x, y], SLIDER.joints[name]);
    }
  }
  // The quantities that the page offers are numbers.
  for (const { quantities } of allQuantities(scene)) for (const one of quantities) assert.ok(Number.isFinite(one.value(turn.sample(0.5), 1)));
  const moved = sketchScene(SLIDER, { A: [0.1, 0.1] });
  assert.deepEqual(moved.joints.find(({ name }) => name === "A").at, [0.1, 0.1]);
});

test("nothing throws on what is half finished, and nothing is without a place", () => {
  const wrong = [null, 1, "x", [], {}, [null], { a: null }, { A: [NaN, 1] }, { A: [1] }, { A: ["B"] }];
  const documents = [{}, null, undefined, [], { joints: { A: [0, 0] } }, { joints: { A: [1, 1], B: [1, 1] }, links: { a: ["A", "B"] } }];
  for (const key of ["joints", "links", "slides", "driver", "dimensions", "drawn", "bodies"]) {
    for (const value of wrong) documents.push({ ...SLIDER, [key]: value });
  }
  const slides = [{}, { link: "ram" }, { link: "ram", on: "none", angle: 0 }, { link: "ram", on: "ram", angle: 0 }, { link: "ram", on: "rod", along: ["A", "Z"] }, { link: "ram", on: "rod", angle: "x" }, { base: "A" }, { base: "A", end: "A" }, { base: "O", end: "Z" }];
  for (const one of slides) documents.push({ ...SLIDER, slides: { one } });
  documents.push({ ...SLIDER, links: { ...SLIDER.links, none: [], ghost: ["Q", 3, null] } });
  documents.push({ ...SLIDER, driver: [{ link: "none" }, "ground", { relative_to: "crank" }, { link: "rod", relative_to: "crank" }, "guide"] });
  documents.push({ joints: { A: [0, 0] }, links: { a: [], b: [] }, slides: { s: { link: "a", on: "b", angle: 1 }, t: { link: "b", on: "ground", angle: 1 } } });
  for (const document of documents) {
    const scene = sketchScene(document);
    const text = JSON.stringify(document);
    assert.ok(numbersOf(scene).every(Number.isFinite), text);
    const [x0, y0, x1, y1] = scene.bounds;
    assert.ok(x1 > x0 || y1 > y0, text);
    assert.ok(scene.usual > 0 && scene.links[0] === "ground");
    assert.ok(new Turn(scene.turn).sample(0).known);
    assert.ok(scene.parts.every((part) => part.link >= 0 && part.link < scene.links.length && part.at.length % 4 === 0), text);
  }
});
