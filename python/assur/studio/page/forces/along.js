// Numbers that the server gave at rows of a coordinate, found between the rows.

export class Along {
  /**
   * @param {Float64Array|number[]} places ascending: of q, or of time
   * @param {boolean} repeats whether the rows are one period
   */
  constructor(places, repeats) {
    this.places = places;
    this.repeats = repeats;
    this.low = places[0];
    this.high = places[places.length - 1];
  }

  /**
   * Find the rows about a place.
   * @returns {{row: number, part: number} | null} null beyond the rows
   */
  locate(place) {
    const { places, low, high } = this;
    const span = high - low;
    const own = this.repeats ? low + ((((place - low) % span) + span) % span) : place;
    // A place may lie beyond by rounding.
    const tiny = 1e-9 * span;
    if (!(own >= low - tiny && own <= high + tiny)) return null;
    let row = 0;
    let end = places.length - 1;
    while (end - row > 1) {
      const middle = (row + end) >> 1;
      if (places[middle] <= own) row = middle;
      else end = middle;
    }
    return { row, part: Math.min(Math.max((own - places[row]) / (places[row + 1] - places[row]), 0), 1) };
  }

  /**
   * Return numbers at a place; NaN where there are none. Loads may jump, so a line leads from row to row.
   * @param {Float64Array} values [row][width]
   * @param {number} place
   * @param {number} width numbers of a row
   * @param {number} first of those wanted
   * @param {number} count
   */
  at(values, place, width = 1, first = 0, count = 1) {
    const found = this.locate(place);
    return Array.from({ length: count }, (_, i) => {
      if (!found) return NaN;
      const a = values[found.row * width + first + i];
      const b = values[(found.row + 1) * width + first + i];
      return found.part === 0 ? a : a + found.part * (b - a);
    });
  }

  /** Return the mean of a column over the places: by trapezia; rows without a number are left out. */
  mean(values) {
    let sum = 0;
    let span = 0;
    for (let i = 1; i < this.places.length; i++) {
      const step = this.places[i] - this.places[i - 1];
      const own = (values[i] + values[i - 1]) / 2;
      if (!Number.isFinite(own)) continue;
      sum += step * own;
      span += step;
    }
    return span > 0 ? sum / span : NaN;
  }

  /** Return the greatest magnitude of a column, with its sign, and where it is. */
  greatest(values) {
    let best = -1;
    values.forEach((value, i) => {
      if (Number.isFinite(value) && (best < 0 || Math.abs(value) > Math.abs(values[best]))) best = i;
    });
    return best < 0 ? null : { value: values[best], place: this.places[best] };
  }
}
