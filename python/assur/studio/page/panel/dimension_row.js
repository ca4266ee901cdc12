// One dimension: its field, why a value is not taken, and what it does to the output.

import { html, icon, write } from "../../../pictures/page/elements.js";
import { digits } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { parseQuantity } from "../document/units.js";
import { dimensionLabel } from "./dimensions_of.js";
import { signed } from "./outputs.js";
import { fieldText, keeping, stepped } from "./steps.js";

const BACK = "M9 7L4 12l5 5M4 12h10a5 5 0 0 1 0 10h-2";

/** Steps that follow each other sooner are one step of undo, ms. */
const STEPS_END_AFTER = 500;
/** Effects that are less are rounding: their numbers are written as 0. */
const LEAST_EFFECT = 1e-12;

export class DimensionRow {
  #written = "";
  #ending = 0;

  /**
   * @param {string} name of the dimension
   * @param {string} unit "m" or "rad"
   * @param {{apply: (name: string, value: number | null) => void, step: (name: string, value: number) => void,
   *   settle: (row: DimensionRow) => void, restore: () => void}} on
   */
  constructor(name, unit, on) {
    Object.assign(this, { name, unit, on, value: NaN, isStepping: false });
    const id = `dimension-${name.replace(/[^\w-]/g, "-")}`;
    const { owner, joint, word } = dimensionLabel(name);
    const label = html("label", { class: "dimension-name", for: id, title: name }, owner);
    if (joint) label.append(owner ? " " : "", html("i", { class: "name" }, joint));
    const isAxis = ["x", "y"].includes(word);
    const last = word && !isAxis ? say(`dimension_${word}`) : word;
    if (word) label.append(" ", isAxis ? html("i", { class: "name" }, word) : last);
    const plain = [owner, joint, last].filter(Boolean).join(" ");
    this.field = html("input", {
      ...{ id, class: "number", type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false" },
      ...{ "aria-label": plain, "aria-describedby": `${id}-error` },
    });
    this.unitText = html("span", { class: "unit" });
    const back = say("toDrawn", { name: plain });
    this.back = html("button", { type: "button", class: "reset", title: back, "aria-label": back }, icon(BACK));
    this.effect = html("span", { class: "effect" });
    this.bar = html("i");
    this.error = html("p", { class: "field-error", id: `${id}-error`, role: "alert", hidden: "" });
    const quantity = html("span", { class: "quantity" }, this.field, this.unitText);
    const bar = html("span", { class: "effect-bar" }, this.bar);
    this.element = html("div", { class: "dimension", "data-dimension": name });
    this.element.append(label, this.back, quantity, this.effect, bar, this.error);
    this.#listen();
  }

  #listen() {
    const { field, on } = this;
    field.addEventListener("focus", () => {
      this.#write(true);
      field.select();
    });
    field.addEventListener("blur", () => {
      this.#endStep();
      this.#apply();
      if (!this.isWrong) this.#write(false);
    });
    field.addEventListener("keydown", (event) => this.#key(event));
    field.addEventListener("keyup", (event) => {
      if (!this.isStepping || !["ArrowUp", "ArrowDown"].includes(event.key)) return;
      clearTimeout(this.#ending);
      this.#ending = setTimeout(() => this.#endStep(), STEPS_END_AFTER);
    });
    this.back.addEventListener("click", () => {
      this.say("");
      on.apply(this.name, null);
    });
  }

  #key(event) {
    const { key } = event;
    if (key === "Enter") {
      this.#endStep();
      this.#apply();
    } else if (key === "Escape") {
      clearTimeout(this.#ending);
      if (this.isStepping) this.on.restore();
      this.isStepping = false;
      this.say("");
      this.#write(true);
    } else if (key === "ArrowUp" || key === "ArrowDown") {
      this.#step((key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 10 : 1));
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #step(count) {
    const { name, unit, scale, value } = this;
    const isPositive = name.endsWith(".length");
    const next = stepped(value, scale.factor, count, { usual: this.usual, isAngle: unit === "rad", isPositive });
    if (next === value) return;
    clearTimeout(this.#ending);
    this.isStepping = true;
    this.value = next;
    this.say("");
    this.#write(true);
    this.on.step(name, next);
  }

  #endStep() {
    clearTimeout(this.#ending);
    if (!this.isStepping) return;
    this.isStepping = false;
    this.on.settle(this);
  }

  /** Take what was typed; what is bad stays to be mended, with the reason under it. */
  #apply() {
    if (this.field.value === this.#written) return;
    const read = parseQuantity(this.field.value, this.unit, this.scale.name);
    if (read.error) return this.say(keeping(say(read.error, read.values), this.kept));
    this.say("");
    if (read.value === this.value) return this.#write(this.isFocused);
    this.#written = this.field.value;
    this.on.apply(this.name, read.value);
  }

  get isFocused() {
    return this.field === this.field.getRootNode().activeElement;
  }

  get isWrong() {
    return !this.error.hidden;
  }

  /** The value that the picture has, as a text. */
  get kept() {
    const { name } = this.scale;
    return `${fieldText(this.value, this.unit, name)}${name === "°" ? "" : " "}${name}`;
  }

  #write(isWhole) {
    if (this.isWrong && this.field.value !== this.#written) return;
    this.#written = fieldText(this.value, this.unit, this.scale.name, isWhole);
    this.field.value = this.#written;
  }

  /**
   * Show the value of the document.
   * @param {number} value SI
   * @param {{name: string, factor: number}} scale
   * @param {number} usual length of the mechanism, m
   * @param {boolean} isGiven not the drawing's
   */
  show(value, scale, usual, isGiven) {
    this.back.classList.toggle("given", isGiven);
    if (this.back.disabled === isGiven) this.back.disabled = !isGiven;
    this.usual = usual;
    this.scale = scale;
    write(this.unitText, scale.name);
    if (this.isStepping) return;
    const isEdited = this.isFocused && this.field.value !== this.#written;
    this.value = value;
    if (!isEdited) this.#write(this.isFocused);
  }

  /** Say what is wrong under the field, or nothing. */
  say(text) {
    this.error.textContent = text;
    this.error.hidden = !text;
    this.field.setAttribute("aria-invalid", String(Boolean(text)));
  }

  /** Show its effect on the output, of which `most` is the greatest beside it. */
  affect(value, most) {
    const isKnown = Number.isFinite(value);
    this.effect.textContent = isKnown ? signed(digits(value)) : "";
    const part = isKnown && most > LEAST_EFFECT ? (50 * value) / most : 0;
    this.bar.style.left = `${part < 0 ? 50 + part : 50}%`;
    this.bar.style.width = `${Math.abs(part)}%`;
  }
}
