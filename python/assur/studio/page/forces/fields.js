// Fields of a section that is made anew whenever the document changes: what is typed, the focus and
// what is wrong with a field stay.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { parseQuantity, writeQuantity } from "../document/units.js";

/**
 * Read a quantity as a field has it.
 * @param {string} text
 * @param {{unit: string, shown?: string, isOptional?: boolean, check?: (value: number) => string | null}} field
 *   `check` returns the key of what is wrong with a number
 * @returns {{value: number | null} | {error: string}} a sentence
 */
export function readField(text, { unit, shown = unit, isOptional = false, check = () => null }) {
  if (isOptional && !text.trim()) return { value: null };
  const read = parseQuantity(text, unit, shown);
  const error = read.error ?? check(read.value);
  if (!error) return read;
  return { error: say(error, { text: text.trim(), ...read.values }) };
}

/** A number that must not be negative, or must be more than zero. */
export const notNegative = (value) => (value < 0 ? "mustNotBeNegative" : null);
export const positive = (value) => (value > 0 ? null : "mustBePositive");

export class Fields {
  /** @param {HTMLElement} container whose children are made anew */
  constructor(container) {
    this.container = container;
    /** What is wrong, by the keys of fields: the text and the sentence. */
    this.bad = new Map();
  }

  /**
   * Make a field of a quantity.
   * @param {string} key
   * @param {{label: string, value: number | null | undefined, unit: string, shown?: string, isOptional?: boolean,
   *   hint?: string, check?: (value: number) => string | null, set: (value: number | null) => void, error?: string,
   *   hasUnit?: boolean}} options `error` is what the server says of it; `hasUnit` false: it stands elsewhere
   */
  quantity(key, options) {
    const { label, value, unit, shown = unit, hint = "", error = "", hasUnit = true } = options;
    const own = value === null || value === undefined ? "" : writeQuantity(value, unit, shown);
    const input = html("input", {
      class: "number", inputmode: "text", autocomplete: "off", spellcheck: "false",
      ...{ "aria-label": label, "data-key": key, placeholder: hint },
    });
    const message = html("p", { class: "field-error", id: `field-${key.replace(/\W/g, "-")}` });
    const tell = (sentence) => {
      message.textContent = sentence;
      message.hidden = !sentence;
      input.setAttribute("aria-invalid", String(Boolean(sentence)));
      if (sentence) input.setAttribute("aria-describedby", message.id);
      else input.removeAttribute("aria-describedby");
    };
    input.value = this.bad.get(key)?.text ?? own;
    input.dataset.shown = own;
    tell(this.bad.get(key)?.error ?? error);
    input.addEventListener("change", () => {
      const read = readField(input.value, options);
      if (read.error) this.bad.set(key, { text: input.value, error: read.error });
      else this.bad.delete(key);
      tell(read.error ?? "");
      if (!read.error && read.value !== (value ?? null)) options.set(read.value);
      else if (!read.error) input.value = own;
    });
    input.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      this.bad.delete(key);
      input.value = own;
      tell(error);
    });
    const box = html("span", { class: "unit-field" }, input);
    if (hasUnit && shown) box.append(html("span", { class: "unit" }, shown));
    return { box, message, input, label };
  }

  /** Make a row of a label and a field, what is wrong below it. */
  row(key, options) {
    const { box, message } = this.quantity(key, options);
    return html(
      "div", { class: "field-row" }, html("label", { class: "row" }, html("span", {}, options.label), box), message,
    );
  }

  /**
   * Make a choice.
   * @param {string} key
   * @param {{label: string, options: [string, string][], value: string, set: (value: string) => void}} options
   */
  choice(key, { label, options, value, set }) {
    const select = html("select", { class: "select", "aria-label": label, "data-key": key });
    for (const [own, text] of options) select.append(html("option", { value: own }, text));
    select.value = value;
    select.addEventListener("change", () => set(select.value));
    return select;
  }

  choiceRow(key, options) {
    return html("label", { class: "row" }, html("span", {}, options.label), this.choice(key, options));
  }

  /**
   * Make a field of several lines.
   * @param {string} key
   * @param {{label: string, text: string, read: (text: string) => {error?: string}, set: (read: Object) => void,
   *   hint?: string}} options
   */
  lines(key, { label, text, read, set, hint = "" }) {
    const area = html("textarea", {
      class: "lines", rows: 6, "aria-label": label, "data-key": key, spellcheck: "false",
    });
    const message = html("p", { class: "field-error" }, this.bad.get(key)?.error ?? "");
    message.hidden = !message.textContent;
    area.value = this.bad.get(key)?.text ?? text;
    area.dataset.shown = text;
    area.setAttribute("aria-invalid", String(this.bad.has(key)));
    area.addEventListener("change", () => {
      const found = read(area.value);
      if (found.error) this.bad.set(key, { text: area.value, error: found.error });
      else this.bad.delete(key);
      message.textContent = found.error ?? "";
      message.hidden = !found.error;
      area.setAttribute("aria-invalid", String(Boolean(found.error)));
      if (!found.error) set(found);
    });
    return html(
      "div",
      { class: "field-row" },
      html("label", { class: "lines-label" }, html("span", { class: "note" }, label), area),
      html("p", { class: "hint" }, hint),
      message,
    );
  }

  /** Let a field that was made anew have what was being typed; it counts as changed when it is left. */
  #goOn(input, typed) {
    input.value = typed;
    let isDone = false;
    input.addEventListener("change", () => (isDone = true));
    const leave = () => {
      if (!isDone && input.value !== input.dataset.shown) input.dispatchEvent(new Event("change"));
    };
    input.addEventListener("blur", leave, { once: true });
  }

  /** Show other children; the focus stays, with what is typed there. */
  show(...children) {
    const { container } = this;
    const active = container.getRootNode().activeElement;
    const key = container.contains(active) ? active.dataset.key : undefined;
    const isTyped = key !== undefined && active.dataset.shown !== undefined && active.value !== active.dataset.shown;
    const typed = isTyped ? active.value : null;
    container.replaceChildren(...children);
    if (key === undefined) return;
    const again = [...container.querySelectorAll("[data-key]")].find((one) => one.dataset.key === key);
    if (!again) return;
    again.focus({ preventScroll: true });
    if (typed !== null) this.#goOn(again, typed);
    else if (again.select && again.tagName === "INPUT" && again.type !== "checkbox") again.select();
  }
}

/**
 * Return a function that calls another once, when what is going on is done: a field that was left
 * for another is not taken away meanwhile.
 */
export function later(act) {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(act, 0);
  };
}
