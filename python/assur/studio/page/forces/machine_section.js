// Masses, loads and motor of the document: a section that is short until there are some.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { drivesSlide } from "../document/drivers.js";
import { listOf, tableOf } from "../document/names.js";
import { hasMachine } from "./answers.js";
import { driveFacts, withForceUnit } from "./drive.js";
import { Fields, later } from "./fields.js";
import { foldedSection } from "./folded.js";
import { loadList } from "./loads.js";
import { massTable, weightSwitch } from "./masses.js";
import { motorForm, motorWords } from "./motor.js";

export class MachineSection {
  /**
   * @param {import("../studio.js").Studio} studio
   * @param {import("./answers.js").ForceAnswers} answers
   */
  constructor({ model, shell }, answers) {
    this.model = model;
    // What the loads ask of the drive stands further up: one click leads there.
    this.toDrive = html("button", { type: "button", class: "button to-drive" });
    this.toDrive.addEventListener("click", () => {
      shell.panel.scrollTo?.({ top: 0 });
      shell.panel.querySelector("[data-fact=driveGreatest]")?.scrollIntoView({ block: "nearest" });
    });
    for (const event of ["forces", "document", "checked"]) model.on(event, () => this.#tellDrive());
    this.answers = answers;
    this.state = { open: null };
    const { element, details, body, note } = foldedSection(
      "machine", say("massesAndLoads"), "more", answers.folded, true,
    );
    Object.assign(this, { element, details, note });
    const form = html("div");
    body.append(form, this.toDrive);
    this.fields = new Fields(form);
    this.again = later(() => this.show());
    for (const event of ["document", "checked", "forces"]) model.on(event, this.again);
    details.addEventListener("toggle", this.again);
    this.#tellDrive();
    this.show();
  }

  /** What the server says of a place of the document. */
  #wrongAt(key) {
    const { error } = this.answers;
    return error?.key === key || error?.key?.startsWith(`${key}.`) ? error.message : "";
  }

  #tellDrive() {
    const { answers, model, toDrive } = this;
    toDrive.hidden = !answers.forces || !answers.canBe;
    if (toDrive.hidden) return;
    const { greatest, most } = driveFacts(answers.forces);
    const torque = withForceUnit(greatest?.value ?? NaN, drivesSlide(model.document) ? "N" : "N·m", most);
    toDrive.textContent = say("driveAbove", { torque });
  }

  show() {
    const { model, fields, details } = this;
    const { document } = model;
    this.element.hidden = !Object.keys(tableOf(document.links)).some((name) => name !== "ground");
    const n = Object.keys(tableOf(document.bodies)).length;
    const loads = listOf(document.loads).length;
    // Open where there is something, unless it was closed by hand.
    const isMachine = hasMachine(document);
    if (this.answers.folded.machine === undefined && isMachine !== details.open) details.open = isMachine;
    const counts = { n, loads, motor: motorWords(document) };
    this.note.textContent = isMachine ? say("machineNote", counts) : say("noMasses");
    if (this.element.hidden || !details.open) {
      this.shown = null;
      return fields.show();
    }
    const { error } = this.answers;
    if (this.shown?.document === document && this.shown.error === error && this.shown.open === this.state.open) return;
    this.shown = { document, error, open: this.state.open };
    const wrongAt = (key) => this.#wrongAt(key);
    const head = (key) => html("h3", {}, say(key));
    fields.show(
      ...[head("masses"), massTable(model, fields, wrongAt), weightSwitch(model)],
      ...[head("loads"), ...loadList(model, fields, this.state, () => this.show(), wrongAt)],
      ...[head("motor"), ...motorForm(model, fields, wrongAt)],
    );
  }
}
