// Several drivers: a slider and a field for each, within what it can reach while the others are held.

import { html } from "../../../pictures/page/elements.js";
import { digits } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { tableOf } from "../document/names.js";
import { parseQuantity } from "../document/units.js";
import { section } from "../window/shell.js";
import { fieldText, keeping, panelLength } from "./steps.js";

/** Steps of an arrow key over all that can be reached. */
const KEY_STEPS = 100;
/** After the last movement the reach of the others is asked for, ms. */
const REACH_AFTER = 250;

/** Return the drivers of a document: names, and whether their coordinate is an angle. */
export function driverList(document) {
  const slides = tableOf(document.slides);
  return [document.driver ?? []].flat().map((one) => {
    const name = typeof one === "string" ? one : `${one.link} − ${one.relative_to}`;
    return { name, link: typeof one === "string" ? one : one.link, isAngle: !Object.hasOwn(slides, name) };
  });
}

export class DriverSection {
  #rows = [];
  #built = "";
  #wanted = null;
  #isSwitching = false;
  #reachAt = "";
  #timer = 0;

  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.model = studio.model;
    this.list = html("div", { class: "drivers" });
    const { element, note } = section(say("drivers"), "dimensions", this.list);
    note.textContent = say("driversHint");
    this.element = element;
    const { model } = this;
    model.on("turn", () => this.#replaced());
    for (const event of ["pose", "told"]) model.on(event, () => this.show());
    model.on("told", () => this.#askReach());
    this.#replaced();
  }

  #replaced() {
    const { model } = this;
    this.element.hidden = model.isSketch || model.driverCount < 2;
    if (this.element.hidden) return;
    const drivers = driverList(model.document);
    const key = drivers.map((one) => one.name).join();
    if (key !== this.#built) {
      this.#rows = drivers.map((driver, i) => this.#row(driver, i));
      this.list.replaceChildren(...this.#rows.map((row) => row.element));
    }
    this.#built = key;
    if (model.reach) {
      this.#reachAt = JSON.stringify(model.place);
      this.#rows.forEach(({ slider }, i) => {
        [slider.min, slider.max] = model.reach[i].map(String);
      });
    }
    this.show();
  }

  #row({ name, link, isAngle }, i) {
    const slider = html("input", { type: "range", step: "any", class: "range", "aria-label": name, "data-driver": i });
    const label = say("coordinateOf", { name });
    const field = html("input", { class: "number", inputmode: "decimal", "aria-label": label, "data-driver-field": i });
    const unit = html("span", { class: "unit" });
    const error = html("p", { class: "field-error", role: "alert", hidden: "" });
    const quantity = html("span", { class: "quantity" }, field, unit);
    const title = html("span", { class: "driver-name" }, name);
    const element = html("div", { class: "driver" }, title, slider, quantity, error);
    const row = { name, isAngle, slider, field, unit, error, element, written: "" };
    slider.addEventListener("input", () => this.#move(i, Number(slider.value)));
    slider.addEventListener("focus", () => this.#choose(i));
    slider.addEventListener("keydown", (event) => {
      const sense = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!sense) return;
      const [low, high] = [Number(slider.min), Number(slider.max)];
      slider.value = String(Number(slider.value) + (sense * (event.shiftKey ? 10 : 1) * (high - low)) / KEY_STEPS);
      this.#move(i, Number(slider.value));
      event.preventDefault();
      event.stopPropagation();
    });
    field.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.#read(row, i);
      else if (event.key === "Escape") {
        this.#refuse(row, "");
        field.value = row.written;
      } else return;
      event.stopPropagation();
    });
    field.addEventListener("blur", () => this.#read(row, i));
    const { document } = this.model;
    const slide = tableOf(document.slides)[link];
    const parts = slide ? [slide.barrel ?? `${link}_barrel`, slide.rod ?? `${link}_rod`, slide.link] : [link];
    this.studio.highlight.attach(element, () => ({ links: parts.filter(Boolean) }));
    return row;
  }

  #refuse(row, text) {
    row.error.textContent = text;
    row.error.hidden = !text;
    row.field.setAttribute("aria-invalid", String(Boolean(text)));
  }

  #scale({ isAngle }) {
    return isAngle ? { name: "°", factor: 180 / Math.PI } : panelLength(this.model.data);
  }

  #read(row, i) {
    if (row.field.value === row.written) return;
    const { name } = this.#scale(row);
    const read = parseQuantity(row.field.value, row.isAngle ? "rad" : "m", name);
    const kept = `${row.written} ${name}`;
    if (read.error) return this.#refuse(row, keeping(say(read.error, read.values), kept));
    const [low, high] = [Number(row.slider.min), Number(row.slider.max)];
    if (read.value < low || read.value > high) {
      const write = (value) => digits(value * this.#scale(row).factor, 4);
      const wrong = say("outOfReach", { name: row.name, low: write(low), high: write(high), unit: name });
      return this.#refuse(row, keeping(wrong, kept));
    }
    this.#refuse(row, "");
    row.written = row.field.value;
    this.#move(i, read.value);
  }

  /** Make a driver the one that the dial moves. */
  #choose(i) {
    if (this.model.axis !== i) this.#move(i, this.model.held[i]);
  }

  /** Move a driver; while another turn is on its way the newest place waits. */
  async #move(i, value) {
    const { model, studio } = this;
    studio.playback.pause();
    this.#wanted = { i, value };
    if (this.#isSwitching) return;
    this.#isSwitching = true;
    try {
      while (this.#wanted.i !== model.axis) await model.setAxis(this.#wanted.i);
    } finally {
      this.#isSwitching = false;
    }
    if (model.data.turn.unit !== "time") studio.playback.seek(this.#wanted.value);
  }

  /** Once it stands still elsewhere, the others can go elsewhere too. */
  #askReach() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      const { model, studio } = this;
      const isElsewhere = JSON.stringify(model.place) !== this.#reachAt;
      const isMoving = studio.playback.player.isPlaying || model.isDragging || this.#isSwitching;
      if (model.driverCount > 1 && isElsewhere && !isMoving && model.link.isOpen) model.look();
    }, REACH_AFTER);
  }

  show() {
    if (this.element.hidden) return;
    const { model } = this;
    const active = this.element.getRootNode().activeElement;
    this.#rows.forEach((row, i) => {
      row.element.classList.toggle("chosen", i === model.axis);
      const scale = this.#scale(row);
      row.unit.textContent = scale.name;
      const isWaiting = this.#isSwitching && this.#wanted?.i === i;
      if (!isWaiting) row.slider.value = String(model.held[i]);
      row.slider.setAttribute("aria-valuetext", `${digits(model.held[i] * scale.factor, 4)} ${scale.name}`);
      if (row.field === active && row.field.value !== row.written) return;
      if (!row.error.hidden) return;
      row.written = fieldText(model.held[i], row.isAngle ? "rad" : "m", scale.name);
      row.field.value = row.written;
    });
  }
}
