// The document drawn as it is seen, so that nothing jumps when its structure changes.

import { isCylinder, tableOf } from "../document/names.js";
import { isAsDrawn, redrawn } from "../document/structure.js";

/** The drawing's coordinate and the present one are the same within this. */
const SAME_Q = 1e-12;

/** Whether a mechanism that moves is where it is drawn. */
function isAtDrawing({ document, driverCount, q, checked }) {
  return isAsDrawn(document) && driverCount === 1 && Math.abs(q - checked.q0) < SAME_Q;
}

/**
 * Return the document of a model, drawn in the position that is shown.
 * @param {import("../model/model.js").Model} model
 */
export async function asSeen(model) {
  const { document } = model;
  if (model.isSketch || !model.moves || isAtDrawing(model)) return document;
  try {
    const { header } = await model.ask("position", { q: model.place });
    const places = Object.fromEntries(Object.entries(header.joints).map(([joint, { value }]) => [joint, value]));
    const slides = Object.entries(tableOf(document.slides)).filter(([, own]) => !isCylinder(own));
    const angles = slides.map(([name, { on }]) => {
      const own = model.dimensions.find((one) => one.name === `${name}.angle`)?.value ?? 0;
      return [name, header.links[on ?? "ground"].value + own];
    });
    return redrawn(document, places, Object.fromEntries(angles));
  } catch {
    // It is not known where it is: then as it was drawn.
    return document;
  }
}
