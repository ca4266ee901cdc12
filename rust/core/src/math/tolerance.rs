//! The thresholds that decide what is returned, each with its reason; those of one search
//! stand beside it.
//!
//! All but the range of lengths are pure numbers: they are compared with lengths divided by
//! the size of the mechanism, or with sines of angles.

/// Unit roundoff of binary64 as used in the error bounds (the spacing at 1).
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON;

/// Lengths and coordinates beyond this are refused: their squares, and the third
/// analogues of slides, would leave the range of numbers.
pub const GREATEST_LENGTH: f64 = 1.0e153;

/// Lengths below this are refused, for the same reason.
pub const LEAST_LENGTH: f64 = 1.0e-153;

/// Two joints nearer than this part of their coordinates coincide: the distance
/// is then nothing but the rounding of the coordinates.
pub const ZERO_LENGTH: f64 = 4.0 * UNIT_ROUNDOFF;

/// Sine below which two guides of a drawing are parallel (angles carry a few u).
pub const PARALLEL: f64 = 1.0e-12;

/// A dyad drawn with a smaller |sine| between its legs shows no side.
///
/// Lengths taken from coordinates are good to a few u; near the flat dyad the
/// sine of the angle between the legs is the square root of such a difference,
/// so anything below a few √u = 1.5e-8 cannot be told from 0.
pub const FLAT_SINE: f64 = 6.0e-8;

/// How far (relative to the longer side) a triangle of lengths may fail to
/// close and still be taken as exactly flat: the closing side is a sum of a few
/// rounded terms, each good to u.
pub const FLAT_CLOSURE: f64 = 16.0 * UNIT_ROUNDOFF;

/// Singular values below this fraction of the largest count as zero when ranks
/// are taken. Columns are scaled to unit length before; coordinates carry u,
/// and a factor of 1e7 covers drawings typed with nine digits.
pub const RANK: f64 = 2.0e-9;

/// Residual (of the size) to which a displaced mechanism must close before its
/// rank is believed: Gauss-Newton converges quadratically, so it is either here
/// or far away.
pub const REGULAR_CLOSURE: f64 = 1.0e-12;

/// Entries of an elimination below this are not solved for when a displaced linkage is brought back
/// onto its closure.
pub const TRUNCATED: f64 = 1.0e-6;

/// Entries of an elimination below this belong to equations that nearly depend on others: links
/// that would be redundant, drawn with few digits. (Their misfit is amplified by the condition.)
pub const NEARLY_DEPENDENT: f64 = 1.0e-2;

/// So much (of the size) the misfit of such links may be for them to be said to nearly fit.
pub const NEARLY_REDUNDANT: f64 = 1.0e-4;

/// A redundant link fits while its misfit is below this part of the size (or below
/// [`CLOSURE_PER_CONDITION`] times the condition), and joints of a drawing are moved by no more
/// until its redundant links fit. Drawings typed with nine digits are off by less.
pub const REDUNDANT_CLOSURE: f64 = 2.0e-9;

/// Misfit of redundant links that is the rounding of a drawing, also of one far from its origin or of
/// ten or twenty links.
pub const REDUNDANT_ROUNDING: f64 = 1024.0 * UNIT_ROUNDOFF;

/// No redundant link fits with a greater misfit, however bad the condition.
pub const REDUNDANT_GREATEST: f64 = 1.0e-6;

/// Error of a position per unit of condition, of the size: 2 u measured on the
/// dyad RRR, 8 u with a margin (the design's bound).
pub const CLOSURE_PER_CONDITION: f64 = 8.0 * UNIT_ROUNDOFF;

/// Error of an analogue per unit of squared condition, of the analogue's size.
pub const ANALOGUE_PER_CONDITION_SQUARED: f64 = 64.0 * UNIT_ROUNDOFF;

/// Positions whose analogues keep fewer digits than this are near-singular.
pub const DIGITS_LEFT: f64 = 1.0e-6;

/// Condition from which a position is near-singular: 64 u κ² reaches [`DIGITS_LEFT`].
pub const NEAR_SINGULAR_CONDITION: f64 = 8388.608;

/// Condition of a dyad from which it cannot be told from a flat one: 1/κ is the
/// square root of a difference of rounded lengths, so beyond 1/(4 √u) = 2^24 nothing of
/// it is left. (What the dyad hangs on may carry more, but seldom across the flat
/// dyad: chains of parallelograms pass their change points without loss.)
pub const SINGULAR_CONDITION: f64 = 16_777_216.0;

/// Step, as a part of a cell of the path, of the six points from which a change
/// point is judged: far enough for the spread to be well conditioned, near enough
/// for a polynomial of degree six (error of the order of its sixth power).
pub const CHANGE_STEP: f64 = 1.0 / 128.0;

/// Least squared spread, per condition of what the dyad hangs on, that counts as
/// none: six values, each good to a few u, weighted by up to 15/10.
pub const CHANGE_SPREAD: f64 = 64.0 * UNIT_ROUNDOFF;

/// Condition of what a dyad hangs on that is counted there, at most: the product of
/// the conditions overrates chains that are singular together.
pub const CHANGE_CONDITION: f64 = 1.0e3;

/// How near (rad, or units of the scale) to a change point the smooth motion through it
/// is taken: where fewer than six digits of the analogues would remain.
pub const CHANGE_REACH: f64 = 1.0 / NEAR_SINGULAR_CONDITION;

/// How near it is the change point itself: nearer no dyad can be told from a flat one.
pub const CHANGE_WIDTH: f64 = 1.0 / SINGULAR_CONDITION;

/// How well (of the size) the polynomial through a change point must close: that of
/// some 20 states, each closed to a few u, has no more rounding; what is more is truncation.
pub const SMOOTH_CLOSURE: f64 = 256.0 * UNIT_ROUNDOFF;

/// How far (of the size, per condition) that smooth motion may be from the position
/// solved for: the errors of both. Farther, something else happens near by.
pub const CHANGE_MISFIT: f64 = 4.0 * CLOSURE_PER_CONDITION;

/// Product of the two steps (rad, or units of the scale) of a round of the iteration of a group
/// above class II, after which it is done: about that is left of the error.
pub const NEWTON_LEFT: f64 = UNIT_ROUNDOFF;
/// Square of the first step of a round by the condition, at most, for its matrix to be nearly
/// that of the solution; beyond a condition of 2^25, where no step is that short, nothing is known
/// any more.
pub const NEWTON_BENT2: f64 = 1.0 / 16.0;
/// Step after which it is done in any case: the next would be about its square.
pub const NEWTON_DONE: f64 = 1.0 / 67_108_864.0;
/// Rounds of that iteration, at most: from within the reach of the way's own steps it needs one
/// or two.
pub const NEWTON_ROUNDS: usize = 8;
/// Longest step of that iteration: a turn of a link by more says only that it starts far away.
pub const NEWTON_LONGEST: f64 = 0.5;

/// Largest turn of a link between two neighbouring knots of the path along
/// which angles are followed; half a turn would already be ambiguous.
pub const LIFT_TURN: f64 = std::f64::consts::FRAC_PI_4;

/// Halvings of one cell of that path: 2^-40 of a cell is below the spacing of q.
pub const LIFT_HALVINGS: u32 = 40;
