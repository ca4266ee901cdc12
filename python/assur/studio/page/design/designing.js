// Dimensions that follow a hand: shown as fast as answers come, one step of undo; where the mechanism
// cannot be assembled the last good design stays.

import { setDimension } from "../document/machine.js";
import { newestOnly } from "../model/link.js";
import { problemText } from "../panel/problem.js";
import { designChoices } from "./choices.js";

export class Designing {
  /**
   * @param {import("../studio.js").Studio} page
   */
  constructor(page) {
    const { model } = page;
    this.page = page;
    this.model = model;
    /** Called when a design was shown or refused, and at the end. */
    this.listeners = new Set();
    this.choices = designChoices(model);
    this.isOn = false;
    /** What was wanted, by dimension, SI, and why it cannot be had, or an empty text. */
    this.wanted = {};
    this.refusal = "";
    this.previews = newestOnly((values) => this.#preview(values));
    // What was refused belongs to the document of then.
    model.on("document", () => {
      if (!this.isOn) this.refusal = "";
    });
  }

  #closing = null;
  #isEnding = false;

  /**
   * Want other values; the first begins the gesture.
   * @param {Object<string, number>} values SI, by dimension
   */
  set(values) {
    if (this.#closing) return void this.#closing.then(() => this.set(values));
    const { model } = this;
    this.#isEnding = false;
    if (!this.isOn) {
      this.gesture = model.previews.begin();
      this.isOn = true;
      this.wanted = {};
      this.good = this.start = model.document;
    }
    this.wanted = { ...this.wanted, ...values };
    this.previews.push(this.wanted);
  }

  async #preview(values) {
    const { model } = this;
    if (!this.isOn || !model.previews.isUnderWay(this.gesture)) return;
    let document = this.start;
    for (const name in values) document = setDimension(document, name, values[name]);
    await model.previews.show(document);
    const isGood = model.moves && !model.problem;
    if (isGood) this.good = document;
    this.refusal = isGood ? "" : this.#reason();
    this.#tell();
  }

  #reason() {
    const { problem, checked } = this.model;
    return problem ? problemText(problem, this.page) : checked.message;
  }

  #tell() {
    for (const listener of this.listeners) listener();
  }

  /** Let go: the last design that could be shown is a step. */
  async end() {
    if (this.#closing) return this.#closing.then(() => this.end());
    if (!this.isOn) return undefined;
    this.#isEnding = true;
    await this.previews.settled();
    if (!this.#isEnding || this.#closing) return undefined;
    this.#closing = this.#close(async () => {
      // Without any good one it is as if it had not begun.
      if (this.good === this.start) return this.model.previews.cancel(this.gesture);
      if (this.model.document !== this.good && this.model.previews.isUnderWay(this.gesture)) await this.model.previews.show(this.good);
      return this.model.previews.commit(this.gesture);
    });
    return this.#closing;
  }

  /**
   * End it when a slider is let go.
   * @param {HTMLInputElement} range which tells no change if its value was put back meanwhile
   */
  endWith(range) {
    for (const event of ["change", "pointerup", "pointercancel", "blur"]) range.addEventListener(event, () => this.end());
  }

  /** As if it had not begun. */
  async cancel() {
    if (!this.isOn || this.#closing) return;
    await this.previews.settled();
    this.refusal = "";
    this.#closing = this.#close(() => this.model.previews.cancel(this.gesture));
    await this.#closing;
  }

  async #close(act) {
    try {
      await act();
    } finally {
      this.isOn = this.#isEnding = false;
      this.#closing = null;
      this.#tell();
    }
  }
}
