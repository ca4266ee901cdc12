// Warns where the transmission angle becomes too small over the turn.

import { html } from "../../../pictures/page/elements.js";
import { degrees } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";

/** What is usually asked for, rad. */
export const USUAL_TRANSMISSION = (40 * Math.PI) / 180;

/** Return the dyad with the least transmission angle, if that is below the usual one. */
export function poorest(transmission) {
  const [worst] = [...(transmission ?? [])].sort((a, b) => a.least - b.least);
  return worst && worst.least < USUAL_TRANSMISSION ? worst : null;
}

export class TransmissionWarning {
  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.element = html("p", { class: "caution", role: "status", hidden: "" });
    for (const event of ["turn", "checked", "problem"]) studio.model.on(event, () => this.show());
  }

  show() {
    const { model, playback } = this.studio;
    // Of several drivers what one of them does alone says little.
    const isTold = model.moves && !model.isSketch && !model.problem && model.driverCount === 1;
    const worst = isTold ? poorest(model.transmission) : null;
    this.element.hidden = !worst;
    if (!worst) return;
    const { unit } = model.data.turn;
    const isOne = model.transmission.length === 1;
    const [least, usual] = [worst.least, USUAL_TRANSMISSION].map((angle) => degrees(angle));
    const values = { at: worst.at, symbol: unit === "angle" ? "φ" : "s", q: playback.place(worst.q), least, usual };
    this.element.textContent = say(isOne ? "gammaFalls" : "gammaFallsAt", values);
  }
}
