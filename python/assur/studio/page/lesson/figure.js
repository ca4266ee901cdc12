// The picture of the lesson: the mechanism with paths, arrows, successive positions and names; the
// rod and the locked joint while D slides.

import { Drawing, pathOf } from "../../../pictures/page/draw.js";
import { put, svg } from "../../../pictures/page/elements.js";
import { placeLabels } from "../../../pictures/page/labels.js";
import { digits } from "../../../pictures/page/numbers.js";
import { Paths } from "../../../pictures/page/paths.js";
import { pointState } from "../../../pictures/page/quantities.js";
import { Vectors } from "../../../pictures/page/vectors.js";
import { View } from "../../../pictures/page/view.js";
import { lessonScene } from "./lesson_scene.js";
import { Loupe } from "./loupe.js";
import { successive } from "./successive.js";
import { Support } from "./support.js";

const LESSON_LAYERS = [
  ...["others", "paths", "dimension", "band", "links", "markers", "lock"],
  ...["velocity", "acceleration", "names", "loupe", "support"],
];
/** Switches of arrows and the layers that have them. */
const ARROWS = [["velocities", "velocity"], ["accelerations", "acceleration"]];
const LAYERS_SWITCHED = [["paths", "paths"], ["paths", "markers"], ["positions", "others"], ...ARROWS];
const LESSON_NAME_HEIGHT = 17;
const LESSON_VALUE_HEIGHT = 16;
/** Drawn lines narrower than this have smaller symbols: px to 60 px of the crank. */
const NARROW_FIGURE = 560;

export class LessonFigure {
  /**
   * @param {import("./motion.js").LessonMotion} motion
   * @param {{dragged: (l4: number) => void, began: () => void, ended: () => void}} on of the support
   */
  constructor(motion, on) {
    this.view = new View();
    this.size = 1;
    /** What lies over the picture at its top, px. */
    this.head = 0;
    this.switches = { paths: true, velocities: false, accelerations: false, positions: false, givesWay: true };
    this.chosen = ["C", "B"];
    this.element = svg("svg", { class: "picture lesson-picture", role: "img", tabindex: 0 });
    this.layers = Object.fromEntries(LESSON_LAYERS.map((name) => [name, svg("g", { class: `layer lesson-${name}` })]));
    this.world = svg("g", {}, ...Object.values(this.layers));
    this.element.append(this.world);
    this.support = new Support(this, on);
    this.loupe = new Loupe(this.layers.loupe);
    this.band = svg("path", { class: "lesson-band-line" });
    this.layers.band.append(this.band);
    const cross = svg("path", { class: "lesson-lock-cross", d: "M-4 -4L4 4M-4 4L4 -4" });
    this.lock = svg("g", {}, svg("circle", { class: "lesson-lock-disc", r: 9 }), cross);
    this.layers.lock.append(this.lock);
    this.names = motion.joints.map(({ name }) => this.#label(name, "", LESSON_NAME_HEIGHT));
    this.values = new Map();
    this.replace(motion, true);
  }

  /**
   * Draw another motion.
   * @param {import("./motion.js").LessonMotion} motion
   * @param {boolean} isFitted whether the view fits it
   */
  replace(motion, isFitted) {
    this.motion = motion;
    const { lengths, asked } = motion;
    const key = [lengths.l1, lengths.l2, lengths.l3, Math.sign(asked.speed)].join();
    if (key !== this.key) {
      this.key = key;
      this.layers.links.replaceChildren();
      this.drawing = new Drawing(lessonScene(lengths, Math.sign(asked.speed)), this.layers.links);
    }
    this.paths ??= new Paths(motion, this.layers.paths, this.layers.markers);
    for (const [, name] of ARROWS) {
      this[name] ??= new Vectors(name, motion, this.layers[name]);
      this[name].turn = motion;
    }
    this.#choose();
    if (isFitted) this.fit();
    else this.#zoomed();
  }

  /** Choose the joints with paths and arrows. */
  choose(names) {
    this.chosen = names;
    this.#choose();
    this.#zoomed();
  }

  /** What is drawn of the turn: where the support is held, only what swings. */
  get turn() {
    return this.switches.givesWay ? this.motion : this.motion.swinging;
  }

  #choose() {
    const joints = this.chosen.map((name) => this.motion.joints.find((one) => one.name === name));
    this.paths.choose(joints);
    this.velocity.choose(joints);
    this.acceleration.choose(joints);
  }

  /** Switch what is shown. */
  set(switches) {
    this.switches = { ...this.switches, ...switches };
    this.#zoomed();
  }

  resize(width, height) {
    if (width < 1 || height < 1) return;
    put(this.element, "viewBox", `0 0 ${width} ${height}`);
    this.view.resize(width, height);
    this.fit();
  }

  /** Show all of the motion; `head`: what lies over the picture at its top, px. */
  fit(head = this.head) {
    this.head = head;
    const isNarrow = this.view.width < NARROW_FIGURE;
    const { width, height } = this.view;
    const top = Math.min(Math.max(isNarrow ? 92 : 150, this.head + 24), 0.45 * height);
    // On the left there is room for the loupe, below for the dimension.
    const left = isNarrow ? 30 : Math.min(190, Math.max(150, 0.16 * width));
    const room = { left, right: isNarrow ? 30 : 84, top, bottom: isNarrow ? 62 : 50 };
    this.view.fit(this.motion.bounds, room);
    this.#zoomed();
  }

  zoom(x, y, factor) {
    this.view.zoom(x, y, factor);
    this.#zoomed();
  }

  pan(dx, dy) {
    this.view.pan(dx, dy);
    this.#panned();
  }

  #zoomed() {
    const { scale } = this.view;
    const { l1, l3 } = this.motion.lengths;
    this.size = this.view.density(Math.max(l1, l3));
    this.drawing.zoom(scale, this.size);
    for (const [key, name] of LAYERS_SWITCHED) {
      this.layers[name].style.display = this.switches[key] ? "" : "none";
    }
    this.paths.turn = this.turn;
    this.paths.zoom(scale, this.size);
    this.layers.others.replaceChildren();
    if (this.switches.positions) {
      this.numbers = successive(this.motion, this.turn, this.drawing, this.layers.others, scale);
    }
    this.#panned();
  }

  #panned() {
    put(this.world, "transform", `translate(${this.view.x.toFixed(2)} ${this.view.y.toFixed(2)})`);
    if (this.pose) this.show(this.pose, this.state);
  }

  /**
   * Show a position.
   * @param {import("./motion.js").LessonPose} pose
   * @param {{speed: number, isLocked: boolean, givesWay: boolean, l4: number, unit: string}} state
   *   `isLocked`: joint C is jammed
   */
  show(pose, state) {
    this.state = state;
    // Of a position that does not exist the last good one stays.
    if (!pose.known) return;
    this.pose = pose;
    const { scale } = this.view;
    const isSliding = state.isLocked && state.givesWay;
    this.element.classList.toggle("lesson-slides", isSliding);
    this.layers.band.style.display = this.layers.lock.style.display = state.isLocked ? "" : "none";
    this.drawing.show(pose);
    const states = this.motion.points(pose);
    const seen = ([name, { x, y }]) => [name, [x * scale, -y * scale]];
    const at = Object.fromEntries(Object.entries({ A: { x: 0, y: 0 }, ...states }).map(seen));
    if (state.isLocked) {
      put(this.band, "d", pathOf([at.B, at.C, at.D]));
      put(this.lock, "transform", `translate(${at.C.map((x) => x.toFixed(2)).join(" ")})`);
    }
    if (this.switches.paths) this.paths.show(pose);
    const labels = [];
    const lines = [];
    for (const [kind, name] of ARROWS) {
      if (!this.switches[kind]) continue;
      const shown = this[name].show(pose, scale, this.size, state.speed);
      const isRelative = state.unit === "l₁";
      for (const label of shown.labels) if (isRelative) label.text = this.#relative(pose, label.key, state.speed);
      labels.push(...shown.labels);
      lines.push(...shown.lines);
    }
    this.support.show(pose, at, state);
    const travel = isSliding ? state.l4 - -pose.value[12] : 0;
    this.loupe.show(this.view, at.D, travel, scale, this.size);
    this.#place(at, pose, labels, lines);
  }

  /** Write a rate in crank lengths. */
  #relative(pose, key, speed) {
    const [kind, name] = key.split(" ");
    const joint = this.motion.joints.find((one) => one.name === name);
    const { x1, y1, x2, y2 } = pointState(pose, joint.link, joint.at);
    const isFirst = kind === "velocity";
    const size = isFirst ? Math.hypot(x1, y1) * Math.abs(speed) : Math.hypot(x2, y2) * speed * speed;
    return `${digits(size)} l₁/s${isFirst ? "" : "²"}`;
  }

  /** Names and values find their places. */
  #place(at, pose, values, lines) {
    this.names.forEach((label, i) => {
      const { name, radius } = this.motion.joints[i];
      [label.x, label.y] = at[name];
      label.radius = radius * this.size + (name === "A" ? 4 : 0);
    });
    for (const label of this.values.values()) label.isShown = false;
    const written = values.map(({ key, symbol, text, ...place }) => {
      const label = this.values.get(key) ?? this.#label(symbol, " ", LESSON_VALUE_HEIGHT);
      this.values.set(key, label);
      label.element.lastChild.data = ` ${text}`;
      label.width = 7.4 * (symbol.length + 1 + text.length) + 4;
      return Object.assign(label, place, { isShown: true });
    });
    for (const label of this.values.values()) label.element.style.display = label.isShown ? "" : "none";
    const { view } = this;
    const obstacles = [...this.drawing.lines(pose), ...lines, ...this.support.lines];
    if (this.switches.paths) obstacles.push(...this.paths.lines);
    if (this.switches.positions) obstacles.push(...(this.numbers ?? []));
    const bounds = { low: [4 - view.x, 4 - view.y], high: [view.width - view.x - 4, view.height - view.y - 4] };
    const all = [...this.names, ...written];
    const middles = placeLabels(all, obstacles, bounds);
    all.forEach(({ element }, i) => {
      const { x, y } = middles[i];
      put(element, "transform", `translate(${x.toFixed(1)} ${(y + 5).toFixed(1)})`);
    });
  }

  #label(symbol, text, height) {
    const element = svg("text", { class: "label" }, svg("tspan", { class: "name" }, symbol), text);
    this.layers.names.append(element);
    return { element, x: 0, y: 0, radius: 0, width: 9.5 * symbol.length + 4, height, place: undefined };
  }
}
