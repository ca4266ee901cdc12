// What one chose in the sections of design: it outlives a change of language.

/**
 * @typedef {Object} Choices
 * @property {string[] | null} sliders dimensions that have one; null: the two usual ones
 * @property {string} across dimension along the map's lower side
 * @property {string} up dimension along its left side
 * @property {string} metric which metric the map shows
 * @property {string} point the joint whose path is compared with the target
 * @property {Object} [found] what is wanted of which dimension
 * @property {string} number the quantity in large digits
 */

/** @type {WeakMap<Object, Choices>} */
const CHOICES = new WeakMap();

/**
 * Return what one chose for a document's window.
 * @param {import("../model/model.js").Model} model
 * @returns {Choices}
 */
export function designChoices(model) {
  if (!CHOICES.has(model)) {
    CHOICES.set(model, { sliders: null, across: "", up: "", metric: "", point: "", number: "" });
  }
  return CHOICES.get(model);
}
