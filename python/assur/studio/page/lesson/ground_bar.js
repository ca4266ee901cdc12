// The bar of l4: where the crank turns, and where it turns with friction counted.

import { html, put } from "../../../pictures/page/elements.js";
import { tickText } from "../../../pictures/page/numbers.js";
import { lengthText } from "./entries.js";
import { sayLesson } from "./lesson_words.js";
import { withSymbols } from "./symbols.js";

/** Of the range, on each side. */
const BAR_ROOM = 0.3;

/** Return what the bar shows of l4, m; the support is dragged no farther. */
export function barRange({ turning_range: turning, ground_range: least }, l4) {
  const [low, high] = turning ?? least ?? [0.7 * l4, 1.3 * l4];
  const room = BAR_ROOM * (high - low);
  const from = Math.max(Math.min(low - room, l4), 0.01 * low);
  return [from, Math.max(high + room, l4)];
}

export class GroundBar {
  constructor() {
    const keys = ["turns", "works", "marker", "value", "low", "high"];
    this.parts = Object.fromEntries(keys.map((key) => [key, html("span", { class: `lesson-bar-${key}` })]));
    const { turns, works, marker, value, low, high } = this.parts;
    works.append(html("span", { class: "lesson-bar-text" }, sayLesson("barTurns")));
    this.bar = html("div", { class: "lesson-bar", role: "img" }, turns, works, value, marker, low, high);
    this.hint = html("p", { class: "lesson-hint" });
    this.element = html("div", {}, this.bar, this.hint);
  }

  /** Show what the lengths allow. */
  replace(header, l4) {
    this.header = header;
    this.range = barRange(header, l4);
    const { turning_range: turning, ground_range: works } = header;
    const place = (part, range) => {
      part.hidden = !range;
      if (!range) return;
      part.style.left = this.#part(range[0]);
      part.style.width = `calc(${this.#part(range[1])} - ${this.#part(range[0])})`;
    };
    place(this.parts.turns, turning);
    place(this.parts.works, works);
    ["low", "high"].forEach((key, i) => {
      const end = (works ?? turning)?.[i];
      this.parts[key].hidden = end === undefined;
      if (end === undefined) return;
      this.parts[key].textContent = lengthText(Number(end.toFixed(3)));
      this.parts[key].style.left = this.#part(end);
    });
    const short = (end) => tickText(Number(end.toFixed(3)));
    const [from, to] = (turning ?? []).map(short);
    const text = sayLesson(turning ? "barHint" : "barNone", { low: from, high: to });
    this.hint.replaceChildren(...withSymbols(text));
    this.show(l4);
  }

  #part(l4) {
    const [low, high] = this.range;
    return `${(100 * Math.min(Math.max((l4 - low) / (high - low), 0), 1)).toFixed(3)}%`;
  }

  /** Show another l4. */
  show(l4) {
    const { turning_range: turning, ground_range: works } = this.header;
    const value = lengthText(l4);
    this.parts.marker.style.left = this.parts.value.style.left = this.#part(l4);
    this.parts.value.textContent = value;
    const isGood = works && l4 > works[0] && l4 < works[1];
    this.parts.marker.classList.toggle("lesson-bar-bad", !isGood);
    const text = (end) => (end === undefined ? "–" : lengthText(end));
    const [low, high] = (turning ?? []).map(text);
    const [least, greatest] = [works?.[0], works?.[1]].map(text);
    const label = sayLesson(turning ? "barLabel" : "barLabelNone", { value, low, high, least, greatest });
    put(this.bar, "aria-label", label);
  }
}
