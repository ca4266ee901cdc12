// A mechanism as SVG: each link's parts in its own frame, so that a position sets transforms alone.

import { put, svg } from "./elements.js";

/** Strokes of hatching: px across their line, and how many at most (of a link seen very large). */
const HATCH_DEPTH = 7;
const MOST_STROKES = 400;
/** What is nearer, relative to a usual link, is the same place: rounding. */
const SAME_PLACE = 1e-6;
/** What makes a part another one; numbers of its size may differ. */
const PART_KEYS = ["link", "name", "colour", "closed", "fill", "hatched", "floor", "disc", "hatching", "width"];

/**
 * Return where a list of vertices x, y (m), dx, dy (px) is drawn, in px of the link's frame.
 * @param {number[]} at
 * @param {number} scale px to a metre
 * @param {number} size of symbols
 * @returns {number[][]}
 */
export function placed(at, scale, size) {
  const points = [];
  for (let i = 0; i < at.length; i += 4) {
    points.push([at[i] * scale + at[i + 2] * size, -at[i + 1] * scale - at[i + 3] * size]);
  }
  return points;
}

/** Write a path through points. */
export function pathOf(points, closed = false) {
  const text = points.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join("L");
  return `M${text}${closed ? "Z" : ""}`;
}

/**
 * Return strokes of hatching on the right of a line, as one goes from start to end.
 * @returns {number[][][]}
 */
export function hatchedLine([x0, y0], [x1, y1], spacing, depth) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  const ux = (x1 - x0) / length;
  const uy = (y1 - y0) / length;
  const strokes = [];
  const count = Math.min(Math.floor(length / spacing + 1e-9), MOST_STROKES);
  for (let i = 1; i <= count; i++) {
    const foot = i * spacing;
    // Each leans back from its foot, and none beyond the line's end. y is down: right is (−uy, ux).
    const lean = Math.min(0.7 * depth, foot);
    const x = x0 + foot * ux;
    const y = y0 + foot * uy;
    strokes.push([[x, y], [x + lean * (-uy - ux), y + lean * (ux - uy)]]);
  }
  return strokes;
}

/** Return strokes at 45° inside a convex area. */
export function hatchedArea(corners, spacing) {
  const level = ([x, y]) => x + y;
  const levels = corners.map(level);
  const low = Math.min(...levels);
  const high = Math.max(...levels);
  const step = Math.max(spacing * Math.SQRT2, (high - low) / MOST_STROKES);
  const strokes = [];
  for (let own = low + step / 2; own < high; own += step) {
    const cuts = [];
    corners.forEach((a, i) => {
      const b = corners[(i + 1) % corners.length];
      const da = level(a) - own;
      const db = level(b) - own;
      if (da < 0 !== db < 0) {
        const t = da / (da - db);
        cuts.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
      }
    });
    if (cuts.length === 2) strokes.push(cuts);
  }
  return strokes;
}

const pathOfStrokes = (strokes) => strokes.map((stroke) => pathOf(stroke)).join("");

export class Drawing {
  /**
   * @param {Object} scene the page's data
   * @param {SVGElement} layer where to draw
   */
  constructor(scene, layer) {
    this.scene = scene;
    this.scale = 0;
    this.size = 0;
    /** Groups of parts in drawing order: consecutive parts of one link share one. */
    this.groups = [];
    /** What draws each part, and the parts that are to be drawn though the scale is the same. */
    this.redraw = new Map();
    this.stale = new Set();
    /** What the functions that draw hold: sizes change, the rest stays. */
    this.parts = scene.parts.map((part) => ({ ...part }));
    let last = null;
    for (const part of this.parts) {
      if (!last || last.link !== part.link) {
        last = { link: part.link, element: svg("g", { "data-link": scene.links[part.link] }) };
        this.groups.push(last);
        layer.append(last.element);
      }
      this.#make(part, last.element);
    }
    this.colour(false);
  }

  /** Whether another scene has the same parts, perhaps of other sizes. */
  fits(scene) {
    const { parts, links } = this.scene;
    const isSame = (part, i) => PART_KEYS.every((key) => part[key] === scene.parts[i][key]) && part.at.length === scene.parts[i].at.length;
    return links.join() === scene.links.join() && parts.length === scene.parts.length && parts.every(isSame);
  }

  /** Draw another scene whose parts fit, at the next zoom: what has another size. */
  resized(scene) {
    const tiny = SAME_PLACE * scene.usual;
    scene.parts.forEach((part, i) => {
      const own = this.parts[i];
      if (!part.at.some((number, k) => Math.abs(number - own.at[k]) > tiny)) return;
      this.stale.add(Object.assign(own, part));
    });
    this.scene = scene;
  }

  /** Colour links by their Assur groups, or not. */
  colour(byGroup) {
    this.byGroup = byGroup;
    const { scene } = this;
    for (const { link, element } of this.groups) {
      const group = scene.groups[link];
      let own = "var(--ink)";
      if (scene.driven.includes(link)) own = "var(--driver)";
      else if (byGroup && group >= 0) own = `var(--group-${group % 6})`;
      element.style.setProperty("--own", own);
    }
  }

  /** Draw for another scale or size of symbols. */
  zoom(scale, size) {
    const isSame = scale === this.scale && size === this.size;
    this.scale = scale;
    this.size = size;
    for (const part of isSame ? this.stale : this.redraw.keys()) this.redraw.get(part)(scale, size);
    this.stale.clear();
  }

  /** Move every link to its frame. */
  show(pose) {
    const { value } = pose;
    const texts = new Array(this.scene.links.length);
    for (const { link, element } of this.groups) {
      texts[link] ??= this.#transform(value, 3 * link);
      put(element, "transform", texts[link]);
    }
  }

  #transform(value, i) {
    const x = (value[i] * this.scale).toFixed(2);
    const y = (-value[i + 1] * this.scale).toFixed(2);
    return `translate(${x} ${y})rotate(${((-value[i + 2] * 180) / Math.PI).toFixed(3)})`;
  }

  /**
   * Return the lines of one position in px, for what must keep clear of them.
   * @returns {number[][][]}
   */
  lines(pose) {
    return this.scene.parts.filter((part) => part.disc === undefined).map((part) => this.line(part, pose));
  }

  /** Return the line of a part in px. */
  line(part, pose) {
    const i = 3 * part.link;
    const angle = pose.value[i + 2];
    const cosine = Math.cos(angle);
    const sine = Math.sin(angle);
    const x0 = pose.value[i] * this.scale;
    const y0 = -pose.value[i + 1] * this.scale;
    const points = placed(part.at, this.scale, this.size).map(([x, y]) => [
      x0 + cosine * x + sine * y,
      y0 - sine * x + cosine * y,
    ]);
    if (part.closed) points.push(points[0]);
    return points;
  }

  #make(part, group) {
    if (part.disc !== undefined) this.#disc(part, group);
    else if (part.hatching !== undefined) this.#hatching(part, group);
    else this.#stroke(part, group);
  }

  #colour(part) {
    return part.colour ? `var(--${part.colour})` : "var(--own)";
  }

  #disc(part, group) {
    const circle = svg("circle", { class: part.name.startsWith("joint") ? "joint" : "" });
    circle.style.stroke = part.width ? this.#colour(part) : "none";
    circle.style.fill = part.fill === "solid" ? this.#colour(part) : "var(--canvas)";
    group.append(circle);
    this.redraw.set(part, (scale, size) => {
      const [[x, y]] = placed(part.at, scale, size);
      put(circle, "cx", x.toFixed(2));
      put(circle, "cy", y.toFixed(2));
      put(circle, "r", (part.disc * size).toFixed(2));
      circle.style.strokeWidth = part.width * size;
    });
  }

  #hatching(part, group) {
    const path = this.#path(group, "none", this.#colour(part));
    this.redraw.set(part, (scale, size) => {
      const [start, end] = placed(part.at, scale, size);
      put(path, "d", pathOfStrokes(hatchedLine(start, end, part.hatching * size, HATCH_DEPTH * size)));
      path.style.strokeWidth = 1.1 * size;
    });
  }

  #stroke(part, group) {
    const colour = this.#colour(part);
    const width = part.width;
    const layers = [];
    // What lies on other parts hides them.
    if (part.fill === "canvas" || (part.fill === "tint" && part.floor > 1)) {
      layers.push(this.#path(group, "var(--canvas)", "none"));
    }
    if (part.fill === "tint" || part.fill === "solid") {
      const tint = this.#path(group, colour, "none");
      if (part.fill === "tint") tint.style.fillOpacity = "0.1";
      layers.push(tint);
    }
    const hatching = part.hatched ? this.#path(group, "none", colour) : null;
    if (hatching) hatching.style.strokeOpacity = "0.38";
    const outline = this.#path(group, "none", width ? colour : "none");
    layers.push(outline);
    this.redraw.set(part, (scale, size) => {
      const points = placed(part.at, scale, size);
      const d = pathOf(points, part.closed);
      for (const layer of layers) put(layer, "d", d);
      outline.style.strokeWidth = width * size;
      if (part.dashes) {
        outline.style.strokeDasharray = part.dashes.map((dash) => dash * size).join(" ");
        outline.style.strokeLinecap = "butt";
      }
      if (hatching) {
        put(hatching, "d", pathOfStrokes(hatchedArea(points, 9 * size)));
        hatching.style.strokeWidth = 0.8 * size;
      }
    });
  }

  #path(group, fill, stroke) {
    const path = svg("path");
    path.style.fill = fill;
    path.style.stroke = stroke;
    group.append(path);
    return path;
  }
}
