// The section of sliders: any dimension can have one.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { section } from "../window/shell.js";
import { designChoices } from "./choices.js";
import { dimensionText, mostUsefulFirst } from "./ranges.js";
import { DimensionSlider } from "./slider.js";

export class DesignSection {
  /**
   * @param {Object} page the studio
   * @param {import("./designing.js").Designing} designing
   */
  constructor(page, designing) {
    this.model = page.model;
    this.designing = designing;
    this.sliders = [];
    this.list = html("div", { class: "sliders" });
    this.choice = html("select", { class: "number", "aria-label": say("dimensionToSlide") });
    this.add = html("button", { type: "button", class: "button" }, say("addSlider"));
    this.add.addEventListener("click", () => this.#add(this.choice.value));
    const row = html("div", { class: "row" }, this.choice, this.add);
    this.controls = html("fieldset", { class: "plain" }, this.list, row);
    const { element, note } = section(say("designTitle"), "dimensions", this.controls);
    note.textContent = say("designNote");
    this.element = element;
    for (const event of ["turn", "connection", "problem"]) this.model.on(event, () => this.show());
    designing.listeners.add(() => this.show());
    this.show();
  }

  /** The dimensions that have a slider. */
  get names() {
    const { dimensions } = this.model;
    const chosen = designChoices(this.model).sliders;
    const known = dimensions.map((one) => one.name);
    const own = chosen?.filter((name) => known.includes(name));
    // Of another mechanism none may be left.
    return own?.length || chosen?.length === 0 ? own : this.#useful.slice(0, 2);
  }

  get #useful() {
    const { dimensions, document } = this.model;
    return mostUsefulFirst(dimensions, [document.driver].flat());
  }

  #add(name) {
    designChoices(this.model).sliders = [...this.names, name];
    this.show();
    this.sliders.at(-1).range.focus();
  }

  #remove(name) {
    designChoices(this.model).sliders = this.names.filter((one) => one !== name);
    this.show();
    this.add.focus();
  }

  show() {
    const { model, designing } = this;
    this.element.hidden = model.isSketch || !model.dimensions.length;
    if (this.element.hidden) return;
    this.controls.disabled = !model.link.isOpen;
    const names = this.names;
    if (names.join() !== this.sliders.map((one) => one.name).join()) {
      this.sliders = names.map((name) => {
        const there = this.sliders.find((one) => one.name === name);
        return there ?? new DimensionSlider(model, designing, name, () => this.#remove(name));
      });
      this.list.replaceChildren(...this.sliders.map((one) => one.element));
    }
    this.#offer(model.dimensions.map((one) => one.name).filter((name) => !names.includes(name)));
    for (const one of this.sliders) one.show();
  }

  /** Offer the dimensions that have no slider yet. */
  #offer(others) {
    this.choice.parentElement.hidden = !others.length;
    if ([...this.choice.options].map((option) => option.value).join() === others.join()) return;
    this.choice.replaceChildren(...others.map((name) => html("option", { value: name }, dimensionText(name))));
    this.choice.value = this.#useful.find((name) => others.includes(name)) ?? "";
  }
}
