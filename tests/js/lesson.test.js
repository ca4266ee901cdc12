import assert from "node:assert/strict";
import test from "node:test";
import { LessonClock, SupportSpeed } from "../../python/assur/studio/page/lesson/clock.js";
import { blockedWithin, turnedTable } from "../../python/assur/studio/page/lesson/curves.js";
import { lengthText, readTyped, turnText, typedText } from "../../python/assur/studio/page/lesson/entries.js";
import { barRange } from "../../python/assur/studio/page/lesson/ground_bar.js";
import { LESSON_WORDS } from "../../python/assur/studio/page/lesson/lesson_words.js";
import { LessonMotion, withinTurn } from "../../python/assur/studio/page/lesson/motion.js";
import { lessonRequest, neighbours, scaledDesign } from "../../python/assur/studio/page/lesson/requests.js";
import { plainText, symbolPieces } from "../../python/assur/studio/page/lesson/symbols.js";
import { reachable } from "../../python/assur/studio/page/lesson/travel.js";

const TURN = 2 * Math.PI;

test("what is typed: numbers, fractions, units, commas and a true minus", () => {
  const cases = [
    ["4.5", "ratio", 4.5],
    [" 9/2 ", "ratio", 4.5],
    ["1,5", "ratio", 1.5],
    ["12 cm", "length", 0.12],
    ["−60", "degrees", -Math.PI / 3],
    ["90°", "rad", Math.PI / 2],
    ["1e-3", "number", 1e-3],
    ["60 rpm", "speed", TURN],
  ];
  for (const [text, kind, value] of cases) assert.ok(Math.abs(readTyped(text, kind).value - value) < 1e-12, text);
  const wrong = ["", "abc", "NaN", "Infinity", "1/0", "1 2", "12 cm 3", "1e999", "--1"];
  for (const text of wrong) assert.ok(readTyped(text, "length").error, text);
  assert.ok(readTyped("12 cm", "ratio").error);
});

test("what is shown can be typed again", () => {
  for (const value of [1, 4.995, 4.9775, 0.2, -1.5, 123.456, 1e-4]) {
    assert.ok(Math.abs(readTyped(typedText(value, "number"), "number").value - value) <= 1e-3 * Math.abs(value));
    assert.ok(Math.abs(readTyped(lengthText(value), "ratio").value - value) <= 1e-4 * Math.abs(value));
  }
  assert.equal(lengthText(1), "1.000");
  assert.equal(lengthText(4.98136), "4.9814");
  assert.equal(turnText(-Math.PI / 3), "300°");
  assert.equal(turnText(TURN - 1e-9), "0°");
});

test("where C is jammed and the support held the crank stops, at either end", () => {
  const stretches = [
    { start: -0.2, end: 0.2, side: "outer" },
    { start: 0.2, end: TURN - 0.2, side: null },
  ];
  const near = (found, to, isStopped) => {
    assert.ok(Math.abs(found.to - to) < 1e-9, `${found.to} is not ${to}`);
    assert.equal(found.isStopped, isStopped);
  };
  near(reachable(stretches, 1, 2), 2, false);
  near(reachable(stretches, -1, 0), -0.2, true);
  // Also of another turn, over the whole of it, and backwards.
  near(reachable(stretches, 2 * TURN - 1, 2 * TURN + 1), 2 * TURN - 0.2, true);
  near(reachable(stretches, 1, -1), 0.2, true);
  // From the end it goes back, not on.
  near(reachable(stretches, -0.2, -0.1), -0.2, true);
  near(reachable(stretches, -0.2, 1), -0.2, true);
  near(reachable(stretches, -0.2, -0.3), -0.3, false);
  near(reachable(stretches, 0.2, 0.3), 0.3, false);
  near(reachable(stretches, 0.2, 0.1), 0.2, true);
  // Put in the middle it stays there.
  near(reachable(stretches, 0, 0.1), 0, true);
});

test("the speed of the support is that of the last 50 ms", () => {
  const speed = new SupportSpeed();
  assert.equal(speed.at(0), 0);
  // 0.5 a second from 0 s on, in steps of 4 ms.
  speed.note(4, -1e-6);
  for (let i = 1; i <= 50; i++) speed.note(4 + 0.002 * i, 0.004 * i);
  assert.ok(Math.abs(speed.at(0.2) - 0.5) < 0.05);
  // Standing for 20 ms, the rest of the window moved; after 50 ms nothing did.
  assert.ok(Math.abs(speed.at(0.22) - 0.3) < 0.05);
  assert.equal(speed.at(0.26), 0);
  speed.clear();
  assert.equal(speed.at(0.26), 0);
});

test("the clock takes no step longer than 0.1 s, and none before its first frame", () => {
  let waiting = null;
  const steps = [];
  const clock = new LessonClock((seconds) => steps.push(seconds), {
    request: (frame) => ((waiting = frame), 1),
    cancel: () => (waiting = null),
    now: () => 0,
  });
  clock.start();
  for (const now of [1000, 1016, 9000]) waiting(now);
  assert.deepEqual(steps, [0, 0.016, 0.1]);
  clock.stop();
  assert.equal(waiting, null);
  assert.ok(!clock.isRunning);
});

/** A motion made up: coupler and rocker turn evenly, and D slides in the first stretch. */
function motion() {
  const rows = 5;
  const stretches = [
    { start: -0.5, end: 0.5, side: "outer", rod: 3 },
    { start: 0.5, end: TURN - 0.5, side: null, rod: null },
  ];
  const frames = stretches.flatMap(({ start, end, side }) => {
    const at = (i) => start + ((end - start) * i) / (rows - 1);
    const row = (phi) => [0, 0, phi, 0, 0, 0.5, side ? -3 : -4, 0, 1.5, side ? -3 : -4, 0, 0];
    const first = [0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    const all = Array.from({ length: rows }, (_, i) => i);
    const second = new Array(rows * first.length).fill(0);
    return [...all.flatMap((i) => row(at(i))), ...all.flatMap(() => first), ...second];
  });
  const byGround = Float64Array.from({ length: 2 * rows * 2 }, (_, i) => (i < 2 * rows ? 0 : 0.25));
  const arrays = { frames: Float64Array.from(frames), by_ground: byGround };
  const header = { stretches, position: { by_ground: { coupler: [0.5, 2], rocker: [0.5, 2] } } };
  return new LessonMotion({ header, arrays }, { l1: 1, l2: 2, l3: 1.5, l4: 4, phi1: 1, speed: 2, start: 0 });
}

test("a motion is sampled in its stretch, around and around", () => {
  const own = motion();
  for (const turn of [-2, 0, 3]) {
    assert.equal(own.figures(own.sample(0.1 + turn * TURN)).l4, 3);
    assert.equal(own.figures(own.sample(1 + turn * TURN)).l4, 4);
    assert.equal(own.sample(1 + turn * TURN).stretch.side, null);
  }
  // Where one stretch ends and another begins the crank is where it should be.
  for (const edge of [own.low, 0.5, own.high, own.high + 0.5]) {
    for (const q of [edge - 1e-15, edge, edge + 1e-15, edge + 1e-9]) {
      const angle = own.sample(q).value[5];
      assert.ok(Math.abs(Math.sin((angle - q) / 2)) < 1e-9, `${angle} is not ${q}`);
    }
  }
  const { gamma } = own.figures(own.sample(1));
  assert.ok(Math.abs(gamma - 1) < 1e-12);
  // What swings only: the rest is not there.
  assert.ok(!own.swinging.sample(0.1).known);
  assert.ok(own.swinging.sample(1).known);
});

test("a support that is dragged turns the links and moves D", () => {
  const own = motion();
  const still = own.sample(1);
  const moved = own.sample(1, own.pose(), 0.1);
  const COUPLER = 8;
  assert.ok(Math.abs(moved.d1[COUPLER] - still.d1[COUPLER] - 0.025) < 1e-12);
  assert.ok(Math.abs(moved.d2[COUPLER] - (2 * 0.5 * 0.1 + 2 * 0.01)) < 1e-12);
  assert.ok(Math.abs(own.points(moved).D.x1 + 0.1) < 1e-12);
  // While D slides it is the rod that moves it.
  assert.equal(own.points(own.sample(0.1, own.pose(), 0.1)).D.x1, 0);
});

test("intervals and tables of the turn that is shown", () => {
  const stretches = [{ start: -0.2, end: 0.2, side: "outer" }, { start: 0.2, end: TURN - 0.2, side: null }];
  const close = (found, wanted) => found.flat().forEach((x, i) => assert.ok(Math.abs(x - wanted.flat()[i]) < 1e-12));
  close(blockedWithin(stretches, -1), [[-0.2, 0.2]]);
  // Cut at both ends.
  close(blockedWithin(stretches, 0), [[0, 0.2], [TURN - 0.2, TURN]]);
  assert.equal(blockedWithin(stretches, 0).length, 2);
  const values = Float64Array.from({ length: 361 }, (_, i) => Math.cos((i * TURN) / 360));
  for (const [angle, value] of turnedTable(values, -1.234)) assert.ok(Math.abs(value - Math.cos(angle)) < 1e-4);
  assert.ok(Math.abs(withinTurn(-1, 0) - (TURN - 1)) < 1e-12);
});

test("grounds that are compared: those of the paper", () => {
  assert.deepEqual(neighbours({ l1: 1, l2: 4.5, l3: 1.5, l4: 4.995 }), [4.95, 4.9, 4.85, 4.8]);
  // Of one that does not turn, those that do.
  assert.deepEqual(neighbours({ l1: 1, l2: 4.5, l3: 1.5, l4: 5.2 }), [4.95, 4.9, 4.85, 4.8]);
  assert.deepEqual(neighbours({ l1: 1, l2: 4.5, l3: 1.5, l4: 3 }), [4.05, 4.1, 4.15, 4.2]);
  assert.equal(neighbours({ l1: 1, l2: 1, l3: 1, l4: 1 }), null);
});

test("requests have γmin or friction; designs change their unit", () => {
  const design = { l1: 2, l2: 9, l3: 3, l4: 9.9, start: 0, speed: 2, least: 0.2, friction: null };
  assert.equal(lessonRequest(design, 1, 0).gamma_min, 0.2);
  const rubbing = { ...design, friction: { f_c: 0.1, r_c: 1, f_d: 0.2, r_d: 2 } };
  assert.ok(!("gamma_min" in lessonRequest(rubbing, 1, 0)));
  const half = scaledDesign(rubbing, 0.5);
  assert.deepEqual([half.l1, half.l4, half.friction.r_d, half.friction.f_d, half.least], [1, 4.95, 1, 0.2, 0.2]);
});

test("the bar shows l4 wherever it is", () => {
  const header = { turning_range: [4, 5], ground_range: [4.05, 4.98] };
  for (const l4 of [0.1, 4.5, 9]) {
    const [low, high] = barRange(header, l4);
    assert.ok(low > 0 && low <= l4 && high >= l4);
  }
  const [low, high] = barRange({ turning_range: null, ground_range: null }, 2);
  assert.ok(low < 2 && high > 2);
});

test("symbols stand apart from words", () => {
  assert.equal(plainText("$C jams below γ_min; l_4 = 1, φ_1"), "C jams below γmin; l4 = 1, φ1");
  assert.deepEqual(symbolPieces("speed ω"), [{ plain: "speed " }, { symbol: "ω", below: "" }]);
  // Not within a word.
  assert.deepEqual(symbolPieces("γωνία"), [{ plain: "γωνία" }]);
});

test("every language says everything, with the same symbols and values", () => {
  const marks = (text) => [...text.matchAll(/\{\w+\}/g)].map(String).sort().join();
  const { en, ...others } = LESSON_WORDS;
  for (const [language, words] of Object.entries(others)) {
    assert.deepEqual(Object.keys(words).sort(), Object.keys(en).sort(), language);
    for (const key in en) assert.equal(marks(words[key]), marks(en[key]), `${language} ${key}`);
  }
});
