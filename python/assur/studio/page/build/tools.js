// The tools: what presses and moves on the canvas mean to each. They hold the ends of what is begun;
// the document changes by what `up` returns.

import { cylinderBetween, driverToggled, groundToggled, guideDirection, isSameEnd, linkThrough } from "./steps.js";
import { slideOfBlock, slideOnGround, slideOnLink, withEnd, withoutItem, withPoint } from "./steps.js";
import { Tool } from "./tool.js";

const endOf = ({ joint, link, at }) => (joint ? { joint, at } : link ? { link, at } : { at });
const only = (change) => (document) => ({ document: change(document) });

/** A tool of single clicks. */
class Click extends Tool {
  constructor(change) {
    super();
    this.change = change;
  }

  get drags() {
    return false;
  }

  up(spot, isDrag) {
    return isDrag ? null : this.change(spot);
  }
}

/** From one end to another: pressed and dragged, or clicked twice. */
class Stretch extends Tool {
  /**
   * @param {(document: Object, from: Object, to: Object) => {document: Object, joint?: string}} change
   * @param {boolean} chains whether the next begins where one ended
   */
  constructor(change, chains) {
    super();
    this.change = change;
    this.chains = chains;
  }

  down(spot) {
    super.down(spot);
    this.pressed = endOf(spot);
    this.isFirst = !this.isBegun;
    if (this.isFirst) this.ends = [this.pressed];
  }

  up(spot, isDrag) {
    super.move(spot);
    // An undo, another document or another tool meanwhile: nothing is begun any more.
    if (!this.isBegun) return null;
    const to = endOf(spot);
    // A drag is a link of its own, a click goes on.
    this.goesOn = this.chains && !isDrag;
    if (isDrag) this.ends = [this.pressed];
    const [from] = this.ends;
    if (isSameEnd(from, to)) {
      if (isDrag || !this.isFirst) this.reset();
      return null;
    }
    return (document) => this.change(document, from, to);
  }

  done(joint, at) {
    this.ends = this.goesOn && joint ? [{ joint, at }] : [];
  }

  preview() {
    const [from] = this.ends;
    return from && this.last ? { lines: [[from.at, this.last.at]], dots: [from.at, this.last.at] } : {};
  }
}

/** Joint after joint, closed at the first or by the last once more; or a link, and a further point of it. */
class Plate extends Tool {
  up(spot, isDrag) {
    super.move(spot);
    const [first] = this.ends;
    if (this.link) {
      const { link } = this;
      return only((document) => withPoint(document, link, endOf(spot)));
    }
    const under = spot.link ?? spot.plate;
    if (!first && !spot.joint && under) {
      this.link = under;
      this.ends = [{ link: under, at: spot.at }];
      return null;
    }
    const own = endOf(spot);
    const isLast = first && isSameEnd(this.ends[this.ends.length - 1], own);
    if (first && (isLast || isSameEnd(first, own))) return this.enter();
    if (!this.ends.some((end) => isSameEnd(end, own))) this.ends.push(own);
    return null;
  }

  enter() {
    const { ends } = this;
    return !this.link && ends.length > 1 ? (document) => linkThrough(document, ends) : null;
  }

  reset() {
    super.reset();
    this.link = null;
  }

  preview() {
    const places = this.ends.map(({ at }) => at);
    if (!places.length || !this.last) return {};
    const lines = places.map((at, i) => [at, places[i + 1] ?? this.last.at]);
    if (places.length > 1) lines.push([this.last.at, places[0]]);
    return { lines, dots: [...(this.link ? [] : places), this.last.at] };
  }
}

/** A joint and the direction of its guide; or a link and the joint that slides on it. */
class Slide extends Stretch {
  constructor() {
    super(null, false);
  }

  up(spot, isDrag) {
    super.move(spot);
    if (!this.isBegun) return null;
    const [from] = this.ends;
    if (from.link) {
      const to = isDrag || !this.isFirst ? endOf(spot) : { at: from.at };
      // A new joint on the same link slides where it is.
      const end = to.link === from.link ? { at: to.at } : to;
      return only((document) => slideOnLink(document, from.link, from.at, end));
    }
    if (from.at[0] === spot.at[0] && from.at[1] === spot.at[1]) {
      if (!this.isFirst) this.reset();
      return null;
    }
    const angle = guideDirection(from.at, spot.at, spot.isFree);
    return only((document) => slideOnGround(document, from, angle));
  }

  preview() {
    const [from] = this.ends;
    if (!from || !this.last) return {};
    if (from.link) return { lines: [[from.at, this.last.at]], dots: [this.last.at] };
    const { at } = this.last;
    const isFar = at[0] !== from.at[0] || at[1] !== from.at[1];
    const angle = isFar ? guideDirection(from.at, at, this.last.isFree) : 0;
    const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
    const length = Math.hypot(at[0] - from.at[0], at[1] - from.at[1]);
    const end = (sign) => [from.at[0] + sign * length * dx, from.at[1] + sign * length * dy];
    return { lines: isFar ? [[end(-1), end(1)]] : [], dots: [from.at], block: { at: from.at, angle } };
  }
}

/** Return what a click removes: a joint, else a slide by its block, else a link. */
export function itemUnder(document, { joint, link }) {
  if (joint) return { kind: "joint", name: joint };
  if (!link) return null;
  const slide = slideOfBlock(document, link);
  return slide ? { kind: "slide", name: slide } : { kind: "link", name: link };
}

/** On a link, or inside of a plate: a joint of it. */
const onLink = (spot) => ({ ...spot, link: spot.link ?? spot.plate });

/**
 * Make the tools.
 * @param {() => Object} shown returns the document
 * @returns {Object<string, Tool>}
 */
export function makeTools(shown) {
  const overItem = (act) => (spot) => {
    const item = itemUnder(shown(), spot.over);
    return item && only((document) => act(document, item, spot));
  };
  const drive = (document, { name }, { isMore }) => driverToggled(document, name, isMore);
  return {
    joint: new Click((spot) => {
      return spot.joint ? null : only((document) => withEnd(document, endOf(onLink(spot))).document);
    }),
    link: new Stretch((document, from, to) => linkThrough(document, [from, to]), true),
    plate: new Plate(),
    slide: new Slide(),
    cylinder: new Stretch((document, from, to) => ({ document: cylinderBetween(document, from, to) }), false),
    ground: new Click((spot) => only((document) => groundToggled(document, endOf(onLink(spot))))),
    driver: new Click((spot) => overItem(drive)({ ...spot, over: { link: spot.over.link } })),
    remove: new Click(overItem(withoutItem)),
  };
}
