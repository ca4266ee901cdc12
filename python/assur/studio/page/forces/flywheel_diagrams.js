// Diagrams of a flywheel in the place of the others: speed with its band, surplus moment, Wittenbauer's.

import { hatchedArea, pathOf } from "../../../pictures/page/draw.js";
import { html, svg } from "../../../pictures/page/elements.js";
import { degrees, digits, forceUnit } from "../../../pictures/page/numbers.js";
import { button } from "../../../pictures/page/panel.js";
import { say } from "../../../pictures/page/words.js";
import { Along } from "./along.js";
import { dragCursor, moveCursor, plotFrame, rangeOf } from "./plot.js";
import { surplusAreas, tangentsOf } from "./surplus.js";

const KINDS = ["speed", "surplus", "wittenbauer"];
const HATCH = 9;

export class FlywheelDiagrams {
  /** @param {{seek: (q: number) => void, close: () => void}} on */
  constructor({ seek, close }) {
    this.seek = seek;
    this.plots = KINDS.map((kind) => {
      const value = html("output", { class: "value" });
      const note = html("span", { class: "note" });
      const picture = svg("svg", { class: "plot", "aria-hidden": "true" });
      const head = html("div", { class: "chart-head" }, html("b", {}, say(`diagram_${kind}`)), note, value);
      const element = html("div", { class: "chart", "data-diagram": kind }, head, picture);
      dragCursor(picture, (px) => this.#placeAt(kind, px), (q) => this.seek(q));
      return { kind, value, note, picture, element };
    });
    const leave = button(say("closeDiagrams"), "M6 6l12 12M18 6L6 18");
    leave.addEventListener("click", close);
    leave.classList.add("close-diagrams");
    this.element = html("div", { class: "charts flywheel-charts" }, ...this.plots.map((plot) => plot.element), leave);
    this.observer = new ResizeObserver(() => this.draw());
    this.observer.observe(this.element);
  }

  /**
   * Show a flywheel, and if known the speed without it.
   * @param {{header: Object, arrays: Object<string, Float64Array>}} flywheel
   * @param {{header: Object, arrays: Object<string, Float64Array>} | null} without
   */
  take(flywheel, without) {
    const { header, arrays } = flywheel;
    Object.assign(this, { header, arrays, without });
    this.along = new Along(arrays.q, true);
    const { name, factor } = (this.momentUnit = forceUnit(
      "N·m", arrays.moment.reduce((most, own) => Math.max(most, Math.abs(own)), 0),
    ));
    this.surplus = Array.from(arrays.moment, (own) => (own + header.motor_moment) * factor);
    this.energyUnit = forceUnit("J", arrays.work.reduce((most, own) => Math.max(most, Math.abs(own)), 0));
    const notes = ["rad/s", name, this.energyUnit.name];
    const titles = ["rad/s", `${name}, ${say("motorAndLoads")}`, say("energyOver", { unit: this.energyUnit.name })];
    this.plots.forEach((plot, i) => {
      plot.note.textContent = notes[i];
      plot.note.title = titles[i];
    });
    this.draw();
  }

  #placeAt(kind, px) {
    const frame = this.plots.find((plot) => plot.kind === kind).frame;
    if (!frame || kind === "wittenbauer") return null;
    const { q } = this.arrays;
    const part = Math.min(Math.max((px - frame.left) / (frame.right - frame.left), 0), 1 - 1e-9);
    return q[0] + part * (q[q.length - 1] - q[0]);
  }

  draw() {
    if (!this.header) return;
    for (const plot of this.plots) {
      const { clientWidth: width, clientHeight: height } = plot.picture;
      if (width < 120 || height < 80) continue;
      const nodes = {
        speed: () => this.#speed(plot, width, height),
        surplus: () => this.#surplus(plot, width, height),
        wittenbauer: () => this.#wittenbauer(plot, width, height),
      }[plot.kind]();
      const { frame } = plot;
      const cursor = svg("line", { class: "cursor", y1: frame.top - 6, y2: frame.bottom });
      plot.cursor = plot.kind === "wittenbauer" ? null : cursor;
      plot.point = svg("circle", { class: "point", r: 4.2 });
      plot.picture.replaceChildren(...frame.nodes, ...nodes, ...(plot.cursor ? [plot.cursor] : []), plot.point);
    }
    if (this.pose) this.show(this.pose);
  }

  #overTurn(width, height, ys) {
    const { q } = this.arrays;
    return plotFrame({ width, height, xs: [q[0], q[q.length - 1]], ys, isAngle: true });
  }

  #speed(plot, width, height) {
    const { header, arrays, without } = this;
    const other = without?.arrays;
    const frame = (plot.frame = this.#overTurn(width, height, rangeOf(arrays.speed, other?.speed ?? [])));
    const { x, y, left, right } = frame;
    const { max, min } = header;
    const band = Math.max(y(min.value) - y(max.value), 1);
    const nodes = [svg("rect", { class: "band", x: left, width: right - left, y: y(max.value), height: band })];
    if (other) nodes.push(svg(
      "path", { class: "curve without", d: pathOf(curveOf(other.q, other.speed, x, y, arrays.q)) },
    ));
    nodes.push(svg("path", { class: "curve with", d: pathOf(curveOf(arrays.q, arrays.speed, x, y)) }));
    nodes.push(svg(
      "text",
      { class: "plot-note driver-text start", x: left + 8, y: y(min.value) - 7 },
      `δ = ${digits(header.delta)}`,
    ));
    for (const [own, below] of [[max, false], [min, true]]) nodes.push(...marked(
      frame, own.q, own.value, digits(own.value, 4), below,
    ));
    return nodes;
  }

  #surplus(plot, width, height) {
    const { arrays, surplus } = this;
    const frame = (plot.frame = this.#overTurn(width, height, rangeOf(surplus, [0])));
    const { x, y } = frame;
    const nodes = surplusAreas(arrays.q, surplus).flatMap(({ isLeft, points }) => {
      const corners = points.map(([q, value]) => [x(q), y(value)]);
      const area = svg("path", { class: isLeft ? "area-left" : "area-wanting", d: pathOf(corners, true) });
      if (isLeft) return [area];
      return [area, svg("path", { class: "area-strokes", d: strokesWithin(corners) })];
    });
    nodes.push(svg("path", { class: "curve ink", d: pathOf(curveOf(arrays.q, surplus, x, y)) }));
    return nodes;
  }

  #wittenbauer(plot, width, height) {
    const { header, arrays, energyUnit } = this;
    const rows = arrays.q.length;
    const inertia = Array.from({ length: rows }, (_, i) => arrays.diagram[2 * i]);
    const energy = Array.from({ length: rows }, (_, i) => arrays.diagram[2 * i + 1] * energyUnit.factor);
    const xs = rangeOf(inertia);
    const tangents = tangentsOf(header);
    const on = ({ slope }, place) => (tangents.meet[1] + slope * (place - tangents.meet[0])) * energyUnit.factor;
    const ys = rangeOf(energy, ...tangents.lines.map((line) => xs.map((place) => on(line, place))));
    const frame = (plot.frame = plotFrame({ width, height, xs, ys, isAngle: false }));
    const { x, y, left, right, bottom } = frame;
    plot.at = (q) => this.along.at(arrays.diagram, q, 2, 0, 2).map((own, i) => (i ? own * energyUnit.factor : own));
    const nodes = [svg("path", { class: "curve ink", d: pathOf(inertia.map((own, i) => [x(own), y(energy[i])])) })];
    for (const line of tangents.lines) {
      nodes.push(svg(
        "line", { class: `tangent ${line.key}`, x1: left, x2: right, y1: y(on(line, xs[0])), y2: y(on(line, xs[1])) },
      ));
      nodes.push(slopeNote(frame, line, (part) => xs[0] + part * (xs[1] - xs[0]), on));
      const [atI, atE] = plot.at(header[line.key].q);
      nodes.push(svg("circle", { class: `mark ${line.key}`, cx: x(atI), cy: y(atE), r: 3.6 }));
    }
    const energyThere = `${digits(tangents.meet[1] * energyUnit.factor)} ${energyUnit.name}`;
    const where = `I = ${digits(tangents.meet[0])} kg·m², E = ${energyThere}`;
    for (const [text, up] of [[say("tangentsMeet"), 22], [where, 8]]) nodes.push(svg(
      "text", { class: "plot-note second end", x: right, y: bottom - up }, text,
    ));
    return nodes;
  }

  /** Move the cursor. */
  show(pose) {
    this.pose = pose;
    if (!this.header) return;
    const { q, speed } = this.arrays;
    const span = q[q.length - 1] - q[0];
    const place = q[0] + ((((pose.q - q[0]) % span) + span) % span);
    for (const { kind, frame, cursor, point, value, at } of this.plots) {
      if (!frame || !point) continue;
      if (kind === "wittenbauer") {
        const [inertia, energy] = at(place);
        moveCursor(null, point, frame.x(inertia), frame.y(energy));
        value.textContent = degrees(place, 0);
        continue;
      }
      const [own] = this.along.at(kind === "speed" ? speed : this.surplus, place);
      moveCursor(cursor, point, frame.x(place), frame.y(own));
      value.textContent = kind === "speed" ? digits(own, 4) : digits(own);
    }
  }
}

/** Write the slope of a tangent beside it: above that of the greatest speed, below that of the least. */
function slopeNote({ x, y }, line, at, on) {
  const isGreatest = line.key === "max";
  const place = at(isGreatest ? 0.86 : 0.24);
  const [px, py] = [x(place), y(on(line, place))];
  const text = say("slope", { which: isGreatest ? "max" : "min" });
  return svg(
    "text",
    {
      class: `plot-note ${isGreatest ? "end" : "start"}`,
      x: px + (isGreatest ? -10 : 12),
      y: py + (isGreatest ? -6 : 16),
    },
    text,
  );
}

/** Return a curve, px; of places that go on beyond the axis what lies on it. */
function curveOf(places, values, x, y, axis = places) {
  const [low, high] = [axis[0], axis[axis.length - 1]];
  const span = high - low;
  // Of another period that begins elsewhere the rows are brought to the axis.
  const rows = Array.from(
    places, (place, i) => [axis === places ? place : low + ((((place - low) % span) + span) % span), values[i]],
  );
  if (axis !== places) rows.sort((a, b) => a[0] - b[0]);
  return rows.filter(([, value]) => Number.isFinite(value)).map(([place, value]) => [x(place), y(value)]);
}

/** Return a ring at a place with its number. */
function marked({ x, y, left, right }, place, value, text, isBelow) {
  const px = Math.min(Math.max(x(place), left + 22), right - 14);
  return [
    svg("circle", { class: "mark with", cx: x(place), cy: y(value), r: 3.6 }),
    svg("text", { class: "extreme", x: px, y: y(value) + (isBelow ? 18 : -9) }, text),
  ];
}

/** Return strokes that fill an area between a curve and the axis, which need not be convex. */
function strokesWithin(corners) {
  const xs = corners.map(([x]) => x);
  const ys = corners.map(([, y]) => y);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  if (!(x1 - x0 > 1 && y1 - y0 > 1)) return "";
  const box = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
  return hatchedArea(box, HATCH).flatMap((stroke) => cutByArea(stroke, corners)).map((own) => pathOf(own)).join("");
}

/** Cut a stroke to what lies inside a polygon: between every other crossing. */
function cutByArea([[ax, ay], [bx, by]], corners) {
  const at = [];
  corners.forEach(([px, py], i) => {
    const [qx, qy] = corners[(i + 1) % corners.length];
    const side = (x, y) => (bx - ax) * (y - ay) - (by - ay) * (x - ax);
    const [d0, d1] = [side(px, py), side(qx, qy)];
    if (d0 < 0 === d1 < 0) return;
    const t = d0 / (d0 - d1);
    const [x, y] = [px + t * (qx - px), py + t * (qy - py)];
    at.push(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2));
  });
  at.sort((a, b) => a - b);
  const place = (t) => [ax + t * (bx - ax), ay + t * (by - ay)];
  const cuts = [];
  for (let i = 0; i + 1 < at.length; i += 2) cuts.push([place(at[i]), place(at[i + 1])]);
  return cuts;
}
