// What follows the picture while something is dragged: one thing after another, each after a frame.

/** One of them so often, ms. */
const BETWEEN = 30;

/**
 * Return a function that has all of these done once more, in turn: while a frame is on its way to the
 * screen nothing else delays it, and afterwards the server computes the next.
 * @param {(() => void)[]} all
 */
export function passing(all) {
  const waiting = new Set();
  let isScheduled = false;
  let last = 0;
  const schedule = () => {
    isScheduled = true;
    // A frame is drawn between its request and a timer that is set then.
    const afterFrame = () => requestAnimationFrame(() => setTimeout(run));
    setTimeout(afterFrame, Math.max(BETWEEN - (performance.now() - last), 0));
  };
  const run = () => {
    isScheduled = false;
    last = performance.now();
    const [next] = waiting;
    waiting.delete(next);
    if (waiting.size) schedule();
    next();
  };
  return () => {
    for (const one of all) waiting.add(one);
    if (!isScheduled) schedule();
  };
}
