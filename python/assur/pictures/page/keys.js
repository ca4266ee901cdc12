// Keys of the page: what has its own use of a key keeps it.

const FIELDS = "input:not([type=checkbox], [type=range]), select, textarea";
const PRESSED = "button, summary, input[type=checkbox]";

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
