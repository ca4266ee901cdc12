// The target path: drawn by hand, and how far the path of a point passes from it.

import { html } from "../../../pictures/page/elements.js";
import { pathLines } from "../../../pictures/page/paths.js";
import { say } from "../../../pictures/page/words.js";
import { writeWithUnit } from "../document/units.js";
import { helpButton } from "../help/help.js";
import { section } from "../window/shell.js";
import { designChoices } from "./choices.js";
import { deviationFrom } from "./deviation.js";
import { unitShown } from "./ranges.js";
import { TargetLine, TargetSheet } from "./targetline.js";

export class TargetSection {
  /** @param {Object} page the studio */
  constructor(page) {
    this.model = page.model;
    this.canvas = page.canvas;
    this.line = new TargetLine(this.canvas.stage);
    this.sheet = new TargetSheet(this.canvas, (target) => this.#drawn(target));
    this.sheet.sketch = (target) => target && this.line.take(target, null);
    const make = (text, act) => {
      const element = html("button", { type: "button", class: "button" }, text);
      element.addEventListener("click", act);
      return element;
    };
    this.draw = make(say("drawTarget"), () => this.open(!this.sheet.isOn));
    this.take = make(say("takeTarget"), () => this.#take());
    this.clear = make(say("clearTarget"), () => {
      this.#set(null);
      this.draw.focus();
    });
    this.point = html("select", { class: "number", "aria-label": say("targetPoint") });
    this.point.addEventListener("change", () => {
      designChoices(this.model).point = this.point.value;
      this.show();
    });
    this.closed = html("input", { type: "checkbox" });
    this.closed.addEventListener("change", () => this.#set({ ...this.model.target, closed: this.closed.checked }));
    this.closedRow = html("label", { class: "switch plain" }, this.closed, say("targetClosed"));
    this.greatest = html("dd");
    this.rms = html("dd");
    this.facts = html("dl", { class: "facts" });
    const term = (text, value) => [html("dt", {}, text), html("span"), value];
    this.facts.append(...term(say("deviationGreatest"), this.greatest), ...term(say("deviationRms"), this.rms));
    this.hint = html("p", { class: "hint" });
    const buttons = html("div", { class: "buttons" }, this.draw, this.take, this.clear);
    const parts = [buttons, this.hint, this.facts, this.closedRow];
    const { element, head, note } = section(say("targetTitle"), "dimensions", ...parts);
    note.replaceWith(this.point);
    head.classList.add("with-choice");
    head.firstChild.after(helpButton(page, () => "targetDeviation"));
    this.element = element;
    element.addEventListener("keydown", (event) => this.#escape(event));
    this.sheet.element.addEventListener("keydown", (event) => this.#escape(event));
    for (const event of ["turn", "target"]) this.model.on(event, () => this.show());
    this.show();
  }

  #escape(event) {
    if (event.key !== "Escape" || !this.sheet.isOn) return;
    event.stopPropagation();
    this.open(false);
  }

  /** Let one draw on the picture, or no longer. */
  open(isOn) {
    this.sheet.open(isOn);
    this.show();
  }

  #drawn(target) {
    this.sheet.open(false);
    if (target) this.#set(target);
    else this.show();
  }

  #set(target) {
    this.model.setTarget(target);
  }

  get #joint() {
    const { data } = this.model;
    const moving = data.joints.filter((joint) => joint.link !== 0);
    const { point } = designChoices(this.model);
    return [point, ...data.paths].map((name) => moving.find((joint) => joint.name === name)).find(Boolean) ?? moving[0];
  }

  /** The path of the chosen point, m. */
  get #path() {
    const lines = pathLines(this.model.turn, this.#joint, 1);
    return lines.map((line) => line.map(([x, y]) => [x, -y]));
  }

  /** What is now becomes the target: dimensions can then be compared with it. */
  #take() {
    const [longest] = this.#path.sort((a, b) => b.length - a.length);
    if (!longest) return;
    const { closes } = this.model.turn;
    this.#set({ points: closes ? longest.slice(0, -1) : longest, closed: closes });
  }

  show() {
    const { model, sheet } = this;
    const { target } = model;
    const joint = model.isSketch ? null : this.#joint;
    this.element.hidden = !joint;
    if (!joint) {
      sheet.open(false);
      this.line.take(target, null);
      return;
    }
    this.#offer(joint);
    const deviation = target && deviationFrom(target, this.#path);
    if (!sheet.points) this.line.take(target, deviation);
    this.draw.setAttribute("aria-pressed", String(sheet.isOn));
    this.clear.hidden = this.closedRow.hidden = this.facts.hidden = !target;
    this.closed.checked = Boolean(target?.closed);
    this.hint.textContent = sheet.isOn ? say("targetHint") : target ? "" : say("targetNote");
    this.hint.hidden = !this.hint.textContent;
    const { name } = unitShown(model.data, "m");
    const write = (value) => (value === undefined ? "–" : writeWithUnit(value, "m", name, 3));
    this.greatest.textContent = write(deviation?.greatest);
    this.rms.textContent = write(deviation?.rms);
    this.deviation = deviation;
  }

  #offer(joint) {
    const names = this.model.data.joints.filter((one) => one.link !== 0).map((one) => one.name);
    if ([...this.point.options].map((one) => one.value).join() !== names.join()) {
      const option = (name) => html("option", { value: name }, say("pathOf", { point: name }));
      this.point.replaceChildren(...names.map(option));
    }
    this.point.value = joint.name;
  }
}
