// What is drawn over and under the mechanism while it is built: dots of the grid, halos of links,
// rings, what a tool has begun, and the ghost of a remedy.

import { Drawing, pathOf } from "../../../pictures/page/draw.js";
import { svg } from "../../../pictures/page/elements.js";
import { Turn } from "../../../pictures/page/turn.js";
import { gridStep } from "../document/snap.js";
import { sketchScene } from "../document/sketch.js";

/** The ring of what catches a joint, and of what is chosen, px. */
const CATCH_RING = 13;
const CHOSEN_RING = 11;
/** A block that is not there yet, px. */
const BLOCK = [30, 19];
/** Dots are this many steps of the grid apart. */
const DOT_STEPS = 2;
/** Parts that have a halo: not the arrow of a driver. */
const BODY = /^(link|slide) /;

let grids = 0;

export class Overlay {
  /** @param {import("../../../pictures/page/stage.js").Stage} stage */
  constructor(stage) {
    this.stage = stage;
    const id = `assur-grid-${grids++}`;
    this.dot = svg("circle", { r: 1.1 });
    this.pattern = svg("pattern", { id, patternUnits: "userSpaceOnUse" }, this.dot);
    this.grid = svg("rect", { class: "grid-dots", width: "100%", height: "100%", fill: `url(#${id})` });
    this.halos = svg("g", { class: "build-halos" });
    this.ghost = svg("g", { class: "remedy-ghost" });
    this.marks = svg("g", { class: "building" });
    stage.element.prepend(svg("defs", {}, this.pattern), this.grid);
    stage.world.prepend(this.halos);
    stage.world.append(this.ghost);
    stage.element.append(this.marks);
    this.marked = {};
    /** Links with a halo: `{ name, kind }`. */
    this.links = [];
    this.seen = "";
  }

  /** Whether the grid is seen. */
  set hasGrid(isSeen) {
    this.grid.style.display = isSeen ? "" : "none";
  }

  /**
   * Draw rings, lines and texts at places of the plane, m.
   * @param {{lines?: number[][][], dots?: number[][], block?: {at: number[], angle: number},
   *   guide?: {from: number[], along: number[]}, ring?: number[], text?: string, chosen?: number[]}} marked
   */
  mark(marked) {
    this.marked = marked;
    this.show();
  }

  /** Draw a document lightly, or nothing. */
  preview(document) {
    this.ghost.replaceChildren();
    this.sketch = null;
    // What is there now steps back meanwhile.
    this.stage.element.classList.toggle("previews", Boolean(document));
    if (!document) return;
    const scene = sketchScene(document);
    const turn = new Turn(scene.turn);
    const pose = turn.pose();
    turn.sample(0, pose);
    this.sketch = new Drawing(scene, this.ghost);
    this.sketch.pose = pose;
    this.show();
  }

  /** Draw all where it is now. */
  show() {
    const { view } = this.stage;
    const seen = `${view.x} ${view.y} ${view.scale}`;
    if (seen !== this.seen) this.#showGrid(view);
    this.seen = seen;
    if (this.sketch) {
      this.sketch.zoom(view.scale, this.stage.size);
      this.sketch.show(this.sketch.pose);
    }
    this.#showHalos();
    this.#showMarks();
  }

  #showGrid({ x, y, scale }) {
    const step = DOT_STEPS * gridStep(scale) * scale;
    for (const [name, value] of Object.entries({ x: x - step / 2, y: y - step / 2, width: step, height: step })) {
      this.pattern.setAttribute(name, value.toFixed(3));
    }
    for (const name of ["cx", "cy"]) this.dot.setAttribute(name, (step / 2).toFixed(3));
  }

  #showHalos() {
    const { drawing, pose } = this.stage;
    if (!pose || (!this.links.length && !this.halos.firstChild)) return;
    const paths = this.links.flatMap(({ name, kind }) => {
      const link = drawing.scene.links.indexOf(name);
      const isLine = (part) => part.disc === undefined && part.hatching === undefined;
      const isBody = (part) => part.link === link && BODY.test(part.name) && isLine(part);
      const own = link > 0 ? drawing.scene.parts.filter(isBody) : [];
      return own.map((part) => svg("path", { class: `build-halo ${kind}`, d: pathOf(drawing.line(part, pose)) }));
    });
    this.halos.replaceChildren(...paths);
  }

  #showMarks() {
    const { view } = this.stage;
    const { lines = [], dots = [], block, guide, ring, text, chosen } = this.marked;
    const px = ([x, y]) => view.px(x, y);
    const made = [];
    if (guide) {
      const [x, y] = px(guide.from);
      const far = view.width + view.height;
      const [dx, dy] = [far * guide.along[0], -far * guide.along[1]];
      made.push(svg("path", { class: "guide", d: pathOf([[x - dx, y - dy], [x + dx, y + dy]]) }));
    }
    for (const line of lines) made.push(svg("path", { class: "begun", d: pathOf(line.map(px)) }));
    if (block) {
      const [x, y] = px(block.at);
      const [width, height] = BLOCK;
      const turned = `translate(${x} ${y})rotate(${(-block.angle * 180) / Math.PI})`;
      made.push(svg("rect", { class: "begun", x: -width / 2, y: -height / 2, width, height, transform: turned }));
    }
    for (const [x, y] of dots.map(px)) made.push(svg("circle", { class: "begun-joint", cx: x, cy: y, r: 5 }));
    if (chosen) {
      const [cx, cy] = px(chosen);
      made.push(svg("circle", { class: "chosen-ring", cx, cy, r: CHOSEN_RING }));
    }
    if (ring) {
      const [cx, cy] = px(ring);
      made.push(svg("circle", { class: "ring", cx, cy, r: CATCH_RING }));
      if (text) made.push(svg("text", { class: "ring-text", x: cx + CATCH_RING + 6, y: cy - CATCH_RING }, text));
    }
    if (made.length || this.marks.firstChild) this.marks.replaceChildren(...made);
  }
}
