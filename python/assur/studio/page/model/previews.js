// Gestures: previews of a document, which become one step when they are committed, or none.

import { newestOnly } from "./link.js";

/** Rows of a turn while something is dragged. */
export const ROWS_DRAGGED = 61;

export class Previews {
  /** What is under way, with what was before it; or null. */
  #gesture = null;
  #drags = newestOnly((fields) => this.#drag(fields));

  /** @param {import("./model.js").Model} model */
  constructor(model) {
    this.model = model;
  }

  /** Begin a gesture; another one that is not yet done is a step as far as it has come. */
  begin() {
    this.finish();
    this.#gesture = { before: this.model.snapshot(), isOver: false };
    return this.#gesture;
  }

  get isDragging() {
    return this.#gesture !== null;
  }

  /** Whether nothing more will come of the gesture than its last answer. */
  get isOver() {
    return this.#gesture?.isOver ?? true;
  }

  /** What was before the gesture under way. */
  get before() {
    return this.#gesture?.before ?? null;
  }

  /** Whether a gesture is still under way: another document may have come meanwhile. */
  isUnderWay(gesture) {
    return gesture !== null && gesture === this.#gesture;
  }

  leave() {
    this.#gesture = null;
  }

  /** Move a joint of a mechanism that moves; its dimensions follow. */
  dragJoint(joint, to) {
    this.#drags.push({ gesture: this.#gesture, joint, to, q: this.model.place });
  }

  /** Wait until the joint is where it was moved to last. */
  dragged() {
    return this.#drags.settled();
  }

  /** Show a document that is not yet a step. */
  async show(document) {
    if (this.#gesture) await this.model.become(document);
  }

  /** Make a step of a gesture, once its last answer has come. */
  async commit(gesture = this.#gesture) {
    const { model } = this;
    if (!this.isUnderWay(gesture)) return;
    gesture.isOver = true;
    await this.#drags.settled();
    if (!this.isUnderWay(gesture)) return;
    this.finish();
    if (gesture.before.document === model.document) return;
    model.emit("document");
    await model.look();
  }

  /** Make a step of the gesture as far as it has come, at once. */
  finish() {
    if (!this.#gesture) return;
    const { before } = this.#gesture;
    this.leave();
    if (before.document !== this.model.document) this.model.history.push(before);
  }

  /** As if the gesture had not begun: answers that still come are not for it. */
  async cancel(gesture = this.#gesture) {
    if (!this.isUnderWay(gesture)) return;
    const { before } = gesture;
    this.leave();
    if (before.document !== this.model.document) await this.model.become(before.document, before.place);
  }

  async #drag({ gesture, ...fields }) {
    const { model } = this;
    if (!this.isUnderWay(gesture)) return;
    try {
      const answer = await model.ask("drag", { ...fields, rows: ROWS_DRAGGED, orders: 2, axis: model.axis });
      if (!answer || !this.isUnderWay(gesture)) return;
      const { header } = answer;
      model.document = header.document;
      model.rev += 1;
      /** Names of the dimensions that have changed. */
      model.changed = header.changed;
      model.show(answer, header.q);
    } catch (error) {
      if (this.isUnderWay(gesture)) model.fail(error);
    }
  }
}
