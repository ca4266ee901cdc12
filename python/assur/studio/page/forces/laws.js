// Input laws as the server knows them, with the numbers that each takes.

/** Laws that lead from one coordinate to another. */
export const LAWS = [
  "Uniform", "Harmonic", "Cycloidal", "Polynomial345", "Polynomial4567", "Trapezoidal", "ModifiedSine",
];

/** What is asked for a run at first: a turn from where it is, or what is left of a stroke. */
export function firstRun({ isSlide, q, high, low }) {
  const whole = isSlide ? (q - low < high - q ? high : low) : q + 2 * Math.PI;
  return {
    by: "speed",
    speed: 1,
    t_end: isSlide ? 1 : 2 * Math.PI,
    law: "Cycloidal",
    start: q,
    end: whole,
    duration: 1,
    ramp: 1 / 3,
    machine_speed: 0,
    machine_end: 1,
  };
}

/**
 * Return the fields of a request.
 * @param {Object} wanted as of `firstRun`
 * @param {number} q0 where it begins
 * @param {boolean} wantsForces
 */
export function runRequest(wanted, q0, wantsForces) {
  const forces = wantsForces ? { reactions: true } : {};
  if (wanted.by === "law") {
    const { law, start, end, duration, ramp } = wanted;
    return { by: "law", law: { law, start, end, duration, ...(law === "Trapezoidal" ? { ramp } : {}) }, ...forces };
  }
  if (wanted.by === "machine") return {
    by: "machine", q0, speed: wanted.machine_speed, t_end: wanted.machine_end, ...forces,
  };
  return { by: "speed", q0, speed: wanted.speed, t_end: wanted.t_end, ...forces };
}
