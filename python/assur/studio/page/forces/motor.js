// The motor: none, or one of the kinds of the file format, with its numbers.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { drivesSlide } from "../document/drivers.js";
import { setMotor } from "../document/machine.js";
import { isTable, listOf } from "../document/names.js";
import { notNegative, positive } from "./fields.js";
import { asInFile } from "./load_form.js";
import { valueField } from "./value_field.js";

/** Numbers of each kind: key, unit, what is wrong with a number. */
const MOTOR_FIELDS = {
  ConstantTorque: [],
  LinearMotor: [["stall", "N·m", positive], ["no_load", "rad/s", positive]],
  InductionMotor: [["breakdown", "N·m", positive], ["slip", "", positive], ["synchronous", "rad/s", positive]],
};
/** Those that every motor can have, with their usual values. */
const SHAFT = [
  ["ratio", "", (value) => (value === 0 ? "mustNotBeZero" : null), 1], ["rotor_inertia", "kg·m²", notNegative, 0],
];
const NEW_MOTORS = {
  ConstantTorque: { torque: 10 },
  LinearMotor: { stall: 100, no_load: 30 },
  InductionMotor: { breakdown: 60, slip: 0.15, synchronous: 157.1, ratio: 10 },
};

/** Return the motor of a document: of several drivers that of the first. */
export const motorOf = (document) => (isTable(document.motor) ? document.motor : (listOf(document.motor)[0] ?? null));

/** Say what kind of motor there is, in two words. */
export const motorWords = (document) => say(`motor${motorOf(document)?.type ?? "None"}`);

/**
 * Make the fields of the motor.
 * @param {import("../model/model.js").Model} model
 * @param {import("./fields.js").Fields} fields
 * @param {(key: string) => string} wrongAt what the server says of a place of the document
 */
export function motorForm(model, fields, wrongAt) {
  const { document } = model;
  const motor = motorOf(document);
  const wrong = wrongAt("motor");
  const rest = wrong ? [html("p", { class: "field-error" }, wrong)] : [];
  if (Array.isArray(document.motor)) return [...asInFile(document.motor), ...rest];
  const type = motor?.type ?? "";
  const kinds = ["", ...Object.keys(MOTOR_FIELDS), ...(type && !MOTOR_FIELDS[type] ? [type] : [])];
  const choice = fields.choiceRow("motor type", {
    label: say("motorKind"), value: type, options: kinds.map((own) => [own, say(`motor${own || "None"}`)]),
    set: (own) => {
      fields.bad.clear();
      model.edit(setMotor(model.document, own ? { type: own, ...NEW_MOTORS[own] } : null));
    },
  });
  if (!motor) return [choice, ...rest];
  if (!MOTOR_FIELDS[type]) return [choice, ...asInFile(motor), ...rest];
  const edit = (key, value) => {
    const { [key]: _, ...others } = motorOf(model.document);
    return model.edit(setMotor(model.document, value === null ? others : { ...motorOf(model.document), [key]: value }));
  };
  const unitOf = (unit) => (drivesSlide(document) ? ({ "N·m": "N", "rad/s": "m/s" }[unit] ?? unit) : unit);
  const own = MOTOR_FIELDS[type].map(([key, unit, check]) => {
    return fields.row(`motor ${key}`, {
      label: say(`motor_${key}`), value: motor[key], unit: unitOf(unit), check, set: (value) => edit(key, value),
    });
  });
  if (type === "ConstantTorque") {
    const set = (value) => edit("torque", value);
    own.push(...valueField(model, fields, "motor torque", {
      label: say("motor_torque"), value: motor.torque, unit: unitOf("N·m"), set,
    }));
  }
  const shaft = SHAFT.map(([key, unit, check, usual]) => {
    return fields.row(`motor ${key}`, {
      label: say(`motor_${key}`), value: motor[key] ?? usual, unit, check, isOptional: true,
      set: (value) => edit(key, value === usual ? null : value),
    });
  });
  return [choice, ...own, ...shaft, ...rest];
}
