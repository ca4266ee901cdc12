// Joints, links and slides by name, to be renamed.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { renameJoint } from "../document/joints.js";
import { renameLink } from "../document/links.js";
import { allLinks, nameError, tableOf } from "../document/names.js";
import { renameSlide, slideNameError } from "../document/slides.js";
import { section } from "../window/shell.js";
import { concernedBy } from "./dimensions_of.js";

const movingNames = (document) => Object.keys(allLinks(document)).filter((name) => name !== "ground");

const NAMED = {
  joints: { names: (document) => Object.keys(tableOf(document.joints)), rename: renameJoint, refuse: nameError },
  links: { names: (document) => movingNames(document), rename: renameLink, refuse: nameError },
  slides: { names: (document) => Object.keys(tableOf(document.slides)), rename: renameSlide, refuse: slideNameError },
};

export class NameSection {
  #built = "";

  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.model = studio.model;
    this.lists = html("div", { class: "name-lists" });
    this.more = html("details", { class: "unfold" }, html("summary", {}, say("namesHint")), this.lists);
    const { element } = section(say("jointsAndLinks"), "more", this.more);
    this.element = element;
    this.model.on("document", () => this.show());
    this.model.on("connection", () => this.#lock());
    this.show();
  }

  show() {
    const { document } = this.model;
    const known = Object.entries(NAMED).map(([kind, { names }]) => [kind, names(document)]);
    this.element.hidden = known.every(([, names]) => !names.length);
    const key = JSON.stringify(known);
    if (key === this.#built) return;
    this.#built = key;
    const lists = known.filter(([, names]) => names.length).map(([kind, names]) => {
      const title = say(`named_${kind}`);
      const entries = names.map((name) => this.#entry(kind, name));
      return html("div", { role: "group", "aria-label": title }, html("h3", {}, title), ...entries);
    });
    this.lists.replaceChildren(...lists);
    this.#lock();
  }

  #lock() {
    for (const field of this.lists.querySelectorAll("input")) field.readOnly = !this.model.link.isOpen;
  }

  #entry(kind, name) {
    const own = { class: kind === "joints" ? "number name" : "number", "aria-label": say("nameOf", { name }) };
    const field = html("input", { ...own, spellcheck: "false", maxlength: "60", "data-named": name });
    field.value = name;
    const error = html("p", { class: "field-error", role: "alert", hidden: "" });
    const refuse = (text) => {
      error.textContent = text;
      error.hidden = !text;
      field.setAttribute("aria-invalid", String(Boolean(text)));
    };
    const apply = () => {
      const to = field.value.trim();
      const wrong = NAMED[kind].refuse(this.model.document, to, name);
      refuse(wrong ? say(wrong.error, wrong.values) : "");
      if (!wrong && to !== name) this.#rename(kind, name, to);
    };
    field.addEventListener("blur", apply);
    field.addEventListener("keydown", (event) => {
      if (event.key === "Enter") apply();
      else if (event.key === "Escape") {
        field.value = name;
        refuse("");
      } else return;
      event.stopPropagation();
    });
    const element = html("div", { class: "named" }, field, error);
    this.studio.highlight.attach(element, () => {
      return kind === "slides" ? concernedBy(name, this.model.document) : { [kind]: [name] };
    });
    return element;
  }

  async #rename(kind, from, to) {
    const { model } = this;
    const made = NAMED[kind].rename(model.document, from, to);
    if (!made) return;
    const { root } = this.studio;
    const hadFocus = this.lists.contains(root.getRootNode().activeElement);
    this.studio.highlight.light();
    await model.edit(made);
    if (hadFocus) this.lists.querySelector(`[data-named="${CSS.escape(to)}"]`)?.focus();
  }
}
