// The bar: what is open, undo and redo, menus.

import { html } from "../../../pictures/page/elements.js";
import { schemeButton } from "../../../pictures/page/main.js";
import { button } from "../../../pictures/page/panel.js";
import { say, spoken } from "../../../pictures/page/words.js";
import { chooseFile, download, openFile } from "./files.js";
import { entry, menu } from "./menu.js";

const UNDO = "M9 7L4 12l5 5M4 12h10a5 5 0 0 1 0 10h-2";
const REDO = "M15 7l5 5-5 5M20 12H10a5 5 0 0 0 0 10h2";
const SHEET = "M6 3h8l4 4v14H6zM14 3v4h4M12 11v6M9 14h6";
const FOLDER = "M3 6h6l2 3h10v10H3z";
const BOOK = "M5 4h13v16H5zM5 16h13";
const OUT = "M12 15V4M8 8l4-4 4 4M5 14v6h14v-6";
const HELP = "M9 9a3 3 0 1 1 4 2.8c-.7.3-1 .8-1 1.7M12 17v.5";
const MENU = "M4 7h16M4 12h16M4 17h16";
const SCREEN = "M3 5h18v11H3zM8 20h8M12 16v4";
const GLOBE = "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zM3 12h18M12 3c3 3 3 15 0 18M12 3c-3 3-3 15 0 18";
const FORMATS = ["toml", "svg", "dxf", "csv", "gif", "html"];
export const LANGUAGES = { en: "English", de: "Deutsch", ru: "Русский", uk: "Українська" };

export class Bar {
  /**
   * @param {HTMLElement} root
   * @param {import("../model/model.js").Model} model
   * @param {{start: Object, notify: Function, lesson: () => void, help: () => void, speak: (code: string) => void, isEmbedded: boolean}} page
   */
  constructor(root, model, page) {
    this.model = model;
    this.page = page;
    this.title = html("input", { class: "file-title", "aria-label": say("untitled"), spellcheck: "false", maxlength: "80" });
    this.title.addEventListener("change", () => {
      model.title = this.title.value.trim();
      model.emit("file");
    });
    this.state = html("span", { class: "note" });
    this.undo = button(say("undo"), UNDO);
    this.redo = button(say("redo"), REDO);
    this.undo.addEventListener("click", () => model.undo());
    this.redo.addEventListener("click", () => model.redo());
    const fresh = button(say("newDocument"), SHEET, html("span", {}, say("newDocument")));
    fresh.classList.add("fresh");
    fresh.addEventListener("click", () => page.begin());
    const open = menu(say("open"), FOLDER, () => this.#openEntries());
    const examples = menu(say("examples"), BOOK, () => this.#exampleEntries());
    const out = menu(say("export"), OUT, () => this.#exportEntries());
    const language = menu(LANGUAGES[spoken()], GLOBE, () => Object.entries(LANGUAGES).map(([code, name]) => entry(name, () => page.speak(code))));
    language.opener.setAttribute("aria-label", say("language"));
    language.element.classList.add("language");
    const help = button(say("help"), HELP);
    help.addEventListener("click", () => page.help());
    const projector = button(say("projector"), SCREEN);
    projector.addEventListener("click", () => page.projector());
    // The lesson has neither.
    for (const one of [out.element, projector]) one.classList.add("of-document");
    const brand = html("span", { class: "brand" }, say("studio"));
    const files = page.isEmbedded ? [out.element] : [fresh, open.element, examples.element, out.element];
    const menus = html("div", { class: "menus" }, ...files, language.element, projector, schemeButton(root), help);
    const more = button(say("menu"), MENU);
    more.classList.add("more");
    more.setAttribute("aria-expanded", "false");
    const unfold = (isOpen) => {
      menus.classList.toggle("unfolded", isOpen);
      more.setAttribute("aria-expanded", String(isOpen));
    };
    more.addEventListener("click", () => unfold(!menus.classList.contains("unfolded")));
    menus.addEventListener("click", (event) => {
      if (!event.target.closest("[aria-haspopup]")) unfold(false);
    });
    this.element = html(
      "header",
      { class: "bar" },
      more,
      ...(page.isEmbedded ? [] : [brand, this.title, this.state]),
      this.undo,
      this.redo,
      html("span", { class: "space" }),
      menus,
    );
    for (const event of ["document", "file", "connection"]) model.on(event, () => this.show());
    this.show();
  }

  show() {
    const { model, page } = this;
    const isLesson = page.lessonScreen?.isOpen ?? false;
    this.undo.disabled = isLesson || !model.history.canUndo;
    this.redo.disabled = isLesson || !model.history.canRedo;
    this.title.readOnly = isLesson;
    if (isLesson) {
      this.title.value = say("lesson");
      this.state.textContent = say("lessonSource");
      return;
    }
    if (this.title !== this.title.getRootNode().activeElement) this.title.value = model.title || say("untitled");
    const isSaved = model.file?.saves && model.savedDocument === model.document;
    this.state.textContent = isSaved ? say("saved") : say(model.file?.saves ? "notSaved" : "kept");
  }

  #openEntries() {
    const { model, page } = this;
    const entries = [
      entry(say("openFile"), () => chooseFile((file) => openFile(model, file, page.start.limits.up / 2, page.notify))),
    ];
    if (model.file?.saves) entries.push(entry(say("save"), () => this.save(), "Ctrl S"));
    return entries;
  }

  #exampleEntries() {
    const { model, page } = this;
    const lesson = entry(say("lesson"), () => page.lesson());
    const own = page.start.examples.map(({ name, text }) => {
      return entry(name.replaceAll("_", " "), () => this.#try(() => model.open({ example: name })), text);
    });
    return [lesson, ...own];
  }

  #exportEntries() {
    return FORMATS.map((format) => entry(say(`format${format[0].toUpperCase()}${format.slice(1)}`), () => this.export(format)));
  }

  async export(format) {
    const { model, page } = this;
    const name = (model.title || say("untitled")).replace(/\.\w+$/, "");
    const fields = { format, name };
    if (["svg", "dxf", "html"].includes(format)) fields.q = model.place;
    if (["csv", "html"].includes(format) && model.driverCount === 1) fields.speed = page.speed();
    page.notify(say("working"), { kind: "working" });
    await this.#try(async () => {
      const { header, arrays } = await model.ask("export", fields);
      download(header.name, header.type, arrays.bytes);
    });
    page.dismiss("working");
  }

  /** Save to the file of the command; over another's changes only if wanted. */
  async save() {
    const { model, page } = this;
    if (!model.file?.saves) return this.export("toml");
    try {
      await model.save();
    } catch (error) {
      if (error.kind !== "changed") return page.notify(say("failed", { reason: error.message }));
      page.notify(say("changedOnDisk"), { action: { text: say("saveOver"), act: () => this.#try(() => model.save(true)) } });
    }
  }

  async #try(act) {
    try {
      await act();
    } catch (error) {
      this.page.notify(say("failed", { reason: error.kind === "disconnected" ? say("offline") : error.message }));
    }
  }
}
