// The window: a bar, a rail of tools, the picture, what plays below it, and a panel of numbers.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";

/** Tabs of narrow windows: each shows the sections that name it. */
const TABS = ["dimensions", "diagrams", "assembly", "more"];
const TAB_WORDS = { dimensions: "tabDimensions", diagrams: "tabDiagrams", assembly: "tabAssembly", more: "tabMore" };

/**
 * Make a section of the panel.
 * @param {string} title
 * @param {string} tab where narrow windows show it
 * @param {...(Node|string)} children
 */
export function section(title, tab, ...children) {
  const note = html("span", { class: "note" });
  const head = html("div", { class: "section-head" }, html("h2", {}, title), note);
  const element = html("section", { class: "section", "data-tab": tab, "aria-label": title }, head, ...children);
  return { element, note, head };
}

export class Shell {
  /**
   * @param {HTMLElement} root
   * @param {{bar: HTMLElement, canvas: HTMLElement, dock: HTMLElement}} parts
   */
  constructor(root, { bar, canvas, dock }) {
    this.root = root;
    this.rail = html("nav", { class: "rail", "aria-label": say("tools") });
    this.panel = html("aside", { class: "panel", "aria-label": say("panel") });
    this.tabs = html("div", { class: "tabs", role: "tablist" });
    for (const tab of TABS) {
      const one = html("button", { type: "button", role: "tab", class: "tab", "data-tab": tab }, say(TAB_WORDS[tab]));
      one.addEventListener("click", () => this.choose(tab));
      this.tabs.append(one);
    }
    this.notices = html("div", { class: "notices", role: "alert" });
    this.element = html("div", { class: "shell" }, bar, this.rail, canvas, dock, this.tabs, this.panel, this.notices);
    root.replaceChildren(this.element);
    this.choose("diagrams");
  }

  /** Show a tab, in a narrow window. */
  choose(tab) {
    this.element.dataset.tab = tab;
    for (const one of this.tabs.children) one.setAttribute("aria-selected", String(one.dataset.tab === tab));
  }

  /**
   * Say something over the picture until it is closed.
   * @param {string} text
   * @param {{kind?: string, action?: {text: string, act: () => void}}} [options] of a kind the last stays
   */
  notify(text, { kind = "note", action } = {}) {
    this.dismiss(kind);
    const notice = html("div", { class: `notice ${kind}`, "data-kind": kind }, html("span", {}, text));
    if (action) {
      const button = html("button", { type: "button", class: "button" }, action.text);
      button.addEventListener("click", () => {
        notice.remove();
        action.act();
      });
      notice.append(button);
    }
    const close = html("button", { type: "button", class: "button round", "aria-label": say("close"), title: say("close") }, "×");
    close.addEventListener("click", () => notice.remove());
    notice.append(close);
    this.notices.append(notice);
  }

  dismiss(kind) {
    for (const notice of this.notices.querySelectorAll(`[data-kind=${kind}]`)) notice.remove();
  }
}
