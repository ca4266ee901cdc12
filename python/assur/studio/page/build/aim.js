// What lies under a point of the picture, and where it snaps to: for tools, and for joints that are dragged.

import { isInside, linkAt } from "../../../pictures/page/drag.js";
import { pointState } from "../../../pictures/page/quantities.js";
import { jointAt } from "../window/dragging.js";
import { allLinks, tableOf } from "../document/names.js";
import { snapped } from "../document/snap.js";
import { placeOf } from "../document/structure.js";
import { areOnOneLink } from "./steps.js";

export class Aim {
  /**
   * @param {import("../model/model.js").Model} model
   * @param {import("../../../pictures/page/canvas.js").Canvas} canvas
   * @param {import("../../../pictures/page/playback.js").Playback} playback
   */
  constructor(model, canvas, playback) {
    Object.assign(this, { model, canvas, playback });
    /** Keys that are held. */
    this.alt = this.shift = false;
  }

  /** Return the joint and the link under a point of the picture. */
  over(x, y, isTouch) {
    const { stage } = this.canvas;
    const { pose } = this.playback;
    const { document } = this.model;
    const joint = jointAt(this.canvas, pose, x, y, isTouch)?.name;
    const link = stage.data.links[linkAt(stage.drawing, pose, x - stage.view.x, y - stage.view.y, isTouch)];
    return {
      joint: Object.hasOwn(tableOf(document.joints), joint ?? "") ? joint : undefined,
      link: Object.hasOwn(allLinks(document), link ?? "") ? link : undefined,
    };
  }

  /** Return what a click chooses. */
  itemAt(x, y, isTouch) {
    const { joint, link } = this.over(x, y, isTouch);
    if (joint) return { kind: "joint", name: joint };
    return link ? { kind: "link", name: link } : null;
  }

  /** Return the plate that a point of the picture is inside of. */
  #plateAt(x, y) {
    const { drawing, view } = this.canvas.stage;
    const { parts, links } = drawing.scene;
    const isPlate = (part) => part.closed && part.link > 0 && part.name === `link ${links[part.link]}`;
    const isOver = (part) => isInside(x - view.x, y - view.y, drawing.line(part, this.playback.pose));
    const found = parts.find((part) => isPlate(part) && isOver(part));
    return found && links[found.link];
  }

  /** Where joints are now, if that is not as drawn. */
  places() {
    const { model, canvas, playback } = this;
    if (model.isSketch || !playback.pose.known) return {};
    const { joints } = canvas.stage.data;
    const place = ({ link, at }) => {
      const { x, y } = pointState(playback.pose, link, at);
      return [x, y];
    };
    return Object.fromEntries(joints.map((joint) => [joint.name, place(joint)]));
  }

  #snapped(place, more) {
    const { alt, shift } = this;
    const { scale } = this.canvas.stage.view;
    return snapped(place, { document: this.model.document, scale, alt, shift, places: this.places(), ...more });
  }

  /**
   * Return what a tool is told of a point of the picture.
   * @param {number[] | undefined} from where what it has begun starts, m
   * @returns {import("./tool.js").Spot}
   */
  spot(x, y, isTouch, from) {
    const { alt, shift, model } = this;
    const over = this.over(x, y, isTouch);
    const found = this.#snapped(this.canvas.stage.view.m(x, y), { from });
    // A finger catches from farther away.
    if (isTouch && over.joint && !found.joint) {
      Object.assign(found, { joint: over.joint, at: this.places()[over.joint] ?? placeOf(model.document, over.joint) });
    }
    const isMore = shift || model.checked.state === "loose";
    return { ...found, over, plate: alt ? undefined : this.#plateAt(x, y), isFree: alt, isMore };
  }

  /**
   * Return where a dragged joint goes, and what it would be joined to if it were dropped.
   * @param {string} joint
   * @param {number[]} place m
   * @param {number[]} from where it was
   * @returns {{joint: string, at: number[], target: {joint?: string, link?: string} | null, guide?: Object}}
   */
  joint(joint, place, from) {
    const { model } = this;
    const found = this.#snapped(place, { exclude: [joint], from });
    const isOwn = found.joint && areOnOneLink(model.document, [joint, found.joint]);
    const target = !isOwn && (found.joint || found.link) ? { joint: found.joint, link: found.link } : null;
    // What moves follows the pointer, not the grid.
    const isCaught = target || found.guide || (model.isSketch && !isOwn);
    return { joint, target, at: isCaught ? found.at : place, guide: found.guide };
  }
}
