// A loupe for a slide too short to be seen.

import { put, svg } from "../../../pictures/page/elements.js";
import { hatchedLine, pathOf } from "../../../pictures/page/draw.js";
import { lengthText } from "./entries.js";
import { sayLesson } from "./lesson_words.js";

/** Shorter slides are magnified, px. */
const LEAST_SEEN = 6;
const LOUPE_RADIUS = 80;
const NARROW_RADIUS = 58;
const NARROWEST_RADIUS = 46;
/** How far the block has gone in the loupe, px. */
const LOUPE_TRAVEL = 30;
const HALF_BLOCK = [23, 17];

export class Loupe {
  /** @param {SVGElement} layer */
  constructor(layer) {
    this.layer = layer;
    this.ray = svg("path", { class: "lesson-loupe-ray" });
    this.circle = svg("circle", { class: "lesson-loupe-rim" });
    this.guide = svg("path", { class: "lesson-loupe-ink" });
    this.hatching = svg("path", { class: "lesson-loupe-thin" });
    this.home = svg("path", { class: "lesson-loupe-home" });
    const [width, height] = HALF_BLOCK;
    const body = { class: "lesson-loupe-block", x: -width, y: -height, width: 2 * width, height: 2 * height };
    this.block = svg("g", {}, svg("rect", body), svg("circle", { class: "lesson-loupe-block", r: 6 }));
    this.arrow = svg("path", { class: "lesson-loupe-arrow" });
    this.travel = svg("text", { class: "lesson-loupe-text" });
    this.note = svg("text", { class: "lesson-loupe-note" }, sayLesson("magnified"));
    layer.append(this.ray, this.circle, this.guide, this.hatching, this.home, this.block);
    layer.append(this.arrow, this.travel, this.note);
  }

  /**
   * Show the slide of D, if it is there and cannot be seen.
   * @param {import("../../../pictures/page/view.js").View} view
   * @param {number[]} at where D is, px of the world
   * @param {number} travel inward, m
   * @param {number} scale
   */
  show(view, at, travel, scale) {
    const isShown = travel !== 0 && Math.abs(travel * scale) < LEAST_SEEN;
    this.layer.style.display = isShown ? "" : "none";
    if (!isShown) return;
    const usual = Math.min(view.width - 130, view.height - 60) < 500 ? NARROW_RADIUS : LOUPE_RADIUS;
    const radius = view.width < 450 ? NARROWEST_RADIUS : usual;
    // In the lower left corner of the picture, below D.
    const x = Math.max(radius + 12 - view.x, at[0] - 135);
    const y = view.height - view.y - radius - (radius < LOUPE_RADIUS ? 8 : 22);
    const sense = Math.sign(travel);
    put(this.circle, "cx", x.toFixed(1));
    put(this.circle, "cy", y.toFixed(1));
    put(this.circle, "r", String(radius));
    const away = Math.hypot(at[0] - x, at[1] - y);
    const rim = [x + (radius * (at[0] - x)) / away, y + (radius * (at[1] - y)) / away];
    put(this.ray, "d", pathOf([rim, at]));
    const part = radius / LOUPE_RADIUS;
    const floor = y + 0.27 * radius;
    const half = Math.sqrt(radius * radius - (floor - y) ** 2);
    put(this.guide, "d", pathOf([[x - half, floor], [x + half, floor]]));
    const strokes = hatchedLine([x - half, floor], [x + half, floor], 7, 7);
    put(this.hatching, "d", strokes.map((stroke) => pathOf(stroke)).join(""));
    const way = sense * LOUPE_TRAVEL * part;
    const home = x - way / 2 - 2;
    put(this.home, "d", `M${home.toFixed(1)} ${floor}V${(floor - 56 * part).toFixed(1)}`);
    const middle = floor - HALF_BLOCK[1] * part;
    put(this.block, "transform", `translate(${(home + way).toFixed(1)} ${middle.toFixed(1)})scale(${part})`);
    const level = (floor - 47 * part).toFixed(1);
    const back = -6 * sense;
    put(this.arrow, "d", `M${home.toFixed(1)} ${level}h${way.toFixed(1)}m${back} -4l${-back} 4l${back} 4`);
    const size = lengthText(Number(Math.abs(travel).toPrecision(3)));
    // In the smallest there is room for the number alone; the arrow says where.
    const word = travel > 0 ? "inward" : "outward";
    this.travel.textContent = radius > NARROWEST_RADIUS ? sayLesson(word, { travel: size }) : size;
    put(this.travel, "x", x.toFixed(1));
    put(this.travel, "y", (y - (part < 1 ? 0.64 : 0.55) * radius).toFixed(1));
    put(this.note, "x", x.toFixed(1));
    put(this.note, "y", (y + 0.7 * radius).toFixed(1));
  }
}
