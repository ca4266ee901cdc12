// One dimension as a slider with a field.

import { html } from "../../../pictures/page/elements.js";
import { button } from "../../../pictures/page/panel.js";
import { say } from "../../../pictures/page/words.js";
import { parseQuantity, writeQuantity } from "../document/units.js";
import { designRange, dimensionText, sliderSteps, unitShown, valueText } from "./ranges.js";

/** Digits that a field shows. */
const SLIDER_DIGITS = 5;

export class DimensionSlider {
  /**
   * @param {import("../model/model.js").Model} model
   * @param {import("./designing.js").Designing} designing
   * @param {string} name of the dimension
   * @param {(() => void) | null} remove takes the slider away
   */
  constructor(model, designing, name, remove) {
    Object.assign(this, { model, designing, name });
    const text = dimensionText(name);
    this.range = html("input", { type: "range", "aria-label": text });
    const named = { "aria-label": say("dimensionValue", { name: text }), "data-slides": name };
    this.field = html("input", { class: "number", inputmode: "decimal", ...named });
    this.unit = html("span", { class: "note" });
    this.note = html("p", { class: "field-error", role: "status", hidden: "" });
    const label = html("span", { class: "slider-name" }, text);
    const head = html("div", { class: "slider-head" }, label, this.field, this.unit);
    if (remove) {
      const what = say("removeSlider", { name: text });
      const away = button(what, "", "×");
      away.className = "button round quiet";
      away.addEventListener("click", remove);
      head.append(away);
    }
    this.element = html("div", { class: "slider" }, head, this.range, this.note);
    this.range.addEventListener("input", () => this.#slide());
    designing.endWith(this.range);
    // Arrows are the slider's, not those of the crank.
    this.range.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && designing.isOn) designing.cancel();
      else if (!/^(Arrow|Page|Home|End)/.test(event.key)) return;
      event.stopPropagation();
    });
    this.field.addEventListener("change", () => this.#type());
    this.show();
  }

  get dimension() {
    return this.model.dimensions.find((one) => one.name === this.name);
  }

  #slide() {
    if (!this.dimension) return;
    const { unit } = this.dimension;
    const { factor } = unitShown(this.model.data, unit);
    this.designing.set({ [this.name]: Number(this.range.value) / factor });
    this.#write(this.designing.wanted[this.name] ?? this.dimension.value);
  }

  async #type() {
    // What is typed as the dimension goes is of no use: the field that is taken away says so too.
    if (!this.dimension) return;
    const { unit } = this.dimension;
    const read = parseQuantity(this.field.value, unit, unitShown(this.model.data, unit).name);
    if (read.error) {
      this.#complain(say(read.error, read.values));
      this.field.setAttribute("aria-invalid", "true");
      return;
    }
    if (this.name.endsWith(".length") && !(read.value > 0)) {
      this.#complain(say("notPositive"));
      this.field.setAttribute("aria-invalid", "true");
      return;
    }
    this.designing.set({ [this.name]: read.value });
    await this.designing.end();
  }

  #complain(text) {
    this.note.hidden = !text;
    this.note.textContent = text;
  }

  #write(value) {
    const { unit } = this.dimension;
    const shown = unitShown(this.model.data, unit);
    this.unit.textContent = shown.name;
    if (this.field !== this.field.getRootNode().activeElement) {
      this.field.value = writeQuantity(Number(value.toPrecision(SLIDER_DIGITS)), unit, shown.name);
    }
    this.range.setAttribute("aria-valuetext", valueText(this.model.data, value, unit));
  }

  /** Show the present value; while it slides the hand is right. */
  show() {
    const { model, designing, dimension } = this;
    if (!dimension) return;
    const { unit, value } = dimension;
    const shown = unitShown(model.data, unit);
    const wanted = designing.wanted[this.name];
    if (designing.isOn && wanted !== undefined) {
      const text = valueText(model.data, wanted, unit);
      this.#write(wanted);
      this.range.value = String(wanted * shown.factor);
      this.#complain(designing.refusal && say("cannotBeAssembled", { value: text, reason: designing.refusal }));
      return;
    }
    const isWithin = this.steps && value >= this.limits[0] && value <= this.limits[1];
    if (!isWithin || this.factor !== shown.factor) this.#lay(value, shown);
    this.field.removeAttribute("aria-invalid");
    const { refusal } = designing;
    const kept = valueText(model.data, value, unit);
    this.#complain(refusal && wanted !== undefined ? say("lastGoodStays", { value: kept, reason: refusal }) : "");
    this.range.value = String(value * shown.factor);
    this.#write(value);
  }

  /** Choose the range about a value. */
  #lay(value, { factor }) {
    this.factor = factor;
    this.limits = designRange({ ...this.dimension, value }, this.model.data.usual);
    this.steps = sliderSteps(this.limits, factor);
    this.range.min = String(this.steps.low);
    this.range.max = String(this.steps.high);
    this.range.step = String(this.steps.step);
  }
}
