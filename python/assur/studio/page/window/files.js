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

/** Return where a document is kept: that of a file or example of the command by itself. */
const keyOf = (id) => (id ? `${KEPT} ${id}` : KEPT);

/** Keep the document whenever it changes: for this window, and without a file for the next one that opens. */
export function keep(model) {
  let timer = 0;
  const write = () => {
    const { document, title, held, file, target, savedDocument } = model;
    const isUnsaved = Boolean(file) && savedDocument !== document;
    const own = JSON.stringify({ document, title, held, target, stamp: file?.stamp ?? null, isUnsaved });
    try {
      sessionStorage.setItem(keyOf(file?.id), own);
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

/** Keep nothing of a file any more: its document goes on by itself. */
export function forget(id) {
  try {
    sessionStorage.removeItem(keyOf(id));
  } catch {
    // There is no store.
  }
}

/**
 * Return what this browser kept, or null: of a file what this window has.
 * @param {string | null} id of the file, null without one
 * @returns {{document: Object, title: string, held: number[] | undefined, target: Object | null, stamp: string | null,
 *   isUnsaved: boolean} | null} stamp: of the file as it was opened or saved last
 */
export function kept(id) {
  for (const store of id ? ["sessionStorage"] : ["sessionStorage", "localStorage"]) {
    try {
      const own = JSON.parse(window[store].getItem(keyOf(id)));
      if (!own || !hasShapeOfDocument(own.document) || (!id && own.stamp)) continue;
      const { document, title, held, target, stamp, isUnsaved } = own;
      return {
        document,
        title: typeof title === "string" ? title : "",
        held: [held ?? []].flat().every(Number.isFinite) ? held : undefined,
        target: isTargetPath(target) ? target : null,
        stamp: typeof stamp === "string" ? stamp : null,
        isUnsaved: isUnsaved === true,
      };
    } catch {
      // Not ours, or there is no store.
    }
  }
  return null;
}
