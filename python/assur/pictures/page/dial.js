// The driver's dial: a ring with what is within reach, dead points, the drawing, and a knob; a
// straight bar if the coordinate is no angle.

import { put, svg, write } from "./elements.js";
import { degrees } from "./numbers.js";

const TURN = 2 * Math.PI;
const RING = 52;
const MIDDLE = 78;
const BAR = 126;

/** Return the path of an arc about the middle, angles counter-clockwise. */
export function arcPath(radius, from, to) {
  const at = (angle) => `${(MIDDLE + radius * Math.cos(angle)).toFixed(2)} ${(MIDDLE - radius * Math.sin(angle)).toFixed(2)}`;
  if (to - from >= TURN - 1e-9) {
    const half = (from + to) / 2;
    return `${arcPath(radius, from, half)}${arcPath(radius, half, to - 1e-9)}`;
  }
  const isLarge = to - from > Math.PI ? 1 : 0;
  return `M${at(from)}A${radius} ${radius} 0 ${isLarge} 0 ${at(to)}`;
}

/** Return a diamond about a place. */
const diamond = (x, y) => svg("path", { class: "dead", d: `M${x - 6} ${y}L${x} ${y - 6}L${x + 6} ${y}L${x} ${y + 6}Z` });

export class Dial {
  /**
   * @param {Object} data the page's data
   * @param {import("./turn.js").Turn} turn
   * @param {{label: string, text: (q: number) => string, seek: (q: number) => void}} options
   */
  constructor(data, turn, options) {
    this.options = options;
    this.element = svg("svg", { role: "slider", tabindex: 0 });
    this.replace(data, turn, options.label);
    this.element.addEventListener("pointerdown", (event) => {
      this.element.setPointerCapture(event.pointerId);
      this.#drag(event);
    });
    this.element.addEventListener("pointermove", (event) => {
      if (this.element.hasPointerCapture(event.pointerId)) this.#drag(event);
    });
  }

  /** Show the driver of another turn. */
  replace(data, turn, label) {
    this.data = data;
    this.turn = turn;
    const { unit, at, dead } = data.turn;
    const drawn = JSON.stringify([unit, at, dead, turn.low, turn.high, turn.closes, label]);
    if (drawn === this.drawn) return;
    this.drawn = drawn;
    this.isRound = unit === "angle";
    const { element } = this;
    element.replaceChildren();
    put(element, "class", this.isRound ? "dial" : "dial bar");
    put(element, "viewBox", this.isRound ? "0 0 156 156" : "0 0 156 44");
    put(element, "aria-label", label);
    if (this.isRound) this.#ring();
    else this.#bar();
  }

  #ring() {
    const { turn, element, data } = this;
    const at = (radius, angle) => [MIDDLE + radius * Math.cos(angle), MIDDLE - radius * Math.sin(angle)];
    const isWhole = turn.high - turn.low >= TURN - 1e-9;
    element.append(svg("path", { class: "beyond", d: arcPath(RING, 0, TURN) }));
    if (!isWhole) {
      // Strokes where nothing is reached.
      for (let angle = turn.high + 0.1; angle < turn.low + TURN - 0.05; angle += 0.14) {
        const [a, b] = [at(RING - 4, angle), at(RING + 4, angle + 0.05)];
        element.append(svg("line", { class: "stroke", x1: a[0], y1: a[1], x2: b[0], y2: b[1] }));
      }
    }
    element.append(svg("path", { class: "reach", d: arcPath(RING, turn.low, isWhole ? turn.low + TURN : turn.high) }));
    for (let k = 0; k < 12; k++) {
      const angle = (k * TURN) / 12;
      const [a, b] = [at(k % 3 ? 41 : 38, angle), at(44, angle)];
      element.append(svg("line", { class: "tick", x1: a[0], y1: a[1], x2: b[0], y2: b[1] }));
      if (k % 3 === 0) {
        const [x, y] = at(69, angle);
        element.append(svg("text", { class: "tick-text", x, y: y + 3.5 }, String(k * 30)));
      }
    }
    const [a, b] = [at(RING - 8, data.turn.at), at(RING + 8, data.turn.at)];
    element.append(svg("line", { class: "drawing", x1: a[0], y1: a[1], x2: b[0], y2: b[1] }));
    for (const { q } of data.turn.dead) element.append(diamond(...at(RING, q)));
    this.text = svg("text", { class: "dial-text", x: MIDDLE, y: MIDDLE + 3 });
    this.second = svg("text", { class: "dial-second", x: MIDDLE, y: MIDDLE + 18 });
    this.knob = svg("circle", { class: "knob", r: 9 });
    element.append(this.text, this.second, this.knob);
    this.place = (q) => at(RING, q);
  }

  #bar() {
    const { turn, element, data } = this;
    const along = (q) => [15 + (BAR * (q - turn.low)) / (turn.high - turn.low), 30];
    element.append(svg("line", { class: "reach", x1: 15, y1: 30, x2: 15 + BAR, y2: 30 }));
    const [x] = along(data.turn.at);
    element.append(svg("line", { class: "drawing", x1: x, y1: 22, x2: x, y2: 38 }));
    for (const { q } of data.turn.dead) element.append(diamond(...along(q)));
    this.text = svg("text", { class: "dial-text", x: MIDDLE, y: 14 });
    this.second = svg("text", { class: "dial-second", x: MIDDLE, y: 44 });
    this.knob = svg("circle", { class: "knob", r: 9 });
    element.append(this.text, this.knob);
    this.place = along;
  }

  #drag(event) {
    const box = this.element.getBoundingClientRect();
    const { turn } = this;
    const per = 156 / box.width;
    const x = (event.clientX - box.left) * per;
    if (!this.isRound) {
      this.options.seek(turn.low + ((x - 15) / BAR) * (turn.high - turn.low));
      return;
    }
    const y = (event.clientY - box.top) * per;
    const angle = Math.atan2(MIDDLE - y, x - MIDDLE);
    // The turn next to where it is.
    const q = angle + TURN * Math.round((this.q - angle) / TURN);
    if (turn.closes || (q >= turn.low && q <= turn.high)) this.options.seek(q);
    else {
      const ends = [turn.low, turn.high].map((end) => [Math.abs(Math.sin((end - q) / 2)), end]);
      this.options.seek(Math.abs(this.q - q) > 0.5 ? ends.sort((a, b) => a[0] - b[0])[0][1] : q);
    }
  }

  /** Show a coordinate; `second` is a smaller text. */
  show(q, second = "") {
    this.q = q;
    const [x, y] = this.place(q);
    put(this.knob, "transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
    write(this.text, this.options.text(q));
    write(this.second, second);
  }

  /** Tell screen readers; not for each frame. */
  tell(q) {
    const isAngle = this.isRound;
    const number = (x) => String(Number((isAngle ? (x * 180) / Math.PI : x).toPrecision(6)));
    put(this.element, "aria-valuemin", number(this.turn.low));
    put(this.element, "aria-valuemax", number(this.turn.high));
    put(this.element, "aria-valuenow", number(q));
    put(this.element, "aria-valuetext", isAngle ? degrees(q) : this.options.text(q));
  }
}
