// Successive positions of the links in one picture, numbered at the crank's pin.

import { pathOf } from "../../../pictures/page/draw.js";
import { svg } from "../../../pictures/page/elements.js";

const SUCCESSIVE = 12;
/** Of a number from the circle of the pin, px. */
const NUMBER_OUT = 14;

/**
 * Draw the links at every 30° from the start on, in the sense of turning.
 * @param {import("./motion.js").LessonMotion} motion
 * @param {{sample: Function}} turn of it what is drawn
 * @param {import("../../../pictures/page/draw.js").Drawing} drawing
 * @param {SVGElement} layer
 * @param {number} scale px to a metre
 * @returns {number[][][]} lines across the numbers, px, which names keep clear of
 */
export function successive(motion, turn, drawing, layer, scale) {
  const { start, speed } = motion.asked;
  const parts = drawing.scene.parts.filter((part) => part.name.startsWith("link "));
  const pose = motion.pose();
  const numbers = [];
  const radius = motion.lengths.l1 * scale;
  layer.append(svg("circle", { class: "lesson-circle", r: radius.toFixed(2) }));
  for (let k = 0; k < SUCCESSIVE; k++) {
    const q = start + (Math.sign(speed) * k * 2 * Math.PI) / SUCCESSIVE;
    if (!turn.sample(q, pose).known) continue;
    const d = parts.map((part) => pathOf(drawing.line(part, pose))).join("");
    const isSliding = pose.stretch.side !== null;
    const x = (radius + NUMBER_OUT) * Math.cos(q);
    const y = -(radius + NUMBER_OUT) * Math.sin(q);
    const text = svg("text", { class: "lesson-number", x: x.toFixed(1), y: (y + 4).toFixed(1) }, String(k + 1));
    layer.append(svg("path", { class: isSliding ? "other lesson-other-slides" : "other", d }), text);
    numbers.push([[x - 7, y], [x + 7, y]]);
  }
  return numbers;
}
