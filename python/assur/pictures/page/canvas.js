// The picture with what lies on it: messages, switches, the choice of points.

import { html, svg, write } from "./elements.js";
import { button, pointChoice, switchRow } from "./panel.js";
import { Stage } from "./stage.js";
import { say } from "./words.js";

const FIT = "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5";
/** Below this width the switches stand under the picture, px. */
const NARROW = 700;
/** Where what lies over the picture begins, px. */
const TOP = 12;
/** What reaches over this part of the width is over the picture's middle. */
const FAR = 0.42;

export class Canvas {
  /**
   * @param {HTMLElement} root has the class `grouped` where groups are coloured
   * @param {Object} data the page's data
   * @param {import("./turn.js").Turn} turn
   * @param {Partial<import("./stage.js").Switches>} [switches] those that are on at first, or off
   */
  constructor(root, data, turn, switches = {}) {
    this.root = root;
    this.picture = svg("svg", { class: "picture", role: "img", tabindex: 0 });
    this.stage = new Stage(data, turn, this.picture);
    this.status = html("p", { class: "status", role: "status", "aria-live": "polite" });
    this.warning = html("p", { class: "warning", hidden: "" });
    const own = { ...this.stage.switches, ...switches };
    this.row = switchRow(own, (state) => this.set(state));
    this.fit = button(say("fit"), FIT, say("fit"));
    this.fit.addEventListener("click", () => this.stage.fit());
    this.corner = html("div", { class: "corner" }, this.#points(data), this.fit);
    this.element = html("div", { class: "canvas" }, this.picture, this.status, this.warning, this.corner, this.row);
    /** What else lies over the picture, at its top. */
    this.covers = [];
    this.stage.choose(data.joints.filter((joint) => data.paths.includes(joint.name)));
    this.set(own);
  }

  /** Lay something over the top of the picture: what is fitted and named keeps clear of it. */
  cover(element) {
    this.covers.push(element);
    this.element.append(element);
  }

  /** Switch what is shown. */
  set(switches) {
    this.stage.set(switches);
    this.root.classList.toggle("grouped", switches.groups);
  }

  /** Take another turn; of another mechanism with the joints that it wants. */
  replace(data, turn) {
    const names = (joints) => joints.map((joint) => joint.name).join();
    const isOther = names(this.stage.data.joints) !== names(data.joints);
    this.stage.replace(data, turn);
    if (!isOther) return;
    if (!this.stage.chosen.length) this.#choose(data.paths);
    const chosen = this.stage.chosen.map((joint) => joint.name);
    this.corner.firstChild.replaceWith(this.#points({ ...data, paths: chosen }));
  }

  #points(data) {
    return pointChoice(data.joints, data.paths, (names) => this.#choose(names));
  }

  #choose(names) {
    this.stage.choose(this.stage.data.joints.filter((joint) => names.includes(joint.name)));
    this.stage.zoomed();
  }

  /** Say what is wrong, or nothing. */
  warn(text) {
    this.warning.hidden = !text;
    write(this.warning, text);
  }

  /** The window has another size. */
  resize() {
    const { picture, stage, corner, row } = this;
    const { clientWidth: width, clientHeight: height } = picture;
    const isNarrow = this.root.clientWidth < NARROW;
    // The scale bar stands beside the switches, or above them.
    stage.foot = isNarrow ? 0 : row.offsetHeight;
    stage.barFoot = !isNarrow && row.offsetWidth > width - 220 ? row.offsetHeight + 4 : 0;
    // Where they reach far over the picture it begins under the lowest.
    const reaches = (one) => one.offsetLeft + one.offsetWidth > FAR * width;
    const heights = this.covers.map((one) => one.offsetHeight + (reaches(one) ? Math.max(one.offsetTop - TOP, 0) : 0));
    stage.head = Math.max(isNarrow ? corner.offsetHeight : 0, ...heights);
    const box = picture.getBoundingClientRect();
    stage.covers = [corner, ...this.covers, ...(isNarrow ? [] : [row])].map((over) => {
      const own = over.getBoundingClientRect();
      return [own.left - box.left, own.top - box.top, own.right - box.left, own.bottom - box.top];
    });
    stage.resize(width, height);
  }
}
