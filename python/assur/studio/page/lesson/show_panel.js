// The panel's switches, and the choice of joints with paths and arrows.

import { html, put } from "../../../pictures/page/elements.js";
import { sayLesson } from "./lesson_words.js";
import { plainText, withSymbols } from "./symbols.js";

const LESSON_SWITCHES = ["paths", "velocities", "accelerations", "diagrams", "positions", "givesWay"];
const CHOSEN_JOINTS = ["B", "C", "D"];

export class ShowPanel {
  /**
   * @param {Object<string, boolean>} state by switch
   * @param {string[]} chosen joints
   * @param {{switched: (key: string, isOn: boolean) => void, chosen: (names: string[]) => void}} on
   */
  constructor(state, chosen, on) {
    const rows = LESSON_SWITCHES.map((key) => {
      const text = sayLesson(key);
      const kind = { type: "checkbox", role: "switch", class: "lesson-switch-box" };
      const box = html("input", { ...kind, "aria-label": plainText(text) });
      box.checked = state[key];
      box.addEventListener("change", () => on.switched(key, box.checked));
      const label = html("label", { class: "lesson-switch" }, box, html("span", {}, ...withSymbols(text)));
      const row = html("div", { class: "lesson-switch-row" }, label);
      if (key === "paths") row.append(this.#points(chosen, on.chosen));
      if (key === "positions") row.append(html("span", { class: "lesson-aside" }, sayLesson("every")));
      return row;
    });
    const note = html("p", { class: "lesson-hint" }, ...withSymbols(sayLesson("assumption")));
    this.element = html("section", { class: "lesson-section" }, html("h2", {}, sayLesson("show")), ...rows, note);
  }

  #points(chosen, changed) {
    const own = new Set(chosen);
    const buttons = CHOSEN_JOINTS.map((name) => {
      const label = sayLesson("point", { joint: name });
      const button = html("button", { type: "button", class: "lesson-point", "aria-label": label }, name);
      put(button, "aria-pressed", String(own.has(name)));
      button.addEventListener("click", () => {
        if (!own.delete(name)) own.add(name);
        put(button, "aria-pressed", String(own.has(name)));
        // The first has a full line: C, which moves as nobody sees at once.
        changed(["C", "B", "D"].filter((one) => own.has(one)));
      });
      return button;
    });
    return html("span", { class: "lesson-points" }, ...buttons);
  }
}
