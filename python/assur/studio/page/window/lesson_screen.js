// The lesson in place of the picture, the tools and the panel; the document waits meanwhile.

import { html } from "../../../pictures/page/elements.js";
import { button } from "../../../pictures/page/panel.js";
import { say } from "../../../pictures/page/words.js";
import { Lesson } from "../lesson/lesson.js";

const LEAVE = "M10 6l-6 6 6 6M4 12h16";

export class LessonScreen {
  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.lesson = null;
    this.back = button(say("backFromLesson"), LEAVE, say("backFromLesson"));
    this.back.classList.add("back");
    this.back.addEventListener("click", () => this.close());
    studio.bar.element.prepend(this.back);
    // What is opened or undone is to be seen.
    studio.model.on("document", () => this.close());
  }

  get isOpen() {
    return this.lesson !== null;
  }

  open() {
    if (this.isOpen) return;
    const { studio } = this;
    const { model, shell, root } = studio;
    studio.playback.pause();
    this.host = html("div", { class: "lesson" });
    shell.element.append(this.host);
    root.classList.add("in-lesson");
    this.lesson = new Lesson(this.host, (kind, fields) => model.link.ask(kind, model.rev, fields));
    studio.bar.show();
  }

  close() {
    if (!this.isOpen) return;
    this.lesson.close();
    this.lesson = null;
    this.host.remove();
    this.studio.root.classList.remove("in-lesson");
    this.studio.bar.show();
    this.studio.resize();
  }
}
