// The joint in a hand: its links are drawn with it at once; all else follows with the server's answer.
//
// At the position that is shown a dragged joint moves alone (see `drag` of docs/developers/studio_protocol.md),
// so what is drawn here is what the answer will say of these links.

import { pointState, toLocal } from "../../../pictures/page/quantities.js";

/** A vertex that is nearer to the joint, relative to a usual link, is at it. */
const AT_JOINT = 1e-6;

export class Pulling {
  #drawing = null;
  /** Parts that are drawn with the joint elsewhere, by their number. */
  #pulled = new Map();

  /** @param {import("../../../pictures/page/stage.js").Stage} stage */
  constructor(stage) {
    this.stage = stage;
  }

  /**
   * Draw the links of a joint with it at a place.
   * @param {string} name
   * @param {number[]} place m
   * @param {import("../../../pictures/page/turn.js").Pose} pose that is shown
   */
  pull(name, [x, y], pose) {
    const { drawing, data } = this.stage;
    const joint = data.joints.find((one) => one.name === name);
    if (!joint || !pose.known) return;
    if (drawing !== this.#drawing) this.#pulled.clear();
    this.#drawing = drawing;
    const from = pointState(pose, joint.link, joint.at);
    const tiny = AT_JOINT * data.usual;
    if (Math.hypot(from.x - x, from.y - y) < tiny) return this.letGo();
    for (const link of joint.links) {
      const [own, next] = [toLocal(pose, link, from.x, from.y), toLocal(pose, link, x, y)];
      drawing.scene.parts.forEach((part, i) => {
        if (part.link !== link) return;
        const at = moved(part.at, own, next, tiny);
        if (at) this.#draw(i, at);
      });
    }
  }

  /** Draw them where they are. */
  letGo() {
    const { drawing } = this.stage;
    const pulled = [...this.#pulled];
    this.#pulled.clear();
    if (drawing !== this.#drawing) return;
    for (const [i, at] of pulled) {
      // Another turn has drawn the others meanwhile.
      if (drawing.parts[i].at === at) this.#draw(i, drawing.scene.parts[i].at);
    }
    this.#pulled.clear();
  }

  #draw(i, at) {
    const { parts, redraw, scale, size } = this.#drawing;
    parts[i].at = at;
    this.#pulled.set(i, at);
    redraw.get(parts[i])(scale, size);
  }
}

/** Return vertices with those at one place at another; null if there are none. */
function moved(at, [x0, y0], [x1, y1], tiny) {
  let result = null;
  for (let i = 0; i < at.length; i += 4) {
    if (Math.abs(at[i] - x0) > tiny || Math.abs(at[i + 1] - y0) > tiny) continue;
    result ??= [...at];
    result[i] = x1;
    result[i + 1] = y1;
  }
  return result;
}
