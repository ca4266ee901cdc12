// Presses on the canvas while a tool is taken: clicks and drags that are the tool's.

/** A press that moves less than this is a click, px. */
const CLICK_REACH = 5;
/** With a finger what is dragged stands above it, px. */
const ABOVE_FINGER = 40;

export class Press {
  /** @param {import("./builder.js").Builder} builder */
  constructor(builder) {
    this.builder = builder;
    this.wasCancelled = false;
    this.#follow(builder.canvas.picture);
  }

  /** Follow the pointer where `Gestures` does not: without a press, and the keys that are held. */
  #follow(picture) {
    const { builder } = this;
    const place = (event) => {
      const box = picture.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    for (const kind of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) {
      const held = (event) => {
        Object.assign(builder.aim, { alt: event.altKey, shift: event.shiftKey });
        this.wasCancelled = kind === "pointercancel";
      };
      picture.parentNode.addEventListener(kind, held, { capture: true });
    }
    let pressed = [0, 0];
    picture.addEventListener("pointerdown", (event) => {
      pressed = place(event);
      picture.focus({ preventScroll: true });
    });
    picture.addEventListener("pointermove", (event) => {
      if (!builder.tool || event.buttons || event.pointerType === "touch") return;
      builder.cursor.at = null;
      builder.hover(...place(event));
    });
    picture.addEventListener("pointerleave", () => {
      builder.spot = null;
      builder.show();
    });
    picture.addEventListener("click", (event) => {
      const [x, y] = place(event);
      if (builder.tool || event.detail === 0 || Math.hypot(x - pressed[0], y - pressed[1]) > CLICK_REACH) return;
      builder.choice.choose(builder.aim.itemAt(x, y, event.pointerType === "touch"));
    });
    // A double click, the other button, or a finger that rests.
    for (const kind of ["dblclick", "contextmenu"]) {
      picture.addEventListener(kind, (event) => {
        const item = builder.tool ? null : builder.aim.itemAt(...place(event), event.pointerType === "touch");
        if (kind === "contextmenu") event.preventDefault();
        if (!item) return;
        builder.studio.gestures.cancel();
        builder.choice.choose(item);
        builder.choice.field.open();
      });
    }
  }

  /**
   * Return handlers that are the tool's while there is one, and others else.
   * @param {import("../../../pictures/page/drag.js").Handlers} own
   */
  handlers(own) {
    const { builder } = this;
    return {
      ...own,
      grip: (x, y, isTouch) => {
        if (!builder.tool || !builder.model.link.isOpen) return own.grip(x, y, isTouch);
        return { tool: builder.tool, at: [x, y], seen: [x, y], isTouch };
      },
      move: (grip, x, y) => (grip.tool ? builder.when(() => this.drag(grip, x, y)) : own.move(grip, x, y)),
      drop: (grip) => {
        if (!grip.tool) return own.drop(grip);
        const isNone = this.#isNone();
        return builder.when(() => this.drop(grip, isNone));
      },
      cancel: (grip) => {
        if (!grip.tool) return own.cancel(grip);
        grip.isOver = true;
        return builder.escape();
      },
    };
  }

  /** Whether the press was none: another finger came, or the system took it. */
  #isNone() {
    return this.wasCancelled || this.builder.studio.gestures.pointers.size > 1;
  }

  drag(grip, x, y) {
    const { builder } = this;
    const { tool, at, seen, isTouch } = grip;
    if (grip.isOver || tool !== builder.tool) return;
    if (!grip.isDrag && Math.hypot(x - at[0], y - at[1]) < CLICK_REACH) return;
    if (!grip.isDrag && tool.drags) tool.down(builder.spotAt(...at, isTouch));
    grip.isDrag = true;
    // Of tools that only click a drag moves the canvas.
    if (!tool.drags) builder.canvas.stage.pan(x - seen[0], y - seen[1]);
    grip.seen = [x, y];
    builder.spot = tool.drags ? builder.spotAt(x, y - (isTouch ? ABOVE_FINGER : 0), isTouch) : null;
    if (builder.spot) tool.move(builder.spot);
    builder.show();
  }

  drop(grip, isNone = false) {
    const { builder } = this;
    const { tool, at, isTouch } = grip;
    if (grip.isOver || tool !== builder.tool) return;
    if (isNone) {
      if (grip.isDrag) tool.reset();
    } else {
      if (!grip.isDrag) {
        builder.spot = builder.spotAt(...at, isTouch);
        tool.down(builder.spot);
      }
      const change = builder.spot && tool.up(builder.spot, Boolean(grip.isDrag));
      if (isTouch) builder.spot = null;
      if (change) builder.commit(change);
    }
    builder.show();
  }
}
