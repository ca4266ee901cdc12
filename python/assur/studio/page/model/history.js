// Undo and redo: documents as they were. A gesture is one step.

/** Steps that are kept. */
const MOST_STEPS = 200;

/**
 * What a step brings back.
 * @typedef {{document: Object, title: string, place: any}} Snapshot
 */

export class History {
  #past = [];
  #future = [];

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  clear() {
    this.#past = [];
    this.#future = [];
  }

  /** Keep what was before a change. */
  push(snapshot) {
    this.#past.push(snapshot);
    if (this.#past.length > MOST_STEPS) this.#past.shift();
    this.#future = [];
  }

  /**
   * Return the step before, and keep the present one for redo.
   * @returns {Snapshot | undefined}
   */
  undo(present) {
    return this.#step(this.#past, this.#future, present);
  }

  redo(present) {
    return this.#step(this.#future, this.#past, present);
  }

  #step(from, to, present) {
    const found = from.pop();
    if (found) to.push(present);
    return found;
  }
}
