// All texts, by language. `{name}` is replaced.

const WORDS = {
  en: {
    play: "Play",
    pause: "Pause",
    home: "To the drawing",
    speed: "Speed of the driver",
    speedStays: "It stays {kept}.",
    slower: "shown {n} times slower",
    fit: "Fit",
    wheelZooms: "Ctrl and the wheel zoom.",
    scheme: "Light or dark",
    names: "Names",
    paths: "Paths",
    velocity: "Velocity",
    acceleration: "Acceleration",
    positions: "Positions",
    groups: "Groups",
    points: "Points",
    pointsHint: "Points with paths and arrows",
    show: "What is shown",
    diagram: "Quantity of diagram {n}",
    picture: "{title}: {links} moving links, driver {driver}, at {q}",
    mechanism: "Mechanism",
    dial: "Position of the driver {driver}",
    turn: "turn {n}",
    of: "{low} to {high}",
    atDeadPoint: "Dead point at {q}: {group} lets the driver go no further.",
    nothing: "There is no position at {q}.",
    playing: "Playing",
    paused: "Paused at {q}",
    angle: "angle",
    omega: "speed",
    alpha: "acceleration",
    value: "position",
    v: "speed",
    a: "acceleration",
    notASpeed: "“{text}” is not a speed.",
    tooLargeNumber: "“{text}” is too large.",
  },
};

let language = "en";

/** Speak another language from now on. */
export function speak(code) {
  language = code;
}

/** Return the language that is spoken. */
export const spoken = () => language;

/**
 * Learn more words.
 * @param {Object<string, Object<string, string>>} tables by language
 */
export function learn(tables) {
  for (const code in tables) WORDS[code] = { ...WORDS[code], ...tables[code] };
}

/**
 * Return a text; in English where the language has none.
 * @param {string} key
 * @param {Object<string, string|number>} [values]
 */
export function say(key, values = {}) {
  const text = WORDS[language]?.[key] ?? WORDS.en[key] ?? key;
  return text.replace(/\{(\w+)\}/g, (whole, name) => String(values[name] ?? whole));
}
