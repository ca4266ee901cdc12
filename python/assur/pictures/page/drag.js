// Gestures on the picture: a link that is dragged drives; the canvas pans; wheel and pinch zoom.

import { pointState } from "./quantities.js";

/** How near to a line one must be to grip it, px; with a finger. */
const GRIP = 10;
const TOUCH = 22;
const HALVINGS = 40;

/**
 * Return the coordinate that brings a point of a link nearest to a target, going downhill from
 * where it is, so that the mechanism follows without jumps and stops at its ends.
 * @param {import("./turn.js").Turn} turn
 * @param {number} link
 * @param {number[]} at the point in the link's frame, m
 * @param {number[]} target m
 * @param {number} q where it is
 * @param {number} [sense] which way it last went: of two equal ways it goes on
 * @returns {number}
 */
export function nearestCoordinate(turn, link, at, target, q, sense = 1) {
  const pose = turn.pose();
  const distance = (own) => {
    turn.sample(own, pose);
    if (!pose.known) return Infinity;
    const { x, y } = pointState(pose, link, at);
    return (x - target[0]) ** 2 + (y - target[1]) ** 2;
  };
  const span = turn.high - turn.low;
  const step = span / (turn.rows - 1);
  const ways = sense < 0 ? [-1, 1] : [1, -1];
  const start = distance(q);
  const way = ways.find((own) => distance(q + own * step) < start);
  let low = q - step;
  let high = q + step;
  if (way !== undefined) {
    let here = q;
    let best = start;
    // No farther than once around.
    for (let i = 0; i < turn.rows; i++) {
      const next = distance(here + way * step);
      if (!(next < best) || turn.bring(here) === turn.bring(here + way * step)) break;
      here += way * step;
      best = next;
    }
    low = here - step;
    high = here + step;
  }
  // Golden section between the neighbours.
  const part = (Math.sqrt(5) - 1) / 2;
  for (let i = 0; i < HALVINGS; i++) {
    const a = high - part * (high - low);
    const b = low + part * (high - low);
    if (distance(a) < distance(b)) high = b;
    else low = a;
  }
  return turn.bring((low + high) / 2);
}

/** Return the distance of a point from a segment. */
export function fromSegment(x, y, [ax, ay], [bx, by]) {
  const dx = bx - ax;
  const dy = by - ay;
  const length2 = dx * dx + dy * dy;
  const t = length2 ? Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / length2, 0), 1) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

/** Whether a point is inside a closed line. */
export function isInside(x, y, line) {
  let inside = false;
  for (let i = 1; i < line.length; i++) {
    const [ax, ay] = line[i - 1];
    const [bx, by] = line[i];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  }
  return inside;
}

/**
 * Return the moving link under a point, px of the drawing, or null.
 * @param {import("./draw.js").Drawing} drawing
 */
export function linkAt(drawing, pose, x, y, isTouch) {
  let best = null;
  let least = isTouch ? TOUCH : GRIP;
  for (const part of drawing.scene.parts) {
    if (part.link === 0) continue;
    const line = drawing.line(part, pose);
    let distance = Infinity;
    for (let i = 1; i < line.length; i++) distance = Math.min(distance, fromSegment(x, y, line[i - 1], line[i]));
    if (part.disc !== undefined) distance = Math.hypot(x - line[0][0], y - line[0][1]) - part.disc;
    // Inside a plate is on it, though a line that crosses it is nearer.
    if (part.closed && isInside(x, y, line)) distance = Math.min(distance, 0.8 * least);
    if (distance < least) {
      least = distance;
      best = part.link;
    }
  }
  return best;
}

/** Whether a wheel is meant to zoom also where it scrolls a page; a pinch on a touch pad is one with Ctrl. */
export const isZoom = (event) => event.ctrlKey || event.metaKey;

/**
 * What gestures do; places are px from the upper left corner of the element.
 * @typedef {Object} Handlers
 * @property {(x: number, y: number, isTouch: boolean) => any} grip what is there, null for nothing
 * @property {(grip: any, x: number, y: number) => void} move
 * @property {(grip: any) => void} drop
 * @property {(grip: any) => void} [cancel]
 * @property {(dx: number, dy: number) => void} pan
 * @property {(x: number, y: number, factor: number) => void} zoom
 * @property {(event: WheelEvent) => boolean} takesWheel whether the wheel zooms here, or scrolls the page
 */

export class Gestures {
  /**
   * @param {Element} element
   * @param {Handlers} handlers
   */
  constructor(element, handlers) {
    this.element = element;
    this.handlers = handlers;
    /** @type {Map<number, {x: number, y: number}>} */
    this.pointers = new Map();
    this.gripped = null;
    element.addEventListener("pointerdown", (event) => this.#down(event));
    element.addEventListener("pointermove", (event) => this.#move(event));
    for (const end of ["pointerup", "pointercancel"]) element.addEventListener(end, (event) => this.#up(event));
    element.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
  }

  #place(event) {
    const box = this.element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #down(event) {
    if (event.button > 0) return;
    const place = this.#place(event);
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, place);
    if (this.pointers.size > 1) this.#drop();
    else this.gripped = this.handlers.grip(place.x, place.y, event.pointerType === "touch");
  }

  #move(event) {
    const before = this.pointers.get(event.pointerId);
    const place = this.#place(event);
    if (!before) {
      const isOver = this.handlers.grip(place.x, place.y, false) !== null;
      this.element.style.cursor = isOver ? "grab" : "";
      return;
    }
    const [first, second] = [...this.pointers.values()];
    this.pointers.set(event.pointerId, place);
    if (second) {
      const other = before === first ? second : first;
      const factor = Math.hypot(place.x - other.x, place.y - other.y) / Math.hypot(before.x - other.x, before.y - other.y);
      // Half of the movement of one finger is that of their middle.
      this.handlers.pan((place.x - before.x) / 2, (place.y - before.y) / 2);
      if (Number.isFinite(factor) && factor > 0) this.handlers.zoom((place.x + other.x) / 2, (place.y + other.y) / 2, factor);
    } else if (this.gripped !== null) this.handlers.move(this.gripped, place.x, place.y);
    else this.handlers.pan(place.x - before.x, place.y - before.y);
  }

  #up(event) {
    this.pointers.delete(event.pointerId);
    if (!this.pointers.size) this.#drop();
  }

  get isGripping() {
    return this.gripped !== null;
  }

  /** Let go as if the gesture had not begun. */
  cancel() {
    const grip = this.gripped;
    this.gripped = null;
    if (grip !== null) this.handlers.cancel?.(grip);
  }

  #drop() {
    if (this.gripped !== null) this.handlers.drop(this.gripped);
    this.gripped = null;
  }

  #wheel(event) {
    if (!this.handlers.takesWheel(event)) return;
    event.preventDefault();
    const { x, y } = this.#place(event);
    const px = event.deltaMode === 1 ? 16 * event.deltaY : event.deltaY;
    this.handlers.zoom(x, y, Math.exp(-0.0016 * Math.min(Math.max(px, -300), 300)));
  }
}
