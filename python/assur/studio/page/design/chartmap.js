// The picture of a map: cells in steps of colour, hatching where there is no value, axes, a ring.

import { put, svg } from "../../../pictures/page/elements.js";
import { ticks, tickText } from "../../../pictures/page/numbers.js";
import { cellPaths, COLOUR_STEPS, partOfSide, roomFor, stepOf, valueAtPart } from "./cells.js";

const MAP_MARGIN = { left: 34, right: 12, top: 8, bottom: 20 };
const MAP_HEIGHT = 200;
/** A letter of a reason, and its line, px. */
const LETTER = 6.6;
const LINE = 16;
let maps = 0;

export class MapPicture {
  /**
   * @param {{label: string, pick: (x: number, y: number) => void, drop: () => void, cancel: () => void,
   *   hover: (x: number, y: number) => void, leave: () => void, step: (dx: number, dy: number) => void}} on
   *   places are values of the dimensions, SI
   */
  constructor(on) {
    this.on = on;
    this.hatching = `map-hatching-${++maps}`;
    const stroke = svg("path", { class: "map-hatch", d: "M-1 7L7 -1M-1 1L1 -1M5 7L7 5" });
    const pattern = svg("pattern", { id: this.hatching, width: 6, height: 6, patternUnits: "userSpaceOnUse" }, stroke);
    this.cells = svg("g");
    this.axes = svg("g", { class: "map-axes" });
    this.ring = svg("circle", { class: "map-ring", r: 6.5, role: "slider", tabindex: 0, "aria-label": on.label });
    const layers = [svg("defs", {}, pattern), this.cells, this.axes, this.ring];
    this.element = svg("svg", { class: "map", role: "group" }, ...layers);
    this.ring.style.display = "none";
    this.#listen();
  }

  #listen() {
    const { element, on } = this;
    let isHeld = false;
    element.addEventListener("pointerdown", (event) => {
      const place = this.#place(event);
      if (event.button > 0 || !place) return;
      isHeld = true;
      element.setPointerCapture(event.pointerId);
      // Browsers give the focus where the pointer went down, after this.
      event.preventDefault();
      this.ring.focus({ preventScroll: true });
      on.pick(...place);
    });
    element.addEventListener("pointermove", (event) => {
      const place = this.#place(event);
      if (!place) return;
      if (isHeld) on.pick(...place);
      else on.hover(...place);
    });
    const end = (isDropped) => {
      if (!isHeld) return;
      isHeld = false;
      if (isDropped) on.drop();
      else on.cancel();
    };
    element.addEventListener("pointerup", () => end(true));
    element.addEventListener("pointercancel", () => end(false));
    element.addEventListener("pointerleave", () => on.leave());
    this.ring.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
      if (event.key === "Escape" && isHeld) end(false);
      else if (way) on.step(...way.map((one) => one * (event.shiftKey ? 10 : 1)));
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
  }

  /** Return the values under the pointer. */
  #place(event) {
    if (!this.grid) return null;
    const box = this.element.getBoundingClientRect();
    const x = (event.clientX - box.left - MAP_MARGIN.left) / this.width;
    const y = 1 - (event.clientY - box.top - MAP_MARGIN.top) / this.height;
    return [valueAtPart(this.grid.x, x), valueAtPart(this.grid.y, y)];
  }

  /**
   * Draw a map.
   * @param {import("./cells.js").Grid2} grid
   * @param {{low: number, high: number} | null} range of the colours, in the unit of the value
   * @param {{value: number, x: number, y: number}} factors units to an SI unit
   * @param {string[]} reasons as they are shown
   */
  draw(grid, range, factors, reasons) {
    this.grid = grid;
    const outer = this.element.clientWidth || 316;
    this.width = outer - MAP_MARGIN.left - MAP_MARGIN.right;
    this.height = MAP_HEIGHT - MAP_MARGIN.top - MAP_MARGIN.bottom;
    put(this.element, "viewBox", `0 0 ${outer} ${MAP_HEIGHT}`);
    const n = grid.x.length;
    // Cells without a value have the number of their reason, below zero.
    const without = (i) => -Math.max(grid.reason[i], 1);
    const classOf = (value, i) => (Number.isFinite(value) ? stepOf(value * factors.value, range) : without(i));
    const classes = Array.from(grid.value, classOf);
    put(this.cells, "transform", `translate(${MAP_MARGIN.left} ${MAP_MARGIN.top})`);
    this.cells.replaceChildren();
    for (const [own, d] of cellPaths(classes, n, this.width, this.height)) {
      const path = svg("path", { d, class: own < 0 ? "map-without" : `map-step map-${own}` });
      if (own < 0) path.setAttribute("fill", `url(#${this.hatching})`);
      this.cells.append(path);
    }
    reasons.forEach((reason, i) => this.#name(reason, classes, n, -1 - i));
    this.#axes(factors);
  }

  /** Write a reason where it has room. */
  #name(reason, classes, n, own) {
    const columns = Math.ceil(((LETTER * reason.length) / this.width) * n);
    const room = roomFor(classes, n, own, columns, Math.ceil((LINE / this.height) * n));
    if (!room) return;
    const [x, y] = [(room.column / n) * this.width, this.height * (1 - room.row / n) + 4];
    this.cells.append(svg("text", { class: "map-reason", x: x.toFixed(1), y: y.toFixed(1) }, reason));
  }

  #axes(factors) {
    const { grid, width, height } = this;
    this.axes.replaceChildren();
    const ends = (values, factor) => [values[0] * factor, values.at(-1) * factor];
    for (const own of ticks(...ends(grid.x, factors.x), 5)) {
      const x = MAP_MARGIN.left + partOfSide(grid.x, own / factors.x) * width;
      this.axes.append(svg("text", { x: x.toFixed(1), y: MAP_HEIGHT - 5, "text-anchor": "middle" }, tickText(own)));
    }
    for (const own of ticks(...ends(grid.y, factors.y), 4)) {
      const y = MAP_MARGIN.top + (1 - partOfSide(grid.y, own / factors.y)) * height;
      const place = { x: MAP_MARGIN.left - 6, y: (y + 4).toFixed(1), "text-anchor": "end" };
      this.axes.append(svg("text", place, tickText(own)));
    }
  }

  /** Put the ring at a design; it says where that is. */
  place(x, y, text) {
    const { grid, ring } = this;
    const [across, up] = [partOfSide(grid.x, x), partOfSide(grid.y, y)];
    const isSeen = across >= 0 && across <= 1 && up >= 0 && up <= 1;
    ring.style.display = isSeen ? "" : "none";
    put(ring, "cx", (MAP_MARGIN.left + across * this.width).toFixed(1));
    put(ring, "cy", (MAP_MARGIN.top + (1 - up) * this.height).toFixed(1));
    put(ring, "aria-valuenow", String(Number(x.toPrecision(6))));
    put(ring, "aria-valuemin", String(grid.x[0]));
    put(ring, "aria-valuemax", String(grid.x.at(-1)));
    put(ring, "aria-valuetext", text);
  }
}

/** Make the bar of colours between its ends. */
export function colourBar(low, high) {
  const [wide, height] = [14, 10];
  const step = (_, i) => svg("rect", { class: `map-step map-${i}`, x: i * wide, width: wide - 1, height });
  const size = { width: wide * COLOUR_STEPS, height };
  const box = { class: "map-bar", viewBox: `0 0 ${size.width} ${height}`, ...size, "aria-hidden": "true" };
  const bar = svg("svg", box, ...Array.from({ length: COLOUR_STEPS }, step));
  return [low, bar, high];
}
