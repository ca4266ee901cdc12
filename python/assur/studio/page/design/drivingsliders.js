// Sliders along the foot of the projector view: the coordinates of the drivers; of one driver its own
// and those of the dimensions that are designed.

import { html } from "../../../pictures/page/elements.js";
import { degrees } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { newestOnly } from "../model/link.js";
import { designRange, dimensionText, sliderSteps, unitShown, valueText } from "./ranges.js";

/** Steps of a coordinate. */
const COORDINATE_STEPS = 720;
/** Sliders of dimensions beside that of the driver. */
const MOST_DIMENSIONS = 2;

export class DrivingSliders {
  /** @param {Object} page the studio */
  constructor(page) {
    this.page = page;
    this.model = page.model;
    this.element = html("div", { class: "projector-sliders" });
    this.rows = [];
    /** From where to where each driver goes: `{ low, high, unit }`. */
    this.reach = [];
    this.moves = newestOnly((wanted) => this.#move(wanted));
    this.measures = newestOnly(() => this.#measure());
  }

  #row(key, name) {
    const value = html("b");
    const range = html("input", { type: "range", "aria-label": name });
    const head = html("span", { class: "projector-slider-head" }, html("span", {}, name), value);
    const row = { key, range, value, element: html("label", { class: "projector-slider" }, head, range) };
    range.addEventListener("keydown", (event) => {
      if (/^(Arrow|Page|Home|End)/.test(event.key)) event.stopPropagation();
    });
    return row;
  }

  /** Take another turn. */
  take() {
    const { model } = this;
    const { driver } = model.document;
    const named = (one, i) => (typeof one === "string" ? one : say("driverOf", { name: i + 1 }));
    const drivers = [driver ?? []].flat().map(named);
    const designed = drivers.length === 1 ? this.page.design.names.slice(0, MOST_DIMENSIONS) : [];
    const names = designed.filter((name) => model.dimensions.some((one) => one.name === name));
    const { low, high } = model.turn;
    this.reach[model.axis] = { low, high, unit: model.data.turn.unit };
    const keys = [...drivers.map((_, i) => `driver ${i}`), ...names].join();
    if (this.keys !== keys) {
      this.keys = keys;
      const driven = drivers.map((name, i) => this.#driverRow(i, name));
      this.rows = [...driven, ...names.map((name) => this.#dimensionRow(name))];
      this.element.replaceChildren(...this.rows.map((row) => row.element));
      if (drivers.length > 1) this.measure();
    }
    this.element.hidden = model.isSketch;
    this.show();
  }

  #driverRow(i, name) {
    const row = this.#row(`driver ${i}`, name);
    row.show = () => this.#showDriver(row, i);
    row.range.addEventListener("input", () => this.moves.push({ axis: i, q: Number(row.range.value) }));
    row.range.addEventListener("change", () => this.measure());
    return row;
  }

  #showDriver({ range, value, element }, i) {
    const reach = this.reach[i];
    const q = i === this.model.axis ? this.page.playback.pose.q : this.model.held[i];
    // Between two documents there may be more drivers than coordinates.
    const isKnown = Boolean(reach) && Number.isFinite(q);
    element.classList.toggle("waits", !isKnown);
    range.disabled = !isKnown;
    if (!isKnown) return;
    const { low, high, unit } = reach;
    Object.assign(range, { min: String(low), max: String(high), step: String((high - low) / COORDINATE_STEPS) });
    range.value = String(q);
    value.textContent = unit === "angle" ? degrees(q) : valueText(this.model.data, q, "m");
    range.setAttribute("aria-valuetext", value.textContent);
  }

  #dimensionRow(name) {
    const { model } = this;
    const { designing } = this.page;
    const row = this.#row(name, dimensionText(name));
    const present = () => model.dimensions.find((one) => one.name === name);
    const lay = (own) => (row.limits = designRange(own, model.data.usual));
    row.show = () => {
      const own = present();
      if (!own) return;
      const { factor } = unitShown(model.data, own.unit);
      const value = (designing.isOn && designing.wanted[name]) || own.value;
      if (!row.limits || own.value < row.limits[0] || own.value > row.limits[1]) lay(own);
      const { low, high, step } = sliderSteps(row.limits, factor);
      Object.assign(row.range, { min: String(low), max: String(high), step: String(step) });
      row.range.value = String(value * factor);
      row.value.textContent = valueText(model.data, value, own.unit);
      row.range.setAttribute("aria-valuetext", row.value.textContent);
      row.range.disabled = !model.link.isOpen;
    };
    row.range.addEventListener("input", () => {
      if (!present()) return;
      designing.set({ [name]: Number(row.range.value) / unitShown(model.data, present().unit).factor });
      row.show();
    });
    designing.endWith(row.range);
    return row;
  }

  /** Move a driver: of several the one that moves is chosen first. */
  async #move({ axis, q }) {
    const { model, page } = this;
    if (model.axis !== axis) {
      page.playback.pause();
      await model.setAxis(axis);
    }
    page.playback.seek(q);
  }

  /** Ask how far the drivers that are held could go from here. */
  measure() {
    if (this.model.driverCount > 1 && this.model.link.isOpen && !this.model.isSketch) this.measures.push(null);
  }

  async #measure() {
    const { model } = this;
    for (let axis = 0; axis < model.driverCount; axis++) {
      if (axis === model.axis) continue;
      try {
        const answer = await model.ask("turn", { q: model.place, rows: 3, orders: 2, axis });
        if (!answer) continue;
        const { turn } = answer.header.payload;
        const { grid, unit } = turn;
        const { kind, middle, half } = grid;
        const [low, high] = kind === "cosine" ? [middle - half, middle + half] : [grid.low, grid.high];
        this.reach[axis] = { low, high, unit };
      } catch {
        // Where it is not known the slider keeps what it had.
      }
    }
    this.show();
  }

  show() {
    for (const row of this.rows) row.show();
  }
}
