// A link that is dragged drives: the coordinate follows that brings the gripped point nearest.

import { linkAt, nearestCoordinate } from "./drag.js";
import { toLocal } from "./quantities.js";

/**
 * Return what grips links: a part of the handlers of `Gestures`.
 * @param {import("./canvas.js").Canvas} canvas
 * @param {import("./playback.js").Playback} playback
 */
export function driving({ stage }, playback) {
  return {
    grip(x, y, isTouch) {
      const { pose, player } = playback;
      const link = linkAt(stage.drawing, pose, x - stage.view.x, y - stage.view.y, isTouch);
      return link === null ? null : { link, at: toLocal(pose, link, ...stage.view.m(x, y)), sense: player.sense };
    },
    move(grip, x, y) {
      const { turn, player } = playback;
      const q = nearestCoordinate(turn, grip.link, grip.at, stage.view.m(x, y), player.q, grip.sense);
      const step = q - player.q;
      if (step) grip.sense = Math.sign(Math.abs(step) > (turn.high - turn.low) / 2 ? -step : step);
      player.seek(q);
    },
    drop: () => playback.tell(),
    pan: (dx, dy) => stage.pan(dx, dy),
    zoom: (x, y, factor) => stage.zoom(x, y, factor),
  };
}
