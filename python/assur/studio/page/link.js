// The socket: requests with numbers, answers as frames (docs/studio_protocol.md).

/**
 * Return the header and the arrays of a frame.
 * @param {ArrayBuffer} frame
 * @returns {{header: Object, arrays: Object<string, Float64Array | Uint8Array>}}
 */
export function decode(frame) {
  const length = new DataView(frame).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(frame, 4, length)));
  const aligned = (at) => Math.ceil(at / 8) * 8;
  let at = aligned(4 + length);
  const arrays = {};
  for (const { name, type, shape } of header.arrays) {
    const count = shape.reduce((product, n) => product * n, 1);
    arrays[name] = type === "uint8" ? new Uint8Array(frame, at, count) : new Float64Array(frame, at, count);
    at = aligned(at + arrays[name].byteLength);
  }
  return { header, arrays };
}

export class Link {
  #socket;
  #waiting = new Map();
  #id = 0;

  /** @param {{opened?: () => void, closed?: () => void}} [on] */
  constructor(on = {}) {
    this.#socket = new WebSocket(`ws://${location.host}/socket`);
    this.#socket.binaryType = "arraybuffer";
    this.#socket.onopen = () => on.opened?.();
    this.#socket.onmessage = (event) => this.#take(decode(event.data));
    this.#socket.onclose = () => {
      for (const { reject } of this.#waiting.values()) reject(new Error("disconnected"));
      this.#waiting.clear();
      on.closed?.();
    };
  }

  /**
   * Send a request. The answer is null if a newer request took its place.
   * @param {string} kind
   * @param {number} rev
   * @param {Object} fields
   * @returns {Promise<{header: Object, arrays: Object} | null>}
   */
  ask(kind, rev, fields) {
    const id = ++this.#id;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      this.#socket.send(JSON.stringify({ id, rev, kind, ...fields }));
    });
  }

  #take({ header, arrays }) {
    const own = this.#waiting.get(header.id);
    if (!own) return;
    this.#waiting.delete(header.id);
    if (header.error) own.reject(Object.assign(new Error(header.error.message), header.error));
    else own.resolve(header.dropped ? null : { header, arrays });
  }
}
