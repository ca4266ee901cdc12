// Forces as quantities of diagrams: of the drive, in joints, of slides.

import { driveAt, jointForce, slideForce } from "./answers.js";
import { peakOf } from "./peaks.js";

/** What is large of every `step`-th number from the first, or of pairs of them. */
function largest(along, values, step, first, size) {
  const own = [];
  for (let i = first; i < values.length; i += step) own.push(
    size === 2 ? Math.hypot(values[i], values[i + 1]) : values[i]
  );
  return peakOf(own, along.repeats).most;
}

/**
 * Return the forces that diagrams can show, grouped.
 * @param {import("./answers.js").Forces} forces
 * @param {{driver: string, isSlide: boolean}} drive
 * @returns {{name: string, quantities: import("../../../pictures/page/quantities.js").Quantity[]}[]}
 */
export function forceQuantities(forces, { driver, isSlide }) {
  const { along, arrays, joints, slides } = forces;
  const make = (id, of, what, unit, size, value) => ({
    id, of, what, order: 0, isAngle: false, unit, role: "force", size, value,
  });
  const most = largest(along, arrays.drive, 1, 0, 1);
  const mostPower = most * Math.abs(forces.speed ?? 1);
  const drive = [
    make(
      `${driver}.drive`,
      driver,
      isSlide ? "driveForce" : "driveMoment",
      isSlide ? "N" : "N·m",
      most,
      (pose) => driveAt(forces, pose.q).drive,
    ),
    make(`${driver}.power`, driver, "power", "W", mostPower, (pose) => driveAt(forces, pose.q).power),
  ];
  const seen = new Set();
  const inJoints = joints.flatMap(({ joint, on, from }, i) => {
    const of = from === null ? `${joint} → ${on}` : joint;
    const id = from === null ? `${joint}.F.${on}` : `${joint}.F`;
    if (seen.has(id)) return [];
    seen.add(id);
    const size = largest(along, arrays.forces, 2 * joints.length, 2 * i, 2);
    const at = (pose) => jointForce(forces, i, pose.q);
    return [
      make(id, of, "force", "N", size, (pose) => Math.hypot(...at(pose))),
      make(`${id}x`, of, "forceX", "N", size, (pose) => at(pose)[0]),
      make(`${id}y`, of, "forceY", "N", size, (pose) => at(pose)[1]),
    ];
  });
  const inSlides = slides.flatMap(({ slide }, i) => {
    const at = (pose) => slideForce(forces, i, pose.q);
    const size = (first) => largest(along, arrays.slide_forces, 3 * slides.length, 3 * i + first, 1);
    return [
      make(`${slide}.N`, slide, "normalForce", "N", size(0), (pose) => at(pose)[0]),
      make(`${slide}.M`, slide, "moment", "N·m", size(1), (pose) => at(pose)[1]),
    ];
  });
  return [{ name: "forces", quantities: [...drive, ...inJoints, ...inSlides] }];
}
