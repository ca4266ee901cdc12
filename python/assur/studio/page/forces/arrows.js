// Arrows of loads and of forces in pairs, on the picture: golden, with their values.

import { pathOf } from "../../../pictures/page/draw.js";
import { html, put, svg } from "../../../pictures/page/elements.js";
import { digits, forceUnit } from "../../../pictures/page/numbers.js";
import { pointState } from "../../../pictures/page/quantities.js";
import { filledHead } from "../../../pictures/page/vectors.js";
import { say } from "../../../pictures/page/words.js";
import { appliedForce, jointForce, slideForce } from "./answers.js";
import { peakOf, withoutLimit } from "./peaks.js";

/** The longest arrow of the turn, how far beyond it one may go, and the least that is drawn, px. */
const LONGEST_FORCE = 95;
const FORCE_BEYOND = 1.6;
const LEAST_FORCE = 3;
const FORCE_HEAD = [13, 11];

/**
 * Return what is drawn of forces: where each acts and how large it is.
 * @param {import("./answers.js").Forces} forces
 * @param {Object} data the page's data
 * @param {string[]} chosen joints; of none all are drawn
 * @returns {{key: string, symbol: string, isLoad: boolean, at: (pose: Object) => number[]}[]} `at` returns
 *   x, y, Fx, Fy
 */
export function shownForces(forces, data, chosen) {
  const joint = (name) => data.joints.find((one) => one.name === name);
  const wants = (name) => !chosen.length || chosen.includes(name);
  const place = (pose, name) => {
    const own = joint(name);
    const { x, y } = pointState(pose, own.link, own.at);
    return [x, y];
  };
  const inJoints = forces.joints.flatMap(({ joint: name, on }, i) => {
    if (!joint(name) || !wants(name)) return [];
    return [{
      key: `R ${name} ${on}`,
      symbol: "R",
      isLoad: false,
      at: (pose) => [...place(pose, name), ...jointForce(forces, i, pose.q)],
    }];
  });
  const onSlides = forces.slides.flatMap(({ slide: name, on }, i) => {
    const slide = data.slides.find((one) => one.name === name);
    const link = data.links.indexOf(on);
    const near = data.joints.filter((one) => one.links.includes(link));
    if (!slide || !(near.length ? near.some((one) => wants(one.name)) : !chosen.length)) return [];
    return [{
      key: `N ${name}`, symbol: "N", isLoad: false,
      at(pose) {
        const { x, y } = pointState(pose, slide.link, slide.at);
        const angle = pose.value[3 * slide.on + 2] + slide.angle;
        const [normal] = slideForce(forces, i, pose.q);
        return [x, y, -normal * Math.sin(angle), normal * Math.cos(angle)];
      },
    }];
  });
  const loads = forces.applied.map(({ load, on }, i) => ({
    key: `F ${load} ${on} ${i}`, symbol: "F", isLoad: true, at: (pose) => appliedForce(forces, i, pose.q),
  }));
  return [...inJoints, ...onSlides, ...loads];
}

/** Return nearly the greatest force along the rows: near dead points there is no greatest. */
export function usualForce(shown, turn) {
  const sizes = turn.coordinates(360).flatMap((q) => {
    const pose = turn.sample(q);
    return pose.known ? shown.map(({ at }) => Math.hypot(...at(pose).slice(2))) : [];
  });
  return peakOf(sizes, turn.closes).most;
}

export class ForceArrows {
  /**
   * @param {import("./answers.js").ForceAnswers} answers
   * @param {import("../../../pictures/page/canvas.js").Canvas} canvas
   */
  constructor(answers, canvas) {
    this.answers = answers;
    this.canvas = canvas;
    this.layer = canvas.stage.addVectors(this);
    this.arrows = [];
    this.made = {};
    this.box = html("input", { type: "checkbox", "data-switch": "forces" });
    this.switch = html(
      "label",
      { class: "switch", title: say("forcesHint") },
      this.box,
      html("i", { class: "swatch force" }),
      say("forces"),
    );
    this.box.checked = answers.isShown;
    this.box.addEventListener("change", () => {
      answers.isShown = this.box.checked;
      this.#again();
    });
    canvas.row.append(this.switch);
    const { model } = answers;
    for (const event of ["forces", "checked", "document"]) model.on(event, () => this.#offer());
    this.#offer();
  }

  get isShown() {
    return this.answers.isShown && this.answers.forces !== null;
  }

  #wasShown = false;

  /** The switch is there if there can be forces. */
  #offer() {
    const isHidden = !this.answers.canBe;
    if (this.switch.hidden !== isHidden) {
      this.switch.hidden = isHidden;
      this.canvas.resize();
    }
    this.#again();
  }

  #again() {
    const { isShown } = this;
    this.layer.style.display = isShown ? "" : "none";
    // Those of another document stand until their own are there.
    this.layer.style.opacity = this.answers.isPresent ? "" : "0.35";
    const { stage } = this.canvas;
    // Labels make room for arrows, and take it back.
    if (stage.pose && (isShown || this.#wasShown)) stage.show(stage.pose, stage.speed);
    this.#wasShown = isShown;
  }

  #make() {
    const { stage } = this.canvas;
    const { forces } = this.answers;
    const { data, turn } = stage;
    const chosen = stage.chosen.map((joint) => joint.name).join("\n");
    if (this.made.forces === forces && this.made.data === data && this.made.chosen === chosen) return;
    this.made = { forces, data, chosen };
    const shown = shownForces(forces, data, chosen ? chosen.split("\n") : []);
    this.layer.replaceChildren();
    this.arrows = shown.map((own) => {
      const kind = own.isLoad ? "force applied" : "force";
      const line = svg("path", { class: `vector ${kind}`, "data-force": own.key });
      const head = svg("path", { class: `head ${kind}` });
      this.layer.append(line, head);
      return { ...own, line, head };
    });
    this.greatest = usualForce(shown, turn);
    this.per = LONGEST_FORCE / (this.greatest || Infinity);
  }

  /** Bring the place of a value into the picture: a load may begin outside. */
  #within([x, y]) {
    const { view } = this.canvas.stage;
    return [
      Math.min(Math.max(x, 40 - view.x), view.width - view.x - 40),
      Math.min(Math.max(y, 20 - view.y), view.height - view.y - 20),
    ];
  }

  /** Show a position; returns the values as labels and the lines of the arrows, px. */
  show(pose, scale, size) {
    this.#make();
    const labels = [];
    const lines = [];
    const unit = forceUnit("N", this.greatest);
    for (const { key, symbol, isLoad, at, line, head } of this.arrows) {
      const [x, y, fx, fy] = at(pose);
      const force = Math.hypot(fx, fy);
      const px = Math.min(force * this.per, FORCE_BEYOND * LONGEST_FORCE);
      const isDrawn = px > LEAST_FORCE;
      line.style.display = head.style.display = isDrawn ? "" : "none";
      if (!isDrawn) continue;
      const [ux, uy] = [fx / force, -fy / force];
      const start = [x * scale, -y * scale];
      // A load pushes: its tip is where it acts. The force in a joint begins there.
      if (isLoad) start.forEach((_, i) => (start[i] -= (px + 9 * size) * [ux, uy][i]));
      const tip = [start[0] + px * ux, start[1] + px * uy];
      const own = size * Math.min(1, px / 26);
      put(line, "d", pathOf([start, [tip[0] - 8 * own * ux, tip[1] - 8 * own * uy]]));
      put(head, "d", filledHead(...tip, ux, uy, own, FORCE_HEAD));
      lines.push([start, tip]);
      // The values of another document are not told.
      if (!this.answers.isPresent) continue;
      const [lx, ly] = this.#within(isLoad ? start : tip);
      const text = withoutLimit(force, this.greatest) ? "∞" : `${digits(force * unit.factor)} ${unit.name}`;
      labels.push({ x: lx, y: ly, radius: 4, key, symbol, text });
    }
    return { labels, lines };
  }
}
