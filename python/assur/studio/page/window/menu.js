// Menus of the bar: a button that opens a list; Escape and a click beside it close it.

import { html } from "../../../pictures/page/elements.js";
import { button } from "../../../pictures/page/panel.js";

/**
 * Make a menu.
 * @param {string} name
 * @param {string} path of its icon
 * @param {() => HTMLElement[]} entries made when it opens
 */
export function menu(name, path, entries) {
  const list = html("div", { class: "menu-list", role: "menu", hidden: "" });
  const opener = button(name, path, name);
  opener.setAttribute("aria-haspopup", "menu");
  opener.setAttribute("aria-expanded", "false");
  const element = html("div", { class: "menu" }, opener, list);
  const close = () => {
    list.hidden = true;
    opener.setAttribute("aria-expanded", "false");
  };
  opener.addEventListener("click", () => {
    if (!list.hidden) return close();
    list.replaceChildren(...entries());
    list.hidden = false;
    opener.setAttribute("aria-expanded", "true");
    list.querySelector("button")?.focus();
  });
  element.addEventListener("focusout", (event) => {
    if (event.relatedTarget && !element.contains(event.relatedTarget)) close();
  });
  element.addEventListener("keydown", (event) => {
    const all = [...list.querySelectorAll("button")];
    const at = all.indexOf(element.getRootNode().activeElement);
    if (event.key === "Escape") {
      close();
      opener.focus();
    } else if (event.key === "ArrowDown") all[(at + 1) % all.length]?.focus();
    else if (event.key === "ArrowUp") all[(at + all.length - 1) % all.length]?.focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  list.addEventListener("click", (event) => {
    if (event.target.closest("button")) close();
  });
  return { element, opener, close };
}

/** Make an entry of a menu. */
export function entry(text, act, note = "") {
  const element = html("button", { type: "button", class: "entry", role: "menuitem" }, html("span", {}, text));
  if (note) element.append(html("span", { class: "note" }, note));
  element.addEventListener("click", act);
  return element;
}
