import assert from "node:assert/strict";
import test from "node:test";
import { checklist, linksApart } from "../../python/assur/studio/page/build/checklist.js";
import { itemsOf, neighboursOf } from "../../python/assur/studio/page/build/choice.js";
import { listedNames, whyItStands } from "../../python/assur/studio/page/build/mend.js";
import * as steps from "../../python/assur/studio/page/build/steps.js";
import { itemUnder, makeTools } from "../../python/assur/studio/page/build/tools.js";

const EMPTY = { joints: {}, links: { ground: [] } };
const FOUR = {
  driver: "crank",
  joints: { A: [0, 0], B: [0, 1], C: [4, 3], D: [5, 0] },
  links: { ground: ["A", "D"], crank: ["A", "B"], coupler: ["B", "C"], rocker: ["D", "C"] },
};
const spot = (at, more = {}) => ({ at, over: {}, ...more });

/** What happens with a tool: presses and releases at spots, as the builder passes them on. */
function hand(document = EMPTY) {
  const own = { document, tools: makeTools(() => own.document) };
  own.take = (name) => {
    own.tool = own.tools[name];
    return own;
  };
  own.apply = (change) => {
    if (!change) return own;
    const { document: made, joint } = change(own.document);
    own.document = made;
    own.tool.done(joint, made.joints[joint]);
    return own;
  };
  own.click = (one) => {
    own.tool.down(one);
    return own.apply(own.tool.up(one, false));
  };
  own.drag = (from, to) => {
    if (own.tool.drags) own.tool.down(from);
    own.tool.move(to);
    return own.apply(own.tool.up(to, true));
  };
  return own;
}

test("clicks chain links, and a click at the last joint ends the chain", () => {
  const own = hand().take("link").click(spot([0, 0])).click(spot([0, 1]));
  assert.deepEqual(own.document.links, { ground: [], link1: ["A", "B"] });
  own.click(spot([4, 3]));
  assert.deepEqual(own.document.links.link2, ["B", "C"]);
  assert.ok(own.tool.isBegun);
  own.click(spot([4, 3], { joint: "C" }));
  assert.ok(!own.tool.isBegun);
  own.click(spot([5, 0])).click(spot([4, 3], { joint: "C" }));
  assert.deepEqual(own.document.links.link3, ["D", "C"]);
});

test("a drag is one link and no chain; a press without a way is nothing", () => {
  const own = hand().take("link").drag(spot([0, 0]), spot([1, 0]));
  assert.deepEqual(own.document.links.link1, ["A", "B"]);
  assert.ok(!own.tool.isBegun);
  own.drag(spot([1, 0], { joint: "B" }), spot([1, 0], { joint: "B" }));
  assert.deepEqual(Object.keys(own.document.links), ["ground", "link1"]);
  // A pair that a link has already gets no second one.
  own.drag(spot([1, 0], { joint: "B" }), spot([0, 0], { joint: "A" }));
  assert.deepEqual(Object.keys(own.document.links), ["ground", "link1"]);
});

test("a link that ends on another gets a joint of it", () => {
  const own = hand(FOUR).take("link").drag(spot([2, 2], { link: "coupler" }), spot([2, 5]));
  assert.deepEqual(own.document.links.coupler, ["B", "C", "E"]);
  assert.deepEqual(own.document.links.link1, ["E", "F"]);
  assert.deepEqual(own.document.joints.E, [2, 2]);
});

test("a plate closes at its first joint or by Enter; a link gets a further point", () => {
  const own = hand().take("plate").click(spot([0, 0])).click(spot([1, 0])).click(spot([0, 1])).click(spot([0, 0]));
  assert.deepEqual(own.document.links.link1, ["A", "B", "C"]);
  own.click(spot([0, 0], { joint: "A" })).click(spot([3, 3])).click(spot([4, 4])).apply(own.tool.enter());
  assert.deepEqual(own.document.links.link2, ["A", "D", "E"]);
  const other = hand(FOUR).take("plate").click(spot([2, 2], { link: "coupler" })).click(spot([1, 3]));
  assert.deepEqual(other.document.links.coupler, ["B", "C", "E"]);
  assert.deepEqual(other.document.joints.E, [1, 3]);
  assert.ok(!other.tool.isBegun);
});

test("a joint slides along the direction that is dragged; one of the ground is freed", () => {
  const own = hand(FOUR).take("slide").drag(spot([5, 0], { joint: "D" }), spot([9, 0.02]));
  assert.deepEqual(own.document.links.ground, ["A"]);
  assert.deepEqual(own.document.links.block1, ["D"]);
  assert.deepEqual(own.document.slides.slide1, { link: "block1", on: "ground", angle: 0, origin: "A" });
  const free = hand(FOUR).take("slide").drag(spot([4, 3], { joint: "C" }), spot([5, 3.3], { isFree: true }));
  assert.ok(Math.abs(free.document.slides.slide1.angle - Math.atan2(0.3, 1)) < 1e-12);
});

test("from a link the joint slides on it, along its nearest side", () => {
  const joints = { ...FOUR.joints, P: [1, 5], Q: [3, 5] };
  const own = hand({ ...FOUR, joints, links: { ...FOUR.links, coupler: ["B", "C", "P"] } }).take("slide");
  own.drag(spot([2.4, 4.1], { link: "coupler" }), spot([3, 5], { joint: "Q" }));
  assert.deepEqual(own.document.slides.slide1, { link: "block1", on: "coupler", along: ["C", "P"], origin: "C" });
  assert.deepEqual(own.document.links.block1, ["Q"]);
  // Not a joint of that very link.
  const same = hand(FOUR).take("slide").drag(spot([2, 2], { link: "coupler" }), spot([4, 3], { joint: "C" }));
  assert.equal(same.document, FOUR);
});

test("cylinders, ground, driver", () => {
  const own = hand(FOUR).take("cylinder").drag(spot([0, 1], { joint: "B" }), spot([5, 0], { joint: "D" }));
  assert.deepEqual(own.document.slides.cylinder1, { base: "B", end: "D" });
  const atB = spot([0, 1], { joint: "B" });
  assert.equal(hand(FOUR).take("cylinder").drag(atB, atB).document, FOUR);
  own.take("ground").click(spot([5, 0], { joint: "D" }));
  assert.deepEqual(own.document.links.ground, ["A"]);
  own.click(spot([7, 7]));
  assert.deepEqual(own.document.links.ground, ["A", "E"]);
  // A drag pans: it fixes nothing.
  own.drag(spot([5, 0], { joint: "D" }), spot([6, 0]));
  assert.deepEqual(own.document.links.ground, ["A", "E"]);
  own.take("driver").click(spot([0, 1], { over: { link: "rocker" } }));
  assert.equal(own.document.driver, "rocker");
  own.click(spot([0, 1], { over: { link: "crank" }, isMore: true }));
  assert.deepEqual(own.document.driver, ["rocker", "crank"]);
  own.click(spot([0, 1], { over: { link: "rocker" } }));
  assert.equal(own.document.driver, "crank");
  // A cylinder is driven by its slide.
  own.click(spot([2, 1], { over: { link: "cylinder1_rod" } }));
  assert.equal(own.document.driver, "cylinder1");
});

test("what is removed: a joint before a slide before a link", () => {
  const slid = steps.slideOnGround(FOUR, { joint: "C" }, 0);
  assert.deepEqual(itemUnder(slid, { joint: "C", link: "crank" }), { kind: "joint", name: "C" });
  assert.deepEqual(itemUnder(slid, { link: "block1" }), { kind: "slide", name: "slide1" });
  assert.deepEqual(itemUnder(slid, { link: "crank" }), { kind: "link", name: "crank" });
  assert.equal(itemUnder(slid, {}), null);
  const own = hand(slid).take("remove").click(spot([4, 3], { over: { link: "block1" } }));
  assert.deepEqual(own.document.links, FOUR.links);
  own.click(spot([0, 1], { over: { link: "coupler" } }));
  assert.deepEqual(Object.keys(own.document.links), ["ground", "crank", "rocker"]);
});

test("a tool forgets what is gone", () => {
  const own = hand(FOUR).take("link").click(spot([4, 3], { joint: "C" }));
  own.tool.forget((name) => name !== "D");
  assert.ok(own.tool.isBegun);
  own.tool.forget((name) => name !== "C");
  assert.ok(!own.tool.isBegun);
});

test("guides go to whole 15° if they are near, else to whole degrees", () => {
  const degree = Math.PI / 180;
  const to = (angle) => [1 + Math.cos(angle), 1 + Math.sin(angle)];
  const towards = (angle, isFree) => steps.guideDirection([1, 1], to(angle), isFree) / degree;
  assert.ok(Math.abs(towards(32 * degree) - 30) < 1e-9);
  assert.ok(Math.abs(towards(37.3 * degree) - 37) < 1e-9);
  assert.ok(Math.abs(towards(37.3 * degree, true) - 37.3) < 1e-9);
});

test("the checklist tells what is there", () => {
  const done = (document, counted = { mobility: 1 }) => checklist(document, counted).map(({ isDone }) => isDone);
  assert.deepEqual(done(FOUR), [true, true, true, true]);
  assert.deepEqual(done(EMPTY, { mobility: 0 }), [false, false, true, false]);
  const joints = { ...FOUR.joints, E: [9, 9], F: [8, 8] };
  const lone = { ...FOUR, joints, links: { ...FOUR.links, lost: ["E", "F"] } };
  assert.deepEqual(linksApart(lone), ["lost"]);
  assert.deepEqual(linksApart(steps.cylinderBetween(lone, { joint: "E" }, { joint: "C" })), []);
  const slid = steps.slideOnGround({ ...lone, driver: ["crank", "lost"] }, { joint: "E" }, 1);
  assert.deepEqual(linksApart(slid), []);
  const last = { key: "checkMobility", isDone: true, detail: { mobility: 2, needed: 2 } };
  assert.deepEqual(checklist(slid, { mobility: 2 })[3], last);
});

test("why it stands, in the words of the page", () => {
  const held = { state: "stuck", reason: "immovable", message: "…", concerned: { links: ["a", "b", "c"] } };
  assert.equal(whyItStands(held, FOUR), "whyStuck");
  const undriven = { state: "no_driver", message: "m", candidates: [] };
  assert.equal(whyItStands(undriven, EMPTY), "whyNoLink");
  assert.equal(whyItStands(undriven, { ...FOUR, links: { ...FOUR.links, ground: [] } }), "whyNoGround");
  assert.equal(whyItStands(undriven, FOUR), "m");
  assert.equal(whyItStands({ state: "stuck", reason: "almost_fits", message: "by 3 mm" }, FOUR), "by 3 mm");
  assert.equal(listedNames(["a"]), "a");
});

test("Tab goes through joints, links and slides, each told with what it is on", () => {
  const slid = steps.slideOnGround(FOUR, { joint: "C" }, 0);
  assert.equal(itemsOf(slid).map(({ name }) => name).join(), "A,B,C,D,crank,coupler,rocker,slide1");
  assert.deepEqual(neighboursOf(slid, { kind: "joint", name: "C" }), ["coupler", "rocker", "block1"]);
  assert.deepEqual(neighboursOf(slid, { kind: "slide", name: "slide1" }), ["block1", "ground"]);
});
