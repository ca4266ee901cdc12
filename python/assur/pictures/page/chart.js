// A diagram of one quantity over the coordinate, with a cursor and its extremes.

import { html, put, svg, write } from "./elements.js";
import { pathOf } from "./draw.js";
import { angleTicks, degrees, digits, ticks, tickText } from "./numbers.js";
import { roleOf, unitOf } from "./quantities.js";

const CHART_MARGIN = { left: 46, right: 20, top: 12, bottom: 22 };
const SAMPLES = 360;
/** Room above and below the curve, relative to its range, and at least for a number, px. */
const HEADROOM = 0.18;
const NUMBER = 22;
/** Values so many times the usual ones go beyond the picture: at dead points they are infinite. */
const BEYOND = 5;
/** A press works in a small part of its turn: its peaks are what is asked for. */
const FORCE_PEAK = 50;
const USUAL = 0.85;
/** Changes less than this part of what is large are rounding. */
const CONSTANT = 2e-5;

/**
 * Return the range of a diagram.
 * @param {number[]} values
 * @param {number[]} places of the values: they may be denser here and there
 * @param {number} size what is large
 * @param {number} height px
 * @param {number} [beyond] so many times the usual values are shown
 * @returns {{low: number, high: number, isCut: boolean, isConstant: boolean}}
 */
export function chartRange(values, places, size, height, beyond = BEYOND) {
  const known = values.map((value, i) => i).filter((i) => Number.isFinite(values[i]));
  if (!known.length) return { low: -1, high: 1, isCut: false, isConstant: true };
  let low = Math.min(...known.map((i) => values[i]));
  let high = Math.max(...known.map((i) => values[i]));
  // Sizes by how much of the axis has them.
  const sizes = known.map((i) => {
    const width = (places[i + 1] ?? places[i]) - (places[i - 1] ?? places[i]);
    return { size: Math.abs(values[i]), width };
  });
  sizes.sort((a, b) => a.size - b.size);
  let rest = USUAL * sizes.reduce((sum, one) => sum + one.width, 0);
  const usual = sizes.find((one) => (rest -= one.width) <= 0)?.size ?? 0;
  const limit = beyond * usual;
  const isCut = limit > CONSTANT * size && Math.max(-low, high) > 2 * limit;
  if (isCut) {
    low = Math.max(low, -limit);
    high = Math.min(high, limit);
  }
  let span = high - low;
  const isConstant = span <= CONSTANT * Math.max(size, Math.abs(low), Math.abs(high));
  // Nothing moves at speed 0: any range shows it.
  if (isConstant) span = Math.max(Math.abs(high), size) || 1;
  const room = Math.max(HEADROOM, NUMBER / Math.max(height - 2 * NUMBER, NUMBER)) * span;
  return { low: low - room, high: high + room, isCut, isConstant };
}

/** Return the indices of the least and the greatest value. */
export function extremes(values) {
  let least = -1;
  let greatest = -1;
  values.forEach((value, i) => {
    if (!Number.isFinite(value)) return;
    if (least < 0 || value < values[least]) least = i;
    if (greatest < 0 || value > values[greatest]) greatest = i;
  });
  return least < 0 ? [] : [least, greatest];
}

export class Chart {
  /**
   * @param {import("./turn.js").Turn} turn
   * @param {{name: string, quantities: import("./quantities.js").Quantity[]}[]} groups
   * @param {{label: string, unit: string, words: (quantity: Object) => string, seek: (q: number) => void,
   *   place: (q: number) => string, scaled: number}} options `scaled`: units of the axis to one of q
   */
  constructor(turn, groups, options) {
    this.options = options;
    this.quantity = null;
    this.speed = 1;
    this.width = 0;
    this.height = 0;
    /** Where the axis begins, px. */
    this.left = CHART_MARGIN.left;
    this.title = html("select", { class: "title", "aria-label": options.label });
    this.replace(turn, groups);
    this.title.addEventListener("change", () => this.choose(this.title.value));
    this.value = html("output", { class: "value" });
    this.svg = svg("svg", { class: "plot", "aria-hidden": "true" });
    this.element = html("div", { class: "chart" }, html("div", { class: "chart-head" }, html("div", { class: "choose" }, this.title), this.value), this.svg);
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      this.#drag(event);
    });
    this.svg.addEventListener("pointermove", (event) => {
      if (this.svg.hasPointerCapture(event.pointerId)) this.#drag(event);
    });
  }

  /** Take another turn, and what can be shown of it; drawn when it is chosen. */
  replace(turn, groups, options = {}) {
    Object.assign(this.options, options);
    const ids = (list) => list.flatMap((group) => group.quantities.map((one) => one.id)).join();
    const isSame = this.groups && ids(this.groups) === ids(groups);
    this.turn = turn;
    this.groups = groups;
    this.pose = null;
    if (isSame) return;
    const grouped = groups.map(({ name, quantities }) => {
      const own = quantities.map((one) => html("option", { value: one.id }, this.options.words(one)));
      return html("optgroup", { label: name }, ...own);
    });
    this.title.replaceChildren(...grouped);
  }

  /** Show another quantity, by its id. */
  choose(id) {
    this.pick(id);
    this.draw();
  }

  /** Choose a quantity; it is drawn next. */
  pick(id) {
    const known = this.groups.flatMap((group) => group.quantities);
    this.quantity = known.find((one) => one.id === id) ?? known[0];
    this.title.value = this.quantity?.id ?? "";
  }

  #drag(event) {
    const box = this.svg.getBoundingClientRect();
    const { low, high } = this.turn;
    const part = (event.clientX - box.left - this.left) / (this.width - this.left - CHART_MARGIN.right);
    // Within: the end of the axis is not its beginning.
    this.options.seek(low + Math.min(Math.max(part, 0), 1 - 1e-9) * (high - low));
  }

  resize() {
    const { clientWidth, clientHeight } = this.svg;
    if (clientWidth === this.width && clientHeight === this.height) return;
    this.width = clientWidth;
    this.height = clientHeight;
    this.draw();
  }

  /** Draw the curve, for this quantity, speed and size. */
  draw() {
    const { turn, quantity, width, height } = this;
    if (!quantity || !turn || width < 80 || height < 60) return;
    const pose = turn.pose();
    // A turn that is dragged has few rows.
    const count = Math.min(SAMPLES, 2 * (turn.rows - 1));
    const places = turn.coordinates(count);
    const values = places.map((q, i) => {
      // The last of a closed motion is the first: angles have gone on by a turn.
      turn.sample(turn.closes && i === count ? q - 1e-9 : q, pose, quantity.links);
      return pose.known ? quantity.value(pose, this.speed) : NaN;
    });
    const right = width - CHART_MARGIN.right;
    const bottom = height - CHART_MARGIN.bottom;
    const large = quantity.size * Math.abs(this.speed) ** quantity.order;
    const { factor } = (this.unit = unitOf(quantity, Math.max(...values.filter(Number.isFinite).map(Math.abs), 0)));
    values.forEach((value, i) => (values[i] = value * factor));
    const { low, high, isCut, isConstant } = chartRange(values, places, large * factor, bottom - CHART_MARGIN.top, quantity.role === "force" ? FORCE_PEAK : BEYOND);
    const role = roleOf(quantity);
    const lines = ticks(low, high, Math.max(2, Math.floor((bottom - CHART_MARGIN.top) / 34)));
    const texts = lines.map((value) => tickText(Math.abs(value) < 1e-9 * (high - low) ? 0 : value));
    // Long numbers take more room.
    const left = Math.max(CHART_MARGIN.left, 14 + 6.6 * Math.max(...texts.map((text) => text.length)));
    this.left = left;
    const x = (q) => left + ((q - turn.low) / (turn.high - turn.low)) * (right - left);
    const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - CHART_MARGIN.top);
    this.x = x;
    this.y = (value) => Math.min(Math.max(y(value), CHART_MARGIN.top), bottom);
    const nodes = [];
    lines.forEach((value, i) => {
      const isZero = texts[i] === "0";
      nodes.push(
        svg("line", { class: isZero ? "grid zero" : "grid", x1: left, x2: right, y1: y(value), y2: y(value) }),
        svg("text", { class: "tick-y", x: left - 7, y: y(value) + 4 }, texts[i]),
      );
    });
    const isAngle = this.options.unit === "angle";
    const most = Math.max(2, Math.floor((right - left) / 44));
    const { scaled } = this.options;
    const marks = isAngle
      ? angleTicks(turn.low, turn.high, most)
      : ticks(turn.low * scaled, turn.high * scaled, most).map((mark) => mark / scaled);
    nodes.push(svg("line", { class: "axis", x1: left, x2: right, y1: bottom, y2: bottom }));
    for (const q of marks) {
      nodes.push(
        svg("line", { class: "axis", x1: x(q), x2: x(q), y1: bottom, y2: bottom + 4 }),
        svg("text", { class: "tick-x", x: x(q), y: bottom + 17 }, isAngle ? degrees(q, 0) : this.options.place(q)),
      );
    }
    // Beyond the picture the curve stays at its edge, and is broken there.
    let line = null;
    const curves = [];
    values.forEach((value, i) => {
      if (!Number.isFinite(value) || value > high || value < low) {
        line = null;
        return;
      }
      if (!line) curves.push((line = []));
      line.push([x(places[i]), y(value)]);
    });
    for (const curve of curves) nodes.push(svg("path", { class: `curve ${role}`, d: pathOf(curve) }));
    for (const i of isCut || isConstant ? [] : extremes(values)) {
      const [px, py] = [x(places[i]), y(values[i])];
      const isHigh = values[i] > (low + high) / 2;
      const half = 22;
      const text = svg("text", { class: "extreme", x: Math.min(Math.max(px, left + half), right - half + 8), y: py + (isHigh ? -9 : 18) });
      text.append(digits(values[i]));
      nodes.push(svg("circle", { class: `mark ${role}`, cx: px, cy: py, r: 3.6 }), text);
    }
    this.cursor = svg("line", { class: "cursor", y1: CHART_MARGIN.top - 6, y2: bottom });
    this.point = svg("circle", { class: `point ${role}`, r: 4.2 });
    this.svg.replaceChildren(...nodes, this.cursor, this.point);
    if (this.pose) this.show(this.pose);
  }

  /** Move the cursor. */
  show(pose) {
    this.pose = pose;
    if (!this.cursor || !this.quantity) return;
    const { factor, name } = this.unit;
    const value = pose.known ? factor * this.quantity.value(pose, this.speed) : NaN;
    const px = this.x(pose.q).toFixed(2);
    put(this.cursor, "x1", px);
    put(this.cursor, "x2", px);
    put(this.point, "cx", px);
    put(this.point, "cy", Number.isFinite(value) ? this.y(value).toFixed(2) : "-99");
    write(this.value, `${digits(value)}${name === "°" ? "" : " "}${name}`);
  }
}
