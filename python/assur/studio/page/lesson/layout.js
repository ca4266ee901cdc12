// Where the parts of the lesson stand.

import { html } from "../../../pictures/page/elements.js";
import { button } from "../../../pictures/page/panel.js";
import { sayLesson } from "./lesson_words.js";

const FIT_ICON = "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5";

/**
 * Put the parts into the host.
 * @param {HTMLElement} host
 * @param {{fields: Object, bar: Object, panel: Object, picture: Element, warning: Object, card: Object,
 *   dial: Object, diagrams: Element[]}} parts
 * @param {() => void} fit
 */
export function layOut(host, { fields, bar, panel, picture, warning, card, dial, diagrams }, fit) {
  fields.bar.append(bar.element);
  const fitButton = button(sayLesson("fit"), FIT_ICON);
  fitButton.classList.add("lesson-fit");
  fitButton.addEventListener("click", fit);
  const status = html("p", { class: "status", role: "status", "aria-live": "polite" });
  const over = [status, warning.element, card.element, fitButton];
  const canvas = html("div", { class: "canvas lesson-canvas" }, picture, ...over);
  const charts = html("div", { class: "charts lesson-charts" }, ...diagrams);
  const dock = html("div", { class: "lesson-dock" }, dial.element, charts);
  const aside = html("aside", { class: "lesson-panel" }, fields.element, panel.element);
  host.replaceChildren(aside, canvas, dock);
  return { canvas, status, charts };
}
