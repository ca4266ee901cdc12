// A field of a value of a load: a constant, or a table over the driver's coordinate.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { tableOf } from "../document/names.js";
import { documentUnit } from "./masses.js";
import { constantOf, isValueTable, linesOf, readLines, tableOfConstant } from "./values.js";

/** Return the unit of the coordinate of a table: of `over`, else of the driver. */
function coordinateOf(document, over) {
  const name = over ?? (Array.isArray(document.driver) ? document.driver[0] : document.driver);
  const isSlide = typeof name === "string" && Object.hasOwn(tableOf(document.slides), name);
  return isSlide ? { unit: "m", shown: documentUnit(document) } : { unit: "rad", shown: "°" };
}

/**
 * Make the field.
 * @param {import("../model/model.js").Model} model
 * @param {import("./fields.js").Fields} fields
 * @param {string} key
 * @param {{label: string, value: number | Object, unit: string, set: (value: number | Object) => void}} options
 * @returns {HTMLElement[]}
 */
export function valueField(model, fields, key, { label, value, unit, set }) {
  const isTable = isValueTable(value);
  const coordinate = coordinateOf(model.document, isTable ? value.over : undefined);
  const turnInto = html(
    "button",
    { type: "button", class: "button small", "data-key": `${key} kind` },
    say(isTable ? "asConstant" : "asTable"),
  );
  turnInto.setAttribute("aria-label", `${label}: ${turnInto.textContent}`);
  turnInto.addEventListener("click", () => {
    fields.bad.delete(`${key} rows`);
    fields.bad.delete(key);
    set(isTable ? constantOf(value) : tableOfConstant(value, coordinate.unit === "rad"));
  });
  if (!isTable) {
    const { box, message } = fields.quantity(key, { label, value, unit, set });
    return [html(
      "div", { class: "field-row" }, html("div", { class: "row" }, html("span", {}, label), box, turnInto), message,
    )];
  }
  const read = (text) => {
    const found = readLines(text, coordinate, unit, value);
    return found.error ? { error: say(found.error, found.values) } : found;
  };
  const over = value.over ?? say("theDriver");
  return [
    html("div", { class: "row" }, html("span", {}, label), turnInto),
    fields.lines(`${key} rows`, {
      label: say("tableColumns", { over, place: coordinate.shown, unit }), text: linesOf(value, coordinate, unit), read,
      set: ({ q, value: own }) => set({ ...value, q, value: own }), hint: say("tableHint"),
    }),
    fields.choiceRow(`${key} spline`, {
      label: say("between"), value: value.spline === "linear" ? "linear" : "smooth",
      options: [["linear", say("betweenLinear")], ["smooth", say("betweenSmooth")]],
      set: (own) => set({ ...value, spline: own === "linear" ? "linear" : "pchip" }),
    }),
  ];
}
