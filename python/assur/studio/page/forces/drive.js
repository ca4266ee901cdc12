// The drive: which moment (or force) the driver needs, now and over the turn, and with which power.

import { Chart } from "../../../pictures/page/chart.js";
import { html } from "../../../pictures/page/elements.js";
import { digits, forceUnit } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { drivesSlide } from "../document/drivers.js";
import { driveAt } from "./answers.js";
import { foldedSection } from "./folded.js";
import { forceQuantities } from "./force_quantities.js";
import { peakOf, withoutLimit } from "./peaks.js";

/** Smaller parts of what is large are not told: they flicker, or are rounding. */
const PARTS = 1e4;

/** Write a number with its unit, N or kN as what is large has it. */
export function withForceUnit(value, unit, large = value) {
  const { name, factor } = forceUnit(unit, large);
  const step = 10 ** Math.floor(Math.log10(Math.abs(large * factor) / PARTS));
  const own = value * factor;
  const isRounded = step > 0 && Number.isFinite(own);
  return `${digits(isRounded ? Number((Math.round(own / step) * step).toPrecision(12)) : own)} ${name}`;
}

/**
 * Return what is told of the drive over the rows.
 * @param {import("./answers.js").Forces} forces
 * @returns {{greatest: {value: number, place: number} | null, most: number, isUnbounded: boolean, mean: number,
 *   power: number}}
 */
export function driveFacts(forces) {
  const { along, arrays, speed } = forces;
  const { drive } = arrays;
  const powers = speed === null ? drive.map((own, i) => own * arrays.speed[i]) : drive.map((own) => own * speed);
  // Even in time at an even speed: the mean over q is that over time.
  const peak = peakOf(drive, along.repeats);
  return { ...peak, greatest: along.greatest(drive), mean: along.mean(drive), power: along.mean(powers) };
}

export class DriveSection {
  /**
   * @param {import("../studio.js").Studio} studio
   * @param {import("./answers.js").ForceAnswers} answers
   */
  constructor({ model, playback }, answers) {
    Object.assign(this, { model, playback, answers });
    const { element, details, body, note } = foldedSection("drive", say("drive"), "more", answers.folded, false);
    Object.assign(this, { element, details, note });
    this.now = html("output", { class: "big-number" });
    this.nowLabel = html("p", { class: "note" });
    this.facts = html("dl", { class: "facts" });
    this.warning = html("p", { class: "field-error", role: "status" });
    this.chart = null;
    this.chartBox = html("div", { class: "section-chart" });
    this.numbers = html("div", {}, this.nowLabel, this.now, this.facts, this.chartBox);
    body.append(this.warning, this.numbers);
    for (const event of ["forces", "checked", "document"]) model.on(event, () => this.show());
    model.on("pose", (pose) => this.#showNow(pose));
    this.observer = new ResizeObserver(() => this.chart?.resize());
    this.observer.observe(this.chartBox);
    this.show();
  }

  /** What drives, for the words and units. */
  get drive() {
    const { document, data } = this.model;
    return { driver: data.driver, isSlide: drivesSlide(document) };
  }

  get #unit() {
    return this.drive.isSlide ? "N" : "N·m";
  }

  show() {
    const { answers, model, playback } = this;
    const { forces, error } = answers;
    this.element.hidden = !answers.canBe;
    this.element.classList.toggle("stale", forces !== null && !answers.isPresent);
    if (this.forces === forces && this.error === error) return;
    Object.assign(this, { forces, error });
    this.warning.hidden = !error;
    this.warning.textContent = error ? error.message : "";
    this.numbers.hidden = !forces;
    playback.offer(forces ? this.#groups(forces) : []);
    if (!forces) return;
    const speed = `${digits(forces.speed)} ${this.drive.isSlide ? "m/s" : "rad/s"}`;
    this.note.textContent = forces.speed === null ? say("alongRun") : say("driveAtSpeed", { speed });
    this.nowLabel.textContent = say(
      this.drive.isSlide ? "driveForceNeeded" : "driveMomentNeeded", { driver: model.data.driver },
    );
    this.#showFacts(forces);
    this.#showChart(forces);
    this.#showNow(playback.pose);
  }

  #groups(forces) {
    return forceQuantities(forces, this.drive).map(({ quantities }) => ({ name: say("forces"), quantities }));
  }

  #showFacts(forces) {
    const { greatest, most, isUnbounded, mean, power } = driveFacts(forces);
    this.greatest = most;
    const unit = this.#unit;
    const rows = [
      [
        "driveGreatest",
        greatest ? this.playback.place(greatest.place) : "",
        isUnbounded ? "∞" : withForceUnit(greatest?.value ?? NaN, unit, most),
      ],
      ["driveMean", "", isUnbounded ? "–" : withForceUnit(mean, unit, most)],
      ["powerMean", "", isUnbounded ? "–" : withForceUnit(power, "W", most * (forces.speed ?? 1))],
    ];
    this.facts.replaceChildren();
    for (const [key, place, text] of rows) {
      this.facts.append(
        html("dt", {}, say(key)), html("dd", { class: "note" }, place), html("dd", { "data-fact": key }, text),
      );
    }
  }

  #showChart(forces) {
    const { model, playback } = this;
    const { turn } = model;
    const options = {
      label: say("driveDiagram"), unit: playback.unit, scaled: playback.scaled,
      words: (one) => `${one.of} ${say(one.what)}`,
      seek: (q) => playback.seek(q), place: (q) => digits(q * playback.scaled),
    };
    const groups = this.#groups(forces);
    if (this.chart) this.chart.replace(turn, groups, options);
    else {
      this.chart = new Chart(turn, groups, options);
      this.chartBox.append(this.chart.element);
    }
    this.chart.pick(this.chart.quantity?.id);
    this.chart.resize();
    this.chart.draw();
  }

  #showNow(pose) {
    const { forces } = this;
    if (!forces || !pose) return;
    const { drive, power } = driveAt(forces, pose.q);
    const text = withoutLimit(drive, this.greatest) ? "∞" : withForceUnit(drive, this.#unit, this.greatest);
    if (this.now.value !== text) this.now.value = text;
    const watts = say("powerNow", { power: withForceUnit(power, "W", this.greatest * (forces.speed ?? 1)) });
    if (this.now.title !== watts) this.now.title = watts;
    this.chart?.show(pose);
  }
}
