// The figures of the instant at which it was stopped, as the server computed them.

import { html } from "../../../pictures/page/elements.js";
import { degrees, digits } from "../../../pictures/page/numbers.js";
import { lengthText, turnText } from "./entries.js";
import { sayLesson } from "./lesson_words.js";
import { withSymbols } from "./symbols.js";

const CLOSE_CARD = "✕";

export class FiguresCard {
  constructor() {
    const hide = { type: "button", class: "lesson-card-close", "aria-label": sayLesson("hide") };
    const close = html("button", hide, CLOSE_CARD);
    close.addEventListener("click", () => this.hide());
    this.angle = html("output", { class: "lesson-card-angle" });
    this.rows = html("dl", {});
    const head = html("div", { class: "lesson-card-head" }, html("h3", {}, sayLesson("stopped")), this.angle, close);
    this.element = html("div", { class: "lesson-card", hidden: "" }, head, this.rows);
  }

  hide() {
    this.element.hidden = true;
  }

  /**
   * Show the figures.
   * @param {Object} position of the answer
   * @param {{phi1: number, unit: string, pushes: boolean, isHeld: boolean, chosen: string[]}} at `isHeld`: the
   *   support does not give way: where C is jammed nothing moves
   */
  show(position, { phi1, unit, pushes, isHeld, chosen }) {
    this.element.hidden = false;
    this.angle.textContent = turnText(phi1);
    const own = unit ? ` ${unit}` : "";
    const { links, joints, sliding } = position;
    const size = (pair) => Math.hypot(...pair);
    const rocker = Math.atan2(Math.sin(links.rocker.value), Math.cos(links.rocker.value));
    const rows = [
      ["γ", "", `${lengthText(Number(position.gamma.toFixed(4)))} rad`],
      ["φ_3", "", degrees(rocker, 2)],
    ];
    const isStuck = isHeld && sliding;
    if (isStuck) return this.#fill([...rows, ["l_4", sayLesson("held"), `${lengthText(position.l4)}${own}`]]);
    const force = `${sayLesson("force")} ${sayLesson(pushes ? "pushes" : "pulls")}`;
    rows.push(["ω_3", sliding ? "" : force, `${digits(links.rocker.speed)} rad/s`]);
    if (sliding) rows.push(["$B$D", sayLesson("held"), `${lengthText(position.rod)}${own}`]);
    rows.push(["l_4", sliding ? sayLesson("slides") : "", `${lengthText(position.l4)}${own}`]);
    const per = `${unit || "l₁"}/s`;
    for (const name of chosen) {
      const { speed, acceleration } = joints[name];
      rows.push([`v_${name}, a_${name}`, "", `${digits(size(speed))} ${per}, ${digits(size(acceleration))} ${per}²`]);
    }
    return this.#fill(rows);
  }

  #fill(rows) {
    const row = ([symbol, note, value]) => {
      const name = html("dt", {}, ...withSymbols(symbol));
      return html("div", {}, name, html("dd", { class: "lesson-note" }, note), html("dd", {}, value));
    };
    this.rows.replaceChildren(...rows.map(row));
  }
}
