// Keys of the page: what has its own use of a key keeps it.

const FIELDS = "input:not([type=checkbox], [type=range]), select, textarea";
const PRESSED = "button, summary, input[type=checkbox]";

const EDITING = /^([acvxyz]|Arrow.*|Home|End|Backspace|Delete)$/i;

/**
 * Keep the keys that are pressed in a cell of a notebook from it: there letters change and delete
 * cells. Commands pass (Ctrl S), unless they edit a text here, and so do Tab and Escape.
 * @param {HTMLElement} root with what listens for keys, in a root of the cell
 */
export function holdKeys(root) {
  // A click beside all that takes the focus is in the cell too.
  root.tabIndex = -1;
  const hold = (event) => {
    const { key } = event;
    const isText = event.composedPath()[0].matches?.(FIELDS);
    const isCommand = (event.ctrlKey || event.metaKey || event.altKey) && !(isText && EDITING.test(key));
    const passes = isCommand || key === "Tab" || (key === "Escape" && !isText);
    if (event.defaultPrevented || !passes) event.stopPropagation();
  };
  for (const kind of ["keydown", "keypress", "keyup"]) root.parentNode.addEventListener(kind, hold);
}

/**
 * Listen for keys.
 * @param {HTMLElement} root in a notebook keys are those of the focus
 * @param {(key: string, isShift: boolean, target: Element) => (() => void) | null | undefined} find
 *   what a key does
 * @returns {() => void} ends it
 */
export function listenForKeys(root, find) {
  const listening = root.classList.contains("embedded") ? root : document;
  const listener = (event) => {
    const target = event.composedPath()[0];
    if (target.matches?.(FIELDS) || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === " " && target.matches?.(PRESSED)) return;
    const act = find(event.key, event.shiftKey, target);
    if (!act) return;
    event.preventDefault();
    act();
  };
  listening.addEventListener("keydown", listener);
  return () => listening.removeEventListener("keydown", listener);
}

/**
 * Return what a key does to what plays.
 * @param {import("./playback.js").Playback} playback
 * @param {import("./stage.js").Stage} stage
 */
export function playingKey(playback, stage, key, isShift) {
  const step = playback.step * (isShift ? 10 : 1);
  const by = (way) => () => playback.seek(playback.q + way * step);
  const keys = {
    " ": () => playback.toggle(),
    ArrowLeft: by(-1),
    ArrowRight: by(1),
    ArrowDown: by(-1),
    ArrowUp: by(1),
    Home: () => playback.seek(playback.data.turn.at),
    0: () => stage.fit(),
  };
  return keys[key];
}
