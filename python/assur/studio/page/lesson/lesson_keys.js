// Keys of the lesson: Space runs and stops, left and right turn the crank by 1°, with Shift by 10°.

const ONE_DEGREE = Math.PI / 180;
const TYPED_INTO = "input:not([type=checkbox]), select, textarea";
const PRESSED_BY_SPACE = "button, summary, input[type=checkbox]";

/**
 * Listen for keys until the function returned is called.
 * @param {HTMLElement} host
 * @param {import("./lesson.js").Lesson} lesson
 * @returns {() => void}
 */
export function lessonKeys(host, lesson) {
  const listening = host.closest(".embedded") ?? document;
  const pressed = (event) => {
    const target = event.composedPath()[0];
    const isOther = event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey;
    if (isOther || target.matches?.(TYPED_INTO)) return;
    if (event.key === " " && target.matches?.(PRESSED_BY_SPACE)) return;
    const step = ONE_DEGREE * (event.shiftKey ? 10 : 1);
    const acts = {
      " ": () => lesson.toggle(),
      ArrowLeft: () => lesson.turn(-step),
      ArrowRight: () => lesson.turn(step),
      Home: () => lesson.seek(lesson.design.start),
      0: () => lesson.fit(),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  };
  listening.addEventListener("keydown", pressed);
  return () => listening.removeEventListener("keydown", pressed);
}
