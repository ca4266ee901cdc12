// The three diagrams of the lesson: γ, φ3 and l4, drawn as it runs.

import { degrees } from "../../../pictures/page/numbers.js";
import { diagramData } from "./curves.js";
import { LessonDiagram } from "./diagram.js";
import { lengthText } from "./entries.js";
import { sayLesson } from "./lesson_words.js";

const WRITTEN = {
  gamma: (value) => `${lengthText(Number(value.toFixed(4)))} rad`,
  phi3: (value) => degrees(value, 1),
  l4: lengthText,
};

export class LessonDiagrams {
  /** @param {(phi1: number) => void} seek */
  constructor(seek) {
    this.all = Object.fromEntries(
      Object.entries(WRITTEN).map(([key, write]) => [key, new LessonDiagram(sayLesson(`${key}Title`), seek, write)]),
    );
  }

  get #each() {
    return Object.entries(this.all);
  }

  get elements() {
    return this.#each.map(([, one]) => one.element);
  }

  /** Show another motion; what has been run stays. */
  replace(motion, givesWay) {
    this.motion = motion;
    const data = diagramData(motion, givesWay);
    for (const [key, one] of this.#each) one.replace(data[key]);
  }

  /** Forget what has been run. */
  clear() {
    for (const [, one] of this.#each) one.clear();
  }

  /** Note what has been run, from one crank angle to another. */
  record(from, to) {
    const { motion } = this;
    const pose = motion.pose();
    const figures = new Map();
    const at = (phi1, key) => {
      if (!figures.has(phi1)) figures.set(phi1, motion.sample(phi1, pose).known ? motion.figures(pose) : {});
      return figures.get(phi1)[key] ?? NaN;
    };
    for (const [key, one] of this.#each) one.record(from, to, (phi1) => at(phi1, key));
  }

  /** Move the cursors. */
  show(phi1, figures) {
    for (const [key, one] of this.#each) one.show(phi1, figures[key]);
  }

  resize() {
    for (const [, one] of this.#each) one.resize();
  }
}
