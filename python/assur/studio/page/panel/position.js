// The numbers of the position that is shown, and how well the forces are passed on in it.

import { html, write } from "../../../pictures/page/elements.js";
import { degrees, digits } from "../../../pictures/page/numbers.js";
import { allQuantities, unitOf } from "../../../pictures/page/quantities.js";
import { say } from "../../../pictures/page/words.js";
import { section } from "../window/shell.js";
import { LiveQuestion } from "./live.js";
import { rangesOf, usualOutput } from "./outputs.js";

/** Speeds and accelerations are written in m at most, not in km. */
const MOST = 999;
/** The rows are made again at most so often then, ms. */
const WHILE_DRAGGING = 150;
/** What is smaller, of what would be large, is rounding of the turn's interpolation. */
const ROUNDING = 1e-7;
/** A transmission angle that is always right says nothing: a driven cylinder's. */
const ALWAYS_RIGHT = Math.PI / 2 - 1e-6;

export class PositionSection {
  #rows = [];
  #table = [];
  #ranges = new Map();
  #key = "";
  #transmission = null;
  #dyads = [];
  #built = 0;
  #isOld = false;

  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.model = studio.model;
    this.facts = html("dl", { class: "position-facts" });
    this.all = html("table", { class: "position-table" });
    this.more = html("details", { class: "unfold" }, html("summary", {}, say("allParts")), this.all);
    const { element, note } = section(say("thisPosition"), "assembly", this.facts, this.more);
    Object.assign(this, { element, note });
    const { model } = this;
    model.on("turn", () => this.#replaced());
    model.on("pose", (pose) => !model.isDragging && this.#follow(pose));
    model.on("told", () => this.#follow(studio.playback.pose));
    this.more.addEventListener("toggle", () => this.#build());
    const fields = () => ({ q: model.place });
    const seen = () => this.#follow(studio.playback.pose);
    const take = (header) => {
      this.#transmission = header?.transmission ?? null;
      seen();
    };
    this.question = new LiveQuestion(studio, element, { kind: "position", fields, take, isLive: true, seen });
    this.#build();
  }

  /** While something is dragged turns come faster than anyone reads. */
  #replaced() {
    this.#isOld = this.model.isDragging && performance.now() - this.#built < WHILE_DRAGGING;
    if (!this.#isOld) this.#build();
  }

  /** Make the rows: of another turn, another speed, other points. */
  #build() {
    const { model, studio } = this;
    const { data, turn } = model;
    this.element.hidden = model.isSketch;
    if (model.isSketch) return;
    const speed = studio.playback.player.speed;
    const groups = allQuantities(data);
    const quantities = groups.flatMap((group) => group.quantities);
    this.#key = this.#wanted();
    this.#built = performance.now();
    const find = (id) => quantities.find((one) => one.id === id);
    const output = model.output ?? usualOutput(data);
    const [of] = (output ?? "").split(".");
    const ids = [output, ...(find(`${of}.omega`) ? [`${of}.omega`, `${of}.alpha`] : [`${of}.v`, `${of}.a`])];
    const chosen = studio.canvas.stage.chosen.filter((joint) => joint.name !== of);
    const points = chosen.flatMap(({ name }) => [`${name}.v`, `${name}.a`]);
    const shown = [...new Set([...ids, ...points])].map(find).filter(Boolean);
    const parts = this.more.open ? groups.filter((group) => !this.#isJoint(group.name)) : [];
    this.#ranges = rangesOf(turn, [...shown, ...parts.flatMap((group) => group.quantities)], speed);
    this.#rows = [this.#driver(), ...shown.map((one) => this.#quantity(one)), ...this.#angles()];
    this.facts.replaceChildren(...this.#rows.map(({ label, note, value }) => html("div", {}, label, note, value)));
    this.#tabulate(parts);
    this.#follow(studio.playback.pose);
  }

  /** What the rows are made for, besides the turn. */
  #wanted() {
    const { stage } = this.studio.canvas;
    return [this.studio.playback.player.speed, this.model.output, ...stage.chosen.map((joint) => joint.name)].join();
  }

  #row(label, note, text) {
    return { label: html("dt", {}, ...label), note: html("dd", { class: "note" }, note), value: html("dd"), text };
  }

  #driver() {
    const { playback } = this.studio;
    const { data, axis } = this.model;
    const symbol = html("i", { class: "name" }, { angle: "φ", length: "s", time: "t" }[data.turn.unit]);
    const name = this.model.driverCount > 1 ? data.driver.split(", ")[axis] : data.driver;
    return this.#row([`${name} `, symbol], "", () => playback.place(playback.q));
  }

  #text(quantity) {
    const { low, high } = this.#ranges.get(quantity.id);
    // Near a dead point speeds know no bounds.
    const { name, factor } = unitOf(quantity, Math.min(Math.max(Math.abs(low), Math.abs(high)), MOST));
    return (pose, speed) => {
      const own = quantity.value(pose, speed);
      const value = Math.abs(own) < ROUNDING * quantity.size * Math.abs(speed) ** quantity.order ? 0 : own;
      return quantity.isAngle && !quantity.order ? degrees(value) : `${digits(value * factor)} ${name}`;
    };
  }

  #quantity(quantity) {
    const { id, of, what, order, isAngle } = quantity;
    const { low, high } = this.#ranges.get(id);
    let note = "";
    if (!order && isAngle && high - low < 2 * Math.PI - 0.1) note = say("swings", { n: degrees(high - low) });
    if (!order && !isAngle) note = say("travels", { n: this.#length(quantity, high - low) });
    const name = this.#isJoint(of) ? html("i", { class: "name" }, of) : of;
    return this.#row([name, ` ${say(what)}`], note, this.#text(quantity));
  }

  #length(quantity, value) {
    const { name, factor } = unitOf(quantity, value);
    return `${digits(value * factor)} ${name}`;
  }

  #isJoint(name) {
    return this.model.data.joints.some((joint) => joint.name === name);
  }

  /** The transmission angles of the dyads. Which is the least is not known while something is dragged. */
  #angles() {
    const { transmission, isDragging } = this.model;
    const isTelling = ({ min }) => min < ALWAYS_RIGHT;
    if (transmission || !isDragging) this.#dyads = (transmission ?? []).filter(isTelling);
    return this.#dyads.map(({ at, min }) => {
      const symbol = html("i", { class: "name" }, this.#dyads.length > 1 ? `γ ${at}` : "γ");
      const note = transmission ? say("least", { n: degrees(min) }) : "";
      return this.#row([`${say("transmissionAngle")} `, symbol], note, () => {
        const own = this.#transmission?.[at];
        return Number.isFinite(own) && !isDragging ? degrees(own) : "–";
      });
    });
  }

  /** All parts with value, speed, acceleration. */
  #tabulate(parts) {
    const head = [["valueColumn", say("valueColumn")], ["v", "ω, v"], ["a", "α, a"]].map(([what, text]) => {
      return html("th", { scope: "col", title: say(what), "aria-label": say(what) }, text);
    });
    this.#table = [];
    const rows = parts.map(({ name, quantities }) => {
      const cells = quantities.map((quantity) => {
        const cell = html("td");
        this.#table.push({ cell, text: this.#text(quantity) });
        return cell;
      });
      const row = html("tr", {}, html("th", { scope: "row" }, name), ...cells);
      this.studio.highlight.attach(row, () => ({ links: [name] }));
      return row;
    });
    this.all.replaceChildren(html("thead", {}, html("tr", {}, html("td"), ...head)), html("tbody", {}, ...rows));
  }

  #follow(pose) {
    const { element, studio } = this;
    if (element.hidden || this.#isOld || !pose.known || !this.question?.isSeen) return;
    if (this.#key !== this.#wanted()) return this.#build();
    const { player } = studio.playback;
    const speed = player.speed * player.sense;
    for (const row of this.#rows) write(row.value, row.text(pose, speed));
    if (this.more.open) for (const { cell, text } of this.#table) write(cell, text(pose, speed));
    const { symbol, speedUnit } = studio.playback;
    const values = { symbol: symbol.textContent, n: digits(player.speed), unit: speedUnit.textContent };
    write(this.note, say("atSpeed", values));
  }
}
