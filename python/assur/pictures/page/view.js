// What of the plane is seen: zoom and pan.

/** Zoom stays within these parts of the fitted scale. */
const LEAST_ZOOM = 0.1;
const GREATEST_ZOOM = 60;
/** Steps of 1. */
const DENSITIES = 20;

export class View {
  constructor() {
    /** px to a metre. */
    this.scale = 1;
    /** Where the origin is, px from the upper left corner. */
    this.x = 0;
    this.y = 0;
    this.width = 1;
    this.height = 1;
    this.fitted = 1;
  }

  /**
   * Show all of a rectangle.
   * @param {number[]} bounds x0, y0, x1, y1, m
   * @param {{left: number, right: number, top: number, bottom: number}} margin px
   */
  fit([x0, y0, x1, y1], margin) {
    const width = Math.max(this.width - margin.left - margin.right, this.width / 2);
    const height = Math.max(this.height - margin.top - margin.bottom, this.height / 2);
    const tiny = 1e-300;
    this.scale = Math.min(width / Math.max(x1 - x0, tiny), height / Math.max(y1 - y0, tiny));
    this.fitted = this.scale;
    const middleX = (margin.left + this.width - margin.right) / 2;
    const middleY = (margin.top + this.height - margin.bottom) / 2;
    this.x = middleX - (this.scale * (x0 + x1)) / 2;
    this.y = middleY + (this.scale * (y0 + y1)) / 2;
  }

  /** Keep what is in the middle there when the window changes. */
  resize(width, height) {
    this.x += (width - this.width) / 2;
    this.y += (height - this.height) / 2;
    this.width = width;
    this.height = height;
  }

  /** Zoom by a factor; the point under (px, py) stays. */
  zoom(px, py, factor) {
    const scale = Math.min(Math.max(this.scale * factor, LEAST_ZOOM * this.fitted), GREATEST_ZOOM * this.fitted);
    const own = scale / this.scale;
    this.scale = scale;
    this.x = px + (this.x - px) * own;
    this.y = py + (this.y - py) * own;
  }

  pan(dx, dy) {
    this.x += dx;
    this.y += dy;
  }

  /** Return a place of the plane (m) in px. */
  px(x, y) {
    return [this.x + this.scale * x, this.y - this.scale * y];
  }

  /** Return a place in px in the plane, m. */
  m(px, py) {
    return [(px - this.x) / this.scale, (this.y - py) / this.scale];
  }

  /**
   * Return how large symbols are: 1, less where links are short. In steps: while a link becomes longer
   * not every symbol is drawn anew.
   * @param {number} usual the usual length of a link, m
   */
  density(usual) {
    return Math.round(DENSITIES * Math.min(Math.max((usual * this.scale) / 60, 0.6), 1)) / DENSITIES;
  }
}
