// A section of the panel that folds: its head opens and closes it.

import { html } from "../../../pictures/page/elements.js";

/**
 * Make a section that folds; whether it is open stays with `state`.
 * @param {string} key
 * @param {string} title
 * @param {string} tab where narrow windows show it
 * @param {Object<string, boolean>} state true: folded in
 * @param {boolean} isFolded unless it was opened or closed before
 */
export function foldedSection(key, title, tab, state, isFolded) {
  const note = html("span", { class: "note" });
  const head = html("summary", { class: "section-head" }, html("h2", {}, title), note);
  const body = html("div", { class: "fold-body" });
  const details = html("details", { class: "fold" }, head, body);
  const element = html(
    "section", { class: "section", "data-tab": tab, "data-section": key, "aria-label": title }, details,
  );
  details.open = !(state[key] ?? isFolded);
  head.addEventListener("click", () => (state[key] = details.open));
  return { element, details, body, note };
}
