// Edits of joints: each takes a document and returns a new one.
//
// What changes the structure forgets `assembly` and `drawn`: see `redrawn` in structure.js.

import { allLinks, listOf, nameError, nameJoint, tableOf } from "./names.js";
import { withNames } from "./references.js";
import { guideAngle, isHeld, restructured, slidesOf, withSection } from "./structure.js";
import { withJoints, withoutCylinder, withoutDimensions, withoutFrame } from "./structure.js";

/**
 * Add a joint that is on no link yet.
 * @param {Object} document
 * @param {number[]} at m
 * @param {string} [name]
 */
export function addJoint(document, at, name = nameJoint(document)) {
  if (nameError(document, name)) return document;
  return withSection({ ...document, joints: { ...tableOf(document.joints), [name]: [...at] } }, "drawn", null);
}

/** Rename a joint everywhere; null if the name is not allowed: `nameError` says why. */
export function renameJoint(document, from, to) {
  if (nameError(document, to, from)) return null;
  return withNames(document, { joint: (name) => (name === from ? to : name) });
}

/**
 * Make a joint a fixed pivot, or free it.
 * @param {Object} document
 * @param {string} joint
 * @param {boolean} isGround
 */
export function setGround(document, joint, isGround) {
  const links = tableOf(document.links);
  const before = listOf(links.ground);
  if (!Object.hasOwn(tableOf(document.joints), joint) || before.includes(joint) === isGround) return document;
  const ground = isGround ? [...before, joint] : before.filter((own) => own !== joint);
  // The ground is the first of the links.
  return withJoints({ ...document, links: { ground: before, ...links } }, "ground", ground);
}

/**
 * Move a joint in the drawing.
 *
 * Dimensions that are given hide the drawing, so those of its links are withoutFramesAt. That is for a
 * document which is still drawn: of one that moves, the server's `drag` finds the dimensions.
 */
export function moveJoint(document, joint, at) {
  if (!Object.hasOwn(tableOf(document.joints), joint)) return document;
  const moved = { ...document, joints: { ...document.joints, [joint]: [...at] } };
  const made = withoutFramesAt(withSection(moved, "drawn", null), joint);
  return withoutDimensions(made, (name) => name.startsWith(`ground.${joint}.`));
}

/** Forget the dimensions of the moving links with a joint. */
function withoutFramesAt(document, joint) {
  const links = Object.entries(allLinks(document)).filter(([, joints]) => joints.includes(joint)).map(([link]) => link);
  return links.filter((link) => link !== "ground").reduce(withoutFrame, document);
}

/**
 * Make two joints one, where `into` is: all that named `from` names `into`. A link never has it
 * twice; one that is left with a single joint stays.
 */
export function mergeJoints(document, from, into) {
  const joints = tableOf(document.joints);
  if (from === into || !Object.hasOwn(joints, from) || !Object.hasOwn(joints, into)) return document;
  const free = withoutFramesAt(withAngles(document, (along) => along.includes(from) && along.includes(into)), from);
  return restructured(withNames(free, { joint: (name) => (name === from ? into : name) }));
}

/** Slides along joints that a test picks keep their direction in the drawing as an angle. */
function withAngles(document, picks) {
  if (!document.slides) return document;
  const slides = Object.entries(tableOf(document.slides)).map(([name, own]) => {
    const angle = Array.isArray(own?.along) && picks(own.along) ? guideAngle(document, own) : null;
    if (angle === null) return [name, own];
    const { along: _, ...rest } = own;
    return [name, { ...rest, angle }];
  });
  return { ...document, slides: Object.fromEntries(slides) };
}

/** Make a joint one of a link too. A cylinder's barrel or rod becomes a link like others by that. */
export function joinToLink(document, joint, link) {
  const joints = allLinks(document)[link];
  if (!joints || joints.includes(joint) || !Object.hasOwn(tableOf(document.joints), joint)) return document;
  const isOwn = Object.hasOwn(tableOf(document.links), link);
  const made = isOwn ? document : withoutCylinder(document, slidesOf(document, link)[0]);
  return withJoints(made, link, [...joints, joint]);
}

/** Add a joint to a link: a further corner of a plate, a point whose path is drawn. */
export function addPlateJoint(document, link, at, name = nameJoint(document)) {
  if (!Object.hasOwn(allLinks(document), link) || nameError(document, name)) return document;
  return joinToLink(addJoint(document, at, name), name, link);
}

/** Remove a joint with all that named it, and links that are left with one joint or one slide alone. */
export function removeJoint(document, joint) {
  if (!Object.hasOwn(tableOf(document.joints), joint)) return document;
  const links = Object.entries(tableOf(document.links)).filter(([, joints]) => listOf(joints).includes(joint));
  const without = (made, [link, joints]) => withJoints(made, link, joints.filter((own) => own !== joint));
  const cut = links.reduce(without, withAngles(document, (along) => along.includes(joint)));
  const left = restructured(withNames(cut, { joint: (name) => (name === joint ? null : name) }));
  return withoutStubs(left, links.map(([link]) => link));
}

/** Remove those of some links that are stubs; their slides go with them, which may leave others as stubs. */
function withoutStubs(document, links) {
  const isOn = (link) => link !== "ground" && Object.hasOwn(tableOf(document.links), link) && isStub(document, link);
  const stubs = links.filter(isOn);
  if (!stubs.length) return document;
  const slides = stubs.flatMap((link) => slidesOf(document, link)).map((name) => document.slides[name]);
  const left = withNames(document, { link: (name) => (stubs.includes(name) ? null : name) });
  return withoutStubs(left, slides.flatMap((own) => [own.link, own.on]));
}

/** Whether a link has fewer than two joints and slides together. */
export function isStub(document, link) {
  return listOf(tableOf(document.links)[link]).length + slidesOf(document, link).length < 2;
}

/** Remove those of some joints that nothing holds any more. */
export function withoutLoose(document, joints) {
  const loose = joints.filter((joint) => Object.hasOwn(tableOf(document.joints), joint) && !isHeld(document, joint));
  return loose.length ? withNames(document, { joint: (name) => (loose.includes(name) ? null : name) }) : document;
}
