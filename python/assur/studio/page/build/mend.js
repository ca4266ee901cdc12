// Why it does not move, what would mend it, and what it has of what it needs.

import { html, icon } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { allLinks, tableOf } from "../document/names.js";
import { section } from "../window/shell.js";
import { checklist, isOnGround, linksApart } from "./checklist.js";

const DONE = "M5 12l5 5 9-10";
const MISSING = "M6 6l12 12M18 6L6 18";

/** Write a whole number with a true minus. */
const wholeText = (number) => String(number).replace("-", "−");

/** Make one text of names: links and slides bold, joints as symbols. */
function namedText(text, document) {
  const { ground: _, ...links } = allLinks(document);
  const slides = tableOf(document.slides);
  const joints = tableOf(document.joints);
  return text.split(/([\p{L}\p{N}_]+)/u).map((word) => {
    if (Object.hasOwn(links, word) || Object.hasOwn(slides, word)) return html("b", {}, word);
    return Object.hasOwn(joints, word) ? html("i", { class: "name" }, word) : word;
  });
}

/** Return names as a sentence has them: a, b and c. */
export function listedNames(names) {
  if (names.length < 2) return names.join();
  return say("andLast", { names: names.slice(0, -1).join(", "), last: names[names.length - 1] });
}

/** Return what `check` says, in the language of the page where it has words for it. */
export function whyItStands({ state, message, reason, concerned, needed, candidates, joint }, document) {
  const links = listedNames(concerned?.links ?? []);
  if (state === "stuck" && reason === "immovable" && links) return say("whyStuck", { links });
  const isOne = concerned?.links?.length === 1;
  if (state === "loose" && links && needed > 1) return say(isOne ? "whyLooseOne" : "whyLoose", { links, needed });
  if (state === "no_driver" && candidates?.length) return say("whyNoDriver", { links: listedNames(candidates) });
  if (reason === "loose_joint" && joint) return say("whyLooseJoint", { joint });
  if (reason === "unconnected" && links) return say("whyApart", { links });
  if (state !== "no_driver" && state !== "empty") return message;
  if (!Object.keys(allLinks(document)).some((link) => link !== "ground")) return say("whyNoLink");
  if (!isOnGround(document)) return say("whyNoGround");
  const apart = linksApart(document);
  return apart.length ? say("whyApart", { links: listedNames(apart) }) : message;
}

export class Mend {
  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.model = studio.model;
    this.state = "moves";
    this.why = html("p", { class: "why" });
    this.remedies = html("div", { class: "remedies" });
    this.list = html("ul", { class: "checklist" });
    this.counts = html("dl", { class: "facts count" });
    const parts = [this.#part(say("check"), this.list), this.#part(say("count"), this.counts, say("countNote"))];
    const { element, head } = section(say("whatIsMissing"), "dimensions", this.why, this.remedies, ...parts);
    element.classList.add("mend");
    this.element = element;
    this.title = head.firstChild;
    for (const event of ["checked", "document"]) this.model.on(event, () => this.show());
    this.show();
  }

  #part(title, element, note = "") {
    return html("div", { class: "mend-part" }, html("h3", {}, title, html("span", { class: "note" }, note)), element);
  }

  show() {
    const { model } = this;
    const { document, checked } = model;
    const isEmpty = checked.state === "empty" && !Object.keys(tableOf(document.joints)).length;
    // What could not be checked has nothing to mend.
    const isSeen = !["moves", "unchecked"].includes(checked.state) && !isEmpty;
    this.#turnTab();
    this.element.hidden = !isSeen;
    if (!isSeen) return this.#preview(null);
    this.title.textContent = say(checked.state === "stuck" ? "whyItCannotMove" : "whatIsMissing");
    this.why.replaceChildren(...namedText(whyItStands(checked, document), document));
    this.#showRemedies(checked.remedies ?? []);
    this.list.replaceChildren(...checklist(document, checked.counted).map((one) => this.#item(one)));
    this.#count(checked.counted);
  }

  /** Of narrow windows the tab of diagrams has nothing to show when it moves no more: before anything is drawn. */
  #turnTab() {
    const { shell } = this.studio;
    const { rev, checked } = this.model;
    const isStopped = rev && this.state === "moves" && checked.state !== "moves";
    if (isStopped && shell?.element.dataset.tab === "diagrams") shell.choose("dimensions");
    this.state = checked.state;
  }

  #showRemedies(remedies) {
    const { model } = this;
    if (this.shown === remedies) return;
    this.shown = remedies;
    this.#preview(null);
    const cards = remedies.map(({ text, detail = "", document }) => {
      const act = html("button", { type: "button", class: "button" }, say("doIt"));
      const words = html("span", {}, ...namedText(text, model.document), html("span", { class: "note" }, detail));
      const card = html("div", { class: "remedy" }, words, act);
      for (const event of ["pointerenter", "focusin"]) card.addEventListener(event, () => this.#preview(document));
      for (const event of ["pointerleave", "focusout"]) card.addEventListener(event, () => this.#preview(null));
      act.setAttribute("aria-label", `${say("doIt")}: ${text}`);
      act.addEventListener("click", () => this.#apply(document));
      return card;
    });
    this.remedies.replaceChildren(...(cards.length ? [html("h3", {}, say("wouldMove")), ...cards] : []));
  }

  /** Once it moves the drawing is done: what is dragged then moves it, and draws no link. */
  async #apply(document) {
    const { model, studio } = this;
    this.#preview(null);
    await model.edit(document, { place: [] });
    if (model.checked.state === "moves") studio.builder.take("select");
  }

  #preview(document) {
    this.studio.builder?.overlay.preview(document);
  }

  #item({ key, isDone, detail }) {
    const { names, mobility, needed } = detail;
    const text = names ? names.join(", ") : say("mobilityNeeds", { mobility: wholeText(mobility), needed });
    const words = { class: isDone ? "tick" : "cross", role: "img", "aria-label": say(isDone ? "done" : "missing") };
    const mark = html("span", words, icon(isDone ? DONE : MISSING));
    const note = html("span", { class: "note" }, text);
    return html("li", { "data-check": key, "data-done": String(isDone) }, mark, html("span", {}, say(key)), note);
  }

  #count({ moving_links: n = 0, turning_pairs: turning = 0, sliding_pairs: sliding = 0, mobility = 0 }) {
    const rows = [[say("countLinks"), "n", n], [say("countTurning"), sliding ? "" : "p", turning]];
    if (sliding) rows.push([say("countSliding"), "", sliding], [say("countPairs"), "p", turning + sliding]);
    const letter = (own) => html("i", { class: "symbol" }, own);
    const row = ([text, own, value]) => [html("dt", {}, text, " ", letter(own)), html("dd", {}, String(value))];
    const formula = html("dt", {}, "3", letter("n"), " − 2", letter("p"));
    this.counts.replaceChildren(...rows.flatMap(row), formula, html("dd", { class: "total" }, wholeText(mobility)));
  }
}
