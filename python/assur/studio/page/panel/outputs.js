// Outputs: what a mechanism does, as `sensitivity` names it.

/**
 * Return what can be an output: angles of links, slides, joints' coordinates.
 * @param {Object} data the page's data
 * @returns {{of: string, name: string, what: string, isAngle: boolean}[]}
 */
export function outputsOf(data) {
  const links = data.links.slice(1).map((name) => ({ of: name, name, what: "angle", isAngle: true }));
  const slides = data.slides.map(({ name }) => ({ of: name, name, what: "value", isAngle: false }));
  const joints = data.joints.filter((joint) => joint.link !== 0);
  const along = (what) => ({ name }) => ({ of: `${name}.${what}`, name, what, isAngle: false });
  return [...links, ...slides, ...joints.flatMap((joint) => [along("x")(joint), along("y")(joint)])];
}

/** Return the name of the output that a mechanism is made for: what its first diagram shows. */
export function usualOutput(data) {
  const known = outputsOf(data);
  const first = data.diagrams[0] ?? "";
  const own = known.find((one) => one.of === first || one.of === first.split(".")[0]);
  return (own ?? known[known.length - 1])?.of;
}

/**
 * Return a derivative by a dimension in the units shown: ° or mm per mm or °.
 * @param {number} value SI
 * @param {boolean} isAngle of the output
 * @param {boolean} byAngle of the dimension
 * @param {number} factor units of length to a metre
 */
export function perUnit(value, isAngle, byAngle, factor) {
  const degree = 180 / Math.PI;
  return (value * (isAngle ? degree : factor)) / (byAngle ? degree : factor);
}

/** Write a number with its sign. */
export function signed(text) {
  return /^[−–0]/.test(text) && !/^0\./.test(text) ? text : `+${text}`;
}

/**
 * Return the least and the greatest of quantities over a turn.
 * @param {import("../../../pictures/page/turn.js").Turn} turn
 * @param {import("../../../pictures/page/quantities.js").Quantity[]} quantities
 * @param {number} speed of the coordinate
 * @param {number} [count] of places
 * @returns {Map<string, {low: number, high: number}>} by id
 */
export function rangesOf(turn, quantities, speed, count = 120) {
  const ranges = new Map(quantities.map(({ id }) => [id, { low: Infinity, high: -Infinity }]));
  const pose = turn.pose();
  const links = quantities.every((one) => one.links) ? [...new Set(quantities.flatMap((one) => one.links))] : undefined;
  for (const q of turn.coordinates(count)) {
    turn.sample(q, pose, links);
    if (!pose.known) continue;
    for (const { id, value } of quantities) {
      const own = value(pose, speed);
      const range = ranges.get(id);
      range.low = Math.min(range.low, own);
      range.high = Math.max(range.high, own);
    }
  }
  return ranges;
}
