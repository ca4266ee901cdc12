// Puts the studio together: the model, the picture, what plays, tools, panel, keys.

import { Canvas } from "../../pictures/page/canvas.js";
import { Gestures, isZoom } from "../../pictures/page/drag.js";
import { driving } from "../../pictures/page/driving.js";
import { html } from "../../pictures/page/elements.js";
import { listenForKeys, playingKey } from "../../pictures/page/keys.js";
import { tellPosition, whatIsWrong } from "../../pictures/page/main.js";
import { Playback } from "../../pictures/page/playback.js";
import { learn, say, speak, spoken } from "../../pictures/page/words.js";
import { Bar } from "./window/bar.js";
import { Beginning } from "./build/beginning.js";
import { Builder } from "./build/builder.js";
import { withInputSpeed } from "./document/drivers.js";
import { parseQuantity } from "./document/units.js";
import { Mend } from "./build/mend.js";
import { Designing } from "./design/designing.js";
import { FindSection } from "./design/findsection.js";
import { MapSection } from "./design/mapsection.js";
import { Projector } from "./design/projector.js";
import { DesignSection } from "./design/section.js";
import { TargetSection } from "./design/targetsection.js";
import { JointDrag } from "./window/dragging.js";
import { forceSections } from "./forces/sections.js";
import { keep } from "./window/files.js";
import { openHelp } from "./help/help.js";
import { LessonScreen } from "./window/lesson_screen.js";
import { Model } from "./model/model.js";
import { AssemblySection } from "./panel/assemblies.js";
import { DimensionSection } from "./panel/dimensions.js";
import { DriverSection } from "./panel/drivers.js";
import { StructureSection } from "./panel/groups.js";
import { Highlight } from "./panel/highlight.js";
import { NameSection } from "./panel/naming.js";
import { PositionSection } from "./panel/position.js";
import { problemText } from "./panel/problem.js";
import { TransmissionWarning } from "./panel/transmission.js";
import { Shell } from "./window/shell.js";
import { Status } from "./window/status.js";
import { BUILD_WORDS } from "./words/build.js";
import { DESIGN_WORDS } from "./words/design.js";
import { DRIVE_WORDS } from "./words/drive.js";
import { FIELD_WORDS } from "./words/fields.js";
import { FRAME_WORDS } from "./words/frame.js";
import { HELP_WORDS } from "./words/help.js";
import { LOADS_WORDS } from "./words/loads.js";
import { PANEL_WORDS } from "./words/panel.js";
import { PICTURE_WORDS } from "./words/picture.js";
import { RUN_WORDS } from "./words/run.js";

/** So long it is told how the wheel zooms, ms. */
const WHEEL_TOLD = 2500;

const TABLES = [PICTURE_WORDS, FRAME_WORDS, FIELD_WORDS, PANEL_WORDS, BUILD_WORDS, DESIGN_WORDS, HELP_WORDS];
for (const words of [...TABLES, LOADS_WORDS, DRIVE_WORDS, RUN_WORDS]) learn(words);

export class Studio {
  /**
   * @param {HTMLElement} root
   * @param {import("./model/link.js").Link} link
   * @param {Object} start what `start` answered
   */
  constructor(root, link, start) {
    this.root = root;
    this.start = start;
    this.model = new Model(link);
    this.isEmbedded = root.classList.contains("embedded");
    this.model.drawAsSketch();
    this.#build();
  }

  /** Make the window anew: in the beginning, and in another language. */
  #build() {
    const { root, model } = this;
    model.listeners.clear();
    const { data, turn } = model;
    this.canvas = new Canvas(root, data, turn);
    const { stage } = this.canvas;
    this.playback = new Playback(data, turn, {
      show: (pose) => {
        const { playback } = this;
        // A sketch has no coordinate: what was held stays.
        if (model.run) model.shownRun.follow(playback.q);
        else if (!model.isSketch) model.q = playback.q;
        stage.show(pose, playback.player.speed * playback.player.sense);
        this.canvas.warn(this.#whatIsWrong());
        model.emit("pose", pose);
      },
      told: () => {
        if (model.isSketch) this.#tellSketch();
        else tellPosition(this.canvas, this.playback);
        model.emit("told");
      },
      paced: (speed) => this.pace(speed),
      readSpeed: parseQuantity,
    });
    this.bar = new Bar(root, model, this);
    this.status = new Status(model);
    this.canvas.cover(this.status.element);
    this.highlight = new Highlight(stage);
    this.caution = new TransmissionWarning(this);
    this.canvas.cover(this.caution.element);
    this.later = html("p", { class: "later" }, say("later"));
    this.playback.element.append(this.later);
    this.shell = new Shell(root, { bar: this.bar.element, canvas: this.canvas.element, dock: this.playback.element });
    for (const one of this.#sections()) this.shell.panel.append(one.element);
    this.builder?.end();
    this.builder = new Builder(this);
    this.beginning = new Beginning(this.builder);
    this.projecting = new Projector(this);
    const wasInLesson = this.lessonScreen?.isOpen;
    this.lessonScreen?.close();
    this.lessonScreen = new LessonScreen(this);
    this.joints = new JointDrag(model, this.canvas, this.playback, this.builder);
    this.gestures = new Gestures(this.canvas.picture, this.builder.press.handlers(this.#handlers()));
    this.#listen();
    stage.measure();
    this.resize();
    this.observer?.disconnect();
    this.observer = new ResizeObserver(() => this.resize());
    // The picture and the diagrams also change where what stands beside them does.
    for (const one of [root, this.canvas.picture, this.playback.chartRow]) this.observer.observe(one);
    this.#enable();
    if (wasInLesson) this.lesson();
    if (this.isKept) keep(model);
    this.onBuilt?.();
    this.playback.show();
  }

  /** The sections of the panel, from above. */
  #sections() {
    this.designing = new Designing(this);
    this.target = new TargetSection(this);
    this.design = new DesignSection(this, this.designing);
    this.map = new MapSection(this, this.designing);
    const numbers = [Mend, DriverSection, DimensionSection, FindSection, AssemblySection, PositionSection].map((One) => new One(this));
    const design = [this.map, this.design, this.target];
    const { above, below } = forceSections(this);
    return [...above, ...numbers, ...below, ...design, new StructureSection(this), new NameSection(this)];
  }

  /** A drawing has no position to tell. */
  #tellSketch() {
    const { joints, links } = this.model.data;
    const text = say("sketchPicture", { joints: joints.length, links: links.length - 1 });
    this.canvas.picture.setAttribute("aria-label", text);
  }

  #whatIsWrong() {
    const { model, playback } = this;
    if (model.problem) return problemText(model.problem, this);
    // Why it stops at a dead point stands over the picture already.
    if (model.isSketch || (this.caution?.tellsEnds && playback.pose.known)) return "";
    return whatIsWrong(playback);
  }

  #listen() {
    const { model, canvas, playback, root } = this;
    model.on("picture", () => {
      this.#replace(true);
      this.joints.passed();
    });
    // While something is dragged the picture is there already.
    model.on("turn", () => (model.isDragging && canvas.stage.turn === model.turn ? playback.draw() : this.#replace()));
    model.on("problem", () => canvas.warn(this.#whatIsWrong()));
    model.on("document", () => (root.dataset.state = model.checked.state));
    model.on("checked", () => (root.dataset.state = model.checked.state));
    model.on("connection", () => {
      root.classList.toggle("offline", !model.link.isOpen);
      if (model.link.isOpen) this.dismiss("offline");
      else this.notify(say("offline"), { kind: "offline" });
    });
    this.#keys?.();
    this.#keys = listenForKeys(root, (key, isShift, target) => this.#key(key, isShift, target));
  }

  #keys = null;

  /** Take the turn of the model. */
  #replace(isPassing = false) {
    const { model, canvas, playback } = this;
    playback.replace(model.data, model.turn, model.run ? model.turn.low : model.q, isPassing);
    canvas.replace(model.data, model.turn);
    if (model.isNew) {
      model.isNew = false;
      canvas.stage.fit();
      playback.player.turns = 0;
      playback.player.sense = 1;
      playback.setSpeed(this.#ownSpeed);
    }
    // What has grown out of the window comes back into it, unless a hand holds it or has placed the view.
    else if (canvas.stage.isFitted && !model.isDragging && !canvas.stage.isWithin()) canvas.stage.fit();
    // A run has a pace of its own, and a speed that is being typed is not yet that of the document.
    const isPaced = !model.run && !model.isDragging && !playback.isTypingSpeed;
    if (isPaced && playback.player.speed !== this.#ownSpeed) playback.setSpeed(this.#ownSpeed);
    if (model.isSketch) playback.pause();
    this.#enable();
    playback.show();
    if (!model.isDragging) playback.tell();
  }

  /** The speed of the document; without one a turn takes a few seconds. */
  get #ownSpeed() {
    const { model } = this;
    return model.inputSpeed ?? model.data.speed;
  }

  /** What does not move cannot be played. */
  #enable() {
    const { model, playback } = this;
    playback.play.disabled = playback.home.disabled = model.isSketch;
    this.later.hidden = !model.isSketch;
    playback.element.classList.toggle("still", model.isSketch);
  }

  #handlers() {
    const { canvas, playback, joints, model } = this;
    const links = driving(canvas, playback);
    const { view } = canvas.stage;
    return {
      ...links,
      grip: (x, y, isTouch) => {
        const joint = model.link.isOpen ? joints.grip(x, y, isTouch) : null;
        if (joint) return joint;
        return model.isSketch ? null : links.grip(x, y, isTouch);
      },
      move: (grip, x, y) => (grip.joint ? joints.move(grip, view.m(x, y)) : links.move(grip, x, y)),
      drop: (grip) => (grip.joint ? joints.drop(grip) : links.drop(grip)),
      cancel: (grip) => (grip.joint ? joints.cancel(grip) : links.drop(grip)),
      takesWheel: (event) => !this.isEmbedded || isZoom(event) || this.#tellWheel(),
    };
  }

  /** A wheel over a cell scrolls the notebook; who works in the cell is told how to zoom. */
  #tellWheel() {
    if (this.root.contains(this.root.getRootNode().activeElement)) {
      this.notify(say("wheelZooms"), { kind: "wheel" });
      clearTimeout(this.#wheelTold);
      this.#wheelTold = setTimeout(() => this.dismiss("wheel"), WHEEL_TOLD);
    }
    return false;
  }

  #wheelTold = 0;

  #key(key, isShift, target) {
    const { model, gestures } = this;
    // The lesson has keys of its own.
    if (this.lessonScreen.isOpen) return key === "?" ? () => this.help() : null;
    if (key === "Escape") {
      if (gestures.isGripping) return () => gestures.cancel();
      if (this.target.sheet.isOn) return () => this.target.open(false);
      if (this.projecting.isOn) return () => this.projector();
    }
    if (target.closest?.("[role=menu], [role=tablist], dialog")) return null;
    const drawing = this.builder.key(key, isShift, target);
    if (drawing) return drawing;
    if (key === "Escape") return null;
    const keys = { f: () => this.projector(), "?": () => this.help() };
    if (keys[key]) return keys[key];
    return model.isSketch && key !== "0" ? null : playingKey(this.playback, this.canvas.stage, key, isShift);
  }

  // -- what parts of the window ask of it --------------------------------------

  notify = (text, options) => this.shell.notify(text, options);

  dismiss = (kind) => this.shell.dismiss(kind);

  /** Give the driver a speed: a step that can be undone. */
  pace(speed) {
    const { model } = this;
    const others = model.inputSpeed ?? model.data.speed;
    return model.edit(withInputSpeed(model.document, model.axis, speed, others));
  }

  speed = () => this.playback.player.speed;

  lesson() {
    this.lessonScreen.open();
  }

  /** Open the help, perhaps at a term. */
  help(term) {
    openHelp(this, term);
  }

  projector() {
    this.projecting.toggle();
  }

  /** Keep the document in this browser from now on, also in another language. */
  keep() {
    this.isKept = true;
    keep(this.model);
  }

  /** Begin with nothing. */
  begin() {
    this.builder.take("select");
    this.model.file = null;
    this.model.isNew = true;
    return this.model.edit({ joints: {}, links: { ground: [] } }, { title: "" });
  }

  /** Speak another language: the window is made anew, the document stays. */
  speak(code) {
    speak(code);
    document.documentElement.lang = spoken();
    // The picture that is dragged will be gone.
    this.model.previews.finish();
    const { speed, q } = this.playback.player;
    this.playback.pause();
    this.#build();
    this.playback.setSpeed(speed);
    this.playback.seek(q);
  }

  resize() {
    this.canvas.resize();
    this.playback.resize();
    this.builder.resize();
  }
}

/**
 * Show the studio.
 * @param {HTMLElement} root
 * @param {import("./model/link.js").Link} link that is open
 */
export async function openStudio(root, link) {
  const { header } = await link.ask("start", 0, {});
  link.most = header.limits.up;
  return new Studio(root, link, header);
}

/** Show a text in place of the page. */
export function showFailure(root, text) {
  root.replaceChildren(html("p", { class: "failure", role: "alert" }, text));
}
