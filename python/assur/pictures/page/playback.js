// What plays: the clock with its dial, its buttons and its speed, and diagrams with a cursor.

import { Chart } from "./chart.js";
import { Dial } from "./dial.js";
import { html, icon, write } from "./elements.js";
import { degrees, digits, lengthUnit, tickText } from "./numbers.js";
import { button } from "./panel.js";
import { Player } from "./player.js";
import { allQuantities } from "./quantities.js";
import { readSpeed } from "./speeds.js";
import { say } from "./words.js";

const PLAY = "M8 5v14l11-7z";
const PAUSE = "M7 5h4v14H7zM13 5h4v14h-4z";
const HOME = "M6 5h2.4v14H6zM19 5v14L9.5 12z";
const DEGREE = Math.PI / 180;
/** Nothing is faster, rad/s or m/s: beyond, accelerations are no numbers any more. */
const FASTEST = 1e9;
const SPEED_UNITS = { angle: "rad/s", length: "m/s", time: "" };
/** The field of the speed is narrow: so many letters, else so many digits. */
const SPEED_LETTERS = 6;
const SPEED_DIGITS = 4;

export class Playback {
  /**
   * @param {Object} data the page's data
   * @param {import("./turn.js").Turn} turn
   * @param {{show: (pose: import("./turn.js").Pose) => void, told: () => void, paced?: (speed: number) => void, readSpeed?: typeof readSpeed}} on
   *   `show` for every frame, `told` where it was put by hand, or began or stopped to play, `paced`
   *   once another speed was typed, which `readSpeed` reads
   */
  constructor(data, turn, on) {
    this.on = on;
    this.player = new Player(turn, () => this.show());
    this.play = button(say("play"), PLAY);
    this.play.classList.add("play");
    this.play.addEventListener("click", () => this.toggle());
    this.home = button(say("home"), HOME);
    this.home.addEventListener("click", () => this.seek(this.data.turn.at));
    this.slower = html("p", { class: "hint slower" });
    this.speed = html("input", { class: "number", "aria-label": say("speed"), autocomplete: "off", spellcheck: "false" });
    this.speed.addEventListener("input", () => this.#trySpeed());
    this.speed.addEventListener("change", () => this.#takeSpeed());
    this.speed.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.setSpeed(this.#goodSpeed);
      else if (event.key === "Enter") this.#takeSpeed();
    });
    this.speedError = html("p", { class: "field-error", role: "alert", hidden: "" });
    this.symbol = html("i");
    this.speedUnit = html("span");
    this.speedField = html("label", { class: "speed", title: say("speed") }, this.symbol, this.speed, this.speedUnit);
    this.#take(data, turn);
    this.dial = new Dial(data, turn, { label: this.#dialLabel(), text: (q) => this.place(q), seek: (q) => this.seek(q) });
    this.charts = [];
    /** Quantities beside those of the motion: forces. */
    this.more = [];
    this.chartRow = html("div", { class: "charts" });
    this.#chart(data, turn);
    const drive = html("div", { class: "drive" }, this.dial.element, html("div", { class: "play-row" }, this.play, this.home), this.speedField, this.speedError, this.slower);
    this.element = html("div", { class: "dock" }, drive, this.chartRow);
    this.player.q = turn.bring(data.turn.at);
    turn.sample(this.player.q, this.pose);
    this.#writeSpeed(data.speed);
    this.#pace(data.speed);
  }

  /**
   * Play another turn; it stays where it is as far as that can be reached. `show` is called next.
   * @param {Object} data
   * @param {import("./turn.js").Turn} turn
   * @param {number} [q] where to go on
   * @param {boolean} [isPassing] the next one comes at once: diagrams wait for the last
   */
  replace(data, turn, q = this.player.q, isPassing = false) {
    this.#take(data, turn);
    this.player.turn = turn;
    // Only between ends it goes back too.
    if (turn.closes) this.player.sense = 1;
    this.player.q = turn.bring(q);
    turn.sample(this.player.q, this.pose);
    this.dial.replace(data, turn, this.#dialLabel());
    if (isPassing) return;
    this.#chart(data, turn);
    this.#pace(this.player.speed);
  }

  /** Draw the diagrams alone. */
  draw() {
    this.#chart(this.data, this.turn);
    this.#pace(this.player.speed);
    for (const chart of this.charts) chart.show(this.pose);
  }

  /** Make the diagrams that are wanted; those that are there show the same as before, if they can. */
  #chart(data, turn) {
    const groups = [...allQuantities(data), ...this.more];
    this.chartRow.hidden = data.diagrams.length === 0;
    for (const [i, id] of data.diagrams.entries()) {
      const before = this.charts[i]?.quantity?.id;
      if (!this.charts[i]) {
        const options = { label: say("diagram", { n: i + 1 }), words: (one) => `${one.of} ${say(one.what)}`, seek: (q) => this.seek(q) };
        this.charts.push(new Chart(turn, groups, { ...options, ...this.#axis() }));
        this.chartRow.append(this.charts[i].element);
      } else this.charts[i].replace(turn, groups, this.#axis());
      const isThere = groups.some((group) => group.quantities.some((one) => one.id === before));
      this.charts[i].pick(isThere ? before : id);
    }
  }

  /**
   * Offer more quantities for the diagrams.
   * @param {{name: string, quantities: import("./quantities.js").Quantity[]}[]} groups
   */
  offer(groups) {
    this.more = groups;
    this.draw();
  }

  #take(data, turn) {
    this.data = data;
    this.turn = turn;
    this.pose = turn.pose();
    this.unit = data.turn.unit;
    const [x0, y0, x1, y1] = data.bounds;
    const length = lengthUnit(Math.max(x1 - x0, y1 - y0));
    this.scaled = { angle: 1 / DEGREE, length: length.factor, time: 1 }[this.unit];
    this.placeUnit = this.unit === "time" ? "s" : length.name;
    write(this.symbol, this.unit === "angle" ? "ω" : "v");
    write(this.speedUnit, SPEED_UNITS[this.unit]);
    this.speedField.hidden = this.unit === "time";
  }

  #dialLabel() {
    return say("dial", { driver: this.data.driver });
  }

  #axis() {
    return { unit: this.unit, scaled: this.scaled, place: (q) => tickText(q * this.scaled) };
  }

  /** Write a coordinate. */
  place(q) {
    return this.unit === "angle" ? degrees(q) : `${digits(q * this.scaled)} ${this.placeUnit}`;
  }

  get q() {
    return this.player.q;
  }

  /** A step of the coordinate by a key. */
  get step() {
    return this.unit === "angle" ? DEGREE : (this.turn.high - this.turn.low) / 360;
  }

  /** Show where it is. */
  show() {
    const { turn, pose, player } = this;
    turn.sample(player.q, pose);
    this.on.show(pose);
    this.dial.show(pose.q, this.#second());
    for (const chart of this.charts) chart.show(pose);
  }

  #second() {
    const { turn, player, pose } = this;
    if (this.unit !== "angle") return "";
    if (!turn.closes) return say("of", { low: degrees(turn.low, 0), high: degrees(turn.high, 0) });
    const turns = Math.round((turn.high - turn.low) / (2 * Math.PI));
    return say("turn", { n: 1 + player.turns * turns + Math.floor((pose.q - turn.low) / (2 * Math.PI)) });
  }

  /** Go to a coordinate by hand. */
  seek(q) {
    this.player.seek(q);
    this.tell();
  }

  tell() {
    this.dial.tell(this.pose.q);
    this.on.told();
  }

  toggle() {
    const { player, play } = this;
    if (player.isPlaying) player.pause();
    else player.play();
    play.replaceChildren(icon(player.isPlaying ? PAUSE : PLAY));
    for (const name of ["title", "aria-label"]) play.setAttribute(name, say(player.isPlaying ? "pause" : "play"));
    this.show();
    this.tell();
  }

  pause() {
    if (this.player.isPlaying) this.toggle();
  }

  /** Read the field: a speed, or why it is none, as a sentence. */
  #typedSpeed() {
    const unit = SPEED_UNITS[this.unit];
    const text = this.speed.value;
    const { value, error, values } = (this.on.readSpeed ?? readSpeed)(text, unit);
    if (!error && Math.abs(value) <= FASTEST) return { value };
    const why = say(error ?? "tooLargeNumber", values ?? { text: text.trim() });
    return { wrong: `${why} ${say("speedStays", { kept: `${this.#writtenSpeed} ${unit}` })}` };
  }

  /** While it is typed a speed is shown; a bad one keeps the last that was taken. */
  #trySpeed() {
    const { value, wrong } = this.#typedSpeed();
    this.#refuseSpeed("");
    this.speed.setAttribute("aria-invalid", String(Boolean(wrong)));
    this.#pace(wrong ? this.#goodSpeed : value);
    this.show();
  }

  /** Take what was typed; what is bad stays to be mended, with the reason under it. */
  #takeSpeed() {
    if (this.speed.value === this.#writtenSpeed) return;
    const { value, wrong } = this.#typedSpeed();
    if (wrong) return this.#refuseSpeed(wrong);
    const before = this.#goodSpeed;
    this.setSpeed(value);
    if (value !== before) this.on.paced?.(value);
  }

  /** Whether a speed is being typed, which is not yet taken. */
  get isTypingSpeed() {
    return this.speed === this.speed.getRootNode().activeElement && this.speed.value !== this.#writtenSpeed;
  }

  #writtenSpeed = "";
  /** The last that was taken: of a text that is being typed nothing is known yet. */
  #goodSpeed = 0;

  #writeSpeed(value) {
    const whole = String(value);
    const count = Math.max(SPEED_DIGITS, String(Math.trunc(Math.abs(value))).length);
    const text = whole.length > SPEED_LETTERS ? String(Number(value.toPrecision(count))) : whole;
    this.#writtenSpeed = text.replaceAll("-", "−");
    this.speed.value = this.#writtenSpeed;
    this.#goodSpeed = value;
    this.#refuseSpeed("");
  }

  #refuseSpeed(text) {
    this.speedError.textContent = text;
    this.speedError.hidden = !text;
    this.speed.setAttribute("aria-invalid", String(Boolean(text)));
  }

  setSpeed(value) {
    this.#writeSpeed(value);
    this.#pace(value);
    this.show();
  }

  #pace(value) {
    const { player } = this;
    player.speed = value;
    this.slower.textContent = player.slowness > 1 ? say("slower", { n: player.slowness }) : "";
    for (const chart of this.charts) {
      chart.speed = value;
      chart.draw();
    }
  }

  resize() {
    for (const chart of this.charts) chart.resize();
  }
}
