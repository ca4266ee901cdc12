// The socket: requests with numbers, answers as frames (docs/developers/studio_protocol.md).

import { say } from "../../../pictures/page/words.js";

/** Bytes of a letter, at most. */
const BYTES_OF_LETTER = 3;
/** Waits between attempts to connect again, ms: each twice the one before, up to the last. */
const FIRST_WAIT = 500;
const LONGEST_WAIT = 8000;
const FORBIDDEN = 403;
const ARRAYS = { uint8: Uint8Array, float32: Float32Array, float64: Float64Array };

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
    arrays[name] = new ARRAYS[type](frame, at, count);
    at = aligned(at + arrays[name].byteLength);
  }
  return { header, arrays };
}

/**
 * Something that carries texts up and frames down: a socket, or the model of a notebook's widget.
 * @typedef {{send: (text: string) => void, isOpen: boolean}} Carrier
 */

/** Requests and their answers, over any carrier. */
export class Link {
  #waiting = new Map();
  #id = 0;
  /** Why the server takes no requests of this window, if it has said so. */
  #refusal = null;
  /** The longest message that the server takes, bytes. */
  most = Infinity;

  /** @param {Carrier} carrier its owner calls `take` with frames and `lost` when it breaks */
  constructor(carrier) {
    this.carrier = carrier;
  }

  get isOpen() {
    return this.carrier.isOpen;
  }

  /** Whether nothing that was asked waits for its answer. */
  get isQuiet() {
    return this.#waiting.size === 0;
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
      if (!this.isOpen) return reject(disconnected());
      const text = JSON.stringify({ id, rev, kind, ...fields });
      if (BYTES_OF_LETTER * text.length > this.most && new TextEncoder().encode(text).length > this.most) {
        return reject(tooLong(this.most));
      }
      this.#waiting.set(id, { resolve, reject });
      this.carrier.send(text);
    });
  }

  /** Take an answer. */
  take(frame) {
    const { header, arrays } = decode(frame);
    if (header.id === null && header.error) this.#refusal = errorOf(header.error);
    const own = this.#waiting.get(header.id);
    if (!own) return;
    this.#waiting.delete(header.id);
    if (header.error) own.reject(errorOf(header.error));
    else own.resolve(header.dropped ? null : { header, arrays });
  }

  /** The carrier broke: what was asked has no answer. */
  lost() {
    const error = this.#refusal ?? disconnected();
    this.#refusal = null;
    for (const { reject } of this.#waiting.values()) reject(error);
    this.#waiting.clear();
  }
}

function errorOf(error) {
  return Object.assign(new Error(error.message), error);
}

/** What a request says that is longer than the server takes. */
function tooLong(most) {
  return errorOf({ message: say("tooLong", { limit: Math.floor(most / 1024) }), kind: "too_large" });
}

/** What a request says that the connection has lost. */
function disconnected() {
  return Object.assign(new Error("disconnected"), { kind: "disconnected" });
}

/** Whether a server is there that does not let this page in: a socket that fails does not say why. */
async function isRefused() {
  try {
    return (await fetch("/", { method: "HEAD" })).status === FORBIDDEN;
  } catch {
    return false;
  }
}

/**
 * Connect to the server, and again whenever the connection is lost.
 * @param {(isOpen: boolean) => void} changed
 * @param {() => void} refused called when another server is there: started anew, it has another token
 * @returns {Link}
 */
export function connect(changed, refused) {
  let socket = null;
  let wait = FIRST_WAIT;
  const link = new Link({
    send: (text) => socket.send(text),
    get isOpen() {
      return socket.readyState === WebSocket.OPEN;
    },
  });
  const open = () => {
    socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    let wasOpen = false;
    socket.onopen = () => {
      wait = FIRST_WAIT;
      wasOpen = true;
      changed(true);
    };
    socket.onmessage = (event) => link.take(event.data);
    socket.onclose = () => {
      link.lost();
      changed(false);
      if (!wasOpen) isRefused().then((is) => is && refused());
      setTimeout(open, wait);
      wait = Math.min(2 * wait, LONGEST_WAIT);
    };
  };
  open();
  return link;
}

/**
 * Ask for what changes quickly: one request under way, of the others only the newest waits.
 * @param {(value: any) => Promise<void>} send
 * @returns {{push: (value: any) => void, settled: () => Promise<void>}}
 */
export function newestOnly(send) {
  let running = null;
  let next = null;
  const run = async () => {
    while (next) {
      const { value } = next;
      next = null;
      await send(value);
    }
    running = null;
  };
  return {
    push(value) {
      next = { value };
      running ??= run();
    },
    settled: () => running ?? Promise.resolve(),
  };
}
