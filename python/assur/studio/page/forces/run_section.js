// A motion over time: at a given speed, by an input law, or under motor and loads.

import { html } from "../../../pictures/page/elements.js";
import { digits } from "../../../pictures/page/numbers.js";
import { button } from "../../../pictures/page/panel.js";
import { say } from "../../../pictures/page/words.js";
import { drivesSlide } from "../document/drivers.js";
import { hasMachine } from "./answers.js";
import { Fields, later, positive } from "./fields.js";
import { foldedSection } from "./folded.js";
import { firstRun, LAWS, runRequest } from "./laws.js";
import { documentUnit } from "./masses.js";
import { motorOf } from "./motor.js";

const RUN_PATH = "M8 5v14l11-7z";

/** Say a word of the core; as it is where there is no translation. */
function wordOf(kind, word) {
  const key = `${kind}_${word.replace(/\W/g, "_")}`;
  const text = say(key);
  return text === key ? word : text;
}

export class RunSection {
  /**
   * @param {import("../studio.js").Studio} studio
   * @param {import("./answers.js").ForceAnswers} answers
   */
  constructor({ model, playback }, answers) {
    Object.assign(this, { model, playback, answers });
    const { element, details, body, note } = foldedSection("run", say("run"), "more", answers.folded, true);
    Object.assign(this, { element, details, note });
    this.form = html("div");
    this.fields = new Fields(this.form);
    this.error = html("p", { class: "field-error", role: "alert" });
    this.start = button(say("runNow"), RUN_PATH, say("runNow"));
    this.start.classList.add("primary");
    this.start.addEventListener("click", () => this.run());
    this.back = button(say("backToTurn"), "", say("backToTurn"));
    this.back.addEventListener("click", () => model.shownRun.end());
    this.result = html("div", { class: "run-result", role: "status" });
    body.append(this.form, html("div", { class: "run-row" }, this.start, this.back), this.error, this.result);
    this.again = later(() => this.show());
    for (const event of ["document", "checked", "turn", "run"]) model.on(event, this.again);
    model.on("run", () => this.#paceAsRun());
    details.addEventListener("toggle", this.again);
    if (model.run) this.#paceAsRun();
    this.show();
  }

  get #isSlide() {
    return drivesSlide(this.model.document);
  }

  /** What is wanted, as far as it was typed; the rest is a turn from where it is. */
  get wanted() {
    const { model, answers } = this;
    const { low, high } = model.run ? { low: model.q, high: model.q + 1 } : model.turn;
    const first = firstRun({ isSlide: this.#isSlide, q: model.q, low, high });
    if (!model.run) Object.assign(first, { speed: this.playback.player.speed || 1 });
    const by = hasMachine(model.document) && motorOf(model.document) ? "machine" : "speed";
    // What was typed for another driver has other units.
    const driver = JSON.stringify(model.document.driver);
    if (answers.wanted.driver !== driver) answers.wanted = { driver, run: {} };
    return { ...first, by, ...answers.wanted.run };
  }

  #set(key, value) {
    this.answers.wanted.run = { ...this.answers.wanted.run, [key]: value };
    this.again();
  }

  show() {
    const { model, fields, details, back, start } = this;
    this.element.hidden = !model.moves || model.driverCount !== 1 || model.isSketch;
    if (this.element.hidden || !details.open) return;
    start.disabled = this.isRunning ?? false;
    back.hidden = !model.run;
    fields.show(...this.#form());
    this.#showResult();
  }

  #form() {
    const { fields, wanted } = this;
    // A law begins where it was chosen: what is shown is what is run.
    if (wanted.by === "law") this.answers.wanted.run = {
      start: wanted.start, end: wanted.end, ...this.answers.wanted.run,
    };
    const modes = ["speed", "law", ...(hasMachine(this.model.document) ? ["machine"] : [])];
    const by = modes.includes(wanted.by) ? wanted.by : "speed";
    const choice = fields.choiceRow("run by", {
      label: say("runBy"),
      value: by,
      options: modes.map((own) => [own, say(`runBy_${own}`)]),
      set: (own) => this.#set("by", own),
    });
    const place = this.#isSlide ? { unit: "m", shown: documentUnit(this.model.document) } : { unit: "rad", shown: "°" };
    const rate = { unit: this.#isSlide ? "m/s" : "rad/s" };
    const row = (key, kind) => fields.row(`run ${key}`, {
      label: say(`run_${key}`), value: wanted[key], ...kind, set: (value) => this.#set(key, value),
    });
    const time = { unit: "s", check: positive };
    if (by === "speed") return [choice, row("speed", rate), row("t_end", time)];
    if (by === "machine") return [
      choice, row("machine_speed", rate), row("machine_end", time), html("p", { class: "hint" }, say("runFromHere")),
    ];
    const law = fields.choiceRow("run law", {
      label: say("law"),
      value: wanted.law,
      options: LAWS.map((own) => [own, say(`law${own}`)]),
      set: (own) => this.#set("law", own),
    });
    const ramp = wanted.law === "Trapezoidal" ? [row("ramp", { unit: "", check: positive })] : [];
    return [choice, law, row("start", place), row("end", place), row("duration", time), ...ramp];
  }

  /** Ask for the motion and play it. */
  async run() {
    const { model, answers, fields, wanted } = this;
    if (fields.bad.size) return this.form.querySelector("[aria-invalid=true]")?.focus();
    const { document } = model;
    this.error.textContent = "";
    this.isRunning = true;
    this.start.disabled = true;
    try {
      const by = wanted.by === "machine" && !hasMachine(document) ? "speed" : wanted.by;
      const answer = await model.ask("run", runRequest({ ...wanted, by }, model.q, hasMachine(document)));
      if (!answer || model.document !== document) return;
      model.shownRun.show(answer);
      const name = model.data.driver;
      const own = this.#isSlide ? `${name}.v` : `${name}.omega`;
      answers.chartBefore ??= this.playback.charts[0]?.quantity?.id;
      this.playback.charts[0]?.choose(own);
      this.playback.seek(model.turn.low);
      if (!this.playback.player.isPlaying) this.playback.toggle();
    } catch (error) {
      const reason = error.kind === "disconnected" ? say("offline") : error.message;
      if (model.document === document) this.error.textContent = reason;
    } finally {
      this.isRunning = false;
      this.start.disabled = false;
      this.again();
    }
  }

  /** Time goes with its own speed; the turn again has that of the document. */
  #paceAsRun() {
    const { model, answers, playback } = this;
    if (model.run) playback.setSpeed(1);
    else {
      if (answers.chartBefore) playback.charts[0]?.choose(answers.chartBefore);
      answers.chartBefore = undefined;
      playback.pause();
    }
  }

  #showResult() {
    const { model, result, note } = this;
    note.textContent = model.run ? say("runShown") : "";
    if (!model.run) return result.replaceChildren();
    const { header, arrays } = model.run;
    const last = (values) => values[values.length - 1];
    const place = (q) => (this.#isSlide ? `${digits(q)} m` : `${digits((q * 180) / Math.PI)}°`);
    const rate = (value) => `${digits(value)} ${this.#isSlide ? "m/s" : "rad/s"}`;
    const facts = html("dl", { class: "facts" });
    const fact = (key, at, text) => facts.append(
      html("dt", {}, say(key)), html("dd", { class: "note" }, at), html("dd", { "data-fact": key }, text),
    );
    fact("runEnds", `${digits(last(arrays.t))} s`, wordOf("end", header.end));
    fact("runAt", "", place(last(arrays.q)));
    fact("runSpeed", "", rate(last(arrays.speed)));
    const children = [facts];
    const message = header.end === "reached" ? "" : header.message;
    // That it ended early is one of the warnings too.
    const warnings = (header.warnings ?? []).filter((text) => !message || !text.includes(message));
    for (const text of [message, ...warnings].filter(Boolean)) children.push(html("p", { class: "hint" }, text));
    if (header.events.length) {
      const list = html("ul", { class: "events", "aria-label": say("events") });
      for (const { event, t, q } of header.events) list.append(html(
        "li", {}, html("b", {}, wordOf("event", event)), ` ${digits(t)} s, ${place(q)}`,
      ));
      children.push(list);
    }
    result.replaceChildren(...children);
  }
}
