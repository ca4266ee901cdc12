// The field of what is chosen: the place and name of a joint, the name of a link or a slide.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { moveJoint, renameJoint } from "../document/joints.js";
import { renameLink } from "../document/links.js";
import { nameError } from "../document/names.js";
import { renameSlide, slideNameError } from "../document/slides.js";
import { documentSize } from "../document/structure.js";
import { parseQuantity, usualUnit, writeQuantity } from "../document/units.js";

/** Between the item and its field, px; its width with what is about it. */
const FIELD_OFFSET = 18;
const FIELD_SIZE = [220, 210];
/** So many digits of a place are written; an untouched one is not read back. */
const PLACE_DIGITS = 6;

export class ItemField {
  /**
   * @param {import("./builder.js").Builder} builder
   * @param {import("./choice.js").Choice} choice
   */
  constructor(builder, choice) {
    this.builder = builder;
    this.choice = choice;
    this.element = html("form", { class: "item-field", hidden: "", novalidate: "" });
    builder.canvas.element.append(this.element);
    this.element.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#apply();
    });
    this.element.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      event.stopPropagation();
      this.close();
      builder.canvas.picture.focus();
    });
  }

  open() {
    const { builder, choice } = this;
    const { model } = builder;
    const { kind, name } = choice.item;
    const at = choice.anchor();
    if (!at) return;
    this.unit = usualUnit(documentSize(model.document)).name;
    this.inputs = { name: this.#input(say("nameField"), name) };
    this.before = { name };
    if (kind === "joint") {
      ["x", "y"].forEach((axis, i) => {
        const text = writeQuantity(Number(at[i].toPrecision(PLACE_DIGITS)), "m", this.unit);
        this.before[axis] = text;
        this.inputs[axis] = this.#input(`${axis}, ${this.unit}`, text);
      });
    }
    this.error = html("p", { class: "field-error", role: "alert", hidden: "" });
    const done = html("button", { type: "submit", class: "button primary" }, say("apply"));
    const row = (input) => html("label", { class: "row" }, html("span", {}, input.ariaLabel), input);
    const rows = Object.values(this.inputs).map(row);
    this.element.replaceChildren(html("b", {}, say(`${kind}Named`, { name })), ...rows, this.error, done);
    this.element.setAttribute("aria-label", say(`${kind}Named`, { name }));
    this.element.hidden = false;
    this.at = [...at];
    const { view } = builder.canvas.stage;
    const [x, y] = view.px(...at);
    const clamp = (value, size, room) => Math.max(8, Math.min(value + FIELD_OFFSET, room - size - 8));
    this.element.style.left = `${clamp(x, FIELD_SIZE[0], view.width)}px`;
    this.element.style.top = `${clamp(y, FIELD_SIZE[1], view.height)}px`;
    const first = this.inputs.x ?? this.inputs.name;
    first.focus();
    first.select();
  }

  close() {
    this.element.hidden = true;
  }

  #input(label, value) {
    return html("input", { class: "number", "aria-label": label, value, autocomplete: "off", spellcheck: "false" });
  }

  #refuse(key, { error, values }) {
    for (const [own, input] of Object.entries(this.inputs)) input.setAttribute("aria-invalid", String(own === key));
    this.error.hidden = false;
    this.error.textContent = say(error, values);
    this.inputs[key].focus();
  }

  /** Take what is typed, as one step; a bad value changes nothing and says why. */
  async #apply() {
    const { builder, before, inputs } = this;
    const { model, canvas } = builder;
    const { kind, name } = this.choice.item;
    const typed = inputs.name.value.trim();
    const errorOf = kind === "slide" ? slideNameError : nameError;
    const wrong = errorOf(model.document, typed, name);
    if (wrong) return this.#refuse("name", wrong);
    const to = [...this.at];
    for (const [i, axis] of ["x", "y"].entries()) {
      if (!inputs[axis] || inputs[axis].value === before[axis]) continue;
      const read = parseQuantity(inputs[axis].value, "m", this.unit);
      if (read.error) return this.#refuse(axis, read);
      to[i] = read.value;
    }
    this.close();
    canvas.picture.focus();
    canvas.stage.isFitted = false;
    model.previews.begin();
    if (to[0] !== this.at[0] || to[1] !== this.at[1]) await this.#move(name, to);
    if (typed !== name) {
      const rename = { joint: renameJoint, link: renameLink, slide: renameSlide }[kind];
      this.choice.item = { kind, name: typed };
      await model.previews.show(rename(model.document, name, typed));
    }
    await model.previews.commit();
  }

  async #move(joint, to) {
    const { model } = this.builder;
    if (!model.moves) return model.previews.show(moveJoint(model.document, joint, to));
    model.previews.dragJoint(joint, to);
    return model.previews.dragged();
  }
}
