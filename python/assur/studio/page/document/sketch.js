// The scene of a document that does not move yet, or is half drawn: what `payload` is of one that
// moves. All frames are the drawing's, so every part is where it is drawn.

import { allLinks, cylinderLinks, isCylinder, isTable, listOf, tableOf } from "./names.js";
import { slideParts } from "./guides.js";
import { crossing, extentOf, unitVector } from "./plane.js";
import { guideAngle, placeOf } from "./structure.js";
import { jointPart, linkParts, pivotParts, SIZES, turningArrow } from "./symbols.js";

/** The frame of an empty drawing, m: what is drawn first is of a hand's size. */
const EMPTY_SIZE = 0.2;

/**
 * Return the scene of a document, in the form of a `payload`. What is half finished is left out:
 * nothing throws.
 * @param {Object} document
 * @param {Object<string, number[]>} [places] of joints, where they are not as in the drawing
 */
export function sketchScene(document, places = {}) {
  const own = { ...tableOf(document), joints: { ...tableOf(document?.joints), ...places } };
  const placed = Object.keys(own.joints).map((joint) => [joint, placeOf(own, joint)]);
  const at = Object.fromEntries(placed.filter(([, place]) => place));
  const there = (joints) => [...new Set(joints)].filter((joint) => Object.hasOwn(at, joint));
  const given = Object.entries(allLinks(own)).map(([link, joints]) => [link, there(joints)]);
  const links = new Map([["ground", []], ...given]);
  const names = [...links.keys()];
  const index = new Map(names.map((name, i) => [name, i]));
  const size = extentOf(Object.values(at)) || EMPTY_SIZE;
  const drivers = driversOf(own, index);
  const driven = new Set(drivers.turning.map(({ link }) => link));
  const placesOf = (link) => links.get(link).map((joint) => at[joint]);
  const pairs = pairsOf(own, { at, links, index, drivers, driven, placesOf });
  const sliding = pairs.map((pair) => slideParts(pair, size, placesOf("ground")));
  const body = (link) => linkParts(index.get(link), link, placesOf(link), driven.has(link));
  const lines = [...names.slice(1).flatMap(body), ...sliding.flatMap(({ parts }) => parts)];
  const turning = drivers.turning.flatMap((drive) => arrowOf(drive, { at, links, index, pairs }));
  const arrows = [...turning, ...sliding.flatMap((one) => one.arrows)];
  const marked = (slide) => [slide?.origin, ...listOf(slide?.along)];
  const marks = new Set(Object.values(tableOf(own.slides)).flatMap(marked));
  const joints = Object.keys(at).map((joint) => jointEntry(joint, { at, links, index, pairs }));
  // A fixed joint that only a slide is measured from is no pivot.
  const isPivot = ({ name, links: on }) => on.includes(0) && (on.length > 1 || !marks.has(name));
  const parts = [
    // Plates lie under bars, guides under blocks, everything under the joints.
    ...lines.sort((a, b) => (a.floor ?? 1) - (b.floor ?? 1)),
    ...joints.filter(isPivot).flatMap(({ name }) => pivotParts(name, at[name])),
    ...arrows,
    ...joints.map((one) => jointPart(one.name, one.link, at[one.name], one.links.length, isPivot(one))),
  ];
  return {
    ...{ title: "", formula: [], driver: drivers.text, links: names, classes: [], paths: [], diagrams: [] },
    driven: names.flatMap((name, i) => (driven.has(name) ? [i] : [])),
    groups: names.map(() => -1),
    joints,
    slides: pairs.map((pair) => slideEntry(pair, own, at)),
    parts,
    bounds: boundsOf(parts),
    usual: usualLength(names.slice(1).map(placesOf)) || size,
    speed: 1,
    turn: stillTurn(names.length - 1),
  };
}

/** A turn of two rows that are the same: every link stays in the drawing's frame. */
function stillTurn(moving) {
  const values = new Float64Array(2 * 2 * 3 * moving);
  const grid = { kind: "linear", low: 0, high: 1 };
  return { grid, closes: false, unit: "angle", at: 0, dead: [], orders: 2, rows: 2, ground: [0, 0, 0], values };
}

/** Return the driven angles and slides of a document that are there. */
function driversOf(document, index) {
  const given = Array.isArray(document.driver) ? document.driver : [document.driver];
  const all = given.filter((one) => typeof one === "string" || isTable(one));
  const slides = all.filter((one) => typeof one === "string" && Object.hasOwn(tableOf(document.slides), one));
  const drive = (one) => ({ relative_to: "ground", ...(isTable(one) ? one : { link: one }) });
  const angles = all.filter((one) => !slides.includes(one)).map(drive);
  const turning = angles.filter(({ link }) => index.has(link) && link !== "ground");
  const text = all.map((one) => (isTable(one) ? `${one.link} − ${drive(one).relative_to}` : one)).join(", ");
  return { turning, slides: new Set(slides), text };
}

/** Draw the arrow of a driven angle: about the joint of both links if they share one. */
function arrowOf({ link, relative_to: other }, { at, links, index, pairs }) {
  const own = links.get(link);
  const pivot = own.find((joint) => links.get(other)?.includes(joint)) ?? own[0];
  if (pivot === undefined) return [];
  const arms = own.map((joint) => [at[joint][0] - at[pivot][0], at[joint][1] - at[pivot][1]]);
  const longest = arms.reduce((best, arm) => (Math.hypot(...arm) > Math.hypot(...best) ? arm : best));
  // A link of one joint lies along its guide.
  const guide = pairs.find(({ slidingName, guideName }) => [slidingName, guideName].includes(link))?.angle ?? 0;
  return turningArrow(index.get(link), at[pivot], Math.hypot(...longest) ? Math.atan2(longest[1], longest[0]) : guide);
}

/**
 * Return the sliding pairs whose links are there and whose guide has a direction.
 * @returns {import("./guides.js").Pair[]}
 */
function pairsOf(document, { at, links, index, drivers, driven, placesOf }) {
  const given = Object.entries(tableOf(document.slides)).map(([name, own]) => {
    const parts = isCylinder(own) ? cylinderLinks(name, own) : { rod: own?.link, barrel: own?.on };
    const origin = isCylinder(own) ? own.base : own?.origin;
    return { name, link: parts.rod, on: parts.barrel, origin, angle: guideAngle(document, own) };
  });
  const isWhole = ({ link, on, angle }) => angle !== null && link !== on && index.has(link) && index.has(on);
  const whole = given.filter(isWhole);
  const placeIn = (link) => placesOf(link)[0] ?? referencePoint(link, whole, links, at);
  return whole.map(({ name, link, on, angle }) => {
    const others = whole.filter((one) => one.name !== name);
    const touches = (one) => [one.link, one.on].some((own) => own === link || own === on);
    return {
      ...{ name, angle, sliding: index.get(link), guide: index.get(on), slidingName: link, guideName: on },
      slidingJoints: placesOf(link),
      guideJoints: placesOf(on),
      block: placeIn(link),
      carrier: placeIn(on),
      isAlone: !others.some(touches) && !driven.has(link) && !driven.has(on),
      isDriven: drivers.slides.has(name),
      isGuideDriven: driven.has(on),
    };
  });
}

/** Return where a link without joints is: where its guides cross, or at the origin of one. */
function referencePoint(link, pairs, links, at) {
  const lines = pairs.filter((pair) => pair.link === link || pair.on === link).map((pair) => {
    const other = pair.link === link ? pair.on : pair.link;
    const joint = pair.link === link && Object.hasOwn(at, pair.origin ?? "") ? pair.origin : links.get(other)[0];
    return [at[joint], unitVector(pair.angle)];
  });
  const placed = lines.filter(([point]) => point);
  const crossings = placed.slice(1).map((line) => crossing(placed[0], line)).filter(Boolean);
  return crossings[0] ?? placed[0]?.[0] ?? Object.values(at)[0] ?? [0, 0];
}

function jointEntry(joint, { at, links, index, pairs }) {
  const on = [...links].filter(([, joints]) => joints.includes(joint)).map(([link]) => index.get(link));
  const [x, y] = at[joint];
  // A block about the joint keeps its name farther away.
  const isInBlock = pairs.some(({ block }) => block[0] === x && block[1] === y);
  const radius = isInBlock ? SIZES.BLOCK_LENGTH / 2 : SIZES.PIVOT;
  return { name: joint, link: on[0] ?? 0, links: on, at: [x, y], radius };
}

function slideEntry({ name, sliding, guide, block, angle }, document, at) {
  const { origin, base } = document.slides[name];
  const from = at[origin ?? base] ?? block;
  return { name, link: sliding, on: guide, at: block, origin: from, angle, offset: 0 };
}

/** Return the frame of all parts; it is never without size. */
function boundsOf(parts) {
  const points = parts.flatMap(({ at }) => Array.from({ length: at.length / 4 }, (_, i) => [at[4 * i], at[4 * i + 1]]));
  if (!points.length) return [0, 0, EMPTY_SIZE, EMPTY_SIZE];
  const [x, y] = [0, 1].map((axis) => points.map((point) => point[axis]));
  const pad = extentOf(points) ? 0 : EMPTY_SIZE / 2;
  return [Math.min(...x) - pad, Math.min(...y) - pad, Math.max(...x) + pad, Math.max(...y) + pad];
}

/** Return the median distance of two joints of a link, m. */
function usualLength(links) {
  const distances = (points, a, i) => points.slice(0, i).map((b) => Math.hypot(a[0] - b[0], a[1] - b[1]));
  const lengths = links.flatMap((points) => points.flatMap((a, i) => distances(points, a, i)));
  const sorted = lengths.filter((length) => length > 0).sort((a, b) => a - b);
  const half = sorted.length >> 1;
  return sorted.length ? (sorted[half] + sorted[(sorted.length - 1) >> 1]) / 2 : 0;
}
