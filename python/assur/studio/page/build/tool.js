// What all tools have in common.

/**
 * A place under the pointer: where it snaps to, and what lies under it.
 * @typedef {{at: number[], joint?: string, link?: string, plate?: string,
 *   over: {joint?: string, link?: string}, guide?: Object, isFree?: boolean, isMore?: boolean}} Spot
 */

/**
 * What is drawn of what is begun, m.
 * @typedef {{lines?: number[][][], dots?: number[][], block?: {at: number[], angle: number}}} Preview
 */

/**
 * A change of the document: returns it, and the joint at which a chain goes on.
 * @typedef {(document: Object) => {document: Object, joint?: string}} Change
 */

/** What all tools have in common: nothing begun, one press does it all. */
export class Tool {
  /** What is begun: the first of its ends is where guides start. */
  ends = [];
  last = null;

  get isBegun() {
    return this.ends.length > 0;
  }

  /** Whether a drag on the canvas is the tool's own; of others it pans. */
  get drags() {
    return true;
  }

  down(spot) {
    this.last = spot;
  }

  /** The pointer is elsewhere, pressed or not. */
  move(spot) {
    this.last = spot;
  }

  /**
   * @param {Spot} spot
   * @param {boolean} isDrag whether it was drawn from where it was pressed
   * @returns {Change | null}
   */
  up(spot, isDrag) {
    return null;
  }

  /** What Enter finishes. */
  enter() {
    return null;
  }

  /** The change is made; a chain goes on at a joint. */
  done(joint, at) {
    this.reset();
  }

  reset() {
    this.ends = [];
  }

  /** @returns {Preview} */
  preview() {
    return {};
  }

  /** The joints that it holds, for when one goes. */
  forget(isThere) {
    if (this.ends.some(({ joint, link }) => (joint && !isThere(joint)) || (link && !isThere(link)))) this.reset();
  }
}
