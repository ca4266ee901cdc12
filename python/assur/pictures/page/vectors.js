// Velocity and acceleration of chosen joints as arrows with their values.

import { put, svg } from "./elements.js";
import { pathOf } from "./draw.js";
import { pointState } from "./quantities.js";
import { digits, lengthUnit } from "./numbers.js";

/** The longest arrow of the turn, px, and how far beyond it one may go at a dead point. */
const LONGEST_ARROW = 95;
const MOST_BEYOND = 1.6;
const LEAST_ARROW = 3;

const VECTOR_KINDS = {
  velocity: { symbol: "v", of: (p) => [p.x1, p.y1], power: 1 },
  acceleration: { symbol: "a", of: (p) => [p.x2, p.y2], power: 2 },
};

/** Return a filled head, 11 × 8 or as given, its tip at (x, y). */
export function filledHead(x, y, ux, uy, size, [long, wide] = [11, 8]) {
  const back = long * size;
  const half = (wide / 2) * size;
  const corner = (side) => [x - back * ux - side * half * uy, y - back * uy + side * half * ux];
  return pathOf([[x, y], corner(1), corner(-1)], true);
}

/** Return two open heads, 8 × 9. */
function openHeads(x, y, ux, uy, size) {
  const wing = (x0, y0) => {
    const corner = (side) => [x0 - 8 * size * ux - side * 4.5 * size * uy, y0 - 8 * size * uy + side * 4.5 * size * ux];
    return pathOf([corner(1), [x0, y0], corner(-1)]);
  };
  return wing(x, y) + wing(x - 6 * size * ux, y - 6 * size * uy);
}

export class Vectors {
  /**
   * @param {"velocity"|"acceleration"} kind
   * @param {import("./turn.js").Turn} turn
   * @param {SVGElement} layer
   */
  constructor(kind, turn, layer) {
    this.kind = kind;
    this.turn = turn;
    this.layer = layer;
    this.arrows = [];
    /** px to a unit, once it is needed. */
    this.per = null;
  }

  /** Draw those of other joints, or of the same in another turn. */
  choose(joints) {
    this.per = null;
    if (joints.length === this.arrows.length && joints.every(({ name }, i) => name === this.arrows[i].joint.name)) {
      joints.forEach((joint, i) => (this.arrows[i].joint = joint));
      return;
    }
    this.layer.replaceChildren();
    this.arrows = joints.map((joint) => {
      const style = { class: `vector ${this.kind}` };
      const arrow = { joint, line: svg("path", style), head: svg("path", { class: `head ${this.kind}` }) };
      this.layer.append(arrow.line, arrow.head);
      return arrow;
    });
  }

  /** Return nearly the greatest of the turn: at dead points it is infinite. */
  #usualGreatest(joints) {
    const sizes = [];
    const pose = this.turn.pose();
    const links = joints.map((joint) => joint.link);
    for (const q of this.turn.coordinates(90)) {
      this.turn.sample(q, pose, links);
      for (const joint of joints) sizes.push(Math.hypot(...VECTOR_KINDS[this.kind].of(pointState(pose, joint.link, joint.at))));
    }
    const known = sizes.filter(Number.isFinite).sort((a, b) => a - b);
    const usual = known[Math.floor(0.9 * known.length)] ?? 0;
    return Math.min(known.at(-1) ?? 0, 3 * usual || Infinity);
  }

  /**
   * Show a position; returns the values as labels and the lines of the arrows, px.
   * @returns {{labels: Object[], lines: number[][][]}}
   */
  show(pose, scale, size, speed) {
    const { of, power, symbol } = VECTOR_KINDS[this.kind];
    this.per ??= LONGEST_ARROW / (this.#usualGreatest(this.arrows.map((arrow) => arrow.joint)) || Infinity);
    const labels = [];
    const lines = [];
    // One unit for all, so that they can be compared.
    const unit = lengthUnit((LONGEST_ARROW / this.per) * Math.abs(speed) ** power);
    for (const { joint, line, head } of this.arrows) {
      const point = pointState(pose, joint.link, joint.at);
      const [vx, vy] = of(point);
      const length = Math.hypot(vx, vy);
      const px = Math.min(length * this.per, MOST_BEYOND * LONGEST_ARROW);
      const isShown = px > LEAST_ARROW && speed !== 0;
      line.style.display = head.style.display = isShown ? "" : "none";
      if (!isShown) continue;
      // A falling speed turns the velocity about, not the acceleration.
      const sign = power === 1 ? Math.sign(speed) : 1;
      const ux = (sign * vx) / length;
      const uy = (-sign * vy) / length;
      const x = point.x * scale;
      const y = -point.y * scale;
      const tip = [x + px * ux, y + px * uy];
      // Heads shrink on short arrows.
      const own = size * Math.min(1, px / 26);
      put(line, "d", pathOf([[x, y], [tip[0] - 6 * own * ux, tip[1] - 6 * own * uy]]));
      put(head, "d", power === 1 ? filledHead(...tip, ux, uy, own) : openHeads(...tip, ux, uy, own));
      lines.push([[x, y], tip]);
      const rate = Math.abs(speed) ** power;
      const text = `${digits(length * rate * unit.factor)} ${unit.name}/s${power === 1 ? "" : "²"}`;
      labels.push({ x: tip[0], y: tip[1], radius: 4, key: `${this.kind} ${joint.name}`, symbol, text });
    }
    return { labels, lines };
  }
}
