// Scenes of documents and sizes of symbols, for the tests in Python. Input and output are JSON.

import { readFileSync } from "node:fs";
import { sketchScene } from "../../python/assur/studio/page/document/sketch.js";
import { SIZES } from "../../python/assur/studio/page/document/symbols.js";

const documents = JSON.parse(readFileSync(0, "utf8"));
const scenes = documents.map((document) => ({ ...sketchScene(document), turn: null }));
process.stdout.write(JSON.stringify({ scenes, sizes: SIZES }));
