// Files: opening, saving, taking away, and what this browser keeps.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { hasShapeOfDocument, isTargetPath } from "../document/shape.js";

/** Where this browser keeps the document. */
const KEPT = "assur-studio";
/** After the last change it waits so long, ms. */
const KEEP_AFTER = 400;

/** Give a file to the person. */
export function download(name, type, bytes) {
  const address = URL.createObjectURL(new Blob([bytes], { type }));
  const anchor = html("a", { href: address, download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Let the person choose a file; calls `take` with it. */
export function chooseFile(take) {
  const input = html("input", { type: "file", accept: ".toml,.json,.pmks,.txt,.csv,.linkage2,.xml,.mech" });
  input.addEventListener("change", () => {
    if (input.files[0]) take(input.files[0]);
  });
  input.click();
}

/** Return the text of a file: UTF-8, else what Windows programs write. */
function textOf(bytes) {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

/**
 * Open a file of the person, if it is a mechanism; the old one stays if not.
 * @param {import("../model/model.js").Model} model
 * @param {File} file
 * @param {number} limit bytes
 * @param {(text: string) => void} tell
 */
export async function openFile(model, file, limit, tell) {
  const { name } = file;
  if (file.size > limit) {
    tell(say("tooLarge", { name, size: Math.ceil(file.size / 1024), limit: Math.floor(limit / 1024) }));
    return;
  }
  try {
    const { omitted } = await model.open({ text: textOf(await file.arrayBuffer()), name });
    if (omitted?.length) tell(say("omitted", { what: omitted.join(" ") }));
  } catch (error) {
    tell(say("notAMechanism", { name, reason: error.message }));
  }
}

/** Keep the document whenever it changes: for this window, and for the next one that opens. */
export function keep(model) {
  let timer = 0;
  const write = () => {
    const { document, title, held, file, target } = model;
    const own = JSON.stringify({ document, title, held, target, stamp: file?.stamp ?? null });
    try {
      sessionStorage.setItem(KEPT, own);
      if (!file) localStorage.setItem(KEPT, own);
    } catch {
      // The browser keeps nothing, or has no more room: the page goes on.
    }
  };
  for (const event of ["document", "file", "target"]) {
    model.on(event, () => {
      clearTimeout(timer);
      timer = setTimeout(write, KEEP_AFTER);
    });
  }
  window.onpagehide = write;
}

/**
 * Return what this browser kept, or null: of a file what this window had not saved.
 * @param {string | null} stamp of the file that is open
 */
export function kept(stamp) {
  for (const store of stamp ? ["sessionStorage"] : ["sessionStorage", "localStorage"]) {
    try {
      const own = JSON.parse(window[store].getItem(KEPT));
      if (!own || own.stamp !== stamp || !hasShapeOfDocument(own.document)) continue;
      const { document, title, held, target } = own;
      return {
        document,
        title: typeof title === "string" ? title : "",
        held: [held ?? []].flat().every(Number.isFinite) ? held : undefined,
        target: isTargetPath(target) ? target : null,
      };
    } catch {
      // Not ours, or there is no store.
    }
  }
  return null;
}
