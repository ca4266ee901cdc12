// All dimensions in a table, each with a field and its exact effect on an output.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { newestOnly } from "../model/link.js";
import { section } from "../window/shell.js";
import { DimensionRow } from "./dimension_row.js";
import { concernedBy, givenDimensions, groupDimensions, withDimension } from "./dimensions_of.js";
import { LiveQuestion } from "./live.js";
import { outputsOf, perUnit, usualOutput } from "./outputs.js";
import { problemText } from "./problem.js";
import { panelLength } from "./steps.js";

/** From so many on they scroll; from so many they can be filtered too. */
const MANY = 12;
const VERY_MANY = 20;
const ANGLE_SCALE = { name: "°", factor: 180 / Math.PI };

export class DimensionSection {
  #rows = new Map();
  #built = "";
  #edited = "";
  #gesture = null;
  #steps = newestOnly(({ gesture, document }) => this.model.previews.isUnderWay(gesture) && this.model.previews.show(document));

  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.model = studio.model;
    this.choice = html("select", { class: "title", "aria-label": say("outputChoice") });
    this.choice.addEventListener("change", () => {
      this.model.output = this.choice.value;
      this.#ofOutput(null);
      this.question.again();
    });
    this.per = html("span");
    const filter = { placeholder: say("filter"), "aria-label": say("filter") };
    this.filter = html("input", { class: "filter", type: "search", ...filter, hidden: "" });
    this.filter.addEventListener("input", () => this.#sift());
    this.table = html("div", { class: "dimensions" });
    this.remark = html("p", { class: "remark" });
    const { element, note } = section(say("dimensions"), "dimensions", this.filter, this.table, this.remark);
    note.classList.add("effect-head");
    note.append(say("changeOf"), " ", html("span", { class: "choose" }, this.choice), this.per);
    this.element = element;
    const { model } = this;
    // While something is dragged the document tells it.
    model.on("turn", () => model.isDragging || this.show());
    model.on("checked", () => this.show());
    model.on("document", () => this.show());
    model.on("problem", () => this.#tellProblem());
    model.on("settled", () => this.#mark([]));
    model.on("connection", () => this.#lock());
    const fields = () => ({ q: model.place, of: this.choice.value });
    const take = (header, error) => this.#ofOutput(header ?? null, error);
    this.question = new LiveQuestion(studio, element, { kind: "sensitivity", fields, take });
    model.on("pose", () => this.table.classList.toggle("stale", studio.playback.player.isPlaying));
    this.show();
  }

  /** Show the present dimensions. */
  show() {
    const { model } = this;
    // After a drag the turn knows them, else what was checked: it does even where it does not close.
    const isChecked = model.moves && !model.isDragging && model.checked.dimensions;
    const given = givenDimensions(model.document);
    const known = isChecked ? model.checked.dimensions : model.dimensions;
    const all = known.map((one) => ({ ...one, value: given[one.name] ?? one.value }));
    this.element.hidden = model.isSketch || !all.length;
    if (this.element.hidden) return;
    const names = all.map(({ name }) => name).join();
    if (names !== this.#built) this.#build(all);
    this.#built = names;
    this.#chooseOutput();
    const length = panelLength(model.data);
    for (const { name, value, unit } of all) {
      const isGiven = Object.hasOwn(given, name);
      this.#rows.get(name).show(value, unit === "rad" ? ANGLE_SCALE : length, model.data.usual, isGiven);
    }
    if (model.isDragging) this.#mark(model.changed ?? []);
    this.#lock();
  }

  #build(all) {
    const on = {
      apply: (name, value) => this.#apply(name, value),
      step: (name, value) => this.#step(name, value),
      settle: (row) => this.#settle(row),
      restore: () => this.#restore(),
    };
    this.#rows.clear();
    const groups = groupDimensions(all, this.model.document).map(({ key, dimensions }) => {
      const rows = dimensions.map(({ name, unit }) => {
        const row = new DimensionRow(name, unit, on);
        this.studio.highlight.attach(row.element, () => concernedBy(name, this.model.document));
        this.#rows.set(name, row);
        return row.element;
      });
      const head = html("h3", {}, say(`dimensions_${key}`), html("span", { class: "note" }));
      const group = { class: "dimension-group", role: "group", "aria-label": say(`dimensions_${key}`) };
      return html("div", group, head, ...rows);
    });
    this.table.replaceChildren(...groups);
    this.table.classList.toggle("many", all.length > MANY);
    this.filter.hidden = all.length <= VERY_MANY;
    if (this.filter.hidden) this.filter.value = "";
    this.#sift();
    this.question?.again();
  }

  /** Show the rows with what is typed in the filter. */
  #sift() {
    const wanted = this.filter.value.trim().toLowerCase();
    for (const [name, row] of this.#rows) row.element.hidden = !name.toLowerCase().includes(wanted);
    for (const group of this.table.children) group.hidden = !group.querySelector(".dimension:not([hidden])");
  }

  /** Without the server nothing can be changed. */
  #lock() {
    for (const row of this.#rows.values()) row.field.readOnly = !this.model.link.isOpen;
  }

  #mark(names) {
    const own = new Set(names);
    for (const [name, row] of this.#rows) row.element.classList.toggle("changed", own.has(name));
  }

  // -- edits -------------------------------------------------------------------

  /** Take a value if the mechanism with it is one; else say why under its field. */
  async #apply(name, value) {
    const { model } = this;
    if (!model.link.isOpen) return this.#rows.get(name)?.say(say("offline"));
    const wanted = withDimension(model.document, name, value);
    const before = model.document;
    try {
      const trial = await model.ask("check", { document: wanted });
      if (model.document !== before) return;
      if (trial && trial.header.state !== "moves") return this.#rows.get(name)?.say(trial.header.message);
    } catch (error) {
      return this.#rows.get(name)?.say(error.kind === "disconnected" ? say("offline") : error.message);
    }
    this.#edited = name;
    await model.edit(wanted);
  }

  #step(name, value) {
    const { model } = this;
    if (!model.link.isOpen) return;
    this.#edited = name;
    if (!model.previews.isUnderWay(this.#gesture)) this.#gesture = model.previews.begin();
    this.#steps.push({ gesture: this.#gesture, document: withDimension(model.document, name, value) });
  }

  /** All steps are one step of undo. */
  async #settle(row) {
    await this.#steps.settled();
    if (!row.isStepping) await this.model.previews.commit(this.#gesture);
  }

  async #restore() {
    await this.#steps.settled();
    await this.model.previews.cancel(this.#gesture);
  }

  /** What the present numbers cannot be shown for stands under the field that was changed. */
  #tellProblem() {
    const { problem } = this.model;
    for (const [name, row] of this.#rows) {
      const isConcerned = problem && name === (this.#rows.has(problem.dimension) ? problem.dimension : this.#edited);
      if (isConcerned) row.say(say("undoIt", { problem: problemText(problem, this.studio).replace(/\.$/, "") }));
      else if (!problem && name === this.#edited) row.say("");
    }
  }

  // -- effects -----------------------------------------------------------------

  #chooseOutput() {
    const { model, choice } = this;
    const outputs = outputsOf(model.data);
    const key = outputs.map((one) => one.of).join();
    if (choice.dataset.key !== key) {
      choice.dataset.key = key;
      const options = outputs.map(({ of, name, what }) => html("option", { value: of }, `${name} ${say(what)}`));
      choice.replaceChildren(...options);
      this.#ofOutput(null);
    }
    const isKnown = outputs.some((one) => one.of === model.output);
    const wanted = isKnown ? model.output : usualOutput(model.data);
    if (choice.value !== wanted) choice.value = wanted;
  }

  /** Show what an output's derivatives are, or why there are none. */
  #ofOutput(header, error) {
    this.remark.textContent = error ? say("noEffects", { reason: error.message }) : "";
    const { data } = this.model;
    const { factor, name: length } = panelLength(data);
    const isAngle = header?.unit === "rad";
    for (const byAngle of [false, true]) {
      const rows = [...this.#rows.values()].filter((row) => (row.unit === "rad") === byAngle);
      const value = ({ name }) => (header ? perUnit(header.by[name], isAngle, byAngle, factor) : NaN);
      const most = Math.max(0, ...rows.map((row) => Math.abs(value(row))).filter(Number.isFinite));
      for (const row of rows) row.affect(value(row), most);
    }
    const own = outputsOf(data).find((one) => one.of === this.choice.value);
    const unit = own?.isAngle ? "°" : length;
    this.per.textContent = `, ${say("per", { unit, by: length })}`;
    for (const group of this.table.children) {
      const isOfAngles = group.querySelector(".unit")?.textContent === "°";
      group.querySelector("h3 .note").textContent = isOfAngles ? say("per", { unit, by: "°" }) : "";
    }
  }
}
