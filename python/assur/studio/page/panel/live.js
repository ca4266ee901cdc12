// Questions that the server is asked again whenever what they are about has changed.

import { newestOnly } from "../model/link.js";

/** While it plays, at most so often, ms. */
const WHILE_PLAYING = 250;

export class LiveQuestion {
  #asked = "";
  #last = 0;
  #newest = newestOnly(() => this.#send());

  /**
   * @param {import("../studio.js").Studio} studio
   * @param {HTMLElement} element nothing is asked while it is not seen
   * @param {{kind: string, fields: () => Object | null, take: (header: Object | null, error?: Error) => void,
   *   isLive?: boolean, seen?: () => void}} question `isLive`: also while it plays; `seen`: it is seen from now on
   */
  constructor(studio, element, { kind, fields, take, isLive = false, seen }) {
    Object.assign(this, { studio, kind, fields, take, isLive, isSeen: false });
    for (const event of ["settled", "told"]) studio.model.on(event, () => this.ask());
    if (isLive) studio.model.on("pose", () => this.#whilePlaying());
    new IntersectionObserver((entries) => {
      this.isSeen = entries[entries.length - 1].isIntersecting;
      if (!this.isSeen) return;
      seen?.();
      this.ask();
    }).observe(element);
  }

  get #isTold() {
    const { model, playback } = this.studio;
    const isThere = model.moves && !model.isSketch && !model.isDragging && !model.problem;
    if (!this.isSeen || !isThere || !model.link.isOpen) return false;
    return this.isLive || !playback.player.isPlaying;
  }

  /** Ask, unless that has been asked already. */
  ask() {
    if (this.#isTold) this.#newest.push(null);
  }

  /** What was answered is no longer shown: ask it again. */
  again() {
    this.#asked = "";
    this.ask();
  }

  #whilePlaying() {
    const now = performance.now();
    if (!this.studio.playback.player.isPlaying || now - this.#last < WHILE_PLAYING) return;
    this.#last = now;
    this.ask();
  }

  async #send() {
    const { model } = this.studio;
    const fields = this.#isTold ? this.fields() : null;
    if (!fields) return;
    const { rev } = model;
    const key = `${rev} ${JSON.stringify(fields)}`;
    if (key === this.#asked) return;
    this.#asked = key;
    try {
      const answer = await model.ask(this.kind, fields);
      if (!answer || rev !== model.rev) this.#asked = "";
      else this.take(answer.header);
    } catch (error) {
      this.#asked = "";
      if (rev === model.rev && error.kind !== "disconnected") this.take(null, error);
    }
  }
}
