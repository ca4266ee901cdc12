// What an empty canvas offers: to draw a link, or to open one of three examples.

import { Drawing } from "../../../pictures/page/draw.js";
import { html, svg } from "../../../pictures/page/elements.js";
import { Turn } from "../../../pictures/page/turn.js";
import { say } from "../../../pictures/page/words.js";
import { tableOf } from "../document/names.js";
import { sketchScene } from "../document/sketch.js";

const OFFERED = ["crank_rocker", "engine", "jansen_leg"];
/** A smallPicture, px, and its margin. */
const THUMB = [150, 100];
const THUMB_MARGIN = 16;

/** Draw a document as a small picture. */
export function smallPicture(document) {
  const [width, height] = THUMB;
  const scene = sketchScene(document);
  const [x0, y0, x1, y1] = scene.bounds;
  const scale = Math.min((width - 2 * THUMB_MARGIN) / (x1 - x0), (height - 2 * THUMB_MARGIN) / (y1 - y0));
  const [x, y] = [width / 2 - (scale * (x0 + x1)) / 2, height / 2 + (scale * (y0 + y1)) / 2];
  const layer = svg("g", { transform: `translate(${x} ${y})` });
  const drawing = new Drawing(scene, layer);
  const turn = new Turn(scene.turn);
  const pose = turn.pose();
  turn.sample(0, pose);
  drawing.zoom(scale, 0.5);
  drawing.show(pose);
  return svg("svg", { class: "picture thumb", viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" }, layer);
}

export class Beginning {
  /** @param {import("./builder.js").Builder} builder */
  constructor(builder) {
    this.builder = builder;
    const { canvas, model } = builder;
    const draw = html("button", { type: "button", class: "button primary" }, say("drawALink"));
    draw.addEventListener("click", () => {
      builder.take("link");
      canvas.picture.focus();
    });
    this.examples = html("div", { class: "offered" });
    const or = html("p", { class: "note" }, say("orExample"));
    this.element = html("div", { class: "beginning", hidden: "" }, draw, or, this.examples);
    canvas.element.append(this.element);
    for (const event of ["document", "checked", "tool"]) model.on(event, () => this.show());
    this.show();
  }

  show() {
    const { model, tool } = this.builder;
    const { joints, slides } = model.document;
    const isEmpty = !Object.keys(tableOf(joints)).length && !Object.keys(tableOf(slides)).length;
    this.element.hidden = !isEmpty || Boolean(tool) || model.rev === 0;
    if (!this.element.hidden) this.#offer();
  }

  /** The examples are asked for once they are seen. */
  async #offer() {
    const { model } = this.builder;
    if (this.isOffered) return;
    this.isOffered = true;
    try {
      const answers = await Promise.all(OFFERED.map((example) => model.link.ask("open", model.rev, { example })));
      this.examples.replaceChildren(...answers.map(({ header }, i) => this.#card(OFFERED[i], header.document)));
    } catch {
      // Without a connection there are none; the next time it asks again.
      this.isOffered = false;
    }
  }

  async #open(example) {
    const { model, studio } = this.builder;
    try {
      await model.open({ example });
    } catch (error) {
      studio.notify(say("failed", { reason: error.kind === "disconnected" ? say("offline") : error.message }));
    }
  }

  #card(name, document) {
    const title = html("span", {}, name.replaceAll("_", " "));
    const card = html("button", { type: "button", class: "offer", "data-example": name }, smallPicture(document), title);
    card.addEventListener("click", () => this.#open(name));
    return card;
  }
}
