// Edits of documents, for the tests in Python: input is a list of [document, edits], each edit a
// function's name and its arguments after the document; output what the last one returns. Both are JSON.

import { readFileSync } from "node:fs";
import { addJoint, joinToLink, mergeJoints, moveJoint, removeJoint, renameJoint, setGround } from "../../python/assur/studio/page/document/joints.js";
import { addLink, removeLink, renameLink, setDriver } from "../../python/assur/studio/page/document/links.js";
import { nameError } from "../../python/assur/studio/page/document/names.js";
import { setDimension } from "../../python/assur/studio/page/document/machine.js";
import { addCylinder, addSlide, removeSlide, renameSlide } from "../../python/assur/studio/page/document/slides.js";
import { redrawn, withoutCylinder } from "../../python/assur/studio/page/document/structure.js";

const EDITS = {
  ...{ addJoint, joinToLink, mergeJoints, moveJoint, removeJoint, renameJoint, setGround },
  ...{ addLink, removeLink, renameLink, setDriver },
  ...{ setDimension, addCylinder, addSlide, removeSlide, renameSlide, redrawn, withoutCylinder, nameError },
};

const cases = JSON.parse(readFileSync(0, "utf8"));
const apply = (document, [name, ...values]) => EDITS[name](document, ...values);
process.stdout.write(JSON.stringify(cases.map(([document, edits]) => edits.reduce(apply, document))));
