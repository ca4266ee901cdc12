// All ways to put the mechanism together at the present position: one is moved over to by a click.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { drivesSlide } from "../document/drivers.js";
import { section } from "../window/shell.js";
import { LiveQuestion } from "./live.js";
import { reachText } from "./reach.js";
import { thumbnail } from "./skeleton.js";
import { panelLength } from "./steps.js";

/** Of more the server lists those that differ in one dyad. */
const ALL_LISTED = 64;

export class AssemblySection {
  #shown = null;

  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.model = studio.model;
    this.list = html("div", { class: "assemblies", role: "group", "aria-label": say("assemblies") });
    this.remark = html("p", { class: "remark" });
    const { element, note } = section(say("assemblies"), "assembly", this.list, this.remark);
    Object.assign(this, { element, note });
    const { model } = this;
    const fields = () => ({ q: model.place });
    const take = (header, error) => this.#take(header, error);
    this.question = new LiveQuestion(studio, element, { kind: "assemblies", fields, take });
    for (const event of ["turn", "checked"]) model.on(event, () => this.#hide());
    model.on("pose", () => this.list.classList.toggle("stale", studio.playback.player.isPlaying));
    model.on("connection", () => this.#lock());
    this.#hide();
  }

  #hide() {
    this.element.hidden = this.model.isSketch || !this.model.moves;
  }

  #lock() {
    for (const one of this.list.children) one.disabled = !this.model.link.isOpen;
  }

  #take(header, error) {
    const hadFocus = this.list.contains(this.list.getRootNode().activeElement);
    this.studio.highlight.other(null);
    if (error) {
      this.list.replaceChildren();
      this.note.textContent = "";
      this.remark.textContent = error.message;
      return;
    }
    const { assemblies, failures, most, is_complete: isComplete } = header;
    this.#shown = header;
    this.note.textContent = say(assemblies.length === 1 ? "oneAssembly" : "someAssemblies", { n: assemblies.length });
    this.list.replaceChildren(...assemblies.map((one, i) => this.#card(one, i)));
    this.list.classList.toggle("many", assemblies.length > 6);
    this.#scroll();
    if (hadFocus) this.list.querySelector("[aria-pressed=true]")?.focus();
    const remarks = [];
    const isOfNeighbours = most > ALL_LISTED;
    if (isOfNeighbours) remarks.push(say("neighbourAssemblies", { most: isComplete ? most : `${most}+` }));
    if (assemblies.length > 1) remarks.push(say("chooseAssembly"));
    if (assemblies.some((one) => one.is_double)) remarks.push(say("doubleAssembly"));
    if (!isComplete && !isOfNeighbours) remarks.push(say("notAllAssemblies", { n: failures.length }));
    this.remark.textContent = remarks.join(" ");
  }

  /** Bring the present one into sight, in the list alone. */
  #scroll() {
    const { list } = this;
    const own = list.querySelector("[aria-pressed=true]");
    if (!own || list.scrollHeight <= list.clientHeight) return;
    list.scrollTop += own.getBoundingClientRect().top - list.getBoundingClientRect().top - 3;
  }

  #card(one, i) {
    const { model } = this;
    const { data } = model;
    const isAngle = !drivesSlide(model.document, model.axis);
    const reach = reachText(one.reach, [this.#shown.q].flat()[0], isAngle, panelLength(data));
    const groups = new Map(data.links.map((link, k) => [link, data.groups[k]]));
    const driven = new Set(data.driven.map((k) => data.links[k]));
    const name = one.is_current ? say("assemblyNow") : say("assemblyOther", { n: i + 1 });
    const text = [name, reach, one.is_double ? say("isDouble") : ""].filter(Boolean).join(" · ");
    const state = { "aria-pressed": String(one.is_current), "data-assembly": i, title: text };
    const card = html("button", { type: "button", class: "assembly", ...state });
    card.append(thumbnail(model.document, one.joints, { driven, groups }), html("span", {}, text));
    const { highlight } = this.studio;
    for (const event of ["pointerenter", "focus"]) {
      card.addEventListener(event, () => {
        highlight.other(one.is_current || this.#isStale ? null : model.document, one.joints);
      });
    }
    for (const event of ["pointerleave", "blur"]) card.addEventListener(event, () => highlight.other(null));
    card.addEventListener("click", () => this.#choose(one));
    return card;
  }

  /** While it plays the list is of another position. */
  get #isStale() {
    return this.studio.playback.player.isPlaying;
  }

  async #choose(one) {
    if (one.is_current || !this.model.link.isOpen) return;
    const { studio, model } = this;
    studio.playback.pause();
    studio.highlight.other(null);
    await model.edit(one.document, { place: this.#shown.q });
  }
}
