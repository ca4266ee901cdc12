// The projector view: the picture, a title, one number, sliders; all of it large.

import { html, icon } from "../../../pictures/page/elements.js";
import { allQuantities } from "../../../pictures/page/quantities.js";
import { button } from "../../../pictures/page/panel.js";
import { say } from "../../../pictures/page/words.js";
import { DrivingSliders } from "./drivingsliders.js";
import { greatestOf, numberText, placeQuantities } from "./number.js";
import { designChoices } from "./choices.js";

/** Symbols are so many times larger. */
const MAGNIFIED = 1.6;
const PLAYING = "M7 5h4v14H7zM13 5h4v14h-4z";
const RESTING = "M8 5v14l11-7z";

export class Projector {
  /** @param {Object} page the studio */
  constructor(page) {
    this.page = page;
    this.model = page.model;
    this.isOn = false;
    this.title = html("h1");
    this.choice = html("select", { class: "projector-choice", "aria-label": say("numberChoice") });
    this.choice.addEventListener("change", () => {
      designChoices(this.model).number = this.choice.value;
      this.#pick();
    });
    this.number = html("output", { class: "projector-number" });
    const name = html("span", { class: "choose" }, this.choice);
    const choose = html("label", { class: "projector-value" }, name, this.number);
    this.head = html("header", { class: "projector-head" }, this.title, choose);
    this.play = button(say("play"), RESTING);
    this.play.addEventListener("click", () => page.playback.toggle());
    this.play.classList.add("play");
    this.close = button(say("endProjector"), "M6 6l12 12M18 6L6 18");
    this.close.addEventListener("click", () => this.toggle());
    this.sliders = new DrivingSliders(page);
    this.foot = html("footer", { class: "projector-foot" }, this.play, this.sliders.element, this.close);
    page.shell.element.append(this.head, this.foot);
    this.head.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.toggle();
    });
    this.model.on("turn", () => this.isOn && this.#take());
    this.model.on("pose", () => this.isOn && this.#show());
    this.model.on("told", () => this.isOn && this.#tell());
    this.model.on("settled", () => this.isOn && this.sliders.measure());
    this.model.on("file", () => this.#name());
    // Escape leaves the full screen without a key that the page would see.
    page.root.onfullscreenchange = () => {
      if (!document.fullscreenElement && this.isOn && this.wasFull) this.toggle();
    };
  }

  /** Begin it, or end it. */
  toggle() {
    const { page } = this;
    this.isOn = !this.isOn;
    this.wasFull = false;
    page.shell.element.classList.toggle("projector", this.isOn);
    page.canvas.stage.magnify(this.isOn ? MAGNIFIED : 1);
    if (this.isOn) {
      this.before = page.root.getRootNode().activeElement;
      this.#take();
      this.sliders.measure();
      // In a notebook keys are those of the focus.
      if (page.isEmbedded) page.canvas.picture.focus();
      else this.before?.blur?.();
      const wanted = page.root.requestFullscreen?.();
      // Where the browser does not let it fills the window.
      wanted?.then(() => (this.wasFull = true), () => {});
    } else {
      if (document.fullscreenElement) document.exitFullscreen();
      this.before?.focus?.();
    }
    page.resize();
    if (page.canvas.stage.isFitted) page.canvas.stage.fit();
  }

  /** Take another turn: what can be chosen, and what slides. */
  #take() {
    const { model, choice } = this;
    const groups = [...placeQuantities(model.data), ...allQuantities(model.data)];
    this.quantities = groups.flatMap((group) => group.quantities);
    const ids = this.quantities.map((one) => one.id).join();
    if (choice.dataset.offered !== ids) {
      choice.dataset.offered = ids;
      const textOf = (one) => (one.isPlace ? say("placeOfPoint", { name: one.of }) : `${one.of} ${say(one.what)}`);
      const option = (one) => html("option", { value: one.id }, textOf(one));
      choice.replaceChildren(...groups.map(({ name, quantities }) => {
        const group = html("optgroup", { label: name });
        group.append(...quantities.map(option));
        return group;
      }));
    }
    this.sliders.take();
    this.#name();
    this.#pick();
    this.#tell();
  }

  #name() {
    this.title.textContent = this.model.title || say("mechanism");
  }

  /** The chosen number; the output's, of several drivers the place of the output's point. */
  #pick() {
    const { model, quantities } = this;
    const { number } = designChoices(model);
    const { paths, diagrams } = model.data;
    const usual = model.driverCount > 1 && paths.length ? `${paths[0]}.place` : diagrams[0];
    const found = [number, usual].map((id) => quantities.find((one) => one.id === id)).find(Boolean);
    this.quantity = found ?? quantities[0];
    this.choice.parentElement.hidden = !quantities.length;
    this.choice.value = this.quantity?.id ?? "";
    const { player } = this.page.playback;
    this.greatest = this.quantity ? greatestOf(this.quantity, model.turn, player.speed) : 0;
    this.#show();
  }

  #show() {
    const { quantity, page } = this;
    const { pose, player } = page.playback;
    const speed = player.speed * player.sense;
    this.number.textContent = quantity && pose.known ? numberText(quantity, pose, speed, this.greatest) : "–";
    this.sliders.show();
  }

  #tell() {
    const { player } = this.page.playback;
    const text = say(player.isPlaying ? "pause" : "play");
    this.play.replaceChildren(icon(player.isPlaying ? PLAYING : RESTING));
    for (const name of ["title", "aria-label"]) this.play.setAttribute(name, text);
    this.play.disabled = this.model.isSketch;
    this.sliders.show();
  }
}
