// The flywheel for a wanted fluctuation of speed: how large, and what the turn is with it.

import { html } from "../../../pictures/page/elements.js";
import { degrees, digits } from "../../../pictures/page/numbers.js";
import { button } from "../../../pictures/page/panel.js";
import { say } from "../../../pictures/page/words.js";
import { newestOnly } from "../model/link.js";
import { hasMachine } from "./answers.js";
import { withForceUnit } from "./drive.js";
import { Fields, later, positive } from "./fields.js";
import { FlywheelDiagrams } from "./flywheel_diagrams.js";
import { foldedSection } from "./folded.js";
import { motorOf, motorWords } from "./motor.js";
import { discDiameter } from "./surplus.js";

/** Steel, kg/m³, and the disc that is shown at first, m. */
const STEEL = 7850;
const DISC = 0.06;
const WANTED = { fluctuation: 0.05, mean_speed: null, thickness: DISC };

/** How the package says that a speed must be given, in words of Python. */
const NEEDS_SPEED = /^mean_speed is needed|pass speed=/;

export class FlywheelSection {
  /**
   * @param {import("../studio.js").Studio} studio
   * @param {import("./answers.js").ForceAnswers} answers
   */
  constructor(studio, answers) {
    const { model, playback, shell } = studio;
    Object.assign(this, { studio, model, playback, shell, answers });
    const { element, details, body, note } = foldedSection("flywheel", say("flywheel"), "more", answers.folded, false);
    Object.assign(this, { element, details, note });
    const form = html("div");
    this.fields = new Fields(form);
    this.error = html("p", { class: "field-error", role: "status" });
    this.number = html("output", { class: "big-number", "data-fact": "inertia" });
    this.disc = html("p", { class: "hint" });
    this.remark = html("p", { class: "hint", role: "status", "data-fact": "warnings" });
    this.facts = html("dl", { class: "facts" });
    this.opener = button(say("flywheelDiagrams"), "M4 20V4M4 20h16M7 15c3-9 5-9 7-3s3 3 5-4", say("flywheelDiagrams"));
    this.opener.addEventListener("click", () => this.#openDiagrams(!this.isOpen));
    this.pace = html("button", { type: "button", class: "button" }, say("playAtMean"));
    this.pace.addEventListener("click", () => studio.pace(Number(this.found.header.mean_speed.toPrecision(4))));
    const row = html("div", { class: "button-row" }, this.opener, this.pace);
    this.result = html(
      "div", {}, html("p", { class: "note" }, say("inertiaNeeded")), this.number, this.disc, this.remark, row, this.facts,
    );
    this.error.hidden = true;
    this.result.hidden = true;
    body.append(form, this.error, this.result);
    this.diagrams = new FlywheelDiagrams({ seek: (q) => playback.seek(q), close: () => this.#openDiagrams(false) });
    this.diagrams.element.hidden = true;
    playback.element.append(this.diagrams.element);
    model.on("pose", (pose) => this.isOpen && !model.run && this.diagrams.show(pose));
    this.again = later(() => this.show());
    for (const event of ["document", "checked", "settled", "run"]) model.on(event, this.again);
    model.on("pose", () => this.meanSpeed !== this.asked?.mean && this.again());
    details.addEventListener("toggle", this.again);
    // A section that comes to be seen asks.
    this.observer = new ResizeObserver(this.again);
    this.observer.observe(form);
    this.requests = newestOnly(() => this.#ask());
    this.show();
  }

  get isOpen() {
    return !this.diagrams.element.hidden;
  }

  get wanted() {
    return { ...WANTED, ...this.answers.flywheelWanted };
  }

  /** The mean speed that is wanted: without a motor, which would set it, that of the page. */
  get meanSpeed() {
    const { mean_speed } = this.wanted;
    if (mean_speed !== null || motorOf(this.model.document)) return mean_speed;
    return Math.abs(this.playback.player.speed) || null;
  }

  #set(key, value) {
    this.answers.flywheelWanted = { ...this.wanted, [key]: value };
    this.again();
  }

  /** A flywheel is for a crank that turns all the way around. */
  get canBe() {
    const { model, answers } = this;
    return answers.canBe && hasMachine(model.document) && Boolean(model.turn?.closes || model.run);
  }

  show() {
    const { element, details, note, model } = this;
    element.hidden = !this.canBe;
    if (element.hidden || model.run) this.#openDiagrams(false);
    if (element.hidden) return;
    note.textContent = motorWords(model.document);
    element.classList.toggle("stale", this.foundFor !== model.document);
    this.opener.disabled = this.pace.disabled = Boolean(model.run);
    if (!details.open || !details.offsetParent) return;
    this.#form();
    const mean = this.meanSpeed;
    const key = JSON.stringify([this.wanted.fluctuation, mean]);
    if (model.isDragging || (this.asked?.document === model.document && this.asked.key === key)) return;
    this.asked = { document: model.document, key, mean };
    this.requests.push(null);
  }

  #form() {
    const { fields, wanted, found } = this;
    const mean = this.meanSpeed ?? found?.header.mean_speed;
    fields.show(
      fields.row("flywheel fluctuation", {
        label: say("wantedDelta"),
        value: wanted.fluctuation,
        unit: "",
        check: positive,
        set: (value) => this.#set("fluctuation", value),
      }),
      fields.row("flywheel mean_speed", {
        label: say("meanSpeed"), value: wanted.mean_speed, unit: "rad/s", isOptional: true, check: positive,
        hint: mean ? digits(mean, 4) : "–", set: (value) => this.#set("mean_speed", value),
      }),
      fields.row("flywheel thickness", {
        label: say("discThickness"), value: wanted.thickness, unit: "m", shown: "mm", check: positive,
        set: (value) => {
          this.#set("thickness", value);
          if (found) this.#showDisc(found.header.inertia);
        },
      }),
    );
  }

  async #ask() {
    const { model, wanted, meanSpeed } = this;
    const { document } = model;
    const fields = { fluctuation: wanted.fluctuation, ...(meanSpeed === null ? {} : { mean_speed: meanSpeed }) };
    try {
      const [answer, without] = await Promise.all([model.ask("flywheel", fields), this.#without()]);
      if (!answer || model.document !== document) return;
      this.#take(answer, without, null);
    } catch (error) {
      if (error.kind === "disconnected") this.asked = null;
      else if (model.document === document) this.#take(null, null, error);
    }
  }

  /** The motion without a flywheel; that there is none is an answer. */
  async #without() {
    const { meanSpeed } = this;
    try {
      return await this.model.ask("steady", meanSpeed === null ? {} : { speed: meanSpeed });
    } catch (error) {
      return { error };
    }
  }

  #take(found, without, error) {
    this.found = found;
    this.foundFor = this.model.document;
    const message = error?.message ?? "";
    this.error.textContent = NEEDS_SPEED.test(message) ? say("giveMeanSpeed") : message;
    this.error.hidden = !error;
    this.result.hidden = !found;
    if (!found) return this.#openDiagrams(false);
    this.diagrams.take(found, without?.arrays ? without : null);
    const { header } = found;
    this.number.textContent = `${digits(header.inertia, 4)} kg·m²`;
    this.remark.textContent = (header.warnings ?? []).join(" ");
    this.remark.hidden = !header.warnings;
    this.#showDisc(header.inertia);
    this.#showFacts(header, found.arrays, without);
    this.again();
  }

  #showDisc(inertia) {
    const { thickness } = this.wanted;
    const mm = (value) => `${digits(value * 1e3)} mm`;
    this.disc.hidden = !(inertia > 0);
    this.disc.textContent = say("steelDisc", {
      thickness: mm(thickness), diameter: mm(discDiameter(inertia, thickness, STEEL)),
    });
  }

  #showFacts(header, arrays, without) {
    const rad = (value) => `${digits(value, 4)} rad/s`;
    const large = (values) => values.reduce((most, own) => Math.max(most, Math.abs(own)), 0);
    const moment = large(arrays.moment);
    const reason = without?.error?.message ?? "";
    const bare = without?.header ? `δ = ${digits(without.header.delta)}` : say("noSteady");
    const rows = [
      ["withoutIt", "", bare],
      ["greatestSpeed", degrees(header.max.q, 0), rad(header.max.value)],
      ["leastSpeed", degrees(header.min.q, 0), rad(header.min.value)],
      ["motorMoment", "", withForceUnit(header.motor_moment, "N·m", moment)],
      [
        "workOfTurn",
        "",
        withForceUnit(header.motor_moment * (arrays.q[arrays.q.length - 1] - arrays.q[0]), "J", moment),
      ],
      ["power", "", withForceUnit(header.power, "W", moment * header.mean_speed)],
    ];
    this.facts.replaceChildren();
    for (const [key, place, text] of rows) {
      const value = html("dd", { "data-fact": key }, text);
      if (key === "withoutIt" && reason) value.title = reason;
      this.facts.append(html("dt", {}, say(key)), html("dd", { class: "note" }, place), value);
    }
  }

  /** Open the diagrams in the place of the others, or close them. */
  #openDiagrams(isWanted) {
    const { diagrams, playback, shell } = this;
    if (isWanted === this.isOpen || (isWanted && !this.found)) return;
    diagrams.element.hidden = !isWanted;
    shell.element.classList.toggle("tall-dock", isWanted);
    playback.element.classList.toggle("shows-flywheel", isWanted);
    this.opener.setAttribute("aria-pressed", String(isWanted));
    this.studio.resize();
    if (!isWanted) return;
    if (getComputedStyle(shell.tabs).display !== "none") shell.choose("diagrams");
    diagrams.show(playback.pose);
    diagrams.draw();
    diagrams.element.querySelector("button").focus({ preventScroll: true });
  }
}
