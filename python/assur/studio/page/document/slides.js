// Edits of slides and cylinders: each takes a document and returns a new one.
//
// What changes the structure forgets `assembly` and `drawn`: see `redrawn` in structure.js.

import { isStub, withoutLoose } from "./joints.js";
import { allLinks, CYLINDER_PARTS, cylinderLinks, isCylinder, tableOf, takenNames } from "./names.js";
import { nameError, numberedName } from "./names.js";
import { withNames } from "./references.js";
import { placeOf, restructured, withEntry, withoutDimensions } from "./structure.js";

/**
 * Add a sliding pair: of a link, or of a joint, which gets a block of its own.
 * @param {Object} document
 * @param {{link?: string, joint?: string, on?: string, angle?: number, along?: string[],
 *   origin?: string, name?: string}} slide the guide lies on the ground by default, along x
 */
export function addSlide(document, { link, joint, on = "ground", angle = 0, along, origin, name }) {
  const own = name ?? numberedName(document, "slide");
  const links = allLinks(document);
  if (nameError(document, own) || (on !== "ground" && !Object.hasOwn(links, on))) return document;
  const ground = tableOf(document.links).ground ?? [];
  let made = { ...document, links: { ground, ...tableOf(document.links) } };
  let block = link;
  if (joint !== undefined) {
    if (!Object.hasOwn(tableOf(document.joints), joint)) return document;
    block = numberedName(document, "block");
    made = { ...made, links: { ...made.links, [block]: [joint] } };
  } else if (!Object.hasOwn(links, link ?? "")) {
    return document;
  }
  if (block === on) return document;
  const slide = { link: block, on, ...(along ? { along: [...along] } : { angle }) };
  // The value is measured from a joint of the guide's link; without one from the drawing.
  if (origin !== undefined && (allLinks(made)[on] ?? []).includes(origin)) slide.origin = origin;
  return restructured({ ...made, slides: { ...tableOf(document.slides), [own]: slide } });
}

/** Add a cylinder between two joints that are not in one place. */
export function addCylinder(document, base, end, name = numberedName(document, "cylinder")) {
  const [a, b] = [placeOf(document, base), placeOf(document, end)];
  const isLong = a && b && (a[0] !== b[0] || a[1] !== b[1]);
  const parts = Object.values(cylinderLinks(name, {}));
  if (!isLong || [name, ...parts].some((own) => nameError(document, own))) return document;
  return restructured({ ...document, slides: { ...tableOf(document.slides), [name]: { base, end } } });
}

/**
 * Rename a slide everywhere, and the links that a cylinder named by itself; null if the name is
 * not allowed: `nameError` says why, also of such a link, `slideNameError`.
 */
export function renameSlide(document, from, to) {
  if (slideNameError(document, to, from)) return null;
  return withNames(document, { slide: (name) => (name === from ? to : name) });
}

/** Return what is wrong with a new name of a slide: see `nameError`. */
export function slideNameError(document, name, from) {
  const error = nameError(document, name, from);
  const own = tableOf(document.slides)[from];
  if (error || name === from || !isCylinder(own)) return error;
  const taken = takenNames(document);
  const endings = Object.entries(CYLINDER_PARTS).filter(([part]) => own[part] === undefined);
  const other = endings.map(([, ending]) => `${name}${ending}`).find((link) => taken.has(link));
  return other === undefined ? null : { error: "takenName", values: { name: other } };
}

/** Change a slide's guide: `on`, `angle` or `along`, `origin`; null takes an origin away. */
export function setSlide(document, name, fields) {
  const before = tableOf(document.slides)[name];
  if (!before || isCylinder(before)) return document;
  let own = { ...before };
  for (const [key, value] of Object.entries(fields)) own = withEntry(own, key, value);
  if (fields.angle !== undefined) delete own.along;
  else if (fields.along !== undefined) delete own.angle;
  // Without an origin the value is 0 as drawn, which no length is.
  if (own.origin === undefined) delete own.length;
  const made = withoutDimensions(document, (dimension) => dimension.startsWith(`${name}.`));
  return restructured({ ...made, slides: { ...document.slides, [name]: own } });
}

/**
 * Remove a slide with all that named it. Of a cylinder its two links go too, of others a block
 * that has nothing left but a joint; joints that nothing else holds go with them.
 */
export function removeSlide(document, name) {
  const own = tableOf(document.slides)[name];
  if (!own) return document;
  const joints = isCylinder(own) ? [own.base, own.end] : (allLinks(document)[own.link] ?? []);
  let left = withNames(document, { slide: (slide) => (slide === name ? null : slide) });
  if (!isCylinder(own) && own.link !== "ground" && isStub(left, own.link)) {
    left = withNames(left, { link: (link) => (link === own.link ? null : link) });
  }
  return withoutLoose(restructured(left), joints);
}
