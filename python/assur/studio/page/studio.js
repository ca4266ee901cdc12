// Begins the page: opens the file given, or an example, and shows it.

import { mount } from "/pictures/main.js";
import { Link } from "/studio/link.js";

// The token is a cookie by now; the address is better without it.
history.replaceState(null, "", "/");

const root = document.getElementById("assur");
const link = new Link({ opened: begin });

async function begin() {
  try {
    const { header } = await link.ask("start", 0, {});
    const opened = await link.ask("open", 0, header.file ? { file: true } : { example: header.examples[0].name });
    const { header: shown, arrays } = await link.ask("turn", 0, { document: opened.header.document });
    const data = { ...shown.payload, title: opened.header.title };
    mount(root, { ...data, turn: { ...data.turn, values: arrays.values } });
  } catch (error) {
    root.textContent = error.message;
  }
}
