// Why the present numbers cannot be shown, in the units of the panel.

import { digits } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { ownCoordinateText } from "./coordinate.js";
import { panelLength } from "./steps.js";

/**
 * Return the sentence of an error.
 * @param {Error & {kind?: string, q?: number, value?: number, group?: string}} problem
 * @param {import("../studio.js").Studio} studio
 */
export function problemText(problem, { model }) {
  const { kind, q, value, group } = problem;
  if (kind !== "not_closed" || !Number.isFinite(q) || !Number.isFinite(value) || !group) return problem.message;
  const { name, factor } = panelLength(model.data);
  return say("notClosed", { q: ownCoordinateText(model, q), at: group, miss: `${digits(value * factor)} ${name}` });
}
