// Asks for the map of the present design, again whenever what it depends on has changed.

import { newestOnly } from "../model/link.js";
import { designRange } from "./ranges.js";

/** Cells along a side at rest, and while something moves. */
const MAP_CELLS = 41;
const MAP_CELLS_MOVING = 21;
/** While something moves, maps that take longer wait until it rests, ms. */
const LIVE_WITHIN = 120;
/** A busy server is asked again after this time, ms. */
const BUSY_WAIT = 700;
/** How many times its value a dimension reaches on a map. */
const MAP_REACH = 1.5;
/** Of a driver that does not turn round the middle part of its reach is measured: at its ends nothing is. */
const MEASURED = 0.8;

/**
 * A map with what was asked: names of its dimensions, their ranges, the metric, and from where to
 * where q was measured, or null for a turn.
 * @typedef {import("./cells.js").Grid2 & {names: string[], axes: number[][],
 *   chosen: import("./metrics.js").MetricChoice, measured: number[] | null}} AskedMap
 */

/** Return from where to where q is measured, or null for a turn. */
export function measuredRange({ turn, data }, { isWhole }) {
  if (data.turn.unit === "angle" && (turn.closes || isWhole)) return null;
  const cut = ((1 - MEASURED) / 2) * (turn.high - turn.low);
  return [turn.low + cut, turn.high - cut];
}

export class MapAsking {
  /**
   * @param {import("../model/model.js").Model} model
   * @param {{got: (map: AskedMap) => void, failed: (text: string) => void, again: () => void}} on
   *   `again` where it should be followed once more
   */
  constructor(model, on) {
    this.model = model;
    this.on = on;
    /** The document whose turn and dimensions are shown. */
    this.shown = model.document;
    model.on("turn", () => (this.shown = model.document));
    this.maps = newestOnly((asked) => this.#ask(asked));
    this.forget();
  }

  /** Another mechanism: nothing is known of it. */
  forget() {
    this.known = "";
    this.took = 0;
    /** Cells along a side at rest: fewer where the server has no time for all. */
    this.cells = MAP_CELLS;
  }

  /** Whether what is shown is the present document. */
  get isReady() {
    const { model } = this;
    return model.link.isOpen && !model.problem && this.shown === model.document;
  }

  /**
   * Ask for a map, if it is not known.
   * @param {string[]} names of the two dimensions
   * @param {import("./metrics.js").MetricChoice} chosen
   * @param {AskedMap | null} before what is shown
   */
  follow(names, chosen, before) {
    const { model } = this;
    const isMoving = model.isDragging;
    if (isMoving && this.took > LIVE_WITHIN) return;
    const axes = names.map((name, i) => this.#axis(name, before?.names[i] === name ? before.axes[i] : null));
    // What the map does not depend on: the two dimensions themselves.
    const others = { ...model.document.dimensions };
    for (const name of names) delete others[name];
    const rest = JSON.stringify([{ ...model.document, dimensions: others, drawn: null }, names, axes, chosen.id]);
    const n = isMoving ? MAP_CELLS_MOVING : this.cells;
    const key = `${rest} ${n}`;
    if (key === this.known || this.known === `${rest} ${this.cells}`) return;
    this.known = key;
    this.maps.push({ document: model.document, key, n, names, axes, chosen });
  }

  /** From where to where: as before while the design is well inside. */
  #axis(name, before) {
    const { model } = this;
    if (model.isDragging && before) return before;
    const own = model.dimensions.find((one) => one.name === name);
    const [low, high] = before ?? [Infinity, -Infinity];
    const edge = (high - low) / 20;
    if (own.value > low + edge && own.value < high - edge) return before;
    return designRange(own, model.data.usual, MAP_REACH);
  }

  async #ask({ document, key, n, names, axes, chosen }) {
    const { model } = this;
    // What waited while the document changed is asked again once that has settled.
    const isStale = () => model.document !== document;
    const forget = () => key === this.known && (this.known = "");
    if (isStale()) return void forget();
    const measured = measuredRange(model, chosen);
    const side = (i) => ({ dimension: names[i], low: axes[i][0], high: axes[i][1] });
    const part = measured ? { low: measured[0], high: measured[1] } : {};
    const began = performance.now();
    try {
      const answer = await model.ask("map", { n, metric: chosen.spec, x: side(0), y: side(1), ...part });
      this.took = performance.now() - began;
      const asked = { names, axes, chosen, measured };
      if (!answer) forget();
      else if (key === this.known) this.on.got({ ...answer.arrays, reasons: answer.header.reasons, ...asked });
    } catch (error) {
      this.took = performance.now() - began;
      forget();
      this.#failed(error, isStale());
    }
  }

  #failed(error, isStale) {
    const isTooMuch = error.kind === "time_limit" && this.cells > MAP_CELLS_MOVING;
    if (isTooMuch) this.cells = MAP_CELLS_MOVING;
    // The server may still compute what it had no time for.
    if (isTooMuch || error.kind === "busy") setTimeout(this.on.again, BUSY_WAIT);
    else if (error.kind !== "disconnected" && !isStale) this.on.failed(error.message);
  }
}
