// Edits of dimensions, masses, loads, friction and the motor: each takes a document and returns a new one.

import { isTable, listOf, tableOf } from "./names.js";
import { withEntry, withSection } from "./structure.js";

/** Set a dimension by its dotted name, `"coupler.length"`; m or rad. */
export function setDimension(document, name, value) {
  return withDimensionTable(document, withEntry(document.dimensions, name, value));
}

/** Let the drawing give a dimension. */
export function clearDimension(document, name) {
  return withDimensionTable(document, withEntry(document.dimensions, name, null));
}

/** Where an assembly was found belongs to the dimensions that it was found with. */
function withDimensionTable(document, dimensions) {
  const made = withSection(document, "dimensions", dimensions);
  if (!isTable(document.drawn) || document.drawn.dimensions) return made;
  return { ...made, drawn: { ...document.drawn, dimensions: { ...tableOf(document.dimensions) } } };
}

/**
 * Set the body of a link, or take it away.
 * @param {Object} document
 * @param {string} link
 * @param {{mass?: number, inertia?: number, at?: string | number[]} | null} fields
 */
export function setBody(document, link, fields) {
  return withSection(document, "bodies", withEntry(document.bodies, link, fields));
}

/** Set the friction of a joint or a slide, or take it away. */
export function setFriction(document, name, fields) {
  return withSection(document, "friction", withEntry(document.friction, name, fields));
}

/** Add a load: `{ type: "Force", at, force }` and so on. */
export function addLoad(document, load) {
  return withSection(document, "loads", [...listOf(document.loads), load]);
}

/** Put another load in the place of one. */
export function setLoad(document, i, load) {
  return withSection(document, "loads", listOf(document.loads).map((own, k) => (k === i ? load : own)));
}

/** Remove a load. */
export function removeLoad(document, i) {
  return withSection(document, "loads", listOf(document.loads).filter((_, k) => k !== i));
}

/** Set the motor: of several drivers a list; null for none. */
export function setMotor(document, motor) {
  return withSection(document, "motor", motor);
}
