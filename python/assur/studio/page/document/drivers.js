// The drivers of a document: what moves by itself, and in what its coordinate is measured.

import { tableOf } from "./names.js";

/** Whether a driver (by default the first) is a slide: it has m and N where others have rad and N·m. */
export function drivesSlide(document, axis = 0) {
  const own = [document.driver ?? []].flat()[axis];
  return typeof own === "string" && Object.hasOwn(tableOf(document.slides), own);
}
