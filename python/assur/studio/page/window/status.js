// What is said over the picture: whether it moves and how, and what is wrong where it is.

import { html, icon } from "../../../pictures/page/elements.js";
import { formula } from "../../../pictures/page/panel.js";
import { say } from "../../../pictures/page/words.js";

const MARKS = { moves: "M5 12l5 5 9-10", wrong: "M6 6l12 12M18 6L6 18", open: "M12 5v9M12 18v1" };

export class Status {
  /** @param {import("../model/model.js").Model} model */
  constructor(model) {
    this.model = model;
    this.element = html("div", { class: "pill", role: "status", "aria-live": "polite" });
    model.on("checked", () => this.show());
    this.show();
  }

  show() {
    const { checked } = this.model;
    const { state, structure, message } = checked;
    const kind = { moves: "moves", stuck: "wrong", invalid: "wrong" }[state] ?? "open";
    const mark = html("span", { class: `mark-${kind}` }, icon(MARKS[kind]));
    const parts = [mark, html("b", {}, say(state))];
    if (state === "moves") {
      parts.push(html("span", { class: "note" }, say("mobility", { n: structure.mobility })), formula(structure.formula));
    } else if (checked.counted.mobility !== undefined && state !== "empty") {
      parts.push(html("span", { class: "note" }, say("mobility", { n: checked.counted.mobility })));
    }
    this.element.replaceChildren(...parts);
    this.element.title = message;
  }
}
