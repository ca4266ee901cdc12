// Warns where the driver cannot go on, else where the transmission angle becomes too small over the turn.

import { html } from "../../../pictures/page/elements.js";
import { degrees } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { coordinateText } from "./coordinate.js";
import { deadEnds } from "./dead_ends.js";
import { panelLength } from "./steps.js";

/** What is usually asked for, rad. */
export const USUAL_TRANSMISSION = (40 * Math.PI) / 180;
/** Stands for a place in a sentence, which becomes a button there. */
const PLACE = "\u0001";

/** Return the dyad with the least transmission angle, if that is below the usual one. */
export function poorest(transmission) {
  const [worst] = [...(transmission ?? [])].sort((a, b) => a.min - b.min);
  return worst && worst.min < USUAL_TRANSMISSION ? worst : null;
}

export class TransmissionWarning {
  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.links = [];
    this.element = html("p", { class: "caution", role: "status", hidden: "" });
    studio.highlight.attach(this.element, () => ({ links: this.links }));
    for (const event of ["turn", "checked", "problem"]) studio.model.on(event, () => this.show());
    // In another language the window is made anew, and the mechanism stays.
    this.#tell();
  }

  show() {
    this.#tell();
    this.#makeRoom();
  }

  #tell() {
    const { model } = this.studio;
    // Of several drivers what one of them does alone says little.
    const isTold = model.moves && !model.isSketch && !model.problem && !model.run && model.driverCount === 1;
    const ends = isTold ? deadEnds(model.data.turn.dead, model.checked.structure?.groups ?? []) : [];
    const worst = isTold && !ends.length ? poorest(model.transmission) : null;
    const shown = JSON.stringify([ends, worst, model.data.turn.unit, panelLength(model.data).name]);
    this.element.hidden = !ends.length && !worst;
    this.links = ends.flatMap((end) => end.links);
    /** Whether it says where the driver stops, and why. */
    this.tellsEnds = ends.length > 0;
    // A button that has the focus stays.
    if (this.element.hidden || shown === this.shown) return;
    this.shown = shown;
    this.element.replaceChildren(...(worst ? this.#gamma(worst) : ends.flatMap((end) => [...this.#end(end), " "])));
  }

  /** What is fitted keeps clear of it; under a hand nothing jumps. */
  #makeRoom() {
    const { model, canvas } = this.studio;
    if (model.isDragging || this.height === this.element.offsetHeight) return;
    this.height = this.element.offsetHeight;
    canvas.resize();
  }

  #gamma({ at, q, min }) {
    const { model } = this.studio;
    // The end of a turn is its beginning.
    const place = model.turn.closes ? model.turn.bring(q) : q;
    const [own, usual] = [min, USUAL_TRANSMISSION].map((angle) => degrees(angle));
    const values = { at, symbol: model.data.turn.unit === "angle" ? "φ" : "s", q: PLACE, least: own, usual };
    const text = say(model.transmission.length === 1 ? "gammaFalls" : "gammaFallsAt", values);
    return this.#sentence(text, [place]);
  }

  #end({ at, key, values }) {
    const { data } = this.studio.model;
    const q = at.length > 1 ? say("andLast", { names: PLACE, last: PLACE }) : PLACE;
    return this.#sentence(say(key, { ...values, driver: data.driver, q }), at);
  }

  /** Make a sentence whose places are buttons that go there. */
  #sentence(text, places) {
    const { data } = this.studio.model;
    const write = (q) => coordinateText(data, q, data.turn.unit === "length");
    return text.split(PLACE).flatMap((part, i) => {
      if (i === 0) return [part];
      const q = places[i - 1];
      const name = say("goThere");
      const words = { title: name, "aria-label": `${name}: ${write(q)}` };
      const go = html("button", { type: "button", class: "place", ...words }, write(q));
      go.addEventListener("click", () => {
        this.studio.playback.pause();
        this.studio.playback.seek(q);
      });
      return [go, part];
    });
  }
}
