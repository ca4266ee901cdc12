// Puts a page together: picture, dial, play, diagrams, switches, keys.

import { Canvas } from "./canvas.js";
import { Gestures, isZoom } from "./drag.js";
import { driving } from "./driving.js";
import { html } from "./elements.js";
import { holdKeys, listenForKeys, playingKey } from "./keys.js";
import { button, formula } from "./panel.js";
import { Playback } from "./playback.js";
import { pointState } from "./quantities.js";
import { fromBase64, Turn } from "./turn.js";
import { say } from "./words.js";

const SCHEME = "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18";
/** Of a bounded range: as near to a dead point counts as there. */
const AT_END = 1e-4;

/** Return the turn of a page's data: one that is a file has its numbers as text. */
export function turnFrom(data) {
  const { values } = data.turn;
  return new Turn({ ...data.turn, values: typeof values === "string" ? fromBase64(values) : values });
}

/**
 * Return what is wrong where it is, or an empty text.
 * @param {Playback} playback
 */
export function whatIsWrong(playback) {
  const { data, turn, pose, player } = playback;
  if (!pose.known) return say("nothing", { q: playback.place(player.q) });
  const near = AT_END * (turn.high - turn.low);
  const dead = player.isPlaying ? undefined : data.turn.dead.find((point) => Math.abs(point.q - pose.q) < near);
  return dead ? say("atDeadPoint", { q: playback.place(dead.q), group: dead.group }) : "";
}

/** Tell screen readers where it is. */
export function tellPosition(canvas, playback) {
  const { data, player } = playback;
  const q = playback.place(playback.pose.q);
  const title = data.title || say("mechanism");
  const sentence = say("picture", { title, links: data.links.length - 1, driver: data.driver, q });
  canvas.picture.setAttribute("aria-label", sentence);
  canvas.status.textContent = player.isPlaying ? say("playing") : say("paused", { q });
}

/** Make the button of light and dark. */
export function schemeButton(root) {
  const scheme = button(say("scheme"), SCHEME);
  scheme.addEventListener("click", () => {
    const isDark = getComputedStyle(root).getPropertyValue("--dark").trim() === "1";
    root.dataset.theme = isDark ? "light" : "dark";
  });
  return scheme;
}

/**
 * Show a mechanism.
 * @param {HTMLElement} root what the page fills
 * @param {Object} data what Python wrote: see payload.py
 */
export function mount(root, data) {
  const turn = turnFrom(data);
  const canvas = new Canvas(root, data, turn);
  const { stage } = canvas;
  canvas.corner.append(schemeButton(root));
  const playback = new Playback(data, turn, {
    show(pose) {
      stage.show(pose, playback.player.speed * playback.player.sense);
      canvas.warn(whatIsWrong(playback));
    },
    told: () => tellPosition(canvas, playback),
  });
  const head = html("header", { class: "head" }, html("h1", {}, data.title), formula(data.formula));
  root.replaceChildren(html("div", { class: "frame" }, head, canvas.element, playback.element));

  const isEmbedded = root.classList.contains("embedded");
  const gestures = new Gestures(canvas.picture, {
    ...driving(canvas, playback),
    takesWheel: (event) => !isEmbedded || isZoom(event),
  });
  if (isEmbedded) {
    holdKeys(root);
    canvas.fit.title = say("wheelZooms");
  }
  listenForKeys(root, (key, isShift) => playingKey(playback, stage, key, isShift));

  const resize = () => {
    canvas.resize();
    playback.resize();
  };
  stage.measure();
  resize();
  new ResizeObserver(resize).observe(root);
  playback.show();
  playback.tell();
  const pointAt = (joint) => pointState(playback.pose, joint.link, joint.at);
  return { player: playback.player, stage, turn, charts: playback.charts, gestures, seek: (q) => playback.seek(q), pointAt };
}
