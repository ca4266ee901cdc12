// The picture: layers of paths, other positions, the mechanism, vectors and names, in a view.

import { Drawing } from "./draw.js";
import { put, svg, write } from "./elements.js";
import { placeLabels } from "./labels.js";
import { lengthUnit, niceLength } from "./numbers.js";
import { otherPositions, Paths } from "./paths.js";
import { pointState } from "./quantities.js";
import { Vectors } from "./vectors.js";
import { View } from "./view.js";

const STAGE_MARGIN = 46;
const NAME_HEIGHT = 17;
const VALUE_HEIGHT = 16;

/**
 * What is shown.
 * @typedef {{names: boolean, paths: boolean, velocity: boolean, acceleration: boolean,
 *   positions: boolean, groups: boolean}} Switches
 */

export class Stage {
  /**
   * @param {Object} data the page's data
   * @param {import("./turn.js").Turn} turn
   * @param {SVGElement} element
   */
  constructor(data, turn, element) {
    this.element = element;
    this.view = new View();
    this.size = 1;
    /** How many times larger symbols and texts are: seen from afar. */
    this.magnified = 1;
    this.isFitted = true;
    /** What lies over the picture at its top and bottom, px. */
    this.head = 0;
    this.foot = 0;
    this.barFoot = 0;
    /** Rectangles that cover the picture: x0, y0, x1, y1, px. */
    this.covers = [];
    const layers = ["others", "paths", "links", "markers", "vectors", "badges", "names"];
    const made = layers.map((name) => svg("g", { class: `layer ${name}` }));
    this.layers = Object.fromEntries(layers.map((name, i) => [name, made[i]]));
    this.world = svg("g", {}, ...made);
    this.bar = svg("path", { class: "scale" });
    this.barText = svg("text", { class: "scale-text" });
    element.append(this.world, this.bar, this.barText);
    this.paths = new Paths(turn, this.layers.paths, this.layers.markers);
    this.velocity = new Vectors("velocity", turn, this.#layer());
    this.acceleration = new Vectors("acceleration", turn, this.#layer());
    /** More arrows: each has a layer, `isShown`, and `show` as vectors have it. */
    this.extras = [];
    this.texts = new Map();
    /** What is drawn besides: at every position `show(pose)`, for every scale `zoom(scale)`, if it has them. */
    this.overlays = [];
    /** @type {Switches} */
    this.switches = { names: true, paths: true, velocity: false, acceleration: false, positions: false, groups: false };
    this.#build(data, turn);
  }

  /**
   * Take another turn, perhaps of another mechanism; the joints chosen are those of the same names.
   * What is seen changes with the next `show`.
   * @param {Object} data the page's data
   * @param {import("./turn.js").Turn} turn
   */
  replace(data, turn) {
    const chosen = (this.chosen ?? []).map((joint) => joint.name);
    const names = (one) => one.joints.map((joint) => joint.name).join();
    if (this.drawing.fits(data) && names(this.data) === names(data)) {
      this.drawing.resized(data);
      this.#take(data, turn);
      this.names.forEach((label, i) => (label.joint = data.joints[i]));
    } else {
      for (const name of ["links", "names", "badges", "others"]) this.layers[name].replaceChildren();
      this.texts.clear();
      this.#build(data, turn);
      this.measure();
    }
    this.pose = null;
    this.choose(data.joints.filter((joint) => chosen.includes(joint.name)));
    this.set(this.switches);
  }

  #build(data, turn) {
    this.drawing = new Drawing(data, this.layers.links);
    this.names = data.joints.map((joint) => this.#label(`name ${joint.name}`, joint.name, "", NAME_HEIGHT, joint));
    this.#take(data, turn);
  }

  #take(data, turn) {
    this.data = data;
    this.turn = turn;
    for (const layer of [this.paths, this.velocity, this.acceleration]) layer.turn = turn;
    this.badges = null;
  }

  /** Add arrows of another kind; they draw in the layer that is returned. */
  addVectors(extra) {
    this.extras.push(extra);
    return this.#layer();
  }

  #layer() {
    const layer = svg("g");
    this.layers.vectors.append(layer);
    return layer;
  }

  /** Choose the joints with paths and vectors. */
  choose(joints) {
    this.chosen = joints;
    this.paths.choose(joints);
    this.velocity.choose(joints);
    this.acceleration.choose(joints);
  }

  /** Switch what is shown. */
  set(switches) {
    this.switches = switches;
    this.drawing.colour(switches.groups);
    if (switches.groups && !this.badges) this.badges = this.#badges();
    this.layers.badges.style.display = switches.groups ? "" : "none";
    for (const name of ["paths", "markers"]) this.layers[name].style.display = switches.paths ? "" : "none";
    this.layers.others.style.display = switches.positions ? "" : "none";
    for (const kind of ["velocity", "acceleration"]) {
      this[kind].layer.style.display = switches[kind] ? "" : "none";
    }
    for (const label of this.names) label.element.style.display = switches.names ? "" : "none";
    this.zoomed();
  }

  /** The window has another size. */
  resize(width, height) {
    if (width < 1 || height < 1) return;
    put(this.element, "viewBox", `0 0 ${width} ${height}`);
    this.view.resize(width, height);
    if (this.isFitted) this.fit();
    else this.panned();
  }

  /** Show all of the motion. */
  fit() {
    const bottom = STAGE_MARGIN + this.foot;
    this.view.fit(this.data.bounds, { left: STAGE_MARGIN, right: STAGE_MARGIN, top: STAGE_MARGIN + this.head, bottom });
    this.isFitted = true;
    this.zoomed();
  }

  /** Whether all of the motion is in the window. */
  isWithin() {
    const { view, data } = this;
    const [x0, y0, x1, y1] = data.bounds;
    const [left, bottom] = view.px(x0, y0);
    const [right, top] = view.px(x1, y1);
    return left >= 0 && right <= view.width && top >= 0 && bottom <= view.height;
  }

  zoom(x, y, factor) {
    this.view.zoom(x, y, factor);
    this.isFitted = false;
    this.zoomed();
  }

  pan(dx, dy) {
    this.view.pan(dx, dy);
    this.isFitted = false;
    this.panned();
  }

  /** Draw all for another scale. */
  zoomed() {
    const { scale } = this.view;
    this.size = this.view.density(this.data.usual) * this.magnified;
    this.drawing.zoom(scale, this.size);
    if (this.switches.paths) this.paths.zoom(scale, this.size);
    if (this.switches.positions) otherPositions(this.turn, this.drawing, this.layers.others);
    for (const overlay of this.overlays) overlay.zoom?.(scale);
    const length = niceLength(100 / scale);
    const px = length * scale;
    const { name, factor } = lengthUnit(length);
    this.barWidth = px;
    write(this.barText, `${Number((length * factor).toPrecision(3))} ${name}`);
    this.panned();
  }

  /** Move all; the scale is as before. */
  panned() {
    const { view } = this;
    put(this.world, "transform", `translate(${view.x.toFixed(2)} ${view.y.toFixed(2)})`);
    const y = view.height - 22 - this.barFoot;
    put(this.bar, "d", `M16 ${y - 4}v8m0 -4h${this.barWidth.toFixed(1)}m0 -4v8`);
    put(this.barText, "x", (this.barWidth + 24).toFixed(1));
    put(this.barText, "y", y + 4);
    if (this.pose) this.show(this.pose, this.speed);
  }

  /**
   * Show a position.
   * @param {import("./turn.js").Pose} pose
   * @param {number} speed of the coordinate
   */
  show(pose, speed) {
    this.pose = pose;
    this.speed = speed;
    this.world.style.visibility = pose.known ? "" : "hidden";
    if (!pose.known) return;
    const { scale } = this.view;
    const { switches, size } = this;
    this.drawing.show(pose);
    for (const overlay of this.overlays) overlay.show?.(pose);
    if (switches.paths) this.paths.show(pose);
    const values = [];
    const lines = [];
    for (const kind of ["velocity", "acceleration"]) {
      if (!switches[kind]) continue;
      const shown = this[kind].show(pose, scale, size, speed);
      values.push(...shown.labels);
      lines.push(...shown.lines);
    }
    for (const extra of this.extras) {
      if (!extra.isShown) continue;
      const shown = extra.show(pose, scale, size, speed);
      values.push(...shown.labels);
      lines.push(...shown.lines);
    }
    if (switches.groups) for (const badge of this.badges) this.#moveBadge(badge, pose, scale);
    this.#place(pose, values, lines);
  }

  /** Names and values find their places. */
  #place(pose, values, lines) {
    const { switches, view, drawing, size } = this;
    const names = switches.names ? this.names : [];
    for (const label of names) {
      const { x, y } = pointState(pose, label.joint.link, label.joint.at);
      label.x = x * view.scale;
      label.y = -y * view.scale;
      label.radius = label.joint.radius * size;
    }
    for (const label of this.texts.values()) label.isShown = false;
    const written = values.map(({ key, symbol, text, ...at }) => {
      const label = this.texts.get(key) ?? this.#value(key, symbol);
      if (label.text !== text) {
        label.text = text;
        label.element.lastChild.data = ` ${text}`;
        // Digits are of one width.
        label.width = 7.4 * this.magnified * (symbol.length + 1 + text.length) + 4;
      }
      return Object.assign(label, at, { isShown: true });
    });
    for (const label of this.texts.values()) label.element.style.display = label.isShown ? "" : "none";
    const labels = [...names, ...written];
    if (!labels.length) return;
    const obstacles = [...drawing.lines(pose), ...lines, ...this.#covered()];
    if (switches.paths) obstacles.push(...this.paths.lines);
    if (switches.groups) for (const { at: [x, y] } of this.badges) obstacles.push([[x - 9, y], [x + 9, y]]);
    const bounds = { low: [4 - view.x, 4 - view.y], high: [view.width - view.x - 4, view.height - view.y - 4] };
    const middles = placeLabels(labels, obstacles, bounds);
    labels.forEach(({ element }, i) => {
      put(element, "transform", `translate(${middles[i].x.toFixed(1)} ${(middles[i].y + 5).toFixed(1)})`);
    });
  }

  /** Return lines that fill what covers the picture. */
  #covered() {
    const { x, y } = this.view;
    const lines = [];
    for (const [x0, y0, x1, y1] of this.covers) {
      for (let own = y0; own <= y1 + 6; own += 12) lines.push([[x0 - x, own - y], [x1 - x, own - y]]);
    }
    return lines;
  }

  #label(key, symbol, text, height, joint) {
    const element = svg("text", { class: "label" }, svg("tspan", { class: "name" }, symbol), text);
    this.layers.names.append(element);
    const width = 9.5 * this.magnified * symbol.length + 4;
    return { key, element, joint, x: 0, y: 0, radius: 0, width, height: height * this.magnified, place: undefined };
  }

  #value(key, symbol) {
    const label = this.#label(key, symbol, " ", VALUE_HEIGHT, null);
    this.texts.set(key, label);
    return label;
  }

  /** Draw symbols and texts so many times larger; `resize` is called next. */
  magnify(factor) {
    this.magnified = factor;
    for (const label of this.names) label.height = NAME_HEIGHT * factor;
    for (const { element } of this.texts.values()) element.remove();
    this.texts.clear();
    this.measure();
    this.zoomed();
  }

  /** Measure the names, once they are in the page. */
  measure() {
    for (const label of this.names) {
      const width = label.element.getBBox?.().width ?? 0;
      if (width > 0) label.width = width + 4;
    }
  }

  /** Each link of a group has the class of its group beside it, the driver a I. */
  #badges() {
    const { data } = this;
    this.layers.badges.replaceChildren();
    return data.links.flatMap((link, i) => {
      const group = data.groups[i];
      const isDriven = data.driven.includes(i);
      const joints = data.joints.filter((joint) => joint.links.includes(i));
      if (i === 0 || (group < 0 && !isDriven)) return [];
      const text = isDriven ? "I" : data.classes[group];
      const width = 14 + 6 * text.length;
      const element = svg(
        "g", { class: "badge" },
        svg("rect", { x: -width / 2, y: -9, width, height: 18, rx: 9 }),
        svg("text", { y: 4.5 }, text),
      );
      element.style.setProperty("--own", isDriven ? "var(--driver)" : `var(--group-${group % 6})`);
      this.layers.badges.append(element);
      return [{ link: i, element, joints, at: [0, 0] }];
    });
  }

  #moveBadge(badge, pose, scale) {
    const { link, element, joints } = badge;
    let x = pose.value[3 * link];
    let y = pose.value[3 * link + 1];
    if (joints.length) {
      const places = joints.map((joint) => pointState(pose, joint.link, joint.at));
      x = places.reduce((sum, place) => sum + place.x, 0) / places.length;
      y = places.reduce((sum, place) => sum + place.y, 0) / places.length;
    }
    // Beside a bar, inside a plate.
    const aside = joints.length > 2 ? 0 : 15 * this.magnified;
    badge.at = [x * scale + aside, -y * scale + aside];
    put(element, "transform", `translate(${badge.at[0].toFixed(1)} ${badge.at[1].toFixed(1)})scale(${this.magnified})`);
  }
}
