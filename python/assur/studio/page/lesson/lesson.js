// The lesson "Crank-rocker with friction": the program of Manzhosov and Petrova, section 3.

import { put } from "../../../pictures/page/elements.js";
import { degrees } from "../../../pictures/page/numbers.js";
import { slowness } from "../../../pictures/page/player.js";
import { newestOnly } from "../model/link.js";
import { FiguresCard } from "./card.js";
import { BROWSER_FRAMES, LessonClock, SupportSpeed } from "./clock.js";
import { LessonDiagrams } from "./diagrams.js";
import { lengthText, turnText } from "./entries.js";
import { LessonFields } from "./fields.js";
import { LessonFigure } from "./figure.js";
import { GroundBar } from "./ground_bar.js";
import { layOut } from "./layout.js";
import { LessonDial } from "./lesson_dial.js";
import { listenToGestures } from "./lesson_gestures.js";
import { lessonKeys } from "./lesson_keys.js";
import { sayLesson } from "./lesson_words.js";
import { withinTurn } from "./motion.js";
import { askForMotion, scaledDesign } from "./requests.js";
import { ShowPanel } from "./show_panel.js";
import { reachable } from "./travel.js";
import { lessonWarning, WarningCard } from "./warning.js";

const AROUND_ONCE = 2 * Math.PI;
/** Figure 8 of the paper, from 60° before the crank's pin is farthest from D. */
const FIGURE_8 = { l1: 1, l2: 4.5, l3: 1.5, l4: 4.995, start: -Math.PI / 3, speed: 2, least: 0.2, friction: null };
const FIRST_SWITCHES = {
  ...{ paths: true, velocities: false, accelerations: false },
  ...{ diagrams: true, positions: true, givesWay: true },
};

export class Lesson {
  #ask;
  #design = FIGURE_8;
  #isRelative = true;
  /** Of the crank, when lengths were last in metres. */
  #crank = 1;
  #motion = null;
  #pose = null;
  #phi1 = FIGURE_8.start;
  #groundSpeed = 0;
  #switches = { ...FIRST_SWITCHES };
  #chosen = ["C", "B"];
  #isDead = false;
  /** Answers to what was asked before another Apply are not for the present design. */
  #revision = 0;
  #isClosed = false;

  /**
   * @param {HTMLElement} host an empty element of class "lesson"
   * @param {(kind: string, fields: Object) => Promise<{header: Object, arrays: Object}|null>} ask
   * @param {import("./clock.js").Frames} [frames]
   */
  constructor(host, ask, frames = BROWSER_FRAMES) {
    this.host = host;
    this.#ask = ask;
    this.frames = frames;
    this.clock = new LessonClock((seconds) => this.#step(seconds), frames);
    this.supportSpeed = new SupportSpeed();
    this.fields = new LessonFields({
      apply: () => this.apply(),
      run: () => this.start(),
      stop: () => this.stop(),
      unit: (isRelative) => this.#changeUnit(isRelative),
    });
    this.fields.keep(this.#design, this.#design.least, true);
    this.bar = new GroundBar();
    this.panel = new ShowPanel(this.#switches, this.#chosen, {
      switched: (key, isOn) => this.#switch(key, isOn),
      chosen: (names) => this.#choose(names),
    });
    this.warning = new WarningCard();
    this.card = new FiguresCard();
    this.dial = new LessonDial((phi1) => this.seek(phi1));
    const seek = (phi1) => this.seek(phi1 + AROUND_ONCE * Math.round((this.#phi1 - phi1) / AROUND_ONCE));
    this.diagrams = new LessonDiagrams(seek);
    this.drags = newestOnly(() => this.#askForDrag());
    /** Settled when the first picture is there. */
    this.ready = this.#begin();
  }

  async #begin() {
    try {
      const motion = await this.#request(this.#design, this.#phi1, 0);
      this.#take(motion, true);
    } catch (error) {
      this.fields.refuse(error);
      if (!this.#isClosed) this.host.replaceChildren(this.fields.element);
      return;
    }
    if (this.#isClosed) return;
    this.fields.general.hidden = true;
    const { fields, bar, panel, warning, card, dial, figure } = this;
    const picture = figure.element;
    const diagrams = this.diagrams.elements;
    this.parts = layOut(this.host, { fields, bar, panel, picture, warning, card, dial, diagrams }, () => this.fit());
    listenToGestures(figure, { phi1: () => this.#phi1, seek: (phi1) => this.seek(phi1) });
    this.closeKeys = lessonKeys(this.host, this);
    this.resizes = new ResizeObserver(() => this.#resize());
    for (const element of [figure.element, this.parts.charts]) this.resizes.observe(element);
    figure.set(this.#switches);
    this.#resize();
    this.#show();
    this.#tell();
  }

  // What tests and the studio read.

  get isRunning() {
    return this.clock.isRunning;
  }

  get phi1() {
    return this.#phi1;
  }

  get l4() {
    return this.#design.l4;
  }

  get design() {
    return { ...this.#design };
  }

  get motion() {
    return this.#motion;
  }

  /** The figures now: angles rad, lengths and rates in the unit of lengths. */
  get figures() {
    const { speed } = this.#design;
    const points = this.#motion.points(this.#pose);
    const of = (write) => Object.fromEntries(Object.entries(points).map(([name, state]) => [name, write(state)]));
    return {
      ...this.#motion.figures(this.#pose),
      groundSpeed: this.#groundSpeed,
      places: of(({ x, y }) => [x, y]),
      speeds: of(({ x1, y1 }) => [x1 * speed, y1 * speed]),
      accelerations: of(({ x2, y2 }) => [x2 * speed * speed, y2 * speed * speed]),
    };
  }

  // What is done.

  /** Run. */
  start() {
    if (this.isRunning) return;
    // The first answer did not come: once more.
    if (!this.#motion) return void (this.ready = this.#begin());
    this.card.hide();
    this.#isDead = false;
    this.supportSpeed.clear();
    this.#groundSpeed = 0;
    this.clock.start();
    this.#tell();
  }

  /** Stop, and show the figures of this instant. */
  stop() {
    if (!this.#motion) return;
    this.clock.stop();
    this.#show();
    this.#tell();
    this.#showFigures();
  }

  toggle() {
    if (this.isRunning) this.stop();
    else this.start();
  }

  /** Take what is typed: checked, and the drawing fitted to it. */
  async apply() {
    if (!this.fields.isValid) return;
    let design = this.fields.design;
    // Lengths relative to the crank: its own is 1.
    if (this.#isRelative) design = scaledDesign(design, 1 / design.l1);
    const isElsewhere = design.start !== this.#design.start || !this.isRunning;
    const revision = (this.#revision += 1);
    const { typed } = this.fields;
    try {
      const phi1 = isElsewhere ? design.start : this.#phi1;
      const motion = await this.#request(design, phi1, 0);
      // Another took its place: its answer is the picture.
      if (revision !== this.#revision) return;
      this.#design = { ...design, least: motion.header.gamma_min };
      this.#phi1 = isElsewhere ? phi1 : this.#phi1;
      this.#groundSpeed = 0;
      this.#isDead = false;
      this.card.hide();
      this.diagrams.clear();
      this.#take(motion, true);
      this.fit();
      this.fields.keep(this.#design, this.#design.least, this.#isRelative, typed);
      this.#tell();
    } catch (error) {
      if (revision === this.#revision) this.fields.refuse(error);
    }
  }

  /** Go to a crank angle by hand. */
  seek(phi1) {
    this.card.hide();
    this.#go(phi1);
    this.#show();
    this.#tell();
  }

  /** Turn by an angle, rad. */
  turn(by) {
    const from = this.#phi1;
    this.seek(from + by);
    this.diagrams.record(from, this.#phi1);
  }

  /** Move the support: l4, in the unit of lengths. */
  moveSupport(l4) {
    const [low, high] = this.bar.range;
    const now = this.frames.now() / 1000;
    this.supportSpeed.note(this.#design.l4, now - 1e-6);
    this.#design = { ...this.#design, l4: Math.min(Math.max(l4, low), high) };
    this.supportSpeed.note(this.#design.l4, now);
    this.fields.follow(this.#design.l4);
    this.bar.show(this.#design.l4);
    if (!this.isRunning) this.#groundSpeed = 0;
    this.card.hide();
    this.#isDead = false;
    this.drags.push(null);
  }

  /** Show all of the motion, below what is said. */
  fit() {
    const { element } = this.warning;
    this.figure.fit(element.hidden ? 0 : element.offsetTop + element.offsetHeight);
  }

  /** Let it go: no clock, no listeners, an empty host. */
  close() {
    this.clock.stop();
    this.closeKeys?.();
    this.resizes?.disconnect();
    this.#revision += 1;
    this.#isClosed = true;
    this.host.replaceChildren();
  }

  // What follows.

  #request(design, phi1, groundSpeed) {
    return askForMotion(this.#ask, design, phi1, groundSpeed);
  }

  async #askForDrag() {
    const revision = this.#revision;
    try {
      const motion = await this.#request(this.#design, this.#phi1, this.isRunning ? this.#groundSpeed : 0);
      if (revision === this.#revision) this.#take(motion, false);
    } catch (error) {
      if (revision === this.#revision) this.fields.refuse(error);
    }
  }

  async #showFigures() {
    const revision = this.#revision;
    const phi1 = this.#phi1;
    try {
      const motion = await this.#request(this.#design, phi1, this.#groundSpeed);
      if (revision !== this.#revision || this.isRunning || phi1 !== this.#phi1) return;
      const { position, instant } = motion.header;
      if (position.joints.C.value.every((x) => x !== null)) {
        const unit = this.#isRelative ? "" : "m";
        const isHeld = !this.#switches.givesWay;
        this.card.show(position, { phi1, unit, pushes: instant.pushes, isHeld, chosen: this.#chosen });
      }
    } catch (error) {
      this.fields.refuse(error);
    }
  }

  /** Take an answer into all parts. */
  #take(motion, isFitted) {
    this.#motion = motion;
    this.#pose = motion.pose();
    this.figure ??= new LessonFigure(motion, {
      began: () => this.supportSpeed.clear(),
      dragged: (l4) => this.moveSupport(l4),
      ended: () => this.#released(),
    });
    this.figure.replace(motion, isFitted);
    if (isFitted) this.bar.replace(motion.header, this.#design.l4);
    this.dial.replace(motion.asked.start, motion.stretches);
    this.diagrams.replace(motion, this.#switches.givesWay);
    this.#show();
  }

  /** The support was let go: what it is now may ask for another view. */
  async #released() {
    await this.drags.settled();
    const [x0] = this.#motion.bounds;
    if (this.figure.view.px(x0, 0)[0] < 8) this.fit();
    this.#tell();
  }

  #changeUnit(isRelative) {
    if (isRelative === this.#isRelative) return;
    if (isRelative) this.#crank = this.#design.l1;
    this.#isRelative = isRelative;
    // What is typed goes along.
    const design = this.fields.isValid ? this.fields.design : this.#design;
    this.#design = scaledDesign(design, isRelative ? 1 / this.#crank : this.#crank);
    this.fields.keep(this.#design, this.#design.least, isRelative);
    this.apply();
  }

  #switch(key, isOn) {
    this.#switches[key] = isOn;
    if (key === "diagrams") this.host.classList.toggle("lesson-no-diagrams", !isOn);
    else this.figure.set({ [key]: isOn });
    if (key === "givesWay") this.diagrams.replace(this.#motion, isOn);
    this.#isDead = false;
    this.#show();
    // With the support held the picture needs the figures of this place.
    if (key === "givesWay") this.drags.push(null);
  }

  #choose(names) {
    this.#chosen = names;
    this.figure.choose(names);
    this.card.hide();
  }

  /** Go on by a time of the screen, s. */
  #step(seconds) {
    const { speed } = this.#design;
    const slower = slowness(AROUND_ONCE, speed);
    this.#groundSpeed = this.supportSpeed.at(this.frames.now() / 1000) * slower;
    const from = this.#phi1;
    const isFree = this.#go(from + (speed * seconds) / slower);
    this.diagrams.record(from, this.#phi1);
    this.#show();
    if (!isFree) this.stop();
  }

  /** Go as far as it goes; returns whether it went all the way. */
  #go(phi1) {
    const { givesWay } = this.#switches;
    const all = { to: phi1, isStopped: false };
    const { to, isStopped } = givesWay ? all : reachable(this.#motion.stretches, this.#phi1, phi1);
    this.#isDead = givesWay && !this.#motion.sample(to, this.#pose).known;
    if (!this.#isDead) this.#phi1 = to;
    return !isStopped && !this.#isDead;
  }

  /** Show everything that moves. */
  #show() {
    const { speed, l4 } = this.#design;
    const { givesWay } = this.#switches;
    const motion = this.#motion;
    const pose = motion.sample(this.#phi1, this.#pose, this.#groundSpeed / speed);
    const isLocked = pose.stretch.side !== null;
    this.host.classList.toggle("lesson-running", this.isRunning);
    if (isLocked && !givesWay && motion.asked.phi1 === this.#phi1) motion.held(this.#phi1, pose);
    const unit = this.#isRelative ? "l₁" : "m";
    this.figure.show(pose, { speed, isLocked, givesWay, l4, unit });
    const figures = motion.figures(pose);
    const turns = Math.floor(Math.abs(this.#phi1 - this.#design.start) / AROUND_ONCE + 1e-9);
    this.dial.show(this.#phi1, sayLesson("turn", { n: 1 + turns }));
    this.diagrams.show(this.#phi1, figures);
    const state = { phi1: this.#phi1, speed, givesWay, isDead: this.#isDead };
    this.warning.show(lessonWarning(motion, state));
  }

  /** Say what is not said at every frame. */
  #tell() {
    this.dial.tell(withinTurn(this.#phi1, this.#motion.asked.start));
    const { gamma, phi3, l4, side } = this.#motion.figures(this.#pose);
    const angles = { angle: turnText(this.#phi1), phi3: degrees(phi3) };
    const values = { ...angles, gamma: lengthText(Number(gamma.toFixed(4))), l4: lengthText(l4) };
    const word = side && this.#switches.givesWay ? "pictureSliding" : "picture";
    put(this.figure.element, "aria-label", sayLesson(word, values));
    if (!this.parts) return;
    this.parts.status.textContent = this.isRunning ? sayLesson("running") : sayLesson("stoppedAt", values);
    this.fields.runs(this.isRunning);
    const slower = slowness(AROUND_ONCE, this.#design.speed);
    this.dial.slower.textContent = slower > 1 ? sayLesson("slower", { n: slower }) : "";
  }

  #resize() {
    const { width, height } = this.figure.element.getBoundingClientRect();
    this.figure.resize(width, height);
    this.fit();
    this.diagrams.resize();
  }
}
