// Edits of links: each takes a document and returns a new one.
//
// What changes the structure forgets `assembly` and `drawn`: see `redrawn` in structure.js.

import { withoutLoose } from "./joints.js";
import { allLinks, isTable, listOf, nameError, numberedName, takenNames, tableOf } from "./names.js";
import { withNames } from "./references.js";
import { restructured, slidesOf, withSection } from "./structure.js";

/** Return a name for a new link: crank for the first one on a fixed pivot, else link1, link2 … */
export function nameLink(document, joints) {
  const links = tableOf(document.links);
  const isFirst = Object.keys(links).every((name) => name === "ground");
  const isOnGround = joints.some((joint) => listOf(links.ground).includes(joint));
  if (isFirst && isOnGround && !takenNames(document).has("crank")) return "crank";
  return numberedName(document, "link");
}

/**
 * Add a link between joints.
 * @param {Object} document
 * @param {string[]} joints
 * @param {string} [name]
 */
export function addLink(document, joints, name = nameLink(document, joints)) {
  const known = [...new Set(joints)].filter((joint) => Object.hasOwn(tableOf(document.joints), joint));
  if (nameError(document, name) || (joints.length && !known.length)) return document;
  return restructured({ ...document, links: { ...tableOf(document.links), [name]: known } });
}

/** Rename a link everywhere, a cylinder's too; null if the name is not allowed: `nameError` says why. */
export function renameLink(document, from, to) {
  if (nameError(document, to, from)) return null;
  return withNames(document, { link: (name) => (name === from ? to : name) });
}

/**
 * Remove a link with all that named it: its slides, a whole cylinder, and those of its joints that
 * nothing else holds. The ground stays, without joints.
 */
export function removeLink(document, link) {
  const links = allLinks(document);
  if (!Object.hasOwn(links, link) || link === "ground") return document;
  const gone = slidesOf(document, link).map((name) => tableOf(document.slides)[name]);
  const ends = gone.flatMap((slide) => [slide.base, slide.end]);
  const left = restructured(withNames(document, { link: (name) => (name === link ? null : name) }));
  return withoutLoose(left, [...new Set([...links[link], ...ends])]);
}

/**
 * Set what drives: a link, a slide, `{ link, relative_to }`, or a list of them; null for nothing.
 * Of several motors the first stays if a single driver is left.
 */
export function setDriver(document, driver) {
  const own = Array.isArray(driver) && driver.length < 2 ? driver[0] : driver;
  // Another driver has a speed of its own, and perhaps another unit.
  const made = withSection(restructured(withSection(document, "driver", own)), "input_speed", null);
  const { motor } = document;
  if (!Array.isArray(motor) || Array.isArray(own)) return made;
  return withSection(made, "motor", motor.find((one) => isTable(one) && one.type !== "None"));
}
