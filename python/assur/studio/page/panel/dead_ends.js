// Why the driver cannot go round: the group that is at a dead point where it stops.

import { pointState } from "../../../pictures/page/quantities.js";
import { listedNames } from "../build/mend.js";

/**
 * @typedef {Object} DeadEnd
 * @property {number[]} at where it stops: coordinates of one dead point or of both
 * @property {string[]} links of the group that stops it
 * @property {string} key of the sentence: a dyad is stretched or folded, another group is "at its dead point"
 * @property {Object} values of the sentence
 */

/**
 * Return what stops the driver at the ends of its reach; the same group in the same way is one.
 * @param {Object} data the page's
 * @param {import("../../../pictures/page/turn.js").Turn} turn
 * @param {Object[]} groups of the structure
 * @returns {DeadEnd[]}
 */
export function deadEnds(data, turn, groups) {
  const ends = [];
  for (const { q, group: text } of data.turn.dead) {
    const group = groups.find(({ links, class: own }) => text === `${own}(${links.join(", ")})`);
    const shape = group ? shapeOf(data, turn, q, group) : null;
    const key = { stretched: "deadStretched", folded: "deadFolded" }[shape?.is] ?? "deadGroup";
    const same = ends.find((end) => end.key === key && end.text === text);
    const values = { group: text, links: listedNames(group?.links ?? []), joint: shape?.joint };
    if (same) same.at.push(q);
    else ends.push({ at: [q], links: group?.links ?? [], key, text, values });
  }
  return ends;
}

/** Tell whether the links of a dyad of turning pairs are stretched or folded at its inner joint. */
function shapeOf(data, turn, q, { kind, joints }) {
  if (kind !== "RRR") return null;
  const [a, inner, b] = joints.map((name) => data.joints.find((joint) => joint.name === name));
  if (!a || !inner || !b) return null;
  const pose = turn.pose();
  turn.sample(q, pose);
  const [from, at, to] = [a, inner, b].map((joint) => pointState(pose, joint.link, joint.at));
  const along = (from.x - at.x) * (to.x - at.x) + (from.y - at.y) * (to.y - at.y);
  return { is: along < 0 ? "stretched" : "folded", joint: inner.name };
}
