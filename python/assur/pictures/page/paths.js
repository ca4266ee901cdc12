// Paths of chosen joints, and other positions of the links: what stays while the mechanism moves.

import { put, svg } from "./elements.js";
import { pathOf } from "./draw.js";
import { pointState } from "./quantities.js";

/** Dots at equal steps of q: far apart is fast. */
const DOTS = 24;
const POINTS = 240;
const POSITIONS = 12;

/**
 * Return the path of a joint as polylines, px; it is broken where there is no position.
 * @param {import("./turn.js").Turn} turn
 */
export function pathLines(turn, joint, scale) {
  const lines = [];
  let line = null;
  const pose = turn.pose();
  for (const q of turn.coordinates(POINTS)) {
    turn.sample(q, pose, [joint.link]);
    if (!pose.known) {
      line = null;
      continue;
    }
    const point = pointState(pose, joint.link, joint.at);
    if (!line) lines.push((line = []));
    line.push([point.x * scale, -point.y * scale]);
  }
  return lines;
}

export class Paths {
  /**
   * @param {import("./turn.js").Turn} turn
   * @param {SVGElement} layer under the links
   * @param {SVGElement} above over them, for the markers
   */
  constructor(turn, layer, above) {
    this.turn = turn;
    this.layer = layer;
    this.above = above;
    this.joints = [];
    this.markers = [];
    this.lines = [];
  }

  choose(joints) {
    this.joints = joints;
  }

  /** Draw for a scale. */
  zoom(scale, size) {
    this.layer.replaceChildren();
    this.above.replaceChildren();
    this.lines = [];
    this.markers = this.joints.map((joint, i) => {
      for (const line of pathLines(this.turn, joint, scale)) {
        this.lines.push(line);
        const path = svg("path", { class: "path", d: pathOf(line) });
        // The first is a full line, others are dashed.
        if (i % 2) path.style.strokeDasharray = "6 4";
        this.layer.append(path);
      }
      const dots = svg("path", { class: "dots", d: this.#dots(joint, scale) });
      dots.style.strokeWidth = 4.8 * size;
      this.layer.append(dots);
      const marker = svg("circle", { class: "marker", r: 4.6 * size });
      this.above.append(marker);
      return marker;
    });
    this.scale = scale;
  }

  /** Return strokes without length: round ends make them dots. */
  #dots({ link, at }, scale) {
    const { low, high } = this.turn;
    const pose = this.turn.pose();
    let d = "";
    for (let k = 0; k < DOTS; k++) {
      if (!this.turn.sample(low + (k / DOTS) * (high - low), pose, [link]).known) continue;
      const { x, y } = pointState(pose, link, at);
      d += `M${(x * scale).toFixed(2)} ${(-y * scale).toFixed(2)}h0`;
    }
    return d;
  }

  /** Move the markers. */
  show(pose) {
    this.joints.forEach((joint, i) => {
      const { x, y } = pointState(pose, joint.link, joint.at);
      put(this.markers[i], "transform", `translate(${(x * this.scale).toFixed(2)} ${(-y * this.scale).toFixed(2)})`);
    });
  }
}

/** Draw the links at other positions, light. */
export function otherPositions(turn, drawing, layer) {
  layer.replaceChildren();
  const { low, high } = turn;
  const parts = drawing.scene.parts.filter((part) => part.name.startsWith("link ") && part.link !== 0);
  const count = turn.closes ? POSITIONS : POSITIONS - 1;
  for (let k = 0; k < POSITIONS; k++) {
    const pose = turn.sample(low + (k / count) * (high - low));
    if (!pose.known) continue;
    const d = parts.map((part) => pathOf(drawing.line(part, pose))).join("");
    layer.append(svg("path", { class: "other", d }));
  }
}
