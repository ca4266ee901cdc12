// Keys of drawing: a letter for each tool, Enter and Escape; undo, redo and save with Ctrl.

import { TOOL_KEYS } from "./rail.js";

const TEXT_FIELDS = "input:not([type=checkbox], [type=range]), select, textarea";

/** Return what a key does to the tools. */
export function toolKey(builder, key, isShift, target) {
  if (key === "Escape") {
    const { tool, choice } = builder;
    return tool || choice.item ? () => builder.escape() : null;
  }
  const act = builder.tool && target === builder.canvas.picture ? builder.cursor.key(key, isShift) : null;
  if (act) return act;
  const name = TOOL_KEYS[key.length === 1 ? key.toLowerCase() : key];
  return name ? () => builder.take(name) : null;
}

/**
 * Listen for undo, redo and save.
 * @param {import("../studio.js").Studio} studio
 * @param {import("./choice.js").Choice} choice
 * @returns {() => void} ends it
 */
export function listenForEdits({ root, isEmbedded, model, bar }, choice) {
  const listening = isEmbedded ? root : document;
  const keys = { z: () => model.undo(), y: () => model.redo(), Z: () => model.redo() };
  // In a notebook Ctrl S saves that.
  if (!isEmbedded) keys.s = () => bar.save();
  const listener = async (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.shiftKey ? event.key.toUpperCase() : event.key.toLowerCase();
    const act = keys[key];
    // A text that is typed has an undo of its own.
    const isTyping = key !== "s" && event.composedPath()[0].matches?.(TEXT_FIELDS);
    if (!act || isTyping || root.classList.contains("in-lesson") || event.composedPath()[0].closest?.("dialog")) return;
    event.preventDefault();
    await choice.finish();
    // Undo ends what is dragged.
    if (!model.isDragging || key === "z") act();
  };
  listening.addEventListener("keydown", listener);
  return () => listening.removeEventListener("keydown", listener);
}
