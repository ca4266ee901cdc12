// Why the driver cannot go round: the group that is at a dead point where it stops.

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
 * @param {{q: number, group: string, inner: string | null, shape: string | null}[]} dead `turn.dead` of the page's data
 * @param {Object[]} groups of the structure
 * @returns {DeadEnd[]}
 */
export function deadEnds(dead, groups) {
  const ends = [];
  for (const { q, group: text, inner, shape } of dead) {
    const group = groups.find(({ links, class: own }) => text === `${own}(${links.join(", ")})`);
    const key = { stretched: "deadStretched", folded: "deadFolded" }[shape] ?? "deadGroup";
    const same = ends.find((end) => end.key === key && end.text === text);
    const values = { group: text, links: listedNames(group?.links ?? []), joint: inner };
    if (same) same.at.push(q);
    else ends.push({ at: [q], links: group?.links ?? [], key, text, values });
  }
  return ends;
}
