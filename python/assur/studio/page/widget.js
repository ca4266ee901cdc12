// The studio in a cell of a notebook: the kernel computes, over the model of its widget.

import { html } from "../../pictures/page/elements.js";
import { holdKeys } from "../../pictures/page/keys.js";
import { hasShapeOfDocument } from "./document/shape.js";
import { Link } from "./model/link.js";
import { openStudio } from "./studio.js";
import { say } from "../../pictures/page/words.js";

/** Changes go to the kernel at most so often, ms. */
const SEND_AFTER = 80;

/**
 * Show the studio; what the kernel changes is shown, what is changed here the kernel knows.
 * @param {{model: any, el: HTMLElement}} cell of anywidget
 */
export function render({ model: cell, el }) {
  const root = html("div", { class: "assur embedded" });
  const host = html("div", { class: "assur-explorer" });
  host.style.height = `${cell.get("height")}px`;
  // Styles of the notebook stay out, ours stay in.
  host.attachShadow({ mode: "open" }).append(html("style", {}, STYLE), root);
  holdKeys(root);
  el.append(host);

  const link = new Link({ send: (text) => cell.send({ text }), isOpen: true });
  // Messages without a frame are others'.
  const take = (_, buffers) => {
    const frame = buffers?.[0];
    if (frame) link.take(frame.buffer.slice(frame.byteOffset, frame.byteOffset + frame.byteLength));
  };
  cell.on("msg:custom", take);
  let studio = null;
  let own = null;
  const timers = new Set();

  const show = async () => {
    const document = cell.get("document");
    // What comes back from here is no news.
    if (!studio || JSON.stringify(document) === own) return;
    if (!hasShapeOfDocument(document) || !document.joints) return studio.notify(say("notADocument"));
    own = JSON.stringify(document);
    const { model } = studio;
    model.isNew = JSON.stringify(Object.keys(document.joints)) !== JSON.stringify(Object.keys(model.document.joints));
    const q = cell.get("q");
    // A place that is none is that of the drawing.
    await model.edit(document, { place: [q].flat().every(Number.isFinite) ? q : [], title: "" });
  };
  const seek = () => {
    const { model, playback } = studio ?? {};
    const q = cell.get("q");
    if (!studio || !Number.isFinite(q) || q === model.q) return;
    playback.seek(q);
  };
  const later = (act) => {
    const timer = setTimeout(() => {
      timers.delete(timer);
      act();
    }, SEND_AFTER);
    timers.add(timer);
  };
  const send = () => {
    const { model } = studio;
    const text = JSON.stringify(model.document);
    if (text !== own) {
      own = text;
      cell.set("document", model.document);
    }
    cell.set("q", model.driverCount === 1 ? model.q : [...model.held]);
    cell.save_changes();
  };
  const listen = () => {
    for (const event of ["document", "told"]) {
      studio.model.on(event, () => {
        if (!timers.size) later(send);
      });
    }
  };
  openStudio(root, link).then(async (opened) => {
    studio = opened;
    studio.onBuilt = listen;
    listen();
    await show();
    studio.model.history.clear();
    studio.model.emit("file");
    host.studio = studio;
  });
  cell.on("change:document", show);
  cell.on("change:q", seek);
  return () => {
    cell.off("msg:custom", take);
    cell.off("change:document", show);
    cell.off("change:q", seek);
    for (const timer of timers) clearTimeout(timer);
    studio?.playback.pause();
  };
}
