// A field of the lesson: a symbol, what is typed, its unit, and why it cannot be taken.

import { html, put } from "../../../pictures/page/elements.js";
import { learn, say } from "../../../pictures/page/words.js";
import { FIELD_WORDS } from "../words/fields.js";
import { readTyped, typedText } from "./entries.js";
import { plainText, withSymbols } from "./symbols.js";

learn(FIELD_WORDS);

let lessonFields = 0;

export class LessonField {
  /**
   * @param {{key: string, label: string, name: string, kind: keyof typeof import("./entries.js").FIELD_KINDS,
   *   unit?: string, check?: (value: number) => string}} options `label` is seen, `name` is read
   *   aloud; `check` returns why a number cannot be taken
   * @param {() => void} changed
   */
  constructor(options, changed) {
    this.options = options;
    this.kind = options.kind;
    this.kept = NaN;
    const id = `lesson-field-${(lessonFields += 1)}`;
    const typing = { id, class: "lesson-input", inputmode: "text", autocomplete: "off", spellcheck: "false" };
    this.input = html("input", { ...typing, "aria-label": plainText(options.name) });
    this.unit = html("span", { class: "lesson-unit" }, options.unit ?? "");
    this.message = html("p", { id: `${id}-error`, class: "lesson-error", role: "alert", hidden: "" });
    put(this.input, "aria-describedby", `${id}-error`);
    const label = html("label", { for: id, class: "lesson-label" }, ...withSymbols(options.label));
    this.box = html("span", { class: "lesson-box" }, this.input, this.unit);
    this.element = html("div", { class: `lesson-field lesson-field-${options.key}` }, label, this.box, this.message);
    this.input.addEventListener("input", () => {
      this.refuse(this.#fault());
      changed();
    });
  }

  /** What is typed, NaN if it cannot be taken. */
  get value() {
    return this.#fault() ? NaN : (readTyped(this.input.value, this.kind).value ?? NaN);
  }

  get isValid() {
    return Number.isFinite(this.value);
  }

  /** Whether what is typed differs from what is shown in the picture. */
  get isDirty() {
    return this.input.value !== this.shown;
  }

  /**
   * Show a value that is in the picture now.
   * @param {string} [typed] only in the place of this text: another was typed since
   */
  keep(value, typed = this.input.value) {
    this.kept = value;
    this.shown = typedText(value, this.kind);
    if (this.input.value !== typed) return;
    this.input.value = this.shown;
    this.refuse("");
  }

  /** Say why a value cannot be taken; an empty text takes it back. */
  refuse(text) {
    this.message.replaceChildren(...withSymbols(text));
    this.message.hidden = text === "";
    put(this.input, "aria-invalid", String(text !== ""));
  }

  /** Read it, or only show it. */
  lock(isLocked) {
    this.input.readOnly = isLocked;
  }

  #fault() {
    const { kind, options } = this;
    const unit = this.unit.textContent;
    const kept = `${typedText(this.kept, kind)}${unit && unit !== "°" ? " " : ""}${unit}`;
    const { value, error, values } = readTyped(this.input.value, kind);
    if (error) return `${say(error, values)} ${say("pictureKeeps", { kept })}`;
    return options.check?.(value, kept) ?? "";
  }
}
