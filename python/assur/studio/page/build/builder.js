// Drawing by hand: the tool that is taken, and how the document takes what it makes.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { allLinks, tableOf } from "../document/names.js";
import { placeOf } from "../document/structure.js";
import { Aim } from "./aim.js";
import { Choice } from "./choice.js";
import { Cursor } from "./cursor.js";
import { Marking } from "./marking.js";
import { Overlay } from "./overlay.js";
import { Press } from "./press.js";
import { Rail } from "./rail.js";
import { asSeen } from "./seen.js";
import { listenForEdits, toolKey } from "./shortcuts.js";
import { joinedTo } from "./steps.js";
import { makeTools } from "./tools.js";

/** Where the hint stands: over the scale bar, over the switches, px. */
const HINT_FOOT = 38;
const HINT_LEAST = 54;

export class Builder {
  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    const { model, canvas, playback } = studio;
    Object.assign(this, { studio, model, canvas, playback });
    this.tools = makeTools(() => model.document);
    /** Name of the tool, "select" if none. */
    this.name = "select";
    /** What is under the pointer, as the tool is told, and where a dragged joint goes. */
    this.spot = this.aimed = null;
    this.aim = new Aim(model, canvas, playback);
    this.overlay = new Overlay(canvas.stage);
    this.marking = new Marking(this);
    this.choice = new Choice(this);
    this.cursor = new Cursor(this);
    this.press = new Press(this);
    this.hint = html("p", { class: "tool-hint" });
    canvas.element.append(this.hint);
    this.rail = new Rail(studio.shell.rail, (name) => this.take(name));
    canvas.stage.overlays.push(this);
    model.on("document", () => this.#forget());
    // A mechanism that was opened is looked at first.
    model.on("opened", () => this.take("select"));
    this.end = listenForEdits(studio, this.choice);
    this.take("select");
  }

  #busy = null;
  #waiting = [];

  get tool() {
    return this.tools[this.name] ?? null;
  }

  /** Take a tool; "select" lays it down. */
  take(name) {
    this.tool?.reset();
    this.name = name;
    this.spot = null;
    if (this.tool) this.choice.choose(null, false);
    this.rail.show(name);
    this.studio.root.dataset.tool = name;
    this.hint.textContent = this.tool ? say(`${name}Hint`) : "";
    this.marking.show();
    this.show();
    this.model.emit("tool");
  }

  /** Return what the tool is told of a point of the picture. */
  spotAt(x, y, isTouch = false) {
    return this.aim.spot(x, y, isTouch, this.tool?.ends[0]?.at);
  }

  /** The pointer, or the cursor of keys, is over a point of the picture. */
  hover(x, y) {
    this.when(() => {
      this.spot = this.spotAt(x, y);
      this.tool?.move(this.spot);
      this.show();
    });
  }

  /** Click at a point of the picture. */
  click(x, y) {
    this.when(() => this.press.drop({ tool: this.tool, at: [x, y], isTouch: false }));
  }

  /** What was begun is as if it had not been; a tool without anything begun is laid down. */
  escape() {
    if (this.tool?.isBegun) this.tool.reset();
    else if (this.tool) this.take("select");
    else this.choice.choose(null);
    this.show();
  }

  /** Finish what Enter finishes. */
  enter() {
    const change = this.tool?.enter();
    if (change) this.commit(change);
  }

  // -- changes of the document ---------------------------------------------------

  /** Whether a change is not yet the document's. */
  get isBusy() {
    return this.#busy !== null;
  }

  /** Do something once the document has taken the last change. */
  when(act) {
    if (this.#busy) this.#waiting.push(act);
    else act();
  }

  /** Change the document; what the pointer does meanwhile waits. */
  commit(change) {
    this.#busy = this.change(change).finally(() => {
      this.#busy = null;
      while (this.#waiting.length && !this.#busy) this.#waiting.shift()();
    });
  }

  /**
   * Change the document, as one step.
   * @param {import("./tool.js").Change} change
   */
  async change(change) {
    const { model, tool } = this;
    const before = await asSeen(model);
    const { document, joint } = change(before);
    tool?.done(joint, joint && placeOf(document, joint));
    // What is drawn stays where it is seen.
    this.canvas.stage.isFitted = false;
    if (document !== before) this.edited = model.edit(document, { place: [] });
    this.show();
  }

  #forget() {
    const { document } = this.model;
    const tables = [tableOf(document.joints), allLinks(document)];
    const isThere = (name) => tables.some((table) => Object.hasOwn(table, name));
    for (const tool of Object.values(this.tools)) tool.forget(isThere);
    this.show();
  }

  // -- a joint that is dragged -----------------------------------------------------

  /** Return where a dragged joint goes, and what it would be joined to: see `Aim.joint`. */
  aimJoint(joint, place, from) {
    this.aimed = this.aim.joint(joint, place, from);
    this.show();
    return this.aimed;
  }

  /** The joint is dropped: nothing is aimed at any more. */
  unaim() {
    this.aimed = null;
    this.show();
  }

  /** Return the document with a dragged joint joined to what was shown. */
  async joined(joint, target) {
    return joinedTo(await asSeen(this.model), joint, target);
  }

  // -- what is seen ------------------------------------------------------------------

  /** The window has another size: the hint stands above the scale bar. */
  resize() {
    const { element, picture, stage } = this.canvas;
    const under = element.clientHeight - picture.clientHeight;
    this.hint.style.bottom = `${under + Math.max(HINT_FOOT + stage.barFoot, under ? 0 : HINT_LEAST)}px`;
  }

  /** Draw grid, rings and what is begun where they are now. */
  show() {
    const { aimed, tool, spot, model } = this;
    this.overlay.hasGrid = Boolean(tool) || model.isSketch;
    const marked = { chosen: this.choice.place() };
    if (aimed) {
      const { target, joint, at, guide } = aimed;
      Object.assign(marked, { guide, ring: target ? at : null });
      if (target) marked.text = say("joinOffer", { a: joint, b: target.joint ?? target.link });
    } else if (tool) {
      const isCaught = spot && (spot.joint || spot.link);
      Object.assign(marked, tool.preview(), { guide: spot?.guide, ring: isCaught ? spot.at : null });
    }
    this.overlay.mark(marked);
  }

  /** What a key does: see `listenForKeys`. */
  key(key, isShift, target) {
    return this.choice.key(key, isShift, target) ?? toolKey(this, key, isShift, target);
  }
}
