// Gestures on the picture of the lesson: the crank is turned by hand, the canvas pans, wheel and
// pinch zoom.

import { fromSegment, Gestures } from "../../../pictures/page/drag.js";

/** How near to the crank one must be to grip it, px; with a finger. */
const CRANK_GRIP = 12;
const CRANK_TOUCH = 22;

/**
 * Listen to gestures on the picture.
 * @param {import("./figure.js").LessonFigure} figure
 * @param {{phi1: () => number, seek: (phi1: number) => void}} on
 */
export function listenToGestures(figure, on) {
  const { view } = figure;
  const around = 2 * Math.PI;
  const grip = (x, y, isTouch) => {
    const radius = figure.motion.lengths.l1;
    const pin = view.px(radius * Math.cos(on.phi1()), radius * Math.sin(on.phi1()));
    return fromSegment(x, y, view.px(0, 0), pin) < (isTouch ? CRANK_TOUCH : CRANK_GRIP) ? "crank" : null;
  };
  return new Gestures(figure.element, {
    grip,
    move: (_, x, y) => {
      const [px, py] = view.m(x, y);
      const angle = Math.atan2(py, px);
      // The turn next to where it is.
      on.seek(angle + around * Math.round((on.phi1() - angle) / around));
    },
    drop: () => {},
    pan: (dx, dy) => figure.pan(dx, dy),
    zoom: (x, y, factor) => figure.zoom(x, y, factor),
    takesWheel: () => true,
  });
}
