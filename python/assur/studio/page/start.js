// Begins the page: connects, and opens the file given, what this browser kept, or an example.

import { kept, keep } from "./files.js";
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
    const own = start.file ? null : kept();
    if (start.file) {
      const { others } = await model.open({ file: true });
      model.savedDocument = model.document;
      if (others) studio.notify(say("others"));
    } else if (own) {
      model.title = own.title;
      await model.edit(own.document, { place: own.held });
      studio.canvas.stage.fit();
    } else await model.open({ example: FIRST });
    model.history.clear();
    model.emit("file");
    keep(model);
    window.assurStudio = studio;
  } catch (error) {
    showFailure(root, error.message);
  }
}
