// The list of loads: each in words, its fields below it when it is opened.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { addLoad, removeLoad } from "../document/machine.js";
import { listOf } from "../document/names.js";
import { loadForm } from "./load_form.js";
import { LOAD_FIELDS, loadText, newLoad } from "./load_kinds.js";

/**
 * Make the list.
 * @param {import("../model/model.js").Model} model
 * @param {import("./fields.js").Fields} fields
 * @param {{open: number | null}} state which load is open
 * @param {() => void} again makes the list anew
 * @param {(key: string) => string} wrongAt what the server says of a place of the document
 */
export function loadList(model, fields, state, again, wrongAt) {
  const loads = listOf(model.document.loads);
  if (state.open !== null && state.open >= loads.length) state.open = null;
  const list = html("ul", { class: "loads", "aria-label": say("loads") });
  loads.forEach((load, i) => list.append(entryOf(model, fields, state, again, load, i, wrongAt(`loads[${i}]`))));
  const choice = fields.choice("load new", {
    label: say("addLoad"), value: "",
    options: [["", say("addLoad")], ...Object.keys(LOAD_FIELDS).map((type) => [type, say(`load${type}`)])],
    set: (type) => {
      if (!type) return;
      state.open = loads.length;
      model.edit(addLoad(model.document, newLoad(model.document, type)));
    },
  });
  choice.classList.add("add-load");
  return [list, choice];
}

function entryOf(model, fields, state, again, load, i, wrong) {
  const { what, size } = loadText(load, say);
  const isOpen = state.open === i;
  const opener = html(
    "button", { type: "button", class: "load", "data-key": `load ${i}`, "aria-expanded": String(isOpen) },
    html("span", {}, what), html("span", { class: "note" }, size),
  );
  opener.addEventListener("click", () => {
    state.open = isOpen ? null : i;
    again();
  });
  const name = say("removeLoad", { what });
  const remove = html(
    "button",
    { type: "button", class: "button round plain", "data-key": `load ${i} remove`, title: name, "aria-label": name },
    "×",
  );
  remove.addEventListener("click", () => {
    state.open = null;
    fields.bad.clear();
    model.edit(removeLoad(model.document, i));
  });
  const entry = html("li", {}, html("div", { class: "load-row" }, opener, remove));
  if (wrong) entry.append(html("p", { class: "field-error" }, wrong));
  if (isOpen) entry.append(loadForm(model, fields, load, i));
  return entry;
}
