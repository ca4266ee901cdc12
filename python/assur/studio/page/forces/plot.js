// The frame of a diagram: axes with their ticks, and places of numbers in it.

import { put, svg } from "../../../pictures/page/elements.js";
import { angleTicks, degrees, ticks, tickText } from "../../../pictures/page/numbers.js";

const PLOT_MARGIN = { right: 20, top: 12, bottom: 24 };
const PLOT_ROOM = 0.12;

/** Return the range of numbers with room about it. */
export function rangeOf(...lists) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) {
    for (const value of list) {
      if (!Number.isFinite(value)) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (!(high >= low)) return [-1, 1];
  const span = high - low || Math.abs(high) || 1;
  return [low - PLOT_ROOM * span, high + PLOT_ROOM * span];
}

/**
 * Make the frame.
 * @param {{width: number, height: number, xs: number[], ys: number[], isAngle: boolean}} options ranges of both
 * @returns {{x: (value: number) => number, y: (value: number) => number, nodes: SVGElement[], left: number,
 *   right: number, top: number, bottom: number}}
 */
export function plotFrame({ width, height, xs, ys, isAngle }) {
  const { right: aside, top, bottom: below } = PLOT_MARGIN;
  const right = width - aside;
  const bottom = height - below;
  const [low, high] = ys;
  const lines = ticks(low, high, Math.max(2, Math.floor((bottom - top) / 40)));
  const texts = lines.map((value) => tickText(Math.abs(value) < 1e-9 * (high - low) ? 0 : value));
  const left = Math.max(46, 16 + 6.6 * Math.max(...texts.map((text) => text.length)));
  const x = (value) => left + ((value - xs[0]) / (xs[1] - xs[0])) * (right - left);
  const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
  const nodes = lines.flatMap((value, i) => [
    svg("line", { class: texts[i] === "0" ? "grid zero" : "grid", x1: left, x2: right, y1: y(value), y2: y(value) }),
    svg("text", { class: "tick-y", x: left - 7, y: y(value) + 4 }, texts[i]),
  ]);
  nodes.push(svg("line", { class: "axis", x1: left, x2: right, y1: bottom, y2: bottom }));
  const count = Math.max(2, Math.floor((right - left) / (isAngle ? 48 : 56)));
  for (const place of isAngle ? angleTicks(...xs, count) : ticks(...xs, count)) {
    nodes.push(
      svg("line", { class: "axis", x1: x(place), x2: x(place), y1: bottom, y2: bottom + 4 }),
      svg("text", { class: "tick-x", x: x(place), y: bottom + 17 }, isAngle ? degrees(place, 0) : tickText(place)),
    );
  }
  return { x, y, nodes, left, right, top, bottom };
}

/** Let a cursor of a diagram be dragged: `seek` gets the place on its axis. */
export function dragCursor(picture, placeAt, seek) {
  const drag = (event) => {
    const place = placeAt(event.clientX - picture.getBoundingClientRect().left);
    if (place !== null) seek(place);
  };
  picture.addEventListener("pointerdown", (event) => {
    picture.setPointerCapture(event.pointerId);
    drag(event);
  });
  picture.addEventListener("pointermove", (event) => {
    if (picture.hasPointerCapture(event.pointerId)) drag(event);
  });
}

/** Put the point of a diagram, and its cursor, at a place, px. */
export function moveCursor(cursor, point, px, py) {
  const at = px.toFixed(2);
  if (cursor) for (const name of ["x1", "x2"]) put(cursor, name, at);
  put(point, "cx", at);
  put(point, "cy", Number.isFinite(py) ? py.toFixed(2) : "-99");
}
