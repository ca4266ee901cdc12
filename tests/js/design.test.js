import assert from "node:assert/strict";
import test from "node:test";
import { cellPaths, colourRange, COLOUR_STEPS, mapExtremes, nearestIndex, partOfSide, roomFor, stepOf, valueAtPart } from "../../python/assur/studio/page/design/cells.js";
import { deviationFrom, evenPlaces, targetOf } from "../../python/assur/studio/page/design/deviation.js";
import { metricChoices, reasonText } from "../../python/assur/studio/page/design/metrics.js";
import { designRange, dimensionText, mostUsefulFirst, roundedWithin, sliderSteps } from "../../python/assur/studio/page/design/ranges.js";
import { learn, speak } from "../../python/assur/pictures/page/words.js";
import { HELP_GESTURES, HELP_KEYS, HELP_TERMS, matchesSearch } from "../../python/assur/studio/page/help/terms.js";
import { DESIGN_WORDS } from "../../python/assur/studio/page/words/design.js";
import { HELP_WORDS } from "../../python/assur/studio/page/words/help.js";

const near = (own, wanted, tolerance) => assert.ok(Math.abs(own - wanted) <= tolerance, `${own}, not ${wanted}`);

/** A circle about a place. */
function circle(radius, n, [x, y] = [0, 0], from = 0, to = 2 * Math.PI) {
  return Array.from({ length: n + 1 }, (_, i) => {
    const angle = from + ((to - from) * i) / n;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}

test("a target circle about a circle is everywhere the difference of the radii away", () => {
  const { greatest, rms } = deviationFrom({ points: circle(3, 720).slice(1), closed: true }, [circle(2, 720)]);
  near(greatest, 1, 4e-5);
  near(rms, 1, 4e-5);
});

test("a line that leaves another at an angle: greatest at its end, rms greatest / √3", () => {
  const slope = 0.3;
  const target = { points: [[0, 0], [4 * Math.cos(slope), 4 * Math.sin(slope)]], closed: false };
  const n = 5000;
  const { greatest, rms, from, to } = deviationFrom(target, [[[-1, 0], [9, 0]]], n);
  near(greatest, 4 * Math.sin(slope), 1e-12);
  near(rms, greatest / Math.sqrt(3), 1e-3 * greatest);
  near(from[0], 4 * Math.cos(slope), 1e-12);
  near(to[1], 0, 1e-12);
});

test("a part of a path is on it, and beyond the gap of a broken path the nearer end counts", () => {
  const part = { points: circle(2, 90, [1, 1], 0.3, 1.1), closed: false };
  near(deviationFrom(part, [circle(2, 1440, [1, 1])]).greatest, 0, 2e-4);
  const broken = [[[0, 0], [1, 0]], [[3, 0], [4, 0]]];
  near(deviationFrom({ points: [[0, 0], [4, 0]], closed: false }, broken, 400).greatest, 1, 1e-12);
  assert.equal(deviationFrom(part, []), null);
});

test("places at even steps are so by the length of a line, not by its corners", () => {
  const places = evenPlaces([[0, 0], [1, 0], [1, 0], [1, 3]], 8);
  assert.equal(places.length, 9);
  places.forEach(([x, y], k) => near(x + y, k / 2, 1e-12));
});

test("what is drawn by hand loses what is too near, and is closed where its ends meet", () => {
  const drawn = circle(10, 400);
  const target = targetOf(drawn, 1, 2);
  assert.ok(target.closed);
  assert.ok(target.points.length > 50 && target.points.length < 64, String(target.points.length));
  assert.equal(targetOf(circle(10, 400, [0, 0], 0, 5), 1, 2).closed, false);
  assert.equal(targetOf([[0, 0], [0.1, 0]], 1, 2), null);
});

test("a dimension slides from half to double, an angle 60° to both sides", () => {
  assert.deepEqual(designRange({ name: "rod.length", value: 0.001, unit: "m" }, 1), [0.0005, 0.002]);
  assert.deepEqual(designRange({ name: "ground.D.x", value: -2, unit: "m" }, 1), [-4, -1]);
  assert.deepEqual(designRange({ name: "ground.A.x", value: 0, unit: "m" }, 0.08), [-0.08, 0.08]);
  const [low, high] = designRange({ name: "guide.angle", value: 0.1, unit: "rad" }, 1);
  near(((high - low) * 180) / Math.PI, 120, 1e-9);
});

test("a slider's values are round in the unit shown", () => {
  const steps = sliderSteps([0.0601, 0.2404], 1000);
  assert.deepEqual(steps, { low: 60.5, high: 240, step: 0.5 });
  assert.equal(roundedWithin(0.08337, [0.06, 0.24], 1000), 0.0835);
  assert.equal(roundedWithin(0.9, [0.06, 0.24], 1000), 0.24);
});

test("lengths of links that are not driven are offered first", () => {
  const make = (name, value, unit = "m") => ({ name, value, unit });
  const all = [make("ground.A.x", 0), make("ground.D.x", 2), make("crank.length", 1), make("guide.angle", 1, "rad"), make("rod.length", 3)];
  assert.deepEqual(mostUsefulFirst(all, ["crank"]).slice(0, 3), ["rod.length", "crank.length", "ground.D.x"]);
  assert.equal(dimensionText("rod.length"), "rod");
  assert.equal(dimensionText("ground.D.x"), "ground D.x");
});

test("colours go between round ends in seven steps, none for what has no value", () => {
  const range = colourRange(Float64Array.of(NaN, 0.02, 0.81), 100);
  assert.deepEqual(range, { low: 0, high: 90 });
  assert.equal(stepOf(NaN, range), -1);
  assert.equal(stepOf(0, range), 0);
  assert.equal(stepOf(90, range), COLOUR_STEPS - 1);
  assert.equal(stepOf(45, range), 3);
  assert.equal(colourRange(Float64Array.of(NaN), 1), null);
});

test("cells of a class are one path with their area", () => {
  const classes = [0, 0, 1, 0, 1, 1, 2, 2, 2];
  const paths = cellPaths(classes, 3, 30, 60);
  const area = (d) => [...d.matchAll(/h([\d.]+)v([\d.]+)/g)].reduce((sum, [, w, h]) => sum + w * h, 0);
  assert.deepEqual([0, 1, 2].map((own) => area(paths.get(own))), [600, 600, 600]);
  // Row 0 is the lowest.
  assert.ok(paths.get(0).startsWith("M0 40h20"));
});

test("a word goes where its class has most room, or nowhere", () => {
  const n = 9;
  const classes = Array.from({ length: n * n }, (_, i) => (i % n > 2 && Math.floor(i / n) > 1 ? -1 : 3));
  const room = roomFor(classes, n, -1, 2, 1);
  assert.equal(room.column, 6);
  // Of rows 2 to 8 five are about it.
  assert.ok(room.row >= 4.5 && room.row <= 6.5, String(room.row));
  assert.equal(roomFor(classes, n, -1, 7, 1), null);
});

test("a value and its place along the side tell each other", () => {
  const values = Float64Array.from({ length: 41 }, (_, i) => 2 + i / 10);
  for (const own of [2, 3.14, 6]) near(valueAtPart(values, partOfSide(values, own)), own, 1e-12);
  assert.equal(valueAtPart(values, -1), 2);
  assert.equal(nearestIndex(values, 3.14), 11);
  assert.deepEqual(mapExtremes(Float64Array.of(NaN, 2, -1, 5)), { least: 2, greatest: 3, without: 1 });
});

test("metrics are those of the mechanism, the transmission angle first", () => {
  const data = { links: ["ground", "crank", "rod", "ram"], driven: [1], driver: "crank", slides: [{ name: "bore" }], diagrams: ["bore", "bore.v"], paths: ["B"] };
  const ids = metricChoices(data, { bore: 1 }, true).map((one) => one.id);
  assert.deepEqual(ids.slice(0, 4), ["min_transmission_angle bore", "span bore", "span rod", "span ram"]);
  assert.ok(ids.includes("reachable") && ids.includes("deviation B") && !ids.includes("span crank"));
  assert.ok(!metricChoices(data, {}, false).some((one) => one.isWhole));
  learn(DESIGN_WORDS);
  speak("de");
  assert.equal(reasonText("crank stops"), "crank bleibt stehen");
  assert.equal(reasonText("the driver stops"), "Antriebsglied bleibt stehen");
  assert.equal(reasonText("cannot be assembled"), "nicht montierbar");
  speak("en");
  assert.equal(reasonText("singular"), "singular");
});

test("all languages have the same words, with the same values in them", () => {
  for (const words of [DESIGN_WORDS, HELP_WORDS]) {
    const values = (text) => [...text.matchAll(/\{\w+\}/g)].map(String).sort().join();
    for (const code of ["de", "ru", "uk"]) {
      assert.deepEqual(Object.keys(words[code]).sort(), Object.keys(words.en).sort());
      for (const key in words.en) {
        assert.equal(values(words[code][key]), values(words.en[key]), `${code} ${key}`);
        assert.ok(words[code][key].trim(), `${code} ${key}`);
      }
    }
  }
});

test("all that the help lists has words", () => {
  const upper = (id) => id[0].toUpperCase() + id.slice(1);
  const keys = [
    ...HELP_TERMS.flatMap(({ id }) => [`help${upper(id)}`, `help${upper(id)}Text`]),
    ...HELP_GESTURES.flatMap((one) => [`helpDo${one}`, `helpWhat${one}`]),
    ...HELP_KEYS.map(([, one]) => `helpKey${one}`),
  ];
  assert.equal(new Set(keys).size, keys.length);
  assert.deepEqual(keys.filter((key) => !HELP_WORDS.en[key]), []);
});

test("the search of the help takes words in any order, without accents and case", () => {
  assert.ok(matchesSearch("Übertragungswinkel γ im Gelenk", "gelenk uber"));
  assert.ok(matchesSearch("Dead point", ""));
  assert.ok(!matchesSearch("Dead point", "dead line"));
});
