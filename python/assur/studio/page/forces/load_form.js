// The fields of one load.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { setLoad } from "../document/machine.js";
import { allLinks, listOf, tableOf } from "../document/names.js";
import { LOAD_FIELDS, placeText, slideAt, USUAL_GRAVITY } from "./load_kinds.js";
import { documentUnit } from "./masses.js";
import { valueField } from "./value_field.js";

/**
 * Make the fields of a load; of one that cannot be edited here what stands in the file.
 * @param {import("../model/model.js").Model} model
 * @param {import("./fields.js").Fields} fields
 * @param {Object} load
 * @param {number} i its place in the list
 */
export function loadForm(model, fields, load, i) {
  const form = html("div", { class: "load-form", role: "group" });
  const known = LOAD_FIELDS[load.type];
  if (!known) {
    form.append(...asInFile(load));
    return form;
  }
  const edit = (changes) => {
    const made = { ...listOf(model.document.loads)[i], ...changes };
    for (const key in made) if (made[key] === null || made[key] === undefined) delete made[key];
    return model.edit(setLoad(model.document, i, made));
  };
  for (const own of known) form.append(...MAKERS[own.is](model, fields, load, `load ${i} ${own.key}`, own, edit));
  return form;
}

/** Show what cannot be edited here as it stands in the file. */
export function asInFile(part) {
  const text = JSON.stringify(part, null, 1);
  return [html("p", { class: "hint" }, say("editInFile")), html("pre", { class: "raw" }, text)];
}

/** Each makes a field of a kind: see LOAD_FIELDS. */
const MAKERS = {
  joint(model, fields, load, key, field, edit) {
    const now = load[field.key];
    const names = Object.keys(tableOf(model.document.joints)).map((name) => [name, name]);
    // A place on a link has no joint: it stays until a joint is chosen.
    const options = typeof now === "string" ? names : [["", placeText(now)], ...names];
    const value = typeof now === "string" ? now : "";
    const set = (name) => name && edit({ [field.key]: name });
    return [fields.choiceRow(key, { label: say(`field_${field.key}`), options, value, set })];
  },
  link(model, fields, load, key, field, edit) {
    const options = Object.keys(allLinks(model.document)).map((name) => [name, name]);
    const value = load[field.key] ?? "ground";
    return [fields.choiceRow(
      key, { label: say(`field_${field.key}`), options, value, set: (name) => edit({ [field.key]: name }) },
    )];
  },
  axes(model, fields, load, key, field, edit) {
    const links = Object.keys(allLinks(model.document)).filter((name) => name !== "ground");
    const options = [["", say("axesFixed")], ...links.map((name) => [name, say("axesOf", { link: name })])];
    return [fields.choiceRow(
      key, { label: say("field_axes"), options, value: load.axes ?? "", set: (name) => edit({ axes: name || null }) },
    )];
  },
  number(model, fields, load, key, field, edit) {
    const shown = { m: documentUnit(model.document), rad: "°" }[field.unit] ?? field.unit;
    return [fields.row(
      key,
      {
        label: say(`field_${field.key}`),
        value: load[field.key] ?? 0,
        unit: field.unit,
        shown,
        set: (value) => edit({ [field.key]: value }),
      },
    )];
  },
  vector(model, fields, load, key, field, edit) {
    const now = load[field.key] ?? USUAL_GRAVITY;
    return [0, 1].map((k) => {
      const set = (value) => edit({ [field.key]: now.map((own, n) => (n === k ? value : own)) });
      return fields.row(`${key} ${k}`, {
        label: say("alongAxis", { axis: "xy"[k] }), value: now[k], unit: field.unit, set,
      });
    });
  },
  value(model, fields, load, key, field, edit) {
    const set = (value) => edit({ [field.key]: value });
    return valueField(model, fields, key, {
      label: say(`load${load.type}`), value: load[field.key], unit: field.unit, set,
    });
  },
  components(model, fields, load, key, field, edit) {
    const now = listOf(load[field.key]);
    return [0, 1].flatMap((k) => {
      const set = (value) => edit({ [field.key]: now.map((own, n) => (n === k ? value : own)) });
      return valueField(model, fields, `${key} ${k}`, {
        label: say("alongAxis", { axis: "xy"[k] }), value: now[k], unit: field.unit, set,
      });
    });
  },
  /** When it acts: always, or while a coordinate goes one way; or against that way, as two loads. */
  way(model, fields, load, key, field, edit) {
    const options = ["always", "forward", "backward"].map((way) => [way, say(`acts_${way}`)]);
    const rows = [fields.choiceRow(key, {
      label: say("acts"), options, value: load.while_ ?? "always",
      // The way of a ram is that of its slide.
      set: (way) => {
        const over = load.over ?? slideAt(model.document, load.at)?.name ?? null;
        edit(way === "always" ? { while_: null, over: null } : { while_: way, over });
      },
    })];
    if (!load.while_) return rows;
    const own = [
      ...Object.keys(tableOf(model.document.slides)),
      ...Object.keys(allLinks(model.document)).filter((name) => name !== "ground"),
    ];
    rows.push(fields.choiceRow(`${key} over`, {
      label: say("goes"), options: [["", say("theDriver")], ...own.map((name) => [name, name])], value: load.over ?? "",
      set: (name) => edit({ over: name || null }),
    }));
    const other = html("button", { type: "button", class: "button", "data-key": `${key} opposes` }, say("opposes"));
    other.addEventListener("click", () => model.edit(withOpposite(model.document, load)));
    const name = load.over ?? drivenName(model.document);
    const what = say(Object.hasOwn(tableOf(model.document.slides), name) ? "positionOf" : "angleOf", { name });
    const [means, hint] = [say("forwardMeans", { what }), say("opposesHint")].map((text) => html("p", { class: "hint" }, text));
    return [...rows, means, hint, other];
  },
};

/** The name of the (first) driver: a slide or a link. */
function drivenName(document) {
  const first = Array.isArray(document.driver) ? document.driver[0] : document.driver;
  return typeof first === "object" && first ? first.link : first;
}

/** Return a value the other way. */
export function negated(value) {
  if (typeof value === "number") return value === 0 ? 0 : -value;
  return { ...value, value: value.value.map((own) => (own === 0 ? 0 : -own)) };
}

/** Return the document with a load of the other way of motion too: both together oppose the motion. */
export function withOpposite(document, load) {
  const while_ = load.while_ === "forward" ? "backward" : "forward";
  const other = load.type === "Force" ? { force: load.force.map(negated) } : { torque: negated(load.torque) };
  return { ...document, loads: [...listOf(document.loads), { ...load, ...other, while_ }] };
}
