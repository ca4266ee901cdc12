// Masses of the links: a table of mass, moment of inertia and centre of mass; and their weight.

import { html } from "../../../pictures/page/elements.js";
import { digits, lengthUnit } from "../../../pictures/page/numbers.js";
import { say } from "../../../pictures/page/words.js";
import { addLoad, removeLoad, setBody } from "../document/machine.js";
import { allLinks, listOf, tableOf } from "../document/names.js";
import { notNegative } from "./fields.js";
import { USUAL_GRAVITY } from "./load_kinds.js";

/** Below these a column is in the smaller unit, kg and kg·m². */
const SMALL_MASS = 0.1;
const SMALL_INERTIA = 1e-3;

/** Return the body of a link with another entry, or null if nothing is left of it. */
export function bodyWith(body, key, value) {
  const { [key]: _, ...rest } = tableOf(body);
  const made = value === null || value === undefined ? rest : { ...rest, [key]: value };
  return made.mass === undefined && made.inertia === undefined ? null : made;
}

/** Whether bodies have weight, and the acceleration: the sum, if a document has it more than once. */
export function gravityOf(document) {
  const own = listOf(document.loads).filter((load) => load?.type === "Gravity");
  if (!own.length) return null;
  return own.reduce(([x, y], { acceleration = USUAL_GRAVITY }) => [x + acceleration[0], y + acceleration[1]], [0, 0]);
}

/** Return the document with weight or without. */
export function withWeight(document, isWanted) {
  if (isWanted) return addLoad(document, { type: "Gravity", acceleration: [...USUAL_GRAVITY] });
  let made = document;
  listOf(document.loads).forEach((load, i) => {
    const at = i - (listOf(document.loads).length - listOf(made.loads).length);
    if (load?.type === "Gravity") made = removeLoad(made, at);
  });
  return made;
}

/** Return the units of the columns. */
export function massUnits(document) {
  const bodies = Object.values(tableOf(document.bodies));
  const most = (key) => Math.max(0, ...bodies.map((body) => Number(tableOf(body)[key]) || 0));
  const isSmall = (key, limit) => most(key) > 0 && most(key) < limit;
  return {
    mass: isSmall("mass", SMALL_MASS) ? "g" : "kg", inertia: isSmall("inertia", SMALL_INERTIA) ? "kg·cm²" : "kg·m²",
  };
}

/**
 * Make the table.
 * @param {import("../model/model.js").Model} model
 * @param {import("./fields.js").Fields} fields
 * @param {(key: string) => string} wrongAt what the server says of a place of the document
 */
export function massTable(model, fields, wrongAt) {
  const { document } = model;
  const units = massUnits(document);
  const head = html("div", { class: "mass-row mass-head note" });
  for (const text of [
    say("link"), `${say("mass")}, ${units.mass}`, `${say("inertia")}, ${units.inertia}`, say("centre"),
  ]) head.append(html("span", {}, text));
  const table = html("div", { class: "masses", role: "group", "aria-label": say("masses") }, head);
  for (const [link, joints] of Object.entries(allLinks(document))) {
    if (link === "ground") continue;
    table.append(...massRow(model, fields, link, joints, units, wrongAt(`bodies.${link}`)));
  }
  return table;
}

function massRow(model, fields, link, joints, units, wrong) {
  const { document } = model;
  const body = tableOf(document.bodies)[link];
  const edit = (key, value) => model.edit(setBody(
    model.document, link, bodyWith(tableOf(model.document.bodies)[link], key, value),
  ));
  const column = (key) => {
    return fields.quantity(`body ${link} ${key}`, {
      label: `${link}: ${say(key)}`, value: body?.[key], unit: key === "mass" ? "kg" : "kg·m²", shown: units[key],
      isOptional: true, hint: "–", hasUnit: false, check: notNegative, set: (value) => edit(key, value),
    });
  };
  const [mass, inertia] = [column("mass"), column("inertia")];
  const isPlace = Array.isArray(body?.at);
  const options = [...joints.map((name) => [name, name]), ["", say("place")]];
  const centre = fields.choice(`body ${link} at`, {
    label: `${link}: ${say("centre")}`, options, value: isPlace ? "" : (body?.at ?? joints[0] ?? ""),
    set: (value) => edit("at", value || placeOnLink(model, link)),
  });
  centre.disabled = !body;
  const row = html(
    "div",
    { class: "mass-row" },
    html("span", { class: "mass-name", title: link }, link),
    mass.box,
    inertia.box,
    centre,
  );
  const below = [mass.message, inertia.message];
  if (isPlace) below.push(placeRow(fields, model, link, body, edit));
  if (wrong) below.push(html("p", { class: "field-error" }, wrong));
  return [row, ...below];
}

/** Where a centre of mass is put first: the middle of the link's first two joints, in its frame. */
function placeOnLink(model, link) {
  const joints = listOf(allLinks(model.document)[link]);
  const [a, b] = joints.map((name) => model.document.joints[name]);
  return a && b ? [Number((Math.hypot(b[0] - a[0], b[1] - a[1]) / 2).toPrecision(3)), 0] : [0, 0];
}

function placeRow(fields, model, link, body, edit) {
  const shown = documentUnit(model.document);
  const along = (i) => {
    return fields.quantity(`body ${link} at ${i}`, {
      label: `${link}: ${say("centre")} ${"xy"[i]}`, value: body.at[i], unit: "m", shown, hint: "xy"[i],
      set: (value) => edit("at", body.at.map((own, k) => (k === i ? value : own))),
    });
  };
  const [x, y] = [along(0), along(1)];
  return html(
    "div",
    { class: "field-row" },
    html("div", { class: "row place-row" }, html("span", { class: "note" }, say("centreInFrame")), x.box, y.box),
    x.message,
    y.message,
  );
}

/** The unit of lengths of a document. */
export function documentUnit(document) {
  const places = Object.values(tableOf(document.joints)).filter(Array.isArray);
  const span = (i) => Math.max(...places.map((at) => at[i])) - Math.min(...places.map((at) => at[i]));
  return lengthUnit(places.length ? Math.max(span(0), span(1)) || 1 : 1).name;
}

/** Make the switch of the weight. */
export function weightSwitch(model) {
  const gravity = gravityOf(model.document);
  const box = html("input", { type: "checkbox", "data-key": "weight", "data-switch": "weight" });
  box.checked = gravity !== null;
  box.addEventListener("change", () => model.edit(withWeight(model.document, box.checked)));
  const text = gravity ? `${digits(Math.hypot(...gravity))} m/s² · ${direction(gravity)}` : "";
  return html(
    "label", { class: "row check-row" }, html("span", {}, box, say("weight")), html("span", { class: "note" }, text),
  );
}

function direction([x, y]) {
  if (x === 0 || y === 0) return say("along", { axis: x === 0 ? (y < 0 ? "−y" : "+y") : x < 0 ? "−x" : "+x" });
  return `(${digits(x)}, ${digits(y)})`;
}
