// A mechanism as lines through its joints: thumbnails, and light drawings over the picture.

import { svg } from "../../../pictures/page/elements.js";
import { cylinderLinks, isCylinder, isTable, listOf, tableOf } from "../document/names.js";
import { hullOf } from "../document/plane.js";
import { guideAngle } from "../document/structure.js";

/**
 * Return the moving links of a document as corners at given places of its joints.
 * @param {Object} document
 * @param {Object<string, number[]>} places m
 * @returns {{link: string, corners: number[][]}[]}
 */
export function skeleton(document, places) {
  const known = (joints) => joints.map((joint) => places[joint]).filter(Boolean);
  const links = Object.entries(tableOf(document.links)).filter(([link]) => link !== "ground");
  const found = links.map(([link, joints]) => ({ link, corners: hullOf(known(listOf(joints))) }));
  for (const [name, slide] of Object.entries(tableOf(document.slides))) {
    if (!isCylinder(slide)) continue;
    found.push({ link: cylinderLinks(name, slide).rod, corners: known([slide.base, slide.end]) });
  }
  return found.filter(({ corners }) => corners.length > 1);
}

/** Return blocks that slide on the ground: their joint, and the direction of their guide, rad. */
export function blocks(document, places) {
  return Object.values(tableOf(document.slides)).flatMap((slide) => {
    if (!isTable(slide) || isCylinder(slide) || slide.on !== "ground") return [];
    const joint = listOf(tableOf(document.links)[slide.link])[0];
    return places[joint] ? [{ at: places[joint], angle: guideAngle(document, slide) ?? 0 }] : [];
  });
}

const WIDTH = 132;
const HEIGHT = 78;
const EDGE = 13;

/**
 * Draw a small picture.
 * @param {Object} document
 * @param {Object<string, number[]>} places m
 * @param {{driven: Set<string>, groups: Map<string, number>}} options
 */
export function thumbnail(document, places, { driven, groups }) {
  const points = Object.values(places);
  const [xs, ys] = [0, 1].map((axis) => points.map((point) => point[axis]));
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const [across, up] = [Math.max(x1 - x0, 1e-12), Math.max(y1 - y0, 1e-12)];
  const scale = Math.min((WIDTH - 2 * EDGE) / across, (HEIGHT - 2 * EDGE) / up);
  const px = ([x, y]) => [WIDTH / 2 + (x - (x0 + x1) / 2) * scale, HEIGHT / 2 - (y - (y0 + y1) / 2) * scale];
  const text = (point) => point.map((own) => own.toFixed(1)).join(" ");
  const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "thumbnail", "aria-hidden": "true" });
  const ground = listOf(tableOf(document.links).ground).map((joint) => places[joint]).filter(Boolean);
  for (const [x, y] of ground.map(px)) {
    const d = `M${x} ${y}l-5 7h10zm-7 7h14m-11 0l-2.5 3m6 -3l-2.5 3m6 -3l-2.5 3`;
    picture.append(svg("path", { class: "pivot", d }));
  }
  for (const { link, corners } of skeleton(document, places)) {
    const d = `M${corners.map((point) => text(px(point))).join("L")}${corners.length > 2 ? "Z" : ""}`;
    const kinds = ["own-link", ...(corners.length > 2 ? ["plate"] : []), ...(driven.has(link) ? ["driven"] : [])];
    const path = svg("path", { class: kinds.join(" "), d });
    path.style.setProperty("--own", groupColour(groups.get(link)));
    picture.append(path);
  }
  for (const { at, angle } of blocks(document, places)) {
    const [x, y] = px(at);
    const transform = `translate(${x} ${y})rotate(${(-angle * 180) / Math.PI})`;
    picture.append(svg("rect", { class: "block", x: -6, y: -4, width: 12, height: 8, transform }));
  }
  for (const point of Object.values(places)) {
    const [x, y] = px(point);
    picture.append(svg("circle", { class: "pin", cx: x.toFixed(1), cy: y.toFixed(1), r: 2 }));
  }
  return picture;
}

/** Return the colour of a group of links. */
export function groupColour(group) {
  return group === undefined || group < 0 ? "var(--ink)" : `var(--group-${group % 6})`;
}
