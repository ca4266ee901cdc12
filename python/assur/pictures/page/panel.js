// Switches, the choice of points, the formula: what stands about the picture.

import { html, icon } from "./elements.js";
import { say } from "./words.js";

const SWITCHES = ["names", "paths", "velocity", "acceleration", "positions", "groups"];
const COLOURED = { paths: "path", velocity: "velocity", acceleration: "acceleration" };

/** Make a button with an icon. */
export function button(name, path, text = "") {
  const element = html("button", { type: "button", class: text ? "button" : "button round", title: name, "aria-label": name });
  if (path) element.append(icon(path));
  element.append(text);
  return element;
}

/**
 * Make the switches of the picture.
 * @param {import("./stage.js").Switches} state
 * @param {(state: import("./stage.js").Switches) => void} changed
 */
export function switchRow(state, changed) {
  const row = html("div", { class: "switches", role: "group", "aria-label": say("show") });
  for (const key of SWITCHES) {
    const box = html("input", { type: "checkbox", "data-switch": key });
    box.checked = state[key];
    box.addEventListener("change", () => changed({ ...state, [key]: (state[key] = box.checked) }));
    const label = html("label", { class: "switch" }, box);
    if (COLOURED[key]) label.append(html("i", { class: `swatch ${COLOURED[key]}` }));
    label.append(say(key));
    row.append(label);
  }
  return row;
}

/**
 * Make the choice of joints whose paths and vectors are shown.
 * @param {{name: string, link: number}[]} joints
 * @param {string[]} chosen
 * @param {(chosen: string[]) => void} changed
 */
export function pointChoice(joints, chosen, changed) {
  const list = html("div", { class: "points", role: "group", "aria-label": say("pointsHint") });
  const own = new Set(chosen);
  for (const joint of joints.filter((one) => one.link !== 0)) {
    const box = html("input", { type: "checkbox", "data-point": joint.name });
    box.checked = own.has(joint.name);
    box.addEventListener("change", () => {
      if (box.checked) own.add(joint.name);
      else own.delete(joint.name);
      changed([...own]);
    });
    list.append(html("label", { class: "switch name" }, box, joint.name));
  }
  return html("details", { class: "choice" }, html("summary", { class: "button", title: say("pointsHint") }, say("points")), list);
}

/** Write the structural formula, each group in its colour if groups are shown. */
export function formula(pieces) {
  const line = html("p", { class: "formula" });
  pieces.forEach((piece, i) => {
    const span = html("span", {}, piece);
    span.style.setProperty("--own", i ? `var(--group-${(i - 1) % 6})` : "var(--driver)");
    line.append(i ? " → " : "", span);
  });
  return line;
}
