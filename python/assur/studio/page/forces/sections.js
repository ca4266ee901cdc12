// Everything about forces: sections of the panel, arrows on the picture.

import { ForceAnswers } from "./answers.js";
import { ForceArrows } from "./arrows.js";
import { DriveSection } from "./drive.js";
import { FlywheelSection } from "./flywheel_section.js";
import { MachineSection } from "./machine_section.js";
import { RunSection } from "./run_section.js";

/**
 * Make the sections and what belongs to them on the picture: what a machine is asked for stands above
 * the dimensions, where it is typed below them.
 * @param {import("../studio.js").Studio} studio
 * @returns {{above: {element: HTMLElement}[], below: {element: HTMLElement}[]}}
 */
export function forceSections(studio) {
  const answers = ForceAnswers.of(studio.model);
  const arrows = new ForceArrows(answers, studio.canvas);
  const make = (kinds) => kinds.map((One) => new One(studio, answers));
  const sections = { above: make([DriveSection, FlywheelSection]), below: make([MachineSection, RunSection]) };
  answers.attach(() => studio.playback.player.speed);
  studio.forceArrows = arrows;
  return sections;
}
