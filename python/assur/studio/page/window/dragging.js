// Joints that are dragged: the dimensions of their links follow, or the drawing if it does not move.

import { pointState } from "../../../pictures/page/quantities.js";
import { moveJoint } from "../document/joints.js";
import { newestOnly } from "../model/link.js";
import { Pulling } from "./pulling.js";

/** How near to a joint one must be to grip it, px; with a finger. */
const JOINT_GRIP = 12;
const JOINT_TOUCH = 22;

/** Return the joint under a point of the picture, or null. */
export function jointAt({ stage }, pose, x, y, isTouch) {
  let best = null;
  let least = isTouch ? JOINT_TOUCH : JOINT_GRIP;
  for (const joint of stage.data.joints) {
    const place = pointState(pose, joint.link, joint.at);
    const [px, py] = stage.view.px(place.x, place.y);
    const distance = Math.hypot(px - x, py - y);
    if (distance < least) {
      least = distance;
      best = joint;
    }
  }
  return best;
}

export class JointDrag {
  /**
   * @param {import("../model/model.js").Model} model
   * @param {import("../../../pictures/page/canvas.js").Canvas} canvas
   * @param {import("../../../pictures/page/playback.js").Playback} playback
   * @param {import("../build/builder.js").Builder} builder says where a joint goes, and what it would be joined to
   */
  constructor(model, canvas, playback, builder) {
    this.model = model;
    this.builder = builder;
    this.canvas = canvas;
    this.playback = playback;
    this.pulling = new Pulling(canvas.stage);
    model.on("problem", () => model.problem && this.pulling.letGo());
    this.previews = newestOnly(({ gesture, document }) => model.previews.isUnderWay(gesture) && model.previews.show(document));
  }

  /** Grip a joint at a place of the picture; null where there is none. */
  grip(x, y, isTouch) {
    const joint = jointAt(this.canvas, this.playback.pose, x, y, isTouch);
    if (!joint) return null;
    const place = pointState(this.playback.pose, joint.link, joint.at);
    return { joint: joint.name, from: [place.x, place.y] };
  }

  /** The gesture before, until its last answer has come. */
  #ending = null;
  /** The grip of a joint whose links are drawn where the hand has it. */
  #held = null;

  /** Another turn is drawn: the hand may have gone on meanwhile. */
  passed() {
    if (this.#held) this.#pull(this.#held);
  }

  #pull(grip) {
    this.#held = grip;
    // Where it cannot be it is not drawn either; while it plays the hand holds it for no longer than a frame.
    if (this.playback.player.isPlaying) this.pulling.letGo();
    else if (!this.model.problem) this.pulling.pull(grip.joint, grip.at, this.playback.pose);
  }

  #letGo(grip) {
    if (this.#held !== grip) return;
    this.#held = null;
    this.pulling.letGo();
  }

  /** Move it to a place in the plane, m; not before the gesture before has ended. */
  move(grip, to) {
    grip.to = to;
    if (!this.#ending) return this.#move(grip);
    grip.waits ??= this.#ending.then(() => {
      grip.waits = null;
      this.#move(grip);
    });
    return undefined;
  }

  #move(grip) {
    const { model } = this;
    if (grip.isCancelled) return;
    grip.gesture ??= model.previews.begin();
    if (!model.previews.isUnderWay(grip.gesture)) return this.#letGo(grip);
    const { at, target } = this.builder.aimJoint(grip.joint, grip.to, grip.from);
    Object.assign(grip, { at, target });
    if (model.moves) {
      this.#pull(grip);
      model.previews.dragJoint(grip.joint, at);
    } else this.previews.push({ gesture: grip.gesture, document: moveJoint(model.document, grip.joint, at) });
  }

  drop(grip) {
    const before = this.#ending ?? Promise.resolve();
    const ending = before.then(() => this.#drop(grip)).finally(() => {
      if (this.#ending === ending) this.#ending = null;
    });
    this.#ending = ending;
  }

  async #drop(grip) {
    await grip.waits;
    const { model } = this;
    const { gesture } = grip;
    if (!gesture) return;
    this.builder.unaim();
    await this.previews.settled();
    if (grip.target && model.previews.isUnderWay(gesture)) {
      await model.previews.dragged();
      await model.previews.show(await this.builder.joined(grip.joint, grip.target));
    }
    await model.previews.commit(gesture);
    this.#letGo(grip);
  }

  async cancel(grip) {
    grip.isCancelled = true;
    this.#letGo(grip);
    if (!grip.gesture) return;
    this.builder.unaim();
    await this.model.previews.cancel(grip.gesture);
  }
}
