// Find a dimension: the value with which a swing, a travel, γ or a time ratio is what one wants.

import { html } from "../../../pictures/page/elements.js";
import { digits } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { Fields } from "../forces/fields.js";
import { foldedSection } from "../forces/folded.js";
import { withDimension } from "../panel/dimensions_of.js";
import { designChoices } from "./choices.js";
import { measuredRange } from "./mapasking.js";
import { metricChoices } from "./metrics.js";
import { designRange, dimensionText, mostUsefulFirst, unitShown, valueText } from "./ranges.js";

/** What can be wanted of a number that changes evenly. */
const WANTED_OF = ["span", "min_transmission_angle", "time_ratio"];
/** How many times its present value a dimension is looked for. */
const FIND_REACH = 3;

export class FindSection {
  /** @param {Object} page the studio */
  constructor(page) {
    this.page = page;
    this.model = page.model;
    const state = (designChoices(this.model).found ??= { folded: {}, metric: "", dimension: "", value: null });
    this.state = state;
    const { element, details, body, note } = foldedSection("find", say("findTitle"), "dimensions", state.folded, true);
    Object.assign(this, { element, details });
    note.textContent = say("findNote");
    const form = html("div");
    this.fields = new Fields(form);
    this.act = html("button", { type: "button", class: "button" }, say("findIt"));
    this.act.addEventListener("click", () => this.#find());
    this.told = html("p", { class: "hint find-told", role: "status" });
    body.append(form, html("div", { class: "button-row" }, this.act), this.told);
    for (const event of ["turn", "checked", "connection"]) this.model.on(event, () => this.show());
    // Of another mechanism something else is wanted; what was found is true of one design.
    this.model.on("opened", () => (state.value = null));
    this.model.on("document", () => this.model.document !== this.found && (this.told.textContent = ""));
    details.addEventListener("toggle", () => this.show());
    this.show();
  }

  get #metrics() {
    const { data, checked } = this.model;
    const all = metricChoices(data, checked.assembly, data.turn.unit === "angle");
    const order = ({ spec }) => WANTED_OF.indexOf(spec.metric);
    const known = all.filter((one) => order(one) >= 0 && !String(one.spec.of ?? "").includes("."));
    return known.sort((a, b) => order(a) - order(b));
  }

  get #metric() {
    return this.#metrics.find((one) => one.id === this.state.metric) ?? this.#metrics[0];
  }

  /** The dimension that changes: at first the length of the crank. */
  get #dimension() {
    const { dimensions, document } = this.model;
    const named = (name) => dimensions.find((one) => one.name === name);
    const drivers = [document.driver].flat();
    const [useful] = mostUsefulFirst(dimensions, drivers);
    return named(this.state.dimension) ?? named(`${drivers[0]}.length`) ?? named(useful);
  }

  show() {
    const { model, details, element, state, fields } = this;
    const isThere = !model.isSketch && model.moves && !model.run && model.driverCount === 1;
    element.hidden = !(isThere && model.dimensions.length && this.#metrics.length);
    if (element.hidden || !details.open || model.isDragging) return;
    const metric = this.#metric;
    const { unit } = metric;
    const set = (key) => (value) => {
      if (key === "metric") state.value = null;
      state[key] = value;
      this.told.textContent = "";
      this.show();
    };
    fields.show(
      fields.choiceRow("find metric", {
        label: say("findMetric"), options: this.#metrics.map(({ id, text }) => [id, text]), value: metric.id,
        set: set("metric"),
      }),
      fields.row("find value", {
        label: say("findValue"), hint: this.#now(metric), value: state.value, unit, isOptional: true,
        shown: unit ? unitShown(model.data, unit).name : "", set: set("value"),
      }),
      fields.choiceRow("find dimension", {
        label: say("findDimension"), options: model.dimensions.map(({ name }) => [name, dimensionText(name)]),
        value: this.#dimension.name, set: set("dimension"),
      }),
    );
    this.act.disabled = state.value === null || !model.link.isOpen;
  }

  /** What it is now, where the page knows it: shown in the empty field. */
  #now({ spec: { metric, at } }) {
    const own = metric === "min_transmission_angle" ? this.model.transmission?.find((one) => one.at === at) : null;
    return own ? digits((own.min * 180) / Math.PI) : "–";
  }

  #write(value) {
    const { unit } = this.#metric;
    const { name, factor } = unit ? unitShown(this.model.data, unit) : { name: "", factor: 1 };
    return `${digits(value * factor, 4)}${name === "°" || !name ? "" : " "}${name}`;
  }

  /** Ask, and take what was found as one step. */
  async #find() {
    const { model, state } = this;
    const [metric, dimension, { document }] = [this.#metric, this.#dimension, model];
    const [low, high] = designRange(dimension, model.data.usual, FIND_REACH);
    const measured = measuredRange(model, metric);
    const part = measured ? { low: measured[0], high: measured[1] } : {};
    const x = { dimension: dimension.name, low, high };
    this.told.textContent = say("working");
    try {
      const answer = await model.ask("find", { x, metric: metric.spec, value: state.value, ...part });
      if (!answer || model.document !== document) return void (this.told.textContent = "");
      const { value, min, max } = answer.header;
      const name = dimensionText(dimension.name);
      const text = (own) => valueText(model.data, own, dimension.unit);
      const [worst, best] = [min, max].map((own) => this.#write(own ?? NaN));
      const range = { name, low: text(low), high: text(high), least: worst, greatest: best };
      if (value === null) return void (this.told.textContent = say(min === null ? "foundNone" : "foundNot", range));
      this.found = withDimension(document, dimension.name, value);
      await model.edit(this.found);
      const wanted = this.#write(state.value);
      this.told.textContent = say("foundIt", { name, value: text(value), what: metric.text, wanted });
    } catch (error) {
      this.told.textContent = error.kind === "disconnected" ? say("offline") : error.message;
    }
  }
}
