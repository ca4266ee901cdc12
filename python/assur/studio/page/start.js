// Begins the page: connects, and opens the file given, what this browser kept, or an example.

import { kept } from "./files.js";
import { connect } from "./link.js";
import { openStudio, showFailure } from "./studio.js";
import { say, speak } from "../../pictures/page/words.js";

/** What is opened if there is nothing else. */
const FIRST = "crank_rocker";

// The token is a cookie by now; the address is better without it.
history.replaceState(null, "", "/");

const root = document.getElementById("assur");
let studio = null;
const link = connect((isOpen) => {
  if (isOpen && !studio) begin();
  else if (studio) {
    studio.model.emit("connection");
    if (isOpen) studio.model.look();
  }
});

async function begin() {
  const language = navigator.language.slice(0, 2);
  if (["de", "ru", "uk"].includes(language)) speak(language);
  try {
    studio = await openStudio(root, link);
    const { model, start } = studio;
    if (start.file) await openGiven();
    else if (kept(null)) await restore(kept(null));
    else await model.open({ example: FIRST });
    if (!start.file) model.history.clear();
    model.emit("file");
    studio.keep();
    window.assurStudio = studio;
  } catch (error) {
    showFailure(root, error.message);
  }
}

/** Open the file of the command; what this window had not saved of it comes back, as a step. */
async function openGiven() {
  const { model } = studio;
  const { others } = await model.open({ file: true });
  model.history.clear();
  model.savedDocument = model.document;
  const own = model.file.saves ? kept(model.file.stamp) : null;
  if (own && JSON.stringify(own.document) !== JSON.stringify(model.document)) {
    await restore(own);
    studio.notify(say("restored"));
  }
  const copy = () => {
    model.file = null;
    model.emit("file");
  };
  if (others) studio.notify(say("others"), { action: { text: say("copy"), act: copy } });
}

async function restore({ document: own, title, held, target }) {
  studio.model.setTarget(Array.isArray(target?.points) ? target : null);
  await studio.model.edit(own, { place: held, title });
  studio.canvas.stage.fit();
}
