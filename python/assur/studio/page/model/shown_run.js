// A motion over time that is shown in place of the turn, until the document changes.

import { Turn } from "../../../pictures/page/turn.js";

export class ShownRun {
  /** The answer to `run` of the protocol; or null. */
  answer = null;
  #turnBefore = null;

  /** @param {import("./model.js").Model} model */
  constructor(model) {
    this.model = model;
  }

  show({ header, arrays }) {
    const { model } = this;
    const { payload } = header;
    this.#turnBefore ??= { data: model.data, turn: model.turn, held: [...model.held] };
    this.answer = { header, arrays };
    model.data = { ...payload, title: model.title, turn: { ...payload.turn, values: arrays.values } };
    model.turn = new Turn(model.data.turn);
    model.emit("turn");
    model.emit("run");
  }

  /** Show the turn again. */
  end() {
    if (!this.answer) return;
    const before = this.#turnBefore;
    this.forget();
    Object.assign(this.model, before);
    this.model.emit("turn");
    this.model.emit("run");
  }

  forget() {
    this.answer = null;
    this.#turnBefore = null;
  }

  /** Be where the run is at a time. */
  follow(t) {
    const { q, t: times } = this.answer.arrays;
    const rows = times.length;
    const place = ((t - times[0]) / (times[rows - 1] - times[0])) * (rows - 1);
    const row = Math.min(Math.max(Math.floor(place), 0), rows - 2);
    const count = q.length / rows;
    const at = (i) => q[row * count + i] + (place - row) * (q[(row + 1) * count + i] - q[row * count + i]);
    this.model.held = this.model.held.map((_, i) => at(i));
  }
}
