// The target path on the picture, and the sheet over the picture on which it is drawn.

import { html, put, svg } from "../../../pictures/page/elements.js";
import { isZoom } from "../../../pictures/page/drag.js";
import { pathOf } from "../../../pictures/page/draw.js";
import { targetOf } from "./deviation.js";

/** Places of a drawn line are at least so far apart; ends so near close it, px. */
const SPACING = 3;
const CLOSING = 16;

export class TargetLine {
  /** @param {import("../../../pictures/page/stage.js").Stage} stage */
  constructor(stage) {
    this.stage = stage;
    this.line = svg("path", { class: "target" });
    this.gap = svg("path", { class: "target-gap" });
    this.layer = svg("g", { class: "layer targets" }, this.line, this.gap);
    stage.layers.paths.after(this.layer);
    stage.overlays.push(this);
    this.target = null;
    this.deviation = null;
  }

  /**
   * @param {import("./deviation.js").Target | null} target
   * @param {{from: number[], to: number[]} | null} deviation where it is farthest
   */
  take(target, deviation) {
    this.target = target;
    this.deviation = deviation;
    this.zoom(this.stage.view.scale);
  }

  /** Draw for a scale. */
  zoom(scale) {
    const { target, deviation } = this;
    const px = (points) => points.map(([x, y]) => [x * scale, -y * scale]);
    put(this.line, "d", target ? pathOf(px(target.points), target.closed) : "");
    put(this.gap, "d", deviation ? pathOf(px([deviation.from, deviation.to])) : "");
  }
}

export class TargetSheet {
  /**
   * @param {import("../../../pictures/page/canvas.js").Canvas} canvas
   * @param {(target: import("./deviation.js").Target | null) => void} drawn called with what was drawn; null if nothing
   */
  constructor(canvas, drawn) {
    this.canvas = canvas;
    this.drawn = drawn;
    this.element = html("div", { class: "target-sheet", hidden: "" });
    this.points = null;
    // Under the switches and buttons of the picture.
    canvas.picture.after(this.element);
    const { element } = this;
    element.addEventListener("pointerdown", (event) => {
      if (event.button > 0) return;
      element.setPointerCapture(event.pointerId);
      this.points = [this.#place(event)];
    });
    element.addEventListener("pointermove", (event) => {
      if (!this.points) return;
      const events = event.getCoalescedEvents?.() ?? [];
      for (const one of events.length ? events : [event]) this.points.push(this.#place(one));
      this.sketch?.(this.#target());
    });
    element.addEventListener("pointerup", () => this.#end(true));
    element.addEventListener("pointercancel", () => this.#end(false));
    element.addEventListener("wheel", (event) => {
      // In a notebook the wheel scrolls that.
      if (canvas.root.classList.contains("embedded") && !isZoom(event)) return;
      event.preventDefault();
      const [x, y] = this.#px(event);
      canvas.stage.zoom(x, y, Math.exp(-0.0016 * Math.min(Math.max(event.deltaY, -300), 300)));
    }, { passive: false });
  }

  #px(event) {
    const box = this.element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #place(event) {
    return this.canvas.stage.view.m(...this.#px(event));
  }

  #target() {
    const { scale } = this.canvas.stage.view;
    return targetOf(this.points, SPACING / scale, CLOSING / scale);
  }

  #end(isDrawn) {
    if (!this.points) return;
    const target = isDrawn ? this.#target() : null;
    this.points = null;
    this.drawn(target);
  }

  get isOn() {
    return !this.element.hidden;
  }

  /** Let one draw, or no longer. */
  open(isOn) {
    this.element.hidden = !isOn;
    this.points = null;
  }
}
