// The joint, link or slide that is chosen: by a click or by Tab; what keys do to it.

import { pointState } from "../../../pictures/page/quantities.js";
import { say } from "../../../pictures/page/words.js";
import { moveJoint } from "../document/joints.js";
import { allLinks, tableOf } from "../document/names.js";
import { placeOf } from "../document/structure.js";
import { ItemField } from "./field.js";
import { driverToggled, groundToggled, slideOfBlock, withoutItem } from "./steps.js";

/** Arrow keys move a joint by so much, px; presses nearer in time than this are one step, ms. */
const NUDGE = 1;
const NUDGE_SHIFT = 10;
const NUDGE_PAUSE = 600;
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * @typedef {{kind: "joint" | "link" | "slide", name: string}} Item
 */

/** Return all that can be chosen, in the order in which Tab goes through it. */
export function itemsOf(document) {
  const named = (kind, names) => names.map((name) => ({ kind, name }));
  const links = Object.keys(allLinks(document)).filter((link) => link !== "ground" && !slideOfBlock(document, link));
  return [
    ...named("joint", Object.keys(tableOf(document.joints)).filter((joint) => placeOf(document, joint))),
    ...named("link", links),
    ...named("slide", Object.keys(tableOf(document.slides))),
  ];
}

/** Return the links of a joint, or the joints of a link, for who does not see them. */
export function neighboursOf(document, { kind, name }) {
  const links = allLinks(document);
  if (kind === "joint") return Object.keys(links).filter((link) => links[link].includes(name));
  if (kind === "link") return links[name] ?? [];
  const slide = tableOf(document.slides)[name] ?? {};
  return [slide.link ?? slide.base, slide.on ?? slide.end].filter(Boolean);
}

export class Choice {
  /** @param {import("./builder.js").Builder} builder */
  constructor(builder) {
    this.builder = builder;
    /** @type {Item | null} */
    this.item = null;
    this.field = new ItemField(builder, this);
    builder.model.on("document", () => this.#keep());
    builder.studio.root.addEventListener("pointerdown", () => this.finish(), { capture: true });
  }

  /** Choose something, or nothing. */
  choose(item, isTold = true) {
    this.finish();
    this.item = item;
    this.field.close();
    if (item && isTold) this.#tell();
    this.builder.marking?.show();
    this.builder.show();
  }

  #tell() {
    const { kind, name } = this.item;
    const of = neighboursOf(this.builder.model.document, this.item).join(", ");
    this.builder.canvas.status.textContent = say(`${kind}Told`, { name, of: of || say("nothingJoined") });
  }

  /** What was chosen may be gone. */
  #keep() {
    if (this.item && this.#indexIn(itemsOf(this.builder.model.document)) < 0) this.choose(null);
  }

  #indexIn(items) {
    return items.findIndex(({ kind, name }) => kind === this.item?.kind && name === this.item?.name);
  }

  /** Return the links that are chosen by it: its own, or those of a slide. */
  links() {
    if (!this.item || this.item.kind === "joint") return [];
    const { document } = this.builder.model;
    if (this.item.kind === "link") return [this.item.name];
    return Object.keys(allLinks(document)).filter((link) => slideOfBlock(document, link) === this.item.name);
  }

  /** Return where the chosen joint is seen, m, or null. */
  place() {
    return this.item?.kind === "joint" ? this.#jointAt(this.item.name) : null;
  }

  #jointAt(joint) {
    const { canvas, playback } = this.builder;
    const own = canvas.stage.data.joints.find(({ name }) => name === joint);
    if (!own || !playback.pose.known) return null;
    const { x, y } = pointState(playback.pose, own.link, own.at);
    return [x, y];
  }

  /** Return a place at the chosen item, m. */
  anchor() {
    if (!this.item) return null;
    if (this.item.kind === "joint") return this.place();
    const { document } = this.builder.model;
    const links = allLinks(document);
    const own = this.item.kind === "link" ? [this.item.name] : neighboursOf(document, this.item);
    const places = own.flatMap((name) => links[name] ?? [name]).map((joint) => this.#jointAt(joint)).filter(Boolean);
    if (!places.length) return null;
    return [0, 1].map((axis) => places.reduce((sum, at) => sum + at[axis], 0) / places.length);
  }

  // -- keys ------------------------------------------------------------------------

  /** Return what a key does to what is chosen. */
  key(key, isShift, target) {
    const { builder } = this;
    const isOnCanvas = target === builder.canvas.picture;
    if (key === "Tab") return isOnCanvas && !builder.tool?.isBegun ? this.#walk(isShift ? -1 : 1) : null;
    if (!this.item || !(isOnCanvas || target === globalThis.document.body)) return null;
    const { kind, name } = this.item;
    if (WAYS[key]) return kind === "joint" ? () => this.#nudge(WAYS[key], isShift) : null;
    if (builder.tool || !builder.model.link.isOpen) return null;
    const change = (act) => async () => {
      await builder.change((document) => ({ document: act(document) }));
      // What it is on now, over what the turn says.
      await builder.edited;
      if (this.item) this.#tell();
    };
    const isMore = builder.model.checked.state === "loose";
    const acts = { Enter: () => this.field.open(), Delete: change((document) => withoutItem(document, this.item)) };
    if (kind === "joint") acts.g = change((document) => groundToggled(document, { joint: name }));
    else acts.d = change((document) => driverToggled(document, name, isMore));
    return { ...acts, Backspace: acts.Delete, x: acts.Delete }[key.length === 1 ? key.toLowerCase() : key];
  }

  /** Go to the next or the one before; at the ends Tab leaves the canvas. */
  #walk(step) {
    const all = itemsOf(this.builder.model.document);
    const at = this.#indexIn(all);
    const next = all[at < 0 ? (step > 0 ? 0 : -1) : at + step];
    if (next) return () => this.choose(next);
    if (this.item) this.choose(null, false);
    return null;
  }

  /** Move the chosen joint; presses that follow each other are one step. */
  #nudge([dx, dy], isShift) {
    const { model, canvas } = this.builder;
    const joint = this.item.name;
    if (!model.link.isOpen || (model.isDragging && !this.nudging)) return;
    if (!this.nudging) {
      const at = this.#jointAt(joint);
      if (!at) return;
      const gesture = model.previews.begin();
      canvas.stage.isFitted = false;
      this.nudging = { joint, at, gesture };
    }
    const own = this.nudging;
    const step = (isShift ? NUDGE_SHIFT : NUDGE) / canvas.stage.view.scale;
    own.at = [own.at[0] + dx * step, own.at[1] + dy * step];
    if (model.moves) model.previews.dragJoint(joint, own.at);
    else own.shown = model.previews.show(moveJoint(model.document, joint, own.at));
    clearTimeout(own.timer);
    own.timer = setTimeout(() => this.finish(), NUDGE_PAUSE);
  }

  /** The presses so far are a step. */
  async finish() {
    const own = this.nudging;
    if (!own) return;
    this.nudging = null;
    clearTimeout(own.timer);
    await own.shown;
    await this.builder.model.previews.commit(own.gesture);
  }
}
