// Whether something from outside has the shape of a document: a browser's store and a notebook's kernel
// may hold anything. Whether it is a mechanism the server says.

import { isTable } from "./names.js";

const isText = (value) => typeof value === "string";
const isPlace = (value) => Array.isArray(value) && value.length === 2 && value.every(Number.isFinite);
const isList = (of) => (value) => Array.isArray(value) && value.every(of);
const isTableOf = (of) => (value) => isTable(value) && Object.values(value).every(of);
const isDriver = (value) => isText(value) || isTable(value);

/** What each part of a document must be, if it is there. */
const DOCUMENT_PARTS = {
  driver: (value) => isDriver(value) || isList(isDriver)(value),
  input_speed: (value) => Number.isFinite(value) || isList(Number.isFinite)(value),
  joints: isTableOf(isPlace),
  links: isTableOf(isList(isText)),
  slides: isTableOf(isTable),
  assembly: isTable,
  dimensions: isTable,
  drawn: isTable,
  bodies: isTableOf(isTable),
  loads: isList(isTable),
  motor: (value) => isTable(value) || isList(isTable)(value),
};

/** Whether a value has the shape of a document. */
export function hasShapeOfDocument(value) {
  if (!isTable(value)) return false;
  return Object.entries(DOCUMENT_PARTS).every(([key, isPart]) => value[key] === undefined || isPart(value[key]));
}

/** Whether a value is a path that a point may be wanted to take. */
export function isTargetPath(value) {
  return isTable(value) && isList(isPlace)(value.points) && value.points.length > 1;
}
