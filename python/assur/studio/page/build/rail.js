// The rail of tools.

import { html, icon } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";

/** Tools from above, lines between them; each with the key that takes it. */
const RAIL = ["select", null, "joint", "link", "plate", "slide", "cylinder", null, "ground", "driver", null, "remove"];
const LETTERS = {
  ...{ select: "V", joint: "J", link: "L", plate: "P", slide: "S", cylinder: "C" },
  ...{ ground: "G", driver: "D", remove: "X" },
};
const ring = (x, y, r) => `M${x} ${y - r}a${r} ${r} 0 1 0 0 ${2 * r} ${r} ${r} 0 0 0 0-${2 * r}z`;
const GROUND_HATCH = "M7.5 16.5L5.5 20M12 16.5L10 20M16.5 16.5l-2 3.5";
const TOOL_ICONS = {
  select: "M6 4l12 9-6 1 3 6-2.5 1-2.7-6L6 19z",
  joint: `${ring(12, 12, 3.5)}M12 3v5.5M12 15.5V21M3 12h5.5M15.5 12H21`,
  link: `${ring(6, 18, 2.5)}${ring(18, 6, 2.5)}M7.8 16.2l8.4-8.4`,
  plate: `${ring(5, 18, 2)}${ring(19, 18, 2)}${ring(11, 6, 2)}M7 18h10M6 16.2l4.2-8.3M12.2 7.7l5.6 8.6`,
  slide: "M7 6h10v7H7zM3 16.5h18M6 16.5l-2 3.5M11 16.5L9 20M16 16.5L14 20M20.5 16.5L18.5 20",
  cylinder: `M3 8.5h11v7H3zM8 8.5v7M8 12h9${ring(19, 12, 2)}`,
  ground: `${ring(12, 6.5, 2)}M10.8 8.2L6 16.5h12l-4.8-8.3M4 16.5h16${GROUND_HATCH}`,
  driver: "M19 13.5a7 7 0 1 0-2.5 4.5M19 13.5l-3-3.5M19 13.5l3.2-3.2",
  remove: "M5 7h14M10 7V4.5h4V7M7 7l1 13h8l1-13M10.5 10.5v6M13.5 10.5v6",
};

const lettersOf = Object.entries(LETTERS).map(([tool, letter]) => [letter.toLowerCase(), tool]);
/** Which tool a key takes. */
export const TOOL_KEYS = Object.fromEntries(lettersOf);

export class Rail {
  /**
   * @param {HTMLElement} element
   * @param {(name: string) => void} take
   */
  constructor(element, take) {
    this.buttons = new Map();
    for (const name of RAIL) {
      if (name === null) {
        element.append(html("hr"));
        continue;
      }
      const label = say(`${name}Tool`);
      const words = { title: `${label} (${LETTERS[name]})`, "aria-label": label, "aria-keyshortcuts": LETTERS[name] };
      const state = { type: "button", class: "tool", "data-tool": name, "aria-pressed": "false" };
      const button = html("button", { ...state, ...words }, icon(TOOL_ICONS[name]));
      // The tool that is taken already is laid down.
      button.addEventListener("click", () => take(button.getAttribute("aria-pressed") === "true" ? "select" : name));
      this.buttons.set(name, button);
      element.append(button);
    }
  }

  show(name) {
    for (const [own, button] of this.buttons) button.setAttribute("aria-pressed", String(own === name));
  }
}
