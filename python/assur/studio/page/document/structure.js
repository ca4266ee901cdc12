// What all changes of the structure share: what a list of joints, a frame or a pose held is forgotten.
//
// An assembly and the place where it was found belong to one structure. `redrawn` first makes the
// drawing what is seen; then nothing jumps.

import { allLinks, cylinderLinks, isCylinder, isTable, listOf, tableOf } from "./names.js";

/** Return a table with an entry, or without it if the value is null or undefined. */
export function withEntry(table, name, value) {
  const { [name]: _, ...rest } = tableOf(table);
  if (value === null || value === undefined) return rest;
  return Object.hasOwn(tableOf(table), name) ? { ...table, [name]: value } : { ...rest, [name]: value };
}

/** Return the document with a section; an empty table or list is left out. */
export function withSection(document, key, value) {
  const isEmpty = value === null || value === undefined || (typeof value === "object" && !Object.keys(value).length);
  if (!isEmpty) return { ...document, [key]: value };
  const { [key]: _, ...rest } = document;
  return rest;
}

/** Return the document without what belongs to the structure before. */
export function restructured(document) {
  return withSection(withSection(document, "assembly", null), "drawn", null);
}

/** Return the document without the dimensions that a test picks by their dotted names. */
export function withoutDimensions(document, picks) {
  if (!document.dimensions) return document;
  const left = Object.entries(tableOf(document.dimensions)).filter(([name]) => !picks(name));
  return withSection(document, "dimensions", Object.fromEntries(left));
}

/** Return the document without the dimensions of a link and of the slides on it: its frame is another one. */
export function withoutFrame(document, link) {
  const owners = new Set([link, ...slidesOf(document, link)]);
  return withoutDimensions(document, (name) => owners.has(name.split(".")[0]));
}

/**
 * Return the document with other joints of a link. What the link had by a joint that it lost is
 * forgotten: a dimension, an origin, the place of its body; so is what lay in its frame, which is
 * fixed by the first two joints.
 */
export function withJoints(document, link, joints) {
  const before = listOf(tableOf(document.links)[link]);
  let made = restructured({ ...document, links: { ...tableOf(document.links), [link]: joints } });
  const isFrame = link !== "ground" && (before[0] !== joints[0] || before[1] !== joints[1]);
  if (isFrame && before.length > 1) made = withoutFrame(made, link);
  const lost = before.filter((joint) => !joints.includes(joint));
  if (!lost.length) return made;
  made = withoutDimensions(made, (name) => lost.some((joint) => name.startsWith(`${link}.${joint}.`)));
  const slides = Object.entries(tableOf(made.slides)).map(([name, own]) => {
    if (!isTable(own) || own.on !== link || !lost.includes(own.origin)) return [name, own];
    // Without an origin the value is 0 as drawn, which no length is.
    const { origin: _, length: __, ...rest } = own;
    return [name, rest];
  });
  if (slides.length) made = { ...made, slides: Object.fromEntries(slides) };
  const body = tableOf(made.bodies)[link];
  if (!isTable(body) || !lost.includes(body.at)) return made;
  const { at: _, ...rest } = body;
  return { ...made, bodies: { ...made.bodies, [link]: rest } };
}

/** Return the place of a joint in the drawing, or null. */
export function placeOf(document, joint) {
  const joints = tableOf(document.joints);
  const at = Object.hasOwn(joints, joint) ? joints[joint] : null;
  return Array.isArray(at) && at.length === 2 && at.every(Number.isFinite) ? at : null;
}

/** Return the direction of a slide's guide in the drawing, rad, or null. */
export function guideAngle(document, slide) {
  if (!isTable(slide)) return null;
  const [from, to] = isCylinder(slide) ? [slide.base, slide.end] : listOf(slide.along);
  const [a, b] = [placeOf(document, from), placeOf(document, to)];
  if (a && b) return Math.atan2(b[1] - a[1], b[0] - a[0]);
  return Number.isFinite(slide.angle) ? slide.angle : null;
}

/** Return how far the drawing reaches, m: the longer side of its frame. */
export function documentSize(document) {
  const places = Object.keys(tableOf(document.joints)).map((joint) => placeOf(document, joint)).filter(Boolean);
  const side = (axis) => Math.max(...places.map((at) => at[axis])) - Math.min(...places.map((at) => at[axis]));
  return places.length ? Math.max(side(0), side(1)) : 0;
}

/** Whether the drawing alone gives the dimensions and the assembly. */
export function isAsDrawn(document) {
  return !document.drawn && !document.assembly && !Object.keys(tableOf(document.dimensions)).length;
}

/**
 * Return the document drawn in a position that is known: then it needs no dimensions, no assembly
 * and no `drawn`, and changes of the structure begin from what is seen. Of dyads exactly in line
 * the side is lost. Where a slide has no origin, its value is zero there.
 * @param {Object} document
 * @param {Object<string, number[]>} places of all joints, m
 * @param {Object<string, number>} [angles] directions of the guides in the drawing's axes, rad
 */
export function redrawn(document, places, angles = {}) {
  const placed = ([name, at]) => [name, Object.hasOwn(places, name) ? [...places[name]] : at];
  const joints = Object.entries(tableOf(document.joints)).map(placed);
  const made = withSection(restructured(document), "dimensions", null);
  const slides = Object.entries(tableOf(document.slides)).map(([name, own]) => {
    if (!isTable(own) || isCylinder(own) || !Number.isFinite(angles[name])) return [name, own];
    const { along: _, ...rest } = own;
    return [name, { ...rest, angle: angles[name] }];
  });
  return withSection({ ...made, joints: Object.fromEntries(joints) }, "slides", Object.fromEntries(slides));
}

/** Return the document with a cylinder as two links and a slide, which can have more joints. */
export function withoutCylinder(document, name) {
  const own = tableOf(document.slides)[name];
  const angle = isCylinder(own) ? guideAngle(document, own) : null;
  if (angle === null) return document;
  const { barrel, rod } = cylinderLinks(name, own);
  const slide = { link: rod, on: barrel, angle, origin: own.base, length: true };
  const links = { ...tableOf(document.links), [barrel]: [own.base], [rod]: [own.end] };
  return { ...document, links, slides: { ...document.slides, [name]: slide } };
}

/** Return the names of the slides that a link is part of. */
export function slidesOf(document, link) {
  return Object.entries(tableOf(document.slides)).filter(([name, own]) => {
    if (!isTable(own)) return false;
    return isCylinder(own) ? Object.values(cylinderLinks(name, own)).includes(link) : [own.link, own.on].includes(link);
  }).map(([name]) => name);
}

/** Whether a link, a slide or a cylinder holds a joint. */
export function isHeld(document, joint) {
  const guides = Object.values(tableOf(document.slides)).map((own) => listOf(own?.along));
  return [...Object.values(allLinks(document)), ...guides].some((joints) => joints.includes(joint));
}
