// The live map of two dimensions: how good the neighbours of this design are, and which do not work.

import { html } from "../../../pictures/page/elements.js";
import { tickText } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { helpButton } from "../help/help.js";
import { ownCoordinateText } from "../panel/coordinate.js";
import { section } from "../window/shell.js";
import { colourRange } from "./cells.js";
import { colourBar, MapPicture } from "./chartmap.js";
import { designChoices } from "./choices.js";
import { MapAsking } from "./mapasking.js";
import { MapWords } from "./mapwords.js";
import { metricChoices, reasonText } from "./metrics.js";
import { dimensionText, mostUsefulFirst, roundedWithin } from "./ranges.js";

export class MapSection {
  /**
   * @param {Object} page the studio
   * @param {import("./designing.js").Designing} designing
   */
  constructor(page, designing) {
    this.page = page;
    this.model = page.model;
    this.designing = designing;
    this.isSeen = false;
    this.words = new MapWords(this.model);
    this.#build();
    this.asking = new MapAsking(this.model, {
      got: (grid) => {
        this.grid = this.words.grid = grid;
        this.#complain("");
        this.#draw();
      },
      failed: (text) => this.#complain(text),
      again: () => this.#follow(),
    });
    const { model } = this;
    model.on("settled", () => this.#follow());
    model.on("checked", () => this.show());
    model.on("turn", () => this.show());
    model.on("connection", () => this.#follow());
    // Another mechanism may have dimensions of the same names: ranges are chosen anew.
    model.on("file", () => {
      this.grid = null;
      this.asking.forget();
      this.#follow();
    });
    new IntersectionObserver((entries) => {
      this.isSeen = entries.at(-1).isIntersecting;
      this.#follow();
    }).observe(this.element);
    new ResizeObserver(() => this.grid && this.#draw()).observe(this.picture.element);
    designing.listeners.add(() => this.show());
    this.show();
  }

  #build() {
    const make = (label, change) => {
      const select = html("select", { class: "number", "aria-label": label });
      select.addEventListener("change", () => {
        change(select.value);
        this.show();
        this.#follow();
      });
      return select;
    };
    const choices = designChoices(this.model);
    this.metric = make(say("mapMetric"), (value) => (choices.metric = value));
    this.across = make(say("mapAcross"), (value) => this.#choose("across", "up", value));
    this.up = make(say("mapUp"), (value) => this.#choose("up", "across", value));
    this.picture = new MapPicture({
      label: say("mapRing"),
      pick: (x, y) => this.#pick(x, y),
      drop: () => this.designing.end(),
      cancel: () => this.designing.cancel(),
      hover: (x, y) => this.grid && (this.told.textContent = this.words.at(x, y)),
      leave: () => this.#tellPresent(),
      step: (dx, dy) => this.#step(dx, dy),
    });
    this.legend = html("div", { class: "map-legend" });
    this.axesText = html("span", { class: "note" });
    this.told = html("p", { class: "map-told" });
    this.trouble = html("p", { class: "field-error", hidden: "" });
    const line = (...children) => html("div", { class: "map-choices" }, ...children);
    const pair = line(this.across, html("span", { "aria-hidden": "true" }, "×"), this.up);
    const foot = html("div", { class: "map-foot" }, this.axesText, this.legend);
    this.figure = html("div", { class: "map-figure" }, this.picture.element, foot, this.told);
    const parts = [line(this.metric), pair, this.trouble, this.figure];
    const { element, note, head } = section(say("mapTitle"), "dimensions", ...parts);
    this.note = note;
    this.explain = helpButton(this.page, () => this.chosen.term);
    head.firstChild.after(this.explain);
    this.element = element;
  }

  /** Two dimensions of one name change places. */
  #choose(own, other, value) {
    const choices = designChoices(this.model);
    const [x, y] = this.pair;
    const before = { across: x, up: y };
    if (before[other] === value) choices[other] = before[own];
    else choices[other] = before[other];
    choices[own] = value;
  }

  /** The two dimensions. */
  get pair() {
    const { dimensions, document } = this.model;
    const { across, up } = designChoices(this.model);
    const isKnown = (name) => dimensions.some((one) => one.name === name);
    if (isKnown(across) && isKnown(up)) return [across, up];
    return mostUsefulFirst(dimensions, [document.driver].flat()).slice(0, 2);
  }

  #dimension(name) {
    return this.model.dimensions.find((one) => one.name === name);
  }

  get choices() {
    const { data, checked } = this.model;
    return metricChoices(data, checked.assembly, data.turn.unit === "angle");
  }

  get chosen() {
    const { choices } = this;
    return choices.find((one) => one.id === designChoices(this.model).metric) ?? choices[0];
  }

  show() {
    const { model } = this;
    const { dimensions } = model;
    const isThere = !model.isSketch && model.moves && model.driverCount === 1 && dimensions.length > 1;
    this.element.hidden = !(isThere && this.choices.length);
    if (this.element.hidden) return;
    this.explain.hidden = !this.chosen.term;
    const names = dimensions.map(({ name }) => [name, dimensionText(name)]);
    const [x, y] = this.pair;
    this.#offer(this.metric, this.choices.map(({ id, text }) => [id, text]), this.chosen.id);
    this.#offer(this.across, names, x);
    this.#offer(this.up, names, y);
    if (this.grid && this.grid.names.join() === this.pair.join()) this.#tellPresent();
  }

  #offer(select, entries, chosen) {
    const texts = entries.map(([value, text]) => `${value}=${text}`).join();
    if (select.dataset.offered !== texts) {
      select.dataset.offered = texts;
      select.replaceChildren(...entries.map(([value, text]) => html("option", { value }, text)));
    }
    select.value = chosen;
  }

  // -- asking ------------------------------------------------------------------

  /** Ask for the map of the present design, if it is seen. */
  #follow() {
    if (this.element.hidden || !this.isSeen || !this.asking.isReady) return;
    this.asking.follow(this.pair, this.chosen, this.grid);
  }

  #complain(text) {
    this.trouble.hidden = !text;
    this.trouble.textContent = text;
    this.figure.hidden = Boolean(text);
  }

  // -- showing -----------------------------------------------------------------

  #draw() {
    const { grid, words } = this;
    const [x, y] = grid.names.map((name) => words.unit(name));
    const { factor } = words.valueUnit;
    const range = colourRange(grid.value, factor);
    this.picture.draw(grid, range, { value: factor, x: x.factor, y: y.factor }, grid.reasons.map(reasonText));
    const units = x.name === y.name ? x.name : `${x.name} × ${y.name}`;
    this.axesText.textContent = `${grid.names.map(dimensionText).join(" × ")}, ${units}`;
    this.legend.replaceChildren(...this.#colours(range, factor));
    this.picture.element.setAttribute("aria-label", words.sentence());
    this.#tellPresent();
  }

  /** The colours between their ends; of one value that alone. */
  #colours(range, factor) {
    if (!range) return [];
    const [low, high] = [range.low, range.high].map((end) => this.words.value(end / factor, tickText));
    return low === high ? [low] : colourBar(low, high);
  }

  #tellPresent() {
    if (!this.grid) return;
    const { wanted, isOn, refusal } = this.designing;
    const present = (name) => (isOn ? wanted[name] : undefined) ?? this.#dimension(name)?.value;
    const [x, y] = this.grid.names.map(present);
    if (x === undefined || y === undefined) return;
    const words = this.words.at(x, y);
    this.picture.place(x, y, words);
    this.told.textContent = isOn && refusal ? `${words}. ${refusal}` : words;
    const ends = this.grid.measured?.map((q) => ownCoordinateText(this.model, q));
    this.note.textContent = ends ? say("mapMeasured", { low: ends[0], high: ends[1] }) : say("mapLive");
  }

  // -- the ring ----------------------------------------------------------------

  #pick(x, y) {
    if (!this.grid || !this.model.link.isOpen) return;
    const { names, axes } = this.grid;
    const round = (value, i) => roundedWithin(value, axes[i], this.words.unit(names[i]).factor);
    this.designing.set({ [names[0]]: round(x, 0), [names[1]]: round(y, 1) });
    this.#tellPresent();
  }

  /** Steps of a hundredth of the sides. */
  async #step(...ways) {
    if (!this.grid || !this.model.link.isOpen) return;
    const { names, axes } = this.grid;
    const { wanted, isOn } = this.designing;
    const [x, y] = names.map((name, i) => {
      const present = isOn && name in wanted ? wanted[name] : this.#dimension(name).value;
      const [low, high] = axes[i];
      // Only the dimension that is stepped gets a round value.
      const next = present + (ways[i] * (high - low)) / 100;
      return ways[i] ? roundedWithin(next, axes[i], this.words.unit(name).factor) : present;
    });
    this.designing.set({ [names[0]]: x, [names[1]]: y });
    this.#tellPresent();
    await this.designing.end();
  }
}
