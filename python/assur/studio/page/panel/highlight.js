// Light on the picture: links and joints that are spoken of, and another assembly.

import { pathOf } from "../../../pictures/page/draw.js";
import { put, svg } from "../../../pictures/page/elements.js";
import { pointState } from "../../../pictures/page/quantities.js";
import { skeleton } from "./skeleton.js";

export class Highlight {
  #links = new Set();
  #joints = new Set();
  #other = null;

  /** @param {import("../../../pictures/page/stage.js").Stage} stage */
  constructor(stage) {
    this.stage = stage;
    this.halo = svg("g", { class: "layer halo" });
    this.ghost = svg("g", { class: "layer ghost" });
    stage.world.insertBefore(this.halo, stage.layers.links);
    stage.world.insertBefore(this.ghost, this.halo);
    stage.overlays.push(this);
  }

  /** Light links and joints up; none to end it. */
  light({ links = [], joints = [] } = {}) {
    this.#links = new Set(links);
    this.#joints = new Set(joints);
    this.#again();
  }

  /** Show another assembly over the picture, or end it with null. */
  other(document, places) {
    this.#other = document && { document, places };
    this.#again();
  }

  /** Light up what an element speaks of, while the pointer or the focus is on it. */
  attach(element, concerned) {
    for (const event of ["pointerenter", "focusin"]) element.addEventListener(event, () => this.light(concerned()));
    for (const event of ["pointerleave", "focusout"]) {
      element.addEventListener(event, () => {
        const holds = event === "pointerleave" && element.contains(element.getRootNode().activeElement);
        if (!holds) this.light();
      });
    }
  }

  #again() {
    if (this.stage.pose?.known) this.show(this.stage.pose);
  }

  /** Follow a position: called by the stage. */
  show(pose) {
    const { data, drawing, view, size } = this.stage;
    const isLine = (part) => part.disc === undefined && part.hatching === undefined;
    const lit = data.parts.filter((part) => this.#links.has(data.links[part.link]) && isLine(part));
    const joints = data.joints.filter((joint) => this.#joints.has(joint.name));
    fill(this.halo, "path", lit.length, (path, i) => {
      put(path, "d", pathOf(drawing.line(lit[i], pose)));
      path.style.strokeWidth = 14 * size;
    });
    const circles = this.halo.querySelectorAll("circle");
    for (let i = joints.length; i < circles.length; i++) circles[i].remove();
    joints.forEach((joint, i) => {
      const circle = circles[i] ?? this.halo.appendChild(svg("circle", { r: 12 }));
      const { x, y } = pointState(pose, joint.link, joint.at);
      put(circle, "cx", (x * view.scale).toFixed(1));
      put(circle, "cy", (-y * view.scale).toFixed(1));
    });
    const shapes = this.#other ? skeleton(this.#other.document, this.#other.places) : [];
    fill(this.ghost, "path", shapes.length, (path, i) => {
      const points = shapes[i].corners.map(([x, y]) => [x * view.scale, -y * view.scale]);
      put(path, "d", pathOf(points, points.length > 2));
    });
  }
}

/** Have as many elements of a tag in a layer as are wanted, and set each. */
function fill(layer, tag, count, set) {
  const own = layer.querySelectorAll(tag);
  for (let i = count; i < own.length; i++) own[i].remove();
  for (let i = 0; i < count; i++) set(own[i] ?? layer.appendChild(svg(tag)), i);
}
