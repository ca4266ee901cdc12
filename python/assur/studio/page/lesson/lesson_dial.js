// The dial of the crank with the intervals in which C is jammed, and what its colours mean.

import { Dial } from "../../../pictures/page/dial.js";
import { html, svg } from "../../../pictures/page/elements.js";
import { turnText } from "./entries.js";
import { sayLesson } from "./lesson_words.js";
import { withSymbols } from "./symbols.js";

/** Of the dial's ring. */
const [BLOCKED_RADIUS, DIAL_MIDDLE] = [52, 78];
const STROKE_STEP = 0.075;

export class LessonDial {
  /** @param {(phi1: number) => void} seek */
  constructor(seek) {
    this.label = sayLesson("dial");
    this.seek = seek;
    this.strokes = svg("g", { class: "lesson-blocked" });
    const row = (key) => {
      const text = html("span", {}, ...withSymbols(sayLesson(key)));
      return html("span", {}, html("i", { class: `lesson-key lesson-key-${key}` }), text);
    };
    this.slower = html("p", { class: "lesson-hint lesson-slower" });
    this.legend = html("div", { class: "lesson-legend" }, row("belowLeast"), row("crankRocker"));
    this.element = html("div", { class: "lesson-dial" });
  }

  /**
   * Show another motion.
   * @param {number} start where the turn begins, rad
   * @param {{start: number, end: number, side: string|null}[]} stretches
   */
  replace(start, stretches) {
    const data = { turn: { unit: "angle", at: start, dead: [] } };
    const turn = { low: start, high: start + 2 * Math.PI, closes: true, dead: [] };
    if (this.dial) this.dial.replace(data, turn, this.label);
    else {
      this.dial = new Dial(data, turn, { label: this.label, text: (q) => turnText(q), seek: this.seek });
      this.element.append(this.dial.element, this.legend, this.slower);
    }
    const lines = stretches.filter((one) => one.side !== null).flatMap((one) => this.#strokes(one));
    this.strokes.replaceChildren(...lines);
    // Under the knob.
    this.dial.element.insertBefore(this.strokes, this.dial.knob);
    this.legend.firstChild.hidden = !lines.length;
  }

  #strokes({ start, end }) {
    const count = Math.max(Math.round((end - start) / STROKE_STEP), 2);
    return Array.from({ length: count }, (_, i) => {
      const angle = start + ((i + 0.5) / count) * (end - start);
      const at = (radius) => [DIAL_MIDDLE + radius * Math.cos(angle), DIAL_MIDDLE - radius * Math.sin(angle)];
      const [[x1, y1], [x2, y2]] = [at(BLOCKED_RADIUS - 5), at(BLOCKED_RADIUS + 5)];
      return svg("line", { class: "lesson-blocked-stroke", x1, y1, x2, y2 });
    });
  }

  show(phi1, second) {
    this.dial.show(phi1, second);
  }

  /** Say it to screen readers; not for each frame. */
  tell(phi1) {
    this.dial.tell(phi1);
  }
}
