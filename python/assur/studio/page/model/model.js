// The document and what the server says of it: one truth that every part of the page shows.

import { Turn } from "../../../pictures/page/turn.js";
import { History } from "./history.js";
import { passing } from "./passing.js";
import { Previews, ROWS_DRAGGED } from "./previews.js";
import { ShownRun } from "./shown_run.js";
import { inputSpeed } from "../document/drivers.js";
import { sketchScene } from "../document/sketch.js";

/** Rows of a turn at rest. */
const ROWS = 361;
/** How long to wait for a server that is busy, ms. */
const SERVER_BUSY_WAIT = 400;

/**
 * What a document says: see `check` in docs/developers/studio_protocol.md.
 * @typedef {{state: string, message: string, counted: Object, structure: Object | null,
 *   remedies: {text: string, document: Object}[], concerned?: Object, candidates?: string[]}} Checked
 */

/**
 * Events: `document` it changed; `picture` another turn is seen while something is dragged; `checked` its state is known; `turn` there is another turn to play;
 * `target` another path is wanted;
 * `problem` the present numbers cannot be shown, or can again; `file` title or stamp changed;
 * `connection` it was lost, or is there again; `settled` nothing is being dragged or computed;
 * `run` a motion over time is shown, or no longer.
 */
export class Model {
  /** @param {import("./link.js").Link} link */
  constructor(link) {
    this.link = link;
    this.document = { joints: {}, links: { ground: [] } };
    this.title = "";
    /** Of the file that the command was given: its stamp, and whether `save` writes it. */
    this.file = null;
    this.rev = 0;
    this.history = new History();
    /** @type {Checked} */
    this.checked = { state: "empty", message: "", counted: {}, structure: null, remedies: [] };
    /** The page's data and the turn that are shown; `isSketch` if the document does not move. */
    this.data = null;
    this.turn = null;
    this.isSketch = true;
    this.dimensions = [];
    /** At rest: the least transmission angles over the turn, and where several drivers can go. */
    this.transmission = null;
    this.reach = null;
    /** The output whose sensitivities are shown; by default the usual one. */
    this.output = undefined;
    /** Why the present document is not what is shown: an error, or null. */
    this.problem = null;
    /** Coordinates of all drivers; the one that moves is number `axis`. */
    this.held = [0];
    this.axis = 0;
    /** The path that a point should take: see design/deviation.js. */
    this.target = null;
    this.listeners = new Map();
    this.previews = new Previews(this);
    this.shownRun = new ShownRun(this);
  }

  /** While something is dragged the picture follows at once; fields and diagrams in turn. */
  #pass = passing([() => this.emit("document"), () => this.emit("turn")]);
  /** The document whose turn is shown. */
  #shown = null;

  /** Call a function at an event; returns one that ends it. */
  on(name, listener) {
    const all = this.listeners.get(name) ?? new Set();
    this.listeners.set(name, all.add(listener));
    return () => all.delete(listener);
  }

  emit(name, detail) {
    for (const listener of this.listeners.get(name) ?? []) listener(detail);
  }

  /** Send a request about the present document. */
  ask(kind, fields = {}) {
    return this.link.ask(kind, this.rev, { document: this.document, ...fields });
  }

  /** Whether a gesture is under way. */
  get isDragging() {
    return this.previews.isDragging;
  }

  /** The motion over time that is shown in place of the turn: see `run` of the protocol; or null. */
  get run() {
    return this.shownRun.answer;
  }

  get moves() {
    return this.checked.state === "moves";
  }

  get driverCount() {
    const { driver } = this.document;
    return Array.isArray(driver) ? driver.length : 1;
  }

  /** Where the drivers are, as requests want it. */
  get place() {
    return this.driverCount > 1 ? [...this.held] : this.held[0];
  }

  /** The coordinate of the driver that moves. */
  get q() {
    return this.held[this.axis];
  }

  /** The speed that the document gives the driver that moves, rad/s or m/s; null without one. */
  get inputSpeed() {
    return inputSpeed(this.document, this.axis);
  }

  set q(value) {
    this.held[this.axis] = value;
  }

  /** What a step of undo brings back. */
  snapshot() {
    return { document: this.document, title: this.title, place: [...this.held] };
  }

  /** Show another document: a step that can be undone. */
  async edit(document, { place, title } = {}) {
    this.history.push(this.previews.before ?? this.snapshot());
    this.previews.leave();
    if (title !== undefined) this.title = title;
    await this.become(document, place);
  }

  async undo() {
    // What is under way is what is undone first.
    if (!this.previews.isOver) return this.previews.cancel();
    this.previews.finish();
    return this.#go(this.history.undo(this.snapshot()));
  }

  async redo() {
    this.previews.finish();
    return this.#go(this.history.redo(this.snapshot()));
  }

  async #go(snapshot) {
    if (!snapshot) return;
    this.title = snapshot.title;
    await this.become(snapshot.document, snapshot.place);
    this.emit("file");
  }

  /** Be another document: no step of undo by itself. */
  async become(document, place) {
    this.shownRun.end();
    this.document = document;
    this.rev += 1;
    if (place !== undefined) this.held = Array.isArray(place) ? [...place] : [place];
    this.emit("document");
    await this.look();
  }

  /** Want another path, or none: no part of the document. */
  setTarget(target) {
    this.target = target;
    this.emit("target");
  }

  /** Open an example, a text or the file given to the command: see `open` of the protocol. */
  async open(fields) {
    const { header } = await this.link.ask("open", this.rev, fields);
    this.file = fields.file ? { stamp: header.stamp, saves: header.saves } : null;
    this.axis = 0;
    this.isNew = true;
    this.setTarget(null);
    this.emit("opened");
    await this.edit(header.document, { place: header.q0, title: header.title });
    this.emit("file");
    return header;
  }

  // -- what the server says ---------------------------------------------------

  /** Ask what the document is, and for its turn. */
  async look() {
    const { rev } = this;
    await Promise.all([this.#check(rev), this.#turn(rev)]);
    if (rev === this.rev) this.emit("settled");
  }

  /** Ask; while the server is busy with what took too long, again a little later. */
  async #patiently(rev, kind, fields) {
    while (rev === this.rev) {
      try {
        return await this.ask(kind, fields);
      } catch (error) {
        if (error.kind !== "busy") throw error;
      }
      await new Promise((resolve) => setTimeout(resolve, SERVER_BUSY_WAIT));
    }
    return null;
  }

  async #check(rev) {
    try {
      const answer = await this.#patiently(rev, "check");
      if (!answer || rev !== this.rev) return;
      this.checked = answer.header;
      if (!this.moves) this.#sketch();
      this.emit("checked");
    } catch (error) {
      if (rev !== this.rev || error.kind === "disconnected") return;
      // What was said of another document is not true of this one.
      this.checked = { state: "unchecked", message: error.message, counted: {}, structure: null, remedies: [] };
      // More than the server takes is more than can be drawn.
      if (this.#shown !== this.document && !error.kind?.startsWith("too_")) this.#sketch();
      this.fail(error);
      this.emit("checked");
    }
  }

  /**
   * Ask for the turn. A document without a driver has none: it is drawn at once, so that what is
   * pressed next lands in its picture and not in the one before.
   */
  async #turn(rev) {
    if (!this.document.driver || !this.document.driver.length) return this.#sketch();
    try {
      const rows = this.isDragging ? { rows: ROWS_DRAGGED, orders: 2 } : { rows: ROWS };
      const answer = await this.#patiently(rev, "turn", { q: this.#known(), ...rows, axis: Math.min(this.axis, this.driverCount - 1) });
      if (!answer || rev !== this.rev) return;
      this.show(answer, undefined);
    } catch (error) {
      // Of what does not move `check` has said it by now.
      if (rev === this.rev && (this.moves || error.kind === "time_limit")) this.fail(error);
    }
  }

  /** The coordinates that fit the drivers; of others the drawing's. */
  #known() {
    return this.held.length === this.driverCount ? this.place : undefined;
  }

  /** Show a turn that was answered; a drag also says where the drivers are. */
  show({ header, arrays }, place) {
    const { payload } = header;
    const wasRun = this.run !== null;
    this.shownRun.forget();
    this.data = { ...payload, title: this.title, turn: { ...payload.turn, values: arrays.values } };
    this.turn = new Turn(this.data.turn);
    this.dimensions = header.dimensions;
    this.transmission = header.transmission ?? null;
    this.reach = header.reach ?? null;
    this.isSketch = false;
    this.#shown = this.document;
    if (place !== undefined) this.held = Array.isArray(place) ? [...place] : [place];
    else if (this.held.length !== this.driverCount) {
      const { q0 } = this.checked;
      this.held = Array.isArray(q0) ? [...q0] : [payload.turn.at];
    }
    this.#solve(null);
    if (this.isDragging) {
      this.emit("picture");
      this.#pass();
    } else this.emit("turn");
    if (wasRun) this.emit("run");
  }

  #sketch() {
    this.drawAsSketch();
    this.#solve(null);
    this.emit("turn");
  }

  /** Draw what does not move as it is drawn. */
  drawAsSketch() {
    this.data = { ...sketchScene(this.document), title: this.title };
    this.turn = new Turn(this.data.turn);
    this.dimensions = [];
    this.isSketch = true;
  }

  /** Say why the present document cannot be shown. */
  fail(error) {
    if (error.kind === "disconnected") return;
    this.#solve(error);
  }

  #solve(error) {
    if (this.problem === null && error === null) return;
    this.problem = error;
    this.emit("problem");
  }

  /** Move another of several drivers. */
  async setAxis(axis) {
    this.axis = axis;
    this.rev += 1;
    await this.look();
  }

  // -- files -------------------------------------------------------------------

  /** Write the document to the file of the command. */
  async save(force = false) {
    const { file, document } = this;
    if (!file) return;
    const { header } = await this.ask("save", { stamp: file.stamp, ...(force ? { force } : {}) });
    file.stamp = header.stamp;
    // It may have changed while it was written.
    this.savedDocument = document;
    this.emit("file");
  }
}
