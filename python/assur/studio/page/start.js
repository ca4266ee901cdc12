// Begins the page: connects, and opens the file given, what this browser kept, or an example.

import { forget, kept } from "./window/files.js";
import { connect } from "./model/link.js";
import { openStudio, showFailure } from "./studio.js";
import { say, speak } from "../../pictures/page/words.js";

/** What is opened if there is nothing else. */
const FIRST = "crank_rocker";

// The token is a cookie by now; the address is better without it.
history.replaceState(null, "", "/");

const root = document.getElementById("assur");
let studio = null;
let isBeginning = false;
const changed = (isOpen) => {
  if (studio) {
    studio.model.emit("connection");
    if (isOpen) studio.model.look();
  } else if (isOpen && !isBeginning) begin();
};
const refused = () => {
  if (studio) studio.notify(say("startedAgain"), { kind: "offline" });
  else showFailure(root, say("startedAgain"));
};
const link = connect(changed, refused);

async function begin() {
  isBeginning = true;
  const language = (navigator.language ?? "").slice(0, 2);
  if (["de", "ru", "uk"].includes(language)) speak(language);
  try {
    const opened = await openStudio(root, link);
    await openFirst(opened);
    opened.model.emit("file");
    opened.keep();
    studio = window.assurStudio = opened;
  } catch (error) {
    // With the next connection it begins anew.
    showFailure(root, error.kind === "disconnected" ? say("offlineYet") : error.message);
  } finally {
    isBeginning = false;
  }
}

/** Open the file given; else, or if it is no mechanism, what this browser kept, or an example. */
async function openFirst(studio) {
  const { model, start } = studio;
  if (start.file) {
    try {
      return await openGiven(studio);
    } catch (error) {
      if (error.kind === "disconnected") throw error;
      studio.notify(say("notAMechanism", { name: start.file.title, reason: error.message }));
      if (await restoreUnsaved(studio)) return model.history.clear();
    }
  }
  const own = kept(null);
  if (own) await restore(studio, own);
  else await model.open({ example: FIRST });
  model.history.clear();
}

/** Open the file of the command; what this window had not saved of it comes back, as a step. */
async function openGiven(studio) {
  const { model, start } = studio;
  const { id } = start.file;
  const { others } = await model.open({ file: true });
  model.file.id = id;
  model.history.clear();
  model.savedDocument = model.document;
  const { stamp } = model.file;
  const text = JSON.stringify(model.document);
  if (JSON.stringify(kept(id)?.document) !== text && (await restoreUnsaved(studio))) {
    studio.notify(say(model.file.stamp === stamp ? "restored" : "restoredBeside"));
  }
  const copy = () => {
    forget(id);
    model.file = null;
    model.emit("file");
  };
  if (others) studio.notify(say("others"), { action: { text: say("copy"), act: copy } });
}

/** Bring back what this window had not saved of the file, as a change of what it was: if it is another by now, saving asks. */
async function restoreUnsaved(studio) {
  const { model, start } = studio;
  const own = kept(start.file.id);
  if (!own?.isUnsaved) return false;
  model.file = { stamp: own.stamp, saves: start.file.saves, id: start.file.id };
  await restore(studio, own);
  return true;
}

async function restore(studio, { document: own, title, held, target }) {
  studio.model.setTarget(target);
  await studio.model.edit(own, { place: held, title });
  studio.canvas.stage.fit();
}
