// The support D, dragged by the pill under it or by keys, and the dimension l4.

import { put, svg } from "../../../pictures/page/elements.js";
import { niceLength } from "../../../pictures/page/numbers.js";
import { lengthText } from "./entries.js";
import { sayLesson } from "./lesson_words.js";

/** px below the line of centres. */
const PILL_DOWN = 44;
const DIMENSION_DOWN = 84;
const PILL = { width: 52, height: 25 };
/** A finger has this much, px. */
const TARGET = 44;

export class Support {
  /**
   * @param {import("./figure.js").LessonFigure} figure
   * @param {{dragged: (l4: number) => void, began: () => void, ended: () => void}} on
   */
  constructor(figure, on) {
    this.figure = figure;
    this.on = on;
    this.lines = [];
    const { width, height } = PILL;
    this.pill = svg(
      "g",
      { class: "lesson-pill", role: "slider", tabindex: 0, "aria-label": sayLesson("support") },
      svg("rect", { class: "lesson-target", x: -TARGET / 2 - 8, y: -TARGET / 2, width: TARGET + 16, height: TARGET }),
      svg("rect", { class: "lesson-pill-body", x: -width / 2, y: -height / 2, width, height, rx: height / 2 }),
      svg("path", { class: "lesson-pill-arrow", d: "M-14 0H14M-9 -5L-14 0L-9 5M9 -5L14 0L9 5" }),
    );
    this.dimension = svg("path", { class: "lesson-dimension-line" });
    this.heads = svg("path", { class: "lesson-dimension-heads" });
    this.text = svg("text", { class: "lesson-dimension-text" });
    this.home = svg("path", { class: "lesson-home" });
    figure.layers.dimension.append(this.dimension, this.heads, this.home);
    figure.layers.support.append(this.text, this.pill);
    this.#listen();
  }

  #listen() {
    const { pill } = this;
    pill.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      // The picture pans otherwise.
      event.stopPropagation();
      pill.focus({ preventScroll: true });
      pill.setPointerCapture(event.pointerId);
      this.grip = { x: event.clientX, l4: this.l4 };
      this.on.began();
    });
    pill.addEventListener("pointermove", (event) => {
      if (!this.grip) return;
      // D is left of A: to the left is longer.
      this.on.dragged(this.grip.l4 - (event.clientX - this.grip.x) / this.figure.view.scale);
    });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
      pill.addEventListener(name, () => {
        if (!this.grip) return;
        this.grip = null;
        this.on.ended();
      });
    }
    pill.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.grip) {
        const { l4 } = this.grip;
        this.grip = null;
        this.on.dragged(l4);
        this.on.ended();
        event.stopPropagation();
        return;
      }
      // Left and right as seen, up and down as the number.
      const sense = { ArrowLeft: 1, ArrowRight: -1, ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!sense) return;
      event.preventDefault();
      event.stopPropagation();
      const step = this.step * (event.shiftKey ? 10 : 1);
      this.on.dragged(this.l4 + sense * step);
      this.on.ended();
    });
  }

  /** What a key moves: a round length of about one px. */
  get step() {
    return niceLength(1 / this.figure.view.scale);
  }

  /** Show where D is, px, and how long l4 is. */
  show(pose, at, { l4, isLocked, givesWay }) {
    this.l4 = l4;
    const [x] = at.D;
    const seen = -pose.value[12];
    const down = this.#fit(PILL_DOWN);
    const line = this.#fit(DIMENSION_DOWN);
    put(this.pill, "transform", `translate(${x.toFixed(2)} ${down})`);
    put(this.pill, "aria-valuenow", String(Number(l4.toPrecision(6))));
    put(this.pill, "aria-valuetext", lengthText(l4));
    const text = `l₄ = ${lengthText(seen)}`;
    if (this.text.textContent !== text) this.text.textContent = text;
    const middle = x / 2;
    const gap = 42;
    const [from, to] = [(middle - gap).toFixed(1), (middle + gap).toFixed(1)];
    const ends = `M${x.toFixed(1)} ${down + 13}V${line + 7}M0 24V${line + 7}`;
    put(this.dimension, "d", `${ends}M${x.toFixed(1)} ${line}H${from}M${to} ${line}H0`);
    put(this.heads, "d", `M${x.toFixed(1)} ${line}l9 -3v6zM0 ${line}l-9 -3v6z`);
    put(this.text, "x", middle.toFixed(1));
    put(this.text, "y", String(line + 4));
    // Where D belongs, if it is seen apart.
    const home = -l4 * this.figure.view.scale;
    const isApart = isLocked && givesWay && Math.abs(home - x) >= 6;
    put(this.home, "d", isApart ? `M${home.toFixed(1)} -26V26` : "");
    this.lines = [
      ...[-10, 0, 10].map((dy) => [[x - 30, down + dy], [x + 30, down + dy]]),
      [[x, line], [0, line]],
    ];
  }

  /** Keep the dimension within a low picture. */
  #fit(down) {
    const { view } = this.figure;
    const room = view.height - view.y - 14;
    return Math.min(down, Math.max(room - (DIMENSION_DOWN - down), 20));
  }
}
