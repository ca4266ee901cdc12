// What a mechanism needs before it moves, ticked off. Pure.

import { allLinks, isCylinder, listOf, tableOf } from "../document/names.js";
import { slidesOf } from "../document/structure.js";
import { driversIn } from "./steps.js";

/** Return the moving links that no chain of pairs joins to the ground. */
export function linksApart(document) {
  const links = allLinks(document);
  // The two links of a slide, or of a cylinder.
  const pairs = Object.entries(tableOf(document.slides)).map(([name, own]) => {
    if (!isCylinder(own)) return [own?.link, own?.on ?? "ground"];
    return Object.keys(links).filter((link) => slidesOf(document, link).includes(name));
  });
  const reached = new Set(["ground"]);
  let before = 0;
  while (reached.size > before) {
    before = reached.size;
    for (const [link, joints] of Object.entries(links)) {
      const shares = (other) => listOf(links[other]).some((joint) => joints.includes(joint));
      const slides = (other) => pairs.some((pair) => pair.includes(link) && pair.includes(other));
      if (!reached.has(link) && [...reached].some((other) => shares(other) || slides(other))) reached.add(link);
    }
  }
  return Object.keys(links).filter((link) => !reached.has(link));
}

/** Return what is fixed: joints of the ground, slides on it. */
function fixedTo(document) {
  const slides = Object.entries(tableOf(document.slides));
  const onGround = slides.filter(([, own]) => !isCylinder(own) && (own?.on ?? "ground") === "ground");
  return [...listOf(tableOf(document.links).ground), ...onGround.map(([name]) => name)];
}

/** Whether anything is fixed to the ground. */
export const isOnGround = (document) => fixedTo(document).length > 0;

/**
 * Return the list: what is there, what is not, and details.
 * @param {Object} document
 * @param {Object} counted of `check`
 * @returns {{key: string, isDone: boolean, detail: {names?: string[], mobility?: number, needed?: number}}[]}
 */
export function checklist(document, counted) {
  const fixed = fixedTo(document);
  const drivers = driversIn(document).map((driver) => (typeof driver === "string" ? driver : driver.link));
  const apart = linksApart(document);
  const needed = Math.max(drivers.length, 1);
  const mobility = counted.mobility ?? 0;
  return [
    { key: "checkGround", isDone: fixed.length > 0, detail: { names: fixed } },
    { key: "checkDriver", isDone: drivers.length > 0, detail: { names: drivers } },
    { key: "checkJoined", isDone: apart.length === 0, detail: { names: apart } },
    { key: "checkMobility", isDone: mobility === needed, detail: { mobility, needed } },
  ];
}
