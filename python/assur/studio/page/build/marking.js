// Links that stand out: those that hold each other, those that could drive, the one that is chosen.

/** States in which the links concerned hold each other. */
const HOLDING = ["stuck"];

export class Marking {
  /** @param {import("./builder.js").Builder} builder */
  constructor(builder) {
    this.builder = builder;
    builder.model.on("checked", () => this.show());
  }

  /** Return the links that hold each other, in their order. */
  held() {
    const { checked } = this.builder.model;
    return HOLDING.includes(checked.state) ? (checked.concerned?.links ?? []).filter((link) => link !== "ground") : [];
  }

  /** Return the links that a click would make drivers, if that is what is asked. */
  candidates() {
    const { checked } = this.builder.model;
    const { name } = this.builder;
    return checked.state === "no_driver" && name === "driver" ? (checked.candidates ?? []) : [];
  }

  show() {
    const { overlay, canvas, choice, model } = this.builder;
    const held = this.held();
    const linksOf = (name) => (model.document.slides?.[name] ? this.#linksOfSlide(name) : [name]);
    const kinds = { held, candidate: this.candidates().flatMap(linksOf), chosen: choice?.links() ?? [] };
    overlay.links = Object.entries(kinds).flatMap(([kind, names]) => names.map((name) => ({ name, kind })));
    const { drawing } = canvas.stage;
    for (const { link, element } of drawing.groups) {
      const name = drawing.scene.links[link];
      element.classList.toggle("holds", held.includes(name));
      element.classList.toggle("last", held.length > 1 && held[held.length - 1] === name);
    }
    overlay.show();
  }

  #linksOfSlide(slide) {
    const { stage } = this.builder.canvas;
    const own = stage.data.slides.find(({ name }) => name === slide);
    return own ? [stage.data.links[own.link]] : [];
  }
}
