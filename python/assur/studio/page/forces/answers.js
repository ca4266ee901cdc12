// Forces of the present document, over the turn at the present speed, or along the run that is shown.

import { isTable, listOf, tableOf } from "../document/names.js";
import { newestOnly } from "../model/link.js";
import { Along } from "./along.js";

/** A speed that is being typed is asked for when it has rested, ms. */
const REST = 180;

/** Whether a document has masses, loads, a motor or friction: what a machine has beside its mechanism. */
export function hasMachine(document) {
  const tables = [document.bodies, document.friction].map((one) => Object.keys(tableOf(one)).length);
  const lists = [document.loads, document.motor].map((one) => listOf(one).length);
  return [...tables, ...lists].some(Boolean) || isTable(document.motor);
}

/**
 * Forces along rows.
 * @typedef {Object} Forces
 * @property {Along} along
 * @property {{joint: string, on: string, from: string | null}[]} joints
 * @property {{slide: string, on: string, from: string}[]} slides
 * @property {{load: number, on: string, joint: string | null}[]} applied
 * @property {Object<string, Float64Array>} arrays
 * @property {number | null} speed of the driver; null along a run
 */

/** Events of the model: `forces` there are others, or none. */
export class ForceAnswers {
  /**
   * What is kept with the model: it stays when the window is made anew.
   * @param {import("../model/model.js").Model} model
   */
  static of(model) {
    return (model.forces ??= new ForceAnswers(model));
  }

  constructor(model) {
    this.model = model;
    /** @type {Forces | null} */
    this.forces = null;
    /** Why there are none: an error of the server, with the place in `key`; or null. */
    this.error = null;
    /** Whether they are drawn; sections that are folded in; what runs and flywheels are asked with. */
    this.isShown = true;
    this.folded = {};
    this.wanted = {};
    this.asked = { document: null, speed: null };
    this.requests = newestOnly(() => this.#ask());
  }

  /** Listen to the model, of a window that shows the speed. */
  attach(speed) {
    const { model } = this;
    this.speed = speed;
    for (const event of ["document", "checked"]) model.on(event, () => this.#drop());
    model.on("settled", () => this.refresh());
    model.on("run", () => this.#takeRun());
    model.on("pose", () => this.#watchSpeed());
    // A window that is made anew gets its speed next.
    setTimeout(() => this.refresh(), 0);
  }

  /** Whether the forces are those of the document that is shown. */
  get isPresent() {
    return this.forces !== null && (this.model.run !== null || this.asked.document === this.model.document);
  }

  /** Whether a document can have forces. */
  get canBe() {
    const { model } = this;
    return model.moves && model.driverCount === 1 && hasMachine(model.document);
  }

  refresh() {
    if (this.model.run || !this.canBe || this.model.isDragging) return;
    const { document } = this.model;
    if (this.asked.document === document && this.asked.speed === this.speed()) return;
    this.requests.push(null);
  }

  #watchSpeed() {
    const { model, asked } = this;
    if (model.run || !this.canBe || asked.document !== model.document || asked.speed === this.speed()) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.refresh(), REST);
  }

  /** What cannot have forces has none. */
  #drop() {
    if (this.canBe || this.model.run) return;
    this.asked = { document: null, speed: null };
    this.#take(null, null);
  }

  async #ask() {
    const { model } = this;
    const { document } = model;
    const speed = this.speed();
    this.asked = { document, speed };
    try {
      const answer = await model.ask("reactions", { speed, begin: model.q });
      if (!answer || model.document !== document || model.run) return;
      const { header, arrays } = answer;
      this.#take({ ...header, arrays, speed, along: new Along(arrays.q, model.turn?.closes ?? false) }, null);
    } catch (error) {
      if (error.kind === "disconnected") this.asked = { document: null, speed: null };
      else if (model.document === document && !model.run) this.#take(null, error);
    }
  }

  #takeRun() {
    const { run } = this.model;
    if (run) {
      const { reactions } = run.header;
      const along = new Along(run.arrays.t, false);
      this.#take(reactions ? { ...reactions, arrays: run.arrays, speed: null, along } : null, null);
    } else {
      this.asked = { document: null, speed: null };
      this.#take(null, null);
      this.refresh();
    }
  }

  #take(forces, error) {
    if (forces === null && error === null && this.forces === null && this.error === null) return;
    this.forces = forces;
    this.error = error;
    this.model.emit("forces");
  }
}

/** Return force or moment of the driver at a place, and the power with it. */
export function driveAt(forces, place) {
  const [drive] = forces.along.at(forces.arrays.drive, place);
  const speed = forces.speed ?? forces.along.at(forces.arrays.speed, place)[0];
  return { drive, power: drive * speed };
}

/** Return the force in a joint (number `i` of `joints`) at a place: x, y, N. */
export const jointForce = (forces, i, place) => forces.along.at(
  forces.arrays.forces, place, 2 * forces.joints.length, 2 * i, 2,
);

/** Return a slide's normal force and moment at a place. */
export const slideForce = (forces, i, place) => forces.along.at(
  forces.arrays.slide_forces, place, 3 * forces.slides.length, 3 * i, 2,
);

/** Return a load's place and force: x, y, Fx, Fy. */
export const appliedForce = (forces, i, place) => forces.along.at(
  forces.arrays.applied, place, 4 * forces.applied.length, 4 * i, 4,
);
