// What is said on the picture: which condition fails, where C jams, what would keep it swinging.

import { html } from "../../../pictures/page/elements.js";
import { lengthText, turnText } from "./entries.js";
import { sayLesson } from "./lesson_words.js";
import { withSymbols } from "./symbols.js";

const WHOLE = 2 * Math.PI - 1e-9;

/** Return what would keep the rocker swinging all around. */
function advice(header, l4, side) {
  const { ground_range: range } = header;
  if (!range) return sayLesson("noGround");
  const limit = (end) => ({ limit: lengthText(Number(end.toFixed(3))) });
  if (side === "outer" && l4 >= range[1]) return sayLesson("below", limit(range[1]));
  if (side === "inner" && l4 <= range[0]) return sayLesson("above", limit(range[0]));
  return "";
}

/**
 * Return what is to be said, null if nothing.
 * @param {import("./motion.js").LessonMotion} motion
 * @param {{phi1: number, speed: number, givesWay: boolean, isDead: boolean}} state
 * @returns {{kind: string, title: string, text: string} | null}
 */
export function lessonWarning(motion, { phi1, speed, givesWay, isDead }) {
  const { header, lengths, stretches } = motion;
  const blocked = stretches.filter((one) => one.side !== null);
  // In the sense of turning: where it jams and where the rocker swings again.
  const ends = ({ start, end }) => {
    const [from, to] = speed > 0 ? [start, end] : [end, start];
    return { from: turnText(from), to: turnText(to) };
  };
  const told = (one) => ({ ...ends(one), advice: advice(header, lengths.l4, one.side) });
  const here = motion.stretchAt(phi1);
  const isAlways = (one) => one.end - one.start >= WHOLE;
  const turns = header.turns ? "" : conditions(header);
  if (isDead) {
    const title = sayLesson("deadTitle", { angle: turnText(phi1) });
    return { kind: "dead", title, text: sayLesson("dead") };
  }
  if (here.side !== null) {
    const word = `${givesWay ? "sliding" : "jammed"}${isAlways(here) ? "Always" : ""}`;
    const title = sayLesson(givesWay ? "slidingTitle" : "jammedTitle");
    const text = [turns, sayLesson(word, told(here))].join(" ").trim();
    return { kind: givesWay ? "sliding" : "jammed", title, text };
  }
  if (!header.turns) {
    const there = blocked.map((one) => sayLesson(givesWay ? "slidesThere" : "fallsStops", told(one)));
    return { kind: "turns", title: sayLesson("cannotTurn"), text: [turns, ...there].join(" ") };
  }
  if (!blocked.length) return null;
  const text = blocked.map((one) => sayLesson(givesWay ? "fallsGives" : "fallsStops", told(one))).join(" ");
  return { kind: "falls", title: sayLesson("fallsTitle", { least: lengthText(header.gamma_min) }), text };
}

/** Return the sums that fail, as sentences. */
function conditions({ conditions: all }) {
  const symbols = (sum) => sum.replace(/l(\d)/g, "l_$1");
  const failed = all.filter((one) => !one.holds);
  const sentence = ({ less, greater, sums: [sum, other] }) => {
    const sides = { less: symbols(less), greater: symbols(greater) };
    return sayLesson("condition", { ...sides, sum: lengthText(sum), other: lengthText(other) });
  };
  return failed.map(sentence).join(" ");
}

export class WarningCard {
  constructor() {
    this.title = html("h3", {});
    this.text = html("p", {});
    this.element = html("div", { class: "lesson-warning", role: "status", hidden: "" }, this.title, this.text);
    this.key = "";
  }

  /** Show a warning; what is said already stays as it is. */
  show(warning) {
    const key = warning ? `${warning.kind} ${warning.title} ${warning.text}` : "";
    if (key === this.key) return;
    this.key = key;
    this.element.hidden = !warning;
    if (!warning) return;
    this.element.className = `lesson-warning lesson-warning-${warning.kind}`;
    const sign = html("span", { class: "lesson-sign", "aria-hidden": "true" }, "!");
    this.title.replaceChildren(sign, html("span", {}, ...withSymbols(warning.title)));
    this.text.replaceChildren(...withSymbols(warning.text));
  }
}
