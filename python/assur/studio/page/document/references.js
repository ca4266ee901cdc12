// Every place of a document where a name of a joint, a link or a slide stands.
//
// Renaming, removing and merging are one walk through all of them: each name becomes another one,
// or is gone, and what cannot be without it goes with it.

import { CYLINDER_PARTS, cylinderLinks, isCylinder, isTable, listOf, tableOf } from "./names.js";

/** Keys of loads with one name; `over` of a load or a table is a link or a slide. */
const LOAD_NAMES = { link: "link", on: "link", axes: "link", slide: "slide", over: "coordinate" };

/**
 * New names: each function takes a name and returns the one that stands for it, or null if it is gone.
 * @typedef {{joint?: (name: string) => string | null, link?: (name: string) => string | null,
 *   slide?: (name: string) => string | null}} NameMap
 */

/**
 * Return the document with other names, and without what names something that is gone.
 *
 * A list of joints never has one twice. A slide that loses its link, its guide or an end goes, and
 * so does a load that loses a name; an origin, a body's place or an entry of a section alone goes.
 * Where something is gone, so is `drawn`, which has to name everything.
 * @param {Object} document
 * @param {NameMap} map
 */
export function withNames(document, map) {
  const same = (name) => name;
  const slides = tableOf(document.slides);
  const isSlide = (name) => Object.hasOwn(slides, name);
  const joint = map.joint ?? same;
  const { link, slide } = followedNames(slides, joint, map.link ?? same, map.slide ?? same);
  const names = {
    ...{ joint, link, slide },
    coordinate: (name) => (isSlide(name) ? slide(name) : link(name)),
    // Friction and assembly are by joint or slide.
    pair: (name) => (isSlide(name) ? slide(name) : joint(name)),
  };
  const changes = {
    joints: (table) => entriesOf(table, joint),
    links: (table) => entriesOf(table, link, (joints) => withoutGone(listOf(joints).map(joint))),
    slides: (table) => entriesOf(table, slide, (own, name) => slideNames(own, name, names)),
    driver: (driver) => driverNames(driver, names),
    assembly: (table) => entriesOf(table, names.pair),
    dimensions: (table) => dimensionNames(table, names, isSlide),
    bodies: (table) => entriesOf(table, link, (body) => bodyNames(body, joint)),
    friction: (table) => entriesOf(table, names.pair),
    loads: (loads) => withoutGone(listOf(loads).map((load) => loadNames(load, names))),
    drawn: (drawn) => drawnNames(drawn, names, isSlide),
  };
  const made = { ...document };
  for (const [key, change] of Object.entries(changes)) {
    if (document[key] === undefined || document[key] === null) continue;
    made[key] = change(document[key]);
    const isEmptied = made[key] !== null && typeof made[key] === "object" && !Object.keys(made[key]).length;
    if (made[key] === null || (isEmptied && key !== "joints" && key !== "links")) delete made[key];
  }
  return withSpeeds(withMotors(made, document, names), document, names);
}

/** A slide goes with its links, a cylinder with its ends too; a cylinder's links go and turn with it. */
function followedNames(slides, joint, renameLink, renameSlide) {
  const gone = new Set();
  const followed = new Map();
  const lost = (value, rename) => typeof value === "string" && rename(value) === null;
  for (const [name, own] of Object.entries(slides).filter(([, one]) => isCylinder(one))) {
    const parts = cylinderLinks(name, own);
    const isPoint = own.base !== own.end && joint(own.base) === joint(own.end);
    const isCut = [own.base, own.end].some((end) => lost(end, joint));
    const isOpen = Object.values(parts).some((part) => lost(part, renameLink));
    if (isPoint || isCut || isOpen || renameSlide(name) === null) gone.add(name);
    for (const [part, ending] of Object.entries(CYLINDER_PARTS)) {
      if (gone.has(name)) followed.set(parts[part], null);
      else if (typeof own[part] !== "string") followed.set(parts[part], `${renameSlide(name)}${ending}`);
    }
  }
  const link = (name) => {
    const own = renameLink(name);
    const after = followed.get(name);
    return own !== null && followed.has(name) && (own === name || after === null) ? after : own;
  };
  for (const [name, own] of Object.entries(slides)) {
    if (isTable(own) && (lost(own.link, link) || lost(own.on, link))) gone.add(name);
  }
  return { link, slide: (name) => (gone.has(name) ? null : renameSlide(name)) };
}

/** Return what is not gone, and each once. */
const withoutGone = (list) => [...new Set(list)].filter((own) => own !== null);

/** Return a table with other keys; of two that become one, the one that had the name stays. */
function entriesOf(table, rename, each = (value) => value) {
  const made = {};
  for (const [name, value] of Object.entries(tableOf(table))) {
    const own = rename(name);
    if (own === null || (own !== name && Object.hasOwn(table, own) && rename(own) === own)) continue;
    made[own] = each(value, name);
  }
  return made;
}

function slideNames(own, name, { joint, link, slide }) {
  if (!isTable(own)) return own;
  const made = { ...own };
  for (const [part, ending] of isCylinder(own) ? Object.entries(CYLINDER_PARTS) : []) {
    // A link that the cylinder named by itself has a name of its own now.
    const before = `${name}${ending}`;
    if (typeof own[part] !== "string" && link(before) !== `${slide(name)}${ending}`) made[part] = before;
  }
  for (const [keys, rename] of [[["link", "on", "barrel", "rod"], link], [["base", "end", "origin"], joint]]) {
    for (const key of keys) {
      if (typeof made[key] !== "string") continue;
      made[key] = rename(made[key]);
      if (made[key] === null) delete made[key];
    }
  }
  if (Array.isArray(made.along)) {
    made.along = made.along.map((own) => joint(own));
    if (made.along.includes(null)) delete made.along;
  }
  return made;
}

function driverNames(driver, names) {
  const one = (own) => {
    if (typeof own === "string") return names.coordinate(own);
    if (!isTable(own)) return own;
    const made = { ...own };
    for (const key of ["link", "relative_to"]) if (typeof own[key] === "string") made[key] = names.link(own[key]);
    return made.link === null || made.relative_to === null ? null : made;
  };
  if (!Array.isArray(driver)) return one(driver);
  const left = driver.map(one).filter((own) => own !== null);
  if (left.length < 2 && left.length < driver.length) return left[0] ?? null;
  return left;
}

/** Motors are in the order of the drivers: one goes with its driver. */
function withMotors(made, before, names) {
  const { motor, driver } = before;
  if (!Array.isArray(motor) || !Array.isArray(driver) || motor.length !== driver.length) return made;
  const left = motor.filter((_, i) => driverNames(driver[i], names) !== null);
  if (left.length === motor.length) return made;
  const { motor: _, ...rest } = made;
  if (left.length > 1) return { ...rest, motor: left };
  return left.length && left[0].type !== "None" ? { ...rest, motor: left[0] } : rest;
}

/** And so does its speed. */
function withSpeeds(made, { input_speed: speeds, driver }, names) {
  if (speeds === undefined || !driver) return made;
  const { input_speed: _, ...rest } = made;
  const given = [speeds].flat();
  const left = given.filter((_, i) => driverNames([driver].flat()[i] ?? null, names) !== null);
  if (left.length === given.length) return made;
  return left.length ? { ...rest, input_speed: left.length > 1 ? left : left[0] } : rest;
}

/** `coupler.length`, `coupler.P.x`, `ground.A.x`, `bore.angle`, `bore.origin.x`; also as nested tables. */
function dimensionNames(table, { joint, link, slide }, isSlide) {
  const made = {};
  for (const [dotted, value] of Object.entries(tableOf(table))) {
    const [owner, ...parts] = dotted.split(".");
    const own = isSlide(owner) ? slide(owner) : link(owner);
    if (parts.length === 2 && !isSlide(owner)) parts[0] = joint(parts[0]);
    if (own === null || parts[0] === null) continue;
    const inner = !parts.length && isTable(value) && !isSlide(owner) ? entriesOf(value, joint) : value;
    made[[own, ...parts].join(".")] = inner;
  }
  return made;
}

function bodyNames(body, joint) {
  if (!isTable(body) || typeof body.at !== "string") return body;
  const { at, ...rest } = body;
  const own = joint(at);
  return own === null ? rest : { ...body, at: own };
}

/** Return a load with other names, or null if one of its names is gone. */
function loadNames(load, names) {
  if (!isTable(load)) return load;
  const made = {};
  for (const [key, value] of Object.entries(load)) {
    if (["at", "first", "second"].includes(key)) made[key] = pointNames(value, names);
    else if (LOAD_NAMES[key] && typeof value === "string") made[key] = names[LOAD_NAMES[key]](value);
    else if (key === "force" && Array.isArray(value)) made[key] = value.map((own) => tableNames(own, names));
    else made[key] = tableNames(value, names);
    const isLost = made[key] === null || (key === "force" && listOf(made[key]).includes(null));
    if (isLost && value !== null) return null;
  }
  // A spring between two joints that become one.
  const isPoint = typeof load.first === "string" && load.first !== load.second && made.first === made.second;
  return isPoint ? null : made;
}

/** A joint, or a point in the frame of a link: `["rod", [x, y]]`. */
function pointNames(point, { joint, link }) {
  if (typeof point === "string") return joint(point);
  if (!Array.isArray(point) || typeof point[0] !== "string") return point;
  const own = link(point[0]);
  return own === null ? null : [own, ...point.slice(1)];
}

/** A value over another coordinate. */
function tableNames(value, { coordinate }) {
  if (!isTable(value) || typeof value.over !== "string") return value;
  const over = coordinate(value.over);
  return over === null ? null : { ...value, over };
}

/** Where an assembly was found has a number of everything: without one of them it says nothing. */
function drawnNames(drawn, names, isSlide) {
  if (!isTable(drawn)) return drawn;
  const made = { ...drawn };
  const keys = { joints: names.joint, angles: names.link, slides: names.slide, signs: names.pair };
  for (const [key, rename] of Object.entries(keys)) {
    if (!isTable(drawn[key])) continue;
    const table = entriesOf(drawn[key], rename);
    if (Object.keys(table).length < Object.keys(drawn[key]).length) return null;
    made[key] = table;
  }
  if (drawn.dimensions) made.dimensions = dimensionNames(drawn.dimensions, names, isSlide);
  if (drawn.drawn) made.drawn = drawnNames(drawn.drawn, names, isSlide);
  return made;
}
