// A diagram of the lesson that is drawn as it runs: the curve of the turn thin, what has been run
// bold, with a cursor.

import { html, put, svg } from "../../../pictures/page/elements.js";
import { pathOf } from "../../../pictures/page/draw.js";
import { angleTicks, degrees, ticks, tickText } from "../../../pictures/page/numbers.js";
import { svgSymbols, withSymbols } from "./symbols.js";

const DIAGRAM_MARGIN = { left: 44, right: 16, top: 14, bottom: 24 };
/** Parts of a turn, each with one value of what has been run. */
const BINS = 720;
const BIN = (2 * Math.PI) / BINS;
const DIAGRAM_ROOM = 0.18;
let diagrams = 0;

/**
 * What a diagram shows beside what has been run.
 * @typedef {Object} DiagramData
 * @property {number} low where the turn begins, rad
 * @property {number} sense of the crank
 * @property {{points: number[][], kind: string, name?: string, isBelow?: boolean}[]} curves
 *   of crank angles within the turn; `isBelow`: their names are
 * @property {number[][]} blocked intervals of crank angles
 * @property {{angle: number, value: number, text: string}[]} [marks]
 * @property {number} [limit] what is below it is tinted
 * @property {string} [limitText]
 * @property {number} [least] the axis begins at it
 * @property {number} [span] the axis is at least so long
 * @property {boolean} [isAngle] values are angles, rad
 */

export class LessonDiagram {
  /**
   * @param {string} title
   * @param {(phi1: number) => void} seek
   * @param {(value: number) => string} write
   */
  constructor(title, seek, write) {
    this.write = write;
    this.trace = new Float64Array(BINS + 1).fill(NaN);
    this.value = html("output", { class: "value" });
    this.svg = svg("svg", { class: "plot", "aria-hidden": "true" });
    const name = html("h3", { class: "lesson-diagram-title" }, ...withSymbols(title));
    const head = html("div", { class: "chart-head" }, name, this.value);
    this.element = html("div", { class: "chart lesson-diagram" }, head, this.svg);
    this.hatch = `lesson-hatch-${(diagrams += 1)}`;
    this.width = 0;
    this.height = 0;
    const drag = (event) => {
      const box = this.svg.getBoundingClientRect();
      const { left, right } = DIAGRAM_MARGIN;
      const part = (event.clientX - box.left - left) / (this.width - left - right);
      seek(this.data.low + Math.min(Math.max(part, 0), 1 - 1e-9) * 2 * Math.PI);
    };
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      drag(event);
    });
    this.svg.addEventListener("pointermove", (event) => {
      if (this.svg.hasPointerCapture(event.pointerId)) drag(event);
    });
  }

  /** Show another motion; what has been run stays. */
  replace(data) {
    const isMoved = this.data && this.data.low !== data.low;
    this.data = data;
    if (isMoved) this.clear();
    this.draw();
  }

  /** Forget what has been run. */
  clear() {
    this.trace.fill(NaN);
    this.#traced();
  }

  /** Whether something has been run. */
  get traced() {
    return this.trace.filter(Number.isFinite).length;
  }

  /**
   * Note what has been run, from one crank angle to another, either way.
   * @param {number} from
   * @param {number} to
   * @param {(phi1: number) => number} valueAt
   */
  record(from, to, valueAt) {
    const [low, high] = from < to ? [from, to] : [to, from];
    const first = Math.ceil((low - this.data.low) / BIN - 1e-9);
    const last = Math.floor((high - this.data.low) / BIN + 1e-9);
    for (let k = Math.max(first, last - BINS); k <= last; k++) {
      const own = ((k % BINS) + BINS) % BINS;
      const value = valueAt(this.data.low + k * BIN);
      this.trace[own] = value;
      // The end of the axis is its beginning.
      if (own === 0) this.trace[BINS] = value;
    }
    this.#traced();
  }

  resize() {
    const { clientWidth, clientHeight } = this.svg;
    if (clientWidth === this.width && clientHeight === this.height) return;
    this.width = clientWidth;
    this.height = clientHeight;
    this.draw();
  }

  /** Return the range of the axis. */
  #range() {
    const { data } = this;
    let low = Infinity;
    let high = -Infinity;
    const take = (value) => {
      if (!Number.isFinite(value)) return;
      low = Math.min(low, value);
      high = Math.max(high, value);
    };
    for (const { points } of data.curves) for (const [, value] of points) take(value);
    this.trace.forEach(take);
    if (!(high >= low)) [low, high] = [0, 1];
    const middle = (low + high) / 2;
    const span = Math.max(high - low, data.span ?? 0, 1e-9 * Math.abs(middle));
    [low, high] = [middle - span / 2, middle + span / 2];
    if (data.least !== undefined) return [data.least, high + (high - data.least) * 0.08];
    return [low - DIAGRAM_ROOM * span, high + DIAGRAM_ROOM * span];
  }

  draw() {
    const { data, width, height } = this;
    if (!data || width < 90 || height < 60) return;
    const { left, right: rightMargin, top, bottom: bottomMargin } = DIAGRAM_MARGIN;
    const right = width - rightMargin;
    const bottom = height - bottomMargin;
    const [low, high] = this.#range();
    this.x = (angle) => left + ((angle - data.low) / (2 * Math.PI)) * (right - left);
    this.y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
    const nodes = [this.#pattern()];
    if (data.limit !== undefined) {
      const y = this.y(data.limit);
      nodes.push(
        svg("rect", { class: "lesson-below-limit", x: left, y, width: right - left, height: Math.max(bottom - y, 0) }),
        svg("line", { class: "lesson-limit", x1: left, x2: right, y1: y, y2: y }),
        svg("text", { class: "lesson-limit-text", x: right - 3, y: Math.min(y + 13, bottom - 3) }, data.limitText),
      );
    }
    const count = Math.max(2, Math.floor((bottom - top) / 32));
    const lines = data.isAngle ? angleTicks(low, high, count) : ticks(low, high, count);
    for (const value of lines) {
      const text = data.isAngle ? degrees(value, 0) : tickText(Math.abs(value) < 1e-9 * (high - low) ? 0 : value);
      const y = this.y(value);
      const isZero = Math.abs(value) < 1e-9 * (high - low);
      nodes.push(
        svg("line", { class: isZero ? "grid zero" : "grid", x1: left, x2: right, y1: y, y2: y }),
        svg("text", { class: "tick-y", x: left - 6, y: y + 4 }, text),
      );
    }
    nodes.push(svg("line", { class: "axis", x1: left, x2: right, y1: bottom, y2: bottom }));
    const many = Math.max(2, Math.floor((right - left) / 46));
    for (const angle of angleTicks(data.low, data.low + 2 * Math.PI, many)) {
      nodes.push(
        svg("line", { class: "axis", x1: this.x(angle), x2: this.x(angle), y1: bottom, y2: bottom + 4 }),
        svg("text", { class: "tick-x", x: this.x(angle), y: bottom + 18 }, degrees(angle, 0)),
      );
    }
    for (const [from, to] of data.blocked) {
      const box = { x: this.x(from), y: top, width: Math.max(this.x(to) - this.x(from), 1), height: bottom - top };
      nodes.push(svg("rect", { class: "lesson-hatched", ...box, fill: `url(#${this.hatch})` }));
    }
    for (const curve of data.curves) nodes.push(...this.#curve(curve));
    for (const { angle, value, text } of data.marks ?? []) {
      const [x, y] = [this.x(angle), this.y(value)];
      const isRight = x < right - 70;
      const side = "lesson-mark-text";
      nodes.push(
        svg("circle", { class: "lesson-mark", cx: x, cy: y, r: 4 }),
        svg("text", { class: isRight ? side : `${side} lesson-mark-left`, x: x + (isRight ? 9 : -9), y: y + 8 }, text),
      );
    }
    this.run = svg("path", { class: "curve ink lesson-run-curve" });
    this.cursor = svg("line", { class: "cursor", y1: top - 6, y2: bottom });
    this.point = svg("circle", { class: "point ink", r: 4.6 });
    this.svg.replaceChildren(...nodes, this.run, this.cursor, this.point);
    this.#traced();
    if (this.at) this.show(...this.at);
  }

  #pattern() {
    const lines = svg("path", { class: "lesson-hatch-line", d: "M-1 7L7 -1M-1 1L1 -1M5 7L7 5" });
    const size = { width: 6, height: 6, patternUnits: "userSpaceOnUse" };
    return svg("defs", {}, svg("pattern", { id: this.hatch, ...size }, lines));
  }

  #curve({ points, kind, name, isBelow }) {
    const own = `lesson-curve lesson-curve-${kind}`;
    const nodes = this.#lines(points).map((line) => svg("path", { class: own, d: pathOf(line) }));
    if (name) {
      // Where the rocker is farthest out: there curves of different grounds are apart.
      const away = ([angle]) => Math.abs(Math.cos(angle) + 1);
      const middle = points.reduce((best, one) => (away(one) < away(best) ? one : best));
      const at = { x: this.x(middle[0]), y: this.y(middle[1]) + (isBelow ? 17 : -8) };
      if (Number.isFinite(at.y)) nodes.push(svg("text", { class: "lesson-curve-name", ...at }, ...svgSymbols(name)));
    }
    return nodes;
  }

  /** Return polylines, broken where there is no value and where an angle jumps by a turn. */
  #lines(points) {
    const lines = [];
    let line = null;
    let last = NaN;
    for (const [angle, value] of points) {
      const isBroken = !Number.isFinite(value) || (this.data.isAngle && Math.abs(value - last) > Math.PI);
      if (isBroken) line = null;
      last = value;
      if (!Number.isFinite(value)) continue;
      if (!line) lines.push((line = []));
      line.push([this.x(angle), this.y(value)]);
    }
    return lines;
  }

  #traced() {
    if (!this.run || !this.data) return;
    const points = Array.from(this.trace, (value, k) => [this.data.low + k * BIN, value]);
    put(this.run, "d", this.#lines(points).map((line) => pathOf(line)).join(""));
  }

  /** Move the cursor. */
  show(angle, value) {
    this.at = [angle, value];
    this.value.textContent = this.write(value);
    if (!this.cursor) return;
    const own = angle - 2 * Math.PI * Math.floor((angle - this.data.low) / (2 * Math.PI));
    const x = this.x(own).toFixed(2);
    put(this.cursor, "x1", x);
    put(this.cursor, "x2", x);
    put(this.point, "cx", x);
    put(this.point, "cy", Number.isFinite(value) ? this.y(value).toFixed(2) : "-99");
  }
}
