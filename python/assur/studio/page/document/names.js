// Names of joints, links and slides: which are taken, which are allowed, which are free.

/** Blanks, dots, slashes, quotes and brackets, and what is not seen: the core forbids them in names. */
const FORBIDDEN_LETTERS = /[\s\p{Cc}\p{Cs}./\\'"\x60()[\]{}<>‘’‚“”„«»‹›（）［］｛｝〈〉《》「」『』【】]/u;
const INVISIBLE_LETTERS = /[\u{ad}\u{200b}-\u{200f}\u{2060}\u{feff}]/u;

/** Parts of a cylinder, and the endings of the links that it makes if they have no names. */
export const CYLINDER_PARTS = { barrel: "_barrel", rod: "_rod" };

/** Whether a value is a table: an object that is no list. */
export const isTable = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
/** Return a part of a document that is a table, or an empty one: half a document may lack it. */
export const tableOf = (value) => (isTable(value) ? value : {});
/** Return a part of a document that is a list, or an empty one. */
export const listOf = (value) => (Array.isArray(value) ? value : []);

/** Whether a slide is a cylinder. */
export const isCylinder = (slide) => isTable(slide) && ("base" in slide || "end" in slide);

/** Return the names of a cylinder's links. */
export function cylinderLinks(name, slide) {
  const own = (part) => (typeof slide[part] === "string" ? slide[part] : `${name}${CYLINDER_PARTS[part]}`);
  return { barrel: own("barrel"), rod: own("rod") };
}

/**
 * Return all links with their joints, those that cylinders make at the end.
 * @returns {Object<string, string[]>}
 */
export function allLinks(document) {
  const links = Object.entries(tableOf(document.links)).map(([name, joints]) => [name, listOf(joints)]);
  for (const [name, slide] of Object.entries(tableOf(document.slides))) {
    if (!isCylinder(slide)) continue;
    const { barrel, rod } = cylinderLinks(name, slide);
    links.push([barrel, [slide.base]], [rod, [slide.end]]);
  }
  return Object.fromEntries(links);
}

/** Return all names that are taken. */
export function takenNames(document) {
  const named = [document.joints, allLinks(document), document.slides];
  return new Set(named.flatMap((table) => Object.keys(tableOf(table))));
}

/**
 * Return what is wrong with a new name.
 * @param {Object} document
 * @param {string} name
 * @param {string} [own] the name so far, which may stay
 * @returns {{error: string, values: Object} | null} a key of words: `emptyName`, `badName`, `takenName`
 */
export function nameError(document, name, own = undefined) {
  if (name === own) return null;
  if (typeof name !== "string" || !name) return { error: "emptyName", values: {} };
  // "__proto__" as a key would not be one.
  const isBad = FORBIDDEN_LETTERS.test(name) || INVISIBLE_LETTERS.test(name) || name === "__proto__";
  if (isBad) return { error: "badName", values: { name } };
  if (own === "ground") return { error: "groundName", values: {} };
  if (name === "ground" || takenNames(document).has(name)) return { error: "takenName", values: { name } };
  return null;
}

/** Return the next free letter for a joint: A to Z, then A1 to Z1, and so on. */
export function nameJoint(document) {
  const taken = takenNames(document);
  for (let round = 0; ; round++) {
    for (const letter of "ABCDEFGHIJKLMNOPQRSTUVWXYZ") {
      const name = round ? `${letter}${round}` : letter;
      if (!taken.has(name)) return name;
    }
  }
}

/** Return the next free name with a number: link1, link2 … */
export function numberedName(document, stem) {
  const taken = takenNames(document);
  let n = 1;
  while (taken.has(`${stem}${n}`)) n += 1;
  return `${stem}${n}`;
}
