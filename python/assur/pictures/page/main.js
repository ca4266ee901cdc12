// Puts a page together: picture, dial, play, diagrams, switches, keys.

import { Chart } from "./chart.js";
import { Dial } from "./dial.js";
import { Gestures, linkAt, nearestCoordinate } from "./drag.js";
import { html, svg } from "./elements.js";
import { degrees, digits, lengthUnit, tickText } from "./numbers.js";
import { button, formula, pointChoice, switchRow } from "./panel.js";
import { Player } from "./player.js";
import { allQuantities, pointState, toLocal } from "./quantities.js";
import { Stage } from "./stage.js";
import { fromBase64, Turn } from "./turn.js";
import { say } from "./words.js";

const PLAY = "M8 5v14l11-7z";
const PAUSE = "M7 5h4v14H7zM13 5h4v14h-4z";
const HOME = "M6 5h2.4v14H6zM19 5v14L9.5 12z";
const FIT = "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5";
const SCHEME = "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18";
const DEGREE = Math.PI / 180;
/** Of a bounded range: as near to a dead point counts as there. */
const AT_END = 1e-4;

/**
 * Show a mechanism.
 * @param {HTMLElement} root what the page fills
 * @param {Object} data what Python wrote: see payload.py
 * @returns {{player: Player, stage: Stage, seek: (q: number) => void}}
 */
export function mount(root, data) {
  // A page that is a file has its numbers as text.
  const { values } = data.turn;
  const turn = new Turn({ ...data.turn, values: typeof values === "string" ? fromBase64(values) : values });
  const unit = data.turn.unit;
  const pose = turn.pose();
  const { name: lengthName, factor } = lengthUnit(Math.max(data.bounds[2] - data.bounds[0], data.bounds[3] - data.bounds[1]));
  const scaled = { angle: 1 / DEGREE, length: factor, time: 1 }[unit];
  const place = (q) => (unit === "angle" ? degrees(q) : `${digits(q * scaled)} ${unit === "time" ? "s" : lengthName}`);

  // The parts.
  const picture = svg("svg", { class: "picture", role: "img", tabindex: 0 });
  const stage = new Stage(data, turn, picture);
  const canvas = html("div", { class: "canvas" }, picture);
  const status = html("p", { class: "status", role: "status", "aria-live": "polite" });
  const warning = html("p", { class: "warning", hidden: "" });
  const play = button(say("play"), PLAY);
  play.classList.add("play");
  const home = button(say("home"), HOME);
  const fit = button(say("fit"), FIT, say("fit"));
  const scheme = button(say("scheme"), SCHEME);
  const slower = html("p", { class: "hint slower" });
  const player = new Player(turn, show);
  const dial = new Dial(data, turn, { label: say("dial", { driver: data.driver }), text: place, seek });
  const groups = allQuantities(data);
  const charts = data.diagrams.map((id, i) => {
    const words = (one) => `${one.of} ${say(one.what)}`;
    const label = say("diagram", { n: i + 1 });
    const chart = new Chart(turn, groups, { label, unit, words, seek, place: (q) => tickText(q * scaled), scaled });
    chart.choose(id);
    return chart;
  });

  const speed = html("input", { class: "number", inputmode: "decimal", "aria-label": say("speed"), value: String(data.speed) });
  const speedUnit = { angle: "rad/s", length: "m/s", time: "" }[unit];
  const speedField = html("label", { class: "speed", title: say("speed") }, html("i", {}, unit === "angle" ? "ω" : "v"), speed, html("span", {}, speedUnit));
  if (unit === "time") speedField.hidden = true;
  const switches = { names: true, paths: true, velocity: false, acceleration: false, positions: false, groups: false };
  const points = pointChoice(data.joints, data.paths, choose);
  const row = switchRow(switches, (state) => {
    stage.set(state);
    root.classList.toggle("grouped", state.groups);
  });
  const corner = html("div", { class: "corner" }, points, fit, scheme);
  canvas.append(status, warning, corner, row);
  const frame = html(
    "div",
    { class: "frame" },
    html("header", { class: "head" }, html("h1", {}, data.title), formula(data.formula)),
    canvas,
    html(
      "div",
      { class: "dock" },
      html("div", { class: "drive" }, dial.element, html("div", { class: "play-row" }, play, home), speedField, slower),
      html("div", { class: "charts" }, ...charts.map((chart) => chart.element)),
    ),
  );
  root.replaceChildren(frame);

  /** Show a coordinate: everything that moves. */
  function show(q) {
    turn.sample(q, pose);
    stage.show(pose, player.speed * player.sense);
    dial.show(pose.q, second());
    for (const chart of charts) chart.show(pose);
    const dead = player.isPlaying ? undefined : data.turn.dead.find((point) => Math.abs(point.q - pose.q) < AT_END * (turn.high - turn.low));
    warning.hidden = pose.known && !dead;
    if (dead) warning.textContent = say("atDeadPoint", { q: place(dead.q), group: dead.group });
    if (!pose.known) warning.textContent = say("nothing", { q: place(q) });
  }

  function second() {
    if (!turn.closes) return unit === "angle" ? say("of", { low: degrees(turn.low, 0), high: degrees(turn.high, 0) }) : "";
    const turns = Math.round((turn.high - turn.low) / (2 * Math.PI));
    if (unit !== "angle") return "";
    return say("turn", { n: 1 + player.turns * turns + Math.floor((pose.q - turn.low) / (2 * Math.PI)) });
  }

  /** Go to a coordinate by hand. */
  function seek(q) {
    player.seek(q);
    tell();
  }

  /** Tell screen readers where it is. */
  function tell() {
    const at = place(pose.q);
    dial.tell(pose.q);
    const links = data.links.length - 1;
    const title = data.title || say("mechanism");
    picture.setAttribute("aria-label", say("picture", { title, links, driver: data.driver, q: at }));
    status.textContent = player.isPlaying ? say("playing") : say("paused", { q: at });
  }

  function toggle() {
    if (player.isPlaying) player.pause();
    else player.play();
    const isPlaying = player.isPlaying;
    play.replaceChildren(svg("svg", { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true" }, svg("path", { d: isPlaying ? PAUSE : PLAY })));
    for (const name of ["title", "aria-label"]) play.setAttribute(name, say(isPlaying ? "pause" : "play"));
    show(player.q);
    tell();
  }

  function choose(names) {
    stage.choose(data.joints.filter((joint) => names.includes(joint.name)));
    stage.zoomed();
  }

  /** A bad value keeps the last good speed. */
  function setSpeed() {
    const value = Number(speed.value.trim().replace(",", ".").replace("−", "-"));
    const isGood = speed.value.trim() !== "" && Number.isFinite(value);
    speed.setAttribute("aria-invalid", String(!isGood));
    if (!isGood) return;
    player.speed = value;
    slower.textContent = player.slowness > 1 ? say("slower", { n: player.slowness }) : "";
    for (const chart of charts) {
      chart.speed = value;
      chart.draw();
    }
    show(player.q);
  }

  const gestures = new Gestures(picture, {
    grip: (x, y, isTouch) => {
      const link = linkAt(stage.drawing, pose, x - stage.view.x, y - stage.view.y, isTouch);
      return link === null ? null : { link, at: toLocal(pose, link, ...stage.view.m(x, y)), sense: player.sense };
    },
    move: (grip, x, y) => {
      const q = nearestCoordinate(turn, grip.link, grip.at, stage.view.m(x, y), player.q, grip.sense);
      const step = q - player.q;
      if (step) grip.sense = Math.sign(Math.abs(step) > (turn.high - turn.low) / 2 ? -step : step);
      player.seek(q);
    },
    drop: tell,
    pan: (dx, dy) => stage.pan(dx, dy),
    zoom: (x, y, factor) => stage.zoom(x, y, factor),
    takesWheel: () => !root.classList.contains("embedded") || root.contains(root.getRootNode().activeElement),
  });

  // Keys: what has its own use of a key keeps it. In a notebook they are those of the focus.
  const listening = root.classList.contains("embedded") ? root : document;
  listening.addEventListener("keydown", (event) => {
    const target = event.composedPath()[0];
    const isField = target.matches?.("input:not([type=checkbox]), select");
    const isPressed = target.matches?.("button, summary, input[type=checkbox]");
    if (isField || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = (unit === "angle" ? DEGREE : (turn.high - turn.low) / 360) * (event.shiftKey ? 10 : 1);
    const keys = {
      " ": isPressed ? null : toggle,
      ArrowLeft: () => seek(player.q - step),
      ArrowRight: () => seek(player.q + step),
      ArrowDown: () => seek(player.q - step),
      ArrowUp: () => seek(player.q + step),
      Home: () => seek(data.turn.at),
      0: () => stage.fit(),
    };
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  play.addEventListener("click", toggle);
  home.addEventListener("click", () => seek(data.turn.at));
  fit.addEventListener("click", () => stage.fit());
  scheme.addEventListener("click", () => {
    const isDark = getComputedStyle(root).getPropertyValue("--dark").trim() === "1";
    root.dataset.theme = isDark ? "light" : "dark";
  });
  speed.addEventListener("input", setSpeed);

  const resize = () => {
    const { clientWidth: width, clientHeight: height } = picture;
    const isNarrow = frame.clientWidth < 700;
    // The scale bar stands beside the switches, or above them.
    stage.foot = isNarrow ? 0 : row.offsetHeight;
    stage.barFoot = !isNarrow && row.offsetWidth > width - 220 ? row.offsetHeight + 4 : 0;
    stage.head = isNarrow ? corner.offsetHeight : 0;
    const box = picture.getBoundingClientRect();
    stage.covers = [corner, ...(isNarrow ? [] : [row])].map((over) => {
      const own = over.getBoundingClientRect();
      return [own.left - box.left, own.top - box.top, own.right - box.left, own.bottom - box.top];
    });
    stage.resize(width, height);
    for (const chart of charts) chart.resize();
  };
  player.q = turn.bring(data.turn.at);
  turn.sample(player.q, pose);
  stage.choose(data.joints.filter((joint) => data.paths.includes(joint.name)));
  stage.set(switches);
  stage.measure();
  setSpeed();
  resize();
  new ResizeObserver(resize).observe(root);
  show(player.q);
  tell();
  return { player, stage, turn, charts, gestures, seek, pointAt: (joint) => pointState(pose, joint.link, joint.at) };
}
