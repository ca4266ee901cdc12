// What a map of two dimensions can show: the metrics of assur.metric that make sense of a mechanism.

import { say } from "../../../pictures/page/words.js";

const METRIC_WORDS = {
  min_transmission_angle: "metricLeastTransmission",
  span: "metricSpan",
  swing: "metricSwing",
  reachable: "metricFullRotation",
  time_ratio: "metricTimeRatio",
  deviation: "metricDeviation",
};

/** What the help says of a metric: one of HELP_TERMS. */
const METRIC_TERMS = { min_transmission_angle: "transmissionAngle", reachable: "fullRotation", time_ratio: "timeRatio" };

/**
 * @typedef {Object} MetricChoice
 * @property {string} id
 * @property {string} text as it is chosen
 * @property {Object} spec what `map` is asked for
 * @property {"rad" | "m" | ""} unit of its value
 * @property {string} [term] of the help
 * @property {boolean} [isWhole] measured over the whole turn, though the driver does not turn round
 */

/**
 * Return the metrics of a mechanism, the usual ones first.
 * @param {Object} data the page's data
 * @param {Object<string, number>} assembly by inner joint or slide of the dyads
 * @param {boolean} isTurning whether q is an angle
 * @returns {MetricChoice[]}
 */
export function metricChoices(data, assembly, isTurning) {
  const slides = data.slides.map((slide) => slide.name);
  const links = data.links.filter((_, i) => i !== 0 && !data.driven.includes(i));
  const isSlide = (name) => slides.includes(name);
  // The output first, as the diagrams show it.
  const outputs = [...new Set(data.diagrams.map((id) => id.split(".")[0])), ...links, ...slides];
  const all = outputs.filter((name, i) => (links.includes(name) || isSlide(name)) && outputs.indexOf(name) === i);
  const made = [];
  const offer = (metric, of, unit, spec, more = {}) => {
    const id = [metric, ...Object.values(spec)].join(" ");
    const term = METRIC_TERMS[metric];
    const word = metric === "span" && unit === "rad" ? "swing" : metric;
    made.push({ id, text: say(METRIC_WORDS[word], { of }), spec: { metric, ...spec }, unit, term, ...more });
  };
  // The dyad next to the output first.
  for (const at of Object.keys(assembly ?? {}).reverse()) offer("min_transmission_angle", at, "rad", { at });
  for (const of of all) offer("span", of, isSlide(of) ? "m" : "rad", { of });
  if (isTurning) {
    offer("reachable", [data.driver].flat()[0], "", {}, { isWhole: true });
    for (const of of all) offer("time_ratio", of, "", { of }, { isWhole: true });
  }
  for (const joint of data.paths) {
    for (const axis of ["x", "y"]) offer("span", `${joint}.${axis}`, "m", { of: `${joint}.${axis}` });
    offer("deviation", joint, "m", { of: joint });
  }
  return made;
}

/** Write why there is no value, as the server says it, in the language spoken. */
export function reasonText(text) {
  const stops = text.match(/^(.*) stops$/);
  if (stops) return say("reasonStops", { driver: stops[1] === "the driver" ? say("theDriver") : stops[1] });
  const known = { "cannot be assembled": "reasonNowhere", "out of reach": "reasonBeyond", "no value": "reasonNoValue" };
  return known[text] ? say(known[text]) : text;
}
