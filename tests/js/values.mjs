// Values of quantities as the page has them: from a page's data and coordinates, for the tests in
// Python. Input and output are JSON.

import { readFileSync } from "node:fs";
import { allQuantities } from "../../python/assur/pictures/page/quantities.js";
import { fromBase64, Turn } from "../../python/assur/pictures/page/turn.js";

const cases = JSON.parse(readFileSync(0, "utf8"));
const answers = cases.map(({ data, q, ids, speed }) => {
  const turn = new Turn({ ...data.turn, values: fromBase64(data.turn.values) });
  const all = allQuantities(data).flatMap((group) => group.quantities);
  return ids.map((id) => q.map((own) => all.find((one) => one.id === id).value(turn.sample(own), speed)));
});
process.stdout.write(JSON.stringify(answers));
