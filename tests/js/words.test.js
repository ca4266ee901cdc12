import assert from "node:assert/strict";
import { readdirSync } from "node:fs";
import test from "node:test";
import { learn, say, speak } from "../../python/assur/pictures/page/words.js";

const folder = new URL("../../python/assur/studio/page/words/", import.meta.url);
const tables = [];
for (const name of readdirSync(folder).sort()) tables.push(...Object.values(await import(new URL(name, folder))));
const LANGUAGES = ["de", "ru", "uk"];
const fields = (text) => (text.match(/\{\w+\}/g) ?? []).sort().join();

test("every text is there in every language, with the same values", () => {
  for (const table of tables) {
    const own = table.en ?? Object.fromEntries(Object.keys(table.de).map((key) => [key, say(key)]));
    for (const code of LANGUAGES) {
      assert.deepEqual(Object.keys(table[code]).sort(), Object.keys(own).sort());
      for (const key in own) assert.equal(fields(table[code][key]), fields(own[key]), `${code} ${key}`);
    }
  }
});

test("no two parts of the page give one key different texts", () => {
  const known = {};
  for (const { en = {} } of tables) {
    for (const key in en) {
      assert.ok(!(key in known) || known[key] === en[key], key);
      known[key] = en[key];
    }
  }
});

test("a language that lacks a text falls back to English", () => {
  for (const table of tables) learn(table);
  speak("de");
  assert.equal(say("mobility", { n: 1 }), "Laufgrad 1");
  assert.equal(say("vx"), "vx");
  speak("en");
  assert.equal(say("mobility", { n: 1 }), "mobility 1");
});
