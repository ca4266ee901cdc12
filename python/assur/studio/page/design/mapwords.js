// A map in words: its values, what is at a place, and the whole of it in a sentence.

import { digits } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { mapExtremes, nearestIndex } from "./cells.js";
import { reasonText } from "./metrics.js";
import { dimensionText, unitShown, valueText } from "./ranges.js";

export class MapWords {
  /** @param {import("../model/model.js").Model} model */
  constructor(model) {
    this.model = model;
    /** The map that is shown, with `names` of its dimensions and the metric `chosen`. */
    this.grid = null;
  }

  #unitOf(name) {
    return this.model.dimensions.find((one) => one.name === name)?.unit ?? "m";
  }

  /** The unit in which a dimension is shown. */
  unit(name) {
    return unitShown(this.model.data, this.#unitOf(name));
  }

  get valueUnit() {
    const { unit } = this.grid.chosen;
    return unit ? unitShown(this.model.data, unit) : { name: "", factor: 1 };
  }

  /** Write a value of the metric, SI. */
  value(value, write = digits) {
    const { name, factor } = this.valueUnit;
    if (this.grid.chosen.spec.metric === "reachable") return say(value ? "turnsRound" : "doesNotTurn");
    return `${write(value * factor)}${name === "°" || !name ? "" : " "}${name}`;
  }

  #place(...values) {
    const { data } = this.model;
    const write = (name, i) => `${dimensionText(name)} ${valueText(data, values[i], this.#unitOf(name))}`;
    return this.grid.names.map(write).join(", ");
  }

  /** What the map has at two values. */
  at(x, y) {
    const { grid } = this;
    const i = nearestIndex(grid.y, y) * grid.x.length + nearestIndex(grid.x, x);
    const value = grid.value[i];
    const why = () => reasonText(grid.reasons[grid.reason[i] - 1] ?? "no value");
    const text = Number.isFinite(value) ? this.value(value) : why();
    return `${this.#place(x, y)}: ${text}`;
  }

  /** The map for those who do not see it. */
  sentence() {
    const { grid } = this;
    const n = grid.x.length;
    const { least, greatest, without } = mapExtremes(grid.value);
    const place = (i) => this.#place(grid.x[i % n], grid.y[Math.floor(i / n)]);
    const what = grid.chosen.text;
    const part = Math.round((100 * without) / grid.value.length);
    const missing = without ? say("mapWithout", { part, why: grid.reasons.map(reasonText).join(", ") }) : "";
    if (least < 0) return `${what}. ${missing}`;
    const values = { what, least: this.value(grid.value[least]), greatest: this.value(grid.value[greatest]) };
    return `${say("mapSentence", { ...values, leastAt: place(least), greatestAt: place(greatest) })} ${missing}`.trim();
  }
}
