// What follows the picture while something is dragged: fields, diagrams, one at a time.

/** One of them so often, ms; if no picture comes, the next so much later. */
const BETWEEN = 60;

/**
 * Return a function that has all of these done once more, in turn: with each picture at most one, so
 * that they share its frame and none waits for many.
 * @param {(() => void)[]} all
 */
export function passing(all) {
  const waiting = new Set();
  let timer = 0;
  let isNext = false;
  let last = -Infinity;
  const schedule = (delay) => {
    clearTimeout(timer);
    timer = setTimeout(run, delay);
  };
  const run = () => {
    isNext = false;
    last = performance.now();
    const [next] = waiting;
    waiting.delete(next);
    if (waiting.size) schedule(BETWEEN);
    next();
  };
  return () => {
    for (const one of all) waiting.add(one);
    if (isNext) return;
    // Between the picture and its frame there is often time.
    isNext = performance.now() - last >= BETWEEN;
    schedule(isNext ? 0 : BETWEEN);
  };
}
