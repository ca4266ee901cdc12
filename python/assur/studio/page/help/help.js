// Help: what one can do, keys, and each quantity with its formula.

import { html } from "../../../pictures/page/elements.js";
import { button } from "../../../pictures/page/panel.js";
import { say } from "../../../pictures/page/words.js";
import { HELP_GESTURES, HELP_KEYS, HELP_TERMS, matchesSearch } from "./terms.js";

const upper = (id) => id[0].toUpperCase() + id.slice(1);

/** Return the entries of a list: what is searched, with its element. */
function rowsOf(pairs, tag) {
  return pairs.map(([name, text]) => {
    const term = html("dt", {}, tag ? html(tag, {}, name) : name);
    return html("div", { class: "help-row" }, term, html("dd", {}, text));
  });
}

/** Write a formula: what follows _ is an index. */
function formulaLine(formula) {
  const pieces = formula.split(/_(\w+)/);
  return html("p", { class: "help-formula" }, ...pieces.map((piece, i) => (i % 2 ? html("sub", {}, piece) : piece)));
}

function termRow({ id, formula, reference }) {
  const words = `help${upper(id)}`;
  const parts = [html("p", {}, say(`${words}Text`))];
  if (formula) parts.unshift(formulaLine(formula));
  if (reference) parts.push(html("p", { class: "note" }, reference));
  const own = { class: "help-row help-term", "data-term": id, tabindex: -1 };
  return html("div", own, html("dt", {}, say(words)), html("dd", {}, ...parts));
}

function listOfHelp(title, rows) {
  const list = html("dl", {}, ...rows);
  const element = html("section", {}, html("h3", {}, title), list);
  return { element, rows };
}

/**
 * Make a small button that opens the help at a term.
 * @param {{help: (term: string) => void}} studio
 * @param {() => string} term asked when it is pressed
 */
export function helpButton(studio, term) {
  const element = button(say("helpOnThis"), "", "i");
  element.className = "button help-button";
  element.addEventListener("click", () => studio.help(term()));
  return element;
}

/**
 * Open the help.
 * @param {{root: HTMLElement}} studio
 * @param {string} [term] one of HELP_TERMS to begin at
 * @returns {HTMLDialogElement}
 */
export function openHelp(studio, term = "") {
  const { root } = studio;
  root.querySelector("dialog.help")?.remove();
  const sought = { "aria-label": say("helpSearch"), placeholder: say("helpSearch") };
  const search = html("input", { type: "search", class: "number", ...sought });
  const close = button(say("close"), "", "×");
  close.className = "button round";
  const done = HELP_GESTURES.map((one) => [say(`helpDo${one}`), say(`helpWhat${one}`)]);
  const gestures = listOfHelp(say("helpGestures"), rowsOf(done));
  const keys = listOfHelp(say("helpKeys"), rowsOf(HELP_KEYS.map(([key, one]) => [key, say(`helpKey${one}`)]), "kbd"));
  const terms = listOfHelp(say("helpTerms"), HELP_TERMS.map(termRow));
  const lists = [gestures, keys, terms];
  const nothing = html("p", { role: "status" });
  const body = html("div", { class: "help-body", tabindex: 0 }, ...lists.map((one) => one.element), nothing);
  const head = html("div", { class: "help-head" }, html("h2", {}, say("help")), search, close);
  const dialog = html("dialog", { class: "help", "aria-label": say("help") }, head, body);
  const before = root.getRootNode().activeElement;
  search.addEventListener("input", () => {
    let found = 0;
    for (const { element, rows } of lists) {
      for (const row of rows) row.hidden = !matchesSearch(row.textContent, search.value.trim());
      const own = rows.filter((row) => !row.hidden).length;
      element.hidden = !own;
      found += own;
    }
    nothing.textContent = found ? "" : say("helpNothing", { text: search.value });
  });
  close.addEventListener("click", () => dialog.close());
  // Keys of the studio wait: Space does not play behind the help.
  dialog.addEventListener("keydown", (event) => event.stopPropagation());
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  dialog.addEventListener("close", () => {
    dialog.remove();
    before?.focus?.();
  });
  root.append(dialog);
  dialog.showModal();
  const row = term && terms.rows.find((one) => one.dataset.term === term);
  if (row) {
    row.scrollIntoView({ block: "start" });
    row.focus();
  } else search.focus();
  return dialog;
}
