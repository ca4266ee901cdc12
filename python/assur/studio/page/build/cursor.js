// A cursor for keys: arrows move it over the plane, Tab takes it to the next joint, Enter clicks.

import { digits, lengthUnit } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { gridStep } from "../document/snap.js";
import { tableOf } from "../document/names.js";
import { placeOf } from "../document/structure.js";

/** With Shift it goes so many steps of the grid. */
const FAR_STEPS = 5;
const CURSOR_WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export class Cursor {
  /** @param {import("./builder.js").Builder} builder */
  constructor(builder) {
    this.builder = builder;
    /** Where it is, px of the picture; null while the pointer is used. */
    this.at = null;
    this.joint = -1;
  }

  /** Return what a key does to it. */
  key(key, isShift) {
    const way = CURSOR_WAYS[key];
    if (way) return () => this.#move(way, isShift ? FAR_STEPS : 1);
    if (key === "Tab") return this.#next(isShift ? -1 : 1);
    if (key !== "Enter") return null;
    return () => (this.at ? this.#click() : this.builder.enter());
  }

  #move([dx, dy], steps) {
    const { view } = this.builder.canvas.stage;
    const step = steps * gridStep(view.scale) * view.scale;
    const [x, y] = this.at ?? [view.width / 2, view.height / 2];
    this.#go([Math.min(Math.max(x + dx * step, 0), view.width), Math.min(Math.max(y + dy * step, 0), view.height)]);
  }

  /** Go to the next joint; beyond the last Tab leaves the canvas. */
  #next(step) {
    const { model, canvas } = this.builder;
    const joints = Object.keys(tableOf(model.document.joints)).filter((joint) => placeOf(model.document, joint));
    const places = this.builder.aim.places();
    const next = this.joint < 0 ? (step > 0 ? 0 : joints.length - 1) : this.joint + step;
    if (next < 0 || next >= joints.length) {
      this.joint = -1;
      return null;
    }
    return () => {
      this.joint = next;
      this.#go(canvas.stage.view.px(...(places[joints[next]] ?? placeOf(model.document, joints[next]))));
    };
  }

  #go(at) {
    this.at = at;
    this.builder.hover(...at);
    this.#tell();
  }

  #click() {
    this.builder.click(...this.at);
    this.#tell();
  }

  /** Say where it is. */
  #tell() {
    const { spot, canvas } = this.builder;
    if (!spot) return;
    const { name, factor } = lengthUnit(100 / canvas.stage.view.scale);
    const [x, y] = spot.at.map((own) => `${digits(own * factor)} ${name}`);
    const onLink = spot.link ? say("linkNamed", { name: spot.link }) : "";
    const over = spot.joint ? say("jointNamed", { name: spot.joint }) : onLink;
    canvas.status.textContent = say("cursorTold", { x, y, over }).trim();
  }
}
