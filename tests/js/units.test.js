import assert from "node:assert/strict";
import test from "node:test";
import { learn, say } from "../../python/assur/pictures/page/words.js";
import { FIELD_WORDS } from "../../python/assur/studio/page/words/fields.js";
import { parseQuantity, usualUnit, writeQuantity, writeWithUnit } from "../../python/assur/studio/page/document/units.js";

learn(FIELD_WORDS);

const TURN = 2 * Math.PI;

test("quantities as they are typed", () => {
  const cases = [
    ["12 cm", "m", "mm", 0.12],
    ["12cm", "m", "mm", 0.12],
    ["83", "m", "mm", 0.083],
    ["1/3", "m", "m", 1 / 3],
    ["1/3", "m", "mm", 1 / 3 / 1000],
    ["3,5 mm", "m", "m", 0.0035],
    ["−2", "m", "m", -2],
    ["-2", "m", "m", -2],
    ["– 2 mm", "m", "m", -0.002],
    ["1e-3", "m", "m", 0.001],
    ["1E−3", "m", "m", 0.001],
    [".5", "m", "m", 0.5],
    ["5.", "m", "m", 5],
    ["+0.2 M", "m", "mm", 0.2],
    ["3\u00a0µm", "m", "mm", 3e-6],
    ["3 μm", "m", "mm", 3e-6],
    ["1 in", "m", "mm", 0.0254],
    ["3/4 in", "m", "mm", (0.75 * 127) / 5000],
    ["30°", "rad", "°", TURN / 12],
    ["30 deg", "rad", "rad", TURN / 12],
    ["30", "rad", "°", TURN / 12],
    ["0.5 turn", "rad", "°", TURN / 2],
    ["1/4 turn", "rad", "°", TURN / 4],
    ["pi/3", "rad", "°", Math.PI / 3],
    ["2 pi / 3", "rad", "°", TURN / 3],
    ["−2π/3", "rad", "°", -TURN / 3],
    ["2*pi", "", "", TURN],
    ["15 %", "", "", 0.15],
    ["250 g", "kg", "kg", 0.25],
    ["3 kg m^2", "kg·m²", "kg·m²", 3],
    ["3 kgm2", "kg·m²", "kg·m²", 3],
    ["20 kg*cm²", "kg·m²", "kg·m²", 0.002],
    ["2 kN", "N", "N", 2000],
    ["8 Nm", "N·m", "N·m", 8],
    ["8 N.mm", "N·m", "N·m", 0.008],
    ["60 rpm", "rad/s", "rad/s", TURN],
    ["60 1/min", "rad/s", "rad/s", TURN],
    ["60/min", "rad/s", "rad/s", TURN],
    ["60 min⁻¹", "rad/s", "rad/s", TURN],
    ["60 min^-1", "rad/s", "rad/s", TURN],
    ["60 RPM", "rad/s", "rad/s", TURN],
    ["60 U/min", "rad/s", "rad/s", TURN],
    ["60 об/мин", "rad/s", "rad/s", TURN],
    ["60 об/хв", "rad/s", "rad/s", TURN],
    ["2 Hz", "rad/s", "rad/s", 2 * TURN],
    ["2 rev/s", "rad/s", "rad/s", 2 * TURN],
    ["2 deg/s", "rad/s", "rad/s", TURN / 180],
    ["−3,5", "rad/s", "rad/s", -3.5],
    ["30 mm/min", "m/s", "m/s", 0.0005],
    ["36 km/h", "m/s", "m/s", 10],
    ["90°/s", "rad/s", "rad/s", TURN / 4],
    ["5 mm/s", "m/s", "m/s", 0.005],
    ["20 ms", "s", "s", 0.02],
    ["2 bar", "Pa", "Pa", 2e5],
    ["0", "m", "mm", 0],
    ["0/5", "m", "mm", 0],
  ];
  for (const [text, unit, shown, value] of cases) {
    const found = parseQuantity(text, unit, shown);
    assert.ok(Math.abs(found.value - value) <= 1e-15 * Math.abs(value), `${text}: ${JSON.stringify(found)}, not ${value}`);
  }
});

test("what is no quantity is refused with a reason", () => {
  const cases = [
    ["", "m", "emptyField"],
    ["  ", "m", "emptyField"],
    [null, "m", "emptyField"],
    ["abc", "m", "notALength"],
    ["abc", "rad", "notAnAngle"],
    ["abc", "kg", "notANumber"],
    ["abc", "rad/s", "notASpeed"],
    ["abc", "m/s", "notASpeed"],
    ["30 rad", "rad/s", "notAUnitHere"],
    ["30 m/s", "rad/s", "notAUnitHere"],
    ["30 rpm", "m/s", "notAUnitHere"],
    ["mm", "m", "notALength"],
    ["NaN", "m", "notALength"],
    ["Infinity", "m", "notALength"],
    ["-", "m", "notALength"],
    ["--2", "m", "notALength"],
    ["2 + 3", "m", "notALength"],
    ["1.2.3", "m", "notALength"],
    ["1,234.5", "m", "notALength"],
    ["1 000", "m", "notALength"],
    ["1/", "m", "notALength"],
    ["1/-2", "m", "notALength"],
    ["0x10", "m", "notAUnitHere"],
    ["12 abc", "m", "notAUnitHere"],
    ["30°", "m", "notAUnitHere"],
    ["30 mm", "rad", "notAUnitHere"],
    ["30 constructor", "m", "notAUnitHere"],
    ["1e", "m", "notAUnitHere"],
    ["1/0", "m", "dividedByZero"],
    ["0/0", "m", "dividedByZero"],
    ["pi/0.0 mm", "m", "dividedByZero"],
    ["1e999", "m", "tooLargeNumber"],
    ["1e308 km", "m", "tooLargeNumber"],
    ["pi*1e308*1e10", "", "tooLargeNumber"],
  ];
  for (const [text, unit, error] of cases) {
    const found = parseQuantity(text, unit, unit === "m" ? "mm" : unit);
    assert.equal(found.error, error, `${text}: ${JSON.stringify(found)}`);
    const sentence = say(found.error, found.values);
    assert.ok(sentence !== error && !sentence.includes("{"), sentence);
  }
  const { error, values } = parseQuantity(" abc", "m", "mm");
  const kept = say("pictureKeeps", { kept: writeWithUnit(0.12, "m", "mm") });
  assert.equal(`${say(error, values)} ${kept}`, "“abc” is not a length. The picture keeps 120 mm.");
});

test("what is written is read again as the same number, but for a last digit of units with π", () => {
  for (const [unit, shown] of [["m", "mm"], ["m", "m"], ["rad", "°"], ["rad", "rad"], ["kg·m²", "kg·cm²"], ["rad/s", "rpm"]]) {
    for (let i = 0; i < 400; i++) {
      const value = Math.sin(i * 12.9898) * 10 ** ((i % 13) - 6);
      const text = writeQuantity(value, unit, shown);
      const read = parseQuantity(text, unit, shown).value;
      assert.ok(Math.abs(read - value) <= 4.5e-16 * Math.abs(value), `${text}: ${read}, not ${value}`);
    }
  }
  for (let i = 1; i < 2000; i++) assert.equal(writeQuantity(Number(`${i}e-3`), "m", "mm"), String(i));
});

test("numbers have a true minus, and as many digits as asked for", () => {
  assert.equal(writeQuantity(-0.12, "m", "mm"), "−120");
  assert.equal(writeQuantity(-1 / 3, "m", "mm", 3), "−333");
  assert.equal(writeQuantity(0.12, "m", "mm", 4), "120.0");
  assert.equal(writeQuantity(Math.PI / 3, "rad", "°"), "60");
  assert.equal(writeWithUnit(Math.PI / 3, "rad", "°"), "60°");
  assert.equal(writeWithUnit(-2, "N·m"), "−2 N·m");
  assert.equal(writeWithUnit(0.02, ""), "0.02");
  assert.equal(writeQuantity(NaN, "m", "mm"), "–");
  assert.equal(writeQuantity(0, "m", "mm"), "0");
});

test("the unit suits the size", () => {
  assert.equal(usualUnit(0.17).name, "mm");
  assert.equal(usualUnit(4).name, "m");
  assert.equal(usualUnit(0).name, "mm");
  assert.equal(usualUnit(NaN).name, "mm");
});
