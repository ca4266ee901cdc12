// What the diagrams of a flywheel show: areas of surplus and want, tangents of Wittenbauer's diagram.

/**
 * Cut a curve at zero into areas: where moment is left over, and where it is wanting.
 * @param {number[]} places
 * @param {number[]} values
 * @returns {{isLeft: boolean, points: number[][]}[]} closed polygons with the axis
 */
export function surplusAreas(places, values) {
  const areas = [];
  let own = null;
  const open = (isLeft, place) => areas.push((own = { isLeft, points: [[place, 0]] }));
  const close = (place) => own?.points.push([place, 0]);
  for (let i = 0; i < places.length; i++) {
    const isLeft = values[i] > 0;
    if (own === null) open(isLeft, places[i]);
    else if (isLeft !== own.isLeft) {
      const part = values[i - 1] / (values[i - 1] - values[i]);
      const zero = places[i - 1] + part * (places[i] - places[i - 1]);
      close(zero);
      open(isLeft, zero);
    }
    own.points.push([places[i], values[i]]);
  }
  close(places[places.length - 1]);
  return areas;
}

/**
 * The tangents of Wittenbauer's diagram: energy over reduced inertia, both without the flywheel. They
 * have slopes ω²/2 and meet where the inertia is −J of the flywheel.
 * @param {{inertia: number, speed0: number, max: {value: number}, min: {value: number}}} flywheel
 * @returns {{meet: number[], lines: {key: string, slope: number}[]}}
 */
export function tangentsOf({ inertia, speed0, max, min }) {
  const meet = [-inertia, (-inertia * speed0 ** 2) / 2];
  return {
    meet, lines: [{ key: "max", slope: max.value ** 2 / 2 }, { key: "min", slope: min.value ** 2 / 2 }],
  };
}

/** Diameter of a full disc of a moment of inertia J = π ρ b D⁴ / 32, m. */
export function discDiameter(inertia, thickness, density) {
  return ((32 * inertia) / (Math.PI * density * thickness)) ** 0.25;
}
