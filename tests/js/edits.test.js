import assert from "node:assert/strict";
import test from "node:test";
import { learn, say } from "../../python/assur/pictures/page/words.js";
import { FIELD_WORDS } from "../../python/assur/studio/page/words/fields.js";
import { addJoint, addPlateJoint, joinToLink, mergeJoints, moveJoint, removeJoint, renameJoint, setGround } from "../../python/assur/studio/page/document/joints.js";
import { addLink, nameLink, removeLink, renameLink, setDriver } from "../../python/assur/studio/page/document/links.js";
import { addLoad, clearDimension, removeLoad, setBody, setDimension, setFriction, setLoad, setMotor } from "../../python/assur/studio/page/document/machine.js";
import { allLinks, nameError, nameJoint } from "../../python/assur/studio/page/document/names.js";
import { addCylinder, addSlide, removeSlide, renameSlide, setSlide, slideNameError } from "../../python/assur/studio/page/document/slides.js";
import { documentSize, isAsDrawn, redrawn } from "../../python/assur/studio/page/document/structure.js";

learn(FIELD_WORDS);

/** Freeze all of a document: an edit that changes it in place throws. */
function frozen(value) {
  if (value !== null && typeof value === "object") Object.values(Object.freeze(value)).forEach(frozen);
  return value;
}

/** All texts of a document, keys and parts of dotted names too. */
function words(value, found = new Set()) {
  if (typeof value === "string") value.split(".").forEach((word) => found.add(word));
  else if (Array.isArray(value)) value.forEach((own) => words(own, found));
  else if (value !== null && typeof value === "object") {
    for (const [key, own] of Object.entries(value)) {
      words(key, found);
      words(own, found);
    }
  }
  return found;
}

/** A document with a name at every place where one can stand. */
const FULL = frozen({
  driver: ["crank", { link: "arm", relative_to: "bar" }, "lift", "bore"],
  joints: { O: [0, 0], A: [0, 1], B: [3, 0], P: [1, 2], E: [5, 1], F: [6, 2], S: [4, 4] },
  links: { ground: ["O", "E"], crank: ["O", "A"], bar: ["A", "B", "P"], ram: ["B"], arm: ["E", "S"], plank: ["S", "P"], block: ["S"] },
  slides: {
    bore: { link: "ram", on: "ground", angle: 0, origin: "O" },
    slot: { link: "block", on: "bar", along: ["A", "P"] },
    lift: { base: "E", end: "F" },
    jack: { base: "E", end: "P", barrel: "tube", rod: "ramrod" },
  },
  assembly: { P: 1, slot: -1 },
  dimensions: {
    ...{ "ground.O.x": 0, "ground.O.y": 0, "crank.length": 1, "bar.length": 3, "bar.P.x": 1, "bar.P.y": 2 },
    ...{ "bore.angle": 0, "bore.offset": 0, "slot.origin.x": 1, "slot.origin.y": 0, "lift_barrel.length": 1 },
  },
  drawn: {
    q: [0, 0, 1, 1],
    joints: { O: [0, 0], A: [0, 1], B: [3, 0], P: [1, 2], E: [5, 1], F: [6, 2], S: [4, 4] },
    angles: { ground: 0, crank: 1, bar: 2, ram: 0, arm: 0, plank: 0, block: 0, lift_barrel: 0, lift_rod: 0, tube: 0, ramrod: 0 },
    slides: { bore: 1, slot: 2, lift: 3, jack: 4 },
    signs: { P: 1, slot: 1 },
    dimensions: { bar: { length: 3, P: { x: 1 } }, "crank.length": 1, slot: { origin: { x: 1 } } },
    drawn: { q: [0], joints: { O: [0, 0], P: [1, 1] }, angles: { crank: 1, bar: 1 } },
  },
  bodies: { crank: { mass: 1, at: "A" }, bar: { mass: 2, inertia: 1, at: [1, 0] }, lift_rod: { mass: 1, at: "F" }, tube: { mass: 1, at: "E" } },
  loads: [
    { type: "Gravity" },
    { type: "Force", at: "P", on: "bar", axes: "crank", force: [{ q: [0, 1], value: [0, 1], over: "bore" }, 0], while_: "forward", over: "lift" },
    { type: "Force", at: ["plank", [1, 2]], force: [1, { q: [0, 1], value: [1, 2], over: "arm" }] },
    { type: "Torque", link: "arm", on: "bar", torque: { q: [0, 1], value: [1, 1], over: "lift_rod" } },
    { type: "Pressure", slide: "bore", area: 1, pressure: { q: [0, 1], value: [1, 1], over: "jack" }, over: "crank" },
    { type: "Spring", first: "B", second: ["crank", [0, 1]], stiffness: 1 },
    { type: "TorsionSpring", link: "crank", on: "ground", stiffness: 1 },
    { type: "Damper", first: ["lift_barrel", [0, 0]], second: "S", damping: 1 },
    { type: "TorsionDamper", link: "tube", damping: 1 },
  ],
  motor: [{ type: "ConstantTorque", torque: 1 }, { type: "None" }, { type: "LinearMotor", stall: 1, no_load: 2 }, { type: "None" }],
  friction: { P: { coefficient: 0.1, radius: 0.01 }, A: { coefficient: 0.1, radius: 0.01 }, bore: { coefficient: 0.1, length: 1 } },
});
const JOINTS = Object.keys(FULL.joints);
const LINKS = Object.keys(allLinks(FULL)).filter((link) => link !== "ground");
const SLIDES = Object.keys(FULL.slides);

/** A document without the links that cylinders name: what a rename and one back may write out. */
const plain = (document) => JSON.parse(JSON.stringify(document));

test("a name changes everywhere, and back again", () => {
  const kinds = [[JOINTS, renameJoint], [LINKS, renameLink], [SLIDES, renameSlide]];
  for (const [names, rename] of kinds) {
    for (const name of names) {
      const after = rename(FULL, name, "new");
      const left = words(after);
      assert.ok(!left.has(name), `${name} is left in ${JSON.stringify(after)}`);
      assert.ok(left.has("new"));
      const back = rename(after, "new", name);
      // A cylinder's link that was named and named back is written out.
      for (const part of ["barrel", "rod"]) if (back.slides.lift[part] === `lift_${part}`) delete back.slides.lift[part];
      assert.deepEqual(plain(back), plain(FULL), name);
      assert.deepEqual(Object.keys(back.joints), JOINTS);
    }
  }
  const moved = renameSlide(FULL, "lift", "hoist");
  assert.ok(Object.hasOwn(allLinks(moved), "hoist_barrel") && moved.bodies.hoist_rod && !words(moved).has("lift_rod"));
});

test("what is removed is named nowhere", () => {
  const kinds = [[JOINTS, removeJoint], [LINKS, removeLink], [SLIDES, removeSlide]];
  for (const [names, remove] of kinds) {
    for (const name of names) {
      const after = remove(FULL, name);
      assert.ok(!words(after).has(name), `${name} is left in ${JSON.stringify(after)}`);
      assert.ok(after.drawn === undefined && after.assembly === undefined);
      // All that is named exists.
      const known = new Set([...Object.keys(after.joints), ...Object.keys(allLinks(after)), ...Object.keys(after.slides)]);
      const named = words({ ...after, joints: {}, links: Object.values(after.links), slides: Object.values(after.slides) });
      const gone = [...JOINTS, ...LINKS, ...SLIDES].filter((own) => !known.has(own));
      for (const own of gone) assert.ok(!named.has(own), `${own} is still named without ${name}`);
      if (Array.isArray(after.motor)) assert.equal(after.motor.length, after.driver.length);
    }
  }
});

test("a cylinder goes with its links, a driver with its motor", () => {
  const after = removeLink(FULL, "lift_rod");
  assert.deepEqual(after.driver, ["crank", { link: "arm", relative_to: "bar" }, "bore"]);
  assert.deepEqual(after.motor.map((one) => one.type), ["ConstantTorque", "None", "None"]);
  // F was only on the cylinder; E is on the ground.
  assert.ok(!("F" in after.joints) && "E" in after.joints && !words(after).has("lift_barrel"));
  assert.ok("drawn" in FULL && after.loads.length === FULL.loads.length - 3);
  const single = { driver: ["a", "b"], links: { ground: [], a: ["P", "Q"], b: ["P", "Q"] }, motor: [{ type: "None" }, { type: "ConstantTorque", torque: 1 }] };
  assert.deepEqual([removeLink(single, "a").driver, removeLink(single, "a").motor], ["b", { type: "ConstantTorque", torque: 1 }]);
  assert.deepEqual([removeLink(single, "b").driver, removeLink(single, "b").motor], ["a", undefined]);
});

test("names that are not allowed are refused in words", () => {
  const refused = { "": "emptyName", "a b": "badName", "a.b": "badName", "a/b": "badName", "“a”": "badName", "a\u200bb": "badName", __proto__: "badName", P: "takenName", crank: "takenName", bore: "takenName", lift_rod: "takenName", ground: "takenName" };
  for (const [name, error] of Object.entries(refused).concat([["__proto__", "badName"]])) {
    const found = nameError(FULL, name, "A");
    assert.equal(found.error, error, name);
    assert.ok(!/[{}]/.test(say(found.error, found.values)) && say(found.error, found.values) !== error);
    assert.equal(renameJoint(FULL, "A", name), null);
    assert.equal(renameLink(FULL, "crank", name === "crank" ? "bar" : name), null);
  }
  assert.equal(renameLink(FULL, "ground", "frame"), null);
  assert.equal(nameError(FULL, "frame", "ground").error, "groundName");
  assert.equal(nameError(FULL, "φ1", "A"), null);
  assert.equal(nameError(FULL, "A", "A"), null);
  const clash = { ...FULL, joints: { ...FULL.joints, hoist_rod: [0, 0] } };
  assert.equal(renameSlide(clash, "lift", "hoist"), null);
  assert.deepEqual(slideNameError(clash, "hoist", "lift"), { error: "takenName", values: { name: "hoist_rod" } });
});

const FOUR_BAR = frozen({
  joints: { A: [0, 0], B: [0, 1], C: [3, 2], D: [4, 0] },
  links: { ground: ["A", "D"], crank: ["A", "B"], coupler: ["B", "C"], rocker: ["D", "C"] },
  driver: "crank",
});

test("a four-bar is drawn from nothing", () => {
  let own = frozen({});
  for (const at of [[0, 0], [0, 1], [3, 2], [4, 0]]) own = frozen(addJoint(own, at));
  assert.deepEqual(Object.keys(own.joints), ["A", "B", "C", "D"]);
  for (const joint of ["A", "D"]) own = frozen(setGround(own, joint, true));
  for (const joints of [["A", "B"], ["B", "C"], ["D", "C"]]) own = frozen(addLink(own, joints));
  own = frozen(setDriver(own, "crank"));
  const same = renameLink(renameLink(own, "link1", "coupler"), "link2", "rocker");
  assert.deepEqual(same, FOUR_BAR);
  assert.equal(nameJoint(own), "E");
  assert.equal(nameLink(own, ["A"]), "link3");
  const all = { joints: Object.fromEntries([..."ABCDEFGHIJKLMNOPQRSTUVWXYZ"].map((letter) => [letter, [0, 0]])) };
  assert.equal(nameJoint(all), "A1");
  assert.deepEqual(addPlateJoint(FOUR_BAR, "coupler", [1, 3]).links.coupler, ["B", "C", "E"]);
  assert.deepEqual(setGround(setGround(FOUR_BAR, "C", true), "C", false), FOUR_BAR);
  assert.equal(documentSize(FOUR_BAR), 4);
  assert.equal(addLink(FOUR_BAR, ["X", "Y"]), FOUR_BAR);
});

test("joints that are merged are one everywhere", () => {
  for (const from of JOINTS) {
    for (const into of JOINTS) {
      if (from === into) continue;
      const after = mergeJoints(FULL, from, into);
      const left = words(after);
      assert.ok(!left.has(from) && left.has(into), `${from} into ${into}`);
      assert.deepEqual(after.joints[into], FULL.joints[into]);
      for (const [link, joints] of Object.entries(after.links)) {
        assert.equal(new Set(joints).size, joints.length, link);
        const expected = new Set(FULL.links[link].map((joint) => (joint === from ? into : joint)));
        assert.deepEqual(new Set(joints), expected);
      }
    }
  }
  // Both ends of a cylinder, or of a link.
  assert.ok(!("lift" in mergeJoints(FULL, "F", "E").slides) && !words(mergeJoints(FULL, "F", "E")).has("lift_rod"));
  assert.deepEqual(mergeJoints(FULL, "B", "A").links.bar, ["A", "P"]);
  assert.deepEqual(mergeJoints(FOUR_BAR, "B", "A").links.crank, ["A"]);
  assert.equal(mergeJoints(FULL, "A", "P").slides.slot.angle, Math.PI / 4);
  // What lay in a frame that is another one is the drawing's.
  assert.equal(mergeJoints(FULL, "B", "S").dimensions["bar.length"], undefined);
  assert.equal(mergeJoints(FULL, "B", "S").dimensions["crank.length"], 1);
});

test("a joint becomes one of a link", () => {
  assert.deepEqual(joinToLink(FOUR_BAR, "D", "coupler").links.coupler, ["B", "C", "D"]);
  assert.equal(joinToLink(FOUR_BAR, "B", "coupler"), FOUR_BAR);
  assert.equal(joinToLink(FOUR_BAR, "B", "none"), FOUR_BAR);
  const after = joinToLink(FULL, "S", "lift_rod");
  assert.deepEqual([after.links.lift_rod, after.links.lift_barrel], [["F", "S"], ["E"]]);
  const lift = { link: "lift_rod", on: "lift_barrel", angle: Math.PI / 4, origin: "E", length: true };
  assert.deepEqual(after.slides.lift, lift);
});

test("removing a joint leaves no link of one joint without a slide", () => {
  const after = removeJoint(FOUR_BAR, "C");
  assert.deepEqual(after, { joints: { A: [0, 0], B: [0, 1], D: [4, 0] }, links: { ground: ["A", "D"], crank: ["A", "B"] }, driver: "crank" });
  assert.deepEqual(removeJoint(FULL, "P").links.bar, ["A", "B"]);
  assert.deepEqual(removeJoint(FULL, "P").links.block, ["S"]);
  assert.equal(removeJoint(FULL, "P").slides.slot.angle, Math.PI / 4);
  assert.deepEqual(removeLink(FOUR_BAR, "coupler").joints, FOUR_BAR.joints);
  assert.deepEqual(Object.keys(removeLink(removeLink(FOUR_BAR, "coupler"), "rocker").joints), ["A", "B", "D"]);
  assert.equal(removeLink(FOUR_BAR, "ground"), FOUR_BAR);
});

test("slides and cylinders", () => {
  const base = addLink(addJoint(addJoint(setGround(addJoint({}, [0, 0]), "A", true), [0, 1]), [3, 0]), ["B", "C"]);
  const slid = addSlide(base, { joint: "C", origin: "A" });
  assert.deepEqual(slid.slides, { slide1: { link: "block1", on: "ground", angle: 0, origin: "A" } });
  assert.deepEqual(slid.links.block1, ["C"]);
  assert.deepEqual(removeSlide(slid, "slide1"), base);
  assert.deepEqual(setSlide(slid, "slide1", { along: ["A", "C"], origin: null }).slides.slide1, { link: "block1", on: "ground", along: ["A", "C"] });
  assert.deepEqual(addSlide(base, { link: "link1", on: "link1" }), base);
  assert.deepEqual(addSlide({}, { joint: "Z" }), {});
  const lifted = addCylinder(base, "A", "C");
  assert.deepEqual(allLinks(lifted).cylinder1_rod, ["C"]);
  assert.deepEqual(removeSlide(lifted, "cylinder1"), base);
  assert.equal(addCylinder(base, "A", "A"), base);
  assert.equal(addCylinder(base, "A", "none"), base);
});

test("places in the drawing", () => {
  const sized = frozen({ ...FOUR_BAR, dimensions: { "crank.length": 2, "rocker.length": 3, "ground.A.x": 0 }, assembly: { C: 1 } });
  assert.deepEqual(moveJoint(sized, "B", [1, 1]).dimensions, { "rocker.length": 3, "ground.A.x": 0 });
  assert.deepEqual(moveJoint(sized, "A", [1, 1]).dimensions, { "rocker.length": 3 });
  assert.deepEqual(moveJoint(FOUR_BAR, "B", [1, 1]).joints.B, [1, 1]);
  assert.equal(moveJoint(FOUR_BAR, "X", [1, 1]), FOUR_BAR);
  assert.ok(!isAsDrawn(sized) && isAsDrawn(FOUR_BAR));
  const after = redrawn(sized, { B: [0, 2], C: [3, 2.5] });
  assert.deepEqual(after, { ...FOUR_BAR, joints: { A: [0, 0], B: [0, 2], C: [3, 2.5], D: [4, 0] } });
  assert.ok(isAsDrawn(redrawn(FULL, {}, { bore: 1, lift: 2 })));
  assert.deepEqual(redrawn(FULL, {}, { slot: 1 }).slides.slot, { link: "block", on: "bar", angle: 1 });
});

test("dimensions, masses, loads, motor", () => {
  let own = frozen(setDimension(FOUR_BAR, "crank.length", 1.1));
  assert.deepEqual(own.dimensions, { "crank.length": 1.1 });
  assert.deepEqual(clearDimension(own, "crank.length"), FOUR_BAR);
  assert.deepEqual(setBody(setBody(own, "crank", { mass: 1 }), "crank", null), own);
  const force = { type: "Force", at: "C", force: [0, 1] };
  own = frozen(addLoad(addLoad(FOUR_BAR, force), { type: "Gravity" }));
  assert.deepEqual(setLoad(own, 1, force).loads, [force, force]);
  assert.deepEqual(removeLoad(own, 0).loads, [{ type: "Gravity" }]);
  assert.deepEqual(removeLoad(removeLoad(own, 0), 0), FOUR_BAR);
  assert.deepEqual(setMotor(setMotor(own, { type: "None" }), null), own);
  assert.deepEqual(setFriction(setFriction(own, "C", { coefficient: 1 }), "C", null), own);
  const found = frozen({ ...FOUR_BAR, dimensions: { "crank.length": 1 }, drawn: { q: [0] } });
  assert.deepEqual(setDimension(found, "crank.length", 2).drawn.dimensions, { "crank.length": 1 });
  assert.deepEqual(setDimension(setDimension(found, "crank.length", 2), "crank.length", 3).drawn.dimensions, { "crank.length": 1 });
  assert.deepEqual(setDriver(FULL, ["crank"]).motor, { type: "ConstantTorque", torque: 1 });
});

test("half a document is no reason to fail", () => {
  const halves = [{}, { joints: null, links: { a: null }, slides: { s: null }, driver: 3 }, { joints: { A: "x" }, links: [], slides: [], loads: {}, drawn: 1, dimensions: 2 }];
  for (const half of halves.map(frozen)) {
    removeJoint(half, "A");
    removeLink(half, "a");
    removeSlide(half, "s");
    renameJoint(half, "A", "B");
    mergeJoints(half, "A", "B");
    joinToLink(half, "A", "a");
    addCylinder(half, "A", "B");
    addLink(addJoint(half, [0, 0], "N"), ["N"]);
    setGround(addJoint(half, [0, 0], "N"), "N", true);
    moveJoint(half, "A", [0, 0]);
    redrawn(half, {});
    setDriver(setDimension(half, "a.length", 1), null);
  }
});
