// What the help explains, in its order: formulas are the same in all languages, the texts are words.

const ARTOBOLEVSKY = "I. I. Artobolevsky, Theory of Mechanisms and Machines (1988)";
const UICKER = "J. J. Uicker, G. R. Pennock, J. E. Shigley, Theory of Machines and Mechanisms";
const WAMPLER = "A. J. Sommese, C. W. Wampler, The Numerical Solution of Systems of Polynomials (2005)";

/**
 * The words of a term are `help_<id>` in camelCase: `helpMobility`, and `helpMobilityText`.
 * @type {{id: string, formula?: string, reference?: string}[]}
 */
export const HELP_TERMS = [
  { id: "mobility", formula: "W = 3n − 2p₁", reference: `${ARTOBOLEVSKY}; ${UICKER}` },
  { id: "assurGroup", formula: "3n − 2p₁ = 0", reference: ARTOBOLEVSKY },
  { id: "structuralFormula", formula: "I(crank) → II(coupler, rocker)", reference: ARTOBOLEVSKY },
  { id: "driver", formula: "q = φ,  q = s" },
  { id: "assembly", reference: WAMPLER },
  { id: "deadPoint", formula: "dφ/dq → ∞,  γ = 0", reference: UICKER },
  { id: "transmissionAngle", formula: "0 ≤ γ ≤ 90°", reference: UICKER },
  { id: "fullRotation", formula: "l_min + l_max < l′ + l″", reference: UICKER },
  { id: "analogues", formula: "φ′ = dφ/dq,  v = φ′ω,  a = φ″ω² + φ′ε", reference: ARTOBOLEVSKY },
  { id: "sensitivity", formula: "∂ψ/∂l,  q = const" },
  { id: "planOfVelocities", formula: "v_C = v_B + v_CB", reference: ARTOBOLEVSKY },
  { id: "instantCentre", formula: "v = ω · r", reference: UICKER },
  { id: "timeRatio", formula: "k = t₁/t₂ ≥ 1", reference: UICKER },
  { id: "reducedInertia", formula: "J = Σ (m v′² + I φ′²)", reference: ARTOBOLEVSKY },
  { id: "reducedMoment", formula: "M = Σ (F · r′ + T φ′)", reference: ARTOBOLEVSKY },
  { id: "equationOfMotion", formula: "J ε + ½ J′ ω² = M", reference: ARTOBOLEVSKY },
  { id: "speedFluctuation", formula: "δ = (ω_max − ω_min)/ω_mean", reference: UICKER },
  { id: "flywheel", formula: "½ J ω² = ½ J₀ ω₀² + ∫ M dq", reference: ARTOBOLEVSKY },
  { id: "reactions", reference: `${ARTOBOLEVSKY}; ${UICKER}` },
  { id: "targetDeviation", formula: "d_max = max dᵢ,  d_rms = √(Σ dᵢ²/n)" },
];

/** What one does, and its words: `helpDo…` and `helpWhat…`. */
export const HELP_GESTURES = ["Joint", "Link", "Canvas", "Shift", "Alt", "Drop", "Touch", "Field"];

/** Keys as they are written, and their words: `helpKey…`. */
export const HELP_KEYS = [
  ["Space", "Play"],
  ["← →", "Step"],
  ["Home", "Home"],
  ["Tab", "Tab"],
  ["0", "Fit"],
  ["F", "Projector"],
  ["Ctrl Z, Ctrl Y", "Undo"],
  ["Ctrl S", "Save"],
  ["Esc", "Escape"],
  ["?", "Help"],
];

/**
 * Whether an entry has all words that are sought.
 * @param {string} text
 * @param {string} sought
 */
export function matchesSearch(text, sought) {
  const plain = (one) => one.toLocaleLowerCase().normalize("NFD").replace(/\p{M}/gu, "");
  const own = plain(text);
  return plain(sought).split(/\s+/).every((word) => own.includes(word));
}
