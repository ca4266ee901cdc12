// The panel's fields: dimensions and motion, with Apply, Run and Stop.

import { html, put } from "../../../pictures/page/elements.js";
import { LessonField } from "./field.js";
import { sayLesson } from "./lesson_words.js";
import { plainText, withSymbols } from "./symbols.js";

const LENGTH_NAMES = { l1: "crank", l2: "coupler", l3: "rocker", l4: "ground" };
const FRICTION_FIELDS = ["f_c", "r_c", "f_d", "r_d"];
const USUAL_FRICTION = 0.1;
/** Fields that a refusal of the server belongs to, by its key or dimension. */
const FIELD_OF_KEY = { gamma_min: "least", phi1: "start", speed: "speed", friction: "f_c" };

/**
 * What the fields hold, in the unit of lengths; angles rad.
 * @typedef {{l1: number, l2: number, l3: number, l4: number, start: number, speed: number,
 *   least: number|null, friction: Object<string, number>|null}} Design
 */

export class LessonFields {
  /**
   * @param {{apply: () => void, run: () => void, stop: () => void, unit: (isRelative: boolean) => void}} on
   */
  constructor(on) {
    this.on = on;
    this.isRelative = true;
    this.hasFriction = false;
    /** @type {Object<string, LessonField>} */
    this.fields = {};
    this.bar = html("div", { class: "lesson-bar-place" });
    this.element = html("div", { class: "lesson-fields" }, this.#dimensions(), this.#motion(), this.#buttons());
    this.element.addEventListener("keydown", (event) => {
      const isTyped = event.key === "Enter" && event.target.matches("input");
      if (isTyped && !this.apply.disabled) this.on.apply();
    });
    this.changed();
  }

  #field(key, options) {
    this.fields[key] = new LessonField({ key, ...options }, () => this.changed());
    return this.fields[key].element;
  }

  #dimensions() {
    const positive = (value, kept) => (value > 0 ? "" : sayLesson("notPositive", { kept }));
    const fields = Object.entries(LENGTH_NAMES).map(([key, name]) => {
      const label = `l_${key[1]}`;
      return this.#field(key, { label, name: `${label}, ${sayLesson(name)}`, kind: "ratio", check: positive });
    });
    const options = ["relative", "metres"].map((key) => html("option", { value: key }, sayLesson(key)));
    const chooses = { class: "lesson-unit-choice", "aria-label": sayLesson("unitOfLengths") };
    this.unit = html("select", chooses, ...options);
    this.unit.addEventListener("change", () => this.on.unit(this.unit.value === "relative"));
    const head = html("div", { class: "lesson-head" }, html("h2", {}, sayLesson("dimensions")), this.unit);
    const lengths = html("div", { class: "lesson-lengths" }, ...fields);
    return html("section", { class: "lesson-section" }, head, lengths, this.bar);
  }

  #motion() {
    const least = (value) => (value > 0 && value < Math.PI / 2 ? "" : sayLesson("leastRange"));
    const moves = (value) => (value === 0 ? sayLesson("notTurning") : "");
    const notNegative = (value) => (value < 0 ? sayLesson("negative") : "");
    const [start, speed, own] = ["start", "speed", "least"].map((key) => {
      const text = sayLesson(key);
      return { label: text, name: text };
    });
    const rows = [
      this.#field("start", { ...start, kind: "degrees", unit: "°" }),
      this.#field("speed", { ...speed, kind: "speed", unit: "rad/s", check: moves }),
      this.#field("least", { ...own, kind: "rad", unit: "rad", check: least }),
    ];
    const friction = FRICTION_FIELDS.map((key) => {
      const joint = key[2].toUpperCase();
      const isFactor = key[0] === "f";
      const label = sayLesson(isFactor ? "coefficient" : "radius", { joint: `$${joint}` });
      const name = sayLesson(isFactor ? "coefficientOf" : "radiusOf", { joint });
      return this.#field(key, { label, name, kind: isFactor ? "number" : "ratio", check: notNegative });
    });
    this.friction = html("div", { class: "lesson-lengths", hidden: "" }, ...friction);
    this.way = html("button", { type: "button", class: "lesson-link", "aria-expanded": "false" });
    this.way.addEventListener("click", () => this.chooseFriction(!this.hasFriction));
    this.general = html("p", { class: "lesson-error", role: "alert", hidden: "" });
    this.#sayWay();
    return html(
      "section",
      { class: "lesson-section" },
      html("h2", {}, sayLesson("motion")),
      ...rows,
      this.way,
      this.friction,
      this.general,
    );
  }

  #buttons() {
    const buttons = ["apply", "run", "stop"].map((key) => {
      const element = html("button", { type: "button", class: `button lesson-${key}` }, sayLesson(key));
      element.addEventListener("click", () => this.on[key]());
      return (this[key] = element);
    });
    return html("div", { class: "lesson-buttons" }, ...buttons);
  }

  /** Run is off while it runs; the focus goes with it, so that Space goes on to run and stop. */
  runs(isRunning) {
    const { run, stop } = this;
    const { activeElement } = run.getRootNode();
    run.disabled = isRunning;
    if (isRunning && activeElement === run) stop.focus();
    if (!isRunning && activeElement === stop) run.focus();
  }

  #sayWay() {
    const text = sayLesson(this.hasFriction ? "leastItself" : "fromFriction");
    this.way.replaceChildren(...withSymbols(text));
    put(this.way, "aria-label", plainText(text));
    put(this.way, "aria-expanded", String(this.hasFriction));
  }

  /** γmin itself, or friction and radii of the pins. */
  chooseFriction(hasFriction) {
    this.hasFriction = hasFriction;
    this.friction.hidden = !hasFriction;
    this.fields.least.lock(hasFriction);
    const { least, l3 } = this.fields;
    if (hasFriction) least.keep(least.kept);
    // To begin with what gives the present γmin.
    if (hasFriction && Number.isNaN(this.fields.f_c.kept)) {
      const radius = (l3.kept * Math.sin(least.kept)) / (2 * USUAL_FRICTION);
      const values = { f: USUAL_FRICTION, r: Number(radius.toPrecision(4)) };
      for (const key of FRICTION_FIELDS) this.fields[key].keep(values[key[0]]);
    }
    this.#sayWay();
    this.changed();
  }

  get #own() {
    const isOwn = (key) => {
      if (key === "least") return !this.hasFriction;
      return this.hasFriction || !FRICTION_FIELDS.includes(key);
    };
    return Object.entries(this.fields).filter(([key]) => isOwn(key));
  }

  get isValid() {
    return this.#own.every(([, field]) => field.isValid);
  }

  get isDirty() {
    return this.hasFriction !== this.hadFriction || this.#own.some(([, field]) => field.isDirty);
  }

  /** @returns {Design} */
  get design() {
    // What was not typed keeps all its digits.
    const value = (key) => (this.fields[key].isDirty ? this.fields[key].value : this.fields[key].kept);
    const friction = Object.fromEntries(FRICTION_FIELDS.map((key) => [key, value(key)]));
    const lengths = Object.fromEntries(Object.keys(LENGTH_NAMES).map((key) => [key, value(key)]));
    return {
      ...lengths,
      start: value("start"),
      speed: value("speed"),
      least: this.hasFriction ? null : value("least"),
      friction: this.hasFriction ? friction : null,
    };
  }

  /** What each field holds as text. */
  get typed() {
    return Object.fromEntries(Object.entries(this.fields).map(([key, field]) => [key, field.input.value]));
  }

  /**
   * Show what is in the picture.
   * @param {Object<string, string>} [typed] the texts it was asked with: what was typed since stays
   */
  keep(design, least, isRelative, typed = {}) {
    this.isRelative = isRelative;
    this.unit.value = isRelative ? "relative" : "metres";
    for (const key of [...Object.keys(LENGTH_NAMES), "r_c", "r_d"]) {
      this.fields[key].kind = isRelative ? "ratio" : "length";
      this.fields[key].unit.textContent = isRelative ? "" : "m";
    }
    for (const key of [...Object.keys(LENGTH_NAMES), "start", "speed"]) this.fields[key].keep(design[key], typed[key]);
    this.fields.least.keep(least, typed.least);
    for (const key of FRICTION_FIELDS) if (design.friction) this.fields[key].keep(design.friction[key], typed[key]);
    this.hadFriction = design.friction !== null;
    this.general.hidden = true;
    this.changed();
  }

  /** The support was dragged: its field follows, others stay as they are. */
  follow(l4) {
    this.fields.l4.keep(l4);
    this.changed();
  }

  /** Say why the server did not take the values, at the field if it is of one. */
  refuse(error) {
    const key = error.dimension ?? String(error.key ?? "").split(".")[0];
    const own = this.fields[key] ?? this.fields[FIELD_OF_KEY[key]];
    const word = key === "friction" ? "wrongFriction" : "refused";
    const reason = error.message.replace(`${error.key}: `, "");
    const text = sayLesson(error.kind === "disconnected" ? "disconnected" : word, { reason });
    if (own) own.refuse(text);
    else {
      this.general.replaceChildren(...withSymbols(text));
      this.general.hidden = false;
    }
  }

  /** Apply is off until something differs, and while something is wrong. */
  changed() {
    if (this.apply) this.apply.disabled = !(this.isDirty && this.isValid);
  }
}
