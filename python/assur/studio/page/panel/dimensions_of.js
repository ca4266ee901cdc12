// Dimensions of a document by their dotted names: how they are grouped, set, named, and what they are of.

import { allLinks, cylinderLinks, isCylinder, isTable, tableOf } from "../document/names.js";
import { withSection } from "../document/structure.js";

/** Groups in the order in which one reads them. */
const GROUPS = ["lengths", "pivots", "corners", "angles", "slides"];

/** Return the key of a dimension's group. */
export function groupOfDimension(name, document) {
  const parts = name.split(".");
  if (name.endsWith("angle")) return "angles";
  if (Object.hasOwn(tableOf(document.slides), parts[0])) return "slides";
  if (parts.length < 3) return "lengths";
  return parts[0] === "ground" ? "pivots" : "corners";
}

/**
 * Group dimensions; of each group they stay in their order.
 * @param {{name: string, value: number, unit: string}[]} dimensions
 * @param {Object} document
 * @returns {{key: string, dimensions: Object[]}[]} without empty groups
 */
export function groupDimensions(dimensions, document) {
  const of = (key) => dimensions.filter((one) => groupOfDimension(one.name, document) === key);
  return GROUPS.map((key) => ({ key, dimensions: of(key) })).filter((group) => group.dimensions.length);
}

/**
 * Return the parts of a dimension's label: its owner if the group does not say it, a joint, a word.
 * @returns {{owner: string, joint: string, word: string}} word: "x", "y", "angle", "offset" or ""
 */
export function dimensionLabel(name) {
  const [owner, ...rest] = name.split(".");
  if (owner === "ground") return { owner: "", joint: rest[0], word: rest[1] ?? "" };
  if (rest.length === 2) return { owner, joint: rest[0] === "origin" ? "" : rest[0], word: rest[1] };
  return { owner, joint: "", word: rest[0] === "length" ? "" : rest[0] };
}

/** Return the links and joints that a dimension is of. */
export function concernedBy(name, document) {
  const [owner, joint] = name.split(".");
  const slide = tableOf(document.slides)[owner];
  if (isTable(slide)) {
    const links = isCylinder(slide) ? Object.values(cylinderLinks(owner, slide)) : [slide.link, slide.on];
    return { links: links.filter((link) => link !== "ground"), joints: [] };
  }
  const joints = Object.hasOwn(tableOf(document.joints), joint) ? [joint] : [];
  const links = Object.hasOwn(allLinks(document), owner) && owner !== "ground" ? [owner] : [];
  return { links, joints };
}

/** Return the dimensions that a document gives, by dotted names; in files they may be nested. */
export function givenDimensions(document) {
  const flat = (table, prefix) =>
    Object.entries(tableOf(table)).flatMap(([key, value]) => {
      return isTable(value) ? flat(value, `${prefix}${key}.`) : [[prefix + key, value]];
    });
  return Object.fromEntries(flat(document.dimensions, ""));
}

/** Return the document with another value of a dimension; null: that of the drawing. */
export function withDimension(document, name, value) {
  const { [name]: _, ...others } = givenDimensions(document);
  return withSection(document, "dimensions", value === null ? others : { ...givenDimensions(document), [name]: value });
}
