// The structure: what is counted, and the Assur groups with their links.

import { html } from "../../../pictures/page/elements.js";
import { say } from "../../../pictures/page/words.js";
import { section } from "../window/shell.js";
import { driverList } from "./drivers.js";
import { groupColour } from "./skeleton.js";

export class StructureSection {
  /** @param {import("../studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.model = studio.model;
    this.list = html("ul", { class: "groups" });
    this.facts = html("dl", { class: "facts" });
    const { element, note } = section(say("structure"), "assembly", this.list, this.facts);
    Object.assign(this, { element, note });
    this.model.on("checked", () => this.show());
    this.show();
  }

  show() {
    const { counted, structure } = this.model.checked;
    // Of what does not move yet, what is missing has the count.
    this.element.hidden = !counted.moving_links || !structure;
    if (this.element.hidden) return;
    this.note.textContent = structure ? say("classOf", { n: structure.class }) : "";
    const { moving_links: links, turning_pairs: turning, sliding_pairs: sliding, mobility } = counted;
    const pairs = turning + sliding;
    const facts = [
      [say("movingLinks"), `n = ${links}`],
      [say("pairsCounted", { turning, sliding }), `p = ${pairs}`],
      [say("chebyshev"), `3·${links} − 2·${pairs} = ${String(mobility).replace("-", "−")}`],
    ];
    const isRedundant = structure && structure.mobility !== mobility;
    if (isRedundant) facts.push([say("redundantCounted"), `W = ${structure.mobility}`]);
    const cells = facts.flatMap(([name, value]) => [html("dt", {}, name), html("dd"), html("dd", {}, value)]);
    this.facts.replaceChildren(...cells);
    const drivers = driverList(this.model.document);
    const groups = (structure?.groups ?? []).map((group, i) => {
      const title = say(group.order === 2 ? "groupDyad" : "groupOf", { cls: group.class, order: group.order });
      return this.#entry(group.class, title, group.links, groupColour(i));
    });
    const title = say(drivers.length > 1 ? "driversNamed" : "driverNamed");
    const driver = this.#entry("I", title, drivers.map((one) => one.name), "var(--driver)");
    this.list.replaceChildren(...(structure ? [driver] : []), ...groups);
  }

  #entry(cls, title, links, colour) {
    const badge = html("span", { class: "badge-text" }, cls);
    badge.style.background = colour;
    const text = html("span", {}, html("span", {}, title), html("span", { class: "note" }, links.join(", ")));
    const entry = html("li", { tabindex: "0" }, badge, text);
    this.studio.highlight.attach(entry, () => ({ links }));
    return entry;
  }
}
